"""The plan of a frame: what a device creates, records and reads back, with a stated default for
everything that is not described.
"""

from __future__ import annotations

from collections.abc import Sequence

from msaa_lint.core.project import folder_of
from msaa_lint.frame.description.models import Command, Draw
from msaa_lint.frame.description.models import Pipeline as DescribedPipeline
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass as DescribedPass
from msaa_lint.frame.facts.pass_contents import covers_picture

from . import parts
from .parts import CLEAR, COLOR, LOAD, NONE, Image, Pass, PassCommand, Pipeline, Plan, Step
from .plan_images import Images
from .plan_integers import layout, mask
from .plan_passes import Passes
from .plan_pipelines import GREATER, LESS, built_in, described
from .plan_shaders import UnusableShader
from .plan_transfers import TRANSFERS, clears, forbidden_samples, ignored_transfer
from .resample import resampled, resized

MAX_STEPS = 4096
"""Commands outside passes, and begins of passes, that are planned at most."""

SPECIAL = (
    "VK_EXT_multisampled_render_to_single_sampled",
    "VK_AMD_mixed_attachment_samples",
    "VK_NV_framebuffer_mixed_samples",
)
"""Extensions that change what is valid; they are enabled only if the frame enables them."""

OPTIONAL = ("sampleRateShading", "alphaToOne")
"""Features that stay disabled if the frame lists its enabled features without them."""


def plan(
    frame: Frame,
    file: str = "",
    size: tuple[int, int] | None = None,
    samples: int | None = None,
    api: int | None = None,
) -> Plan:
    """The plan of a frame. `size` and `samples` replace the described size and the described sample
    counts above one; `api` is the version of the structures that create render passes, by default
    the one that the description allows.

    It never raises for what the frame contains: a pass that no device can run says why (`refused`),
    and so does one whose shaders cannot be used (`failed`).
    """
    frame_plan = _Plan(frame, file, api).build()
    frame_plan = resized(frame_plan, size) if size is not None else frame_plan
    return resampled(frame_plan, samples) if samples is not None else frame_plan


class _Plan:
    def __init__(self, frame: Frame, file: str, api: int | None) -> None:
        self.frame = frame
        self.file = file
        self.folder = folder_of(file)
        self.images = Images(frame)
        self.notes = self.images.notes
        self.passes = Passes(frame, self.images, api)
        self.numbers = {id(described): n for n, described in enumerate(frame.passes)}
        scene = frame.description.scene
        self.reversed = scene is not None and scene.depth == "REVERSED"
        self.pipelines: list[list[Pipeline]] = [[] for _ in frame.passes]
        self.steps: list[Step] = []
        self.used: set[str] = set()
        self.failures: dict[int, str] = {}
        self.left_out: list[tuple[int, str]] = []

    def build(self) -> Plan:
        if not self.images.sized and self.images.images:
            self.notes.append("no size is stated: 256x256 is assumed")
        passes = [self.passes.plan_pass(frame_pass) for frame_pass in self.frame.passes]
        if self.frame.has_commands:
            self._commands(passes)
        else:
            for number, frame_pass in enumerate(self.frame.passes):
                self._begin(passes[number], frame_pass, number, None, [])
        for number, frame_pass in enumerate(self.frame.passes):
            if not frame_pass.begun and self.frame.has_commands:
                # Never begun: the pass is created, but nothing is drawn in it.
                self._fitting(passes[number], frame_pass)
        if not passes:
            passes = (
                [Pass("frame", "images", parts.FRAME, 0)]
                if self.images.images or self.frame.pipelines
                else []
            )
            self.pipelines = [[] for _ in passes]
        if passes:
            self._others()
        passes = [
            frame_pass._replace(pipelines=tuple(pipelines), failed=self.failures.get(number, ""))
            for number, (frame_pass, pipelines) in enumerate(
                zip(passes, self.pipelines, strict=True)
            )
        ]
        passes = _with_images(passes, self.steps, len(self.images.images))
        self._presentable(passes)
        enabled = self.frame.description.enabled
        stated = enabled.features if enabled is not None else None
        scene = self.frame.description.scene
        return Plan(
            self.file,
            self.images.images,
            tuple(passes),
            tuple(self.steps),
            self.notes.lines(),
            self._extensions(),
            tuple(name for name in OPTIONAL if stated is not None and name not in stated),
            self.reversed,
            scene is not None and scene.color == "HDR",
            left_out=tuple(self.left_out),
        )

    def _extensions(self) -> tuple[str, ...]:
        enabled = self.frame.description.enabled
        names = {
            name for name in SPECIAL if enabled is not None and name in (enabled.extensions or ())
        }
        single_sampled = any(
            subpass.single_sampled
            for described in self.frame.passes
            for subpass in described.subpasses
        )
        if single_sampled or (
            enabled is not None and "multisampledRenderToSingleSampled" in (enabled.features or ())
        ):
            names.add(SPECIAL[0])
        return tuple(sorted(names))

    def _commands(self, passes: Sequence[Pass]) -> None:
        """Plans every command in order; the commands within a pass are collected where it
        begins.
        """
        by_position = {
            current: described for described in self.frame.passes for current in described.begun
        }
        commands_within: list[Command] | None = None
        begin: tuple[DescribedPass, int] | None = None
        current = 0
        dynamic: list[Command] = []
        for position, command in enumerate(self.frame.commands):
            if len(self.steps) >= MAX_STEPS:
                self.notes.append(f"commands after the first {MAX_STEPS} are ignored")
                return
            if command.kind == "setRasterizationSamples":
                # Dynamic state outlives passes.
                dynamic = [command]
            if position in by_position:
                begin, commands_within = (by_position[position], position), [*dynamic]
                current = self.numbers[id(begin[0])]
            elif command.kind in ("endRenderPass", "endRendering"):
                if begin is not None and commands_within is not None:
                    self._begin(passes[current], begin[0], current, begin[1], commands_within)
                begin = commands_within = None
            elif commands_within is not None:
                if len(commands_within) < MAX_STEPS:
                    commands_within.append(command)
                else:
                    self.notes.append(f"commands after the first {MAX_STEPS} of a pass are ignored")
            elif command.kind in TRANSFERS:
                self._transfer(command, current)
            elif command.kind in ("readImage", "writeImage"):
                self.notes.append(f"{command.kind} outside a pass is ignored")
                self._read(command, current)
        if begin is not None and commands_within is not None:
            self._begin(passes[current], begin[0], current, begin[1], commands_within)

    def _transfer(self, command: Command, current: int) -> None:
        body, kind = command.body, TRANSFERS[command.kind]
        if kind == "barrier":
            self._barrier(body, current)
            return
        source = self.images.named(getattr(body, "srcImage", None) or getattr(body, "image", None))
        target = self.images.named(getattr(body, "dstImage", None) or getattr(body, "image", None))
        if (source, target) == (NONE, NONE) or (
            kind in ("resolve", "copy", "blit") and NONE in (source, target)
        ):
            return
        images = [
            self.images.images[number]
            for number in dict.fromkeys((source, target))
            if number != NONE
        ]
        if kind in ("resolve", "copy", "blit") and source == target:
            # Descriptions do not state the levels, layers, and regions of a transfer.
            self.notes.append(
                f"{command.kind} from {images[0].name} to itself, between levels or layers that "
                "are not stated, is ignored"
            )
            return
        forbidden = forbidden_samples(kind, images)
        if forbidden and any(image.name in self.images.uncounted for image in images):
            self.notes.append(f"{command.kind} {forbidden} is ignored")
            return
        if kind == "resolve" and not images[0].aspects & COLOR and self._has_maintenance10():
            self.left_out.append(
                (
                    current,
                    f"{command.kind} of {images[0].name} needs maintenance10, which confirm does "
                    "not enable",
                )
            )
            return
        ignored = forbidden or (
            ignored_transfer(kind, *images) if kind in ("resolve", "copy", "blit") else ""
        )
        if forbidden:
            self.left_out.append(
                (current, f"{command.kind} {forbidden} is forbidden by Vulkan and left out")
            )
        elif ignored:
            self.notes.append(f"{command.kind} {ignored} is ignored")
        if not ignored or (forbidden and kind in ("copy", "blit")):
            self.steps.append(
                Step(kind, current, source=source, target=target, illegal=bool(forbidden))
            )

    def _has_maintenance10(self) -> bool:
        enabled = self.frame.description.enabled
        return enabled is not None and "maintenance10" in (enabled.features or ())

    def _presentable(self, passes: Sequence[Pass]) -> None:
        """Notes the images of a swapchain that are multisampled, which no swapchain has."""
        for name, target in self.frame.targets.items():
            number = self.images.named(name)
            if (
                target.image is not None
                and target.image.presentable
                and self.images.images[number].samples > 1
            ):
                using = [n for n, frame_pass in enumerate(passes) if number in frame_pass.images]
                self.left_out += [
                    (n, f"the presentable {name} is multisampled, which is forbidden by Vulkan")
                    for n in using
                ]

    def _read(self, command: Command, current: int) -> None:
        """Notes that a command reads an image, which is not drawn."""
        image = self.images.named(getattr(command.body, "image", None))
        if command.kind == "readImage" and image != NONE:
            self.steps.append(Step("read", current, source=image))

    def _barrier(self, body: object, current: int) -> None:
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
        for entry in getattr(body, "images", ()):
            number = self.images.named(entry if isinstance(entry, str) else entry.image)
            if number != NONE:
                old, new = (
                    (None, None) if isinstance(entry, str) else (entry.oldLayout, entry.newLayout)
                )
                layouts.append((number, layout(old, NONE), layout(new, NONE)))
        self.steps.append(Step("barrier", current, masks=masks, layouts=tuple(layouts)))

    def _begin(
        self,
        frame_pass: Pass,
        described: DescribedPass,
        number: int,
        position: int | None,
        commands_within: Sequence[Command],
    ) -> None:
        if frame_pass.refused:
            return
        fitting = self._fitting(frame_pass, described)
        body = self.frame.commands[position].body if position is not None else described.record
        area = getattr(body, "renderArea", None)
        framebuffer = (
            described.begun.index(position)
            if position is not None and frame_pass.kind == parts.RENDER_PASS
            else 0
        )
        framebuffer_size = frame_pass.framebuffers[framebuffer]
        x, y = (
            max(area.x or 0, 0) if area is not None else 0,
            max(area.y or 0, 0) if area is not None else 0,
        )
        x, y = min(x, framebuffer_size.width - 1), min(y, framebuffer_size.height - 1)
        if area is not None and (
            (area.width or 0) + x > framebuffer_size.width
            or (area.height or 0) + y > framebuffer_size.height
        ):
            self.notes.append(
                f"the render area of {frame_pass.name} exceeds its images and is clipped to them"
            )
        width = min(
            (area.width if area is not None else None) or framebuffer_size.width,
            framebuffer_size.width - x,
        )
        height = min(
            (area.height if area is not None else None) or framebuffer_size.height,
            framebuffer_size.height - y,
        )
        inner: list[PassCommand] = []
        commands: list[list[Command]] = [[] for _ in fitting]
        subpass = 0
        dynamic: tuple[Command, ...] = ()
        for command in commands_within:
            if command.kind == "setRasterizationSamples":
                dynamic = (command,)
            if command.kind == "nextSubpass":
                subpass = min(subpass + 1, len(fitting) - 1)
                commands[subpass] += dynamic
            else:
                commands[subpass].append(command)
        for subpass, compatible in enumerate(fitting):
            inner += self._inner(
                frame_pass, described, number, subpass, compatible, commands[subpass]
            )
        self.steps.append(Step("begin", number, framebuffer, (x, y, width, height), tuple(inner)))

    def _fitting(self, frame_pass: Pass, described: DescribedPass) -> list[Pipeline]:
        """A built-in pipeline compatible with each subpass. The described pipelines of the pass are
        planned as well.
        """
        if frame_pass.refused:
            return []
        compatible = []
        number = self.numbers[id(described)]
        for subpass in described.subpasses:
            colors = [
                self._image(a.targets[0]) if a is not None and a.targets else None
                for a in subpass.color
            ]
            depths = [self._image(a.targets[0]) for a in subpass.depth_stencil if a.targets]
            if frame_pass.kind == parts.RENDER_PASS:
                colors += [None] * (len(frame_pass.subpasses[subpass.index].colors) - len(colors))
            attached = [image for image in (*colors, *depths) if image is not None]
            samples = max([image.samples for image in attached] or [1])
            single = (
                frame_pass.subpasses[subpass.index].single_sampled
                if frame_pass.kind == parts.RENDER_PASS
                else frame_pass.single_sampled
            )
            rendering = frame_pass.kind == parts.RENDERING
            read_only = self._read_only(frame_pass, subpass.index)
            nearer = GREATER if self.reversed else LESS
            depth = depths[0] if depths else None
            pipeline_plan = built_in(
                "",
                subpass.index,
                single or samples,
                colors,
                depth,
                read_only=read_only,
                nearer=nearer,
                rendering=rendering,
            )
            if rendering:
                roles = {
                    rendered.role for rendered in frame_pass.rendered if rendered.image != NONE
                }
                pipeline_plan = pipeline_plan._replace(
                    depth_format=pipeline_plan.depth_format if "depth" in roles else 0,
                    stencil_format=pipeline_plan.stencil_format if "stencil" in roles else 0,
                    depth_test=pipeline_plan.depth_test and "depth" in roles,
                    depth_write=pipeline_plan.depth_write and "depth" in roles,
                    stencil_test=pipeline_plan.stencil_test and "stencil" in roles,
                    view_mask=frame_pass.view_mask,
                )
            compatible.append(pipeline_plan)
        for pipeline, owner in self.frame.pipelines:
            if owner is described and pipeline.key not in self.used:
                at = pipeline.subpass or 0
                if at < len(compatible):
                    self._described(number, pipeline, compatible[at])
        return compatible

    @staticmethod
    def _read_only(frame_pass: Pass, subpass: int) -> bool:
        if frame_pass.kind == parts.RENDER_PASS:
            layouts = [
                reference.layout for reference in frame_pass.subpasses[subpass].depth_stencil
            ]
        else:
            layouts = [
                rendered.layout for rendered in frame_pass.rendered if rendered.role != "color"
            ]
        return any(
            layout
            in (parts.DEPTH_READ_LAYOUT, parts.DEPTH_ALONE_READ_LAYOUT, parts.EITHER_READ_LAYOUT)
            for layout in layouts
        )

    def _image(self, target: object) -> Image:
        return self.images.images[self.images.of(target)]  # type: ignore[arg-type]

    def _described(self, number: int, record: DescribedPipeline, compatible: Pipeline) -> int:
        planned = self.pipelines[number]
        for index, existing in enumerate(planned):
            if existing.name == record.key:
                return index
        self.used.add(record.key)
        try:
            planned.append(described(record, compatible, self.folder, self.notes))
        except UnusableShader as error:
            self.failures.setdefault(number, str(error))
            planned.append(compatible._replace(name=record.key))
        return len(planned) - 1

    def _built_in(self, number: int, compatible: Pipeline) -> int:
        planned = self.pipelines[number]
        pipeline = compatible._replace(name=f"built-in {compatible.subpass}")
        if pipeline not in planned:
            planned.append(pipeline)
        return planned.index(pipeline)

    def _inner(
        self,
        frame_pass: Pass,
        described: DescribedPass,
        number: int,
        subpass: int,
        compatible: Pipeline,
        commands: Sequence[Command],
    ) -> list[PassCommand]:
        """The commands of a subpass: those described, otherwise a draw of the scene with each of
        its pipelines.
        """
        reads: list[PassCommand] = []
        draws: list[PassCommand] = []
        attached = set(frame_pass.framebuffers[0].images)
        for command in commands:
            body = command.body
            if command.kind == "draw":
                name = getattr(body, "pipeline", None)
                record = self.frame.description.pipelines.get(name) if name is not None else None
                index = (
                    self._described(number, record, compatible)
                    if record is not None
                    else self._built_in(number, compatible)
                )
                draws.append(
                    _counted(
                        PassCommand("draw", subpass, index),
                        body,
                        record,
                        tests=bool(described.subpasses[subpass].depth_stencil),
                    )
                )
            elif command.kind == "setRasterizationSamples" and isinstance(body, int):
                draws.append(PassCommand("samples", subpass, value=body))
            elif command.kind == "clearAttachments":
                draws += clears(body, subpass)
            elif command.kind == "readImage":
                image = self.images.named(getattr(body, "image", None))
                if (
                    image != NONE
                    and image not in attached
                    and getattr(body, "stage", None) in (None, "FRAGMENT", "FRAGMENT_SHADER")
                ):
                    reads.append(PassCommand("read", subpass, image=image))
                else:
                    self._read(command, number)
            elif command.kind == "pipelineBarrier":
                self.notes.append("a barrier within a pass is ignored")
        if not any(frame_pass.kind == "draw" for frame_pass in draws):
            # Each of several pipelines draws the scene rotated by another 90 degrees.
            usable = [
                n
                for n, p in enumerate(self.pipelines[number])
                if p.subpass == subpass and not p.name.startswith("built-in ")
            ]
            usable = [n for n in usable if self._belongs(described, self.pipelines[number][n].name)]
            if not any(not self.pipelines[number][n].discard for n in usable):
                usable.append(self._built_in(number, compatible))
            draws += [PassCommand("draw", subpass, n, draws=0) for n in usable[:8]]
        return reads + self._backdrop(frame_pass, number, subpass, draws, bool(reads))

    def _belongs(self, described: DescribedPass, name: str) -> bool:
        return any(
            pipeline.key == name and owner is described for pipeline, owner in self.frame.pipelines
        )

    def _backdrop(
        self,
        frame_pass: Pass,
        number: int,
        subpass: int,
        draws: list[PassCommand],
        reads_image: bool,
    ) -> list[PassCommand]:
        """Makes the first draw cover every pixel if the previous contents of an attachment are
        neither loaded nor cleared.
        """
        first = next((n for n, inner in enumerate(draws) if inner.kind == "draw"), None)
        if first is None or reads_image:
            return draws
        loads, depth_load = _loads(frame_pass, subpass)
        if not loads or all(load in (LOAD, CLEAR) for load in loads):
            return draws
        pipeline = self.pipelines[number][draws[first].pipeline]
        nearer = (4, 6) if self.reversed else (1, 3)
        always_passes = (
            not pipeline.depth_test
            or pipeline.depth_compare == 7
            or (depth_load == CLEAR and pipeline.depth_compare in nearer)
        )
        every = (1 << pipeline.samples) - 1
        writes_all = all(blend.mask == 15 and not blend.enable for blend in pipeline.blends)
        masked = bool(pipeline.mask) and pipeline.mask[0] & every != every
        covers = (
            always_passes
            and writes_all
            and not masked
            and not pipeline.alpha_to_coverage
            and not pipeline.stages
            and not pipeline.discard
        )
        draws[first] = draws[first]._replace(backdrop=True, covers=covers)
        return draws

    def _others(self) -> None:
        """Plans the pipelines of no planned pass: they are created with the first one, for the
        formats that they state.
        """
        for pipeline, owner in self.frame.pipelines:
            if pipeline.key in self.used or (owner is not None and id(owner) in self.numbers):
                continue
            colors = 1 if pipeline.rendering is None else 0
            compatible = Pipeline(
                "", NONE, 1, dynamic=(0, 1), blends=tuple(parts.Blend() for _ in range(colors)),
                numerics=("UNORM",) * colors,
                formats=(37,) * colors,
            )  # fmt: skip
            if pipeline.rendering is None and owner is None:
                self.notes.append(
                    f"the attachments of {pipeline.key} are not stated: R8G8B8A8_UNORM is assumed"
                )
            number = next(
                (n for n, each in enumerate(self.frame.passes) if each.kind == parts.RENDERING), 0
            )
            self._described(number, pipeline, compatible)


def _counted(
    command: PassCommand, draw: object, record: DescribedPipeline | None, *, tests: bool
) -> PassCommand:
    """A draw with its described counts. `tests`: there is depth or stencil to test against."""
    if not isinstance(draw, Draw):
        return command
    count = draw.vertexCount if draw.vertexCount is not None else draw.indexCount
    return command._replace(
        vertices=count or 0,
        instances=draw.instanceCount if draw.instanceCount is not None else 1,
        draws=draw.drawCount or 1,
        full_screen=covers_picture(draw, record, tests) is True,
    )


def _loads(frame_pass: Pass, subpass: int) -> tuple[list[int], int]:
    """The load operations of the color attachments that a subpass is the first to use, and that of
    its depth attachment.
    """
    if frame_pass.kind == parts.RENDERING:
        colors = [
            rendered.load
            for rendered in frame_pass.rendered
            if rendered.role == "color" and rendered.image != NONE
        ]
        return colors, next(
            (rendered.load for rendered in frame_pass.rendered if rendered.role == "depth"), NONE
        )
    before = {
        r.attachment for s in frame_pass.subpasses[:subpass] for r in (*s.colors, *s.resolves)
    }
    described_subpass = frame_pass.subpasses[subpass]
    colors = [
        frame_pass.attachments[r.attachment].load
        for r in described_subpass.colors
        if r.attachment != NONE and r.attachment not in before
    ]
    earlier = {r.attachment for s in frame_pass.subpasses[:subpass] for r in s.depth_stencil}
    depth = next(
        (
            frame_pass.attachments[r.attachment].load if r.attachment not in earlier else LOAD
            for r in described_subpass.depth_stencil
        ),
        NONE,
    )
    return colors, depth


def _with_images(passes: Sequence[Pass], steps: Sequence[Step], images: int) -> list[Pass]:
    """Passes with the images that they need; images that no pass needs are created with the first
    one. A barrier needs none: it may be for images of other passes.
    """
    needed: list[set[int]] = [
        {n for f in frame_pass.framebuffers for n in f.images} for frame_pass in passes
    ]
    for step in steps:
        if step.number < len(needed):
            needed[step.number].update(
                {step.source, step.target, *(inner.image for inner in step.inner)}
            )
    if needed:
        needed[0].update(set(range(images)) - set().union(*needed))
    return [
        frame_pass._replace(images=tuple(sorted(images_of_pass - {NONE})))
        for frame_pass, images_of_pass in zip(passes, needed, strict=True)
    ]
