"""The properties of the installed devices as vkjson, the format that `devices/reports/vkjson.py`
reads.

`devices()` calls the drivers and must run in a child process; `running()` starts one.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .vulkan_errors import Unusable

if TYPE_CHECKING:
    from msaa_lint.frame.devices.reports import Report

MAX_DEVICES = 16

PROPERTIES = {
    "VkPhysicalDeviceVulkan11Properties": (1, 2),
    "VkPhysicalDeviceVulkan12Properties": (1, 2),
    "VkPhysicalDeviceVulkan13Properties": (1, 3),
    "VkPhysicalDeviceDepthStencilResolveProperties": "VK_KHR_depth_stencil_resolve",
    "VkPhysicalDeviceDriverProperties": "VK_KHR_driver_properties",
    "VkPhysicalDeviceSampleLocationsPropertiesEXT": "VK_EXT_sample_locations",
    "VkPhysicalDeviceFragmentShadingRatePropertiesKHR": "VK_KHR_fragment_shading_rate",
}
FEATURES = {
    "VkPhysicalDeviceVulkan11Features": (1, 2),
    "VkPhysicalDeviceVulkan12Features": (1, 2),
    "VkPhysicalDeviceVulkan13Features": (1, 3),
    "VkPhysicalDeviceDynamicRenderingFeatures": "VK_KHR_dynamic_rendering",
    "VkPhysicalDeviceMultisampledRenderToSingleSampledFeaturesEXT": "VK_EXT_multisampled_render_to_single_sampled",  # noqa: E501
    "VkPhysicalDeviceExtendedDynamicState3FeaturesEXT": "VK_EXT_extended_dynamic_state3",
    "VkPhysicalDeviceFragmentShadingRateFeaturesKHR": "VK_KHR_fragment_shading_rate",
    "VkPhysicalDeviceDynamicRenderingUnusedAttachmentsFeaturesEXT": "VK_EXT_dynamic_rendering_unused_attachments",  # noqa: E501
    "VkPhysicalDeviceFragmentShaderInterlockFeaturesEXT": "VK_EXT_fragment_shader_interlock",
    "VkPhysicalDeviceTilePropertiesFeaturesQCOM": "VK_QCOM_tile_properties",
}
"""Structures to query, and the version or extension that a device needs for each."""


def running(seconds: float = 30.0) -> list[Report]:
    """The devices of the drivers that the loader finds (VK_DRIVER_FILES is respected), queried in a
    child process with a time limit.

    Unusable if there is none, or if the child process dies, times out or gives a malformed answer.
    """
    from . import session
    from .child import Limits

    with session.Session(execute=__name__, limits=Limits(seconds=seconds)) as query:
        return reports(query.devices())


def reports(found: list[dict[str, Any]]) -> list[Report]:
    """The result of `devices`, parsed. Unusable if it is malformed: a driver may have overwritten
    it.
    """
    from msaa_lint.frame.devices.reports import vkjson
    from msaa_lint.frame.devices.reports.reading import report

    root = {"devices": found}
    if not vkjson.claims(root):
        raise Unusable("the answer of the driver's process is malformed")
    return [report(each._replace(what="the running driver")) for each in vkjson.read(root)]


def devices() -> list[dict[str, Any]]:
    """Every device of every driver, queried in this process. Unusable if there is none."""
    from .instance import Instance

    with Instance() as instance:
        return [describe(physical) for physical in instance.physical_devices()[:MAX_DEVICES]]


def describe(physical: Any) -> dict[str, Any]:
    """The properties, features, memory and extensions of a physical device."""
    from . import binding

    vk = binding.load()
    names = [
        binding.text(each.extensionName)
        for each in vk.vkEnumerateDeviceExtensionProperties(physical, None)
    ]
    properties = vk.vkGetPhysicalDeviceProperties(physical)
    version = min(binding.version_of(properties.apiVersion)[:2], binding.instance_version()[:2])
    description: dict[str, Any] = {
        "properties": plain(properties.obj),
        "features": plain(vk.vkGetPhysicalDeviceFeatures(physical)),
        "memory": _memory(vk.vkGetPhysicalDeviceMemoryProperties(physical)),
        "extensions": [{"extensionName": name} for name in sorted(names)],
    }
    if version >= (1, 1) and binding.has("vkGetPhysicalDeviceProperties2"):
        for queries, head, call in (
            (PROPERTIES, vk.VkPhysicalDeviceProperties2(), vk.vkGetPhysicalDeviceProperties2),
            (FEATURES, vk.VkPhysicalDeviceFeatures2(), vk.vkGetPhysicalDeviceFeatures2),
        ):
            structures = {
                name: getattr(vk, name)()
                for name, due in queries.items()
                if _offered(due, version, names) and hasattr(vk, name)
            }
            call(physical, binding.chain(head, *structures.values()))
            description.update((name, plain(structure)) for name, structure in structures.items())
    return description


def _offered(due: object, version: tuple[int, int], names: list[str]) -> bool:
    return due in names if isinstance(due, str) else isinstance(due, tuple) and version >= due


def _memory(memory: Any) -> dict[str, Any]:
    return {
        "memoryTypes": [
            plain(memory.memoryTypes[n])
            for n in range(min(memory.memoryTypeCount, len(memory.memoryTypes)))
        ],
        "memoryHeaps": [
            plain(memory.memoryHeaps[n])
            for n in range(min(memory.memoryHeapCount, len(memory.memoryHeaps)))
        ],
    }


def plain(structure: Any) -> Any:
    """A structure as JSON values, without pointers and sType."""
    from . import binding

    ffi = binding.load().ffi
    kind = ffi.typeof(structure)
    if kind.kind == "array":
        return (
            binding.text(structure)
            if kind.item.cname == "char"
            else [_value(each) for each in structure]
        )
    fields = [(name, field.type.kind) for name, field in kind.fields if name != "sType"]
    return {
        name: _value(getattr(structure, name))
        for name, of in fields
        if of not in ("pointer", "function")
    }


def _value(value: Any) -> Any:
    return value if isinstance(value, (int, float, str, bool)) else plain(value)
