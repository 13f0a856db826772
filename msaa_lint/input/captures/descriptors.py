"""Tracks the images in descriptor sets."""

from __future__ import annotations

from typing import Any

from . import values
from .call import Call
from .images import Images
from .objects import DescriptorSet

MAX_COPIED = 64
"""Maximum number of images that copies always copy."""

_ENDS = ("src", "dst")
_STORAGE_IMAGE = 3
_IMAGES = (1, 2, _STORAGE_IMAGE)
"""VkDescriptorType: COMBINED_IMAGE_SAMPLER, SAMPLED_IMAGE, STORAGE_IMAGE. Input attachments are read on the tile and omitted."""
_NAMES = {
    "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER": False,
    "VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE": False,
    "VK_DESCRIPTOR_TYPE_STORAGE_IMAGE": True,
}


class Descriptors(Images):
    """Tracks the descriptor sets of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self.sets: dict[int, DescriptorSet | None] = {}
        """None until a set is used."""
        self.set_pools: dict[int, dict[int, None]] = {}

    def on_AllocateDescriptorSets(self, call: Call) -> None:
        info = values.record(call.args.get("pAllocateInfo"))
        pool = self.set_pools.setdefault(values.handle(info.get("descriptorPool")), {})
        for item in values.items(call.args.get("pDescriptorSets")):
            handle = values.handle(item)
            if self.has_room(self.sets, call):
                self.sets[handle] = None
                pool[handle] = None

    def set(self, value: object) -> DescriptorSet | None:
        """The set of a handle; None if there is none."""
        handle = values.handle(value)
        descriptors = self.sets.get(handle)
        if descriptors is None and handle in self.sets:
            descriptors = self.sets[handle] = DescriptorSet()
        return descriptors

    def on_ResetDescriptorPool(self, call: Call) -> None:
        for handle in self.set_pools.pop(values.handle(call.args.get("descriptorPool")), ()):
            self.sets.pop(handle, None)

    on_DestroyDescriptorPool = on_ResetDescriptorPool

    def on_FreeDescriptorSets(self, call: Call) -> None:
        pool = self.set_pools.get(values.handle(call.args.get("descriptorPool")), {})
        for handle in map(values.handle, values.items(call.args.get("pDescriptorSets"))):
            self.sets.pop(handle, None)
            pool.pop(handle, None)

    def on_UpdateDescriptorSets(self, call: Call) -> None:
        for item in values.items(call.args.get("pDescriptorWrites")):
            write = values.record(item)
            target_set = self.set(write.get("dstSet"))
            if target_set is not None:
                self.write(target_set, write)
        for item in values.items(call.args.get("pDescriptorCopies")):
            copy = values.record(item)
            source, target = (self.set(copy.get(name)) for name in ("srcSet", "dstSet"))
            if source is not None and target is not None:
                self._copy(source, target, copy)

    def _copy(self, source: DescriptorSet, target: DescriptorSet, copy: dict[str, Any]) -> None:
        """Applies a VkCopyDescriptorSet.

        More than one descriptor may continue in the next binding, so all images are copied then: the rules only ask what may be read.
        """
        target.opaque = target.opaque or source.opaque
        if values.integer(copy.get("descriptorCount")) == 1:
            ends = [(values.integer(copy.get(f"{end}Binding")) or 0, values.integer(copy.get(f"{end}ArrayElement")) or 0) for end in _ENDS]
            use = source.images.get(ends[0])
            if use is not None:
                target.put(ends[1], *use)
            else:
                target.remove(ends[1])
        elif len(source.images) > MAX_COPIED and not self.frames.spend(len(source.images) - MAX_COPIED):
            # Copies of copies multiply: beyond the budget, the contents are unknown.
            target.opaque = True
        else:
            for slot, (image, storage) in list(source.images.items()):
                target.put(slot, image, storage)

    def on_UpdateDescriptorSetWithTemplate(self, call: Call) -> None:
        target = self.set(call.args.get("descriptorSet"))
        if target is not None:
            target.opaque = True

    def write(self, target: DescriptorSet, write: dict[str, Any]) -> None:
        """Applies a VkWriteDescriptorSet to a set."""
        storage = _storage(write.get("descriptorType"))
        if storage is None:
            return
        binding = values.integer(write.get("dstBinding")) or 0
        first = values.integer(write.get("dstArrayElement")) or 0
        for offset, item in enumerate(values.items(write.get("pImageInfo"))):
            image = self.views.get(values.handle(values.record(item).get("imageView")))
            slot = (binding, first + offset)
            if image is not None and image.attachable:
                target.put(slot, image, storage)
            else:
                target.remove(slot)


def _storage(kind: object) -> bool | None:
    """Whether shaders may write a descriptor type; None if it is an input attachment or not an image."""
    number = values.integer(kind)
    if number is not None:
        return number == _STORAGE_IMAGE if number in _IMAGES else None
    return _NAMES.get(kind) if isinstance(kind, str) else None
