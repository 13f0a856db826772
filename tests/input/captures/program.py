"""A Vulkan program as the calls that it makes: what a capture of it would hold, in no tool's
spelling.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from msaa_lint.core import finding
from msaa_lint.linter.request import Request
from msaa_lint.linter.run import run

Args = dict[str, Any]

COLOR, DEPTH, SAMPLED, TRANSIENT, SOURCE, TARGET = 0x10, 0x20, 0x4, 0x40, 0x1, 0x2
RGBA8, D32 = "VK_FORMAT_R8G8B8A8_UNORM", "VK_FORMAT_D32_SFLOAT"
GRAPHICS = "VK_PIPELINE_BIND_POINT_GRAPHICS"
SIZE = (256, 128)


class Program:
    """The calls so far. Handles are numbers; `reuse` gives the handles of destroyed objects to new
    ones, as pointers are.
    """

    def __init__(self, reuse: bool = False) -> None:
        self.calls: list[tuple[str, Args]] = []
        self.reuse = reuse
        self.next = 100
        self.free: list[int] = []
        self.swapchain_images: list[int] = []
        self.swapchain = 0
        self.call(
            "vkCreateDevice",
            physicalDevice=1,
            pCreateInfo={"sType": "VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO"},
            pDevice=2,
        )

    def call(self, name: str, **args: Any) -> None:
        """Any call."""
        self.calls.append((name, args))

    def handle(self) -> int:
        """A handle for a new object."""
        if self.reuse and self.free:
            return self.free.pop()
        self.next += 1
        return self.next

    def destroy(self, kind: str, member: str, handle: int) -> None:
        """Destroys an object; its handle may then be another's."""
        self.call(f"vkDestroy{kind}", **{"device": 2, member: handle})
        self.free.append(handle)

    def image(
        self,
        format: str = RGBA8,
        samples: int = 4,
        usage: int = COLOR,
        layers: int = 1,
        name: str | None = None,
    ) -> int:
        """An image of `SIZE`."""
        made = self.handle()
        info = {
            "flags": 0, "imageType": "VK_IMAGE_TYPE_2D", "format": format,
            "extent": {"width": SIZE[0], "height": SIZE[1], "depth": 1},
            "mipLevels": 1, "arrayLayers": layers, "samples": f"VK_SAMPLE_COUNT_{samples}_BIT",
            "tiling": "VK_IMAGE_TILING_OPTIMAL",
            "usage": usage, "sharingMode": "VK_SHARING_MODE_EXCLUSIVE",
            "initialLayout": "VK_IMAGE_LAYOUT_UNDEFINED",
        }  # fmt: skip
        self.call("vkCreateImage", device=2, pCreateInfo=info, pAllocator=None, pImage=made)
        if name is not None:
            self.name("VK_OBJECT_TYPE_IMAGE", made, name)
        return made

    def name(self, kind: str, handle: int, name: str) -> None:
        """vkSetDebugUtilsObjectNameEXT."""
        self.call(
            "vkSetDebugUtilsObjectNameEXT",
            device=2,
            pNameInfo={"objectType": kind, "objectHandle": handle, "pObjectName": name},
        )

    def view(self, image: int) -> int:
        """A view of all of an image."""
        made = self.handle()
        info = {
            "image": image,
            "subresourceRange": {"aspectMask": 1, "levelCount": 1, "layerCount": 1},
        }
        self.call("vkCreateImageView", device=2, pCreateInfo=info, pAllocator=None, pView=made)
        return made

    def swap(self, count: int = 3) -> list[int]:
        """A swapchain and its images."""
        self.swapchain = self.handle()
        info = {
            "minImageCount": count, "imageFormat": RGBA8, "imageExtent": {"width": SIZE[0],
            "height": SIZE[1]}, "imageArrayLayers": 1,
            "imageUsage": COLOR, "imageSharingMode": "VK_SHARING_MODE_EXCLUSIVE",
        }  # fmt: skip
        self.call(
            "vkCreateSwapchainKHR",
            device=2,
            pCreateInfo=info,
            pAllocator=None,
            pSwapchain=self.swapchain,
        )
        self.call(
            "vkGetSwapchainImagesKHR",
            device=2,
            swapchain=self.swapchain,
            pSwapchainImageCount=count,
            pSwapchainImages=None,
        )
        self.swapchain_images = [self.handle() for _ in range(count)]
        listed = self.swapchain_images
        self.call(
            "vkGetSwapchainImagesKHR",
            device=2,
            swapchain=self.swapchain,
            pSwapchainImageCount=count,
            pSwapchainImages=listed,
        )
        return self.swapchain_images

    def render_pass(
        self, attachments: Sequence[Args], color: Sequence[int] = (0,),
        resolve: Sequence[int] = (), depth: int | None = None,
        two: bool = False,
    ) -> int:  # fmt: skip
        """A render pass of one subpass; `two`: by vkCreateRenderPass2KHR."""
        made = self.handle()
        subpass: Args = {
            "pipelineBindPoint": GRAPHICS, "colorAttachmentCount": len(color),
            "pColorAttachments": [_reference(each) for each in color],
            "pResolveAttachments": [_reference(each) for each in resolve] or None,
            "pDepthStencilAttachment": _reference(depth) if depth is not None else None,
        }  # fmt: skip
        info = {
            "attachmentCount": len(attachments),
            "pAttachments": list(attachments),
            "subpassCount": 1,
            "pSubpasses": [subpass],
        }
        name = "vkCreateRenderPass2KHR" if two else "vkCreateRenderPass"
        self.call(name, device=2, pCreateInfo=info, pAllocator=None, pRenderPass=made)
        return made

    def framebuffer(self, render_pass: int, views: Sequence[int], imageless: bool = False) -> int:
        """A framebuffer of `SIZE`."""
        made = self.handle()
        info: Args = {
            "flags": 1 if imageless else 0, "renderPass": render_pass,
            "attachmentCount": len(views),
            "pAttachments": None if imageless else list(views), "width": SIZE[0],
            "height": SIZE[1], "layers": 1,
        }  # fmt: skip
        self.call(
            "vkCreateFramebuffer", device=2, pCreateInfo=info, pAllocator=None, pFramebuffer=made
        )
        return made

    def pipeline(self, render_pass: int = 0, samples: int = 4, dynamic: Sequence[str] = ()) -> int:
        """A graphics pipeline."""
        made = self.handle()
        info = {
            "pMultisampleState": {"rasterizationSamples": f"VK_SAMPLE_COUNT_{samples}_BIT",
            "sampleShadingEnable": 0},
            "pColorBlendState": {"attachmentCount": 1, "pAttachments": [{"blendEnable": 0,
            "colorWriteMask": 15}]},
            "pDynamicState": {"dynamicStateCount": len(dynamic), "pDynamicStates": list(dynamic)},
            "renderPass": render_pass, "subpass": 0,
        }  # fmt: skip
        self.call(
            "vkCreateGraphicsPipelines",
            device=2,
            createInfoCount=1,
            pCreateInfos=[info],
            pPipelines=[made],
        )
        return made

    def buffer(self, secondary: bool = False) -> int:
        """A command buffer, begun."""
        made = self.handle()
        level = (
            "VK_COMMAND_BUFFER_LEVEL_SECONDARY" if secondary else "VK_COMMAND_BUFFER_LEVEL_PRIMARY"
        )
        info = {"commandPool": 3, "level": level, "commandBufferCount": 1}
        self.call("vkAllocateCommandBuffers", device=2, pAllocateInfo=info, pCommandBuffers=[made])
        self.call("vkBeginCommandBuffer", commandBuffer=made, pBeginInfo={"flags": 0})
        return made

    def begin(
        self, buffer: int, render_pass: int, framebuffer: int, views: Sequence[int] | None = None
    ) -> None:
        """vkCmdBeginRenderPass over the whole area; `views` are an imageless framebuffer's."""
        info: Args = {
            "renderPass": render_pass,
            "framebuffer": framebuffer,
            "renderArea": area(),
            "clearValueCount": 1,
        }
        if views is not None:
            info["pNext"] = {
                "sType": "VK_STRUCTURE_TYPE_RENDER_PASS_ATTACHMENT_BEGIN_INFO",
                "pAttachments": list(views),
            }
        self.call(
            "vkCmdBeginRenderPass",
            commandBuffer=buffer,
            pRenderPassBegin=info,
            contents="VK_SUBPASS_CONTENTS_INLINE",
        )

    def rendering(
        self, buffer: int, color: Sequence[Args], depth: Args | None = None, flags: int = 0
    ) -> None:
        """vkCmdBeginRendering over the whole area."""
        info: Args = {
            "flags": flags,
            "renderArea": area(),
            "layerCount": 1,
            "viewMask": 0,
            "pColorAttachments": list(color),
        }
        info["pDepthAttachment"] = depth
        self.call("vkCmdBeginRenderingKHR", commandBuffer=buffer, pRenderingInfo=info)

    def draw(self, buffer: int, pipeline: int = 0, vertices: int = 300) -> None:
        """A draw, with a pipeline bound before it where one is given."""
        if pipeline:
            self.call(
                "vkCmdBindPipeline",
                commandBuffer=buffer,
                pipelineBindPoint=GRAPHICS,
                pipeline=pipeline,
            )
        self.call(
            "vkCmdDraw",
            commandBuffer=buffer,
            vertexCount=vertices,
            instanceCount=1,
            firstVertex=0,
            firstInstance=0,
        )

    def end(self, buffer: int, rendering: bool = False) -> None:
        """The end of a pass."""
        self.call(
            "vkCmdEndRenderingKHR" if rendering else "vkCmdEndRenderPass", commandBuffer=buffer
        )

    def bind(self, buffer: int, *sets: int) -> None:
        """Descriptor sets for draws."""
        self.call(
            "vkCmdBindDescriptorSets",
            commandBuffer=buffer,
            pipelineBindPoint=GRAPHICS,
            firstSet=0,
            pDescriptorSets=list(sets),
        )

    def descriptor_set(self) -> int:
        """An empty descriptor set."""
        made = self.handle()
        self.call(
            "vkAllocateDescriptorSets",
            device=2,
            pAllocateInfo={"descriptorPool": 4},
            pDescriptorSets=[made],
        )
        return made

    def write(
        self, descriptor_set: int, view: int, binding: int = 0, kind: str = "COMBINED_IMAGE_SAMPLER"
    ) -> None:
        """A view into a descriptor set."""
        self.call(
            "vkUpdateDescriptorSets",
            device=2,
            pDescriptorWrites=[written(descriptor_set, view, binding, kind)],
        )

    def submit(self, *buffers: int) -> None:
        """vkQueueSubmit of command buffers that are recorded."""
        for buffer in buffers:
            self.call("vkEndCommandBuffer", commandBuffer=buffer)
        self.call(
            "vkQueueSubmit",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": list(buffers)}],
            fence=0,
        )

    def present(self, index: int = 0) -> None:
        """vkQueuePresentKHR of an image of the swapchain."""
        info = {"swapchainCount": 1, "pSwapchains": [self.swapchain], "pImageIndices": [index]}
        self.call("vkQueuePresentKHR", queue=5, pPresentInfo=info)

    def lines(self) -> list[str]:
        """The capture as gfxrecon-convert 1.x writes it, a call a line after the header."""
        head = json.dumps(
            {
                "header": {
                    "source-path": "p.gfxr",
                    "gfxrecon-version": "1.0.3",
                    "vulkan-version": "1.3.250",
                }
            }
        )
        calls = [
            json.dumps(
                {
                    "index": number,
                    "function": {"name": name, "thread": 1, "return": "VK_SUCCESS", "args": args},
                }
            )
            for number, (name, args) in enumerate(self.calls, 1)
        ]
        return [head, *calls]

    def text(self) -> bytes:
        """The lines as a file."""
        return ("\n".join(self.lines()) + "\n").encode()


def area() -> Args:
    """All of `SIZE`."""
    return {"offset": {"x": 0, "y": 0}, "extent": {"width": SIZE[0], "height": SIZE[1]}}


def attachment(
    format: str = RGBA8,
    samples: int = 4,
    load: str = "CLEAR",
    store: str = "DONT_CARE",
    final: str = "GENERAL",
) -> Args:
    """A VkAttachmentDescription."""
    return {
        "flags": 0, "format": format, "samples": f"VK_SAMPLE_COUNT_{samples}_BIT",
        "loadOp": f"VK_ATTACHMENT_LOAD_OP_{load}",
        "storeOp": f"VK_ATTACHMENT_STORE_OP_{store}",
        "stencilLoadOp": "VK_ATTACHMENT_LOAD_OP_DONT_CARE",
        "stencilStoreOp": "VK_ATTACHMENT_STORE_OP_DONT_CARE",
        "initialLayout": f"VK_IMAGE_LAYOUT_{'GENERAL' if load == 'LOAD' else 'UNDEFINED'}",
        "finalLayout": f"VK_IMAGE_LAYOUT_{final}",
    }  # fmt: skip


def info(view: int, load: str = "CLEAR", store: str = "DONT_CARE", resolve: int = 0) -> Args:
    """A VkRenderingAttachmentInfo; with a view to resolve to it averages."""
    return {
        "imageView": view, "imageLayout": "VK_IMAGE_LAYOUT_GENERAL",
        "resolveMode": f"VK_RESOLVE_MODE_{'AVERAGE_BIT' if resolve else 'NONE'}",
        "resolveImageView": resolve, "resolveImageLayout": "VK_IMAGE_LAYOUT_GENERAL",
        "loadOp": f"VK_ATTACHMENT_LOAD_OP_{load}",
        "storeOp": f"VK_ATTACHMENT_STORE_OP_{store}",
    }  # fmt: skip


def written(
    descriptor_set: int, view: int, binding: int = 0, kind: str = "COMBINED_IMAGE_SAMPLER"
) -> Args:
    """A VkWriteDescriptorSet of one image."""
    return {
        "dstSet": descriptor_set, "dstBinding": binding, "dstArrayElement": 0, "descriptorCount": 1,
        "descriptorType": f"VK_DESCRIPTOR_TYPE_{kind}",
        "pImageInfo": [{"sampler": 0, "imageView": view, "imageLayout": "VK_IMAGE_LAYOUT_GENERAL"}],
    }  # fmt: skip


def lint(data: bytes, **overrides: Any) -> list[finding.Finding]:
    """What `check` finds in an input, by place."""
    return list(run(Request(["-"], isolated=True, data=data, overrides=overrides)).result.findings)


def codes(findings: Sequence[finding.Finding]) -> list[str]:
    """The codes of findings, sorted."""
    return sorted(found.code for found in findings)


def _reference(index: int) -> Args:
    return {"attachment": index, "layout": "VK_IMAGE_LAYOUT_GENERAL"}
