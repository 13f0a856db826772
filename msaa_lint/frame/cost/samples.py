"""Frames with another number of samples a pixel."""

from __future__ import annotations

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Aspect, Attachment, Pass, PassSubpass, Resolve, Target

from .frame_edits import image_of, mentioned, record, recorded, renamed, resolved, users
from .resolves import inline

COUNTS = (1, 2, 4, 8, 16, 32, 64)
"""VkSampleCountFlagBits."""


def multisampled(frame: Frame) -> bool:
    """Whether anything in a frame has more than one sample."""
    if any((target.samples or 1) > 1 for target in frame.all_targets):
        return True
    return any(each.samples not in (None, 1) for within in frame.passes for each in within.attachments) or any(
        subpass.single_sampled for within in frame.passes for subpass in within.subpasses
    )


def with_samples(frame: Frame, samples: int) -> None:
    """Gives everything that has more than one sample another count, above 1 too."""
    for target in (*frame.targets.values(), *(t for within in frame.passes for each in within.attachments for t in each.targets)):
        if target.samples is not None and target.samples > 1:
            target.samples = samples
    for within in frame.passes:
        for each in within.attachments:
            if each.samples is not None and each.samples > 1:
                each.samples = samples
        for subpass in within.subpasses:
            if subpass.single_sampled and subpass.single_sampled_count != 1:
                subpass.single_sampled_count = samples


def single_sampled(frame: Frame) -> None:
    """Takes multisampling out: nothing is resolved any more, and what was resolved into is drawn to.

    Of a source that is resolved into several images of a pass, the last is drawn to and the others are written as before.
    """
    inline(frame)
    into: dict[str, dict[str, Target]] = {}
    for within in frame.passes:
        for found in reversed(resolved(within)):
            source, target = found.source, found.target or found.target_image
            assert source is not None and target is not None
            names = [own.name for own in source.targets if own.image is not None]
            if isinstance(target, Attachment):
                if not source.used:
                    continue
                _draw_to_attachment(within, source, target)
                images = target.targets
            else:
                if found not in within.subpasses[0].resolves:
                    continue
                _draw_to_image(within.subpasses[0], found, target)
                images = [target]
            for name in names:
                into.setdefault(name, {}).update((image.name, image) for image in images)
    with_samples(frame, 1)
    for within in frame.passes:
        for subpass in within.subpasses:
            subpass.single_sampled, subpass.single_sampled_count = False, None
    _replace(frame, {name: images.popitem()[1] for name, images in into.items() if len(images) == 1})
    used, named = users(frame), mentioned(frame)
    for name in into:
        if id(frame.targets[name]) not in used and name not in named:
            del frame.targets[name]


def _draw_to_attachment(within: Pass, source: Attachment, target: Attachment) -> None:
    """Puts a resolve target of a render pass where its source was: loaded as that was, stored as either was."""
    over = {aspect for aspects in target.resolve.values() for aspect in aspects}
    stored = {aspect.name: aspect.store for aspect in target.aspects}
    for index in source.color | source.depth_stencil:
        subpass = within.subpasses[index]
        subpass.color = [target if each is source else each for each in subpass.color]
        subpass.depth_stencil = [target if each is source else each for each in subpass.depth_stencil]
        subpass.resolves = [each for each in subpass.resolves if each.source is not source or each.target is not target]
        target.resolve.pop(index, None)
    target.color |= source.color
    target.depth_stencil |= source.depth_stencil
    target.input |= source.input
    source.color, source.depth_stencil, source.input = set(), set(), set()
    target.aspects = [
        aspect._replace(store=_either(aspect.store, stored.get(aspect.name)) if aspect.name in over else aspect.store)
        for aspect in source.aspects
    ]
    for own, image in zip(target.targets, source.targets * len(target.targets), strict=False):
        _same_size(own, image)
        _as_wide(own, source)
    if source.format is not None and len(source.format.aspects) > len(target.format.aspects if target.format is not None else ()):
        target.format = source.format


def _either(one: str | None, other: str | None) -> str | None:
    """What is stored if either is; None where that hangs on one that is unknown."""
    if "STORE" in (one, other):
        return "STORE"
    return None if None in (one, other) else other


def _draw_to_image(subpass: PassSubpass, found: Resolve, target: Target) -> None:
    """Puts the resolve target of a rendering where its source was; it is written as the resolve did, whatever storeOp was."""
    source = found.source
    assert source is not None
    # Depth and stencil are of one image: who is not resolved goes along.
    together = subpass.depth_stencil if source.depth_stencil else [source]
    resolves = {id(each.source) for each in subpass.resolves if each.mode not in (None, "NONE")}
    for each in together:
        for image in each.targets:
            _same_size(target, image)
        _as_wide(target, each)
        if id(each) in resolves:
            each.aspects = [Aspect(a.name, a.load, "STORE", a.load_member, a.store_member) for a in each.aspects]
        each.name, each.targets = target.name, [target]
    subpass.resolves = [each for each in subpass.resolves if not any(each.source is own for own in together)]


def _same_size(target: Target, source: Target) -> None:
    """Gives an image the extent of another, if it states none."""
    if target.image is not None and target.image.extent is None and source.image is not None and source.image.extent is not None:
        image = image_of(target)
        assert image is not None
        image.extent = source.image.extent


def _as_wide(target: Target, source: Attachment) -> None:
    """Gives an image the format of what is drawn to it now, if that has an aspect more."""
    if source.format is not None and len(source.format.aspects) > len(target.format.aspects if target.format is not None else ()):
        target.format = source.format


def _replace(frame: Frame, images: dict[str, Target]) -> None:
    """Puts the only image that another was resolved into in its place, wherever it is used."""
    if not images:
        return
    for within in frame.passes:
        for each in within.attachments:
            each.targets = [images.get(target.name, target) if target.image is not None else target for target in each.targets]
            if within.kind == RENDERING and each.targets:
                each.name = each.targets[0].name
    if frame.has_commands:
        names = {name: target.name for name, target in images.items()}
        record(frame, [(renamed(command, names), begun) for command, begun in recorded(frame)])
