"""Plans with another size or sample count."""

from __future__ import annotations

from collections.abc import Collection

from .parts import NONE, STORE, TRANSIENT, Framebuffer, Image, Pass, Plan, Reference, Step, Subpass

CUBE_COMPATIBLE = 0x10
"""VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT."""

MAX_IMAGE = 512
"""Maximum width and height of a picture in texels."""


def resized(plan: Plan, size: tuple[int, int], passes: Collection[int] = ()) -> Plan:
    """A plan whose largest pass, of all or of the numbered ones, has a size in pixels, with
    everything else in proportion.
    """
    framebuffers = [
        f for number in passes or range(len(plan.passes)) for f in plan.passes[number].framebuffers
    ]
    width = max([f.width for f in framebuffers] or [i.width for i in plan.images] or [1])
    height = max([f.height for f in framebuffers] or [i.height for i in plan.images] or [1])
    return _scaled(plan, (size[0], width), (size[1], height))


def pictured(plan: Plan, largest: int = MAX_IMAGE) -> Plan:
    """A plan for a picture: at most `largest` texels wide and high, in the described proportion."""
    side = max([max(i.width, i.height) for i in plan.images] or [1])
    return plan if side <= largest else _scaled(plan, (largest, side), (largest, side))


def _scaled(plan: Plan, by_x: tuple[int, int], by_y: tuple[int, int]) -> Plan:
    def across(value: int) -> int:
        return max(1, value * by_x[0] // by_x[1])

    def down(value: int) -> int:
        return max(1, value * by_y[0] // by_y[1])

    def image(each: Image) -> Image:
        width, height = across(each.width), down(each.height) if each.type else each.height
        if each.flags & CUBE_COMPATIBLE:
            # The faces of a cube are square; views and framebuffers may be smaller than the image.
            width = height = max(width, height)
        levels = (
            min(each.levels, max(width, height, each.depth).bit_length())
            if each.levels <= _most_levels(each)
            else each.levels
        )
        return each._replace(width=width, height=height, levels=levels)

    def framebuffer(each: Framebuffer) -> Framebuffer:
        return each._replace(width=across(each.width), height=down(each.height))

    def rect(
        each: tuple[int, ...], before: tuple[int, ...], area: tuple[int, ...]
    ) -> tuple[int, ...]:
        # A rectangle that covers part of the render area still does when it is smaller.
        scaled = []
        for axis, by in ((0, by_x), (1, by_y)):
            begin, end = (
                max(each[axis], before[axis]),
                min(each[axis] + each[axis + 2], before[axis] + before[axis + 2]),
            )
            far = area[axis] + area[axis + 2]
            low = (
                area[axis]
                if begin == before[axis]
                else min(max(begin * by[0] // by[1], area[axis] + 1), far)
            )
            high = (
                far
                if end == before[axis] + before[axis + 2]
                else min(end * by[0] // by[1], far - 1)
            )
            scaled.append((low, max(high - low, 0)))
        return scaled[0][0], scaled[1][0], scaled[0][1], scaled[1][1]

    def step(each: Step) -> Step:
        if not each.area:
            return each
        x, y, width, height = each.area
        whole = framebuffer(plan.passes[each.number].framebuffers[each.framebuffer])
        left, top = (
            min(x * by_x[0] // by_x[1], whole.width - 1),
            min(y * by_y[0] // by_y[1], whole.height - 1),
        )
        right, bottom = min(across(x + width), whole.width), min(down(y + height), whole.height)
        area = (left, top, max(1, right - left), max(1, bottom - top))
        inner = tuple(
            each._replace(rects=tuple(rect(r, (x, y, width, height), area) for r in each.rects))
            for each in each.inner
        )
        return each._replace(area=area, inner=inner)

    passes = tuple(
        each._replace(framebuffers=tuple(map(framebuffer, each.framebuffers)))
        for each in plan.passes
    )
    return plan._replace(
        images=tuple(map(image, plan.images)), passes=passes, steps=tuple(map(step, plan.steps))
    )


def _most_levels(image: Image) -> int:
    """The number of levels of a complete mip chain."""
    return max(image.width, image.height, image.depth).bit_length()


def resampled(plan: Plan, samples: int) -> Plan:
    """A plan with `samples` instead of every described sample count above one.

    With one sample, passes draw directly to what their attachments are resolved to, in the pass or
    by a command. A resolve command becomes a copy if the frame uses its two images differently
    besides.
    """
    if samples == 1:
        for source, target in _replaceable(plan):
            plan = _replaced(plan, source, target)

    def count(stated: int) -> int:
        return samples if stated > 1 else stated

    def single(stated: int) -> int:
        # Multisampled rendering to single-sampled attachments needs more than one sample.
        return count(stated) if samples > 1 else 0

    def made(each: Pass) -> Pass:
        each = each._replace(
            attachments=tuple(a._replace(samples=count(a.samples)) for a in each.attachments),
            pipelines=tuple(p._replace(samples=count(p.samples)) for p in each.pipelines),
            single_sampled=single(each.single_sampled),
            subpasses=tuple(
                s._replace(single_sampled=single(s.single_sampled)) for s in each.subpasses
            ),
        )
        return _unresolved(each) if samples == 1 else each

    steps = tuple(
        step._replace(
            inner=tuple(
                i._replace(value=count(i.value)) if i.kind == "samples" else i for i in step.inner
            )
        )
        for step in plan.steps
    )
    if samples == 1:
        steps = tuple(
            step._replace(kind="copy") if step.kind == "resolve" else step for step in steps
        )
    images = tuple(each._replace(samples=count(each.samples)) for each in plan.images)
    return plan._replace(images=images, passes=tuple(map(made, plan.passes)), steps=steps)


def _unresolved(each: Pass) -> Pass:
    """A single-sampled pass that draws directly to its resolve targets."""
    instead: dict[int, int] = {}
    for subpass in each.subpasses:
        for color, resolved in zip(subpass.colors, subpass.resolves, strict=False):
            if NONE not in (color.attachment, resolved.attachment):
                instead.setdefault(color.attachment, resolved.attachment)
        for depth, resolved in zip(subpass.depth_stencil, subpass.depth_resolve, strict=False):
            if subpass.depth_mode or subpass.stencil_mode:
                instead.setdefault(depth.attachment, resolved.attachment)
    attachments = list(each.attachments)
    for source, target in instead.items():
        own, other = attachments[source], attachments[target]
        attachments[target] = other._replace(
            load=own.load, stencil_load=own.stencil_load, initial=own.initial, store=STORE
        )

    def reference(stated: Reference) -> Reference:
        return stated._replace(attachment=instead.get(stated.attachment, stated.attachment))

    def subpass_of(own: Subpass) -> Subpass:
        used = {reference(r).attachment for r in (*own.colors, *own.inputs, *own.depth_stencil)}
        kept = dict.fromkeys(instead.get(p, p) for p in own.preserves)
        return own._replace(
            colors=tuple(map(reference, own.colors)),
            inputs=tuple(map(reference, own.inputs)),
            depth_stencil=tuple(map(reference, own.depth_stencil)),
            resolves=(),
            depth_resolve=(),
            depth_mode=0,
            stencil_mode=0,
            preserves=tuple(p for p in kept if p not in used),
        )

    rendered = tuple(
        r._replace(
            image=r.resolve_image, resolve_image=NONE, mode=0, layout=r.resolve_layout, store=STORE
        )
        if r.resolve_image != NONE and r.mode
        else r._replace(mode=0)
        for r in each.rendered
    )
    return each._replace(
        attachments=tuple(attachments),
        subpasses=tuple(map(subpass_of, each.subpasses)),
        rendered=rendered,
    )


def images_of(plan: Plan, step: Step) -> set[int]:
    """The images that a step draws to, resolves to, reads, or transfers."""
    numbers = {step.source, step.target, *(inner.image for inner in step.inner)}
    if step.kind == "begin":
        frame_pass = plan.passes[step.number]
        numbers |= set(frame_pass.framebuffers[step.framebuffer].images)
        numbers |= {
            number
            for rendered in frame_pass.rendered
            for number in (rendered.image, rendered.resolve_image)
        }
    return numbers - {NONE}


def _replaceable(plan: Plan) -> list[tuple[int, int]]:
    """The images that resolve commands read, each with the image that can take its place: the only
    one that it is resolved to, not used before that, with nothing that uses the first one
    afterward.
    """
    resolves = [
        (position, step) for position, step in enumerate(plan.steps) if step.kind == "resolve"
    ]
    pairs = {(step.source, step.target) for _, step in resolves}
    uses = [images_of(plan, step) for step in plan.steps]
    found = []
    for source, target in sorted(pairs):
        one, other = plan.images[source], plan.images[target]
        alike = one._replace(name="", samples=0, usage=0, lazy=False) == other._replace(
            name="", samples=0, usage=0, lazy=False
        )
        last = max(
            position
            for position, step in resolves
            if (step.source, step.target) == (source, target)
        )
        alone = sum(bool({source, target} & set(pair)) for pair in pairs) == 1
        before = any(
            target in used
            for used, step in zip(uses[:last], plan.steps, strict=False)
            if (step.source, step.target) != (source, target)
        )
        if (
            alike
            and alone
            and one.samples > 1
            and other.samples == 1
            and not before
            and not any(source in used for used in uses[last + 1 :])
        ):
            found.append((source, target))
    return found


def _replaced(plan: Plan, source: int, target: int) -> Plan:
    """A plan that uses an image in place of another, without the resolves between them."""

    def number(stated: int) -> int:
        return target if stated == source else stated

    def pass_of(each: Pass) -> Pass:
        framebuffers = tuple(
            f._replace(images=tuple(map(number, f.images))) for f in each.framebuffers
        )
        rendered = tuple(r._replace(image=number(r.image)) for r in each.rendered)
        return each._replace(
            framebuffers=framebuffers,
            rendered=rendered,
            images=tuple(sorted(set(map(number, each.images)))),
        )

    def step_of(each: Step) -> Step:
        inner = tuple(i._replace(image=number(i.image)) for i in each.inner)
        # The layouts of transfers are those of the resolve; a barrier is for the drawing that takes
        # its place.
        layouts = tuple((i, old, new) for i, old, new in each.layouts if i not in (source, target))
        masks = each.masks if layouts == each.layouts else _ALL_WORK
        return each._replace(
            inner=inner,
            source=number(each.source),
            target=number(each.target),
            layouts=layouts,
            masks=masks,
        )

    images = list(plan.images)
    images[target] = images[target]._replace(
        usage=images[target].usage | images[source].usage & ~TRANSIENT
    )
    steps = [
        step
        for step in plan.steps
        if (step.kind, step.source, step.target) != ("resolve", source, target)
    ]
    return plan._replace(
        images=tuple(images),
        passes=tuple(map(pass_of, plan.passes)),
        steps=tuple(map(step_of, steps)),
    )


_ALL_WORK = (0x10000, 0x10000, 0x10000, 0x18000)
"""The masks of a barrier between all commands, of all writes with all accesses."""
