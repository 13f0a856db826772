"""Parses a text into a tree whose nodes know their places, from libyaml's events.

PyYAML's composer recurses in C and crashes the interpreter on 100 kB of `[`; nothing here recurses.
JSON, with the trailing commas that real tools write, takes the same path.
"""

from __future__ import annotations

import re
from contextlib import suppress
from typing import Any

from yaml.events import (
    AliasEvent,
    DocumentEndEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)

from msaa_lint.core.garbage import not_collecting
from msaa_lint.core.quote import quoted

from .events import ERRORS, events, problem_of
from .node import NO_KEYS, Limits, Node, Parsed, Problem, Stop
from .scalars import WORDS, resolve
from .source import Source, forbidden, forbidden_message
from .span import Label, Span

__all__ = ["Limits", "Node", "Parsed", "Problem", "parse"]

MAX_PROBLEMS = 50
"""Duplicate keys and wrong tags that are reported for one text; more would only bury the first
ones.
"""

_COLON = r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*+:"


def parse(source: Source, limits: Limits) -> Parsed:
    """The documents of a text and its problems. Never raises for an invalid text."""
    text = source.text
    reading = _Reading(text, limits)
    try:
        reading.read()
    except Stop as stop:
        start, end = stop.problem.span
        problem = stop.problem._replace(span=Span(min(start, len(text)), min(end, len(text))))
    except ERRORS as error:
        problem = problem_of(error, text, limits.depth)
    else:
        return Parsed(reading.documents, reading.problems)
    # The parser rejects these characters too, but not at their place, and perhaps after it has
    # rejected something else.
    at = forbidden(text)
    if at is not None:
        return Parsed([], [Problem("MSAA901", forbidden_message(text, at), Span(at, at + 1))])
    return Parsed(reading.documents, [*reading.problems, problem])


def beginning(text: str, limits: Limits) -> list[Node]:
    """The documents of a text up to its first syntax error or a limit; the last one may be
    incomplete.
    """
    reading = _Reading(text, limits)
    with suppress(Stop, *ERRORS):
        reading.read()
    return [*reading.documents, *reading.roots]


def documents(text: str, limits: Limits) -> list[Node] | None:
    """The documents of a text; None if it has a syntax error or exceeds a limit. Faster than
    `parse` for a text that has one.
    """
    reading = _Reading(text, limits)
    try:
        reading.read()
    except (Stop, *ERRORS):
        return None
    return reading.documents


_Anchored = tuple[Node, int, int]
"""An anchored node, its number of nodes and its depth in collections, aliases expanded."""


class _Reading:
    """One text while it is read. `roots` has the document that is being read; an anchor is None
    until its node is complete.
    """

    def __init__(self, text: str, limits: Limits) -> None:
        self.text = text
        self.limits = limits
        self.documents: list[Node] = []
        self.roots: list[Node] = []
        self.problems: list[Problem] = []
        self.anchors: dict[str, _Anchored | None] = {}

    def read(self) -> None:
        """Reads all events. A tree only grows meanwhile; collecting garbage would take as long as
        reading.
        """
        with not_collecting():
            self._run()

    def _run(self) -> None:
        """Reads all events. Most of the time is spent in this loop, so its variables are local.

        `parent` is the open collection, `values` its children, `keys` its keys (None for a
        sequence), `name` its anchor, `before` the number of nodes before it, `deep` the depth of
        collections within it. `key` waits for its value; `tail` is the end of the last node.
        """
        text = self.text
        max_depth, max_count = self.limits.depth, self.limits.nodes
        get = events(text)
        new, known, anchors = object.__new__, dict(WORDS), self.anchors
        maybe_tags = "!" in text
        roots = self.roots
        opened: list[tuple[Any, ...]] = []
        parent: Any = None
        values: Any = roots
        keys: dict[str, Node] | None = None
        key: Node | None = None
        name: str | None = None
        count = before = tail = deep = 0
        for event in iter(get, None):
            kind = type(event)
            if kind is ScalarEvent:
                start = event.start_mark.index
                tail = event.end_mark.index
                style, scalar = event.style, event.value
                # Node.__init__ without the call.
                node = new(Node)
                node.kind = "scalar"
                node.start = start
                node.end = tail
                node.keys = NO_KEYS
                node.text = scalar
                node.anchor = None
                if style:
                    node.value = scalar
                    node.plain = False
                    if style == "|" or style == ">":
                        tail = node.end = _block_end(text, start, tail, scalar)
                else:
                    try:
                        node.value = known[scalar]
                    except KeyError:
                        node.value = known[scalar] = resolve(scalar)
                    node.plain = True
                    if start == tail:
                        tail = _place_empty(node, key, text)
                    elif maybe_tags and event.tag is None and text[start] in "!&":
                        from .tags import apply_bare_tag

                        apply_bare_tag(node, text)
                if event.tag is not None:
                    self._apply_tag(node, event.tag)
                if event.anchor is not None:
                    anchors[event.anchor] = (node, 1, 0)
                count += 1
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                end = event.end_mark.index
                # A block collection's end mark is at the next token, after blank lines and
                # comments.
                if end > event.start_mark.index:
                    tail = end
                parent.end = tail
                if keys is not None and "<<" in keys:
                    from .merge import merge

                    merge(parent)
                size, depth = count - before, deep + 1
                if name is not None:
                    anchors[name] = (parent, size, depth)
                parent, values, keys, name, before, deep = opened.pop()
                if depth > deep:
                    deep = depth
                continue
            elif kind is MappingStartEvent or kind is SequenceStartEvent:
                start = event.start_mark.index
                if len(opened) >= max_depth:
                    raise Stop(
                        "MSAA906", f"the nesting exceeds the limit of {max_depth}", start, start + 1
                    )
                if kind is MappingStartEvent:
                    node = Node("mapping", start, start, {}, {})
                else:
                    node = Node("sequence", start, start, [], NO_KEYS)
                if event.tag is not None:
                    self._apply_tag(node, event.tag)
                count += 1
            elif kind is AliasEvent:
                of, size, depth = self._anchored(event)
                start, tail = event.start_mark.index, event.end_mark.index
                node = Node(
                    of.kind, start, tail, of.value, of.keys, of.text, of.plain, of.anchor or of
                )
                if len(opened) + depth > max_depth:
                    raise Stop(
                        "MSAA906",
                        f"the nesting with aliases expanded exceeds the limit of {max_depth}",
                        start,
                        tail,
                    )
                if depth > deep:
                    deep = depth
                count += size
            elif kind is DocumentEndEvent:
                root = roots.pop()
                if root.kind != "scalar" or root.start < root.end:
                    self.documents.append(root)
                anchors.clear()
                continue
            else:
                continue
            if count > max_count:
                raise Stop(
                    "MSAA906",
                    f"the number of nodes with aliases expanded exceeds the limit of {max_count}",
                    start,
                    max(start + 1, node.end),
                )
            if keys is None:
                values.append(node)
            elif key is None:
                if node.kind != "scalar":
                    hint = (
                        "fill in the template"
                        if text.startswith("{{", max(start - 1, 0))
                        else "use a scalar"
                    )
                    raise Stop(
                        "MSAA901",
                        f"a {node.kind} cannot be a key; {hint}",
                        start,
                        max(start + 1, node.end),
                    )
                key = node
                continue
            else:
                if values.setdefault(key.text, node) is node:
                    keys[key.text] = key
                else:
                    self._report_duplicate(key, keys[key.text])
                key = None
            if kind is MappingStartEvent or kind is SequenceStartEvent:
                opened.append((parent, values, keys, name, before, deep))
                parent, values, name, before, deep = node, node.value, event.anchor, count - 1, 0
                keys = node.keys if kind is MappingStartEvent else None
                tail = start
                if name is not None:
                    anchors[name] = None

    def _report(self, problem: Problem) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems.append(problem)

    def _report_duplicate(self, key: Node, first: Node) -> None:
        """Reports the second of two equal keys; the first one counts."""
        self._report(
            Problem(
                "MSAA905",
                f"duplicate key {quoted(key.text)}; remove one of the two",
                key.span,
                (Label(first.span, "first defined here"),),
            )
        )

    def _anchored(self, event: Any) -> _Anchored:
        start, end, name = event.start_mark.index, event.end_mark.index, event.anchor
        if name not in self.anchors:
            from msaa_lint.core.suggestions import did_you_mean

            hint = did_you_mean(name, self.anchors)
            if not hint and re.search(rf"&{re.escape(name)}(?![^\s,\[\]{{}}])", self.text[end:]):
                hint = "; move its definition before it"
            raise Stop(
                "MSAA901",
                f"the anchor {quoted(f'&{name}')} is not defined before this alias{hint}",
                start,
                end,
            )
        anchored = self.anchors[name]
        if anchored is None:
            raise Stop("MSAA901", f"the anchor {quoted(f'&{name}')} contains itself", start, end)
        return anchored

    def _apply_tag(self, node: Node, tag: str) -> None:
        from .tags import apply_tag

        problem = apply_tag(node, tag, self.text)
        if problem is not None:
            self._report(problem)


def _block_end(text: str, start: int, end: int, content: str) -> int:
    """The end of a block scalar without the blank lines after it; the end of its `|` or `>` if it
    is empty.
    """
    body, last = text[start:end], content.rstrip("\n")[-1:]
    if not last:
        body = body.partition("#")[0]
    return start + len(body.rstrip("\r\n" if last and last in " \t" else " \t\r\n"))


def _place_empty(node: Node, key: Node | None, text: str) -> int:
    """Places an empty value right after the `:` of its key, as the parser may place it after
    comments and line ends; returns its end.
    """
    if key is not None:
        colon = re.compile(_COLON).match(text, key.end)
        node.start = node.end = colon.end() if colon is not None else key.end
    return node.end
