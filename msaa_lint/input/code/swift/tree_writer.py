"""Writes a Metal description from a Swift file; each member has its location in the source."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span

from .interpreter import Encoded, Interpreter
from .metal import pass_of, pipeline_of
from .textures import COUNTS, Entry, Names, Textures, plain, section, word
from .values import Constant, Field, OneOf, Pass, Pipeline, Symbol, Texture, Value, constant_of

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
        filled = [entry for entry in interpreter.objects.values() if entry.kind == "pipeline" and entry.fields]
        built = [pipeline_of(interpreter, entry, entry.at, entry.type_name) for entry in filled if id(entry) not in descriptors]
        pipelines = [*interpreter.pipelines.values(), *built]
        self.textures.names.assign([(item, item.name or "texture", item.type_name) for item in self.textures.all.values()])
        pass_names = Names()
        pass_names.assign([(entry, entry.descriptor.name or "renderPass", entry.descriptor.type_name) for entry, _ in passes])
        textures = [
            (self.textures.name(texture), texture.at, mapping(members, texture.at))
            for texture in self.textures.all.values()
            if (members := self.textures.members(texture)) or id(texture) in mentioned
        ]
        render_passes = [(pass_names.of[id(entry)], entry.descriptor.at, self.render_pass(entry, used)) for entry, used in passes]
        sections = section("textures", textures) + section("renderPasses", render_passes)
        sections += section("renderPipelines", self.pipelines(pipelines, pass_names.of))
        steps = _commands(interpreter, self.textures, [entry for entry, _ in passes], pass_names.of)
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
            texture, resolve, action = fields.get("texture"), fields.get("resolveTexture"), constant_of(fields.get("storeAction"))
            if texture is None or not isinstance(texture.value, Texture):
                continue
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
            (colors if name.startswith("color") else entries).append((name.removeprefix("color"), place, node))
        return mapping(section("colorAttachments", colors) + entries, render_pass.descriptor.at)

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
                stores = constant_of(field) in ("store", "storeAndMultisampleResolve")
                if not (stores and id(fields["texture"].value) in self.maybe_loaded):
                    entries.extend(word(name, field, allowed))
            elif render_pass.complete and self.defaults:
                place = fields.get("resolveTexture", fields["texture"]).key
                entries.append((name, place, scalar(_DEFAULTS[kind][index], place)))
        for name, allowed in _FILTERS.items():
            if name.startswith(kind):
                entries += word(name, fields.get(name), allowed)
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
            if constant_of(field) in COUNTS:
                entries += plain(name, field)
            elif isinstance(field.value, Symbol) and field.value in self.textures.symbols:
                entries.append((name, field.key, scalar(self.textures.symbols[field.value], field.at)))
        complete = pipeline.descriptor.complete and not pipeline.descriptor.loose
        if not counted and drawn is not None and complete and self.defaults:
            entries.append(("rasterSampleCount", pipeline.descriptor.at, scalar(1, pipeline.descriptor.at)))
        for name in ("depthAttachmentPixelFormat", "stencilAttachmentPixelFormat", *_SWITCHES):
            entries += plain(name, pipeline.fields.get(name))
        colors: list[Entry] = []
        for slot in sorted(pipeline.colors):
            fields = pipeline.colors[slot]
            members = [entry for name in ("pixelFormat", "isBlendingEnabled") for entry in plain(name, fields.get(name))]
            colors += section(slot.removeprefix("color"), members)
        return mapping(entries + section("colorAttachments", colors), pipeline.descriptor.at)

    def device(self) -> list[Entry]:
        interpreter = self.interpreter
        family = interpreter.family
        if family is None and (apple_at := self.apple_only()) is not None:
            self.textures.assume("the GPU family", apple_at, "apple3, the minimum for iOS 13")
            family = ("apple3", apple_at)
        entries = [("family", family[1], scalar(*family))] if family is not None else []
        most = max(interpreter.offered_counts, default=0)
        if most in COUNTS and most > 4:
            place = interpreter.offered_counts[most]
            entries.append(("supportedSampleCounts", place, sequence([scalar(count, place) for count in (1, 2, 4, most)], place)))
        return entries

    def apple_only(self) -> Span | None:
        """Returns where the file shows that it targets Apple GPUs."""
        modes = [fields["storageMode"] for texture in self.textures.all.values() for fields in texture.made if "storageMode" in fields]
        return self.interpreter.imports or next((mode.at for mode in modes if constant_of(mode) == "memoryless"), None)


def _commands(interpreter: Interpreter, textures: Textures, passes: list[Pass], names: dict[int, str]) -> Node | None:
    """Returns the commands of a frame if one function encodes all passes and presents the drawable, and every step is known."""
    encodings = [item for item in interpreter.encoded if item.kind == "pass"]
    roots = {encoding.by for encoding in encodings}
    if len(roots) != 1 or len(encodings) != len(passes) or roots & interpreter.incomplete:
        return None
    steps = [item for item in interpreter.encoded if item.by in roots]
    if not all(item.sure for item in steps) or not any(entry.kind == "present" for entry in steps):
        return None
    if {id(encoding.what[0]) for encoding in encodings} != set(names):
        return None
    attached = {id(field.value) for render_pass in passes for fields in render_pass.attachments.values() for field in fields.values()}
    hidden = attached & interpreter.escaped or any(id(item) in attached and _read_elsewhere(item) for item in textures.all.values())
    if hidden or len(steps) != len(interpreter.encoded):
        return None
    reads: dict[int, list[Encoded]] = {}
    for step in steps:
        if step.kind == "read":
            if not isinstance(step.what[2], Pass):
                return None
            reads.setdefault(id(step.what[2]), []).append(step)
    nodes: list[Node] = []
    for step in steps:
        if step.kind == "pass":
            nodes.extend(_command(textures, item) for item in reads.get(id(step.what[0]), ()))
            nodes.append(mapping([("renderPass", step.at, scalar(names[id(step.what[0])], step.at))], step.at))
        elif step.kind != "read":
            nodes.append(_command(textures, step))
    return sequence(nodes, steps[0].at)


def _read_elsewhere(texture: Texture) -> bool:
    """Returns whether other files may read a texture, judging by its usage."""
    usages = [constant_of(fields.get("usage")) for fields in texture.made]
    return texture.open and (not usages or any(usage not in ("renderTarget", ("renderTarget",)) for usage in usages))


def _command(textures: Textures, step: Encoded) -> Node:
    at = step.at
    named = [scalar(textures.name(item), at) for item in step.what if isinstance(item, Texture)]
    if step.kind == "present":
        return mapping([("present", at, named[0])], at)
    if step.kind == "copy":
        return mapping([("copy", at, mapping([("source", at, named[0]), ("destination", at, named[1])], at))], at)
    return mapping([("readTexture", at, mapping([("texture", at, named[0]), ("stage", at, scalar(str(step.what[1]), at))], at))], at)
