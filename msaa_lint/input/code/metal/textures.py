"""Converts the textures of a program that calls Metal, with the sample counts that must be
assumed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, words
from msaa_lint.core.text.span import Span
from msaa_lint.frame.metal.names import ENUMS, MULTISAMPLE_TYPES
from msaa_lint.input.code.core.configurations import ASSUMED
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Struct, Symbol, Value, are_equal

from .configurations import Field, MetalConfiguration, constant_of, is_certain
from .creation import MetalInterpreter, options

Entry = tuple[str, Span, Node]
"""A member of a description with the location of its name."""

COUNTS = (1, 2, 4, 8, 16, 32, 64)

_STORAGE = frozenset(ENUMS["MTLStorageMode"])
_USAGES = frozenset(ENUMS["MTLTextureUsage"]) - {"unknown"}


class Names:
    """Unique names; equal names are qualified by their context."""

    def __init__(self) -> None:
        self.of: dict[int, str] = {}
        self.taken: set[str] = set()
        self.numbers: dict[str, int] = {}

    def assign(self, items: Sequence[tuple[object, str, str]]) -> None:
        """Assigns names to items by their own name and context."""
        often = Counter(name for _, name, _ in items)
        for item, name, context in items:
            unique = f"{context}.{name}" if often[name] > 1 and context else name
            while unique in self.taken:
                number = self.numbers[unique] = self.numbers.get(unique, 1) + 1
                candidate = f"{unique} {number}"
                if candidate not in self.taken:
                    unique = candidate
            self.taken.add(unique)
            self.of[id(item)] = unique


class Textures(MetalConfiguration):
    """The textures of a program."""

    def __init__(self, program: MetalInterpreter, defaults: bool) -> None:
        super().__init__(program)
        self.defaults = defaults
        """Whether members that are not set have their defaults."""
        self.named: dict[str, ApiObject] = {}
        """Textures of which only the name is known."""
        self.groups: dict[tuple[Any, ...], list[ApiObject]] = {}
        """The textures that are one, created again."""
        self.all: dict[int, ApiObject] = {}
        self.names = Names()
        self.attached: set[int] = set()
        self.resolved: dict[int, Span] = {}
        self.symbols: dict[str, int] = {}
        """The counts assumed for unknown values."""
        self.alike: dict[int, int] = {}
        """The counts taken from other attachments of the pass."""
        for obj in self.current_objects:
            if obj.kind == "texture":
                self.groups.setdefault(self.group_key(obj), []).append(obj)

    def group_key(self, obj: ApiObject) -> tuple[Any, ...]:
        several = constant_of(self.field(obj.info, "textureType")) in MULTISAMPLE_TYPES
        return (obj.name, several) if obj.name_depth == -1 else (id(obj),)

    def first(self, obj: ApiObject) -> ApiObject:
        """Returns the first texture that is the same as this one."""
        group = self.groups.get(self.group_key(obj))
        return group[0] if group else obj

    def texture(self, value: Value) -> ApiObject | object | None:
        """Returns the texture that a value is, None for nil, and UNKNOWN if it is not known; of an
        unknown one, the name may be.
        """
        settled = self.settle(value)
        if any(write.value is UNKNOWN for write in settled) or not is_certain(
            [write.guards for write in settled]
        ):
            return UNKNOWN
        if any(
            write.value is not None and not isinstance(write.value, (ApiObject, Symbol))
            for write in settled
        ):
            return UNKNOWN
        objects = {
            id(one): one
            for write in settled
            if isinstance(write.value, ApiObject)
            for one in (self.first(write.value),)
        }
        symbols = {
            write.value.key: write.value for write in settled if isinstance(write.value, Symbol)
        }
        if len(objects) == 1:
            return next(iter(objects.values()))
        several = [
            obj
            for obj in objects.values()
            if constant_of(self.field(obj.info, "textureType")) in MULTISAMPLE_TYPES
        ]
        if len(several) == 1:
            return several[0]
        if objects:
            keys = {
                text.rpartition("=")[0]
                for write in settled
                for text, _ in write.guards
                if "=" in text
            }
            key = keys.pop() if len(keys) == 1 else ""
            return (
                self.named_texture(key, key.rpartition("::")[2], settled[0].at) if key else UNKNOWN
            )
        if len(symbols) == 1:
            symbol = next(iter(symbols.values()))
            return self.named_texture(symbol.key, symbol.name, settled[0].at)
        return None if not symbols and all(write.value is None for write in settled) else UNKNOWN

    def named_texture(self, key: str, name: str, at: Span) -> ApiObject:
        if key not in self.named:
            self.named[key] = ApiObject("texture", (key,), at, Struct("", at))
            self.named[key].name = name or "texture"
        return self.named[key]

    def add(self, texture: ApiObject) -> None:
        self.all[id(texture)] = texture

    def name(self, texture: object) -> str:
        return self.names.of[id(texture)]

    def name_all(self) -> None:
        items = []
        for texture in self.all.values():
            context, _, name = texture.name.rpartition("::")
            items.append((texture, name.rpartition(".")[2] or "texture", context))
        self.names.assign(items)

    def assume_value(self, what: str, at: Span, value: str) -> None:
        name = " ".join(what.split())[:80]
        self.assumed.setdefault(name, (name, at, value))

    def member(self, texture: ApiObject, name: str) -> Field | None:
        """Returns a member on which all creations of a texture agree, or its default."""
        fields = []
        for obj in self.groups.get(self.group_key(texture), [texture]):
            field = self.field(obj.info, name)
            default = {"textureType": "type2D", "sampleCount": 1}.get(name)
            if field is None and default is not None and obj.info.zeroed:
                field = Field(default, obj.info.at, True)
            fields.append(field)
        first = fields[0]
        if all(
            field is not None and first is not None and are_equal(field.value, first.value)
            for field in fields
        ):
            return first
        known = next((field for field in fields if field is not None), None)
        return known._replace(value=UNKNOWN) if known is not None else None

    def add_pass(self, textures: Sequence[ApiObject]) -> None:
        """Records the textures of a pass. They all have the same sample count, so a count known for
        one applies to all.
        """
        counts = {self.stated_count(texture) for texture in textures} - {None}
        self.attached.update(map(id, textures))
        if len(counts) == 1:
            (count,) = counts
            for texture in textures:
                if count is not None and count > 1 and self.stated_count(texture) is None:
                    self.alike.setdefault(id(texture), count)

    def stated_count(self, texture: ApiObject) -> int | None:
        """Returns the sample count that the program states."""
        field = (
            self.shared("view", "sampleCount")
            if is_view_texture(texture)
            else self.member(texture, "sampleCount")
        )
        value = constant_of(field)
        return value if type(value) is int and value in COUNTS else None

    def members(self, texture: ApiObject) -> list[Entry]:
        """Returns the members of a texture."""
        if is_drawable(texture):
            return [("drawable", texture.at, scalar(True, texture.at)), *self.drawable_format()]
        if is_view_texture(texture):
            return self.view_members(texture)
        names = ("pixelFormat", "width", "height", "mipmapLevelCount", "arrayLength")
        entries = [entry for name in names for entry in plain(name, self.member(texture, name))]
        entries += self.count(texture) + _usage(self.member(texture, "usage"))
        # Passes in other files may need memory for a texture that no pass of this file uses.
        mode = self.storage(texture)
        if id(texture) in self.attached or constant_of(mode) == "memoryless":
            entries += word("storageMode", mode, _STORAGE)
        return entries

    def storage(self, texture: ApiObject) -> Field | None:
        """Returns the storage mode, which resource options contain."""
        mode, resource = (
            self.member(texture, "storageMode"),
            self.member(texture, "resourceOptions"),
        )
        if mode is not None or resource is None:
            return mode
        modes = [
            name
            for name in _STORAGE
            for word, _ in options(resource.value, resource.at) or ()
            if word.lower() == f"storagemode{name}"
        ]
        return Field(modes[0], resource.at) if modes else None

    def count(self, texture: ApiObject) -> list[Entry]:
        """Returns the texture type and the sample count; a count above 1 that is unknown is
        assumed.
        """
        kind, count = self.member(texture, "textureType"), self.member(texture, "sampleCount")
        number = constant_of(count)
        if kind is not None and kind.default and count is not None and not count.default:
            kind = kind._replace(at=count.at)
        if count is not None and count.default and kind is not None and not kind.default:
            count = count._replace(at=kind.at)
        entries: list[Entry] = []
        several = constant_of(kind) in MULTISAMPLE_TYPES
        if several and count is not None and count.default and not self.defaults:
            count, number = None, None
        type_name = constant_of(kind)
        if kind is not None and isinstance(type_name, str) and (number is not None or several):
            entries.append(("textureType", kind.at, scalar(type_name, kind.at)))
        if type(number) is int and number in COUNTS and count is not None:
            entries.append(("sampleCount", count.at, scalar(number, count.at)))
        elif number is None and (
            several or id(texture) in self.resolved or id(texture) in self.alike
        ):
            entries.append(self.assumed_entry(texture, count, kind))
        return entries

    def assumed_entry(self, texture: ApiObject, count: Field | None, kind: Field | None) -> Entry:
        """Returns a count taken from the pass's other textures, or the one that every device
        supports.
        """
        value = self.alike.get(id(texture), ASSUMED)
        known = id(texture) in self.alike
        if count is None:
            place = kind.at if kind is not None else self.resolved.get(id(texture), texture.at)
            if not known:
                self.assume_value(f"the sample count of `{self.name(texture)}`", place, str(value))
            return "sampleCount", place, scalar(value, place)
        if isinstance(count.value, Symbol):
            self.symbols.setdefault(count.value.key, value)
        if not known:
            name = count.value.name if isinstance(count.value, Symbol) else ""
            self.assume_value(
                f"`{name}`" if name else f"the sample count of `{self.name(texture)}`",
                count.at,
                str(value),
            )
        return "sampleCount", count.at, scalar(value, count.at)

    def drawable_format(self) -> list[Entry]:
        """Returns the pixel format of the drawable from its layer or view."""
        names = {"layer": "pixelFormat", "view": "colorPixelFormat"}
        fields = [
            field for kind, name in names.items() if (field := self.shared(kind, name)) is not None
        ]
        return (
            plain("pixelFormat", fields[0])
            if fields and all(are_equal(field.value, fields[0].value) for field in fields)
            else []
        )

    def shared(self, kind: str, name: str) -> Field | None:
        """Returns a member of the program's view or layer."""
        instance = self.program.instances.get((kind,))
        if instance is None:
            return None
        return self.field(self.program.snapshot(instance, frozenset()), name)

    def view_members(self, texture: ApiObject) -> list[Entry]:
        """Returns what is known of a texture that MTKView creates."""
        color = texture.name == "multisampleColorTexture"
        entries = plain(
            "pixelFormat",
            self.shared("view", "colorPixelFormat" if color else "depthStencilPixelFormat"),
        )
        count = self.shared("view", "sampleCount")
        if count is not None and constant_of(count) in COUNTS[1:]:
            entries.append(("textureType", count.at, scalar("type2DMultisample", count.at)))
            entries += plain("sampleCount", count)
        return entries


def is_drawable(texture: ApiObject) -> bool:
    return texture.key == ("drawable texture",)


def is_view_texture(texture: ApiObject) -> bool:
    return bool(texture.key[0] == "view texture")


def word(name: str, field: Field | None, allowed: frozenset[str]) -> list[Entry]:
    """Returns a member that has one of some values, or nothing."""
    value = constant_of(field)
    return (
        [(name, field.at, scalar(value, field.at))]
        if field is not None and isinstance(value, str) and value in allowed
        else []
    )


def plain(name: str, field: Field | None) -> list[Entry]:
    """Returns a member that is a positive number, a boolean, or a word, or nothing."""
    value = constant_of(field)
    if field is None or value is None:
        return []
    usable = (
        value.isidentifier()
        if isinstance(value, str)
        else isinstance(value, bool) or 0 < value < 1 << 31
    )
    return [(name, field.at, scalar(value, field.at))] if usable else []


def section(name: str, entries: list[Entry]) -> list[Entry]:
    """Returns a mapping of some entries at the place of the first, or nothing without entries."""
    return [(name, entries[0][1], mapping(entries, entries[0][1]))] if entries else []


def _usage(field: Field | None) -> list[Entry]:
    """Returns the stated usage, or nothing. `unknown` is 0, and alone it allows every usage."""
    bits = options(field.value, field.at) if field is not None else None
    named = [name for name in dict.fromkeys(name for name, _ in bits or ()) if name != "unknown"]
    return (
        [("usage", field.at, words(named, field.at))]
        if field is not None and named and _USAGES.issuperset(named)
        else []
    )
