"""Plans of frames with one sample per pixel, with more of them: multisampled attachments that are
resolved in their passes, as an engine adds them, or larger images that are scaled down.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

from msaa_lint.experiments.confirm.parts import (
    COLOR,
    COLOR_ATTACHMENT,
    COLOR_LAYOUT,
    DEPTH_ATTACHMENT,
    DEPTH_LAYOUT,
    LOAD,
    LOAD_DONT_CARE,
    NONE,
    RENDER_PASS,
    STENCIL,
    STORE,
    STORE_DONT_CARE,
    TRANSFER_SOURCE,
    TRANSFER_TARGET,
    TRANSIENT,
    UNDEFINED,
    Attachment,
    Framebuffer,
    Image,
    Pass,
    Plan,
    Reference,
    RenderTarget,
    Step,
)
from msaa_lint.experiments.confirm.resample import images_of

SAMPLE_ZERO, AVERAGE = 1, 2
"""VkResolveModeFlagBits."""

NEAREST, LINEAR = 0, 1
"""VkFilter."""

FLOATS_32 = range(98, 110)
"""VkFormats with components of 32 bits, which many devices do not filter."""


def attached(frame_pass: Pass, framebuffer: int = 0) -> tuple[list[int], list[int]]:
    """The images that a pass draws to: those of color, and those of depth and stencil."""
    if frame_pass.kind != RENDER_PASS:
        targets = [rendered for rendered in frame_pass.rendered if rendered.image != NONE]
        colors = [rendered.image for rendered in targets if rendered.role == "color"]
        return colors, list(
            dict.fromkeys(rendered.image for rendered in targets if rendered.role != "color")
        )
    images = frame_pass.framebuffers[framebuffer].images
    colors = [
        images[r.attachment]
        for subpass in frame_pass.subpasses
        for r in subpass.colors
        if r.attachment != NONE
    ]
    depths = [
        images[r.attachment]
        for subpass in frame_pass.subpasses
        for r in subpass.depth_stencil
        if r.attachment != NONE
    ]
    return list(dict.fromkeys(colors)), list(dict.fromkeys(depths))


class _Uses:
    """What happens to the attachments of some passes (`group`) after each of them."""

    def __init__(self, plan: Plan, group: Collection[int]) -> None:
        self.plan, self.group = plan, group
        self.uses = [images_of(plan, step) for step in plan.steps]
        self.leaving: dict[int, set[int]] = {number: set() for number in group}
        """By pass: the images that something outside the group uses next."""
        self.kept: dict[int, set[int]] = {number: set() for number in group}
        """By pass: the images that a pass of the group uses next."""
        self.last: dict[int, set[int]] = {number: set() for number in group}
        """By pass: the images that nothing uses afterward."""
        for position, step in enumerate(plan.steps):
            if self.is_of_group(step):
                colors, depths = attached(plan.passes[step.number], step.framebuffer)
                for image in (*colors, *depths):
                    self._follow(step.number, image, position)

    def is_of_group(self, step: Step) -> bool:
        """Whether a step begins a pass of the group."""
        return step.kind == "begin" and step.number in self.group

    def _follow(self, number: int, image: int, position: int) -> None:
        for later in range(position + 1, len(self.plan.steps)):
            if image in self.uses[later]:
                step = self.plan.steps[later]
                inside = self.is_of_group(step) and image not in {
                    inner.image for inner in step.inner
                }
                (self.kept if inside else self.leaving)[number].add(image)
                return
        self.last[number].add(image)


def multisampled(plan: Plan, group: Collection[int], samples: int) -> Plan:
    """A plan whose passes `group` draw with `samples` samples: to images of their own, which are
    resolved to the described ones in the last pass that draws to them. Depth is resolved where
    something else uses it afterward.
    """
    uses = _Uses(plan, group)
    images = list(plan.images)
    copies: dict[int, int] = {}
    for number in sorted(group):
        for index in range(len(plan.passes[number].framebuffers)):
            for image in {
                i for each in attached(plan.passes[number], index) for i in each
            } - copies.keys():
                copies[image] = len(images)
                images.append(
                    _multisampled_image(
                        plan.images[image],
                        samples,
                        any(image in kept for kept in uses.kept.values()),
                    )
                )
    passes = list(plan.passes)
    for number in group:
        frame_pass = passes[number]
        resolved = {
            image
            for each in attached(frame_pass)
            for image in each
            if image in uses.leaving[number]
            or (image in uses.last[number] and images[image].aspects & COLOR)
        }
        converted = (_render_pass if frame_pass.kind == RENDER_PASS else _rendering)(
            frame_pass, copies, resolved, uses.kept[number], samples, images
        )
        pipelines = tuple(pipeline._replace(samples=samples) for pipeline in frame_pass.pipelines)
        new = {
            copies[image]
            for image in copies
            if image
            in {i for f in frame_pass.framebuffers for i in f.images} | set(frame_pass.images)
        }
        passes[number] = converted._replace(
            pipelines=pipelines, images=tuple(sorted({*frame_pass.images, *new}))
        )
    return plan._replace(images=tuple(images), passes=tuple(passes))


def _multisampled_image(image: Image, samples: int, kept: bool) -> Image:
    usage = COLOR_ATTACHMENT if image.aspects & COLOR else DEPTH_ATTACHMENT
    return image._replace(
        name=f"{image.name} {samples}x",
        samples=samples,
        levels=1,
        tiling=0,
        flags=0,
        lazy=not kept,
        usage=usage if kept else usage | TRANSIENT,
    )


def _render_pass(
    frame_pass: Pass,
    copies: dict[int, int],
    resolved: Collection[int],
    kept: Collection[int],
    samples: int,
    images: Sequence[Image],
) -> Pass:
    (subpass,) = frame_pass.subpasses
    attachments = list(frame_pass.attachments)
    framebuffers = [list(framebuffer.images) for framebuffer in frame_pass.framebuffers]
    targets: dict[int, int] = {}
    for index in {r.attachment for r in (*subpass.colors, *subpass.depth_stencil)} - {NONE}:
        image, described = framebuffers[0][index], attachments[index]
        layout = COLOR_LAYOUT if images[image].aspects & COLOR else DEPTH_LAYOUT
        store = STORE if image in kept else STORE_DONT_CARE
        attachments[index] = described._replace(
            samples=samples, store=store, stencil_store=store, final=layout, stencil_final=NONE,
            stencil_initial=NONE,
            initial=layout if LOAD in (described.load, described.stencil_load) else UNDEFINED,
        )  # fmt: skip
        if image in resolved:
            targets[index] = len(attachments)
            attachments.append(_resolve_target(described))
            for framebuffer in framebuffers:
                framebuffer.append(framebuffer[index])
        for framebuffer in framebuffers:
            framebuffer[index] = copies[framebuffer[index]]
    resolves = tuple(
        Reference(targets[r.attachment], COLOR_LAYOUT)
        if r.attachment in targets
        else Reference(NONE)
        for r in subpass.colors
    )
    depths = [r for r in subpass.depth_stencil if r.attachment in targets]
    subpass = subpass._replace(
        resolves=resolves if any(r.attachment != NONE for r in resolves) else ()
    )
    if depths:
        aspects = images[frame_pass.framebuffers[0].images[depths[0].attachment]].aspects
        target = Reference(targets[depths[0].attachment], DEPTH_LAYOUT)
        subpass = subpass._replace(
            depth_resolve=(target,),
            depth_mode=SAMPLE_ZERO,
            stencil_mode=SAMPLE_ZERO if aspects & STENCIL else 0,
        )
    return frame_pass._replace(
        api=2 if depths else frame_pass.api,
        attachments=tuple(attachments),
        subpasses=(subpass,),
        framebuffers=tuple(
            _with(f, numbers)
            for f, numbers in zip(frame_pass.framebuffers, framebuffers, strict=True)
        ),
    )


def _with(framebuffer: Framebuffer, images: Sequence[int]) -> Framebuffer:
    return framebuffer._replace(images=tuple(images))


def _resolve_target(described: Attachment) -> Attachment:
    return described._replace(
        load=LOAD_DONT_CARE, stencil_load=LOAD_DONT_CARE, store=STORE, stencil_store=STORE,
        initial=UNDEFINED, stencil_initial=NONE,
        stencil_final=NONE,
    )  # fmt: skip


def _rendering(
    frame_pass: Pass,
    copies: dict[int, int],
    resolved: Collection[int],
    kept: Collection[int],
    samples: int,
    images: Sequence[Image],
) -> Pass:
    def target(rendered: RenderTarget) -> RenderTarget:
        if rendered.image == NONE:
            return rendered
        image = images[rendered.image]
        averages = rendered.role == "color" and image.numeric not in ("UINT", "SINT")
        changed = rendered._replace(
            image=copies[rendered.image], store=STORE if rendered.image in kept else STORE_DONT_CARE
        )
        if rendered.image not in resolved:
            return changed
        mode = AVERAGE if averages else SAMPLE_ZERO
        return changed._replace(
            mode=mode, resolve_image=rendered.image, resolve_layout=rendered.layout
        )

    framebuffers = tuple(
        _with(f, [copies.get(image, image) for image in f.images]) for f in frame_pass.framebuffers
    )
    return frame_pass._replace(
        rendered=tuple(map(target, frame_pass.rendered)), framebuffers=framebuffers
    )


def supersampled(plan: Plan, group: Collection[int], grid: int) -> Plan:
    """A plan whose passes `group` draw to images `grid` times as wide and as high, which are scaled
    down to the described ones where something else uses them, or nothing draws to them any more.
    """
    uses = _Uses(plan, group)
    images = list(plan.images)
    larger: dict[int, int] = {}
    for number in sorted(group):
        for image in {
            i
            for framebuffer in range(len(plan.passes[number].framebuffers))
            for e in attached(plan.passes[number], framebuffer)
            for i in e
        }:
            if image not in larger:
                larger[image] = len(images)
                images.append(_larger(plan.images[image], grid))
    passes = list(plan.passes)
    for number in group:
        frame_pass = passes[number]
        framebuffers = tuple(
            f._replace(
                images=tuple(larger.get(i, i) for i in f.images),
                width=f.width * grid,
                height=f.height * grid,
            )
            for f in frame_pass.framebuffers
        )
        rendered = tuple(
            r._replace(image=larger.get(r.image, r.image)) for r in frame_pass.rendered
        )
        needed = {larger[image] for image in larger if image in frame_pass.images}
        passes[number] = frame_pass._replace(
            attachments=_left_for_drawing(frame_pass, plan.images),
            framebuffers=framebuffers,
            rendered=rendered,
            images=tuple(sorted({*frame_pass.images, *needed})),
        )
    steps: list[Step] = []
    for step in plan.steps:
        if not uses.is_of_group(step):
            steps.append(step)
            continue
        inner = tuple(
            each._replace(rects=tuple(tuple(grid * side for side in rect) for rect in each.rects))
            for each in step.inner
        )
        steps.append(step._replace(area=tuple(grid * side for side in step.area), inner=inner))
        colors, depths = attached(plan.passes[step.number], step.framebuffer)
        for image in (*colors, *depths):
            if image in uses.leaving[step.number] or (
                image in colors and image in uses.last[step.number]
            ):
                images[image] = images[image]._replace(usage=images[image].usage | TRANSFER_TARGET)
                source = images[larger[image]]
                images[larger[image]] = source._replace(usage=source.usage | TRANSFER_SOURCE)
                filter = (
                    LINEAR
                    if image in colors
                    and source.numeric not in ("UINT", "SINT")
                    and source.format not in FLOATS_32
                    else NEAREST
                )
                steps.append(
                    Step("blit", step.number, source=larger[image], target=image, filter=filter)
                )
    return plan._replace(images=tuple(images), passes=tuple(passes), steps=tuple(steps))


def _larger(image: Image, grid: int) -> Image:
    usage = image.usage & (COLOR_ATTACHMENT | DEPTH_ATTACHMENT)
    return image._replace(
        name=f"{image.name} {grid}x{grid}",
        width=image.width * grid,
        height=image.height * grid,
        levels=1,
        flags=0,
        lazy=False,
        usage=usage,
    )


def _left_for_drawing(frame_pass: Pass, images: Sequence[Image]) -> tuple[Attachment, ...]:
    """The attachments of a render pass in the layouts of drawing before and after it: nothing but
    passes and a blit uses their images.
    """
    numbers = frame_pass.framebuffers[0].images if frame_pass.attachments else ()
    changed = []
    for attachment, number in zip(frame_pass.attachments, numbers, strict=True):
        layout = COLOR_LAYOUT if images[number].aspects & COLOR else DEPTH_LAYOUT
        loads = LOAD in (attachment.load, attachment.stencil_load)
        changed.append(
            attachment._replace(
                initial=layout if loads else UNDEFINED,
                final=layout,
                stencil_initial=NONE,
                stencil_final=NONE,
            )
        )
    return tuple(changed)


def unresolved(plan: Plan, passes: Collection[int]) -> Plan | None:
    """The plan without the resolves of some passes and of commands, and without scaling down; None
    where it has none.
    """
    changed = list(plan.passes)
    for number in passes:
        each = changed[number]
        rendered = tuple(target._replace(mode=0, resolve_image=NONE) for target in each.rendered)
        subpasses = tuple(
            subpass._replace(resolves=(), depth_resolve=(), depth_mode=0, stencil_mode=0)
            for subpass in each.subpasses
        )
        changed[number] = each._replace(rendered=rendered, subpasses=subpasses)
    steps = tuple(
        step
        for step in plan.steps
        if step.kind != "resolve" and (step.kind != "blit" or step.number not in passes)
    )
    bare = plan._replace(passes=tuple(changed), steps=steps)
    return bare if bare != plan else None
