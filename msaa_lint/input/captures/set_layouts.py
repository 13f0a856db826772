"""Tracks the layouts of descriptor sets and pipelines, and update templates: what a pipeline can
read of a set.
"""

from bisect import bisect_left
from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

from . import values
from .call import Call
from .images import Images
from .objects import ImageKind, ReadableBindings, SetBindings

GRAPHICS, COMPUTE, RAY_TRACING = 0xDF, 0x20, 0x3F00
"""VkShaderStageFlagBits of the stages of a bind point."""

_ALL_STAGES = 0x7FFFFFFF

SAMPLER, INPUT_ATTACHMENT = (
    (0, "VK_DESCRIPTOR_TYPE_SAMPLER"),
    (10, "VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT"),
)
_STORAGE_IMAGE = (3, "VK_DESCRIPTOR_TYPE_STORAGE_IMAGE")
_SAMPLED_IMAGES = (
    1, 2, 1000440000, 1000440001, "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER",
    "VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE",
    "VK_DESCRIPTOR_TYPE_SAMPLE_WEIGHT_IMAGE_QCOM", "VK_DESCRIPTOR_TYPE_BLOCK_MATCH_IMAGE_QCOM",
)  # fmt: skip
_MUTABLE = (1000351000, "VK_DESCRIPTOR_TYPE_MUTABLE_EXT", "VK_DESCRIPTOR_TYPE_MUTABLE_VALVE")
"""VkDescriptorType. A mutable descriptor may be an image."""

MAX_BINDINGS = 4096
"""Maximum number of bindings in a layout, and of entries in a template; what larger ones contain is
unknown.
"""

MAX_SETS = 64
"""Maximum number of sets in a layout of a pipeline; devices allow 32."""

MAX_BINDINGS_TOTAL = 1_000_000
"""Maximum number of bindings and entries in all of them that exist at a time; what further ones
contain is unknown.
"""

Storage = tuple[bool, ...]
"""The kinds of image that a descriptor can be: whether shaders may write it."""

SAMPLED: Storage = (False,)
STORAGE: Storage = (True,)
EITHER: Storage = (False, True)


def storage_of(kind: object) -> Storage:
    """The kinds of image that a VkDescriptorType can be; none for buffers and samplers, and for
    input attachments, which are read on the tile.
    """
    number = values.integer(kind)
    kind = number if number is not None else values.enumerant_name(kind)
    return (
        SAMPLED
        if kind in _SAMPLED_IMAGES
        else STORAGE
        if kind in _STORAGE_IMAGE
        else EITHER
        if kind in _MUTABLE
        else ()
    )


ShaderImages = dict[tuple[int, int], frozenset[bool]]
"""The images that shaders declare, by set and binding, and whether they are multisampled."""


Share = Callable[[dict[int, tuple[ImageKind, ...]]], ReadableBindings]


class SetLayout:
    """The bindings of a descriptor set in order with their number of descriptors, and those that
    are images: their kinds and stages.
    """

    __slots__ = ("counts", "images", "order", "readable")

    def __init__(self, bindings: list[tuple[int, int, Storage, int]]) -> None:
        ordered = sorted(bindings)
        self.order = [binding for binding, _, _, _ in ordered]
        self.counts = [count for _, count, _, _ in ordered]
        self.images = {
            binding: (storage, stages) for binding, _, storage, stages in ordered if storage
        }
        self.readable: dict[int, ReadableBindings] = {}
        """What shaders that are not known can read, by the stages of the bind point."""

    def size(self, binding: int) -> int:
        """The number of descriptors of a binding; 0 if there is no such binding."""
        at = bisect_left(self.order, binding)
        return self.counts[at] if at < len(self.order) and self.order[at] == binding else 0

    def runs(self, binding: int, element: int, count: int) -> Iterator[tuple[int, int, int]]:
        """The descriptors that an update writes, by binding: those beyond the end of a binding are
        in the next one.
        """
        at = bisect_left(self.order, binding)
        while count > 0 and at < len(self.order):
            run = min(count, self.counts[at] - element)
            if run > 0:
                yield self.order[at], element, run
                count -= run
            element = max(element - self.counts[at], 0)
            at += 1

    def readable_by(
        self, stages: int, shaders: Mapping[int, frozenset[bool]] | None, share: Share
    ) -> ReadableBindings:
        """What the stages of a bind point can read; `shaders` are the images that they declare in
        this set, None if that is unknown.

        `share` returns one object for equal bindings.
        """
        if shaders is None:
            if stages not in self.readable:
                every = (False, True)
                self.readable[stages] = share(
                    {
                        binding: _kinds(storage, every)
                        for binding, (storage, of) in self.images.items()
                        if of & stages
                    }
                )
            return self.readable[stages]
        found = {
            binding: _kinds(self.images[binding][0], multisampled)
            for binding, multisampled in shaders.items()
            if binding in self.images and self.images[binding][1] & stages
        }
        return share(found)


def _kinds(
    storage: Storage, multisampled: frozenset[bool] | tuple[bool, ...]
) -> tuple[ImageKind, ...]:
    return tuple((written, samples) for written in storage for samples in multisampled)


class TemplateEntry(NamedTuple):
    """Descriptors that a template writes and that have a VkDescriptorImageInfo: `storage` is empty
    for samplers and input attachments.
    """

    binding: int
    element: int
    size: int
    storage: Storage
    descriptor_type: object


class Template(NamedTuple):
    """A descriptor update template; `point` is the bind point if it pushes descriptors."""

    entries: tuple[TemplateEntry, ...]
    point: object


class SetLayouts(Images):
    """Tracks the layouts of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self.set_layouts: dict[int, SetLayout] = {}
        self.pipeline_layouts: dict[int, tuple[SetLayout | None, ...]] = {}
        self.templates: dict[int, Template] = {}
        self._bindings_left = MAX_BINDINGS_TOTAL
        self._sizes: dict[tuple[int, int], int] = {}
        """The number of bindings of what is followed, by the mapping that has it and its handle."""
        self._shared: dict[frozenset[tuple[int, tuple[ImageKind, ...]]], ReadableBindings] = {}
        """One object for equal bindings, so that what pipelines read of a set is looked up once."""

    def _keeps(self, objects: dict[int, Any], handle: int, entries: list[Any]) -> bool:
        """Whether the bindings of a new object are followed. It takes the place of the one that had
        its handle.
        """
        self._forget_bindings(objects, handle)
        size = len(entries) + 1
        if len(entries) > MAX_BINDINGS or size > self._bindings_left:
            return False
        self._bindings_left -= size
        self._sizes[id(objects), handle] = size
        return True

    def _forget_bindings(self, objects: dict[int, Any], handle: int) -> None:
        if objects.pop(handle, None) is not None:
            self._bindings_left += self._sizes.pop((id(objects), handle))

    def on_DestroyDescriptorSetLayout(self, call: Call) -> None:
        self._forget_bindings(self.set_layouts, values.handle(call.args.get("descriptorSetLayout")))

    def on_DestroyPipelineLayout(self, call: Call) -> None:
        self._forget_bindings(self.pipeline_layouts, values.handle(call.args.get("pipelineLayout")))

    def on_DestroyDescriptorUpdateTemplate(self, call: Call) -> None:
        self._forget_bindings(
            self.templates, values.handle(call.args.get("descriptorUpdateTemplate"))
        )

    def on_CreateDescriptorSetLayout(self, call: Call) -> None:
        handle = values.handle(call.args.get("pSetLayout"))
        items = values.items(values.record(call.args.get("pCreateInfo")).get("pBindings"))
        if self._keeps(self.set_layouts, handle, items):
            self.set_layouts[handle] = SetLayout([_binding(values.record(item)) for item in items])

    def on_CreatePipelineLayout(self, call: Call) -> None:
        handle = values.handle(call.args.get("pPipelineLayout"))
        items = values.items(values.record(call.args.get("pCreateInfo")).get("pSetLayouts"))
        if self._keeps(self.pipeline_layouts, handle, items):
            self.pipeline_layouts[handle] = tuple(
                self.set_layouts.get(values.handle(item)) for item in items[:MAX_SETS]
            )

    def on_CreateDescriptorUpdateTemplate(self, call: Call) -> None:
        handle = values.handle(call.args.get("pDescriptorUpdateTemplate"))
        info = values.record(call.args.get("pCreateInfo"))
        items = values.items(info.get("pDescriptorUpdateEntries"))
        if self._keeps(self.templates, handle, items):
            entries = tuple(_entry(values.record(item)) for item in items)
            self.templates[handle] = Template(
                tuple(entry for entry in entries if entry is not None),
                info.get("pipelineBindPoint"),
            )

    def bindings_of(
        self, layout: object, stages: int, shaders: ShaderImages | None
    ) -> SetBindings | None:
        """What a pipeline with a layout can read, by set; None if the layout is unknown."""
        sets = self.pipeline_layouts.get(values.handle(layout))
        if sets is None:
            return None
        by_set: dict[int, dict[int, frozenset[bool]]] | None = None
        if shaders is not None:
            by_set = {}
            for (number, binding), multisampled in shaders.items():
                by_set.setdefault(number, {})[binding] = multisampled
        return tuple(
            each.readable_by(
                stages, by_set.get(number, {}) if by_set is not None else None, self._share
            )
            if each is not None
            else None
            for number, each in enumerate(sets)
        )

    def _share(self, kinds: dict[int, tuple[ImageKind, ...]]) -> ReadableBindings:
        if len(self._shared) > MAX_BINDINGS:
            self._shared.clear()
        key = frozenset(kinds.items())
        if key not in self._shared:
            self._shared[key] = ReadableBindings(kinds)
        return self._shared[key]


def _binding(info: dict[str, Any]) -> tuple[int, int, Storage, int]:
    stages = values.bits("VkShaderStageFlagBits", info.get("stageFlags"))
    return (
        values.count(info.get("binding")) or 0, values.count(info.get("descriptorCount")) or 0,
        storage_of(info.get("descriptorType")),
        stages if stages is not None else _ALL_STAGES,
    )  # fmt: skip


def _entry(info: dict[str, Any]) -> TemplateEntry | None:
    kind = info.get("descriptorType")
    storage = storage_of(kind)
    number = values.integer(kind)
    name = number if number is not None else values.enumerant_name(kind)
    if not storage and name not in SAMPLER and name not in INPUT_ATTACHMENT:
        return None
    binding, element, size = (
        values.count(info.get(member)) or 0
        for member in ("dstBinding", "dstArrayElement", "descriptorCount")
    )
    return TemplateEntry(binding, element, size, storage, kind)
