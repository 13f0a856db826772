"""One device of our own, as each tool would report it: reports are made here, none is copied."""

from __future__ import annotations

import json
from typing import Any

COUNTS = {
    "framebufferColorSampleCounts": 0b1101,
    "framebufferDepthSampleCounts": 0b101,
    "framebufferStencilSampleCounts": 0b11101,
    "framebufferNoAttachmentsSampleCounts": 0b1111,
    "sampledImageColorSampleCounts": 0b1101,
    "sampledImageIntegerSampleCounts": 0b1,
    "sampledImageDepthSampleCounts": 0b101,
    "sampledImageStencilSampleCounts": 0b101,
    "storageImageSampleCounts": 0b1,
}
INTEGER = 0b101
DEPTH_MODES, STENCIL_MODES = 0b1101, 0b0001
MEMORY = (0, 7, 7, 17)
HEAPS = ((3 << 30, 1), (256 << 20, 0))
FEATURES = {"sampleRateShading": True, "alphaToOne": False, "shaderStorageImageMultisample": True}
NEWER = {"dynamicRendering": True, "multisampledRenderToSingleSampled": False}
EXTENSIONS = (
    "VK_KHR_depth_stencil_resolve",
    "VK_EXT_sample_locations",
    "VK_ARM_shader_core_properties",
)
NAME = "Mali-G999 MC3"
VERSION = 1 << 22 | 3 << 12 | 77

_MODES = ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX")
_MEMORY = ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_COHERENT", "HOST_CACHED", "LAZILY_ALLOCATED")


def bits(mask: int, names: tuple[str, ...], form: str) -> list[str]:
    """The bits of a mask by their names."""
    return [form.format(name) for n, name in enumerate(names) if mask >> n & 1]


def counts(mask: int, form: str = "VK_SAMPLE_COUNT_{}_BIT") -> list[str]:
    """The bits of a mask of sample counts."""
    return bits(mask, ("1", "2", "4", "8", "16"), form)


def modes(mask: int, form: str = "VK_RESOLVE_MODE_{}_BIT") -> list[str]:
    """The bits of a mask of resolve modes."""
    return bits(mask, _MODES, form)


def gpuinfo() -> dict[str, Any]:
    """A report of gpuinfo.org."""
    twelve = {
        "framebufferIntegerColorSampleCounts": INTEGER,
        "driverName": "Own",
        "driverInfo": "v7",
    }
    limits = {
        **COUNTS,
        "standardSampleLocations": 1,
        "subPixelPrecisionBits": 8,
        "maxFramebufferWidth": 8192,
        "maxFramebufferHeight": 4096,
    }
    resolve = {
        "supportedDepthResolveModes": str(DEPTH_MODES),
        "supportedStencilResolveModes": str(STENCIL_MODES),
        "independentResolveNone": "true",
        "independentResolve": "false",
    }
    return {
        "environment": {"name": "android", "version": "14"},
        "properties": {
            "apiVersionText": "1.3.77",
            "deviceName": NAME,
            "deviceType": 1,
            "vendorID": 0x13B5,
            "limits": limits,
        },
        "features": {name: int(value) for name, value in FEATURES.items()},
        "core12": {"properties": twelve, "features": {}},
        "core13": {"properties": {}, "features": {"dynamicRendering": 1}},
        "extended": {
            "deviceproperties2": [
                {"extension": "VK_KHR_depth_stencil_resolve", "name": k, "value": v}
                for k, v in resolve.items()
            ],
            "devicefeatures2": [
                {"extension": "VK_X_y", "name": name, "supported": value}
                for name, value in NEWER.items()
            ],
        },
        "extensions": [{"extensionName": name, "specVersion": 1} for name in EXTENSIONS],
        "memory": {
            "memoryTypeCount": len(MEMORY),
            "memoryTypes": [{"heapIndex": 0, "propertyFlags": flags} for flags in MEMORY],
            "memoryHeapCount": 2,
            "memoryHeaps": [{"size": hex(size), "flags": flags} for size, flags in HEAPS],
        },
    }


def _resolve_members() -> dict[str, Any]:
    return {
        "supportedDepthResolveModes": modes(DEPTH_MODES),
        "supportedStencilResolveModes": modes(STENCIL_MODES),
        "independentResolveNone": True,
        "independentResolve": False,
    }


def vulkaninfo_json() -> dict[str, Any]:
    """What new `vulkaninfo --json` writes: a profile of one device."""
    limits = {
        **{name: counts(mask) for name, mask in COUNTS.items()},
        "standardSampleLocations": True,
        "subPixelPrecisionBits": 8,
        "maxFramebufferWidth": 8192,
        "maxFramebufferHeight": 4096,
    }
    properties = {
        "apiVersion": VERSION,
        "deviceName": NAME,
        "deviceType": "VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU",
        "vendorID": 0x13B5,
    }
    twelve = {
        **_resolve_members(),
        "framebufferIntegerColorSampleCounts": counts(INTEGER),
        "driverName": "Own",
        "driverInfo": "v7",
    }
    block = {
        "extensions": dict.fromkeys(EXTENSIONS, 1),
        "features": {
            "VkPhysicalDeviceFeatures": FEATURES,
            "VkPhysicalDeviceVulkan13Features": NEWER,
        },
        "properties": {
            "VkPhysicalDeviceProperties": {**properties, "limits": limits},
            "VkPhysicalDeviceVulkan12Properties": twelve,
        },
        "formats": {},
    }
    profile = {
        "version": 1,
        "api-version": "1.3.77",
        "label": f"{NAME} driver",
        "capabilities": ["device"],
    }
    return {
        "$schema": "profiles",
        "capabilities": {"device": block},
        "profiles": {"VP_VULKANINFO_Own": profile},
    }


def devsim() -> dict[str, Any]:
    """What old `vulkaninfo --json` writes."""
    return {
        "$schema": "devsim_1_0_0",
        "VkPhysicalDeviceProperties": {
            "apiVersion": VERSION,
            "deviceName": NAME,
            "deviceType": 1,
            "vendorID": 0x13B5,
            "limits": {
                **COUNTS,
                "standardSampleLocations": 1,
                "subPixelPrecisionBits": 8,
                **_size(),
            },
        },
        "VkPhysicalDeviceDepthStencilResolvePropertiesKHR": {
            "supportedDepthResolveModes": DEPTH_MODES,
            "supportedStencilResolveModes": STENCIL_MODES,
            "independentResolveNone": 1,
            "independentResolve": 0,
        },
        "VkPhysicalDeviceVulkan12Properties": {
            "framebufferIntegerColorSampleCounts": INTEGER,
            "driverName": "Own",
            "driverInfo": "v7",
        },
        "VkPhysicalDeviceFeatures": {name: int(value) for name, value in FEATURES.items()},
        "VkPhysicalDeviceVulkan13Features": {name: int(value) for name, value in NEWER.items()},
        "VkPhysicalDeviceMemoryProperties": {
            "memoryTypes": [{"heapIndex": 0, "propertyFlags": flags} for flags in MEMORY],
            "memoryHeaps": [{"size": size, "flags": flags} for size, flags in HEAPS],
        },
        "ArrayOfVkExtensionProperties": [
            {"extensionName": name, "specVersion": 1} for name in EXTENSIONS
        ],
    }


def _size() -> dict[str, int]:
    return {"maxFramebufferWidth": 8192, "maxFramebufferHeight": 4096}


def vkjson() -> dict[str, Any]:
    """What an Android device prints: numbers as floats, and a device in a list."""
    given = devsim()
    properties = dict(given["VkPhysicalDeviceProperties"])
    properties["limits"] = {name: float(value) for name, value in properties["limits"].items()}
    types = given["VkPhysicalDeviceMemoryProperties"]
    device = {
        "properties": {
            **properties,
            "vendorID": float(0x13B5),
            "apiVersion": float(VERSION),
            "deviceType": 1.0,
        },
        "features": {name: float(value) for name, value in FEATURES.items()},
        "memory": {"memoryTypeCount": float(len(MEMORY)), "memoryHeapCount": 2.0, **types},
        "core12": {"properties": given["VkPhysicalDeviceVulkan12Properties"], "features": {}},
        "core13": {"properties": {}, "features": {"dynamicRendering": 1.0}},
        "VK_KHR_depth_stencil_resolve": {
            "depthStencilResolvePropertiesKHR": given[
                "VkPhysicalDeviceDepthStencilResolvePropertiesKHR"
            ],
        },
        "extensions": given["ArrayOfVkExtensionProperties"],
        "queues": [],
        "formats": [[1.0, {"linearTilingFeatures": 0.0}]],
        "layers": [],
    }
    return {"layers": [], "extensions": [], "devices": [device]}


def text(*names: str) -> str:
    """What plain `vulkaninfo` prints of some GPUs, which differ by their names alone."""
    head = (
        "==========\nVULKANINFO\n==========\n\nVulkan Instance Version: 1.3.77\n\n\nLayers: "
        "count = 1\n=======\n"
    )
    head += (
        "VK_LAYER_OWN_none (A layer) Vulkan version 1.3.77, layer version 1:\n\tDevices: count "
        "= 1\n\t\tGPU id = 0 (A GPU)\n\n"
    )
    return (
        head
        + "Device Properties and Extensions:\n=====\n"
        + "".join(_gpu(n, name) for n, name in enumerate(names or (NAME,)))
    )


def _gpu(number: int, name: str) -> str:
    lines = [f"GPU{number}:", "VkPhysicalDeviceProperties:", "------"]
    lines += ["\tapiVersion        = 1.3.77 (4206669)", "\tvendorID          = 0x13b5"]
    lines += [
        "\tdeviceType        = PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU",
        f"\tdeviceName        = {name}",
        "",
    ]
    lines += [
        "VkPhysicalDeviceLimits:",
        "------",
        "\tmaxFramebufferWidth       = 8192",
        "\tmaxFramebufferHeight      = 4096",
    ]
    for member, mask in COUNTS.items():
        lines += _listed(member, counts(mask, "SAMPLE_COUNT_{}_BIT"))
    lines += ["\tsubPixelPrecisionBits     = 8", "\tstandardSampleLocations   = true", ""]
    lines += ["VkPhysicalDeviceDepthStencilResolveProperties:", "------"]
    lines += _listed("supportedDepthResolveModes", modes(DEPTH_MODES, "RESOLVE_MODE_{}_BIT"))
    lines += _listed("supportedStencilResolveModes", modes(STENCIL_MODES, "RESOLVE_MODE_{}_BIT"))
    lines += ["\tindependentResolveNone = true", "\tindependentResolve     = false", ""]
    lines += [
        "VkPhysicalDeviceVulkan12Properties:",
        "------",
        "\tdriverName  = Own",
        "\tdriverInfo  = v7",
    ]
    lines += [
        *_listed("framebufferIntegerColorSampleCounts", counts(INTEGER, "SAMPLE_COUNT_{}_BIT")),
        "",
    ]
    lines += [
        f"Device Extensions: count = {len(EXTENSIONS)}",
        *(f"\t{each} : extension revision 1" for each in EXTENSIONS),
        "",
    ]
    lines += ["VkPhysicalDeviceMemoryProperties:", "=======", f"memoryHeaps: count = {len(HEAPS)}"]
    for n, (size, local) in enumerate(HEAPS):
        lines += [
            f"\tmemoryHeaps[{n}]:",
            f"\t\tsize   = {size} ({size:#x}) ({size / 2**30:.2f} GiB)",
            "\t\tflags: count = 1",
        ]
        lines += ["\t\t\tMEMORY_HEAP_DEVICE_LOCAL_BIT"] if local else ["\t\t\tNone"]
    lines += [f"memoryTypes: count = {len(MEMORY)}"]
    for n, flags in enumerate(MEMORY):
        named = bits(flags, _MEMORY, "MEMORY_PROPERTY_{}_BIT")
        lines += [
            f"\tmemoryTypes[{n}]:",
            "\t\theapIndex     = 0",
            f"\t\tpropertyFlags = {flags:#06x}: count = {len(named)}",
        ]
        lines += [f"\t\t\t{each}" for each in named] + [
            "\t\tusable for:",
            "\t\t\tIMAGE_TILING_OPTIMAL:",
            "\t\t\t\tcolor images",
        ]
    lines += [
        "",
        "VkPhysicalDeviceFeatures:",
        "=======",
        *(f"\t{each} = {str(value).lower()}" for each, value in FEATURES.items()),
        "",
    ]
    lines += [
        "VkPhysicalDeviceVulkan13Features:",
        "------",
        *(f"\t{each} = {str(value).lower()}" for each, value in NEWER.items()),
        "",
    ]
    return "\n".join(lines) + "\n"


def _listed(member: str, names: list[str]) -> list[str]:
    return [f"\t{member}: count = {len(names)}", *(f"\t\t{name}" for name in names)]


def profiles() -> dict[str, Any]:
    """Two profiles: one with alternatives and optional capabilities, one that requires it and
    more.
    """
    limits = {
        "framebufferColorSampleCounts": counts(0b101),
        "standardSampleLocations": True,
        "subPixelPrecisionBits": 4,
    }
    more = {
        "framebufferColorSampleCounts": counts(0b1),
        "framebufferDepthSampleCounts": counts(0b10),
        "subPixelPrecisionBits": 8,
    }
    either = {
        "VkPhysicalDeviceVulkan12Properties": {
            "supportedDepthResolveModes": modes(0b0111),
            "independentResolve": True,
        }
    }
    other = {
        "VkPhysicalDeviceVulkan12Properties": {
            "supportedDepthResolveModes": modes(0b1101),
            "independentResolveNone": False,
        }
    }
    return {
        "capabilities": {
            "base": {
                "properties": {"VkPhysicalDeviceProperties": {"limits": limits}},
                "features": {
                    "VkPhysicalDeviceFeatures": {"sampleRateShading": True, "alphaToOne": False}
                },
                "extensions": {"VK_KHR_depth_stencil_resolve": 1},
            },
            "either": {
                "properties": either,
                "extensions": {"VK_EXT_sample_locations": 1, "VK_KHR_maintenance1": 1},
            },
            "other": {"properties": other, "extensions": {"VK_KHR_maintenance1": 1}},
            "extra": {"features": {"VkPhysicalDeviceFeatures": {"alphaToOne": True}}},
            "more": {"properties": {"VkPhysicalDeviceProperties": {"limits": more}}},
        },
        "profiles": {
            "VP_OWN_base": {
                "version": 2,
                "api-version": "1.1.106",
                "label": "Our own",
                "capabilities": ["base", ["either", "other"]],
                "optionals": ["extra"],
            },
            "VP_OWN_more": {
                "version": 1,
                "api-version": "1.3.204",
                "profiles": ["VP_OWN_base"],
                "capabilities": ["more"],
            },
        },
    }


DIALECTS: dict[str, str] = {
    "gpuinfo": json.dumps(gpuinfo()),
    "vulkaninfo-json": json.dumps(vulkaninfo_json()),
    "vulkaninfo-text": text(),
    "devsim": json.dumps(devsim()),
    "vkjson": json.dumps(vkjson()),
}
"""The same device in each."""
