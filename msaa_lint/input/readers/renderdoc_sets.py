"""The contents of descriptor sets at the start of a RenderDoc frame, as the updates that would
write them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Call, Place
from msaa_lint.input.captures.values import record

IMAGES = (1, 2, 3, 10)
"""VkDescriptorType of image views: COMBINED_IMAGE_SAMPLER, SAMPLED_IMAGE, STORAGE_IMAGE,
INPUT_ATTACHMENT.
"""

INLINE = 1000138000
"""INLINE_UNIFORM_BLOCK: its descriptorCount is in bytes; it has one slot."""

MAX_BINDINGS = 4096
"""Maximum number of bindings in a layout."""

MAX_BINDINGS_TOTAL = 300_000
"""Maximum number of bindings in all layouts, and of sets; the contents of further sets are
unknown.
"""


class DescriptorSets:
    """The layouts of descriptor sets. A set's contents are a sequence of slots, binding after
    binding.
    """

    def __init__(self) -> None:
        self.layouts: dict[int, list[tuple[int, int]]] = {}
        self.layout_of_set: dict[int, int] = {}
        self.remaining = MAX_BINDINGS_TOTAL

    def observe(self, name: str, arguments: dict[str, Any]) -> None:
        """Records the layouts and sets that a call creates."""
        if name == "vkCreateDescriptorSetLayout":
            handle, bindings = (
                arguments.get("pSetLayout"),
                record(arguments.get("pCreateInfo")).get("pBindings"),
            )
            if (
                type(handle) is int
                and isinstance(bindings, list)
                and len(bindings) <= min(MAX_BINDINGS, self.remaining - 1)
            ):
                self.remaining -= len(bindings) + 1
                parsed = map(_binding, bindings)
                self.layouts[handle] = sorted(binding for binding in parsed if binding is not None)
        elif name == "vkAllocateDescriptorSets":
            handles, layouts = (
                arguments.get("pDescriptorSets"),
                record(arguments.get("pAllocateInfo")).get("pSetLayouts"),
            )
            if isinstance(handles, list) and isinstance(layouts, list):
                for handle, layout in zip(handles, layouts, strict=False):
                    if (
                        type(handle) is int
                        and type(layout) is int
                        and len(self.layout_of_set) < MAX_BINDINGS_TOTAL
                    ):
                        self.layout_of_set[handle] = layout

    def initial_contents(self, chunk: dict[str, Any], at: Place) -> Iterator[Call]:
        """The images in a set at the start of the frame; no calls for initial contents of other
        objects.
        """
        handle, slots = chunk.get("id"), chunk.get("Bindings")
        if type(handle) is not int or not isinstance(slots, list):
            return
        layout = self.layouts.get(self.layout_of_set.get(handle, 0))
        if layout is None:
            yield unknown_set(handle, at)
            return
        writes: list[dict[str, Any]] = []
        first = 0
        for binding, count in layout:
            writes.extend(_writes(handle, binding, slots[first : first + count]))
            first += count
        if writes:
            yield Call(
                "vkUpdateDescriptorSets",
                {"descriptorWriteCount": len(writes), "pDescriptorWrites": writes},
                at,
            )


def unknown_set(handle: int, at: Place) -> Call:
    """An update that makes a set's contents unknown: one whose data the capture omits."""
    return Call("vkUpdateDescriptorSetWithTemplate", {"descriptorSet": handle}, at)


def _writes(handle: int, binding: int, slots: list[Any]) -> Iterator[dict[str, Any]]:
    """A write for each run of image slots of the same type."""
    write: dict[str, Any] | None = None
    for element, slot in enumerate(slots):
        kind, resource = record(slot).get("type"), record(slot).get("resource")
        if kind not in IMAGES or type(resource) is not int or not resource:
            write = None
            continue
        if write is None or write["descriptorType"] != kind:
            write = {
                "dstSet": handle,
                "dstBinding": binding,
                "dstArrayElement": element,
                "descriptorType": kind,
                "pImageInfo": [],
            }
            yield write
        image = {
            "sampler": slot.get("sampler", 0),
            "imageView": resource,
            "imageLayout": slot.get("imageLayout"),
        }
        write["pImageInfo"].append(image)


def _binding(chunk: object) -> tuple[int, int] | None:
    binding, count = record(chunk).get("binding"), record(chunk).get("descriptorCount")
    if type(binding) is not int or type(count) is not int or count < 0:
        return None
    return binding, 1 if record(chunk).get("descriptorType") == INLINE else count
