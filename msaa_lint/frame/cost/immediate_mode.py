"""What a pass moves on an immediate-mode GPU, by plain arithmetic: exact bytes of one frame.

Such a GPU writes what it draws to memory, whatever the store operation, and loads nothing when a
pass begins: load and store operations are hints to its driver. A resolve in the pass reads the
samples and writes one value each. Each pixel counts as drawn once; overdraw, tests, blending,
clears, and compression are not known and not counted.
"""

from __future__ import annotations

from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.parts import Attachment, Pass, Resolve

from .sizes import Area
from .traffic import NOT_STATED, Lines, Stored, aspect_bytes, pass_pixels, resolve_write

ASSUMED = (
    "{} is an immediate-mode GPU: a pass writes each sample that it draws once, and its resolves "
    "read the samples; load and store"
    " operations are hints to the driver; overdraw, tests, blending, clears, and compression are "
    "not known"
)


def immediate_lines(render_pass: Pass, area: Area, device: DeviceProfile) -> Lines:
    """What a pass draws and resolves, all the times that a frame begins it."""
    lines = Lines(device)
    if not area.sized:
        lines.missing("its size is not stated: write `frame: {width: ..., height: ...}`")
    if area.times == 0 or area.width is None:
        return lines
    implicit = _implicit_samples(render_pass, lines)
    for attachment in render_pass.attachments:
        _attachment(lines, render_pass, attachment, area, implicit.get(id(attachment)))
    if not render_pass.suspends:
        for resolve in render_pass.resolves:
            _resolve(lines, render_pass, resolve, area)
    return lines


def _implicit_samples(render_pass: Pass, lines: Lines) -> dict[int, int]:
    """The sample counts at which single-sampled attachments are drawn
    (multisampledRenderToSingleSampled), by their identity.
    """
    found: dict[int, int] = {}
    for subpass in render_pass.subpasses:
        if not subpass.single_sampled:
            continue
        if subpass.single_sampled_count is None:
            lines.missing("how many samples it draws: rasterizationSamples is not stated")
            continue
        for attachment in (*subpass.color, *subpass.depth_stencil):
            if attachment is not None and attachment.samples == 1:
                found[id(attachment)] = subpass.single_sampled_count
    return found


def _attachment(
    lines: Lines, render_pass: Pass, attachment: Attachment, area: Area, implicit: int | None
) -> None:
    """What is drawn to an attachment and read from it as an input; of one with implicit samples,
    also their resolve.
    """
    # A resumed rendering goes on with what the suspended one draws.
    drawn = attachment.drawn and not render_pass.resumes
    actions = []
    for aspect in attachment.aspects:
        name = aspect.name or "color"
        # storeOp NONE is that of an attachment which the pass does not write.
        if drawn and aspect.store != "NONE":
            actions.append((name, "write", "write", implicit or attachment.samples))
            if implicit is not None:
                actions += [(name, "resolve", "read", implicit), (name, "resolve", "write", 1)]
        if attachment.input:
            actions.append((name, "input", "read", attachment.samples))
    for name, action, direction, samples in actions:
        _add(lines, render_pass, attachment, name, action, direction, samples, area)


def _resolve(lines: Lines, render_pass: Pass, resolve: Resolve, area: Area) -> None:
    source, target = resolve.source, resolve.written_part
    if resolve.mode == "NONE" or source is None or target is None:
        return
    if resolve.mode is None:
        lines.missing(f"whether `{source.title}` is resolved: resolveMode is not stated")
        return
    _add(lines, render_pass, source, resolve.aspect, "resolve", "read", source.samples, area)
    if isinstance(target, Attachment):
        _add(lines, render_pass, target, resolve.aspect, "resolve", "write", 1, area)
        return
    resolve_write(lines, render_pass, resolve, source, target, area)


def _add(
    lines: Lines,
    render_pass: Pass,
    attachment: Attachment,
    aspect: str,
    action: str,
    direction: str,
    samples: int | None,
    area: Area,
) -> None:
    texel = aspect_bytes(attachment.format, aspect) if attachment.format is not None else None
    if texel is None or samples is None:
        lines.missing(
            f"`{attachment.title}`: {NOT_STATED['format' if texel is None else 'samples']}"
        )
        return
    target = attachment.targets[0] if attachment.targets else None
    image = target.name if target is not None and target.image is not None else ""
    size = pass_pixels(render_pass, attachment, area) * texel * samples
    stored = Stored(
        attachment.format, attachment.samples or 1, target.image if target is not None else None
    )
    lines.add(
        attachment.name,
        image,
        aspect,
        samples,
        action,
        direction,
        size,
        attachment.record.head,
        stored,
    )
