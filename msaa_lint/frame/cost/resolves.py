"""Frames with every resolve inside its pass, or with every resolve as a command after it."""

from __future__ import annotations

from msaa_lint.frame.description.models import AttachmentDescription, Command, Image, TwoImages
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import RENDERING, Aspect, Attachment, Pass, Resolve, Target
from msaa_lint.frame.facts.readers import Readers
from msaa_lint.frame.facts.timeline import Timeline

from .frame_edits import Order, blank, command, copied, image_of, mentioned, record, recorded, resolved, suspended, users

TRANSIENT = "TRANSIENT_ATTACHMENT"
BESIDE = ("COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT")
"""What may stand beside TRANSIENT_ATTACHMENT (VUID-VkImageCreateInfo-usage-00963)."""


def inline(frame: Frame) -> None:
    """Resolves in the pass that drew, each time it is begun; samples that nothing reads afterwards are not stored.

    An image whose samples then stay on the tile becomes transient, and lazily allocated where the device is known to offer that. A command
    stays where no pass before it drew its source, and where the pass resolves that into another image already.
    """
    if frame.has_commands:
        _move_commands(frame)
    readers = Readers(Timeline(frame))
    sources: dict[int, Target] = {}
    for within in frame.passes:
        for found in resolved(within):
            source = found.source
            assert source is not None
            source.aspects = [_unread(readers, within, source, aspect) for aspect in source.aspects]
            sources.update((id(target), target) for target in source.targets)
    named, using = mentioned(frame), users(frame)
    for key, target in sources.items():
        if target.name not in named and not any(map(_leaves, using.get(key, ()))):
            _make_transient(target)


def _move_commands(frame: Frame) -> None:
    drawn: dict[str, tuple[Pass, Attachment]] = {}
    inside: dict[int, list[Attachment | Target | None]] = {}
    for within in frame.passes:
        for found in resolved(within):
            inside.setdefault(id(found.source), []).append(found.target or found.target_image)
    kept: Order = []
    for each, begun in recorded(frame):
        if begun is not None and not suspended(begun):
            for attachment in begun.attachments:
                drawn.update((target.name, (begun, attachment)) for target in attachment.targets if attachment.drawn)
        if each.kind != "resolveImage" or not _moved_inside(frame, each, drawn, inside):
            kept.append((each, begun))
    record(frame, kept)


def _unread(readers: Readers, within: Pass, source: Attachment, aspect: Aspect) -> Aspect:
    stays = aspect.store == "STORE" and readers.read_later(within, source, aspect) is not True
    return aspect._replace(store="DONT_CARE") if stays else aspect


def _leaves(attachment: Attachment) -> bool:
    """Whether an attachment is loaded or stored, or may be."""
    return any(aspect.load in ("LOAD", None) or aspect.store in ("STORE", None) for aspect in attachment.aspects)


def _make_transient(target: Target) -> None:
    image = image_of(target)
    if image is None:
        return
    image.usage = (*(use for use in image.usage or () if use in BESIDE), TRANSIENT)
    if "LAZILY_ALLOCATED" not in (image.memory or ()):
        # Not stated: the model then asks the device.
        image.memory = None


def _moved_inside(
    frame: Frame, each: Command, drawn: dict[str, tuple[Pass, Attachment]], inside: dict[int, list[Attachment | Target | None]]
) -> bool:
    """Makes a resolve command one of the pass that drew its source; whether that is possible."""
    body = each.body
    assert isinstance(body, TwoImages)
    source, target = frame.target(body.srcImage), frame.target(body.dstImage)
    if source is None or target is None or source.samples == 1 or source.name not in drawn:
        return False
    within, attachment = drawn[source.name]
    into = inside.setdefault(id(attachment), [])
    if into:
        return all(_is_image(each, target) for each in into)
    into.append(target)
    if within.kind == RENDERING:
        for own in within.subpasses[0].depth_stencil if attachment.depth_stencil else [attachment]:
            _resolve_of_rendering(within, own, target, each)
    else:
        _resolve_of_pass(within, attachment, target, each)
    return True


def _is_image(into: Attachment | Target | None, target: Target) -> bool:
    return into is target or (isinstance(into, Attachment) and any(own is target for own in into.targets))


def _resolve_of_rendering(within: Pass, source: Attachment, target: Target, each: Command) -> None:
    made = _resolve(within, source, source.aspects[0].name or "color", 0, each)
    made.target_image = target
    within.subpasses[0].resolves.append(made)


def _resolve_of_pass(within: Pass, source: Attachment, target: Target, each: Command) -> None:
    index = max(source.color | source.depth_stencil)
    into = Attachment(blank(AttachmentDescription, each, target.name), target.name, len(within.attachments), [target])
    into.format, into.samples = target.format or source.format, target.samples
    names = into.format.aspects if into.format is not None else ("color",)
    into.aspects = [Aspect(name, "DONT_CARE", "STORE", "loadOp", "storeOp") for name in names]
    into.resolve = {index: set(names)}
    within.attachments.append(into)
    for name in names:
        made = _resolve(within, source, name, index, each)
        made.target, made.target_image = into, target
        within.subpasses[index].resolves.append(made)


def _resolve(within: Pass, source: Attachment, aspect: str, index: int, each: Command) -> Resolve:
    made = Resolve(within.kind, aspect, each, each.path)
    made.render_pass, made.subpass, made.source, made.source_image = within, index, source, source.target
    made.mode = "AVERAGE" if aspect == "color" else "SAMPLE_ZERO"
    return made


def separate(frame: Frame) -> None:
    """Stores all samples of what passes resolve, and resolves by vkCmdResolveImage after them; what is stored is no longer transient.

    The command moves every aspect of an image, so every one is stored. A pass that goes on with the resolved picture loads it.
    """
    after: dict[int, dict[tuple[str, str], Command]] = {}
    for within in frame.passes:
        inside = resolved(within)
        gone = {id(found) for found in inside}
        for found in inside:
            source, into = found.source, found.target or found.target_image
            assert source is not None and into is not None
            if isinstance(into, Attachment):
                _released(into, found)
            target = _image(frame, into) if isinstance(into, Attachment) else into
            for own in within.subpasses[0].depth_stencil if within.kind == RENDERING and source.depth_stencil else [source]:
                _store(own)
            body = blank(TwoImages, found.record, "resolveImage")
            body.srcImage, body.dstImage = _image(frame, source).name, target.name
            made = after.setdefault(id(within), {})
            made.setdefault((body.srcImage, body.dstImage), command("resolveImage", body, found.record))
        for subpass in within.subpasses if gone else ():
            subpass.resolves = [found for found in subpass.resolves if id(found) not in gone]
    if after:
        record(frame, _with_resolves(recorded(frame), after))


def _with_resolves(order: Order, after: dict[int, dict[tuple[str, str], Command]]) -> Order:
    made: Order = []
    waiting: list[Command] = []
    for each, begun in order:
        if begun is not None:
            made += [(resolve, None) for resolve in waiting]
            waiting = [copied(resolve) for resolve in after.get(id(begun), {}).values()]
        made.append((each, begun))
        if each.kind in ("endRenderPass", "endRendering"):
            made += [(resolve, None) for resolve in waiting]
            waiting = []
    return made + [(resolve, None) for resolve in waiting]


def _released(into: Attachment, found: Resolve) -> None:
    """Takes a resolve's target out of the subpass; who uses it later in the pass must load it."""
    aspects = into.resolve.get(found.subpass, set())
    aspects.discard(found.aspect)
    if not aspects:
        into.resolve.pop(found.subpass, None)
    if into.used:
        into.aspects = [aspect._replace(load="LOAD") for aspect in into.aspects]


def _store(source: Attachment) -> None:
    source.aspects = [aspect._replace(store="STORE") for aspect in source.aspects]
    for target in source.targets:
        if target.image is None or TRANSIENT not in (target.image.usage or ()):
            continue
        image = image_of(target)
        assert image is not None
        image.usage = (*(use for use in image.usage or () if use != TRANSIENT), "TRANSFER_SRC")
        if image.memory is not None:
            image.memory = tuple(flag for flag in image.memory if flag != "LAZILY_ALLOCATED")


def _image(frame: Frame, attachment: Attachment) -> Target:
    """The image of an attachment. One that is not described gets a name to be resolved by, and takes no memory, as in every other frame."""
    target = attachment.targets[0]
    if target.image is None:
        image = blank(Image, target.record, f"{target.record.path} (not described)")
        image.usage, image.memory = (TRANSIENT,), ("LAZILY_ALLOCATED",)
        made = Target(image, image, None, attachment.samples)
        made.format = attachment.format
        attachment.targets = [made]
        frame.targets[made.name] = made
        return made
    return target
