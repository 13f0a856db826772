"""Converts the textures of a Swift file, with the sample counts that must be assumed."""

from __future__ import annotations

from msaa_lint.core.text.node_builder import scalar
from msaa_lint.core.text.span import Span

from .entries import COUNTS, Entry, Names, plain, type_of, usage, word
from .interpreter import Interpreter
from .values import MULTISAMPLED_TYPES, Constant, Field, MetalObject, Symbol, Texture, join_fields

ASSUMED_COUNT = 4
"""The only count above 1 that every device supports (Apple's documentation of supportsTextureSampleCount)."""

_STORAGE = frozenset({"shared", "managed", "private", "memoryless"})


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
            several = [fields for fields in texture.made if type_of(fields) in MULTISAMPLED_TYPES]
            common = {}
            for index, texture_fields in enumerate(several or texture.made):
                common = texture_fields if index == 0 else join_fields(common, texture_fields)
            self.given[id(texture)] = common
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
        count = fields.get("sampleCount")
        value = count.value.value if count is not None and isinstance(count.value, Constant) else None
        return value if type(value) is int and value in COUNTS else None

    def members(self, texture: Texture) -> list[Entry]:
        """Returns the members of a texture."""
        if texture.drawable:
            return [("drawable", texture.at, scalar(True, texture.at)), *self.drawable_format()]
        if texture.owner is not None:
            return self.view_members(texture, texture.owner)
        fields = self.fields(texture)
        entries: list[Entry] = []
        for name in ("pixelFormat", "width", "height", "mipmapLevelCount", "arrayLength"):
            if name in fields:
                entries.extend(plain(name, fields[name]))
        entries.extend(self.count(texture, fields))
        if "usage" in fields:
            entries.extend(usage(fields["usage"]))
        # Passes in other files may need memory for a texture that no pass of this file uses.
        if "storageMode" in fields and (id(texture) in self.attached or fields["storageMode"].value == Constant("memoryless")):
            entries.extend(word("storageMode", fields["storageMode"], _STORAGE))
        return entries

    def count(self, texture: Texture, fields: dict[str, Field]) -> list[Entry]:
        """Returns the texture type and the sample count; a count above 1 that is unknown is assumed."""
        kind, count = fields.get("textureType"), fields.get("sampleCount")
        number = count.value.value if count is not None and isinstance(count.value, Constant) else None
        if kind is not None and kind.default and count is not None and not count.default:
            kind = kind._replace(key=count.key, at=count.at)
        if count is not None and count.default and kind is not None and not kind.default:
            count = count._replace(key=kind.key, at=kind.at)
        entries: list[Entry] = []
        several = type_of(fields) in MULTISAMPLED_TYPES
        if several and count is not None and count.default and not self.defaults:
            count, number = None, None
        if kind is not None and isinstance(kind.value, Constant) and isinstance(kind.value.value, str) and (number is not None or several):
            entries.append(("textureType", kind.key, scalar(kind.value.value, kind.at)))
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
        fields = [
            field
            for item in self.interpreter.objects.values()
            for name in {"layer": ("pixelFormat",), "view": ("colorPixelFormat",)}.get(item.kind, ())
            if (field := self.interpreter.field(item, name)) is not None
        ]
        return plain("pixelFormat", fields[0]) if fields and all(entry.value == fields[0].value for entry in fields) else []

    def view_members(self, texture: Texture, view: MetalObject) -> list[Entry]:
        """Returns what is known of a texture that MTKView creates."""
        fields = self.interpreter.snapshot(view)
        entries: list[Entry] = []
        pixels = fields.get("colorPixelFormat" if texture.name == "multisampleColorTexture" else "depthStencilPixelFormat")
        if pixels is not None:
            entries.extend(plain("pixelFormat", pixels))
        count = fields.get("sampleCount")
        if count is None:
            return entries
        if isinstance(count.value, Constant) and count.value.value in COUNTS and count.value.value != 1:
            entries.append(("textureType", count.key, scalar("type2DMultisample", count.at)))
            entries.append(("sampleCount", count.key, scalar(count.value.value, count.at)))
        return entries
