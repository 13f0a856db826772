"""Text to a tree whose every node knows its place, from libyaml's events.

Events and not PyYAML's composer, which recurses in C and crashes the interpreter on 100 kB of `[`; nothing here recurses. JSON, with the
trailing commas that real tools write, is read by the same path. Without libyaml the pure Python parser gives the same events, slower.
"""

from __future__ import annotations

import os
import re
import stat
from typing import Any, NamedTuple

from yaml.error import MarkedYAMLError, YAMLError
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
from .scalars import resolve
from .text import Source, Unreadable, forbidden


class Limits(NamedTuple):
    """How deep an input nests, how many nodes it has once aliases are expanded, how many bytes."""

    depth: int = 100
    nodes: int = 1_000_000
    bytes: int = 64 << 20


class Problem(NamedTuple):
    """What is wrong with a text as such: the code of a 9xx finding, and where."""

    code: str
    message: str
    span: Span
    labels: tuple[Label, ...] = ()


class Parsed(NamedTuple):
    """The documents of a text, whole ones only, and what is wrong with it. After a syntax error nothing further is read."""

    documents: list[Node]
    problems: list[Problem]


class Node:
    """A mapping, a sequence or a scalar, and its place as offsets into the text.

    `value` is a dict of nodes in order, a list of nodes, or the scalar by YAML 1.2; `keys` has the key nodes of a mapping; `text` a
    scalar as it was written, unquoted; `plain` says that it had no quotes. An alias is a node at its own place that shares the value of
    `anchor`.
    """

    __slots__ = ("anchor", "end", "keys", "kind", "plain", "start", "text", "value")

    value: Any

    def __init__(
        self,
        kind: str,
        start: int,
        end: int,
        value: Any,
        keys: dict[str, Node],
        text: str = "",
        plain: bool = False,
        anchor: Node | None = None,
    ) -> None:
        self.kind = kind
        self.start = start
        self.end = end
        self.value = value
        self.keys = keys
        self.text = text
        self.plain = plain
        self.anchor = anchor

    @property
    def span(self) -> Span:
        return Span(self.start, self.end)


def read(path: str, limits: Limits) -> bytes:
    """The bytes of a file. OSError where it cannot be read or is no file; Unreadable where it is larger than the limit."""
    if not stat.S_ISREG(os.stat(path).st_mode):
        raise OSError("it is no regular file")
    with open(path, "rb") as file:
        data = file.read(limits.bytes + 1)
    if len(data) > limits.bytes:
        raise Unreadable(f"the input is larger than the limit of {limits.bytes} bytes")
    return data


def parse(source: Source, limits: Limits) -> Parsed:
    """The documents of a text."""
    at = forbidden(source.text)
    if at is not None:
        message = f"the character U+{ord(source.text[at]):04X} may not stand in YAML or JSON"
        return Parsed([], [Problem("MSAA901", message, Span(at, at + 1))])
    return _Parse(source.text, limits).run()


def _parser(text: str) -> Any:
    try:
        from yaml._yaml import CParser
    except ImportError:
        from .pure import PureParser

        return PureParser(text)
    return CParser(text)


class _Stop(Exception):
    """Ends the parse with a problem."""

    def __init__(self, code: str, message: str, start: int, end: int) -> None:
        self.problem = Problem(code, message, Span(start, max(end, start)))


MAX_TWICE = 50
"""Duplicate keys that are told of one text."""

_PLAIN = (None, "")
_BLOCK = ("|", ">")
_NO_KEYS: dict[str, Node] = {}
_CORE = {"str", "int", "float", "bool", "null", "map", "seq"}
_PREFIX = "tag:yaml.org,2002:"


class _Open:
    """A collection whose end is still to come: what it holds so far, aliases expanded, and the key that waits for its value."""

    __slots__ = ("anchor", "depth", "key", "node", "size")

    def __init__(self, node: Node, anchor: str | None) -> None:
        self.node = node
        self.anchor = anchor
        self.size = 1
        self.depth = 1
        self.key: Node | None = None


class _Anchored(NamedTuple):
    """An anchored node, how many nodes it is, and how deep it nests, aliases expanded."""

    node: Node
    size: int
    depth: int


class _Parse:
    def __init__(self, text: str, limits: Limits) -> None:
        self.text = text
        self.limits = limits
        self.documents: list[Node] = []
        self.problems: list[Problem] = []
        self.anchors: dict[str, _Anchored | None] = {}
        self.merged = 0
        self.surrogates = False

    def run(self) -> Parsed:
        try:
            self._events()
        except _Stop as stop:
            self.problems.append(stop.problem)
        except MarkedYAMLError as error:
            mark = error.problem_mark or error.context_mark
            start = min(mark.index, len(self.text)) if mark is not None else 0
            said = " ".join(part for part in (error.context, error.problem) if part)
            self.problems.append(Problem("MSAA901", said or "this cannot be read", Span(start, min(start + 1, len(self.text)))))
        except (YAMLError, ValueError) as error:
            self.problems.append(Problem("MSAA901", f"this cannot be read: {str(error).splitlines()[0][:200]}", Span(0, 0)))
        return Parsed(self.documents, self.problems)

    def _events(self) -> None:
        text, self.surrogates = _same_length(self.text)
        get = _parser(text).get_event
        depth_limit, node_limit = self.limits.depth, self.limits.nodes
        stack: list[_Open] = []
        top: _Open | None = None
        while True:
            event = get()
            kind = type(event)
            size = depth = 1
            if kind is ScalarEvent:
                text = event.value if not self.surrogates else self._joined(event)
                if event.style not in _PLAIN or not event.implicit[0]:
                    node = Node("scalar", event.start_mark.index, event.end_mark.index, text, _NO_KEYS, text)
                    if event.style in _BLOCK:
                        node.end = node.start + len(self.text[node.start : node.end].rstrip())
                else:
                    node = Node("scalar", event.start_mark.index, event.end_mark.index, resolve(text), _NO_KEYS, text, True)
                if event.tag is not None:
                    self._tagged(node, event.tag)
                name = event.anchor
            elif kind is MappingStartEvent or kind is SequenceStartEvent:
                start = event.start_mark.index
                if len(stack) >= depth_limit:
                    raise _Stop("MSAA906", f"nesting is deeper than the limit of {depth_limit}", start, start + 1)
                if kind is MappingStartEvent:
                    node = Node("mapping", start, event.end_mark.index, {}, {})
                else:
                    node = Node("sequence", start, event.end_mark.index, [], _NO_KEYS)
                if event.tag is not None:
                    self._tagged(node, event.tag)
                if event.anchor is not None:
                    self.anchors[event.anchor] = None
                top = _Open(node, event.anchor)
                stack.append(top)
                continue
            elif kind is MappingEndEvent or kind is SequenceEndEvent:
                done = stack.pop()
                node, name, size, depth = done.node, done.anchor, done.size, done.depth
                top = stack[-1] if stack else None
                # A block collection's end mark is at the next token, past blank lines and comments.
                end = event.end_mark.index
                node.end = end if end > event.start_mark.index else _end_of(node)
                if "<<" in node.keys:
                    size += self._merge(node)
            elif kind is AliasEvent:
                anchored = self._alias(event)
                node, size, depth = anchored
                name = None
            elif kind is StreamEndEvent:
                return
            elif kind is DocumentEndEvent:
                self.anchors.clear()
                continue
            else:
                continue
            if name is not None:
                self.anchors[name] = _Anchored(node, size, depth)
            if top is None:
                if size > node_limit:
                    raise self._too_many(node)
                if not (node.kind == "scalar" and node.plain and node.text == ""):
                    self.documents.append(node)
                continue
            parent = top.node
            if parent.kind == "sequence":
                parent.value.append(node)
            elif top.key is None:
                if node.kind != "scalar":
                    raise _Stop("MSAA901", "a key is a scalar", node.start, min(node.end, node.start + 1))
                top.key = node
                continue
            else:
                key = top.key
                top.key = None
                if key.text in parent.value:
                    self._twice(parent, key)
                else:
                    parent.value[key.text] = node
                    parent.keys[key.text] = key
            top.size += size
            if depth >= top.depth:
                top.depth = depth + 1
                if len(stack) + depth > depth_limit + 1:
                    raise _Stop("MSAA906", f"nesting is deeper than the limit of {depth_limit}, aliases expanded", node.start, node.end)
            if top.size > node_limit:
                raise self._too_many(node)

    def _joined(self, event: Any) -> str:
        """A scalar with the stand-ins for surrogates put together to the characters that they mean."""
        text: str = event.value
        if not _STAND_IN.search(text):
            return text
        halves = _STAND_IN.sub(lambda m: chr(ord(m[0]) - 0xE800 + 0xD800), text)
        try:
            return halves.encode("utf-16-le", "surrogatepass").decode("utf-16-le")
        except UnicodeDecodeError:
            raise _Stop("MSAA901", "half of a surrogate pair is no character", event.start_mark.index, event.end_mark.index) from None

    def _too_many(self, node: Node) -> _Stop:
        return _Stop(
            "MSAA906", f"more nodes than the limit of {self.limits.nodes}, aliases expanded", node.start, min(node.end, node.start + 1)
        )

    def _twice(self, parent: Node, key: Node) -> None:
        """The first of two equal keys is kept."""
        shown = key.text if len(key.text) <= 80 else key.text[:79] + "…"
        if len(self.problems) < MAX_TWICE:
            labels = (Label(parent.keys[key.text].span, "first here"),)
            self.problems.append(Problem("MSAA905", f"the key `{shown}` stands here twice", key.span, labels))

    def _alias(self, event: Any) -> _Anchored:
        start, end = event.start_mark.index, event.end_mark.index
        if event.anchor not in self.anchors:
            raise _Stop("MSAA901", f"no anchor `{event.anchor[:80]}` stands before this alias", start, end)
        anchored = self.anchors[event.anchor]
        if anchored is None:
            raise _Stop("MSAA901", f"`{event.anchor[:80]}` holds itself", start, end)
        of = anchored.node
        return anchored._replace(node=Node(of.kind, start, end, of.value, of.keys, of.text, of.plain, of.anchor or of))

    def _merge(self, node: Node) -> int:
        """`<<: *base` and `<<: [*one, *two]`: what is stated here wins, then the earlier base. The nodes are shared. How many came."""
        merged, key = node.value["<<"], node.keys["<<"]
        if not key.plain:
            return 0
        bases = merged.value if merged.kind == "sequence" else [merged]
        for base in bases:
            if base.kind != "mapping":
                raise _Stop("MSAA903", "a mapping, or a list of mappings, is merged", base.start, base.end)
        del node.value["<<"], node.keys["<<"]
        before = len(node.value)
        for base in bases:
            self.merged += len(base.value)
            if self.merged > self.limits.nodes:
                raise self._too_many(node)
            for name, value in base.value.items():
                if name not in node.value:
                    node.value[name] = value
                    node.keys[name] = base.keys[name]
        return len(node.value) - before

    def _tagged(self, node: Node, tag: str) -> None:
        """Core tags are taken where they agree; every other is refused."""
        core = tag.removeprefix(_PREFIX)
        if tag == "!" and node.kind == "scalar":
            node.value, node.plain = node.text, False
            return
        if core == tag or core not in _CORE:
            raise _Stop("MSAA903", f"the tag {tag[:80]} is not taken here", node.start, node.end)
        if node.kind != "scalar":
            agrees = core == ("map" if node.kind == "mapping" else "seq")
        elif core == "str":
            node.value, node.plain, agrees = node.text, False, True
        else:
            value = node.value = resolve(node.text)
            if core == "float" and isinstance(value, int) and not isinstance(value, bool):
                value = node.value = float(value)
            kinds = {"int": int, "float": float, "bool": bool, "null": type(None)}
            agrees = type(value) is kinds.get(core)
        if not agrees:
            raise _Stop("MSAA903", f"the tag !!{core} does not agree with what it stands at", node.start, node.end)


def _end_of(node: Node) -> int:
    """The end of the last child; the start of an empty block collection."""
    if node.kind == "mapping":
        last = next(reversed(node.value.values()), None)
        key = next(reversed(node.keys.values()), None)
        ends = [n.end for n in (last, key) if n is not None]
        return max(ends) if ends else node.start
    return node.value[-1].end if node.value else node.start


_JSON_SURROGATE = re.compile(r"\\(?:\\|u[dD]([89a-fA-F][0-9a-fA-F]{2}))")
_STAND_IN = re.compile("[\ue800-\uefff]")
_STAND_IN_ESCAPE = re.compile(r"\\u[eE][89a-fA-F]")


def _same_length(text: str) -> tuple[str, bool]:
    """What JSON writes and YAML does not, at the same offsets: tabs as indentation, and characters as two escaped surrogates.

    Such an escape is written as one for a private character (\\uD83D as \\uE83D), to be put together again in the scalar, unless the text
    has such characters of its own.
    """
    if text.lstrip()[:1] not in ("{", "["):
        return text, False
    text = text.replace("\t", " ")
    if "\\u" not in text or _STAND_IN.search(text) or _STAND_IN_ESCAPE.search(text):
        return text, False
    made, count = _JSON_SURROGATE.subn(lambda m: m[0] if m[1] is None else f"\\uE{m[1]}", text)
    return made, count > 0 and made != text
