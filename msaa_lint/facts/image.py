"""Facts of images."""

from __future__ import annotations

from ..devices import DeviceProfile
from ..devices.shares import sample_count_share
from ..document.records import ReadImage
from .facts import Facts
from .frame import Attachment, Frame, Target
from .timeline import READING_USAGES, Timeline

BESIDE_TRANSIENT = frozenset({"TRANSIENT_ATTACHMENT", "COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"})
"""VUID-VkImageCreateInfo-usage-00963."""

_ATTACHMENT_USAGES = BESIDE_TRANSIENT - {"TRANSIENT_ATTACHMENT"}
_RENDER_TARGET_USAGES = frozenset({"COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT"})


def image_facts(target: Target, frame: Frame, timeline: Timeline, device: DeviceProfile | None) -> Facts:
    """What is known of an image by itself, and by what the frame does with it."""
    facts = Facts()
    image, record = target.image, target.record
    facts.put("image.name", target.name, record.head)
    facts.put("image.stated", image is not None)
    facts.put("image.samples", target.samples, record.place("samples"))
    format = target.format
    facts.put("image.format", format.name if format is not None else None, record.place("format"))
    if format is not None:
        facts.put("image.is_color", "color" in format.aspects, record.place("format"))
        facts.put("image.numeric", format.numeric or None, record.place("format"))
        facts.put("image.is_half_float", format.is_float16)
    supported = supported_samples(target, device)
    if supported is not None and device is not None:
        facts.put("image.supported_samples", list(supported))
        if target.samples is not None and (target.samples in supported or not device.minimum):
            facts.put("image.supported", target.samples in supported, record.place("samples"))
    if target.samples is not None:
        facts.put("image.share_of_devices", sample_count_share(target.samples, tilers=False))
        facts.put("image.share_of_tilers", sample_count_share(target.samples, tilers=True))
    bound = _bound_to(target, frame)
    facts.put("image.loaded", _loaded(bound))
    if image is None:
        facts.put("image.is_render_target", any(attachment.drawn or attachment.resolve for attachment in bound))
        return facts
    facts.put("image.type", image.imageType, image.place("imageType"))
    facts.put("image.tiling", image.tiling, image.place("tiling"))
    facts.put("image.mip_levels", image.mipLevels, image.place("mipLevels"))
    facts.put("image.flags", list(image.flags), image.place("flags"))
    facts.put("image.sharing_mode", image.sharingMode, image.place("sharingMode"))
    facts.put("image.presentable", image.presentable, image.place("presentable"))
    facts.put("image.encoding", image.encoding, image.place("encoding"))
    if image.memory is not None:
        facts.put("image.memory", list(image.memory), image.place("memory"))
        facts.put("image.lazily_allocated", "LAZILY_ALLOCATED" in image.memory, image.place("memory"))
    rendered = any(attachment.drawn or attachment.resolve for attachment in bound)
    if image.usage is not None:
        at = image.place("usage")
        facts.put("image.usage", list(image.usage), at)
        facts.put("image.transient", "TRANSIENT_ATTACHMENT" in image.usage, at)
        facts.put("image.attachment_usage", not _ATTACHMENT_USAGES.isdisjoint(image.usage), at)
        facts.put("image.transient_conflicts", [usage for usage in image.usage if usage not in BESIDE_TRANSIENT], at)
        rendered = rendered or not _RENDER_TARGET_USAGES.isdisjoint(image.usage)
        facts.put("image.is_render_target", rendered, at)
    elif rendered:
        facts.put("image.is_render_target", True)
    else:
        facts.places["image.usage"] = record.head
    facts.put("image.read", _read(target, frame, timeline))
    facts.put("image.averaged_by_reader", _averaged(target, frame))
    return facts


def supported_samples(target: Target, device: DeviceProfile | None) -> tuple[int, ...] | None:
    """The counts that a device offers for all aspects of an image's format; None where unknown."""
    format = target.format
    if device is None or format is None:
        return None
    lists = []
    for aspect in format.aspects:
        if aspect == "color":
            lists.append(device.integer_samples if format.numeric in ("UINT", "SINT") else device.color_samples)
        else:
            lists.append(device.depth_samples if aspect == "depth" else device.stencil_samples)
    common: tuple[int, ...] | None = None
    for counts in lists:
        if counts is None:
            return None
        common = counts if common is None else tuple(count for count in common if count in counts)
    return common


def _bound_to(target: Target, frame: Frame) -> list[Attachment]:
    return [a for p in frame.passes for a in p.attachments if any(t.record is target.record for t in a.targets)]


def _loaded(bound: list[Attachment]) -> bool | None:
    """Whether some pass loads an aspect of it; unknown where a load operation is not stated."""
    ops = [aspect.load for attachment in bound if attachment.used for aspect in attachment.aspects]
    if "LOAD" in ops:
        return True
    return None if None in ops else False


def _read(target: Target, frame: Frame, timeline: Timeline) -> bool | None:
    """Whether its samples are read: by commands where the description records them, else as its usage allows."""
    image = target.image
    assert image is not None
    if any(attachment.input for attachment in _bound_to(target, frame)):
        return True
    if frame.has_commands:
        uses = timeline.uses.get(target.name, [])
        return any(use.kind == "read" and use.aspect is None for use in uses)
    return None if image.usage is None else not READING_USAGES.isdisjoint(image.usage)


def _averaged(target: Target, frame: Frame) -> bool | None:
    """Whether a reader states that it averages the samples; unknown where a reader does not say."""
    bodies = [c.body for c in frame.commands if isinstance(c.body, ReadImage) and c.body.image == target.name]
    stated = [body.resolves for body in bodies]
    if "AVERAGE" in stated:
        return True
    return None if not frame.has_commands or None in stated else False
