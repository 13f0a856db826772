"""Text to a tree whose every node knows its place, from libyaml's events.

Events and not PyYAML's composer, which recurses in C and crashes the interpreter on 100 kB of `[`; nothing here recurses. JSON, with the
trailing commas that real tools write, is read by the same path. Without libyaml the pure Python parser gives the same events, slower.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from yaml.events import (
    AliasEvent,
    DocumentEndEvent,
    MappingEndEvent,
    MappingStartEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
    StreamEndEvent,
)

from ..finding import Label, Span
from .events import ERRORS, events, readable, trouble
from .files import read
from .node import NO_KEYS, Limits, Node, Parsed, Problem, Stop
from .scalars import WORDS, resolve
from .text import Source, forbidden

__all__ = ["Limits", "Node", "Parsed", "Problem", "parse", "read"]

MAX_TOLD = 50
"""Duplicate keys and tags of one text that are told; the rest would only bury them."""

_COLON = re.compile(r"(?:[ \t\r\n]|(?<=[ \t\r\n])#[^\r\n]*)*+:")


def parse(source: Source, limits: Limits) -> Parsed:
    """The documents of a text."""
    at = forbidden(source.text)
    if at is not None:
        message = f"the character U+{ord(source.text[at]):04X} may not stand in YAML or JSON"
        return Parsed([], [Problem("MSAA901", message, Span(at, at + 1))])
    reading = _Reading(source.text, limits)
    try:
        reading.run()
    except Stop as stop:
        reading.problems.append(stop.problem)
    except ERRORS as error:
        reading.problems.append(trouble(error, source.text))
    return Parsed(reading.documents, reading.problems)


class _Anchored(NamedTuple):
    """An anchored node, how many nodes it is, and how many collections deep, aliases expanded."""

    node: Node
    size: int
    depth: int


class _Reading:
    """One text while it is read. An anchor is None until its node is whole."""

    def __init__(self, text: str, limits: Limits) -> None:
        self.text = text
        self.limits = limits
        self.documents: list[Node] = []
        self.problems: list[Problem] = []
        self.anchors: dict[str, _Anchored | None] = {}

    def run(self) -> None:
        """Reads all events. This loop is where the time goes: one pass for every node, names local, nothing kept of an event.

        The collection that is open is `node`'s parent: `values` are its children, `keys` is None in a sequence, `key` waits for its
        value, `tail` is the end of its last child, `first` the count of nodes before it, `deep` the most collections that are in it.
        """
        text = self.text
        max_depth, max_count = self.limits.depth, self.limits.nodes
        get = events(readable(text))
        marked_texts = "!" in text
        anchors = self.anchors
        known = dict(WORDS)
        roots: list[Node] = []
        opened: list[tuple[Any, ...]] = []
        parent: Node | None = None
        values: Any = roots
        keys: dict[str, Node] | None = None
        key: Node | None = None
        name: str | None = None
        count = first = tail = deep = 0
        for event in iter(get, None):
            kind = type(event)
            if kind is ScalarEvent:
                start = event.start_mark.index
                tail = event.end_mark.index
                value = event.value
                style = event.style
                if style == '"' or style == "'":
                    node = Node("scalar", start, tail, value, NO_KEYS, value)
                elif style:
                    tail = _block_end(text, start, tail, value)
                    node = Node("scalar", start, tail, value, NO_KEYS, value)
                else:
                    try:
                        resolved = known[value]
                    except KeyError:
                        resolved = known[value] = resolve(value)
                    node = Node("scalar", start, tail, resolved, NO_KEYS, value, True)
                    if start == tail:
                        tail = _place_nothing(node, key, text)
                    elif marked_texts and text[start] in "!&":
                        self._bare(node)
                if event.tag is not None:
                    self._tagged(node, event.tag)
                if event.anchor is not None:
                    anchors[event.anchor] = _Anchored(node, 1, 0)
                count += 1
                if count > max_count:
                    raise _too_many(node, max_count)
                if keys is None:
                    values.append(node)
                elif key is None:
                    key = node
                elif (written := key.text) in values:
                    self._twice(key, keys[written])
                    key = None
                else:
                    values[written] = node
                    keys[written] = key
                    key = None
                continue
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                end = event.end_mark.index
                # The end mark of a block collection is at the next token, past blank lines and comments.
                if end > event.start_mark.index:
                    tail = end
                node = parent  # type: ignore[assignment]
                node.end = tail
                if keys is not None and "<<" in keys:
                    _merge(node)
                if name is not None:
                    anchors[name] = _Anchored(node, count - first, deep + 1)
                inner = deep + 1
                parent, values, keys, key, name, first, deep = opened.pop()
                if inner > deep:
                    deep = inner
                continue
            elif kind is MappingStartEvent or kind is SequenceStartEvent:
                start = event.start_mark.index
                if len(opened) >= max_depth:
                    raise Stop("MSAA906", f"nesting is deeper than the limit of {max_depth}", start, start + 1)
                if kind is MappingStartEvent:
                    node = Node("mapping", start, start, {}, {})
                else:
                    node = Node("sequence", start, start, [], NO_KEYS)
                tail = start
                if event.tag is not None:
                    self._tagged(node, event.tag)
                count += 1
            elif kind is AliasEvent:
                anchored = self._anchored(event)
                node = _alias(anchored.node, event)
                tail = node.end
                count += anchored.size
                if anchored.depth > deep:
                    deep = anchored.depth
                    if len(opened) + deep > max_depth:
                        message = f"nesting is deeper than the limit of {max_depth}, aliases expanded"
                        raise Stop("MSAA906", message, node.start, node.end)
            elif kind is DocumentEndEvent:
                root = roots.pop()
                if root.start < root.end or root.kind != "scalar":
                    self.documents.append(root)
                anchors.clear()
                deep = 0
                continue
            elif kind is StreamEndEvent:
                return
            else:
                continue
            if count > max_count:
                message = f"more nodes than the limit of {max_count}, aliases expanded"
                raise Stop("MSAA906", message, node.start, max(node.start + 1, min(node.end, node.start + 80)))
            if keys is None:
                values.append(node)
            elif key is None:
                if node.kind != "scalar":
                    raise Stop("MSAA903", f"a {node.kind} cannot be a key: a key is a scalar", node.start, node.start + 1)
                key = node
                continue
            else:
                written = key.text
                if written in values:
                    self._twice(key, keys[written])
                else:
                    values[written] = node
                    keys[written] = key
                key = None
            if kind is MappingStartEvent or kind is SequenceStartEvent:
                opened.append((parent, values, keys, key, name, first, deep))
                parent, values, key, name, first, deep = node, node.value, None, event.anchor, count - 1, 0
                keys = node.keys if kind is MappingStartEvent else None
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
            raise Stop("MSAA901", f"`{name[:80]}` holds itself", start, end)
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


def _alias(of: Node, event: Any) -> Node:
    start, end = event.start_mark.index, event.end_mark.index
    return Node(of.kind, start, end, of.value, of.keys, of.text, of.plain, of.anchor or of)


def _block_end(text: str, start: int, end: int, value: str) -> int:
    """The end of a block scalar, without the line ends and blank lines after it."""
    last = value.rstrip("\n")[-1:]
    return start + len(text[start:end].rstrip("\r\n" if last in (" ", "\t") else " \t\r\n"))


def _place_nothing(node: Node, key: Node | None, text: str) -> int:
    """Nothing, where a value is due, stands right after the `:` of its key; a parser's place may be beyond comments and line ends."""
    if key is not None:
        colon = _COLON.match(text, key.end)
        node.start = node.end = colon.end() if colon is not None else key.end
    return node.end


def _merge(node: Node) -> None:
    """`<<: *base` and `<<: [*one, *two]`: in its place stands what the bases have, the earlier before the later; what is stated beside
    it wins. The nodes are shared, and were counted where the bases were named.
    """
    merged, key = node.value["<<"], node.keys["<<"]
    if not key.plain:
        return
    bases = merged.value if merged.kind == "sequence" else [merged]
    for base in bases:
        if base.kind != "mapping":
            raise Stop("MSAA903", "`<<` merges a mapping, or a list of mappings", base.start, min(base.end, base.start + 80))
    stated, keys = dict(node.value), dict(node.keys)
    del stated["<<"], keys["<<"]
    own = list(node.value)
    node.value.clear()
    node.keys.clear()
    for name in own:
        if name != "<<":
            node.value.setdefault(name, stated[name])
            node.keys.setdefault(name, keys[name])
            continue
        for base in bases:
            for inherited, value in base.value.items():
                node.value.setdefault(inherited, stated.get(inherited, value))
                node.keys.setdefault(inherited, keys.get(inherited) or base.keys[inherited])


def _too_many(node: Node, limit: int) -> Stop:
    return Stop("MSAA906", f"more nodes than the limit of {limit}, aliases expanded", node.start, max(node.start + 1, min(node.end, node.start + 80)))
