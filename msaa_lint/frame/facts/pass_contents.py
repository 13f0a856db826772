"""Facts of what a pass records: whether its draws touch an attachment, what it clears before them,
whether they have an edge.

A pass in which neither a draw nor a clear is recorded says nothing of what it draws.
"""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    ClearAttachment,
    ClearAttachments,
    ColorBlendAttachment,
    Draw,
    Pipeline,
    ReadImage,
    Rect,
)

from .contents import Contents
from .facts import Facts, known
from .frame import Frame
from .parts import RENDER_PASS, Aspect, Attachment, Pass, PassSubpass
from .pass_begin import max_uses, targets_at
from .walk import Walk

_DYNAMIC_MASKS = frozenset({"COLOR_WRITE_MASK_EXT", "COLOR_WRITE_ENABLE_EXT"})
_DYNAMIC_BLENDING = _DYNAMIC_MASKS | {
    "COLOR_BLEND_ENABLE_EXT",
    "COLOR_BLEND_EQUATION_EXT",
    "COLOR_BLEND_ADVANCED_EXT",
}
_DYNAMIC_DEPTH = frozenset({"DEPTH_TEST_ENABLE", "DEPTH_WRITE_ENABLE", "DEPTH_COMPARE_OP"})
_DYNAMIC_SAMPLES = frozenset({"SAMPLE_MASK_EXT", "ALPHA_TO_COVERAGE_ENABLE_EXT"})
_FACTORED = ("ADD", "SUBTRACT", "REVERSE_SUBTRACT")
_FETCHING = frozenset(
    {
        "VK_EXT_shader_tile_image",
        "VK_ARM_rasterization_order_attachment_access",
        "VK_EXT_rasterization_order_attachment_access",
    }
)
"""What lets shaders read attachments of which no state tells."""
_FULL_SCREEN = (3, 6)
"""Vertices of one triangle that covers the picture, or of two."""


class Clear(NamedTuple):
    """One entry of a recorded vkCmdClearAttachments: in which subpass, after how many draws, and
    where.
    """

    subpass: int
    draws: int
    cleared: ClearAttachment
    rects: tuple[Rect, ...]


class Instance:
    """What is recorded between one begin of a pass and its end."""

    def __init__(self, position: int) -> None:
        self.position = position
        self.draws = 0
        self.drawn: dict[int, dict[int, Pipeline | None]] = {}
        """By subpass: the pipelines of its draws, by identity; None where a draw names none."""
        self.first: dict[int, int] = {}
        """By subpass: how many draws came before its first."""
        self.drawn_at: dict[int, Span] = {}
        """By subpass: where that is recorded."""
        self.full_screen: dict[int, bool | None] = {}
        """By subpass: whether every draw in it covers the picture with a triangle or two, without
        an edge within.
        """
        self.clears: list[Clear] = []
        self.read: set[str] = set()
        """The images that shaders read meanwhile."""
        self.reads_samples = False
        """Whether one of them has several samples, or may have, which a shader could go through one
        by one.
        """

    @property
    def says(self) -> bool:
        """Whether anything is recorded of what it draws."""
        return bool(self.draws or self.clears)


class PassContents(dict[str, list[Instance]]):
    """By the path of a pass: what is recorded each time that it is begun.

    `exhausted` says that passes are left out, because there is too much to look through.
    """

    exhausted = False


def pass_contents(walk: Walk) -> PassContents:
    """What the commands record in passes; renderings of which a part is recorded elsewhere are left
    out.
    """
    frame = walk.frame
    found: dict[str, list[Instance]] = {}
    for position, run in walk.recorded_runs.items():
        if run.render_pass.suspends or run.render_pass.resumes:
            continue
        instance = Instance(position)
        found.setdefault(run.render_pass.path, []).append(instance)
        for subpass, command in run.commands:
            body = command.body
            if isinstance(body, Draw):
                _draw(instance, body, run.render_pass, subpass, frame)
            elif isinstance(body, ClearAttachments):
                instance.clears += [
                    Clear(subpass, instance.draws, cleared, body.rects)
                    for cleared in body.attachments
                ]
            elif isinstance(body, ReadImage) and body.image is not None:
                instance.read.add(body.image)
                read = frame.target(body.image)
                instance.reads_samples = instance.reads_samples or read is None or read.samples != 1
    passes = (render_pass for render_pass in frame.passes if render_pass.path in found)
    allowance = Allowance(max_uses(frame))
    contents = PassContents(
        {
            each.path: found[each.path]
            for each in passes
            if allowance.take(_work(each, found[each.path]))
        }
    )
    contents.exhausted = allowance.exhausted
    return contents


def _work(render_pass: Pass, instances: list[Instance]) -> int:
    """How much is looked through for the attachments of a pass: it grows faster than the input
    does.
    """
    recorded = sum(
        1 + len(i.clears) + len(i.read) + sum(len(pipelines) for pipelines in i.drawn.values())
        for i in instances
    )
    return len(render_pass.attachments) * (
        recorded
        + sum(len(subpass.color) + len(subpass.depth_stencil) for subpass in render_pass.subpasses)
    )


def _draw(current: Instance, draw: Draw, render_pass: Pass, subpass: int, frame: Frame) -> None:
    pipeline = frame.description.pipelines.get(draw.pipeline or "")
    tests = subpass < len(render_pass.subpasses) and bool(
        render_pass.subpasses[subpass].depth_stencil
    )
    current.drawn.setdefault(subpass, {})[id(pipeline)] = pipeline
    current.first.setdefault(subpass, current.draws)
    current.drawn_at.setdefault(subpass, draw.head)
    current.full_screen[subpass] = known(
        current.full_screen.get(subpass, True), covers_picture(draw, pipeline, tests)
    )
    current.draws += 1


def touch_facts(
    facts: Facts,
    render_pass: Pass,
    attachment: Attachment,
    aspect: Aspect,
    instances: list[Instance],
    frame: Frame,
) -> None:
    """Adds whether anything in the pass touches an aspect, and whether the pass clears it by a
    command before it draws.
    """
    untouched = not (attachment.used or render_pass.unread)
    is_read = frame.document.complete and not render_pass.unread
    if attachment.used and is_read and instances and facts.values.get("aspect.resolved") is False:
        untouched = _untouched(render_pass, attachment, aspect, instances, frame)
    if attachment.used or (
        not render_pass.unread and (render_pass.subpasses or frame.document.whole)
    ):
        facts.put("aspect.untouched", untouched)
    if untouched:
        needs = (
            aspect.store_member
            if aspect.store == "STORE" and aspect.load != "LOAD"
            else aspect.load_member
        )
        facts.places["aspect.untouched"] = (
            attachment.record.place(needs) if attachment.used else attachment.record.head
        )
    cleared = (
        [_cleared(render_pass, attachment, aspect, instance, frame) for instance in instances]
        if attachment.drawn
        else []
    )
    first = cleared[0] if cleared and None not in cleared else None
    facts.put("aspect.clears_in_pass", first is not None)
    facts.put("aspect.cleared_by_command", first is not None, first)
    if first is not None:
        facts.put("aspect.clear_command", "clearAttachments", first)


def _untouched(
    render_pass: Pass,
    attachment: Attachment,
    aspect: Aspect,
    instances: list[Instance],
    frame: Frame,
) -> bool:
    """Whether the draws and clears that are recorded leave an aspect as it was; false where that is
    not known.
    """
    enabled = frame.description.enabled
    fetches = enabled is not None and not _FETCHING.isdisjoint(enabled.extensions or ())
    depth_bounds = enabled is not None and "depthBounds" in (enabled.features or ())
    if (
        not instances
        or attachment.input
        or attachment.rate
        or attachment.resolve
        or aspect.name is None
        or fetches
    ):
        return False
    for instance in instances:
        if not instance.says or not instance.read.isdisjoint(
            t.name for t in targets_at(frame, attachment, instance.position)
        ):
            return False
        if any(_clears(render_pass, clear, attachment, aspect) for clear in instance.clears):
            return False
        for index in attachment.color | attachment.depth_stencil:
            pipelines = instance.drawn.get(index, {}).values()
            slots = (
                [n for n, own in enumerate(render_pass.subpasses[index].color) if own is attachment]
                if pipelines
                else []
            )
            if any(
                _touches(pipeline, slots, aspect, depth_bounds) is not False
                for pipeline in pipelines
            ):
                return False
    return True


def _touches(
    pipeline: Pipeline | None, slots: list[int], aspect: Aspect, depth_bounds: bool
) -> bool | None:
    """Whether a draw may read or write an aspect, by its pipeline's state; None where the state is
    not stated.

    `slots` are the indices at which the subpass has the attachment as a color attachment.
    `depth_bounds`: the application enables the feature depthBounds, without which
    depthBoundsTestEnable is false
    (VUID-VkPipelineDepthStencilStateCreateInfo-depthBoundsTestEnable-00598).
    """
    if pipeline is None:
        return None
    dynamic, raster = pipeline.dynamicState, pipeline.rasterizationState
    if (
        raster is not None
        and raster.rasterizerDiscardEnable
        and "RASTERIZER_DISCARD_ENABLE" not in dynamic
    ):
        return False
    if aspect.name == "color":
        blend = pipeline.colorBlendState
        if (
            blend is None
            or not _DYNAMIC_MASKS.isdisjoint(dynamic)
            or any(n >= len(blend.attachments) for n in slots)
        ):
            return None
        masks = [blend.attachments[n].colorWriteMask for n in slots]
        return True if any(masks) else None if None in masks else False
    state = pipeline.depthStencilState
    if state is None:
        return None
    tests = [(state.stencilTestEnable, "STENCIL_TEST_ENABLE")]
    if aspect.name == "depth":
        bounds = state.depthBoundsTestEnable
        if bounds is None and state.depthWriteEnable is False and not depth_bounds:
            # A pipeline that states both depth tests and depth writes as off has stated all that it
            # does with depth.
            bounds = False
        tests = [(state.depthTestEnable, "DEPTH_TEST_ENABLE"), (bounds, "DEPTH_BOUNDS_TEST_ENABLE")]
    answers = [None if name in dynamic else enabled for enabled, name in tests]
    return True if True in answers else None if None in answers else False


def put_undefined_use(
    facts: Facts,
    render_pass: Pass,
    attachment: Attachment,
    aspect: Aspect,
    instances: list[Instance],
    frame: Frame,
) -> None:
    """Adds what uses contents of an aspect that the pass neither loaded nor cleared, before
    anything in the pass writes it.

    "VK_ATTACHMENT_LOAD_OP_NONE specifies that the previous contents of the image will be undefined
    inside the render pass", and after DONT_CARE they are undefined inside the render area
    (VkAttachmentLoadOp).
    """
    if aspect.load is None:
        return
    use: _Use | None = None
    if aspect.load in ("NONE", "DONT_CARE") and aspect.name is not None and not attachment.resolve:
        uses = (
            _undefined_use(render_pass, attachment, aspect, instance, frame)
            for instance in instances
        )
        use = next(filter(None, uses), None)
        if (
            use is None
            and not any(instance.says for instance in instances)
            and frame.document.whole
        ):
            use = _by_every_pipeline(render_pass, attachment, aspect, frame)
    facts.put("aspect.undefined_used", use is not None, attachment.record.place(aspect.load_member))
    if use is not None:
        facts.put("aspect.undefined_user", *use)


_Use = tuple[str, Span | None]
"""The pipeline of a draw, or a command, and where it is stated."""


def _undefined_use(
    render_pass: Pass, attachment: Attachment, aspect: Aspect, instance: Instance, frame: Frame
) -> _Use | None:
    """What certainly uses the contents that a pass found, as far as its draws are recorded."""
    if any(_clears(render_pass, clear, attachment, aspect) for clear in instance.clears):
        return None
    names = {target.name for target in targets_at(frame, attachment, instance.position)}
    if attachment.input and not attachment.drawn and not instance.read.isdisjoint(names):
        return "readImage", None
    for index in sorted(attachment.color | attachment.depth_stencil):
        slots = [n for n, own in enumerate(render_pass.subpasses[index].color) if own is attachment]
        for pipeline in instance.drawn.get(index, {}).values():
            if pipeline is not None and _uses_contents(pipeline, slots, aspect):
                return pipeline.key, pipeline.head
            if _touches(pipeline, slots, aspect, True) is not False:
                return None
    return None


def _by_every_pipeline(
    render_pass: Pass, attachment: Attachment, aspect: Aspect, frame: Frame
) -> _Use | None:
    """The first of the pipelines of the first subpass that draws to an attachment, if every one
    uses what it finds there.
    """
    first = min(attachment.color | attachment.depth_stencil, default=None)
    if first is None:
        return None
    slots = [n for n, own in enumerate(render_pass.subpasses[first].color) if own is attachment]
    pipelines = frame.pipelines_of(render_pass, first)
    if not all(
        pipeline is not None and _uses_contents(pipeline, slots, aspect) for pipeline in pipelines
    ):
        return None
    return next(
        ((pipeline.key, pipeline.head) for pipeline in pipelines if pipeline is not None), None
    )


def _uses_contents(pipeline: Pipeline, slots: list[int], aspect: Aspect) -> bool:
    """Whether what a draw makes certainly depends on what it finds in an aspect.

    The comparison of a stencil test is not described. Blending over what DONT_CARE left may add
    nothing of it where the source is opaque.
    """
    dynamic, raster = pipeline.dynamicState, pipeline.rasterizationState
    if raster is not None and (
        raster.rasterizerDiscardEnable or "RASTERIZER_DISCARD_ENABLE" in dynamic
    ):
        return False
    if aspect.name == "depth":
        state = pipeline.depthStencilState
        if state is None or not _DYNAMIC_DEPTH.isdisjoint(dynamic):
            return False
        # A test that does not write is for its comparison.
        compares = (
            state.depthCompareOp not in ("ALWAYS", "NEVER")
            if state.depthCompareOp is not None
            else state.depthWriteEnable is False
        )
        return bool(state.depthTestEnable) and compares
    blend = pipeline.colorBlendState
    if (
        aspect.name != "color"
        or aspect.load != "NONE"
        or blend is None
        or not _DYNAMIC_BLENDING.isdisjoint(dynamic)
    ):
        return False
    return any(n < len(blend.attachments) and _blends(blend.attachments[n]) for n in slots)


def _blends(state: ColorBlendAttachment) -> bool:
    """Whether blending that writes certainly takes something from the attachment."""
    equations = (
        (state.colorBlendOp, state.srcColorBlendFactor, state.dstColorBlendFactor, {"R", "G", "B"}),
        (state.alphaBlendOp, state.srcAlphaBlendFactor, state.dstAlphaBlendFactor, {"A"}),
    )
    if not state.blendEnable:
        return False
    return any(
        not components.isdisjoint(state.colorWriteMask or ())
        and (
            op in ("MIN", "MAX")
            or (op in _FACTORED and ("DST" in (source or "") or destination not in (None, "ZERO")))
        )
        for op, source, destination, components in equations
    )


def _clears(render_pass: Pass, clear: Clear, attachment: Attachment, aspect: Aspect) -> bool:
    """Whether a clear is of an aspect, or may be."""
    if clear.subpass >= len(render_pass.subpasses):
        return False
    subpass, entry = render_pass.subpasses[clear.subpass], clear.cleared
    if aspect.name == "color":
        if "COLOR" not in entry.aspect:
            return False
        index = entry.colorAttachment
        return (
            bool(attachment.color)
            if index is None
            else index < len(subpass.color) and subpass.color[index] is attachment
        )
    return attachment in subpass.depth_stencil and (aspect.name or "depth").upper() in entry.aspect


def _cleared(
    render_pass: Pass, attachment: Attachment, aspect: Aspect, instance: Instance, frame: Frame
) -> Span | None:
    """Where a clear of the whole of an aspect is recorded before any draw in a subpass that uses
    it; None where there is none.
    """
    if not instance.clears:
        return None
    uses = attachment.color | attachment.depth_stencil | attachment.input | set(attachment.resolve)
    earliest = min(
        (instance.first[index] for index in uses if index in instance.first), default=instance.draws
    )
    for clear in instance.clears:
        if clear.draws > earliest:
            return None
        if (
            _clears(render_pass, clear, attachment, aspect)
            and clear.cleared.aspect
            and _is_whole(render_pass, attachment, clear, instance, frame)
        ):
            return clear.cleared.place("aspect")
    return None


def _is_whole(
    render_pass: Pass, attachment: Attachment, clear: Clear, instance: Instance, frame: Frame
) -> bool:
    """Whether a clear is certain to cover the render area, in every layer."""
    if clear.cleared.aspect == ("COLOR",) and clear.cleared.colorAttachment is None:
        return False
    area, layers = _area(render_pass, attachment, instance, frame)
    if area is None or layers != 1:
        return False
    left, top, right, bottom = area
    for rect in clear.rects:
        if None in (rect.width, rect.height):
            continue
        x, y = rect.x or 0, rect.y or 0
        if (
            x <= left
            and y <= top
            and x + (rect.width or 0) >= right
            and y + (rect.height or 0) >= bottom
        ):
            return True
    return False


def _area(
    render_pass: Pass, attachment: Attachment, instance: Instance, frame: Frame
) -> tuple[tuple[int, int, int, int] | None, int]:
    """The render area that a pass is begun with, the whole of what it renders to where none is
    stated; and its layers.
    """
    body = frame.commands[instance.position].body
    buffers = frame.framebuffers_of(body)
    if not buffers and render_pass.kind == RENDER_PASS:
        buffers = frame.framebuffers.get(render_pass.name, [])
    layers = max(
        [getattr(body, "layerCount", None) or 1, *(buffer.layers or 1 for buffer in buffers)]
    )
    area = getattr(body, "renderArea", None)
    if area is not None:
        if area.width is None or area.height is None:
            return None, layers
        return (
            area.x or 0,
            area.y or 0,
            (area.x or 0) + area.width,
            (area.y or 0) + area.height,
        ), layers
    targets = attachment.targets if not attachment.only_rate else ()
    extents = [
        target.image.extent
        for target in targets
        if target.image is not None and target.image.extent is not None
    ]
    for sized in (*buffers, *extents, frame.description.frame):
        if sized is not None and sized.width is not None and sized.height is not None:
            return (0, 0, sized.width, sized.height), layers
    return None, layers


def covers_picture(draw: Draw, pipeline: Pipeline | None, tests: bool) -> bool | None:
    """Whether a draw is of a triangle or two without vertex data, all of whose samples are the
    same; None where that is not stated.

    `tests`: there is depth or stencil to test against.
    """
    count = draw.vertexCount if draw.vertexCount is not None else draw.indexCount
    one = draw.instanceCount == 1 if draw.instanceCount is not None else None
    size = count in _FULL_SCREEN if count is not None else None
    if pipeline is None:
        return known(size, one, None)
    dynamic, multisample, vertices = (
        pipeline.dynamicState,
        pipeline.multisampleState,
        pipeline.vertexInputState,
    )
    empty = None
    if vertices is not None and "VERTEX_INPUT_EXT" not in dynamic:
        empty = not (vertices.vertexBindingDescriptions or vertices.vertexAttributeDescriptions)
    untested: list[bool | None] = []
    for member, state in (
        (("depthTestEnable", "DEPTH_TEST_ENABLE"), ("stencilTestEnable", "STENCIL_TEST_ENABLE"))
        if tests
        else ()
    ):
        enabled = getattr(pipeline.depthStencilState, member, None)
        untested.append(None if enabled is None or state in dynamic else not enabled)
    alike: list[bool | None] = [None]
    if multisample is not None:
        alike = [
            not on if on is not None else None
            for on in (multisample.sampleShadingEnable, multisample.alphaToCoverageEnable)
        ]
        alike.append(
            _whole_mask(multisample.sampleMask, multisample.rasterizationSamples)
            and _DYNAMIC_SAMPLES.isdisjoint(dynamic)
        )
    return known(size, one, empty, *untested, *alike)


def _whole_mask(mask: tuple[int, ...], samples: int | None) -> bool:
    """Whether a sample mask lets every sample through, as none does."""
    return not mask or (
        samples is not None
        and samples <= 32
        and mask[0] & ((1 << samples) - 1) == (1 << samples) - 1
    )


def screen_facts(
    facts: Facts, subpass: PassSubpass, instances: list[Instance], contents: Contents
) -> None:
    """Adds whether all that a subpass draws is the whole picture, with nothing before it that had
    an edge.
    """
    whole = bool(instances) and all(
        instance.full_screen.get(subpass.index) is True and not instance.reads_samples
        for instance in instances
    )
    whole = whole and contents.timeline.ordered and not subpass.render_pass.custom_resolve
    reads = whole and all(instance.read for instance in instances)
    for attachment in (a for a in subpass.color if a is not None) if whole else ():
        alone = attachment.color | attachment.depth_stencil | attachment.input == {subpass.index}
        fresh = all(
            aspect.load == "DONT_CARE" or (aspect.load == "CLEAR" and reads)
            for aspect in attachment.aspects
        )
        lines = (
            contents.of(target.name, "color")
            for target in attachment.targets
            if target.image is not None
        )
        whole = whole and alone and fresh and all(line.never_loads for line in lines)
    at = instances[0].drawn_at.get(subpass.index) if instances else None
    facts.put(
        "subpass.full_screen",
        whole and any(attachment is not None for attachment in subpass.color),
        at,
    )
