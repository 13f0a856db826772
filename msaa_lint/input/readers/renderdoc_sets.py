"""Descriptor sets of a RenderDoc capture: what they hold when the frame begins, as the update that would write it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Call, Place

IMAGES = (1, 2, 3, 10)
"""VkDescriptorType of image views: COMBINED_IMAGE_SAMPLER, SAMPLED_IMAGE, STORAGE_IMAGE, INPUT_ATTACHMENT."""

INLINE = 1000138000
"""INLINE_UNIFORM_BLOCK: its count is bytes; it has one slot."""

MAX_BINDINGS = 4096
"""Bindings of a layout."""

MAX_REMEMBERED = 300_000
"""Bindings of all layouts, and sets, that are remembered; what other sets hold stays unknown."""


class Sets:
    """The layouts of descriptor sets: a set's contents are a row of slots, binding after binding."""

    def __init__(self) -> None:
        self.layouts: dict[int, list[tuple[int, int]]] = {}
        self.of_set: dict[int, int] = {}
        self.left = MAX_REMEMBERED

    def noted(self, name: str, arguments: dict[str, Any]) -> None:
        """Looks at a call for layouts, and the sets that have them."""
        if name == "vkCreateDescriptorSetLayout":
            handle, bindings = arguments.get("pSetLayout"), _member(arguments.get("pCreateInfo"), "pBindings")
            if type(handle) is int and isinstance(bindings, list) and len(bindings) <= min(MAX_BINDINGS, self.left - 1):
                self.left -= len(bindings) + 1
                found = [_binding(each) for each in bindings]
                self.layouts[handle] = sorted(each for each in found if each is not None)
        elif name == "vkAllocateDescriptorSets":
            handles, layouts = arguments.get("pDescriptorSets"), _member(arguments.get("pAllocateInfo"), "pSetLayouts")
            if isinstance(handles, list) and isinstance(layouts, list):
                for handle, layout in zip(handles, layouts, strict=False):
                    if type(handle) is int and type(layout) is int and len(self.of_set) < MAX_REMEMBERED:
                        self.of_set[handle] = layout

    def initial(self, given: dict[str, Any], at: Place) -> Iterator[Call]:
        """The images that a set holds when the frame begins; nothing for contents of another kind."""
        handle, slots = given.get("id"), given.get("Bindings")
        if type(handle) is not int or not isinstance(slots, list):
            return
        layout = self.layouts.get(self.of_set.get(handle, 0))
        if layout is None:
            yield unknown(handle, at)
            return
        writes: list[dict[str, Any]] = []
        first = 0
        for binding, count in layout:
            writes.extend(_writes(handle, binding, slots[first : first + count]))
            first += count
        if writes:
            yield Call("vkUpdateDescriptorSets", {"descriptorWriteCount": len(writes), "pDescriptorWrites": writes}, at)


def unknown(handle: int, at: Place) -> Call:
    """A set that holds something which is not told: as an update whose data a capture leaves out."""
    return Call("vkUpdateDescriptorSetWithTemplate", {"descriptorSet": handle}, at)


def _writes(handle: int, binding: int, slots: list[Any]) -> Iterator[dict[str, Any]]:
    """A write for every row of slots of one type that hold images."""
    write: dict[str, Any] | None = None
    for element, slot in enumerate(slots):
        kind, resource = _member(slot, "type"), _member(slot, "resource")
        if kind not in IMAGES or type(resource) is not int or not resource:
            write = None
            continue
        if write is None or write["descriptorType"] != kind:
            write = {"dstSet": handle, "dstBinding": binding, "dstArrayElement": element, "descriptorType": kind, "pImageInfo": []}
            yield write
        image = {"sampler": slot.get("sampler", 0), "imageView": resource, "imageLayout": slot.get("imageLayout")}
        write["pImageInfo"].append(image)


def _binding(given: object) -> tuple[int, int] | None:
    binding, count = _member(given, "binding"), _member(given, "descriptorCount")
    if type(binding) is not int or type(count) is not int or count < 0:
        return None
    return binding, 1 if _member(given, "descriptorType") == INLINE else count


def _member(structure: object, name: str) -> Any:
    return structure.get(name) if isinstance(structure, dict) else None
