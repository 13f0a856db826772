"""Long captures of programs that do not exist, in blocks of text without end, as gfxrecon-convert
0.9 and 1.x write them.

`changing`: no two frames are alike, and hardly a line recurs: attachments and command buffers are
made anew, and draws differ in number, pipelines and arguments. `game`: 1,000 draws a frame with
dynamic state, and descriptors by template in sets that are allocated anew.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator

from tests.input.captures.program import (
    COLOR,
    D32,
    DEPTH,
    RGBA8,
    SAMPLED,
    TRANSIENT,
    Program,
    attachment,
)
from tests.input.readers.dialects import new_lines, old_lines

PIPELINES = 40
TEXTURES = 200
SIZE = '{"width":256,"height":128}'
GRAPHICS = '"pipelineBindPoint":"VK_PIPELINE_BIND_POINT_GRAPHICS"'
IMAGE = (
    '{"sType":"VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO","pNext":null,"flags":0,"imageType":"VK_IMAGE_TYPE_2D","format":"%s",'
    '"extent":{"width":256,"height":128,"depth":1},"mipLevels":1,"arrayLayers":1,"samples":"VK_SAMPLE_COUNT_4_BIT",'
    '"tiling":"VK_IMAGE_TILING_OPTIMAL","usage":%d,"sharingMode":"VK_SHARING_MODE_EXCLUSIVE","queueFamilyIndexCount":0,'
    '"pQueueFamilyIndices":null,"initialLayout":"VK_IMAGE_LAYOUT_UNDEFINED"}'
)
VIEW = (
    '{"sType":"VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO","pNext":null,"flags":0,"image":%d,"viewType":"VK_IMAGE_VIEW_TYPE_2D",'
    '"format":"%s","components":{"r":"VK_COMPONENT_SWIZZLE_R","g":"VK_COMPONENT_SWIZZLE_G","b":"VK_COMPONENT_SWIZZLE_B",'
    '"a":"VK_COMPONENT_SWIZZLE_A"},"subresourceRange":{"aspectMask":%d,"baseMipLevel":0,"levelCount":1,"baseArrayLayer":0,"layerCount":1}}'
)
IMAGE_INFO = (
    '{"sampler":10,"imageView":%d,"imageLayout":"VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL"}'
)
BARRIER = (
    '{"sType":"VK_STRUCTURE_TYPE_DEPENDENCY_INFO","pNext":null,"dependencyFlags":0,"memoryBarrierCount":1,"pMemoryBarriers":[{'
    '"sType":"VK_STRUCTURE_TYPE_MEMORY_BARRIER_2","pNext":null,"srcStageMask":"VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT",'
    '"srcAccessMask":"VK_ACCESS_2_INDEX_READ_BIT","dstStageMask":"VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT",'
    '"dstAccessMask":"VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT"}],"bufferMemoryBarrierCount":0,"pBufferMemoryBarriers":null,'
    '"imageMemoryBarrierCount":0,"pImageMemoryBarriers":null}'
)
STATES = (
    ("vkCmdSetDepthTestEnable", '"depthTestEnable":1'),
    ("vkCmdSetDepthWriteEnable", '"depthWriteEnable":1'),
    ("vkCmdSetDepthCompareOp", '"depthCompareOp":"VK_COMPARE_OP_LESS_OR_EQUAL"'),
    (
        "vkCmdSetColorBlendEnableEXT",
        '"firstAttachment":0,"attachmentCount":1,"pColorBlendEnables":[1]',
    ),
)


class Scene:
    """The objects that live as long as the program, and a counter of handles and of numbers that
    never recur.
    """

    def __init__(self) -> None:
        program = Program()
        self.swapchain_images = program.swap()
        self.swapchain = program.swapchain
        self.textures = [
            program.view(program.image(samples=1, usage=SAMPLED)) for _ in range(TEXTURES)
        ]
        targets = [
            attachment(store="STORE"),
            attachment(D32, store="DONT_CARE"),
            attachment(samples=1, store="STORE"),
        ]
        self.render_pass = program.render_pass(targets, resolve=[2], depth=1)
        self.pipelines = [program.pipeline(self.render_pass) for _ in range(PIPELINES)]
        self.swapchain_views = [program.view(image) for image in self.swapchain_images]
        images = [
            program.image(RGBA8, 4, COLOR | TRANSIENT),
            program.image(D32, 4, DEPTH | TRANSIENT),
        ]
        views = [program.view(image) for image in images]
        self.framebuffers = [
            program.framebuffer(self.render_pass, [*views, view]) for view in self.swapchain_views
        ]
        entry = {
            "dstBinding": 0,
            "dstArrayElement": 0,
            "descriptorCount": 1,
            "offset": 0,
            "stride": 24,
        }
        entry["descriptorType"] = "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER"
        template = {
            "descriptorUpdateEntryCount": 1,
            "pDescriptorUpdateEntries": [entry],
            "templateType": 0,
            "descriptorSetLayout": 11,
        }
        program.call(
            "vkCreateDescriptorUpdateTemplate",
            device=2,
            pCreateInfo=template,
            pAllocator=None,
            pDescriptorUpdateTemplate=9,
        )
        self.program = program
        self.next = itertools.count(10_000).__next__


def text(
    prefix: list[str], frames: Iterator[list[tuple[str, str]]], function: str
) -> Iterator[bytes]:
    """The text of a capture: its first lines, then the calls of frames, each a name and its
    arguments.
    """
    yield "".join(f"{line}\n" for line in prefix).encode()
    index = len(prefix) + 1
    for calls in frames:
        yield "".join(
            f'{{"index":{number},"{function}":{{"name":"{name}",{_result(name)}"args":{{{args}}}}}}}\n'
            for number, (name, args) in enumerate(calls, index)
        ).encode()
        index += len(calls)


def _result(name: str) -> str:
    return (
        ""
        if name.startswith(("vkCmd", "vkDestroy", "vkUpdate", "vkFree"))
        else '"return":"VK_SUCCESS",'
    )


def changing() -> Iterator[bytes]:
    """Frames that never repeat, as version 0.9 writes them."""
    scene = Scene()
    return text(
        old_lines(scene.program.calls),
        (_changing_frame(scene, number) for number in itertools.count()),
        "vkFunc",
    )


def _changing_frame(scene: Scene, number: int) -> list[tuple[str, str]]:
    new = scene.next
    buffer, framebuffer = new(), new()
    images, views = [new(), new()], [new(), new()]
    calls: list[tuple[str, str]] = []

    def call(name: str, args: str) -> None:
        calls.append((name, args))

    for image, view, (form, usage, aspect) in zip(
        images, views, ((RGBA8, COLOR, 1), (D32, DEPTH, 2)), strict=True
    ):
        call(
            "vkCreateImage",
            f'"device":2,"pCreateInfo":{IMAGE % (form, usage | TRANSIENT)},"pAllocator":null,"pImage":{image}',
        )
        call(
            "vkBindImageMemory",
            f'"device":2,"image":{image},"memory":7,"memoryOffset":{new() * 4096}',
        )
        call(
            "vkCreateImageView",
            f'"device":2,"pCreateInfo":{VIEW % (image, form, aspect)},"pAllocator":null,"pView":{view}',
        )
    target = number % 3
    attachments = f"{views[0]},{views[1]},{scene.swapchain_views[target]}"
    info = (
        f'{{"sType":"VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO","pNext":null,"flags":0,"renderPass":{scene.render_pass},'
        f'"attachmentCount":3,"pAttachments":[{attachments}],"width":256,"height":128,"layers":1}}'
    )
    call(
        "vkCreateFramebuffer",
        f'"device":2,"pCreateInfo":{info},"pAllocator":null,"pFramebuffer":{framebuffer}',
    )
    call(
        "vkAllocateCommandBuffers",
        f'"device":2,"pAllocateInfo":{{"commandPool":3,"commandBufferCount":1}},"pCommandBuffers":[{buffer}]',
    )
    call(
        "vkBeginCommandBuffer",
        f'"commandBuffer":{buffer},"pBeginInfo":{{"pNext":null,"flags":1,"pInheritanceInfo":null}}',
    )
    _begin(call, scene, buffer, framebuffer)
    for draw in range(60 + number * 7 % 41):
        pipeline = scene.pipelines[(number * 13 + draw // 3) % PIPELINES]
        call("vkCmdBindPipeline", f'"commandBuffer":{buffer},{GRAPHICS},"pipeline":{pipeline}')
        call(
            "vkCmdPushConstants",
            f'"commandBuffer":{buffer},"layout":8,"stageFlags":1,"offset":0,"size":64,"pValues":"0x{0x7F00_0000_0000 + new():x}"',
        )
        call(
            "vkCmdBindVertexBuffers",
            f'"commandBuffer":{buffer},"firstBinding":0,"bindingCount":1,"pBuffers":[6],"pOffsets":[{new() * 16}]',
        )
        call(
            "vkCmdBindIndexBuffer",
            f'"commandBuffer":{buffer},"buffer":6,"offset":{new() * 4},"indexType":"VK_INDEX_TYPE_UINT16"',
        )
        indices = f'"indexCount":{3 * (new() % 997 + 1)},"instanceCount":1,"firstIndex":{new()},"vertexOffset":0,"firstInstance":0'
        call("vkCmdDrawIndexed", f'"commandBuffer":{buffer},{indices}')
    _end(call, scene, buffer, target)
    call("vkDestroyFramebuffer", f'"device":2,"framebuffer":{framebuffer},"pAllocator":null')
    for image, view in zip(images, views, strict=True):
        call("vkDestroyImageView", f'"device":2,"imageView":{view},"pAllocator":null')
        call("vkDestroyImage", f'"device":2,"image":{image},"pAllocator":null')
    call(
        "vkFreeCommandBuffers",
        f'"device":2,"commandPool":3,"commandBufferCount":1,"pCommandBuffers":[{buffer}]',
    )
    return calls


def _begin(call: Callable[[str, str], None], scene: Scene, buffer: int, framebuffer: int) -> None:
    clears = '{"color":{"float32":[0.000000,0.000000,0.000000,1.000000]}},{"depthStencil":{"depth":1.000000,"stencil":0}}'
    info = (
        f'{{"sType":"VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO","pNext":null,"renderPass":{scene.render_pass},"framebuffer":{framebuffer},'
        f'"renderArea":{{"offset":{{"x":0,"y":0}},"extent":{SIZE}}},"clearValueCount":2,"pClearValues":[{clears}]}}'
    )
    call(
        "vkCmdBeginRenderPass",
        f'"commandBuffer":{buffer},"pRenderPassBegin":{info},"contents":"VK_SUBPASS_CONTENTS_INLINE"',
    )


def _end(call: Callable[[str, str], None], scene: Scene, buffer: int, target: int) -> None:
    call("vkCmdEndRenderPass", f'"commandBuffer":{buffer}')
    call("vkEndCommandBuffer", f'"commandBuffer":{buffer}')
    submit = (
        f'{{"sType":"VK_STRUCTURE_TYPE_SUBMIT_INFO","pNext":null,"waitSemaphoreCount":0,"pWaitSemaphores":null,"commandBufferCount":1,'
        f'"pCommandBuffers":[{buffer}],"signalSemaphoreCount":1,"pSignalSemaphores":[{scene.next()}]}}'
    )
    call("vkQueueSubmit", f'"queue":5,"submitCount":1,"pSubmits":[{submit}],"fence":0')
    info = (
        f'{{"sType":"VK_STRUCTURE_TYPE_PRESENT_INFO_KHR","pNext":null,"waitSemaphoreCount":1,"pWaitSemaphores":[{scene.next()}],'
        f'"swapchainCount":1,"pSwapchains":[{scene.swapchain}],"pImageIndices":[{target}],"pResults":null}}'
    )
    call("vkQueuePresentKHR", f'"queue":5,"pPresentInfo":{info}')


def game() -> Iterator[bytes]:
    """A game's frames of 1,000 draws with descriptors by template, as version 1.x writes them."""
    scene = Scene()
    return text(
        new_lines(scene.program.calls),
        (_game_frame(scene, number) for number in itertools.count()),
        "function",
    )


def _game_frame(scene: Scene, number: int) -> list[tuple[str, str]]:
    new = scene.next
    buffer, uploads = 100_000_000 + number % 4 * 2, 100_000_001 + number % 4 * 2
    calls: list[tuple[str, str]] = []

    def call(name: str, args: str) -> None:
        calls.append((name, args))

    for each in (buffer, uploads):
        call(
            "vkBeginCommandBuffer",
            f'"commandBuffer":{each},"pBeginInfo":{{"pNext":null,"flags":1,"pInheritanceInfo":null}}',
        )
    _begin(call, scene, buffer, scene.framebuffers[number % 3])
    for draw in range(1000):
        if draw % 4 == 0:
            pipeline = scene.pipelines[(number + draw // 25) % PIPELINES]
            call("vkCmdBindPipeline", f'"commandBuffer":{buffer},{GRAPHICS},"pipeline":{pipeline}')
            for name, state in STATES:
                call(name, f'"commandBuffer":{buffer},{state}')
        descriptors = new()
        if draw % 25 == 0:
            handles = ",".join(str(descriptors + each) for each in range(25))
            call(
                "vkAllocateDescriptorSets",
                f'"device":2,"pAllocateInfo":{{"descriptorPool":4}},"pDescriptorSets":[{handles}]',
            )
        texture = scene.textures[(number + draw * 7) % TEXTURES]
        data = f'{{"imageInfos":[{IMAGE_INFO % texture}]}}'
        call(
            "vkUpdateDescriptorSetWithTemplate",
            f'"device":2,"descriptorSet":{descriptors},"descriptorUpdateTemplate":9,"pData":{data}',
        )
        bound = f'"firstSet":0,"descriptorSetCount":1,"pDescriptorSets":[{descriptors}],"dynamicOffsetCount":0,"pDynamicOffsets":null'
        call("vkCmdBindDescriptorSets", f'"commandBuffer":{buffer},{GRAPHICS},"layout":8,{bound}')
        offsets = f'"pBuffers":[6,6],"pOffsets":[{draw * 192},{draw * 192 + 96}]'
        call(
            "vkCmdBindVertexBuffers",
            f'"commandBuffer":{buffer},"firstBinding":0,"bindingCount":2,{offsets}',
        )
        indices = f'"indexCount":{3 * (draw % 97 + 3)},"instanceCount":1,"firstIndex":{number * 31 + draw * 9},"vertexOffset":0'
        call("vkCmdDrawIndexed", f'"commandBuffer":{buffer},{indices},"firstInstance":0')
        call("vkCmdPipelineBarrier2", f'"commandBuffer":{uploads},"pDependencyInfo":{BARRIER}')
    call("vkEndCommandBuffer", f'"commandBuffer":{uploads}')
    _end(call, scene, buffer, number % 3)
    call("vkResetDescriptorPool", '"device":2,"descriptorPool":4,"flags":0')
    return calls
