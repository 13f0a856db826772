"""Text to a tree whose every node knows its place, from libyaml's events.

Events and not PyYAML's composer, which recurses in C and crashes the interpreter on 100 kB of `[`; nothing here recurses. JSON, with the
trailing commas that real tools write, is read by the same path. Without libyaml the pure Python parser gives the same events, slower.
"""

from __future__ import annotations

import gc
import re
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

from .events import ERRORS, events, trouble
from .files import read
from .node import NO_KEYS, Limits, Node, Parsed, Problem, Stop
from .scalars import WORDS, resolve
from .source import Source, forbidden
from .span import Label, Span

__all__ = ["Limits", "Node", "Parsed", "Problem", "parse", "read"]

MAX_TOLD = 50
"""Duplicate keys and tags of one text that are told; the rest would only bury them."""

_COLON = r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*+:"


def parse(source: Source, limits: Limits) -> Parsed:
    """The documents of a text. Nothing raises for what the text holds."""
    text = source.text
    reading = _Reading(text, limits)
    # A tree only grows while it is read, and to look through it for garbage again and again takes as long as to read it.
    collecting = gc.isenabled()
    gc.disable()
    try:
        reading.run()
    except Stop as stop:
        start, end = stop.problem.span
        problem = stop.problem._replace(span=Span(min(start, len(text)), min(end, len(text))))
    except ERRORS as error:
        problem = trouble(error, text)
    else:
        return Parsed(reading.documents, reading.problems)
    finally:
        if collecting:
            gc.enable()
    # The parser refuses these too, but not at their place, and perhaps only after the end of what was read.
    at = forbidden(text)
    if at is not None:
        return Parsed([], [Problem("MSAA901", f"the character U+{ord(text[at]):04X} may not stand in YAML or JSON", Span(at, at + 1))])
    return Parsed(reading.documents, [*reading.problems, problem])


_Anchored = tuple[Node, int, int]
"""An anchored node, how many nodes it is, and how many collections deep, aliases expanded."""


class _Reading:
    """One text while it is read. An anchor is None until its node is whole."""

    def __init__(self, text: str, limits: Limits) -> None:
        self.text = text
        self.limits = limits
        self.documents: list[Node] = []
        self.problems: list[Problem] = []
        self.anchors: dict[str, _Anchored | None] = {}

    def run(self) -> None:
        """Reads all events. This loop is where the time goes: what it needs is local, and nothing is kept of an event.

        `parent` is the open collection, `values` its children, `keys` None where it is a sequence, `key` what waits for its value, `name`
        its anchor, `before` the count of nodes before it, `deep` the most collections within it; `tail` is the end of what was last read.
        """
        text = self.text
        max_depth, max_count = self.limits.depth, self.limits.nodes
        get = events(text)
        new, known, anchors = object.__new__, dict(WORDS), self.anchors
        maybe_tags = "!" in text
        roots: list[Node] = []
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
                style, said = event.style, event.value
                # As Node's own __init__ does, without the call.
                node = new(Node)
                node.kind = "scalar"
                node.start = start
                node.end = tail
                node.keys = NO_KEYS
                node.text = said
                node.anchor = None
                if style:
                    node.value = said
                    node.plain = False
                    if style == "|" or style == ">":
                        tail = node.end = _block_end(text, start, tail, said)
                else:
                    try:
                        node.value = known[said]
                    except KeyError:
                        node.value = known[said] = resolve(said)
                    node.plain = True
                    if start == tail:
                        tail = _place_nothing(node, key, text)
                    elif maybe_tags and event.tag is None and text[start] in "!&":
                        self._bare(node)
                if event.tag is not None:
                    self._tagged(node, event.tag)
                if event.anchor is not None:
                    anchors[event.anchor] = (node, 1, 0)
                count += 1
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                end = event.end_mark.index
                # The end mark of a block collection is at the next token, past blank lines and comments.
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
                    raise Stop("MSAA906", f"nesting is deeper than the limit of {max_depth}", start, start + 1)
                if kind is MappingStartEvent:
                    node = Node("mapping", start, start, {}, {})
                else:
                    node = Node("sequence", start, start, [], NO_KEYS)
                if event.tag is not None:
                    self._tagged(node, event.tag)
                count += 1
            elif kind is AliasEvent:
                of, size, depth = self._anchored(event)
                start, tail = event.start_mark.index, event.end_mark.index
                node = Node(of.kind, start, tail, of.value, of.keys, of.text, of.plain, of.anchor or of)
                if len(opened) + depth > max_depth:
                    raise Stop("MSAA906", f"nesting is deeper than the limit of {max_depth}, aliases expanded", start, tail)
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
                raise Stop("MSAA906", f"more nodes than the limit of {max_count}, aliases expanded", start, max(start + 1, node.end))
            if keys is None:
                values.append(node)
            elif key is None:
                if node.kind != "scalar":
                    raise Stop("MSAA901", f"a {node.kind} cannot be a key: a key is a scalar", start, max(start + 1, node.end))
                key = node
                continue
            else:
                if values.setdefault(key.text, node) is node:
                    keys[key.text] = key
                else:
                    self._twice(key, keys[key.text])
                key = None
            if kind is MappingStartEvent or kind is SequenceStartEvent:
                opened.append((parent, values, keys, name, before, deep))
                parent, values, name, before, deep = node, node.value, event.anchor, count - 1, 0
                keys = node.keys if kind is MappingStartEvent else None
                tail = start
                if name is not None:
                    anchors[name] = None

    def _tell(self, problem: Problem) -> None:
        if len(self.problems) < MAX_TOLD:
            self.problems.append(problem)

    def _twice(self, key: Node, first: Node) -> None:
        """The first of two equal keys is kept."""
        shown = key.text if len(key.text) <= 80 else key.text[:79] + "…"
        self._tell(Problem("MSAA905", f"the key `{shown}` stands here twice", key.span, (Label(first.span, "first here"),)))

    def _anchored(self, event: Any) -> _Anchored:
        start, end, name = event.start_mark.index, event.end_mark.index, event.anchor
        if name not in self.anchors:
            raise Stop("MSAA901", f"no anchor `&{name[:80]}` stands before this alias", start, end)
        anchored = self.anchors[name]
        if anchored is None:
            raise Stop("MSAA901", f"`&{name[:80]}` holds itself", start, end)
        return anchored

    def _tagged(self, node: Node, tag: str) -> None:
        from .tags import tagged

        problem = tagged(node, tag, self.text)
        if problem is not None:
            self._tell(problem)

    def _bare(self, node: Node) -> None:
        from .tags import bare

        if bare(node, self.text):
            node.value, node.plain = node.text, False


def _block_end(text: str, start: int, end: int, said: str) -> int:
    """The end of a block scalar, without the line ends and blank lines after it; where it holds nothing else, of its `|` or `>`."""
    body, last = text[start:end], said.rstrip("\n")[-1:]
    if not last:
        body = body.partition("#")[0]
    return start + len(body.rstrip("\r\n" if last and last in " \t" else " \t\r\n"))


def _place_nothing(node: Node, key: Node | None, text: str) -> int:
    """Nothing, where a value is due, stands right after the `:` of its key; a parser's place may be beyond comments and line ends."""
    if key is not None:
        colon = re.compile(_COLON).match(text, key.end)
        node.start = node.end = colon.end() if colon is not None else key.end
    return node.end
