"""Converts RenderDoc's chunks to C calls: parameter names, one-element arrays, and chunks that
stand for several calls.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Call, Place
from msaa_lint.input.captures.values import record

from .renderdoc_sets import DescriptorSets

ENUMERATE_DEVICES = "vkEnumeratePhysicalDevices"
INITIAL_CONTENTS = "Internal::Initial Contents"

MAX_SWAPCHAIN_IMAGES = 64
"""Maximum number of images in a swapchain; drivers create about three."""

MAX_SWAPCHAINS = 1000

MAX_OBJECTS = 300_000
"""Maximum number of objects whose type is kept for debug names."""

RENAMED = {
    "SubpassBegin": "pSubpassBeginInfo",
    "SubpassEnd": "pSubpassEndInfo",
    "Label": "pLabelInfo",
    "Marker": "pMarkerInfo",
    "CmdPool": "pCommandPool",
    "destImage": "dstImage",
    "destImageLayout": "dstImageLayout",
    "destBuffer": "dstBuffer",
    "destStageMask": "dstStageMask",
    "memoryRequirements": "",
    "Decoded Writes": "pDescriptorWrites",
}
"""C names of chunk, unless they are RenderDoc's name with `p` before a capital; empty if C has no
such parameter.
"""

_PIPELINES = {"count": "createInfoCount", "CreateInfo": "pCreateInfos", "Pipeline": "pPipelines"}

RENAMED_BY_CALL: dict[str, dict[str, str]] = {
    "vkBeginCommandBuffer": {"CommandBuffer": "commandBuffer", "device": "", "AllocateInfo": ""},
    "vkEndCommandBuffer": {"CommandBuffer": "commandBuffer"},
    "vkCreateSwapchainKHR": {"SwapChain": "pSwapchain", "NumImages": ""},
    "vkUpdateDescriptorSets": {
        "writeCount": "descriptorWriteCount",
        "copyCount": "descriptorCopyCount",
    },
    "vkCmdBindDescriptorSets": {"setCount": "descriptorSetCount"},
    "vkCmdCopyImage2": {"CopyInfo": "pCopyImageInfo"},
    "vkCmdBlitImage2": {"BlitInfo": "pBlitImageInfo"},
    "vkCmdResolveImage2": {"ResolveInfo": "pResolveImageInfo"},
    "vkCmdCopyImageToBuffer2": {"CopyInfo": "pCopyImageToBufferInfo"},
    "vkCmdCopyBufferToImage2": {"CopyInfo": "pCopyBufferToImageInfo"},
    "vkCreateGraphicsPipelines": _PIPELINES,
    "vkCreateComputePipelines": _PIPELINES,
    "vkCreateRayTracingPipelinesKHR": _PIPELINES,
    "vkAllocateCommandBuffers": {"CommandBuffer": "pCommandBuffers"},
    "vkAllocateDescriptorSets": {"DescriptorSet": "pDescriptorSets"},
    "vkQueuePresentKHR": {"PresentedImage": ""},
}
"""As RENAMED, for single calls."""

ARRAYS = frozenset({"pCreateInfos", "pPipelines", "pCommandBuffers", "pDescriptorSets"})
"""Parameters of calls that create several objects: a chunk contains one."""

APPLICATION_MEMBERS = {
    "AppName": "pApplicationName",
    "AppVersion": "applicationVersion",
    "EngineName": "pEngineName",
    "EngineVersion": "engineVersion",
    "APIVersion": "apiVersion",
}

NAMED_OBJECTS = {
    "vkCreateImage": ("Image", "IMAGE"),
    "vkCreateImageView": ("View", "IMAGE_VIEW"),
    "vkCreateRenderPass": ("RenderPass", "RENDER_PASS"),
    "vkCreateRenderPass2": ("RenderPass", "RENDER_PASS"),
    "vkCreateGraphicsPipelines": ("Pipeline", "PIPELINE"),
    "vkCreateFramebuffer": ("Framebuffer", "FRAMEBUFFER"),
    "vkCreateSwapchainKHR": ("SwapChain", "SWAPCHAIN_KHR"),
    "vkGetSwapchainImagesKHR": ("SwapchainImage", "IMAGE"),
}
"""Calls that create objects with debug names: the parameter with the handle, and the VkObjectType,
which a debug-name chunk omits.
"""

_SET_CALLS = frozenset({"vkUpdateDescriptorSets"})
_NAME_CALLS = frozenset({"vkSetDebugUtilsObjectName", "vkDebugMarkerSetObjectName"})

NEEDED_FOR = {
    **dict.fromkeys(
        (
            INITIAL_CONTENTS,
            "vkCreateDescriptorSetLayout",
            "vkAllocateDescriptorSets",
            "vkUpdateDescriptorSetWithTemplate",
        ),
        _SET_CALLS,
    ),
    **dict.fromkeys(NAMED_OBJECTS, _NAME_CALLS),
    "vkCreateImage": _NAME_CALLS | {"vkGetImageMemoryRequirements"},
    ENUMERATE_DEVICES: frozenset(
        f"vkGetPhysicalDevice{query}"
        for query in ("Properties", "Properties2", "MemoryProperties", "Features")
    ),
}
"""Chunks that are read because other calls need them."""


class CallConverter:
    """Converts chunks to calls, with the state that later chunks need from earlier ones."""

    def __init__(self) -> None:
        self.swapchains: dict[Any, list[Any]] = {}
        self.types: dict[Any, str] = {}
        self.sets = DescriptorSets()

    def calls(self, name: str, chunk: dict[str, Any], at: Place) -> Iterator[Call]:
        """The calls for a chunk. The queries for a device's properties come before the call that
        enumerates it.
        """
        if name in NAMED_OBJECTS:
            parameter, kind = NAMED_OBJECTS[name]
            handle = chunk.get(parameter)
            if type(handle) is int and len(self.types) < MAX_OBJECTS:
                self.types[handle] = kind
        if name == INITIAL_CONTENTS:
            yield from self.sets.initial_contents(chunk, at)
            return
        if name == ENUMERATE_DEVICES:
            yield from _device_queries(chunk, at)
            arguments = {
                "instance": chunk.get("instance"),
                "pPhysicalDeviceCount": 1,
                "pPhysicalDevices": [chunk.get("PhysicalDevice")],
            }
        elif name == "vkCreateInstance":
            arguments = _instance(chunk)
        elif name == "vkGetSwapchainImagesKHR":
            arguments = self.swapchain_images(chunk)
        elif name in ("vkSetDebugUtilsObjectNameEXT", "vkDebugMarkerSetObjectNameEXT"):
            arguments = self.debug_name(name, chunk)
        else:
            arguments = _renamed(name, chunk)
        self.sets.observe(name, arguments)
        yield Call(name, arguments, at)
        if name == "vkCreateImage" and isinstance(chunk.get("memoryRequirements"), dict):
            needs = {
                "device": chunk.get("device"),
                "image": chunk.get("Image"),
                "pMemoryRequirements": chunk["memoryRequirements"],
            }
            yield Call("vkGetImageMemoryRequirements", needs, at)

    def swapchain_images(self, chunk: dict[str, Any]) -> dict[str, Any]:
        """The arguments of vkGetSwapchainImagesKHR: a chunk has one image, the call also the
        earlier ones.
        """
        swapchain, index, image = (
            chunk.get("Swapchain"),
            chunk.get("SwapchainImageIndex"),
            chunk.get("SwapchainImage"),
        )
        images: list[Any] = []
        if type(swapchain) is int and type(index) is int and 0 <= index < MAX_SWAPCHAIN_IMAGES:
            if len(self.swapchains) < MAX_SWAPCHAINS:
                images = self.swapchains.setdefault(swapchain, images)
            images.extend([0] * (index + 1 - len(images)))
            images[index] = image
        return {
            "device": chunk.get("device"),
            "swapchain": swapchain,
            "pSwapchainImageCount": len(images),
            "pSwapchainImages": list(images),
        }

    def debug_name(self, name: str, chunk: dict[str, Any]) -> dict[str, Any]:
        """The arguments of a debug-name call, with the object type if it is known."""
        handle = chunk.get("Object")
        kind = self.types.get(handle) if type(handle) is int else None
        utils = name == "vkSetDebugUtilsObjectNameEXT"
        of_type = (
            None
            if kind is None
            else f"VK_OBJECT_TYPE_{kind}"
            if utils
            else f"VK_DEBUG_REPORT_OBJECT_TYPE_{kind}_EXT"
        )
        info = {
            "objectType": of_type,
            "objectHandle" if utils else "object": handle,
            "pObjectName": chunk.get("ObjectName"),
        }
        return {"pNameInfo": info}


def _renamed(name: str, chunk: dict[str, Any]) -> dict[str, Any]:
    call_names = RENAMED | RENAMED_BY_CALL.get(name, {})
    out: dict[str, Any] = {}
    for key, value in chunk.items():
        renamed = call_names.get(key, "p" + key if key[:1].isupper() else key)
        if renamed:
            out[renamed] = [value] if key in call_names and renamed in ARRAYS else value
    return out


def _device_queries(chunk: dict[str, Any], at: Place) -> Iterator[Call]:
    """RenderDoc's record of the physical device as the queries that return it."""
    device = chunk.get("PhysicalDevice")
    properties, memory, features, driver = (
        chunk.get(key) for key in ("physProps", "memProps", "physFeatures", "driverProps")
    )
    if isinstance(properties, dict):
        yield Call(
            "vkGetPhysicalDeviceProperties",
            {"physicalDevice": device, "pProperties": properties},
            at,
        )
        if isinstance(driver, dict):
            second = {
                "sType": "VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2",
                "pNext": driver,
                "properties": properties,
            }
            yield Call(
                "vkGetPhysicalDeviceProperties2",
                {"physicalDevice": device, "pProperties": second},
                at,
            )
    if isinstance(memory, dict):
        trimmed = dict(memory)
        for count, array in (
            ("memoryTypeCount", "memoryTypes"),
            ("memoryHeapCount", "memoryHeaps"),
        ):
            # The arrays have C's fixed length.
            if isinstance(trimmed.get(array), list) and type(trimmed.get(count)) is int:
                trimmed[array] = trimmed[array][: max(trimmed[count], 0)]
        yield Call(
            "vkGetPhysicalDeviceMemoryProperties",
            {"physicalDevice": device, "pMemoryProperties": trimmed},
            at,
        )
    if isinstance(features, dict):
        yield Call(
            "vkGetPhysicalDeviceFeatures", {"physicalDevice": device, "pFeatures": features}, at
        )


def _instance(chunk: dict[str, Any]) -> dict[str, Any]:
    init = record(chunk.get("InitParams"))
    return {
        "pCreateInfo": {
            "sType": "VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO",
            "pNext": None,
            "pApplicationInfo": {
                member: init[key] for key, member in APPLICATION_MEMBERS.items() if key in init
            },
            "ppEnabledLayerNames": init.get("Layers"),
            "ppEnabledExtensionNames": init.get("Extensions"),
        },
        "pInstance": init.get("InstanceID"),
    }
