"""The pipeline layout of a pipeline with shaders from outside, and what is bound to it: descriptor
sets and push constants.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from .binding import push_bytes
from .opening import DeviceObjects
from .parts import (
    COLOR,
    DEPTH,
    READ_LAYOUT,
    STENCIL,
    Descriptor,
    Framebuffer,
    Image,
    Pass,
    Pipeline,
    unpacked,
)
from .parts import GENERAL as GENERAL_LAYOUT
from .shader_resources import (
    COMBINED,
    IMAGES,
    INPUT_ATTACHMENT,
    SAMPLER,
    STORAGE_IMAGE,
    TEXELS,
    WHOLE,
    resources,
)

AttachmentView = Callable[[int, Framebuffer, int], Any]
"""The view of some aspects of an image, by its number, as a framebuffer has it."""


class ShaderBindings:
    """The layout of a pipeline's stages. `objects` owns all objects."""

    def __init__(self, objects: DeviceObjects, pipeline: Pipeline) -> None:
        self.objects = objects
        self.vk = objects.vk
        self.pipeline = pipeline
        self.descriptors: dict[tuple[int, int], Descriptor] = {}
        self._stages: Counter[tuple[int, int]] = Counter()
        for stage in pipeline.stages:
            for descriptor in stage.descriptors:
                place = (descriptor.set, descriptor.binding)
                self.descriptors.setdefault(place, descriptor)
                self._stages[place] |= stage.stage
        self._pushing = sum(stage.stage for stage in pipeline.stages if stage.pushed)
        self._pushed = b""
        for stage in pipeline.stages:
            data = unpacked(stage.pushed) if stage.pushed else b""
            self._pushed = data + self._pushed[len(data) :]
        self._pushed = self._pushed.ljust(-(-len(self._pushed) // 4) * 4, b"\0")
        self._set_layouts = [
            self._set_layout(number)
            for number in range(1 + max((each.set for each in self._places()), default=-1))
        ]
        self.layout = self._layout()
        self._sets: list[list[Any]] = []

    def _places(self) -> list[Descriptor]:
        return list(self.descriptors.values())

    def _set_layout(self, number: int) -> Any:
        vk = self.vk
        bindings = [
            vk.VkDescriptorSetLayoutBinding(
                binding=each.binding,
                descriptorType=each.type,
                descriptorCount=each.length,
                stageFlags=self._stages[number, each.binding],
            )
            for each in self._places()
            if each.set == number
        ]
        create = vk.VkDescriptorSetLayoutCreateInfo(pBindings=bindings)
        return self.objects.own(
            vk.vkDestroyDescriptorSetLayout,
            vk.vkCreateDescriptorSetLayout(self.objects.opened.handle, create, None),
        )

    def _layout(self) -> Any:
        vk = self.vk
        ranges = (
            [vk.VkPushConstantRange(stageFlags=self._pushing, offset=0, size=len(self._pushed))]
            if self._pushed
            else []
        )
        create = vk.VkPipelineLayoutCreateInfo(
            pSetLayouts=self._set_layouts, pPushConstantRanges=ranges
        )
        return self.objects.own(
            vk.vkDestroyPipelineLayout,
            vk.vkCreatePipelineLayout(self.objects.opened.handle, create, None),
        )

    def create_sets(self, frame_pass: Pass, images: Sequence[Image], view: AttachmentView) -> None:
        """Creates the descriptor sets: one list of them, or one for each framebuffer if they
        contain its input attachments. `images` are those of the plan.
        """
        has_attachments = any(each.type == INPUT_ATTACHMENT for each in self._places())
        for number in range(len(frame_pass.framebuffers) if has_attachments else 1):
            self._sets.append(
                self._new_sets(partial(self._attachment, frame_pass, number, images, view))
            )

    def _new_sets(self, attachment: Callable[[Descriptor], Any]) -> list[Any]:
        if not self.descriptors:
            return []
        vk, handle = self.vk, self.objects.opened.handle
        counts: Counter[int] = Counter()
        for each in self._places():
            counts[each.type] += each.length
        sizes = [
            vk.VkDescriptorPoolSize(type=type, descriptorCount=count)
            for type, count in counts.items()
        ]
        create = vk.VkDescriptorPoolCreateInfo(maxSets=len(self._set_layouts), pPoolSizes=sizes)
        pool = self.objects.own(
            vk.vkDestroyDescriptorPool, vk.vkCreateDescriptorPool(handle, create, None)
        )
        allocate = vk.VkDescriptorSetAllocateInfo(
            descriptorPool=pool, pSetLayouts=self._set_layouts
        )
        sets = list(vk.vkAllocateDescriptorSets(handle, allocate))
        writes = []
        alike: Counter[Descriptor] = Counter()
        for each in self._places():
            kind = each._replace(set=0, binding=0, length=1)
            infos = self._infos(attachment, each, alike[kind])
            alike[kind] += 1
            writes.append(
                vk.VkWriteDescriptorSet(
                    dstSet=sets[each.set],
                    dstBinding=each.binding,
                    descriptorCount=each.length,
                    descriptorType=each.type,
                    **infos,
                )
            )
        vk.vkUpdateDescriptorSets(handle, len(writes), writes, 0, None)
        return sets

    def _infos(
        self, attachment: Callable[[Descriptor], Any], each: Descriptor, number: int
    ) -> dict[str, list[Any]]:
        vk, made = self.vk, resources(self.objects.opened)
        if each.type in TEXELS:
            return {"pTexelBufferView": [made.texels(each, number)] * each.length}
        if each.type == INPUT_ATTACHMENT:
            return {"pImageInfo": [attachment(each)] * each.length}
        if each.type == SAMPLER or each.type in IMAGES:
            info = vk.VkDescriptorImageInfo(
                sampler=made.sampler(each) if each.type in (SAMPLER, COMBINED) else None,
                imageView=made.view(each, number) if each.type != SAMPLER else None,
                imageLayout=GENERAL_LAYOUT if each.type == STORAGE_IMAGE else READ_LAYOUT,
            )
            return {"pImageInfo": [info] * each.length}
        buffer = vk.VkDescriptorBufferInfo(buffer=made.buffer(each, number), offset=0, range=WHOLE)
        return {"pBufferInfo": [buffer] * each.length}

    def _attachment(
        self,
        frame_pass: Pass,
        framebuffer: int,
        images: Sequence[Image],
        view: AttachmentView,
        each: Descriptor,
    ) -> Any:
        reference = frame_pass.subpasses[self.pipeline.subpass].inputs[each.attachment]
        stated = frame_pass.framebuffers[framebuffer]
        number = stated.images[reference.attachment]
        aspects = images[number].aspects
        aspect = (
            COLOR if aspects & COLOR else STENCIL if each.nearest and aspects & STENCIL else DEPTH
        )
        return self.vk.VkDescriptorImageInfo(
            sampler=None, imageView=view(number, stated, aspect), imageLayout=reference.layout
        )

    def bind(self, buffer: Any, framebuffer: int) -> None:
        """Records the binding of the sets and the push constants."""
        vk = self.vk
        sets = self._sets[min(framebuffer, len(self._sets) - 1)] if self._sets else []
        if sets:
            vk.vkCmdBindDescriptorSets(buffer, 0, self.layout, 0, len(sets), sets, 0, None)
        if self._pushed:
            vk.vkCmdPushConstants(
                buffer, self.layout, self._pushing, 0, len(self._pushed), push_bytes(self._pushed)
            )
