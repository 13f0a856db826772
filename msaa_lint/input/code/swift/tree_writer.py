"""Writes a Metal description from a Swift file; each member has its location in the source."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span

from .entries import COUNTS, Entry, Names, plain, word
from .frame_state import Pass, Pipeline
from .frames import commands
from .interpreter import Interpreter
from .metal import pass_of, pipeline_of
from .textures import Textures
from .values import Constant, Field, OneOf, Symbol, Texture, Value

RESOLVING = ("multisampleResolve", "storeAndMultisampleResolve")
_LOADS = frozenset({"load", "clear", "dontCare"})
_STORES = frozenset({"store", "dontCare", "multisampleResolve", "storeAndMultisampleResolve", "unknown", "customSampleDepthStore"})
_FILTERS = {
    "depthResolveFilter": frozenset({"sample0", "min", "max"}),
    "stencilResolveFilter": frozenset({"sample0", "depthResolvedSample"}),
}
_DEFAULTS = {"color": ("dontCare", "store"), "depth": ("clear", "dontCare"), "stencil": ("clear", "dontCare")}
"""The default load and store actions of attachments (Apple's documentation of loadAction and storeAction)."""

_SWITCHES = ("isAlphaToCoverageEnabled", "alphaToCoverageEnabled", "isAlphaToOneEnabled", "alphaToOneEnabled", "isRasterizationEnabled")


class DescriptionWriter:
    """Writes the description of one file."""

    def __init__(self, interpreter: Interpreter, defaults: bool) -> None:
        self.interpreter = interpreter
        self.defaults = defaults
        self.textures = Textures(interpreter, defaults)
        self.maybe_loaded: set[int] = set()

    def tree(self, whole: Span) -> Node | None:
        """Returns the description, or None if the file does not use Metal multisampling."""
        passes = [(render_pass, written) for render_pass in self.passes() if (written := self.used(render_pass))]
        interpreter = self.interpreter
        for texture in interpreter.textures.values():
            if texture.made:
                self.textures.add(texture)
        mentioned = set(self.textures.attached)
        for step in interpreter.encoded:
            for item in step.what:
                if isinstance(item, Texture):
                    self.textures.add(item)
                    mentioned.add(id(item))
        descriptors = {id(pipeline.descriptor) for pipeline in interpreter.pipelines.values()}
        built = [
            entry for entry in interpreter.objects.values() if entry.kind == "pipeline" and entry.fields and id(entry) not in descriptors
        ]
        pipelines = [*interpreter.pipelines.values(), *(pipeline_of(interpreter, entry, entry.at, entry.type_name) for entry in built)]
        self.textures.names.assign([(item, item.name or "texture", item.type_name) for item in self.textures.all.values()])
        pass_names = Names()
        pass_names.assign([(entry, entry.descriptor.name or "renderPass", entry.descriptor.type_name) for entry, _ in passes])
        textures = [
            (self.textures.name(texture), texture.at, mapping(members, texture.at))
            for texture in self.textures.all.values()
            if (members := self.textures.members(texture)) or id(texture) in mentioned
        ]
        sections: list[Entry] = []
        for name, entries in (
            ("textures", textures),
            ("renderPasses", [(pass_names.of[id(entry)], entry.descriptor.at, self.render_pass(entry, used)) for entry, used in passes]),
            ("renderPipelines", self.pipelines(pipelines, pass_names.of)),
        ):
            if entries:
                place = entries[0][1]
                sections.append((name, place, mapping(entries, place)))
        steps = commands(interpreter, self.textures, [entry for entry, _ in passes], pass_names.of)
        if steps is not None:
            sections.append(("commands", steps.span, steps))
        if not sections:
            return None
        place = sections[-1][1]
        return mapping([("metal", place, mapping([*self.device(), *sections], place))], whole)

    def passes(self) -> list[Pass]:
        """Returns the passes that are encoded, without duplicates, and descriptors that are only filled in."""
        interpreter = self.interpreter
        render_passes: list[Pass] = []
        values_by_descriptor: dict[int, list[dict[str, dict[str, Value]]]] = {}
        for render_pass in interpreter.passes.values():
            values = {slot: {name: field.value for name, field in fields.items()} for slot, fields in render_pass.attachments.items()}
            before = values_by_descriptor.setdefault(id(render_pass.descriptor), [])
            same = next((index for index, one in enumerate(before[:8]) if one == values), None)
            before.append(values)
            if same is None:
                render_passes.append(render_pass)
        for item in interpreter.objects.values():
            if item.kind == "pass" and id(item) not in values_by_descriptor and item.fields and id(item) not in interpreter.superseded:
                unencoded = pass_of(interpreter, item, item.at)
                unencoded.complete = False
                render_passes.append(unencoded)
        return sorted(render_passes, key=lambda render_pass: render_pass.at.start)

    def used(self, render_pass: Pass) -> dict[str, dict[str, Field]]:
        """Returns the attachments of a pass of which enough is known, in the order of their slots."""
        used: dict[str, dict[str, Field]] = {}
        drawn: list[Texture] = []
        for name in sorted(render_pass.attachments):
            fields = render_pass.attachments[name]
            texture, resolve, store = fields.get("texture"), fields.get("resolveTexture"), fields.get("storeAction")
            if texture is None or not isinstance(texture.value, Texture):
                continue
            action = store.value.value if store is not None and isinstance(store.value, Constant) else None
            if resolve is not None and not isinstance(resolve.value, (Texture, Constant)):
                continue
            # Other code may set the resolve texture.
            if resolve is None and (
                not render_pass.complete if action in RESOLVING else action is None and not render_pass.descriptor.complete
            ):
                continue
            used[name] = fields
            self.textures.add(texture.value)
            drawn.append(texture.value)
            load = fields.get("loadAction")
            if load is not None and isinstance(load.value, OneOf) and "load" in load.value.names:
                self.maybe_loaded.add(id(texture.value))
            if resolve is not None and isinstance(resolve.value, Texture):
                self.textures.add(resolve.value)
                self.textures.attached.add(id(resolve.value))
                if action in RESOLVING:
                    self.textures.resolved.setdefault(id(texture.value), texture.at)
        self.textures.add_pass(drawn)
        return used

    def render_pass(self, render_pass: Pass, used: dict[str, dict[str, Field]]) -> Node:
        entries: list[Entry] = []
        colors: list[Entry] = []
        for name, fields in used.items():
            place = fields["texture"].key
            node = mapping(self.attachment(render_pass, name, fields), place)
            if name.startswith("color"):
                colors.append((name.removeprefix("color"), place, node))
            else:
                entries.append((name, place, node))
        if colors:
            entries.insert(0, ("colorAttachments", colors[0][1], mapping(colors, colors[0][1])))
        return mapping(entries, render_pass.descriptor.at)

    def attachment(self, render_pass: Pass, slot: str, fields: dict[str, Field]) -> list[Entry]:
        entries: list[Entry] = []
        for name in ("texture", "resolveTexture"):
            field = fields.get(name)
            if field is not None and isinstance(field.value, Texture):
                entries.append((name, field.key, scalar(self.textures.name(field.value), field.at)))
        kind = "color" if slot.startswith("color") else slot.removesuffix("Attachment")
        for index, (name, allowed) in enumerate((("loadAction", _LOADS), ("storeAction", _STORES))):
            field = fields.get(name)
            if field is not None:
                # If some frames load the texture, its stored samples are read.
                stores = field.value in (Constant("store"), Constant("storeAndMultisampleResolve"))
                if not (stores and id(fields["texture"].value) in self.maybe_loaded):
                    entries.extend(word(name, field, allowed))
            elif render_pass.complete and self.defaults:
                place = fields.get("resolveTexture", fields["texture"]).key
                entries.append((name, place, scalar(_DEFAULTS[kind][index], place)))
        for name, allowed in _FILTERS.items():
            field = fields.get(name)
            if field is not None and name.startswith(kind):
                entries.extend(word(name, field, allowed))
        return entries

    def pipelines(self, pipelines: list[Pipeline], passes: dict[int, str]) -> list[Entry]:
        names = Names()
        names.assign([(pipeline, pipeline.name or pipeline.descriptor.name or "pipeline", pipeline.type_name) for pipeline in pipelines])
        entries = [(names.of[id(pipeline)], pipeline.descriptor.at, self.pipeline(pipeline, passes)) for pipeline in pipelines]
        return [entry for entry in entries if entry[2].value]

    def pipeline(self, pipeline: Pipeline, passes: dict[int, str]) -> Node:
        entries: list[Entry] = []
        drawn = next((one for one in pipeline.passes if id(one) in passes), None)
        if drawn is not None:
            entries.append(("renderPass", pipeline.at, scalar(passes[id(drawn)], pipeline.at)))
        counted = False
        for name in ("rasterSampleCount", "sampleCount"):
            field = pipeline.fields.get(name)
            if field is None:
                continue
            counted = True
            if isinstance(field.value, Constant) and field.value.value in COUNTS:
                entries.append((name, field.key, scalar(field.value.value, field.at)))
            elif isinstance(field.value, Symbol) and field.value in self.textures.symbols:
                entries.append((name, field.key, scalar(self.textures.symbols[field.value], field.at)))
        complete = pipeline.descriptor.complete and not pipeline.descriptor.loose
        if not counted and drawn is not None and complete and self.defaults:
            entries.append(("rasterSampleCount", pipeline.descriptor.at, scalar(1, pipeline.descriptor.at)))
        for name in ("depthAttachmentPixelFormat", "stencilAttachmentPixelFormat", *_SWITCHES):
            if name in pipeline.fields:
                entries.extend(plain(name, pipeline.fields[name]))
        colors: list[Entry] = []
        for slot in sorted(pipeline.colors):
            fields = pipeline.colors[slot]
            members = [entry for name in ("pixelFormat", "isBlendingEnabled") if name in fields for entry in plain(name, fields[name])]
            if members:
                colors.append((slot.removeprefix("color"), members[0][1], mapping(members, members[0][1])))
        if colors:
            entries.append(("colorAttachments", colors[0][1], mapping(colors, colors[0][1])))
        return mapping(entries, pipeline.descriptor.at)

    def device(self) -> list[Entry]:
        interpreter = self.interpreter
        entries: list[Entry] = []
        if interpreter.family is not None:
            name, place = interpreter.family
            entries.append(("family", place, scalar(name, place)))
        else:
            family_at = self.family()
            if family_at is not None:
                self.textures.assume("the GPU family", family_at, "apple3, the minimum for iOS 13")
                entries.append(("family", family_at, scalar("apple3", family_at)))
        most = max(interpreter.offered_counts, default=0)
        if most in COUNTS and most > 4:
            place = interpreter.offered_counts[most]
            entries.append(("supportedSampleCounts", place, sequence([scalar(count, place) for count in (1, 2, 4, most)], place)))
        return entries

    def family(self) -> Span | None:
        """Returns where the file shows that it targets Apple GPUs."""
        place = self.interpreter.imports
        if place is not None:
            return place
        for texture in self.textures.all.values():
            for fields in texture.made:
                mode = fields.get("storageMode")
                if mode is not None and mode.value == Constant("memoryless"):
                    return mode.at
        return None
