"""Captures in which no two frames are alike: everything that a frame uses is created for it, with
other parameters than ever before, and destroyed after it.

`text` yields a capture of any size, for measurements of memory: `python
tests/benchmarks/shapes/capture_frames.py MB [kept] > out.jsonl`.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from typing import Any

DEVICE, QUEUE, POOL, LAYOUT, SWAPCHAIN = 2, 3, 4, 5, 6
SWAPCHAIN_IMAGES = (7, 8, 9)
GENERAL = "VK_IMAGE_LAYOUT_GENERAL"
EXCLUSIVE = "VK_SHARING_MODE_EXCLUSIVE"
MAX_PASSES = 6
DRAWS = 12


class Capture:
    """The lines of a capture as gfxrecon-convert 1.x writes them. `kept` leaves the images
    alive.
    """

    def __init__(self, kept: bool = False) -> None:
        self.kept = kept
        self.lines: list[bytes] = []
        self.index = 0
        self.handle = 100
        self.passes = 0

    def call(self, name: str, **args: Any) -> None:
        self.index += 1
        call = {
            "index": self.index,
            "function": {"name": name, "thread": 1, "return": "VK_SUCCESS", "args": args},
        }
        self.lines.append(json.dumps(call, separators=(",", ":")).encode() + b"\n")

    def create(self, kind: str, result: str, **info: Any) -> int:
        """A new object."""
        self.handle += 1
        self.call(
            f"vkCreate{kind}",
            device=DEVICE,
            pCreateInfo=info,
            pAllocator=None,
            **{result: self.handle},
        )
        return self.handle

    def start(self) -> None:
        """The device and the swapchain."""
        header = {
            "header": {
                "source-path": "p.gfxr",
                "gfxrecon-version": "1.0.3",
                "vulkan-version": "1.3.250",
            }
        }
        self.lines.append(json.dumps(header).encode() + b"\n")
        self.call("vkCreateDevice", physicalDevice=1, pCreateInfo={}, pDevice=DEVICE)
        extent = {"width": 1920, "height": 1080}
        info = {
            "imageFormat": "VK_FORMAT_B8G8R8A8_UNORM",
            "imageExtent": extent,
            "imageArrayLayers": 1,
            "imageUsage": 16,
        }
        self.call(
            "vkCreateSwapchainKHR",
            device=DEVICE,
            pCreateInfo=info,
            pAllocator=None,
            pSwapchain=SWAPCHAIN,
        )
        images = {"pSwapchainImageCount": 3, "pSwapchainImages": SWAPCHAIN_IMAGES}
        self.call("vkGetSwapchainImagesKHR", device=DEVICE, swapchain=SWAPCHAIN, **images)

    def frame(self, number: int) -> None:
        """A frame of passes that no other frame has."""
        self.handle += 1
        buffer = self.handle
        self.call(
            "vkAllocateCommandBuffers",
            device=DEVICE,
            pAllocateInfo={"commandPool": POOL},
            pCommandBuffers=[buffer],
        )
        self.handle += 1
        bound = self.handle
        self.call(
            "vkAllocateDescriptorSets",
            device=DEVICE,
            pAllocateInfo={"descriptorPool": POOL},
            pDescriptorSets=[bound],
        )
        self.call("vkBeginCommandBuffer", commandBuffer=buffer, pBeginInfo={"flags": 1})
        created: list[tuple[str, str, int]] = []
        for _ in range(1 + number % MAX_PASSES):
            self.a_pass(buffer, bound, created)
        self.call("vkEndCommandBuffer", commandBuffer=buffer)
        self.call(
            "vkQueueSubmit",
            queue=QUEUE,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": [buffer]}],
            fence=0,
        )
        presented = {"swapchainCount": 1, "pSwapchains": [SWAPCHAIN], "pImageIndices": [number % 3]}
        self.call("vkQueuePresentKHR", queue=QUEUE, pPresentInfo=presented)
        self.call(
            "vkFreeCommandBuffers",
            device=DEVICE,
            commandPool=POOL,
            commandBufferCount=1,
            pCommandBuffers=[buffer],
        )
        self.call(
            "vkFreeDescriptorSets",
            device=DEVICE,
            descriptorPool=POOL,
            descriptorSetCount=1,
            pDescriptorSets=[bound],
        )
        for kind, member, handle in reversed(created):
            if not (self.kept and kind in ("Image", "ImageView")):
                self.call(f"vkDestroy{kind}", device=DEVICE, **{member: handle}, pAllocator=None)

    def a_pass(self, buffer: int, bound: int, created: list[tuple[str, str, int]]) -> None:
        """A pass in images of a size, with a render pass and a pipeline, that no other pass has."""
        self.passes += 1
        width, height = 1 + self.passes % 4096, 1 + self.passes // 4096
        images, views = [], []
        for samples in (4, 1):
            image = self.create(
                "Image", "pImage", flags=0, imageType="VK_IMAGE_TYPE_2D",
                format="VK_FORMAT_R8G8B8A8_UNORM",
                extent={"width": width, "height": height, "depth": 1}, mipLevels=1, arrayLayers=1,
                samples=f"VK_SAMPLE_COUNT_{samples}_BIT",
                tiling="VK_IMAGE_TILING_OPTIMAL", usage=0x15, sharingMode=EXCLUSIVE,
                initialLayout="VK_IMAGE_LAYOUT_UNDEFINED",
            )  # fmt: skip
            part = {"aspectMask": 1, "levelCount": 1, "layerCount": 1}
            view = self.create("ImageView", "pView", image=image, subresourceRange=part)
            images.append(image)
            views.append(view)
            created += [("Image", "image", image), ("ImageView", "imageView", view)]
        attachments = [
            {
                "flags": 0, "format": "VK_FORMAT_R8G8B8A8_UNORM",
                "samples": f"VK_SAMPLE_COUNT_{samples}_BIT",
                "loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR", "storeOp": "VK_ATTACHMENT_STORE_OP_STORE",
                "stencilLoadOp": "VK_ATTACHMENT_LOAD_OP_DONT_CARE",
                "stencilStoreOp": "VK_ATTACHMENT_STORE_OP_DONT_CARE",
                "initialLayout": "VK_IMAGE_LAYOUT_UNDEFINED", "finalLayout": GENERAL,
            }
            for samples in (4, 1)
        ]  # fmt: skip
        references = [[{"attachment": index, "layout": GENERAL}] for index in (0, 1)]
        subpass = {
            "pipelineBindPoint": "VK_PIPELINE_BIND_POINT_GRAPHICS",
            "pColorAttachments": references[0],
        }
        dependency = {
            "srcSubpass": 4294967295, "dstSubpass": 0, "srcStageMask": 1024, "dstStageMask": 1024,
            "srcAccessMask": self.passes,
            "dstAccessMask": 256, "dependencyFlags": 0,
        }  # fmt: skip
        render_pass = self.create(
            "RenderPass", "pRenderPass", attachmentCount=2, pAttachments=attachments,
            subpassCount=1,
            pSubpasses=[{**subpass, "colorAttachmentCount": 1,
            "pResolveAttachments": references[1]}],
            dependencyCount=1, pDependencies=[dependency],
        )  # fmt: skip
        framebuffer = self.create(
            "Framebuffer", "pFramebuffer", flags=0, renderPass=render_pass, attachmentCount=2,
            pAttachments=views, width=width,
            height=height, layers=1,
        )  # fmt: skip
        self.handle += 1
        pipeline = self.handle
        blend = {"blendEnable": 0, "colorWriteMask": 15}
        state: dict[str, Any] = {
            "pMultisampleState": {
                "rasterizationSamples": "VK_SAMPLE_COUNT_4_BIT",
                "sampleShadingEnable": 0,
                "minSampleShading": 0.0,
            },
            "pColorBlendState": {
                "attachmentCount": 1,
                "pAttachments": [blend],
                "blendConstants": [0.0, 0.0, 0.0, 0.0],
            },
            "pDepthStencilState": {
                "depthTestEnable": 1,
                "depthWriteEnable": 1,
                "minDepthBounds": 0.0,
                "maxDepthBounds": 1.0,
            },
            "pStages": [{"stage": "VK_SHADER_STAGE_FRAGMENT_BIT", "module": 11, "pName": "main"}],
        }
        infos = [{**state, "layout": LAYOUT, "renderPass": render_pass, "subpass": 0}]
        self.call(
            "vkCreateGraphicsPipelines",
            device=DEVICE,
            createInfoCount=1,
            pCreateInfos=infos,
            pPipelines=[pipeline],
        )
        created += [
            ("RenderPass", "renderPass", render_pass),
            ("Framebuffer", "framebuffer", framebuffer),
            ("Pipeline", "pipeline", pipeline),
        ]
        self.call(
            "vkCmdBeginDebugUtilsLabelEXT",
            commandBuffer=buffer,
            pLabelInfo={"pLabelName": f"pass of {self.index:x}"},
        )
        sampled = {"sampler": 0, "imageView": views[1], "imageLayout": GENERAL}
        write = {
            "dstSet": bound, "dstBinding": self.passes % 8, "dstArrayElement": 0,
            "descriptorCount": 1,
            "descriptorType": "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER", "pImageInfo": [sampled],
        }  # fmt: skip
        self.call(
            "vkUpdateDescriptorSets",
            device=DEVICE,
            descriptorWriteCount=1,
            pDescriptorWrites=[write],
        )
        area = {"offset": {"x": 0, "y": 0}, "extent": {"width": width, "height": height}}
        begin = {
            "renderPass": render_pass,
            "framebuffer": framebuffer,
            "renderArea": area,
            "clearValueCount": 1,
        }
        self.call(
            "vkCmdBeginRenderPass",
            commandBuffer=buffer,
            pRenderPassBegin=begin,
            contents="VK_SUBPASS_CONTENTS_INLINE",
        )
        self.call(
            "vkCmdBindPipeline",
            commandBuffer=buffer,
            pipelineBindPoint="VK_PIPELINE_BIND_POINT_GRAPHICS",
            pipeline=pipeline,
        )
        sets = {
            "layout": LAYOUT,
            "firstSet": 0,
            "descriptorSetCount": 1,
            "pDescriptorSets": [bound],
        }
        self.call(
            "vkCmdBindDescriptorSets",
            commandBuffer=buffer,
            pipelineBindPoint="VK_PIPELINE_BIND_POINT_GRAPHICS",
            **sets,
        )
        for draw in range(DRAWS):
            vertices = self.passes * DRAWS + draw
            self.call(
                "vkCmdDraw",
                commandBuffer=buffer,
                vertexCount=vertices,
                instanceCount=1,
                firstVertex=0,
                firstInstance=draw,
            )
        self.call("vkCmdEndRenderPass", commandBuffer=buffer)
        barrier = {
            "srcAccessMask": 256, "dstAccessMask": 32, "oldLayout": GENERAL, "newLayout": GENERAL,
            "image": images[1],
            "subresourceRange": {"aspectMask": 1, "levelCount": 1, "layerCount": 1},
        }  # fmt: skip
        stages = {"srcStageMask": 1024, "dstStageMask": 128}
        self.call(
            "vkCmdPipelineBarrier",
            commandBuffer=buffer,
            **stages,
            imageMemoryBarrierCount=1,
            pImageMemoryBarriers=[barrier],
        )
        self.call("vkCmdEndDebugUtilsLabelEXT", commandBuffer=buffer)


def text(size: int, kept: bool = False) -> Iterator[bytes]:
    """The text of a capture of at least so many bytes; `kept` leaves all images alive."""
    capture = Capture(kept)
    capture.start()
    number = 0
    while size > 0:
        capture.frame(number)
        number += 1
        block = b"".join(capture.lines)
        capture.lines.clear()
        size -= len(block)
        yield block


if __name__ == "__main__":
    for block in text(int(sys.argv[1]) * 1_000_000, "kept" in sys.argv):
        sys.stdout.buffer.write(block)
