"""The elements of a RenderDoc chunk in the layout that RenderDoc writes, by regular expression:
five times as fast as an XML parser.

Text of another shape is left to the XML parser: entities, comments, processing instructions, and
whatever is not well-formed.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

MAX_SIZE = 1 << 20
"""Maximum size of a chunk in bytes that is parsed here."""

MAX_DEPTH = 100

MAX_CACHED_TAGS = 1 << 14
"""Maximum number of cached attribute lists."""

MAX_CACHED_TAG = 1 << 10  # bytes

CHUNK = re.compile(rb'[ \t]*+<chunk((?: [A-Za-z]++="[^"<>&\0-\x1f]*+")++)>\r?\n')
"""The line that starts a chunk."""

NAME = re.compile(rb' name="([^"]*+)"')
"""The name in the attributes of a chunk."""

END = re.compile(rb"</chunk>\r?\n")

_ELEMENT = re.compile(rb"<(/?[A-Za-z]++)([^<>]*+)>([^<>]*+)")
_ATTRIBUTES = re.compile(rb'((?: [A-Za-z]++="[^"<>&\0-\x1f]*+")*+)( ?/)?')
_ATTRIBUTE = re.compile(r' ([A-Za-z]+)="([^"]*)"')

VALUES: dict[str, Callable[[str], Any]] = {
    "uint": int,
    "int": int,
    "enum": int,
    "ResourceId": int,
    "buffer": int,
    "float": float,
    "bool": {"true": True, "false": False}.__getitem__,
    "string": str,
    "char": str,
    "null": lambda text: None,
}
"""The elements that hold a value, with their parsers."""

BUFFERS = ("pCode", "pData")
SPECIAL = frozenset(
    {"sType", "pNextType", "pSampleMask", "DebugMessages", "BakedCommandBuffer", *BUFFERS}
)
"""Members that `special_value` converts."""

Attributes = list[str]
"""Names and values in turns, as expat has them."""


class Unusual(Exception):
    """The text is not as RenderDoc writes it."""


class ElementParser:
    """Parses the elements of chunks. `special` converts members in SPECIAL, and returns SPECIAL
    itself for those that C does not have.
    """

    def __init__(self, special: Callable[[str, Any, Attributes], Any]) -> None:
        self.values = {
            tag.encode(): parser if parser is not str else _printable
            for tag, parser in VALUES.items()
        }
        self.special = special
        self.tags: dict[bytes, tuple[str | None, Attributes, bool]] = {}

    def parse(self, text: bytes) -> dict[str, Any]:
        """The members of a chunk by name, from the text between its tags. Raises Unusual."""
        elements = _ELEMENT.findall(text)
        if (
            len(elements) != text.count(b"<")
            or len(elements) != text.count(b">")
            or b"&" in text
            or not text.isascii()
        ):
            raise Unusual
        arguments: dict[str, Any] = {}
        container: Any = arguments
        outer: list[tuple[Any, bytes, str | None]] = []
        values, find_tag = self.values, self.tags.get
        expected = b""
        """The tag that must end now."""
        for tag, attribute_text, content in elements:
            if expected:
                if tag != expected or attribute_text or not content.isspace():
                    raise Unusual
                expected = b""
                continue
            value_of = values.get(tag)
            if value_of is not None:
                name, attributes, is_empty = find_tag(attribute_text) or self.tag(attribute_text)
                if is_empty:
                    if content and not content.isspace():
                        raise Unusual
                    content = b""
                else:
                    expected = b"/" + tag
                try:
                    value = value_of(content.decode("ascii"))
                except (ValueError, OverflowError, KeyError):
                    raise Unusual from None
            elif content and not content.isspace():
                raise Unusual
            elif tag in (b"struct", b"array"):
                name, attributes, is_empty = find_tag(attribute_text) or self.tag(attribute_text)
                value = [] if tag == b"array" else {}
                if not is_empty:
                    if len(outer) >= MAX_DEPTH - 1 or name in SPECIAL:
                        raise Unusual
                    outer.append((container, b"/" + tag, name))
                    container = value
                    continue
            else:
                if not outer or attribute_text:
                    raise Unusual
                value = container
                container, opened, name = outer.pop()
                if tag != opened:
                    raise Unusual
                attributes = []
            if type(container) is list:
                container.append(value)
            elif name is not None:
                if name in SPECIAL:
                    value = self.special(name, value, attributes)
                    if value is SPECIAL:
                        continue
                container[name] = value
        if outer or expected:
            raise Unusual
        return arguments

    def tag(self, text: bytes) -> tuple[str | None, Attributes, bool]:
        """The name of an element, its attributes, and whether it is empty."""
        match = _ATTRIBUTES.fullmatch(text)
        if match is None:
            raise Unusual
        pairs = _ATTRIBUTE.findall(match[1].decode("ascii"))
        keys = [key for key, _ in pairs]
        if len(set(keys)) != len(keys):
            raise Unusual
        tag = (
            next((value for key, value in pairs if key == "name"), None),
            [part for pair in pairs for part in pair],
            match[2] is not None,
        )
        if len(self.tags) < MAX_CACHED_TAGS and len(text) <= MAX_CACHED_TAG:
            self.tags[text] = tag
        return tag


def _printable(text: str) -> str:
    """The text of a string. Raises ValueError for control characters: XML has no others than line
    ends, which a parser converts.
    """
    if not text.isprintable():
        raise ValueError
    return text
