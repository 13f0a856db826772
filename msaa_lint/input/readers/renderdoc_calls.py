"""RenderDoc's chunks as C's calls: the names of parameters, lists of one, the calls that one chunk stands for."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Call, Place

from .renderdoc_sets import Sets

DEVICE = "vkEnumeratePhysicalDevices"
INITIAL = "Internal::Initial Contents"

MAX_SWAPCHAIN_IMAGES = 64
"""Images of a swapchain that are told; drivers give some three."""

MAX_SWAPCHAINS = 1000

MAX_OBJECTS = 300_000
"""Objects whose type is remembered for the sake of their names."""

RENAMED = {
    "SubpassBegin": "pSubpassBeginInfo",
    "SubpassEnd": "pSubpassEndInfo",
    "Label": "pLabelInfo",
    "CmdPool": "pCommandPool",
    "destImage": "dstImage",
    "destImageLayout": "dstImageLayout",
    "destBuffer": "dstBuffer",
    "destStageMask": "dstStageMask",
    "memoryRequirements": "",
}
"""Parameters whose C name is not RenderDoc's with `p` before a capital; without a name where C has no such parameter."""

OF_CALLS: dict[str, dict[str, str]] = {
    "vkBeginCommandBuffer": {"CommandBuffer": "commandBuffer", "device": "", "AllocateInfo": ""},
    "vkEndCommandBuffer": {"CommandBuffer": "commandBuffer"},
    "vkCreateSwapchainKHR": {"SwapChain": "pSwapchain", "NumImages": ""},
    "vkUpdateDescriptorSets": {"writeCount": "descriptorWriteCount", "copyCount": "descriptorCopyCount"},
    "vkCmdBindDescriptorSets": {"setCount": "descriptorSetCount"},
    "vkCmdCopyImage2": {"CopyInfo": "pCopyImageInfo"},
    "vkCmdBlitImage2": {"BlitInfo": "pBlitImageInfo"},
    "vkCmdResolveImage2": {"ResolveInfo": "pResolveImageInfo"},
    "vkCmdCopyImageToBuffer2": {"CopyInfo": "pCopyImageToBufferInfo"},
    "vkCmdCopyBufferToImage2": {"CopyInfo": "pCopyBufferToImageInfo"},
    "vkCreateGraphicsPipelines": {"count": "createInfoCount", "CreateInfo": "pCreateInfos", "Pipeline": "pPipelines"},
    "vkAllocateCommandBuffers": {"CommandBuffer": "pCommandBuffers"},
    "vkAllocateDescriptorSets": {"DescriptorSet": "pDescriptorSets"},
    "vkQueuePresentKHR": {"PresentedImage": ""},
}
"""As RENAMED, of single calls."""

ARRAYS = frozenset({"pCreateInfos", "pPipelines", "pCommandBuffers", "pDescriptorSets"})
"""Of calls that make several objects a chunk tells one."""

INSTANCE = {
    "AppName": "pApplicationName",
    "AppVersion": "applicationVersion",
    "EngineName": "pEngineName",
    "EngineVersion": "engineVersion",
    "APIVersion": "apiVersion",
}

NAMED = {
    "vkCreateImage": ("Image", "IMAGE"),
    "vkCreateRenderPass": ("RenderPass", "RENDER_PASS"),
    "vkCreateRenderPass2": ("RenderPass", "RENDER_PASS"),
    "vkCreateGraphicsPipelines": ("Pipeline", "PIPELINE"),
    "vkCreateFramebuffer": ("Framebuffer", "FRAMEBUFFER"),
    "vkCreateSwapchainKHR": ("SwapChain", "SWAPCHAIN_KHR"),
    "vkGetSwapchainImagesKHR": ("SwapchainImage", "IMAGE"),
}
"""Calls that make what findings name, the parameter that is its handle, and its VkObjectType, which the chunk of a name leaves out."""

_SETS = frozenset({"vkUpdateDescriptorSets"})
_NAMES = frozenset({"vkSetDebugUtilsObjectName", "vkDebugMarkerSetObjectName"})

NEEDED = {
    **dict.fromkeys((INITIAL, "vkCreateDescriptorSetLayout", "vkAllocateDescriptorSets", "vkUpdateDescriptorSetWithTemplate"), _SETS),
    **dict.fromkeys(NAMED, _NAMES),
    "vkCreateImage": _NAMES | {"vkGetImageMemoryRequirements"},
    DEVICE: frozenset(f"vkGetPhysicalDevice{query}" for query in ("Properties", "Properties2", "MemoryProperties", "Features")),
}
"""Chunks that are read for the sake of other calls."""


class Calls:
    """Chunks to calls; what earlier chunks said that later ones need."""

    def __init__(self) -> None:
        self.swapchains: dict[Any, list[Any]] = {}
        self.types: dict[Any, str] = {}
        self.sets = Sets()

    def of(self, name: str, given: dict[str, Any], at: Place) -> Iterator[Call]:
        """The calls that a chunk stands for, the device's truths before the call that finds it."""
        if name in NAMED:
            parameter, kind = NAMED[name]
            handle = given.get(parameter)
            if type(handle) is int and len(self.types) < MAX_OBJECTS:
                self.types[handle] = kind
        if name == INITIAL:
            yield from self.sets.initial(given, at)
            return
        if name == DEVICE:
            yield from _device(given, at)
            arguments = {"instance": given.get("instance"), "pPhysicalDeviceCount": 1, "pPhysicalDevices": [given.get("PhysicalDevice")]}
        elif name == "vkCreateInstance":
            arguments = _instance(given)
        elif name == "vkGetSwapchainImagesKHR":
            arguments = self.swapchain_images(given)
        elif name in ("vkSetDebugUtilsObjectNameEXT", "vkDebugMarkerSetObjectNameEXT"):
            arguments = self.named(name, given)
        else:
            arguments = _renamed(name, given)
        if name == "vkUpdateDescriptorSetWithTemplate" and isinstance(given.get("Decoded Writes"), list):
            # They name no set.
            writes = [{**each, "dstSet": given.get("descriptorSet")} for each in given["Decoded Writes"] if isinstance(each, dict)]
            name, arguments = "vkUpdateDescriptorSets", {"device": given.get("device"), "pDescriptorWrites": writes}
        self.sets.noted(name, arguments)
        yield Call(name, arguments, at)
        if name == "vkCreateImage" and isinstance(given.get("memoryRequirements"), dict):
            needs = {"device": given.get("device"), "image": given.get("Image"), "pMemoryRequirements": given["memoryRequirements"]}
            yield Call("vkGetImageMemoryRequirements", needs, at)

    def swapchain_images(self, given: dict[str, Any]) -> dict[str, Any]:
        """A chunk is one image: the call tells those that came before too, in their order."""
        swapchain, index, image = given.get("Swapchain"), given.get("SwapchainImageIndex"), given.get("SwapchainImage")
        known: list[Any] = []
        if type(swapchain) is int and type(index) is int and 0 <= index < MAX_SWAPCHAIN_IMAGES:
            if len(self.swapchains) < MAX_SWAPCHAINS:
                known = self.swapchains.setdefault(swapchain, known)
            known.extend([0] * (index + 1 - len(known)))
            known[index] = image
        return {"device": given.get("device"), "swapchain": swapchain, "pSwapchainImageCount": len(known), "pSwapchainImages": list(known)}

    def named(self, name: str, given: dict[str, Any]) -> dict[str, Any]:
        """A debug name, with the type of the object where that is known."""
        handle = given.get("Object")
        kind = self.types.get(handle) if type(handle) is int else None
        utils = name == "vkSetDebugUtilsObjectNameEXT"
        of_type = None if kind is None else f"VK_OBJECT_TYPE_{kind}" if utils else f"VK_DEBUG_REPORT_OBJECT_TYPE_{kind}_EXT"
        info = {"objectType": of_type, "objectHandle" if utils else "object": handle, "pObjectName": given.get("ObjectName")}
        return {"pNameInfo": info}


def _renamed(name: str, given: dict[str, Any]) -> dict[str, Any]:
    own = OF_CALLS.get(name, {})
    out: dict[str, Any] = {}
    for key, value in given.items():
        renamed = own.get(key)
        if renamed is None:
            renamed = RENAMED.get(key)
        if renamed is None:
            renamed = "p" + key if key[:1].isupper() else key
        elif not renamed:
            continue
        elif renamed in ARRAYS:
            value = [value]
        out[renamed] = value
    return out


def _device(given: dict[str, Any], at: Place) -> Iterator[Call]:
    """What RenderDoc notes of the physical device, as the queries for it."""
    device = given.get("PhysicalDevice")
    properties, memory, features, driver = (given.get(key) for key in ("physProps", "memProps", "physFeatures", "driverProps"))
    if isinstance(properties, dict):
        yield Call("vkGetPhysicalDeviceProperties", {"physicalDevice": device, "pProperties": properties}, at)
        if isinstance(driver, dict):
            second = {"sType": "VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2", "pNext": driver, "properties": properties}
            yield Call("vkGetPhysicalDeviceProperties2", {"physicalDevice": device, "pProperties": second}, at)
    if isinstance(memory, dict):
        cut = dict(memory)
        for count, array in (("memoryTypeCount", "memoryTypes"), ("memoryHeapCount", "memoryHeaps")):
            # The arrays are C's, of fixed length.
            if isinstance(cut.get(array), list) and type(cut.get(count)) is int:
                cut[array] = cut[array][: max(cut[count], 0)]
        yield Call("vkGetPhysicalDeviceMemoryProperties", {"physicalDevice": device, "pMemoryProperties": cut}, at)
    if isinstance(features, dict):
        yield Call("vkGetPhysicalDeviceFeatures", {"physicalDevice": device, "pFeatures": features}, at)


def _instance(given: dict[str, Any]) -> dict[str, Any]:
    stated = given.get("InitParams")
    stated = stated if isinstance(stated, dict) else {}
    return {
        "pCreateInfo": {
            "sType": "VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO",
            "pNext": None,
            "pApplicationInfo": {member: stated[key] for key, member in INSTANCE.items() if key in stated},
            "ppEnabledLayerNames": stated.get("Layers"),
            "ppEnabledExtensionNames": stated.get("Extensions"),
        },
        "pInstance": stated.get("InstanceID"),
    }
