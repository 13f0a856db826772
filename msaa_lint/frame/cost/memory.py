"""What images take of memory, and what lazily allocated ones save."""

from __future__ import annotations

from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Target

from .amounts import ImageMemory
from .sizes import Sizes

MAX_MIP_LEVELS = 32
"""A side has at most 2^31 texels."""


def image_bytes(target: Target, sizes: Sizes) -> int | None:
    """Bytes of an image in full: every mip level, layer, slice and sample. None where its size,
    format or sample count is unknown.
    """
    size, format, image = sizes.image(target), target.format, target.image
    if size is None or format is None or target.samples is None or image is None:
        return None
    total = 0
    for level in range(min(image.mipLevels or 1, MAX_MIP_LEVELS)):
        width, height, depth = (max(side >> level, 1) for side in size)
        blocks = [
            -(-side // block)
            for side, block in zip((width, height, depth), format.block, strict=True)
        ]
        total += blocks[0] * blocks[1] * blocks[2]
        if width == height == depth == 1:
            break
    return total * format.bytes * target.samples * (image.arrayLayers or 1)


def images_memory(
    frame: Frame, sizes: Sizes, device: DeviceProfile | None
) -> tuple[list[ImageMemory], list[str]]:
    """What each image of `images` takes, in their order, and what was taken for granted.

    An image commits nothing where it is TRANSIENT_ATTACHMENT and its memory LAZILY_ALLOCATED. Where
    its memory is not stated, it is taken to be lazily allocated if the device is known to offer
    that. A device that offers none, and an immediate-mode GPU of which that is not known, commits
    all of it.
    """
    used = _moved(frame)
    found, assumed = [], []
    for name, target in frame.targets.items():
        image = target.image
        assert image is not None
        full = image_bytes(target, sizes)
        transient = "TRANSIENT_ATTACHMENT" in (image.usage or ())
        lazy = (
            transient
            and image.memory is not None
            and "LAZILY_ALLOCATED" in image.memory
            and not lacks_lazy_memory(device)
        )
        if transient and image.memory is None and offers_lazy_memory(device):
            lazy = True
            assumed.append(f"`{name}` is bound to lazily allocated memory, which the device offers")
        committed = None if full is None else 0 if lazy else full
        found.append(ImageMemory(name, full, committed, lazy and name in used))
    return found, assumed


def lacks_lazy_memory(device: DeviceProfile | None) -> bool:
    """Whether a device is known, or as an immediate-mode GPU is taken, not to offer
    LAZILY_ALLOCATED memory.
    """
    if device is None or device.minimum or offers_lazy_memory(device):
        return False
    return device.memory_types is not None or device.tiler is False


def offers_lazy_memory(device: DeviceProfile | None) -> bool:
    """Whether a device is known to offer LAZILY_ALLOCATED memory."""
    return device is not None and any(
        "LAZILY_ALLOCATED" in flags for flags in device.memory_types or ()
    )


def _moved(frame: Frame) -> set[str]:
    """The images that some pass loads or stores."""
    names: set[str] = set()
    for render_pass in frame.passes:
        for attachment in render_pass.attachments:
            if attachment.used and any(
                aspect.load == "LOAD" or aspect.store == "STORE" for aspect in attachment.aspects
            ):
                names.update(
                    target.name for target in attachment.targets if target.image is not None
                )
    return names
