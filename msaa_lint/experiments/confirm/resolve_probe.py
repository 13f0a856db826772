"""The resolves of a plan, and the tiny frames that probe them on a device."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.frame.vulkan.formats import Format

from . import parts
from .parts import (
    COLOR,
    COLOR_LAYOUT,
    DEPTH,
    DEPTH_LAYOUT,
    NONE,
    RENDER_PASS,
    RENDERING,
    SAMPLED,
    SCISSOR,
    STENCIL,
    TRANSFER_SOURCE,
    VIEWPORT,
    Attachment,
    Framebuffer,
    Image,
    Pass,
    Pipeline,
    Plan,
    Reference,
    RenderTarget,
    Step,
    Subpass,
)
from .resolve_expected import AVERAGE, ZERO
from .texels import format_name, format_of

COMMAND = "command"
"""Resolving by vkCmdResolveImage; the other ways are the kinds of passes."""

SAMPLES, WITNESS = "samples", "witness"
"""The names of a probe's multisampled images."""

WITNESS_FORMAT = 37
"""VK_FORMAT_R8G8B8A8_UNORM, which supports every sample count that any color format does."""

SIDE, WITNESS_SIDE = 16, 32
"""Width and height in pixels. With a witness, triangles must cover whole pixels."""

LESS = 1
"""VkCompareOp."""


class Resolve(NamedTuple):
    """A way of resolving: in a pass (`renderPass`, `rendering`) or by a `command`; the VkFormat,
    the sample count, the aspects, and the VkResolveModeFlagBits of color or depth (`mode`) and of
    stencil.
    """

    way: str
    format: int
    samples: int
    aspects: int
    mode: int
    stencil_mode: int = 0

    @property
    def modes(self) -> list[tuple[int, int]]:
        """The resolved aspects and their modes."""
        modes = {COLOR: self.mode, DEPTH: self.mode, STENCIL: self.stencil_mode}
        return [(aspect, mode) for aspect, mode in modes.items() if self.aspects & aspect and mode]


class Probe(NamedTuple):
    """A frame with resolves of one format and sample count, each with the number of its pass; each
    resolves into an image named by its index. `seen` are the images whose samples determine the
    expected results.
    """

    plan: Plan
    resolves: tuple[tuple[Resolve, int], ...]
    seen: tuple[str, ...]


def resolves(plan: Plan) -> dict[int, tuple[Resolve, ...]]:
    """The resolves of the passes of a plan, and of the commands after them, by the number of the
    pass.
    """
    by_pass: dict[int, list[Resolve]] = {}
    for number, frame_pass in enumerate(plan.passes):
        if not frame_pass.refused:
            by_pass.setdefault(number, []).extend(
                _of_subpasses(frame_pass)
                if frame_pass.kind == RENDER_PASS
                else _of_rendering(plan, frame_pass)
            )
    for step in plan.steps:
        if step.kind == "resolve" and NONE not in (step.source, step.target):
            source, target = plan.images[step.source], plan.images[step.target]
            if (
                source.samples > 1 == target.samples
                and source.aspects == COLOR
                and source.format == target.format
            ):
                by_pass.setdefault(step.number, []).append(
                    Resolve(
                        COMMAND, source.format, source.samples, COLOR, _color_mode(source.format)
                    )
                )
    return {number: tuple(dict.fromkeys(found)) for number, found in by_pass.items() if found}


def _of_subpasses(frame_pass: Pass) -> Iterator[Resolve]:
    for subpass in frame_pass.subpasses:
        for color, target in zip(subpass.colors, subpass.resolves, strict=False):
            pair = _pair(frame_pass, color, target)
            if pair is not None:
                yield Resolve(
                    RENDER_PASS, pair.format, pair.samples, COLOR, _color_mode(pair.format)
                )
        for depth, target in zip(subpass.depth_stencil, subpass.depth_resolve, strict=False):
            pair = _pair(frame_pass, depth, target)
            if pair is not None and (subpass.depth_mode or subpass.stencil_mode):
                aspects = _aspects(pair.format)
                modes = (
                    subpass.depth_mode if aspects & DEPTH else 0,
                    subpass.stencil_mode if aspects & STENCIL else 0,
                )
                if any(modes):
                    yield Resolve(RENDER_PASS, pair.format, pair.samples, aspects, *modes)


def _pair(frame_pass: Pass, source: Reference, target: Reference) -> Attachment | None:
    """The attachment that is resolved; None if this is not a valid resolve."""
    if NONE in (source.attachment, target.attachment):
        return None
    source_attachment, target_attachment = (
        frame_pass.attachments[source.attachment],
        frame_pass.attachments[target.attachment],
    )
    return (
        source_attachment
        if source_attachment.samples > 1 == target_attachment.samples
        and source_attachment.format == target_attachment.format
        else None
    )


def _of_rendering(plan: Plan, frame_pass: Pass) -> Iterator[Resolve]:
    by_role: dict[str, tuple[Image, int]] = {}
    for r in frame_pass.rendered:
        if NONE in (r.image, r.resolve_image) or not r.mode:
            continue
        source, target = plan.images[r.image], plan.images[r.resolve_image]
        if not source.samples > 1 == target.samples or source.format != target.format:
            continue
        if r.role != "color":
            by_role[r.role] = source, r.mode
        elif r.mode == _color_mode(source.format):
            yield Resolve(RENDERING, source.format, source.samples, COLOR, r.mode)
    if by_role:
        (source, _), *_ = by_role.values()
        aspects = (DEPTH if "depth" in by_role else 0) | (STENCIL if "stencil" in by_role else 0)
        modes = {role: mode for role, (_, mode) in by_role.items()}
        yield Resolve(
            RENDERING,
            source.format,
            source.samples,
            aspects,
            modes.get("depth", 0),
            modes.get("stencil", 0),
        )


def probe(requested: Sequence[Resolve], like: Plan) -> Probe | None:
    """The frame that probes resolves of one format and sample count, on a device opened for another
    plan; None if they cannot be probed.
    """
    format = format_of(format_name(requested[0].format))
    if format is None:
        return None
    witnessed = format.is_integer or any(
        resolve.aspects & STENCIL and resolve.stencil_mode for resolve in requested
    )
    read = not format.is_integer and any(
        resolve.mode and resolve.aspects & (COLOR | DEPTH) for resolve in requested
    )
    frame = _Frame(format, requested, WITNESS_SIDE if witnessed else SIDE, witnessed, read)
    plan = Plan(
        "", frame.images(), frame.passes(), frame.steps(), (), like.extensions, like.without
    )
    return Probe(
        plan, frame.resolves, (*((SAMPLES,) if read else ()), *((WITNESS,) if witnessed else ()))
    )


class _Frame:
    """The parts of a probe's frame. Image 0 is multisampled, the last images are the resolve
    targets.
    """

    def __init__(
        self, form: Format, wanted: Sequence[Resolve], side: int, witnessed: bool, read: bool
    ) -> None:
        self.form, self.wanted, self.side, self.witnessed, self.read = (
            form,
            wanted,
            side,
            witnessed,
            read,
        )
        self.format, self.samples = wanted[0].format, wanted[0].samples
        self.color = "color" in form.aspects
        self.layout = COLOR_LAYOUT if self.color else DEPTH_LAYOUT
        self.first = 2 if witnessed else 1
        inline = [each for each in wanted if each.way != COMMAND]
        commands = [each for each in wanted if each.way == COMMAND]
        # Commands resolve the result of the last pass, because creating pipelines takes most of a
        # probe's time.
        self.drawn = inline or commands[:1]
        self.resolves = (
            *((each, n) for n, each in enumerate(inline)),
            *((each, len(self.drawn) - 1) for each in commands),
        )

    def images(self) -> tuple[Image, ...]:
        aspects = _aspects(self.format)
        usage = parts.COLOR_ATTACHMENT if self.color else parts.DEPTH_ATTACHMENT
        source = TRANSFER_SOURCE if any(each.way == COMMAND for each in self.wanted) else 0

        def image(name: str, samples: int, more: int) -> Image:
            numeric, size = self.form.numeric, self.form.bytes
            return Image(
                name,
                self.format,
                samples,
                usage | more,
                self.side,
                self.side,
                1,
                1,
                1,
                1,
                0,
                0,
                False,
                aspects,
                numeric,
                size,
            )

        made = [image(SAMPLES, self.samples, source | (SAMPLED if self.read else 0))]
        if self.witnessed:
            seen = image(WITNESS, self.samples, 0)
            usage = parts.COLOR_ATTACHMENT
            made.append(
                seen._replace(
                    format=WITNESS_FORMAT,
                    usage=usage | SAMPLED,
                    aspects=COLOR,
                    numeric="UNORM",
                    bytes=4,
                )
            )
        usage = parts.COLOR_ATTACHMENT if self.color else parts.DEPTH_ATTACHMENT
        for number, (each, _) in enumerate(self.resolves):
            made.append(
                image(
                    str(number),
                    1,
                    TRANSFER_SOURCE | (parts.TRANSFER_TARGET if each.way == COMMAND else 0),
                )
            )
        return tuple(made)

    def passes(self) -> tuple[Pass, ...]:
        return tuple(self._pass(number, each) for number, each in enumerate(self.drawn))

    def steps(self) -> tuple[Step, ...]:
        area, scene = (0, 0, self.side, self.side), (parts.PassCommand("draw", 0, 0),)
        begins = [Step("begin", number, 0, area, scene) for number in range(len(self.drawn))]
        resolved = [
            (at, self.first + n)
            for n, (each, at) in enumerate(self.resolves)
            if each.way == COMMAND
        ]
        return (*begins, *(Step("resolve", at, source=0, target=target) for at, target in resolved))

    def _pass(self, number: int, each: Resolve) -> Pass:
        sources = tuple(range(self.first))
        images = sources if each.way == COMMAND else (*sources, self.first + number)
        own = {n + self.first for n, (_, at) in enumerate(self.resolves) if at == number}
        framebuffer = Framebuffer(images, self.side, self.side, 1)
        rendering = each.way == RENDERING
        made = Pass(
            str(number), str(number), RENDERING if rendering else RENDER_PASS,
            0 if rendering else 1 if self.color else 2,
            framebuffers=(framebuffer,), pipelines=(self._pipeline(each),), images=(*sources,
            *sorted(own)),
        )  # fmt: skip
        if rendering:
            return made._replace(rendered=self._rendered(each, self.first + number))
        attachments = [self._attachment(self.samples, parts.CLEAR)]
        if self.witnessed:
            attachments.append(
                attachments[0]._replace(format=WITNESS_FORMAT, initial=0, final=COLOR_LAYOUT)
            )
        if each.way != COMMAND:
            attachments.append(self._attachment(1, parts.LOAD_DONT_CARE))
        return made._replace(attachments=tuple(attachments), subpasses=(self._subpass(each),))

    def _attachment(self, samples: int, load: int) -> Attachment:
        stencil = (
            (load, parts.STORE)
            if "stencil" in self.form.aspects
            else (parts.LOAD_DONT_CARE, parts.STORE_DONT_CARE)
        )
        return Attachment(self.format, samples, 0, load, parts.STORE, *stencil, 0, self.layout)

    def _subpass(self, each: Resolve) -> Subpass:
        own, target = Reference(0, self.layout), Reference(self.first, self.layout)
        beside = (Reference(1, COLOR_LAYOUT),) if self.witnessed else ()
        if not self.color:
            return Subpass(0, (), beside, (), (own,), (target,), each.mode, each.stencil_mode)
        unused = (Reference(NONE),) if self.witnessed else ()
        return Subpass(
            colors=(own, *beside), resolves=(target, *unused) if each.way != COMMAND else ()
        )

    def _rendered(self, each: Resolve, target: int) -> tuple[RenderTarget, ...]:
        roles = {COLOR: "color", DEPTH: "depth", STENCIL: "stencil"}
        modes = {COLOR: each.mode, DEPTH: each.mode, STENCIL: each.stencil_mode}
        own = [
            RenderTarget(
                role,
                0,
                self.layout,
                modes[aspect],
                *((target, self.layout) if modes[aspect] else (NONE, 0)),
                parts.CLEAR,
                parts.STORE,
            )
            for aspect, role in roles.items()
            if each.aspects & aspect
        ]
        beside = (
            [RenderTarget("color", 1, COLOR_LAYOUT, 0, NONE, 0, parts.CLEAR, parts.STORE)]
            if self.witnessed
            else []
        )
        return (*own, *beside)

    def _pipeline(self, each: Resolve) -> Pipeline:
        """A pipeline that draws the scene into the image and the witness."""
        numerics = ((self.form.numeric,) if self.color else ()) + (
            ("UNORM",) if self.witnessed else ()
        )
        formats = ((self.format,) if self.color else ()) + (
            (WITNESS_FORMAT,) if self.witnessed else ()
        )
        rendering = each.way == RENDERING
        depth, stencil = bool(each.aspects & DEPTH), bool(each.aspects & STENCIL)
        return Pipeline(
            "scene", 0, self.samples, dynamic=(VIEWPORT, SCISSOR), depth_test=depth,
            depth_write=depth, depth_compare=LESS,
            stencil_test=stencil, blends=tuple(parts.Blend() for _ in numerics), numerics=numerics,
            formats=formats if rendering else (),
            depth_format=self.format if rendering and depth else 0,
            stencil_format=self.format if rendering and stencil else 0,
        )  # fmt: skip


def _color_mode(number: int) -> int:
    """The resolve mode of colors: SAMPLE_ZERO for integers, AVERAGE for everything else."""
    form = format_of(format_name(number))
    return ZERO if form is not None and form.is_integer else AVERAGE


def _aspects(number: int) -> int:
    form = format_of(format_name(number))
    bits = {"color": COLOR, "depth": DEPTH, "stencil": STENCIL}
    return sum(bits[each] for each in form.aspects) if form is not None else 0
