"""Converts the textures of a Swift file, with the sample counts that must be assumed."""

from __future__ import annotations

from collections import Counter
from functools import reduce

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, words
from msaa_lint.core.text.span import Span

from .interpreter import Interpreter
from .values import MULTISAMPLED_TYPES, Field, MetalObject, Symbol, Texture, constant_of, join_fields, options

Entry = tuple[str, Span, Node]
"""A member of a description with the location of its name."""

COUNTS = (1, 2, 4, 8, 16, 32, 64)
ASSUMED_COUNT = 4
"""The only count above 1 that every device supports (Apple's documentation of supportsTextureSampleCount)."""

_STORAGE = frozenset({"shared", "managed", "private", "memoryless"})
_USAGES = frozenset({"renderTarget", "shaderRead", "shaderWrite", "pixelFormatView", "shaderAtomic"})


class Names:
    """Unique names; equal names are qualified by their context."""

    def __init__(self) -> None:
        self.of: dict[int, str] = {}
        self.taken: set[str] = set()
        self.numbers: dict[str, int] = {}

    def assign(self, items: list[tuple[object, str, str]]) -> None:
        """Assigns names to items by their own name and context."""
        often = Counter(name for _, name, _ in items)
        for item, name, type_name in items:
            unique = f"{type_name}.{name}" if often[name] > 1 and type_name else name
            while unique in self.taken:
                number = self.numbers[unique] = self.numbers.get(unique, 1) + 1
                candidate = f"{unique} {number}"
                if candidate not in self.taken:
                    unique = candidate
            self.taken.add(unique)
            self.of[id(item)] = unique


class Textures:
    """The textures of a file.

    `assumed` are unknown values with their locations and the values assumed; `symbols` the counts assumed for symbols; `attached` the
    textures that passes draw to, `resolved` those that they resolve; `alike` the counts taken from other attachments of the pass.
    """

    def __init__(self, interpreter: Interpreter, defaults: bool) -> None:
        self.interpreter = interpreter
        self.defaults = defaults
        self.all: dict[int, Texture] = {}
        self.names = Names()
        self.attached: set[int] = set()
        self.resolved: dict[int, Span] = {}
        self.symbols: dict[Symbol, int] = {}
        self.given: dict[int, dict[str, Field]] = {}
        self.alike: dict[int, int] = {}
        self.assumed: dict[str, tuple[Span, str]] = {}

    def add(self, texture: Texture) -> None:
        self.all[id(texture)] = texture

    def name(self, texture: object) -> str:
        return self.names.of[id(texture)]

    def assume(self, what: str, at: Span, value: str) -> None:
        self.assumed.setdefault(" ".join(what.split())[:80], (at, value))

    def fields(self, texture: Texture) -> dict[str, Field]:
        """Returns the members on which all creations of a texture agree; of those, only the multisampled ones if there are any."""
        common = self.given.get(id(texture))
        if common is None:
            several = [fields for fields in texture.made if constant_of(fields.get("textureType")) in MULTISAMPLED_TYPES]
            made = several or texture.made
            common = self.given[id(texture)] = reduce(join_fields, made) if made else {}
        return common

    def add_pass(self, textures: list[Texture]) -> None:
        """Records the textures of a pass. They all have the same sample count, so a count known for one applies to all."""
        counts = {self.stated_count(texture) for texture in textures} - {None}
        self.attached.update(map(id, textures))
        if len(counts) == 1:
            (count,) = counts
            for texture in textures:
                if count is not None and count > 1 and self.stated_count(texture) is None:
                    self.alike.setdefault(id(texture), count)

    def stated_count(self, texture: Texture) -> int | None:
        """Returns the sample count that the file states."""
        fields = self.fields(texture) if texture.owner is None else self.interpreter.snapshot(texture.owner)
        value = constant_of(fields.get("sampleCount"))
        return value if type(value) is int and value in COUNTS else None

    def members(self, texture: Texture) -> list[Entry]:
        """Returns the members of a texture."""
        if texture.drawable:
            return [("drawable", texture.at, scalar(True, texture.at)), *self.drawable_format()]
        if texture.owner is not None:
            return self.view_members(texture, texture.owner)
        fields = self.fields(texture)
        names = ("pixelFormat", "width", "height", "mipmapLevelCount", "arrayLength")
        entries = [entry for name in names for entry in plain(name, fields.get(name))]
        entries += self.count(texture, fields) + _usage(fields.get("usage"))
        # Passes in other files may need memory for a texture that no pass of this file uses.
        mode = fields.get("storageMode")
        if id(texture) in self.attached or constant_of(mode) == "memoryless":
            entries += word("storageMode", mode, _STORAGE)
        return entries

    def count(self, texture: Texture, fields: dict[str, Field]) -> list[Entry]:
        """Returns the texture type and the sample count; a count above 1 that is unknown is assumed."""
        kind, count = fields.get("textureType"), fields.get("sampleCount")
        number = constant_of(count)
        if kind is not None and kind.default and count is not None and not count.default:
            kind = kind._replace(key=count.key, at=count.at)
        if count is not None and count.default and kind is not None and not kind.default:
            count = count._replace(key=kind.key, at=kind.at)
        entries: list[Entry] = []
        several = constant_of(kind) in MULTISAMPLED_TYPES
        if several and count is not None and count.default and not self.defaults:
            count, number = None, None
        type_name = constant_of(kind)
        if kind is not None and isinstance(type_name, str) and (number is not None or several):
            entries.append(("textureType", kind.key, scalar(type_name, kind.at)))
        if type(number) is int and number in COUNTS and count is not None:
            entries.append(("sampleCount", count.key, scalar(number, count.at)))
        elif number is None and (several or id(texture) in self.resolved or id(texture) in self.alike):
            entries.append(self.assumed_count(texture, count, kind))
        return entries

    def assumed_count(self, texture: Texture, count: Field | None, kind: Field | None) -> Entry:
        """Returns a count taken from the pass's other textures, or the one that every device supports."""
        value = self.alike.get(id(texture), ASSUMED_COUNT)
        if count is None:
            place = kind.at if kind is not None else self.resolved.get(id(texture), texture.at)
            if id(texture) not in self.alike:
                self.assume(f"the sample count of `{self.name(texture)}`", place, str(value))
            return "sampleCount", place, scalar(value, place)
        if isinstance(count.value, Symbol):
            self.symbols.setdefault(count.value, value)
        if id(texture) not in self.alike:
            self.assume(f"`{self.interpreter.text[count.at.start : count.at.end]}`", count.at, str(value))
        return "sampleCount", count.key, scalar(value, count.at)

    def drawable_format(self) -> list[Entry]:
        """Returns the pixel format of the drawable from its layer or view."""
        names = {"layer": "pixelFormat", "view": "colorPixelFormat"}
        objects = [item for item in self.interpreter.objects.values() if item.kind in names]
        fields = [field for item in objects if (field := self.interpreter.field(item, names[item.kind])) is not None]
        return plain("pixelFormat", fields[0]) if fields and all(entry.value == fields[0].value for entry in fields) else []

    def view_members(self, texture: Texture, view: MetalObject) -> list[Entry]:
        """Returns what is known of a texture that MTKView creates."""
        fields = self.interpreter.snapshot(view)
        pixels = fields.get("colorPixelFormat" if texture.name == "multisampleColorTexture" else "depthStencilPixelFormat")
        entries = plain("pixelFormat", pixels)
        count = fields.get("sampleCount")
        if count is not None and constant_of(count) in COUNTS[1:]:
            entries.append(("textureType", count.key, scalar("type2DMultisample", count.at)))
            entries += plain("sampleCount", count)
        return entries


def word(name: str, field: Field | None, allowed: frozenset[str]) -> list[Entry]:
    """Returns a member that has one of some values, or nothing."""
    value = constant_of(field)
    return [(name, field.key, scalar(value, field.at))] if field is not None and isinstance(value, str) and value in allowed else []


def plain(name: str, field: Field | None) -> list[Entry]:
    """Returns a member that is a positive number, a boolean, or a word, or nothing."""
    value = constant_of(field)
    if field is None or not isinstance(value, (str, bool, int)):
        return []
    usable = value.isidentifier() if isinstance(value, str) else isinstance(value, bool) or 0 < value < 1 << 31
    return [(name, field.key, scalar(value, field.at))] if usable else []


def section(name: str, entries: list[Entry]) -> list[Entry]:
    """Returns a mapping of some entries at the place of the first, or nothing without entries."""
    return [(name, entries[0][1], mapping(entries, entries[0][1]))] if entries else []


def _usage(field: Field | None) -> list[Entry]:
    """Returns the stated usage, or nothing. `unknown` is 0, and alone it allows every usage."""
    value = constant_of(field)
    named = [word for word in dict.fromkeys(options(value) if isinstance(value, (str, tuple)) else ()) if word != "unknown"]
    return [("usage", field.key, words(named, field.at))] if field is not None and named and _USAGES.issuperset(named) else []
