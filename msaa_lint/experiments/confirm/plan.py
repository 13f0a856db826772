"""A frame as a plan: what a device is to create, record and read back, with everything that is not described taken by default, in words."""

from __future__ import annotations

import os
from collections.abc import Sequence

from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.models import Pipeline as Described
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass as Joined

from . import parts
from .parts import CLEAR, LOAD, NONE, Image, Pass, PassCommand, Pipeline, Plan, Step
from .plan_images import Images
from .plan_integers import layout, mask
from .plan_passes import Passes
from .plan_pipelines import GREATER, LESS, built_in, described
from .resample import resampled, resized

MAX_STEPS = 4096
"""Commands outside of passes, and begins of passes, that are followed."""

SPECIAL = (
    "VK_EXT_multisampled_render_to_single_sampled",
    "VK_AMD_mixed_attachment_samples",
    "VK_NV_framebuffer_mixed_samples",
)
"""Extensions that change what is right; they are enabled only where the frame has them."""

OPTIONAL = ("sampleRateShading", "alphaToOne")
"""Features that are left off where the frame lists what it enables and leaves them out."""

TRANSFERS = {
    "resolveImage": "resolve", "copyImage": "copy", "blitImage": "blit", "clearColorImage": "clear", "clearDepthStencilImage": "clear",
    "copyImageToBuffer": "copyOut", "copyBufferToImage": "copyIn", "present": "present", "pipelineBarrier": "barrier",
}  # fmt: skip


def plan(frame: Frame, file: str = "", size: tuple[int, int] | None = None, samples: int | None = None, api: int | None = None) -> Plan:
    """The plan of a frame. `size` and `samples` take the place of the size and of the counts above one that are described; `api` is the
    version of the structure that render passes are created by, by default the one that the description can have.

    It never raises for what the frame holds: a pass that nothing can run says why (`refused`).
    """
    made = _Plan(frame, file, api).made()
    made = resized(made, size) if size is not None else made
    return resampled(made, samples) if samples is not None else made


class _Plan:
    def __init__(self, frame: Frame, file: str, api: int | None) -> None:
        self.frame = frame
        self.file = file
        self.folder = os.path.dirname(file)
        self.images = Images(frame)
        self.text = self.images.text
        self.passes = Passes(frame, self.images, api)
        self.numbers = {id(each): n for n, each in enumerate(frame.passes)}
        scene = frame.description.scene
        self.reversed = scene is not None and scene.depth == "REVERSED"
        self.pipelines: list[list[Pipeline]] = [[] for _ in frame.passes]
        self.steps: list[Step] = []
        self.used: set[str] = set()

    def made(self) -> Plan:
        if not self.images.sized and self.images.made:
            self.text.append("no size is stated: 256x256 is taken")
        passes = [self.passes.made(each) for each in self.frame.passes]
        if self.frame.has_commands:
            self._commands(passes)
        else:
            for number, each in enumerate(self.frame.passes):
                self._begin(passes[number], each, number, None, [])
        for number, each in enumerate(self.frame.passes):
            if not each.begun and self.frame.has_commands:
                # Never begun: created, and drawn in by nobody.
                self._fitting(passes[number], each)
        if not passes:
            passes = [Pass("frame", "images", parts.FRAME, 0)] if self.images.made or self.frame.pipelines else []
            self.pipelines = [[] for _ in passes]
        if passes:
            self._others()
        passes = [each._replace(pipelines=tuple(own)) for each, own in zip(passes, self.pipelines, strict=True)]
        passes = _with_images(passes, self.steps, len(self.images.made))
        enabled = self.frame.description.enabled
        stated = enabled.features if enabled is not None else None
        scene = self.frame.description.scene
        return Plan(
            self.file,
            self.images.made,
            tuple(passes),
            tuple(self.steps),
            tuple(dict.fromkeys(self.text)),
            self._extensions(),
            tuple(name for name in OPTIONAL if stated is not None and name not in stated),
            self.reversed,
            scene is not None and scene.color == "HDR",
        )

    def _extensions(self) -> tuple[str, ...]:
        enabled = self.frame.description.enabled
        found = {name for name in SPECIAL if enabled is not None and name in (enabled.extensions or ())}
        single = any(subpass.single_sampled for each in self.frame.passes for subpass in each.subpasses)
        if single or (enabled is not None and "multisampledRenderToSingleSampled" in (enabled.features or ())):
            found.add(SPECIAL[0])
        return tuple(sorted(found))

    def _commands(self, passes: Sequence[Pass]) -> None:
        """Every command in order, those within a pass gathered where it begins."""
        by_position = {at: each for each in self.frame.passes for at in each.begun}
        within: list[Command] | None = None
        begun: tuple[Joined, int] | None = None
        at = 0
        for position, command in enumerate(self.frame.commands):
            if len(self.steps) >= MAX_STEPS:
                self.text.append(f"commands after the first {MAX_STEPS} are left out")
                return
            if position in by_position:
                begun, within = (by_position[position], position), []
                at = self.numbers[id(begun[0])]
            elif command.kind in ("endRenderPass", "endRendering"):
                if begun is not None and within is not None:
                    self._begin(passes[at], begun[0], at, begun[1], within)
                begun = within = None
            elif within is not None:
                if len(within) < MAX_STEPS:
                    within.append(command)
                else:
                    self.text.append(f"commands after the first {MAX_STEPS} of a pass are left out")
            elif command.kind in TRANSFERS:
                self._transfer(command, at)
            elif command.kind in ("readImage", "writeImage"):
                self.text.append(f"{command.kind} outside of a pass is left out")
        if begun is not None and within is not None:
            self._begin(passes[at], begun[0], at, begun[1], within)

    def _transfer(self, command: Command, at: int) -> None:
        body, kind = command.body, TRANSFERS[command.kind]
        if kind == "barrier":
            self._barrier(body, at)
            return
        source = self.images.named(getattr(body, "srcImage", None) or getattr(body, "image", None))
        target = self.images.named(getattr(body, "dstImage", None) or getattr(body, "image", None))
        if (source, target) == (NONE, NONE) or (kind in ("resolve", "copy", "blit") and NONE in (source, target)):
            return
        if NONE not in (source, target) and not self.images.made[source].aspects & self.images.made[target].aspects:
            self.text.append(f"{command.kind} between color and depth is left out")
            return
        self.steps.append(Step(kind, at, source=source, target=target))

    def _barrier(self, body: object, at: int) -> None:
        masks = tuple(
            mask(enum, getattr(body, member, ()))
            for enum, member in (
                ("VkPipelineStageFlagBits2", "srcStageMask"),
                ("VkPipelineStageFlagBits2", "dstStageMask"),
                ("VkAccessFlagBits2", "srcAccessMask"),
                ("VkAccessFlagBits2", "dstAccessMask"),
            )
        )
        layouts = []
        for each in getattr(body, "images", ()):
            number = self.images.named(each if isinstance(each, str) else each.image)
            if number != NONE:
                old, new = (None, None) if isinstance(each, str) else (each.oldLayout, each.newLayout)
                layouts.append((number, layout(old, NONE), layout(new, NONE)))
        self.steps.append(Step("barrier", at, masks=masks, layouts=tuple(layouts)))

    def _begin(self, each: Pass, joined: Joined, number: int, position: int | None, within: Sequence[Command]) -> None:
        if each.refused:
            return
        fitting = self._fitting(each, joined)
        body = self.frame.commands[position].body if position is not None else joined.record
        area = getattr(body, "renderArea", None)
        framebuffer = joined.begun.index(position) if position is not None and each.kind == parts.RENDER_PASS else 0
        whole = each.framebuffers[framebuffer]
        x, y = max(area.x or 0, 0) if area is not None else 0, max(area.y or 0, 0) if area is not None else 0
        x, y = min(x, whole.width - 1), min(y, whole.height - 1)
        if area is not None and ((area.width or 0) + x > whole.width or (area.height or 0) + y > whole.height):
            self.text.append(f"the area of {each.name} goes beyond its images: it is cut there")
        width = min((area.width if area is not None else None) or whole.width, whole.width - x)
        height = min((area.height if area is not None else None) or whole.height, whole.height - y)
        inner: list[PassCommand] = []
        commands: list[list[Command]] = [[] for _ in fitting]
        subpass = 0
        for command in within:
            if command.kind == "nextSubpass":
                subpass = min(subpass + 1, len(fitting) - 1)
            else:
                commands[subpass].append(command)
        for subpass, own in enumerate(fitting):
            inner += self._inner(each, joined, number, subpass, own, commands[subpass])
        self.steps.append(Step("begin", number, framebuffer, (x, y, width, height), tuple(inner)))

    def _fitting(self, each: Pass, joined: Joined) -> list[Pipeline]:
        """By subpass: a pipeline that fits it. The described ones of the pass are planned with them."""
        if each.refused:
            return []
        found = []
        number = self.numbers[id(joined)]
        for subpass in joined.subpasses:
            colors = [self._image(a.targets[0]) if a is not None and a.targets else None for a in subpass.color]
            depths = [self._image(a.targets[0]) for a in subpass.depth_stencil if a.targets]
            if each.kind == parts.RENDER_PASS:
                colors += [None] * (len(each.subpasses[subpass.index].colors) - len(colors))
            drawn = [image for image in (*colors, *depths) if image is not None]
            samples = max([image.samples for image in drawn] or [1])
            single = each.subpasses[subpass.index].single_sampled if each.kind == parts.RENDER_PASS else each.single_sampled
            rendering = each.kind == parts.RENDERING
            read_only = self._read_only(each, subpass.index)
            nearer = GREATER if self.reversed else LESS
            depth = depths[0] if depths else None
            made = built_in("", subpass.index, single or samples, colors, depth, read_only=read_only, nearer=nearer, rendering=rendering)
            if rendering:
                roles = {rendered.role for rendered in each.rendered if rendered.image != NONE}
                made = made._replace(
                    depth_format=made.depth_format if "depth" in roles else 0,
                    stencil_format=made.stencil_format if "stencil" in roles else 0,
                    depth_test=made.depth_test and "depth" in roles,
                    depth_write=made.depth_write and "depth" in roles,
                    stencil_test=made.stencil_test and "stencil" in roles,
                    view_mask=each.view_mask,
                )
            found.append(made)
        for pipeline, of in self.frame.pipelines:
            if of is joined and pipeline.key not in self.used:
                at = pipeline.subpass or 0
                if at < len(found):
                    self._described(number, pipeline, found[at])
        return found

    @staticmethod
    def _read_only(each: Pass, subpass: int) -> bool:
        if each.kind == parts.RENDER_PASS:
            layouts = [reference.layout for reference in each.subpasses[subpass].depth_stencil]
        else:
            layouts = [rendered.layout for rendered in each.rendered if rendered.role != "color"]
        return any(found in (parts.DEPTH_READ_LAYOUT, parts.DEPTH_ALONE_READ_LAYOUT, parts.EITHER_READ_LAYOUT) for found in layouts)

    def _image(self, target: object) -> Image:
        return self.images.made[self.images.of(target)]  # type: ignore[arg-type]

    def _described(self, number: int, record: Described, fitting: Pipeline) -> int:
        own = self.pipelines[number]
        for index, known in enumerate(own):
            if known.name == record.key:
                return index
        self.used.add(record.key)
        own.append(described(record, fitting, self.folder, self.text))
        return len(own) - 1

    def _built_in(self, number: int, fitting: Pipeline) -> int:
        own = self.pipelines[number]
        made = fitting._replace(name=f"built-in {fitting.subpass}")
        if made not in own:
            own.append(made)
        return own.index(made)

    def _inner(
        self, each: Pass, joined: Joined, number: int, subpass: int, fitting: Pipeline, commands: Sequence[Command]
    ) -> list[PassCommand]:
        """What is recorded in a subpass: what is described, else the scene by each of its pipelines."""
        found: list[PassCommand] = []
        drawing: list[PassCommand] = []
        own = set(each.framebuffers[0].images)
        for command in commands:
            body = command.body
            if command.kind == "draw":
                name = getattr(body, "pipeline", None)
                record = self.frame.description.pipelines.get(name) if name is not None else None
                index = self._described(number, record, fitting) if record is not None else self._built_in(number, fitting)
                drawing.append(PassCommand("draw", subpass, index))
            elif command.kind == "setRasterizationSamples" and isinstance(body, int):
                drawing.append(PassCommand("samples", subpass, value=body))
            elif command.kind == "clearAttachments":
                drawing += [
                    PassCommand("clear", subpass, value=c.colorAttachment or 0, aspects=mask("VkImageAspectFlagBits", c.aspect))
                    for c in getattr(body, "attachments", ())
                ]
            elif command.kind == "readImage":
                image = self.images.named(getattr(body, "image", None))
                if image != NONE and image not in own and getattr(body, "stage", None) in (None, "FRAGMENT", "FRAGMENT_SHADER"):
                    found.append(PassCommand("read", subpass, image=image))
            elif command.kind == "pipelineBarrier":
                self.text.append("a barrier within a pass is left out")
        if not any(each.kind == "draw" for each in drawing):
            # Of several pipelines each draws the scene turned by a quarter.
            known = [n for n, p in enumerate(self.pipelines[number]) if p.subpass == subpass and not p.name.startswith("built-in ")]
            known = [n for n in known if self._belongs(joined, self.pipelines[number][n].name)]
            if not any(not self.pipelines[number][n].discard for n in known):
                known.append(self._built_in(number, fitting))
            drawing += [PassCommand("draw", subpass, n) for n in known[:8]]
        return found + self._backdrop(each, number, subpass, drawing, bool(found))

    def _belongs(self, joined: Joined, name: str) -> bool:
        return any(pipeline.key == name and of is joined for pipeline, of in self.frame.pipelines)

    def _backdrop(self, each: Pass, number: int, subpass: int, drawing: list[PassCommand], read: bool) -> list[PassCommand]:
        """The first draw covers every pixel where what an attachment holds before is not kept and not cleared."""
        first = next((n for n, inner in enumerate(drawing) if inner.kind == "draw"), None)
        if first is None or read:
            return drawing
        loads, depth_load = _loads(each, subpass)
        if not loads or all(load in (LOAD, CLEAR) for load in loads):
            return drawing
        pipeline = self.pipelines[number][drawing[first].pipeline]
        nearer = (4, 6) if self.reversed else (1, 3)
        sees = not pipeline.depth_test or pipeline.depth_compare == 7 or (depth_load == CLEAR and pipeline.depth_compare in nearer)
        every = (1 << pipeline.samples) - 1
        plain = all(blend.mask == 15 and not blend.enable for blend in pipeline.blends)
        masked = bool(pipeline.mask) and pipeline.mask[0] & every != every
        covers = sees and plain and not masked and not pipeline.alpha_to_coverage and not pipeline.stages and not pipeline.discard
        drawing[first] = drawing[first]._replace(backdrop=True, covers=covers)
        return drawing

    def _others(self) -> None:
        """Pipelines of no pass that is drawn: they are created with the first, by the formats that they state."""
        for pipeline, of in self.frame.pipelines:
            if pipeline.key in self.used or (of is not None and id(of) in self.numbers):
                continue
            colors = 1 if pipeline.rendering is None else 0
            fitting = Pipeline(
                "", NONE, 1, dynamic=(0, 1), blends=tuple(parts.Blend() for _ in range(colors)), numerics=("UNORM",) * colors,
                formats=(37,) * colors,
            )  # fmt: skip
            if pipeline.rendering is None and of is None:
                self.text.append(f"what {pipeline.key} draws to is not stated: R8G8B8A8_UNORM is taken")
            number = next((n for n, each in enumerate(self.frame.passes) if each.kind == parts.RENDERING), 0)
            self._described(number, pipeline, fitting)


def _loads(each: Pass, subpass: int) -> tuple[list[int], int]:
    """The load operations of the colours that a subpass is the first to draw to, and that of its depth."""
    if each.kind == parts.RENDERING:
        colors = [rendered.load for rendered in each.rendered if rendered.role == "color" and rendered.image != NONE]
        return colors, next((rendered.load for rendered in each.rendered if rendered.role == "depth"), NONE)
    before = {r.attachment for s in each.subpasses[:subpass] for r in (*s.colors, *s.resolves)}
    own = each.subpasses[subpass]
    colors = [each.attachments[r.attachment].load for r in own.colors if r.attachment != NONE and r.attachment not in before]
    earlier = {r.attachment for s in each.subpasses[:subpass] for r in s.depth_stencil}
    depth = next((each.attachments[r.attachment].load if r.attachment not in earlier else LOAD for r in own.depth_stencil), NONE)
    return colors, depth


def _with_images(passes: Sequence[Pass], steps: Sequence[Step], images: int) -> list[Pass]:
    """Passes with the images that they need; what nothing needs is made with the first."""
    needed: list[set[int]] = [{n for f in each.framebuffers for n in f.images} for each in passes]
    for step in steps:
        if step.number < len(needed):
            needed[step.number].update({step.source, step.target, *(inner.image for inner in step.inner), *(n for n, *_ in step.layouts)})
    if needed:
        needed[0].update(set(range(images)) - set().union(*needed))
    return [each._replace(images=tuple(sorted(own - {NONE}))) for each, own in zip(passes, needed, strict=True)]
