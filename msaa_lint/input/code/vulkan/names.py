"""Vulkan names as C and C++ spell them: `VK_ATTACHMENT_STORE_OP_STORE`,
`vk::AttachmentStoreOp::eStore`, `VkImageCreateInfo`, `vk::ImageCreateInfo`, `pAttachments`,
`setAttachments`.

Members are in the order of the Vulkan registry (vk.xml); a test checks that.
"""

from __future__ import annotations

import re
from functools import cache, lru_cache

from msaa_lint.frame.vulkan.enums import VALUES

MEMBERS: dict[str, tuple[str, ...]] = {
    "AttachmentDescription": (
        "flags", "format", "samples", "loadOp", "storeOp", "stencilLoadOp", "stencilStoreOp",
        "initialLayout", "finalLayout",
    ),
    "AttachmentReference": ("attachment", "layout"),
    "SubpassDescription": (
        "flags", "pipelineBindPoint", "inputAttachmentCount", "pInputAttachments",
        "colorAttachmentCount", "pColorAttachments",
        "pResolveAttachments", "pDepthStencilAttachment", "preserveAttachmentCount",
        "pPreserveAttachments",
    ),
    "SubpassDescription2": (
        "flags", "pipelineBindPoint", "viewMask", "inputAttachmentCount", "pInputAttachments",
        "colorAttachmentCount", "pColorAttachments",
        "pResolveAttachments", "pDepthStencilAttachment", "preserveAttachmentCount",
        "pPreserveAttachments",
    ),
    "SubpassDescriptionDepthStencilResolve": ("depthResolveMode", "stencilResolveMode",
    "pDepthStencilResolveAttachment"),
    "RenderPassFragmentDensityMapCreateInfo": ("fragmentDensityMapAttachment",),
    "FragmentShadingRateAttachmentInfo": ("pFragmentShadingRateAttachment",
    "shadingRateAttachmentTexelSize"),
    "RenderingFragmentDensityMapAttachmentInfo": ("imageView", "imageLayout"),
    "RenderingFragmentShadingRateAttachmentInfo": ("imageView", "imageLayout",
    "shadingRateAttachmentTexelSize"),
    "RenderPassMultiviewCreateInfo": (
        "subpassCount", "pViewMasks", "dependencyCount", "pViewOffsets", "correlationMaskCount",
        "pCorrelationMasks",
    ),
    "RenderPassInputAttachmentAspectCreateInfo": ("aspectReferenceCount", "pAspectReferences"),
    "ImageFormatListCreateInfo": ("viewFormatCount", "pViewFormats"),
    "SubpassDependency": (
        "srcSubpass", "dstSubpass", "srcStageMask", "dstStageMask", "srcAccessMask",
        "dstAccessMask", "dependencyFlags",
    ),
    "RenderPassCreateInfo": (
        "flags", "attachmentCount", "pAttachments", "subpassCount", "pSubpasses",
        "dependencyCount", "pDependencies",
    ),
    "FramebufferCreateInfo": ("flags", "renderPass", "attachmentCount", "pAttachments", "width",
    "height", "layers"),
    "ImageCreateInfo": (
        "flags", "imageType", "format", "extent", "mipLevels", "arrayLayers", "samples", "tiling",
        "usage", "sharingMode",
        "queueFamilyIndexCount", "pQueueFamilyIndices", "initialLayout",
    ),
    "ImageViewCreateInfo": ("flags", "image", "viewType", "format", "components",
    "subresourceRange"),
    "RenderingAttachmentInfo": (
        "imageView", "imageLayout", "resolveMode", "resolveImageView", "resolveImageLayout",
        "loadOp", "storeOp", "clearValue",
    ),
    "ResolveImageModeInfo": ("flags", "resolveMode", "stencilResolveMode"),
    "RenderingInfo": (
        "flags", "renderArea", "layerCount", "viewMask", "colorAttachmentCount",
        "pColorAttachments", "pDepthAttachment",
        "pStencilAttachment",
    ),
    "PipelineMultisampleStateCreateInfo": (
        "flags", "rasterizationSamples", "sampleShadingEnable", "minSampleShading", "pSampleMask",
        "alphaToCoverageEnable",
        "alphaToOneEnable",
    ),
    "PipelineColorBlendAttachmentState": (
        "blendEnable", "srcColorBlendFactor", "dstColorBlendFactor", "colorBlendOp",
        "srcAlphaBlendFactor", "dstAlphaBlendFactor",
        "alphaBlendOp", "colorWriteMask",
    ),
    "PipelineColorBlendStateCreateInfo": (
        "flags", "logicOpEnable", "logicOp", "attachmentCount", "pAttachments", "blendConstants",
    ),
    "PipelineDynamicStateCreateInfo": ("flags", "dynamicStateCount", "pDynamicStates"),
    "PipelineRasterizationStateCreateInfo": ("flags", "depthClampEnable",
    "rasterizerDiscardEnable"),
    "PipelineRenderingCreateInfo": (
        "viewMask", "colorAttachmentCount", "pColorAttachmentFormats", "depthAttachmentFormat",
        "stencilAttachmentFormat",
    ),
    "GraphicsPipelineCreateInfo": (
        "flags", "stageCount", "pStages", "pVertexInputState", "pInputAssemblyState",
        "pTessellationState", "pViewportState",
        "pRasterizationState", "pMultisampleState", "pDepthStencilState", "pColorBlendState",
        "pDynamicState", "layout", "renderPass",
        "subpass", "basePipelineHandle", "basePipelineIndex",
    ),
    "MultisampledRenderToSingleSampledInfo": ("multisampledRenderToSingleSampledEnable",
    "rasterizationSamples"),
    "DeviceCreateInfo": (
        "flags", "queueCreateInfoCount", "pQueueCreateInfos", "enabledLayerCount",
        "ppEnabledLayerNames", "enabledExtensionCount",
        "ppEnabledExtensionNames", "pEnabledFeatures",
    ),
    "PhysicalDeviceFeatures": (
        "robustBufferAccess", "fullDrawIndexUint32", "imageCubeArray", "independentBlend",
        "geometryShader", "tessellationShader",
        "sampleRateShading", "dualSrcBlend", "logicOp", "multiDrawIndirect",
        "drawIndirectFirstInstance", "depthClamp", "depthBiasClamp",
        "fillModeNonSolid", "depthBounds", "wideLines", "largePoints", "alphaToOne",
        "multiViewport", "samplerAnisotropy",
        "textureCompressionETC2", "textureCompressionASTC_LDR", "textureCompressionBC",
        "occlusionQueryPrecise",
        "pipelineStatisticsQuery", "vertexPipelineStoresAndAtomics", "fragmentStoresAndAtomics",
        "shaderTessellationAndGeometryPointSize", "shaderImageGatherExtended",
        "shaderStorageImageExtendedFormats",
        "shaderStorageImageMultisample",
    ),
    "PhysicalDeviceFeatures2": ("features",),
    "MemoryAllocateInfo": ("allocationSize", "memoryTypeIndex"),
    "DescriptorImageInfo": ("sampler", "imageView", "imageLayout"),
    "Extent3D": ("width", "height", "depth"),
    "Extent2D": ("width", "height"),
}  # fmt: skip
"""The members of structures in order, without sType and pNext."""

WITHOUT_TYPE = frozenset({
    "AttachmentDescription", "AttachmentReference", "SubpassDescription", "SubpassDependency",
    "PipelineColorBlendAttachmentState",
    "DescriptorImageInfo", "PhysicalDeviceFeatures", "Extent3D", "Extent2D",
})  # fmt: skip
"""Structures without sType and pNext."""

VERSIONED = {
    "AttachmentDescription2": "AttachmentDescription",
    "RenderPassCreateInfo2": "RenderPassCreateInfo",
    "SubpassDescription2": "SubpassDescription",
    "SubpassDependency2": "SubpassDependency",
    "AttachmentReference2": "AttachmentReference",
}
"""The first version of each second-version structure; rules treat them alike."""

MEMBERS["AttachmentDescription2"] = MEMBERS["AttachmentDescription"]
MEMBERS["AttachmentReference2"] = (*MEMBERS["AttachmentReference"], "aspectMask")
MEMBERS["SubpassDependency2"] = (*MEMBERS["SubpassDependency"], "viewOffset")
MEMBERS["RenderPassCreateInfo2"] = (
    *MEMBERS["RenderPassCreateInfo"],
    "correlatedViewMaskCount",
    "pCorrelatedViewMasks",
)

_SCALAR = re.compile(
    r"(?:FlagBits2?|Flags2?|Format|Layout|Op|Mode|Bool32|Tiling|Type|DeviceSize)(?:KHR|EXT)?$"
)
_SUFFIX = re.compile(r"(?:KHR|EXT)$")
_STRUCTURE = re.compile(r"(?:::)?(?:Vk|vk::|VULKAN_HPP_NAMESPACE::)([A-Za-z0-9]+)$")
_COUNT = re.compile(r"VK_SAMPLE_COUNT_(1|2|4|8|16|32|64)_BIT$")
_SCOPED = re.compile(r"(?:.*::)?([A-Z][A-Za-z0-9]+)::e([A-Z0-9][A-Za-z0-9]*)$")

MAX_NAMES = 1 << 14
"""The number of names of which is kept what they stand for; a program asks for most of its names
many times.
"""

TABLES = {
    "VkPipelineStageFlagBits": "VkPipelineStageFlagBits2",
    "VkAccessFlagBits": "VkAccessFlagBits2",
    "VkResolveModeFlagBitsKHR": "VkResolveModeFlagBits",
}


@lru_cache(MAX_NAMES)
def vulkan_struct(type_text: str) -> str:
    """Returns the name of a Vulkan structure type without `Vk` and vendor suffix, or an empty
    string for other types.
    """
    match = _STRUCTURE.match(type_text.removeprefix("VULKAN_HPP_NAMESPACE::"))
    if match is None:
        return ""
    name = _SUFFIX.sub("", match[1])
    return name if name in MEMBERS else ""


@lru_cache(MAX_NAMES)
def is_scalar(type_text: str) -> bool:
    """Returns whether a Vulkan type is an enum, flags, or a number, whose braces contain a single
    value.
    """
    return _SCALAR.search(type_text) is not None or not type_text.startswith(
        ("Vk", "vk::", "VULKAN")
    )


def first_version(kind: str) -> str:
    """Returns the name of a structure without the 2 of its second version."""
    return VERSIONED.get(kind, kind)


@lru_cache(MAX_NAMES)
def constant(name: str) -> int | str | bool | None:
    """Returns the value of a Vulkan constant: a sample count as a number, a boolean, or an
    enumerant as descriptions spell it;

    None for other names.
    """
    if name.startswith("VMA_MEMORY_USAGE_"):
        return name
    if name.startswith("VK_"):
        count = _COUNT.match(name)
        if count is not None:
            return int(count[1])
        if name in ("VK_TRUE", "VK_FALSE"):
            return name == "VK_TRUE"
        if name == "VK_SUCCESS":
            return 0
        return None if name in ("VK_NULL_HANDLE", "VK_CHECK") else name
    if name.endswith("Result::eSuccess"):
        return 0
    match = _SCOPED.match(name)
    if match is None:
        return (
            "VK_SUBPASS_EXTERNAL"
            if name.endswith("::SubpassExternal")
            else 2**32 - 1
            if name.endswith("::AttachmentUnused")
            else None
        )
    enum = f"Vk{match[1]}"
    if enum == "VkSampleCountFlagBits":
        return int(match[2]) if match[2].isdecimal() and len(match[2]) < 3 else None
    enum = TABLES.get(enum, enum)
    if enum not in VALUES:
        return None
    return squashed(enum).get(match[2].lower())


@cache
def squashed(enum: str) -> dict[str, str]:
    """Returns the values of an enum by their spelling in vulkan.hpp and in Rust: without
    underscores, in lower case.
    """
    return {value.replace("_", "").lower(): value for value in VALUES[enum]}


@lru_cache(MAX_NAMES)
def member(name: str) -> str:
    """Returns the name that descriptions give a member: without the `p` of pointers. `pNext` is
    `next`.
    """
    return (
        name[1].lower() + name[2:]
        if len(name) > 1 and name[0] == "p" and name[1].isupper()
        else name
    )


def setter_member(method: str) -> str | None:
    """Returns the member that a setter of vulkan.hpp sets, spelled as in descriptions, or None."""
    if len(method) < 4 or not method.startswith("set") or not method[3].isupper():
        return None
    return member(method[3].lower() + method[4:])
