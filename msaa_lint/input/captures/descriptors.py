"""Tracks the images in descriptor sets."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from . import values
from .call import Call
from .layouts import readable
from .objects import DescriptorSet, UnknownDescriptors
from .set_layouts import SetLayout, SetLayouts, Template, TemplateEntry, storage_of

MAX_COPIED = 64
"""Maximum number of images that copies always copy."""

_ENDS = ("src", "dst")


class Descriptors(SetLayouts):
    """Tracks the descriptor sets of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self.sets: dict[int, DescriptorSet | SetLayout | None] = {}
        """The layout alone, or None if it is unknown, until a set is used."""
        self.set_pools: dict[int, dict[int, None]] = {}

    def on_AllocateDescriptorSets(self, call: Call) -> None:
        info = values.record(call.args.get("pAllocateInfo"))
        pool = self.set_pools.setdefault(values.handle(info.get("descriptorPool")), {})
        layouts = values.items(info.get("pSetLayouts"))
        for number, item in enumerate(values.items(call.args.get("pDescriptorSets"))):
            handle = values.handle(item)
            if self.has_room(self.sets, call):
                self.sets[handle] = (
                    self.set_layouts.get(values.handle(layouts[number]))
                    if number < len(layouts)
                    else None
                )
                pool[handle] = None

    def set(self, value: object) -> DescriptorSet | None:
        """The set of a handle; None if there is none."""
        handle = values.handle(value)
        descriptors = self.sets.get(handle)
        if not isinstance(descriptors, DescriptorSet) and handle in self.sets:
            descriptors = self.sets[handle] = DescriptorSet(descriptors)
        return descriptors if isinstance(descriptors, DescriptorSet) else None

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

        More than one descriptor may continue in the next binding, so all images are copied then:
        the rules only ask what may be read.
        """
        target.opaque = target.opaque or source.opaque
        if len(source.unknown) > MAX_COPIED and not self.frames.spend(len(source.unknown)):
            target.opaque = True
        elif source.unknown:
            target.unknown.update(source.unknown)
            target.updates += 1
        if values.integer(copy.get("descriptorCount")) == 1:
            ends = [
                (
                    values.integer(copy.get(f"{end}Binding")) or 0,
                    values.integer(copy.get(f"{end}ArrayElement")) or 0,
                )
                for end in _ENDS
            ]
            use = source.images.get(ends[0])
            if use is not None:
                target.put(ends[1], *use)
            else:
                target.remove(ends[1])
        elif len(source.images) > MAX_COPIED and not self.frames.spend(
            len(source.images) - MAX_COPIED
        ):
            # Copies of copies multiply: beyond the budget, the contents are unknown.
            target.opaque = True
        else:
            for slot, (image, storage) in list(source.images.items()):
                target.put(slot, image, storage)

    def on_UpdateDescriptorSetWithTemplate(self, call: Call) -> None:
        target = self.set(call.args.get("descriptorSet"))
        if target is not None:
            self.write_template(target, call.args)

    def write(self, target: DescriptorSet, write: dict[str, Any]) -> None:
        """Applies a VkWriteDescriptorSet to a set."""
        storage = storage_of(write.get("descriptorType"))
        if not storage:
            return
        infos = values.items(write.get("pImageInfo"))
        binding, first = (
            values.count(write.get("dstBinding")) or 0,
            values.count(write.get("dstArrayElement")) or 0,
        )
        start = 0
        for run in _runs(target, binding, first, len(infos)):
            for element, item in enumerate(infos[start : start + run.size], run.element):
                image = self.views.get(values.handle(values.record(item).get("imageView")))
                slot = (run.binding, element)
                if image is not None and image.attachable:
                    target.put(slot, image, storage[-1])
                else:
                    target.remove(slot)
            start += run.size
            unknown = target.unknown.get(run.binding)
            if unknown is not None and not run.element and run.size >= unknown.size:
                del target.unknown[run.binding]
                target.updates += 1

    def write_template(self, target: DescriptorSet, args: dict[str, Any]) -> None:
        """Applies an update template to a set. What it writes is unknown if the capture omits it,
        or the template.
        """
        writes = args.get("pDescriptorWrites")
        template = self.templates.get(values.handle(args.get("descriptorUpdateTemplate")))
        if isinstance(writes, list):
            # RenderDoc resolves the template.
            for write in writes:
                self.write(target, values.record(write))
        elif template is not None and (
            len(template.entries) <= MAX_COPIED or self.frames.spend(len(template.entries))
        ):
            self._write_entries(target, template, values.record(args.get("pData")))
        else:
            target.opaque = True

    def _write_entries(
        self, target: DescriptorSet, template: Template, data: dict[str, Any]
    ) -> None:
        # gfxreconstruct 0.9 writes all structures of the data in order, in a VkWriteDescriptorSet
        # without handles; 1.x writes handles.
        infos = values.items(data.get("imageInfos", data.get("pImageInfo")))
        states_handles = "imageInfos" in data or any(
            values.handle(values.record(info).get("imageView")) for info in infos
        )
        start = 0
        for entry in template.entries:
            part = infos[start : start + entry.size]
            start += entry.size
            if not entry.storage:
                continue
            if states_handles and len(part) == entry.size:
                ends = {"dstBinding": entry.binding, "dstArrayElement": entry.element}
                self.write(
                    target, {**ends, "descriptorType": entry.descriptor_type, "pImageInfo": part}
                )
            else:
                _write_unknown(target, entry, part)


class _Run(NamedTuple):
    """Descriptors of one binding that an update writes."""

    binding: int
    element: int
    size: int


def _runs(target: DescriptorSet, binding: int, element: int, count: int) -> Iterator[_Run]:
    """The descriptors that an update writes, by binding: with the set's layout, those beyond the
    end of a binding are in the next one.
    """
    layout: SetLayout | None = target.layout
    if layout is None or layout.size(binding) >= element + count:
        yield _Run(binding, element, count)
        return
    for run in layout.runs(binding, element, count):
        yield _Run(*run)


def _write_unknown(target: DescriptorSet, entry: TemplateEntry, infos: list[Any]) -> None:
    """Writes descriptors whose images are unknown; the capture may state their layouts."""
    target.updates += 1
    layouts: frozenset[str] | None = None
    if len(infos) == entry.size:
        names = {
            values.enum("VkImageLayout", values.record(info).get("imageLayout")) for info in infos
        }
        layouts = frozenset().union(*map(readable, names))
    for run in _runs(target, entry.binding, entry.element, entry.size):
        for element in range(run.element, run.element + min(run.size, MAX_COPIED)):
            target.remove((run.binding, element))
        before = target.unknown.get(run.binding)
        if before is not None and (run.element or run.size < before.size):
            # The other descriptors of the binding are what they were.
            both = (
                layouts | before.layouts
                if layouts is not None and before.layouts is not None
                else None
            )
            target.unknown[run.binding] = UnknownDescriptors(
                max(before.size, run.element + run.size), before.storage, both
            )
        else:
            target.unknown[run.binding] = UnknownDescriptors(
                run.element + run.size, entry.storage, layouts
            )
