"""The features of a device that the capabilities of a shader need, and those that are enabled for
shaders.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

ALWAYS = frozenset({0, 1, 40, 43, 44, 46, 47, 50, 51, 4437, 5301, 6025})
"""Capabilities of SPIR-V that need no feature."""

FEATURES = {
    2: "geometryShader", 3: "tessellationShader", 9: "shaderFloat16", 10: "shaderFloat64",
    11: "shaderInt64",
    12: "shaderBufferInt64Atomics", 22: "shaderInt16", 25: "shaderImageGatherExtended",
    27: "shaderStorageImageMultisample", 28: "shaderUniformBufferArrayDynamicIndexing",
    29: "shaderSampledImageArrayDynamicIndexing", 30: "shaderStorageBufferArrayDynamicIndexing",
    31: "shaderStorageImageArrayDynamicIndexing", 32: "shaderClipDistance",
    33: "shaderCullDistance", 34: "imageCubeArray",
    35: "sampleRateShading", 39: "shaderInt8", 41: "shaderResourceResidency",
    42: "shaderResourceMinLod", 45: "imageCubeArray",
    48: "shaderStorageImageMultisample", 49: "shaderStorageImageExtendedFormats",
    52: "sampleRateShading",
    55: "shaderStorageImageReadWithoutFormat",
    56: "shaderStorageImageWriteWithoutFormat", 57: "multiViewport", 69: "shaderOutputLayer",
    70: "shaderOutputViewportIndex",
    4427: "shaderDrawParameters", 4433: "storageBuffer16BitAccess",
    4434: "uniformAndStorageBuffer16BitAccess",
    4435: "storagePushConstant16", 4436: "storageInputOutput16", 4439: "multiview",
    4441: "variablePointersStorageBuffer",
    4442: "variablePointers", 4448: "storageBuffer8BitAccess",
    4449: "uniformAndStorageBuffer8BitAccess", 4450: "storagePushConstant8",
    5302: "runtimeDescriptorArray", 5303: "shaderInputAttachmentArrayDynamicIndexing",
    5304: "shaderUniformTexelBufferArrayDynamicIndexing",
    5305: "shaderStorageTexelBufferArrayDynamicIndexing",
    5306: "shaderUniformBufferArrayNonUniformIndexing",
    5307: "shaderSampledImageArrayNonUniformIndexing",
    5308: "shaderStorageBufferArrayNonUniformIndexing",
    5309: "shaderStorageImageArrayNonUniformIndexing",
    5310: "shaderInputAttachmentArrayNonUniformIndexing",
    5311: "shaderUniformTexelBufferArrayNonUniformIndexing",
    5312: "shaderStorageTexelBufferArrayNonUniformIndexing", 5345: "vulkanMemoryModel",
    5346: "vulkanMemoryModelDeviceScope",
    5379: "shaderDemoteToHelperInvocation", 6016: "shaderIntegerDotProduct",
    6017: "shaderIntegerDotProduct",
    6018: "shaderIntegerDotProduct", 6019: "shaderIntegerDotProduct",
}  # fmt: skip
"""The feature by capability."""

SUBGROUPS = {
    "GroupNonUniform": 0x1, "GroupNonUniformVote": 0x2, "GroupNonUniformArithmetic": 0x4,
    "GroupNonUniformBallot": 0x8,
    "GroupNonUniformShuffle": 0x10, "GroupNonUniformShuffleRelative": 0x20,
    "GroupNonUniformClustered": 0x40, "GroupNonUniformQuad": 0x80,
}  # fmt: skip
"""VkSubgroupFeatureFlagBits by capability; the numbers of the capabilities are consecutive."""

FEATURES |= {61 + number: name for number, name in enumerate(SUBGROUPS)}

_CAPABILITIES = {
    7: "Linkage", 38: "GenericPointer", 53: "TransformFeedback", 4422: "FragmentShadingRateKHR",
    4447: "SampleMaskPostDepthCoverage",
    4464: "DenormPreserve", 4465: "DenormFlushToZero", 4466: "SignedZeroInfNanPreserve",
    4467: "RoundingModeRTE",
    4468: "RoundingModeRTZ", 4472: "RayQueryKHR", 4478: "RayTraversalPrimitiveCullingKHR",
    5010: "FragmentMaskAMD",
    5013: "StencilExportEXT", 5015: "ImageReadWriteLodAMD", 5016: "Int64ImageEXT",
    5055: "ShaderClockKHR", 5265: "FragmentFullyCoveredEXT",
    5284: "FragmentBarycentricKHR", 5291: "FragmentDensityEXT",
    5347: "PhysicalStorageBufferAddresses",
    5363: "FragmentShaderSampleInterlockEXT", 5372: "FragmentShaderShadingRateInterlockEXT",
    5378: "FragmentShaderPixelInterlockEXT",
    6033: "AtomicFloat32AddEXT", 6034: "AtomicFloat64AddEXT",
}  # fmt: skip
"""Names of capabilities that are not supported."""

EXTENSIONS = frozenset({
    "SPV_KHR_storage_buffer_storage_class", "SPV_KHR_variable_pointers",
    "SPV_KHR_shader_draw_parameters", "SPV_KHR_multiview",
    "SPV_KHR_device_group", "SPV_KHR_16bit_storage", "SPV_KHR_8bit_storage",
    "SPV_EXT_descriptor_indexing",
    "SPV_EXT_shader_viewport_index_layer", "SPV_KHR_vulkan_memory_model",
    "SPV_KHR_no_integer_wrap_decoration", "SPV_KHR_float_controls",
    "SPV_EXT_demote_to_helper_invocation", "SPV_KHR_terminate_invocation",
    "SPV_KHR_integer_dot_product", "SPV_KHR_non_semantic_info",
    "SPV_GOOGLE_decorate_string", "SPV_GOOGLE_hlsl_functionality1", "SPV_GOOGLE_user_type",
})  # fmt: skip
"""The extensions of SPIR-V that Vulkan 1.3 includes, and those that only name things."""

_BY_STRUCTURE = {
    "VkPhysicalDeviceVulkan11Features": frozenset({
        "shaderDrawParameters", "storageBuffer16BitAccess", "uniformAndStorageBuffer16BitAccess",
        "storagePushConstant16",
        "storageInputOutput16", "multiview", "variablePointersStorageBuffer", "variablePointers",
    }),
    "VkPhysicalDeviceVulkan13Features": frozenset({
        "shaderDemoteToHelperInvocation", "shaderTerminateInvocation", "shaderIntegerDotProduct",
    }),
}  # fmt: skip
_OF_1_2 = frozenset({
    "shaderFloat16", "shaderInt8", "shaderBufferInt64Atomics", "shaderOutputLayer",
    "shaderOutputViewportIndex",
    "runtimeDescriptorArray", "vulkanMemoryModel", "vulkanMemoryModelDeviceScope",
    "storageBuffer8BitAccess",
    "uniformAndStorageBuffer8BitAccess", "storagePushConstant8", "scalarBlockLayout",
    "uniformBufferStandardLayout",
    *(name for number, name in FEATURES.items() if 5303 <= number <= 5312),
})  # fmt: skip

ENABLED: Mapping[str, frozenset[str]] = {
    **_BY_STRUCTURE,
    "VkPhysicalDeviceVulkan12Features": _OF_1_2,
}
"""The features to enable where offered, by the structure of Vulkan that has them; those of Vulkan
1.0 are all enabled.
"""

FRAGMENT = 0x10
"""VK_SHADER_STAGE_FRAGMENT_BIT."""

_SPIRV = {(1, 0): (1, 0), (1, 1): (1, 3), (1, 2): (1, 5), (1, 3): (1, 6)}
"""The version of SPIR-V that a version of Vulkan takes."""


def needed(capabilities: Iterable[int]) -> tuple[tuple[str, ...], str]:
    """The features that capabilities need, and the first capability that is not supported on any
    device; empty if all are.
    """
    unknown = sorted(
        number for number in capabilities if number not in ALWAYS and number not in FEATURES
    )
    name = _CAPABILITIES.get(unknown[0], f"number {unknown[0]}") if unknown else ""
    return tuple(sorted({FEATURES[number] for number in capabilities if number in FEATURES})), name


def lacking(device: Mapping[str, Any], features: Iterable[str]) -> str:
    """The first of some features that a device (`opening.Session.device`) does not have; empty if
    it has all.
    """
    subgroups = device.get("VkPhysicalDeviceVulkan11Properties", {})
    operations = (
        int(subgroups.get("subgroupSupportedOperations", 0))
        if int(subgroups.get("subgroupSupportedStages", 0)) & FRAGMENT
        else 0
    )
    structure = {name: key for key, names in ENABLED.items() for name in names}
    for name in features:
        if name in SUBGROUPS and not operations & SUBGROUPS[name]:
            return name
    return next(
        (
            name
            for name in features
            if name not in SUBGROUPS
            and not device.get(structure.get(name, "features"), {}).get(name)
        ),
        "",
    )


def max_spirv(device: Mapping[str, Any]) -> tuple[int, int]:
    """The greatest version of SPIR-V that a device takes."""
    number = int(device.get("properties", {}).get("apiVersion", 0))
    version = (number >> 22 & 0x7F, number >> 12 & 0x3FF)
    return _SPIRV.get(min(version, (1, 3)), (1, 0))
