"""Writes the section `metal` of a description from a program; each member has its location in the
source.
"""

from __future__ import annotations

from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.metal.names import ENUMS, MULTISAMPLE_RESOLVES
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Flags, Struct, Symbol, sole_value
from msaa_lint.input.code.parsing import Read

from .configurations import constant_of
from .creation import MetalInterpreter
from .objects import CREATED, Encoded
from .textures import COUNTS, Entry, Names, Textures, is_drawable, plain, section, word

_LOADS = frozenset(ENUMS["MTLLoadAction"])
_STORES = frozenset(ENUMS["MTLStoreAction"])
_FILTERS = {
    "depthResolveFilter": frozenset(ENUMS["MTLMultisampleDepthResolveFilter"]),
    "stencilResolveFilter": frozenset(ENUMS["MTLMultisampleStencilResolveFilter"]),
}
_DEFAULTS = {
    "color": ("dontCare", "store"),
    "depth": ("clear", "dontCare"),
    "stencil": ("clear", "dontCare"),
}
"""The default load and store actions of attachments (Apple's documentation of loadAction and
storeAction).
"""

_SWITCHES = ("isAlphaToCoverageEnabled", "isAlphaToOneEnabled", "isRasterizationEnabled")


class DescriptionWriter(Textures):
    """Writes the description of one program. `platform` is where it states that it runs on Apple
    GPUs alone.
    """

    def __init__(self, program: MetalInterpreter, defaults: bool, platform: Span | None) -> None:
        super().__init__(program, defaults)
        self.platform = platform
        self.maybe_loaded: set[int] = set()
        self.equal_passes: dict[int, ApiObject] = {}
        """The pass that stands for each pass that is encoded, by its id."""

    def read(self, whole: Span) -> Read | None:
        """Returns the description, or None if the program does not use Metal multisampling."""
        passes = [(obj, used) for obj in self.passes() if (used := self.used(obj))]
        for group in self.groups.values():
            self.add(group[0])
        steps = [
            step._replace(what=tuple(self.known(item) for item in step.what))
            for step in self.program.encoded
        ]
        mentioned = set(self.attached)
        for step in steps:
            for item in step.what:
                if isinstance(item, ApiObject) and item.kind == "texture":
                    self.add(item)
                    mentioned.add(id(item))
        self.name_all()
        pass_names = Names()
        pass_names.assign(
            [(obj, obj.info.name or obj.name or "renderPass", "") for obj, _ in passes]
        )
        textures = [
            (self.name(texture), texture.at, mapping(members, texture.at))
            for texture in self.all.values()
            if (members := self.members(texture)) or id(texture) in mentioned
        ]
        render_passes = [
            (pass_names.of[id(obj)], obj.info.at, self.render_pass(obj, used))
            for obj, used in passes
        ]
        sections = section("textures", textures) + section("renderPasses", render_passes)
        sections += section("renderPipelines", self.pipelines(pass_names.of))
        commands = self.commands(steps, [obj for obj, _ in passes], pass_names.of)
        if commands is not None:
            sections.append(("commands", commands.span, commands))
        if not sections:
            return None
        place = sections[-1][1]
        tree = mapping([("metal", place, mapping([*self.device(), *sections], place))], whole)
        for _, at, _ in self.assumed.values():
            self.assumed_places.setdefault(at, "")
        return Read(tree, tuple(self.assumed.values()), basis=self.basis)

    def known(self, item: Any) -> Any:
        """Returns what a step names: the texture of a value, or a pass."""
        return (
            self.texture(item)
            if isinstance(item, tuple)
            else self.first(item)
            if isinstance(item, ApiObject) and item.kind == "texture"
            else item
        )

    def passes(self) -> list[ApiObject]:
        """Returns the passes that are encoded, without duplicates, and descriptors that are only
        filled in.
        """
        distinct: dict[tuple[Any, ...], ApiObject] = {}
        for obj in self.current_objects:
            if obj.kind == "pass":
                self.equal_passes[id(obj)] = distinct.setdefault(
                    (obj.info.at, self.signature(obj.info)), obj
                )
        return sorted(distinct.values(), key=lambda obj: obj.at.start)

    def signature(self, info: Struct) -> tuple[Any, ...]:
        parts = []
        for slot, attachment in attachments_of(info):
            for name in sorted(attachment.fields):
                writes = tuple(
                    id(self.first(write.value))
                    if isinstance(write.value, ApiObject)
                    else repr(write.value)
                    for write in self.alternatives(attachment, name)
                )
                parts.append((slot, name, writes))
        return tuple(parts)

    def used(self, obj: ApiObject) -> dict[str, tuple[Struct, ApiObject, Any]]:
        """Returns the attachments of a pass of which enough is known, in the order of their slots,
        with their textures.
        """
        used: dict[str, tuple[Struct, ApiObject, Any]] = {}
        for slot, attachment in sorted(attachments_of(obj.info), key=lambda item: item[0]):
            texture = (
                self.texture(attachment.fields["texture"].writes)
                if "texture" in attachment.fields
                else None
            )
            if not isinstance(texture, ApiObject):
                continue
            action = constant_of(self.field(attachment, "storeAction"))
            target = None
            if self.alternatives(attachment, "resolveTexture"):
                target = self.texture(attachment.fields["resolveTexture"].writes)
                if target is UNKNOWN:
                    continue
            elif (
                (not obj.info.zeroed)
                if action in MULTISAMPLE_RESOLVES
                else action is None and CREATED not in obj.info.fields
            ):
                # Other code may set the resolve texture.
                continue
            used[slot] = (attachment, texture, target)
            self.add(texture)
            if any(write.value == "load" for write in self.alternatives(attachment, "loadAction")):
                field = self.field(attachment, "loadAction")
                if field is not None and constant_of(field) is None:
                    self.maybe_loaded.add(id(texture))
            if isinstance(target, ApiObject):
                self.add(target)
                self.attached.add(id(target))
                if action in MULTISAMPLE_RESOLVES:
                    self.resolved.setdefault(id(texture), texture.at)
        self.add_pass([texture for _, texture, _ in used.values()])
        return used

    def render_pass(self, obj: ApiObject, used: dict[str, tuple[Struct, ApiObject, Any]]) -> Node:
        entries: list[Entry] = []
        colors: list[Entry] = []
        for slot, (attachment, texture, target) in used.items():
            place = attachment.fields["texture"].writes[-1].at
            node = mapping(self.attachment(obj, slot, attachment, texture, target), place)
            (colors if slot.startswith("color") else entries).append(
                (slot.removeprefix("color"), place, node)
            )
        return mapping(section("colorAttachments", colors) + entries, obj.info.at)

    def attachment(
        self, obj: ApiObject, slot: str, attachment: Struct, texture: ApiObject, target: Any
    ) -> list[Entry]:
        entries: list[Entry] = []
        for name, known in (("texture", texture), ("resolveTexture", target)):
            if isinstance(known, ApiObject):
                at = attachment.fields[name].writes[-1].at
                entries.append((name, at, scalar(self.name(known), at)))
        kind = "color" if slot.startswith("color") else slot.removesuffix("Attachment")
        for index, (name, allowed) in enumerate((("loadAction", _LOADS), ("storeAction", _STORES))):
            field = self.field(attachment, name)
            if field is not None:
                # If some frames load the texture, its stored samples are read.
                stores = constant_of(field) in ("store", "storeAndMultisampleResolve")
                if not (stores and id(texture) in self.maybe_loaded):
                    entries.extend(word(name, field, allowed))
            elif obj.info.zeroed and self.defaults:
                place = entries[-1][1] if entries[-1][0] == "resolveTexture" else entries[0][1]
                entries.append((name, place, scalar(_DEFAULTS[kind][index], place)))
        for name, allowed in _FILTERS.items():
            if name.startswith(kind):
                entries += word(name, self.field(attachment, name), allowed)
        return entries

    def pipelines(self, passes: dict[int, str]) -> list[Entry]:
        pipelines = [obj for obj in self.current_objects if obj.kind == "pipeline"]
        names = Names()
        names.assign(
            [
                (
                    obj,
                    obj.name.rpartition("::")[2] or obj.info.name or "pipeline",
                    obj.name.rpartition("::")[0],
                )
                for obj in pipelines
            ]
        )
        entries = [
            (names.of[id(obj)], obj.info.at, self.pipeline(obj, passes)) for obj in pipelines
        ]
        return [entry for entry in entries if entry[2].value]

    def pipeline(self, obj: ApiObject, passes: dict[int, str]) -> Node:
        info = obj.info
        entries: list[Entry] = []
        drawings = info.fields["passes"].writes if "passes" in info.fields else ()
        drawn_in = [
            self.equal_passes.get(id(write.value)) for write in drawings if self.settle((write,))
        ]
        drawn = next((item for item in drawn_in if id(item) in passes), None)
        if drawn is not None:
            entries.append(("renderPass", obj.at, scalar(passes[id(drawn)], obj.at)))
        counted = False
        for name in ("rasterSampleCount", "sampleCount"):
            field = self.field(info, name)
            if field is None:
                continue
            counted = True
            if constant_of(field) in COUNTS:
                entries += plain(name, field)
            elif isinstance(field.value, Symbol) and field.value.key in self.symbols:
                entries.append((name, field.at, scalar(self.symbols[field.value.key], field.at)))
        if not counted and drawn is not None and info.zeroed and self.defaults:
            entries.append(("rasterSampleCount", info.at, scalar(1, info.at)))
        for name in ("depthAttachmentPixelFormat", "stencilAttachmentPixelFormat", *_SWITCHES):
            entries += plain(name, self.field(info, name))
        colors: list[Entry] = []
        for slot, attachment in sorted(attachments_of(info), key=lambda item: item[0]):
            members = [
                entry
                for name in ("pixelFormat", "isBlendingEnabled")
                for entry in plain(name, self.field(attachment, name))
            ]
            colors += section(slot.removeprefix("color"), members)
        return mapping(entries + section("colorAttachments", colors), info.at)

    def device(self) -> list[Entry]:
        """Returns what conditions that hold say about the device."""
        asked = [offer for key, offer in self.program.offers.items() if self.configuration.get(key)]
        family = next(
            (
                (word, at)
                for name, word, at in asked
                if name == "supportsFamily" and word in ENUMS["MTLGPUFamily"]
            ),
            None,
        )
        if family is None and (apple_at := self.apple_only()) is not None:
            self.assume_value("the GPU family", apple_at, "apple3, the minimum for iOS 13")
            family = ("apple3", apple_at)
        entries = [("family", family[1], scalar(*family))] if family is not None else []
        most, place = max(
            ((count, at) for name, count, at in asked if name != "supportsFamily"),
            default=(0, Span(0, 0)),
        )
        if most in COUNTS and type(most) is int and most > 4:
            entries.append(
                (
                    "supportedSampleCounts",
                    place,
                    sequence([scalar(count, place) for count in (1, 2, 4, most)], place),
                )
            )
        return entries

    def apple_only(self) -> Span | None:
        """Returns where the program shows that it targets Apple GPUs."""
        modes = [
            mode for texture in self.all.values() if (mode := self.storage(texture)) is not None
        ]
        return self.platform or next(
            (mode.at for mode in modes if constant_of(mode) == "memoryless"), None
        )

    def commands(
        self, steps: list[Encoded], passes: list[ApiObject], names: dict[int, str]
    ) -> Node | None:
        """Returns the commands of a frame if one function encodes all passes and presents the
        drawable, and every step is known.
        """
        encodings = [step for step in steps if step.kind == "pass"]
        roots = {step.by for step in encodings}
        if len(roots) != 1 or len(encodings) != len(passes) or roots & self.program.incomplete:
            return None
        if not all(step.sure and step.by in roots for step in steps) or not any(
            step.kind == "present" for step in steps
        ):
            return None
        if {id(step.what[0]) for step in encodings} != set(names) or any(
            UNKNOWN in step.what or None in step.what for step in steps
        ):
            return None
        if any(
            texture.escaped or self.is_read_elsewhere(texture)
            for texture in self.all.values()
            if id(texture) in self.attached
        ):
            return None
        reads: dict[int, list[Node]] = {}
        nodes: list[Node] = []
        for step in steps:
            if step.kind == "read":
                reads.setdefault(id(step.what[2]), []).append(self.command(step))
        for step in steps:
            if step.kind == "pass":
                nodes += reads.get(id(step.what[0]), ())
                nodes.append(
                    mapping(
                        [("renderPass", step.at, scalar(names[id(step.what[0])], step.at))], step.at
                    )
                )
            elif step.kind != "read":
                nodes.append(self.command(step))
        return sequence(nodes, steps[0].at)

    def is_read_elsewhere(self, texture: ApiObject) -> bool:
        """Returns whether other files may read a texture, judging by its usage."""
        usage = self.member(texture, "usage")
        only_target = usage is not None and (
            usage.value == "renderTarget"
            or (
                isinstance(usage.value, Flags)
                and {bit for bit, _ in usage.value.bits} == {"renderTarget"}
            )
        )
        return (
            not only_target
            and not is_drawable(texture)
            and texture.name in self.program.unit.visible
        )

    def command(self, step: Encoded) -> Node:
        at = step.at
        named = [
            scalar(self.name(item), at)
            for item in step.what
            if isinstance(item, ApiObject) and item.kind == "texture"
        ]
        if step.kind == "present":
            return mapping([("present", at, named[0])], at)
        if step.kind == "copy":
            return mapping(
                [
                    (
                        "copy",
                        at,
                        mapping([("source", at, named[0]), ("destination", at, named[1])], at),
                    )
                ],
                at,
            )
        return mapping(
            [
                (
                    "readTexture",
                    at,
                    mapping(
                        [("texture", at, named[0]), ("stage", at, scalar(str(step.what[1]), at))],
                        at,
                    ),
                )
            ],
            at,
        )


def attachments_of(info: Struct) -> list[tuple[str, Struct]]:
    """Returns the attachments of a descriptor by their slots."""
    known = [(name, sole_value(cell.writes)) for name, cell in info.fields.items()]
    return [(name, value) for name, value in known if isinstance(value, Struct) and value.fields]
