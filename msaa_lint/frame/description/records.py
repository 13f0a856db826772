"""The structures of a description as files are read into them.

Generated from models.py by `python -m msaa_lint.frame.description.generate`: do not edit.
"""

from __future__ import annotations

from typing import ClassVar

from .record import Record, Shape


class Extent(Record):
    """VkExtent3D, in texels."""

    __slots__ = ("depth", "height", "width")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
        "depth": ("int", 1, 2147483647),
    }
    width: int | None
    height: int | None
    depth: int | None


class Rect(Record):
    """VkRect2D, flat, in pixels."""

    __slots__ = ("height", "width", "x", "y")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "x": ("int", -2147483648, 2147483647),
        "y": ("int", -2147483648, 2147483647),
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
    }
    x: int | None
    y: int | None
    width: int | None
    height: int | None


class FrameSize(Record):
    """What costs are reckoned by: the size in pixels (by default the framebuffers') and the rate in frames a second."""

    __slots__ = ("fps", "height", "width")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
        "fps": ("number", True),
    }
    width: int | None
    height: int | None
    fps: float | None


class SampleCounts(Record):
    """The counts a device offers: framebufferColorSampleCounts and its siblings."""

    __slots__ = ("color", "depth", "integer", "stencil")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "color": ("list", ("samples",)),
        "depth": ("list", ("samples",)),
        "stencil": ("list", ("samples",)),
        "integer": ("list", ("samples",)),
    }
    color: tuple[int, ...] | None
    depth: tuple[int, ...] | None
    stencil: tuple[int, ...] | None
    integer: tuple[int, ...] | None


class Device(Record):
    """What a device offers; whatever is absent is unknown."""

    __slots__ = (
        "apiVersion",
        "compression",
        "depthResolveModes",
        "extensions",
        "features",
        "independentResolve",
        "independentResolveNone",
        "maxEfficientSamples",
        "memoryTypes",
        "milliwattsPerGBps",
        "name",
        "sampleCounts",
        "stencilResolveModes",
        "tile",
        "tiler",
        "vendor",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "name": ("text",),
        "vendor": (
            "word",
            ("arm", "img", "amd", "nvidia", "qualcomm", "apple", "intel", "broadcom", "samsung", "mesa", "khronos", "huawei"),
        ),
        "tiler": ("bool",),
        "sampleCounts": ("record", "SampleCounts"),
        "memoryTypes": ("list", ("flags", "VkMemoryPropertyFlagBits")),
        "depthResolveModes": ("flags", "VkResolveModeFlagBits"),
        "stencilResolveModes": ("flags", "VkResolveModeFlagBits"),
        "independentResolve": ("bool",),
        "independentResolveNone": ("bool",),
        "features": ("list", ("text",)),
        "extensions": ("list", ("text",)),
        "apiVersion": ("text",),
        "maxEfficientSamples": ("samples",),
        "tile": ("map", ("either", ("number", False), ("text",))),
        "compression": ("map", ("number", False)),
        "milliwattsPerGBps": ("number", True),
    }
    name: str | None
    vendor: str | None
    tiler: bool | None
    sampleCounts: SampleCounts | None
    memoryTypes: tuple[tuple[str, ...], ...] | None
    depthResolveModes: tuple[str, ...] | None
    stencilResolveModes: tuple[str, ...] | None
    independentResolve: bool | None
    independentResolveNone: bool | None
    features: tuple[str, ...] | None
    extensions: tuple[str, ...] | None
    apiVersion: str | None
    maxEfficientSamples: int | None
    tile: dict[str, float | str] | None
    compression: dict[str, float] | None
    milliwattsPerGBps: float | None


class Enabled(Record):
    """What the application turns on: VkApplicationInfo::apiVersion, VkDeviceCreateInfo's extensions and features."""

    __slots__ = ("apiVersion", "extensions", "features")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "apiVersion": ("text",),
        "extensions": ("list", ("text",)),
        "features": ("list", ("text",)),
    }
    apiVersion: str | None
    extensions: tuple[str, ...] | None
    features: tuple[str, ...] | None


class Image(Record):
    """VkImageCreateInfo, the memory it is bound to, and what its values mean."""

    __slots__ = (
        "arrayLayers",
        "encoding",
        "extent",
        "flags",
        "format",
        "imageType",
        "initialLayout",
        "memory",
        "mipLevels",
        "presentable",
        "samples",
        "sharingMode",
        "tiling",
        "usage",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "format": ("enum", "VkFormat"),
        "samples": ("samples",),
        "usage": ("flags", "VkImageUsageFlagBits"),
        "memory": ("flags", "VkMemoryPropertyFlagBits"),
        "presentable": ("bool",),
        "extent": ("record", "Extent"),
        "mipLevels": ("int", 1, 2147483647),
        "arrayLayers": ("int", 1, 2147483647),
        "imageType": ("enum", "VkImageType"),
        "tiling": ("enum", "VkImageTiling"),
        "flags": ("flags", "VkImageCreateFlagBits"),
        "sharingMode": ("enum", "VkSharingMode"),
        "initialLayout": ("enum", "VkImageLayout"),
        "encoding": ("word", ("LINEAR", "GAMMA", "DATA")),
    }
    format: str | None
    samples: int | None
    usage: tuple[str, ...] | None
    memory: tuple[str, ...] | None
    presentable: bool | None
    extent: Extent | None
    mipLevels: int | None
    arrayLayers: int | None
    imageType: str | None
    tiling: str | None
    flags: tuple[str, ...]
    sharingMode: str | None
    initialLayout: str | None
    encoding: str | None
    ABSENT: ClassVar[dict[str, object]] = {"flags": ()}


class AttachmentDescription(Record):
    """VkAttachmentDescription, VkAttachmentDescription2. `image` binds it without a framebuffer."""

    __slots__ = (
        "finalLayout",
        "flags",
        "format",
        "image",
        "initialLayout",
        "loadOp",
        "samples",
        "stencilFinalLayout",
        "stencilInitialLayout",
        "stencilLoadOp",
        "stencilStoreOp",
        "storeOp",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
        "format": ("enum", "VkFormat"),
        "samples": ("samples",),
        "loadOp": ("enum", "VkAttachmentLoadOp"),
        "storeOp": ("enum", "VkAttachmentStoreOp"),
        "stencilLoadOp": ("enum", "VkAttachmentLoadOp"),
        "stencilStoreOp": ("enum", "VkAttachmentStoreOp"),
        "initialLayout": ("enum", "VkImageLayout"),
        "finalLayout": ("enum", "VkImageLayout"),
        "stencilInitialLayout": ("enum", "VkImageLayout"),
        "stencilFinalLayout": ("enum", "VkImageLayout"),
        "flags": ("flags", "VkAttachmentDescriptionFlagBits"),
    }
    image: str | None
    format: str | None
    samples: int | None
    loadOp: str | None
    storeOp: str | None
    stencilLoadOp: str | None
    stencilStoreOp: str | None
    initialLayout: str | None
    finalLayout: str | None
    stencilInitialLayout: str | None
    stencilFinalLayout: str | None
    flags: tuple[str, ...]
    ABSENT: ClassVar[dict[str, object]] = {"flags": ()}


class AttachmentReference(Record):
    """VkAttachmentReference: a name, an index, or null for VK_ATTACHMENT_UNUSED."""

    __slots__ = ("attachment", "layout")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "attachment": ("null", ("either", ("text",), ("int", 0, 4294967295))),
        "layout": ("enum", "VkImageLayout"),
    }
    attachment: str | int | None
    layout: str | None


class DepthStencilResolve(Record):
    """VkSubpassDescriptionDepthStencilResolve."""

    __slots__ = ("attachment", "depthResolveMode", "stencilResolveMode")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "attachment": ("slot",),
        "depthResolveMode": ("enum", "VkResolveModeFlagBits"),
        "stencilResolveMode": ("enum", "VkResolveModeFlagBits"),
    }
    attachment: AttachmentReference | None
    depthResolveMode: str | None
    stencilResolveMode: str | None


class RenderToSingleSampled(Record):
    """VkMultisampledRenderToSingleSampledInfoEXT."""

    __slots__ = ("multisampledRenderToSingleSampledEnable", "rasterizationSamples")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "multisampledRenderToSingleSampledEnable": ("bool",),
        "rasterizationSamples": ("samples",),
    }
    multisampledRenderToSingleSampledEnable: bool | None
    rasterizationSamples: int | None


class Subpass(Record):
    """VkSubpassDescription, VkSubpassDescription2."""

    __slots__ = (
        "colorAttachments",
        "depthStencilAttachment",
        "depthStencilResolve",
        "flags",
        "inputAttachments",
        "multisampledRenderToSingleSampled",
        "pipelineBindPoint",
        "preserveAttachments",
        "resolveAttachments",
        "viewMask",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "flags": ("flags", "VkSubpassDescriptionFlagBits"),
        "pipelineBindPoint": ("enum", "VkPipelineBindPoint"),
        "inputAttachments": ("list", ("slot",)),
        "colorAttachments": ("list", ("slot",)),
        "resolveAttachments": ("list", ("slot",)),
        "depthStencilAttachment": ("slot",),
        "depthStencilResolve": ("record", "DepthStencilResolve"),
        "preserveAttachments": ("list", ("slot",)),
        "viewMask": ("int", 0, 4294967295),
        "multisampledRenderToSingleSampled": ("record", "RenderToSingleSampled"),
    }
    flags: tuple[str, ...]
    pipelineBindPoint: str | None
    inputAttachments: tuple[AttachmentReference, ...]
    colorAttachments: tuple[AttachmentReference, ...]
    resolveAttachments: tuple[AttachmentReference, ...]
    depthStencilAttachment: AttachmentReference | None
    depthStencilResolve: DepthStencilResolve | None
    preserveAttachments: tuple[AttachmentReference, ...]
    viewMask: int | None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None
    ABSENT: ClassVar[dict[str, object]] = {
        "flags": (),
        "inputAttachments": (),
        "colorAttachments": (),
        "resolveAttachments": (),
        "preserveAttachments": (),
    }


class SubpassDependency(Record):
    """VkSubpassDependency, VkSubpassDependency2. `EXTERNAL` is VK_SUBPASS_EXTERNAL."""

    __slots__ = (
        "dependencyFlags",
        "dstAccessMask",
        "dstStageMask",
        "dstSubpass",
        "srcAccessMask",
        "srcStageMask",
        "srcSubpass",
        "viewOffset",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "srcSubpass": ("subpass",),
        "dstSubpass": ("subpass",),
        "srcStageMask": ("flags", "VkPipelineStageFlagBits2"),
        "dstStageMask": ("flags", "VkPipelineStageFlagBits2"),
        "srcAccessMask": ("flags", "VkAccessFlagBits2"),
        "dstAccessMask": ("flags", "VkAccessFlagBits2"),
        "dependencyFlags": ("flags", "VkDependencyFlagBits"),
        "viewOffset": ("int", -2147483648, 2147483647),
    }
    srcSubpass: int | str | None
    dstSubpass: int | str | None
    srcStageMask: tuple[str, ...]
    dstStageMask: tuple[str, ...]
    srcAccessMask: tuple[str, ...]
    dstAccessMask: tuple[str, ...]
    dependencyFlags: tuple[str, ...]
    viewOffset: int | None
    ABSENT: ClassVar[dict[str, object]] = {
        "srcStageMask": (),
        "dstStageMask": (),
        "srcAccessMask": (),
        "dstAccessMask": (),
        "dependencyFlags": (),
    }


class RenderPass(Record):
    """VkRenderPassCreateInfo, VkRenderPassCreateInfo2."""

    __slots__ = ("attachments", "dependencies", "flags", "subpasses")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "flags": ("flags", "VkRenderPassCreateFlagBits"),
        "attachments": ("counted", ("record", "AttachmentDescription")),
        "subpasses": ("list", ("record", "Subpass")),
        "dependencies": ("list", ("record", "SubpassDependency")),
    }
    flags: tuple[str, ...]
    attachments: tuple[AttachmentDescription, ...]
    subpasses: tuple[Subpass, ...]
    dependencies: tuple[SubpassDependency, ...]
    ABSENT: ClassVar[dict[str, object]] = {"flags": (), "attachments": (), "subpasses": (), "dependencies": ()}


class Framebuffer(Record):
    """VkFramebufferCreateInfo, with images in place of views."""

    __slots__ = ("attachments", "flags", "height", "layers", "renderPass", "width")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "renderPass": ("name", "renderPasses"),
        "attachments": ("list", ("null", ("name", "images"))),
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
        "layers": ("int", 1, 2147483647),
        "flags": ("flags", "VkFramebufferCreateFlagBits"),
    }
    renderPass: str | None
    attachments: tuple[str | None, ...]
    width: int | None
    height: int | None
    layers: int | None
    flags: tuple[str, ...]
    ABSENT: ClassVar[dict[str, object]] = {"attachments": (), "flags": ()}


class MultisampleState(Record):
    """VkPipelineMultisampleStateCreateInfo."""

    __slots__ = (
        "alphaToCoverageEnable",
        "alphaToOneEnable",
        "minSampleShading",
        "rasterizationSamples",
        "sampleMask",
        "sampleShadingEnable",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "rasterizationSamples": ("samples",),
        "sampleShadingEnable": ("bool",),
        "minSampleShading": ("number", False),
        "sampleMask": ("list", ("int", 0, 4294967295)),
        "alphaToCoverageEnable": ("bool",),
        "alphaToOneEnable": ("bool",),
    }
    rasterizationSamples: int | None
    sampleShadingEnable: bool | None
    minSampleShading: float | None
    sampleMask: tuple[int, ...]
    alphaToCoverageEnable: bool | None
    alphaToOneEnable: bool | None
    ABSENT: ClassVar[dict[str, object]] = {"sampleMask": ()}


class ColorBlendAttachment(Record):
    """VkPipelineColorBlendAttachmentState."""

    __slots__ = (
        "alphaBlendOp",
        "blendEnable",
        "colorBlendOp",
        "colorWriteMask",
        "dstAlphaBlendFactor",
        "dstColorBlendFactor",
        "srcAlphaBlendFactor",
        "srcColorBlendFactor",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "blendEnable": ("bool",),
        "colorWriteMask": ("flags", "VkColorComponentFlagBits"),
        "srcColorBlendFactor": ("enum", "VkBlendFactor"),
        "dstColorBlendFactor": ("enum", "VkBlendFactor"),
        "colorBlendOp": ("enum", "VkBlendOp"),
        "srcAlphaBlendFactor": ("enum", "VkBlendFactor"),
        "dstAlphaBlendFactor": ("enum", "VkBlendFactor"),
        "alphaBlendOp": ("enum", "VkBlendOp"),
    }
    blendEnable: bool | None
    colorWriteMask: tuple[str, ...] | None
    srcColorBlendFactor: str | None
    dstColorBlendFactor: str | None
    colorBlendOp: str | None
    srcAlphaBlendFactor: str | None
    dstAlphaBlendFactor: str | None
    alphaBlendOp: str | None


class ColorBlendState(Record):
    """VkPipelineColorBlendStateCreateInfo."""

    __slots__ = ("attachments", "logicOpEnable")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "logicOpEnable": ("bool",),
        "attachments": ("list", ("record", "ColorBlendAttachment")),
    }
    logicOpEnable: bool | None
    attachments: tuple[ColorBlendAttachment, ...]
    ABSENT: ClassVar[dict[str, object]] = {"attachments": ()}


class DepthStencilState(Record):
    """VkPipelineDepthStencilStateCreateInfo."""

    __slots__ = ("depthBoundsTestEnable", "depthCompareOp", "depthTestEnable", "depthWriteEnable", "stencilTestEnable")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "depthTestEnable": ("bool",),
        "depthWriteEnable": ("bool",),
        "depthCompareOp": ("enum", "VkCompareOp"),
        "depthBoundsTestEnable": ("bool",),
        "stencilTestEnable": ("bool",),
    }
    depthTestEnable: bool | None
    depthWriteEnable: bool | None
    depthCompareOp: str | None
    depthBoundsTestEnable: bool | None
    stencilTestEnable: bool | None


class VertexBinding(Record):
    """VkVertexInputBindingDescription."""

    __slots__ = ("binding", "inputRate", "stride")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "binding": ("int", 0, 4294967295),
        "stride": ("int", 0, 4294967295),
        "inputRate": ("enum", "VkVertexInputRate"),
    }
    binding: int | None
    stride: int | None
    inputRate: str | None


class VertexAttribute(Record):
    """VkVertexInputAttributeDescription."""

    __slots__ = ("binding", "format", "location", "offset")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "location": ("int", 0, 4294967295),
        "binding": ("int", 0, 4294967295),
        "format": ("enum", "VkFormat"),
        "offset": ("int", 0, 4294967295),
    }
    location: int | None
    binding: int | None
    format: str | None
    offset: int | None


class VertexInputState(Record):
    """VkPipelineVertexInputStateCreateInfo."""

    __slots__ = ("vertexAttributeDescriptions", "vertexBindingDescriptions")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "vertexBindingDescriptions": ("list", ("record", "VertexBinding")),
        "vertexAttributeDescriptions": ("list", ("record", "VertexAttribute")),
    }
    vertexBindingDescriptions: tuple[VertexBinding, ...]
    vertexAttributeDescriptions: tuple[VertexAttribute, ...]
    ABSENT: ClassVar[dict[str, object]] = {"vertexBindingDescriptions": (), "vertexAttributeDescriptions": ()}


class RasterizationState(Record):
    """VkPipelineRasterizationStateCreateInfo."""

    __slots__ = ("depthBiasEnable", "depthClampEnable", "polygonMode", "rasterizerDiscardEnable")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "rasterizerDiscardEnable": ("bool",),
        "polygonMode": ("enum", "VkPolygonMode"),
        "depthClampEnable": ("bool",),
        "depthBiasEnable": ("bool",),
    }
    rasterizerDiscardEnable: bool | None
    polygonMode: str | None
    depthClampEnable: bool | None
    depthBiasEnable: bool | None


class ShaderStage(Record):
    """VkPipelineShaderStageCreateInfo; `module` is the path of a SPIR-V file, relative to the description."""

    __slots__ = ("module", "name", "specialization", "stage")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "stage": ("enum", "VkShaderStageFlagBits"),
        "module": ("text",),
        "name": ("text",),
        "specialization": ("numbered", ("either", ("number", False), ("bool",))),
    }
    stage: str | None
    module: str | None
    name: str | None
    specialization: dict[str, float | bool] | None


class PipelineRendering(Record):
    """VkPipelineRenderingCreateInfo."""

    __slots__ = ("colorAttachmentFormats", "depthAttachmentFormat", "stencilAttachmentFormat", "viewMask")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "viewMask": ("int", 0, 4294967295),
        "colorAttachmentFormats": ("list", ("null", ("enum", "VkFormat"))),
        "depthAttachmentFormat": ("enum", "VkFormat"),
        "stencilAttachmentFormat": ("enum", "VkFormat"),
    }
    viewMask: int | None
    colorAttachmentFormats: tuple[str | None, ...]
    depthAttachmentFormat: str | None
    stencilAttachmentFormat: str | None
    ABSENT: ClassVar[dict[str, object]] = {"colorAttachmentFormats": ()}


class Pipeline(Record):
    """VkGraphicsPipelineCreateInfo, of a subpass of a render pass or for dynamic rendering."""

    __slots__ = (
        "colorBlendState",
        "depthStencilState",
        "dynamicState",
        "multisampleState",
        "rasterizationState",
        "renderPass",
        "rendering",
        "stages",
        "subpass",
        "vertexInputState",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "renderPass": ("name", "renderPasses"),
        "subpass": ("int", 0, 4294967295),
        "rendering": ("record", "PipelineRendering"),
        "multisampleState": ("record", "MultisampleState"),
        "colorBlendState": ("record", "ColorBlendState"),
        "depthStencilState": ("record", "DepthStencilState"),
        "vertexInputState": ("record", "VertexInputState"),
        "rasterizationState": ("record", "RasterizationState"),
        "dynamicState": ("flags", "VkDynamicState"),
        "stages": ("list", ("record", "ShaderStage")),
    }
    renderPass: str | None
    subpass: int | None
    rendering: PipelineRendering | None
    multisampleState: MultisampleState | None
    colorBlendState: ColorBlendState | None
    depthStencilState: DepthStencilState | None
    vertexInputState: VertexInputState | None
    rasterizationState: RasterizationState | None
    dynamicState: tuple[str, ...]
    stages: tuple[ShaderStage, ...]
    ABSENT: ClassVar[dict[str, object]] = {"dynamicState": (), "stages": ()}


class BeginRenderPass(Record):
    """VkRenderPassBeginInfo; a list of framebuffers alternates from frame to frame."""

    __slots__ = ("clearValueCount", "framebuffer", "renderArea", "renderPass")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "renderPass": ("name", "renderPasses"),
        "framebuffer": ("either", ("name", "framebuffers"), ("list", ("name", "framebuffers"))),
        "renderArea": ("record", "Rect"),
        "clearValueCount": ("int", 0, 4294967295),
    }
    renderPass: str | None
    framebuffer: str | tuple[str, ...] | None
    renderArea: Rect | None
    clearValueCount: int | None


class RenderingAttachment(Record):
    """VkRenderingAttachmentInfo, with images in place of views."""

    __slots__ = ("image", "imageLayout", "loadOp", "resolveImage", "resolveImageLayout", "resolveMode", "storeOp")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
        "imageLayout": ("enum", "VkImageLayout"),
        "resolveMode": ("enum", "VkResolveModeFlagBits"),
        "resolveImage": ("name", "images"),
        "resolveImageLayout": ("enum", "VkImageLayout"),
        "loadOp": ("enum", "VkAttachmentLoadOp"),
        "storeOp": ("enum", "VkAttachmentStoreOp"),
    }
    image: str | None
    imageLayout: str | None
    resolveMode: str | None
    resolveImage: str | None
    resolveImageLayout: str | None
    loadOp: str | None
    storeOp: str | None


class BeginRendering(Record):
    """VkRenderingInfo; null is an unused colour attachment."""

    __slots__ = (
        "colorAttachments",
        "depthAttachment",
        "flags",
        "layerCount",
        "multisampledRenderToSingleSampled",
        "renderArea",
        "stencilAttachment",
        "viewMask",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "flags": ("flags", "VkRenderingFlagBits"),
        "renderArea": ("record", "Rect"),
        "layerCount": ("int", 1, 2147483647),
        "viewMask": ("int", 0, 4294967295),
        "colorAttachments": ("list", ("null", ("record", "RenderingAttachment"))),
        "depthAttachment": ("record", "RenderingAttachment"),
        "stencilAttachment": ("record", "RenderingAttachment"),
        "multisampledRenderToSingleSampled": ("record", "RenderToSingleSampled"),
    }
    flags: tuple[str, ...]
    renderArea: Rect | None
    layerCount: int | None
    viewMask: int | None
    colorAttachments: tuple[RenderingAttachment | None, ...]
    depthAttachment: RenderingAttachment | None
    stencilAttachment: RenderingAttachment | None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None
    ABSENT: ClassVar[dict[str, object]] = {"flags": (), "colorAttachments": ()}


class Draw(Record):
    """vkCmdDraw, vkCmdDrawIndexed."""

    __slots__ = ("firstInstance", "firstVertex", "indexCount", "instanceCount", "pipeline", "vertexCount")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "pipeline": ("name", "pipelines"),
        "vertexCount": ("int", 0, 4294967295),
        "indexCount": ("int", 0, 4294967295),
        "instanceCount": ("int", 0, 4294967295),
        "firstVertex": ("int", 0, 4294967295),
        "firstInstance": ("int", 0, 4294967295),
    }
    pipeline: str | None
    vertexCount: int | None
    indexCount: int | None
    instanceCount: int | None
    firstVertex: int | None
    firstInstance: int | None


class ClearAttachment(Record):
    """VkClearAttachment."""

    __slots__ = ("aspect", "colorAttachment")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "aspect": ("flags", "VkImageAspectFlagBits"),
        "colorAttachment": ("int", 0, 4294967295),
    }
    aspect: tuple[str, ...]
    colorAttachment: int | None
    ABSENT: ClassVar[dict[str, object]] = {"aspect": ()}


class ClearAttachments(Record):
    """vkCmdClearAttachments."""

    __slots__ = ("attachments", "rects")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "attachments": ("list", ("record", "ClearAttachment")),
        "rects": ("list", ("record", "Rect")),
    }
    attachments: tuple[ClearAttachment, ...]
    rects: tuple[Rect, ...]
    ABSENT: ClassVar[dict[str, object]] = {"attachments": (), "rects": ()}


class OneImage(Record):
    """vkCmdClearColorImage, vkCmdClearDepthStencilImage, vkQueuePresentKHR."""

    __slots__ = ("image",)
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
    }
    image: str | None


class TwoImages(Record):
    """vkCmdResolveImage, vkCmdCopyImage, vkCmdBlitImage."""

    __slots__ = ("dstImage", "srcImage")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "srcImage": ("name", "images"),
        "dstImage": ("name", "images"),
    }
    srcImage: str | None
    dstImage: str | None


class CopyImageToBuffer(Record):
    """vkCmdCopyImageToBuffer."""

    __slots__ = ("srcImage",)
    SHAPE: ClassVar[dict[str, Shape]] = {
        "srcImage": ("name", "images"),
    }
    srcImage: str | None


class CopyBufferToImage(Record):
    """vkCmdCopyBufferToImage."""

    __slots__ = ("dstImage",)
    SHAPE: ClassVar[dict[str, Shape]] = {
        "dstImage": ("name", "images"),
    }
    dstImage: str | None


class WriteImage(Record):
    """A shader writes the image."""

    __slots__ = ("access", "image", "stage")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
        "stage": ("enum", "VkShaderStageFlagBits|VkPipelineStageFlagBits2"),
        "access": ("enum", "VkAccessFlagBits2"),
    }
    image: str | None
    stage: str | None
    access: str | None


class ReadImage(Record):
    """A shader reads the image; of a multisampled one which samples it fetches, and what it does with them."""

    __slots__ = ("access", "image", "resolves", "samples", "stage")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
        "stage": ("enum", "VkShaderStageFlagBits|VkPipelineStageFlagBits2"),
        "access": ("enum", "VkAccessFlagBits2"),
        "samples": ("word", (1, "ALL")),
        "resolves": ("word", ("AVERAGE", "MIN", "MAX", "OTHER")),
    }
    image: str | None
    stage: str | None
    access: str | None
    samples: int | str | None
    resolves: str | None


class ImageBarrier(Record):
    """VkImageMemoryBarrier's image and layouts."""

    __slots__ = ("image", "newLayout", "oldLayout")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "image": ("name", "images"),
        "oldLayout": ("enum", "VkImageLayout"),
        "newLayout": ("enum", "VkImageLayout"),
    }
    image: str | None
    oldLayout: str | None
    newLayout: str | None


class PipelineBarrier(Record):
    """vkCmdPipelineBarrier."""

    __slots__ = ("dstAccessMask", "dstStageMask", "images", "srcAccessMask", "srcStageMask")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "srcStageMask": ("flags", "VkPipelineStageFlagBits2"),
        "dstStageMask": ("flags", "VkPipelineStageFlagBits2"),
        "srcAccessMask": ("flags", "VkAccessFlagBits2"),
        "dstAccessMask": ("flags", "VkAccessFlagBits2"),
        "images": ("list", ("either", ("record", "ImageBarrier"), ("name", "images"))),
    }
    srcStageMask: tuple[str, ...]
    dstStageMask: tuple[str, ...]
    srcAccessMask: tuple[str, ...]
    dstAccessMask: tuple[str, ...]
    images: tuple[ImageBarrier | str, ...]
    ABSENT: ClassVar[dict[str, object]] = {"srcStageMask": (), "dstStageMask": (), "srcAccessMask": (), "dstAccessMask": (), "images": ()}


class Nothing(Record):
    """A command without parameters."""

    __slots__ = ()
    SHAPE: ClassVar[dict[str, Shape]] = {}


class Command(Record):
    """One recorded command: its name, and its parameters."""

    __slots__ = ("body", "kind")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "beginRenderPass": ("record", "BeginRenderPass"),
        "nextSubpass": ("null", ("record", "Nothing")),
        "endRenderPass": ("null", ("record", "Nothing")),
        "beginRendering": ("record", "BeginRendering"),
        "endRendering": ("null", ("record", "Nothing")),
        "setRasterizationSamples": ("samples",),
        "draw": ("record", "Draw"),
        "clearAttachments": ("record", "ClearAttachments"),
        "clearColorImage": ("record", "OneImage"),
        "clearDepthStencilImage": ("record", "OneImage"),
        "resolveImage": ("record", "TwoImages"),
        "copyImage": ("record", "TwoImages"),
        "blitImage": ("record", "TwoImages"),
        "copyImageToBuffer": ("record", "CopyImageToBuffer"),
        "copyBufferToImage": ("record", "CopyBufferToImage"),
        "writeImage": ("record", "WriteImage"),
        "readImage": ("record", "ReadImage"),
        "pipelineBarrier": ("record", "PipelineBarrier"),
        "present": ("record", "OneImage"),
    }
    kind: str
    body: object


class Scene(Record):
    """What the picture needs; only this is simulated."""

    __slots__ = ("alphaTest", "color", "depth", "depthResolveWants", "edges", "peak", "textureDetail", "toneMapping")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "edges": ("bool",),
        "depth": ("word", ("STANDARD", "REVERSED")),
        "color": ("word", ("LDR", "HDR")),
        "peak": ("number", True),
        "depthResolveWants": ("word", ("ANY", "NEAREST", "FARTHEST")),
        "toneMapping": ("word", ("AFTER_RESOLVE", "IN_PASS", "NONE")),
        "alphaTest": ("bool",),
        "textureDetail": ("bool",),
    }
    edges: bool | None
    depth: str | None
    color: str | None
    peak: float | None
    depthResolveWants: str | None
    toneMapping: str | None
    alphaTest: bool | None
    textureDetail: bool | None


class SampleCountTest(Record):
    """A test of the bit of one count in a mask, and the count that the branch behind it gives."""

    __slots__ = ("gives", "tests")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "tests": ("samples",),
        "gives": ("samples",),
    }
    tests: int | None
    gives: int | None


class SampleCountChoice(Record):
    """How a program finds its sample count in the masks of VkPhysicalDeviceLimits: of which, how combined, and which bit it takes."""

    __slots__ = ("atMost", "chosen", "combined", "formats", "limits", "tests")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "limits": (
            "list",
            (
                "word",
                (
                    "framebufferColorSampleCounts",
                    "framebufferDepthSampleCounts",
                    "framebufferStencilSampleCounts",
                    "framebufferNoAttachmentsSampleCounts",
                    "framebufferIntegerColorSampleCounts",
                    "sampledImageColorSampleCounts",
                    "sampledImageIntegerSampleCounts",
                    "sampledImageDepthSampleCounts",
                    "sampledImageStencilSampleCounts",
                    "storageImageSampleCounts",
                ),
            ),
        ),
        "combined": ("word", ("AND", "OR", "MIN", "MAX", "LOGICAL_AND", "LOGICAL_OR", "NONE")),
        "chosen": ("word", ("MAXIMUM", "ATMOST")),
        "atMost": ("samples",),
        "tests": ("list", ("record", "SampleCountTest")),
        "formats": ("list", ("enum", "VkFormat")),
    }
    limits: tuple[str, ...] | None
    combined: str | None
    chosen: str | None
    atMost: int | None
    tests: tuple[SampleCountTest, ...]
    formats: tuple[str, ...] | None
    ABSENT: ClassVar[dict[str, object]] = {"tests": ()}


class AttachmentConfig(Record):
    """Impeller's RenderTarget::AttachmentConfig."""

    __slots__ = ("clearColor", "loadAction", "storageMode", "storeAction")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "storageMode": ("word", ("kHostVisible", "kDevicePrivate", "kDeviceTransient")),
        "loadAction": ("word", ("kDontCare", "kLoad", "kClear")),
        "storeAction": ("word", ("kDontCare", "kStore", "kMultisampleResolve", "kStoreAndMultisampleResolve")),
        "clearColor": ("list", ("number", False)),
    }
    storageMode: str | None
    loadAction: str | None
    storeAction: str | None
    clearColor: tuple[float, ...] | None


class AttachmentConfigMSAA(Record):
    """Impeller's RenderTarget::AttachmentConfigMSAA; of one sample a pixel its AttachmentConfig, and `resolveStorageMode` is nobody's."""

    __slots__ = ("clearColor", "loadAction", "resolveStorageMode", "storageMode", "storeAction")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "storageMode": ("word", ("kHostVisible", "kDevicePrivate", "kDeviceTransient")),
        "resolveStorageMode": ("word", ("kHostVisible", "kDevicePrivate", "kDeviceTransient")),
        "loadAction": ("word", ("kDontCare", "kLoad", "kClear")),
        "storeAction": ("word", ("kDontCare", "kStore", "kMultisampleResolve", "kStoreAndMultisampleResolve")),
        "clearColor": ("list", ("number", False)),
    }
    storageMode: str | None
    resolveStorageMode: str | None
    loadAction: str | None
    storeAction: str | None
    clearColor: tuple[float, ...] | None


class RenderTarget(Record):
    """Impeller's render target: what it expands to is what the engine builds of it."""

    __slots__ = (
        "api",
        "colorAttachmentConfig",
        "colorFormat",
        "depthFormat",
        "enableStencil",
        "height",
        "onscreen",
        "sampleCount",
        "stencilAttachmentConfig",
        "width",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "api": ("word", ("vulkan", "metal")),
        "onscreen": ("bool",),
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
        "colorFormat": (
            "word",
            (
                "kA8UNormInt",
                "kR8UNormInt",
                "kR8G8UNormInt",
                "kR8G8B8A8UNormInt",
                "kR8G8B8A8UNormIntSRGB",
                "kB8G8R8A8UNormInt",
                "kB8G8R8A8UNormIntSRGB",
                "kR32G32B32A32Float",
                "kR16G16B16A16Float",
                "kB10G10R10XR",
                "kB10G10R10XRSRGB",
                "kB10G10R10A10XR",
            ),
        ),
        "depthFormat": ("word", ("kS8UInt", "kD24UnormS8Uint", "kD32FloatS8UInt")),
        "sampleCount": ("word", (1, 2, 4, 8, 16, "kCount1", "kCount2", "kCount4", "kCount8", "kCount16", "k1", "k2", "k4", "k8", "k16")),
        "enableStencil": ("bool",),
        "colorAttachmentConfig": ("record", "AttachmentConfigMSAA"),
        "stencilAttachmentConfig": ("record", "AttachmentConfig"),
    }
    api: str | None
    onscreen: bool | None
    width: int | None
    height: int | None
    colorFormat: str | None
    depthFormat: str | None
    sampleCount: int | str | None
    enableStencil: bool | None
    colorAttachmentConfig: AttachmentConfigMSAA | None
    stencilAttachmentConfig: AttachmentConfig | None


class Description(Record):
    """A frame, or part of one. Everything is optional but what Vulkan needs to make sense of a structure."""

    __slots__ = (
        "commands",
        "device",
        "enabled",
        "frame",
        "framebuffers",
        "images",
        "metal",
        "pipelines",
        "renderPasses",
        "renderTargets",
        "sampleCountChoices",
        "scene",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "frame": ("record", "FrameSize"),
        "device": ("either", ("record", "Device"), ("text",)),
        "enabled": ("record", "Enabled"),
        "images": ("map", ("record", "Image")),
        "renderPasses": ("map", ("record", "RenderPass")),
        "framebuffers": ("map", ("record", "Framebuffer")),
        "pipelines": ("map", ("record", "Pipeline")),
        "commands": ("list", ("command",)),
        "scene": ("record", "Scene"),
        "metal": ("record", "Metal"),
        "sampleCountChoices": ("map", ("record", "SampleCountChoice")),
        "renderTargets": ("map", ("record", "RenderTarget")),
    }
    frame: FrameSize | None
    device: Device | str | None
    enabled: Enabled | None
    images: dict[str, Image]
    renderPasses: dict[str, RenderPass]
    framebuffers: dict[str, Framebuffer]
    pipelines: dict[str, Pipeline]
    commands: tuple[Command, ...] | None
    scene: Scene | None
    metal: Metal | None
    sampleCountChoices: dict[str, SampleCountChoice]
    renderTargets: dict[str, RenderTarget]
    ABSENT: ClassVar[dict[str, object]] = {
        "images": {},
        "renderPasses": {},
        "framebuffers": {},
        "pipelines": {},
        "sampleCountChoices": {},
        "renderTargets": {},
    }


class Metal(Record):
    """A frame in Metal's words, and what the GPU offers: its family, and what supportsTextureSampleCount says."""

    __slots__ = ("commands", "family", "renderPasses", "renderPipelines", "supportedSampleCounts", "textures")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "family": ("enum", "MTLGPUFamily"),
        "supportedSampleCounts": ("list", ("samples",)),
        "textures": ("map", ("record", "MetalTexture")),
        "renderPasses": ("map", ("record", "MetalRenderPass")),
        "renderPipelines": ("map", ("record", "MetalRenderPipeline")),
        "commands": ("list", ("command", "MetalCommand")),
    }
    family: str | None
    supportedSampleCounts: tuple[int, ...] | None
    textures: dict[str, MetalTexture]
    renderPasses: dict[str, MetalRenderPass]
    renderPipelines: dict[str, MetalRenderPipeline]
    commands: tuple[MetalCommand, ...] | None
    ABSENT: ClassVar[dict[str, object]] = {"textures": {}, "renderPasses": {}, "renderPipelines": {}}


class MetalTexture(Record):
    """MTLTextureDescriptor; `drawable` is a texture of a CAMetalLayer, `encoding` what the values mean."""

    __slots__ = (
        "arrayLength",
        "drawable",
        "encoding",
        "height",
        "mipmapLevelCount",
        "pixelFormat",
        "sampleCount",
        "storageMode",
        "textureType",
        "usage",
        "width",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "pixelFormat": ("enum", "MTLPixelFormat"),
        "width": ("int", 1, 2147483647),
        "height": ("int", 1, 2147483647),
        "textureType": ("enum", "MTLTextureType"),
        "sampleCount": ("samples",),
        "usage": ("flags", "MTLTextureUsage"),
        "storageMode": ("enum", "MTLStorageMode"),
        "mipmapLevelCount": ("int", 1, 2147483647),
        "arrayLength": ("int", 1, 2147483647),
        "drawable": ("bool",),
        "encoding": ("word", ("LINEAR", "GAMMA", "DATA")),
    }
    pixelFormat: str | None
    width: int | None
    height: int | None
    textureType: str | None
    sampleCount: int | None
    usage: tuple[str, ...] | None
    storageMode: str | None
    mipmapLevelCount: int | None
    arrayLength: int | None
    drawable: bool | None
    encoding: str | None


class MetalColorAttachment(Record):
    """MTLRenderPassColorAttachmentDescriptor."""

    __slots__ = ("loadAction", "resolveTexture", "storeAction", "texture")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "texture": ("name", "metal.textures"),
        "resolveTexture": ("name", "metal.textures"),
        "loadAction": ("enum", "MTLLoadAction"),
        "storeAction": ("enum", "MTLStoreAction"),
    }
    texture: str | None
    resolveTexture: str | None
    loadAction: str | None
    storeAction: str | None


class MetalDepthAttachment(Record):
    """MTLRenderPassDepthAttachmentDescriptor."""

    __slots__ = ("depthResolveFilter", "loadAction", "resolveTexture", "storeAction", "texture")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "texture": ("name", "metal.textures"),
        "resolveTexture": ("name", "metal.textures"),
        "loadAction": ("enum", "MTLLoadAction"),
        "storeAction": ("enum", "MTLStoreAction"),
        "depthResolveFilter": ("enum", "MTLMultisampleDepthResolveFilter"),
    }
    texture: str | None
    resolveTexture: str | None
    loadAction: str | None
    storeAction: str | None
    depthResolveFilter: str | None


class MetalStencilAttachment(Record):
    """MTLRenderPassStencilAttachmentDescriptor."""

    __slots__ = ("loadAction", "resolveTexture", "stencilResolveFilter", "storeAction", "texture")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "texture": ("name", "metal.textures"),
        "resolveTexture": ("name", "metal.textures"),
        "loadAction": ("enum", "MTLLoadAction"),
        "storeAction": ("enum", "MTLStoreAction"),
        "stencilResolveFilter": ("enum", "MTLMultisampleStencilResolveFilter"),
    }
    texture: str | None
    resolveTexture: str | None
    loadAction: str | None
    storeAction: str | None
    stencilResolveFilter: str | None


class MetalRenderPass(Record):
    """MTLRenderPassDescriptor; the colour attachments are a list, or a mapping by index, null for one that is not used."""

    __slots__ = ("colorAttachments", "depthAttachment", "stencilAttachment")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "colorAttachments": (
            "either",
            ("numbered", ("null", ("record", "MetalColorAttachment")), 7),
            ("list", ("null", ("record", "MetalColorAttachment")), 8),
        ),
        "depthAttachment": ("record", "MetalDepthAttachment"),
        "stencilAttachment": ("record", "MetalStencilAttachment"),
    }
    colorAttachments: dict[str, MetalColorAttachment | None] | tuple[MetalColorAttachment | None, ...]
    depthAttachment: MetalDepthAttachment | None
    stencilAttachment: MetalStencilAttachment | None
    ABSENT: ClassVar[dict[str, object]] = {"colorAttachments": ()}


class MetalPipelineColor(Record):
    """MTLRenderPipelineColorAttachmentDescriptor."""

    __slots__ = ("blendingEnabled", "isBlendingEnabled", "pixelFormat")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "pixelFormat": ("enum", "MTLPixelFormat"),
        "isBlendingEnabled": ("bool",),
        "blendingEnabled": ("bool",),
    }
    pixelFormat: str | None
    isBlendingEnabled: bool | None
    blendingEnabled: bool | None


class MetalRenderPipeline(Record):
    """MTLRenderPipelineDescriptor; names that Objective-C has otherwise, or that are deprecated, stand for the same property."""

    __slots__ = (
        "alphaToCoverageEnabled",
        "alphaToOneEnabled",
        "colorAttachments",
        "depthAttachmentPixelFormat",
        "isAlphaToCoverageEnabled",
        "isAlphaToOneEnabled",
        "isRasterizationEnabled",
        "rasterSampleCount",
        "rasterizationEnabled",
        "renderPass",
        "sampleCount",
        "stencilAttachmentPixelFormat",
    )
    SHAPE: ClassVar[dict[str, Shape]] = {
        "renderPass": ("name", "metal.renderPasses"),
        "rasterSampleCount": ("samples",),
        "sampleCount": ("samples",),
        "colorAttachments": (
            "either",
            ("numbered", ("null", ("record", "MetalPipelineColor")), 7),
            ("list", ("null", ("record", "MetalPipelineColor")), 8),
        ),
        "depthAttachmentPixelFormat": ("enum", "MTLPixelFormat"),
        "stencilAttachmentPixelFormat": ("enum", "MTLPixelFormat"),
        "isAlphaToCoverageEnabled": ("bool",),
        "alphaToCoverageEnabled": ("bool",),
        "isAlphaToOneEnabled": ("bool",),
        "alphaToOneEnabled": ("bool",),
        "isRasterizationEnabled": ("bool",),
        "rasterizationEnabled": ("bool",),
    }
    renderPass: str | None
    rasterSampleCount: int | None
    sampleCount: int | None
    colorAttachments: dict[str, MetalPipelineColor | None] | tuple[MetalPipelineColor | None, ...]
    depthAttachmentPixelFormat: str | None
    stencilAttachmentPixelFormat: str | None
    isAlphaToCoverageEnabled: bool | None
    alphaToCoverageEnabled: bool | None
    isAlphaToOneEnabled: bool | None
    alphaToOneEnabled: bool | None
    isRasterizationEnabled: bool | None
    rasterizationEnabled: bool | None
    ABSENT: ClassVar[dict[str, object]] = {"colorAttachments": ()}


class MetalRead(Record):
    """A shader reads the texture; of a multisampled one which samples it reads, and what it does with them."""

    __slots__ = ("resolves", "samples", "stage", "texture")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "texture": ("name", "metal.textures"),
        "stage": ("word", ("vertex", "fragment", "compute", "tile")),
        "samples": ("word", (1, "ALL")),
        "resolves": ("word", ("AVERAGE", "MIN", "MAX", "OTHER")),
    }
    texture: str | None
    stage: str | None
    samples: int | str | None
    resolves: str | None


class MetalWrite(Record):
    """A shader writes the texture."""

    __slots__ = ("stage", "texture")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "texture": ("name", "metal.textures"),
        "stage": ("word", ("vertex", "fragment", "compute", "tile")),
    }
    texture: str | None
    stage: str | None


class MetalCopy(Record):
    """A blit encoder's copy from one texture to another."""

    __slots__ = ("destination", "source")
    SHAPE: ClassVar[dict[str, Shape]] = {
        "source": ("name", "metal.textures"),
        "destination": ("name", "metal.textures"),
    }
    source: str | None
    destination: str | None


class MetalCommand(Command):
    """What a command buffer encodes: a whole render pass, what its shaders read or write, a copy, a drawable that is presented."""

    __slots__ = ()
    SHAPE: ClassVar[dict[str, Shape]] = {
        "renderPass": ("name", "metal.renderPasses"),
        "readTexture": ("record", "MetalRead"),
        "writeTexture": ("record", "MetalWrite"),
        "copy": ("record", "MetalCopy"),
        "present": ("name", "metal.textures"),
    }


RECORDS: dict[str, type[Record]] = {
    "Extent": Extent,
    "Rect": Rect,
    "FrameSize": FrameSize,
    "SampleCounts": SampleCounts,
    "Device": Device,
    "Enabled": Enabled,
    "Image": Image,
    "AttachmentDescription": AttachmentDescription,
    "AttachmentReference": AttachmentReference,
    "DepthStencilResolve": DepthStencilResolve,
    "RenderToSingleSampled": RenderToSingleSampled,
    "Subpass": Subpass,
    "SubpassDependency": SubpassDependency,
    "RenderPass": RenderPass,
    "Framebuffer": Framebuffer,
    "MultisampleState": MultisampleState,
    "ColorBlendAttachment": ColorBlendAttachment,
    "ColorBlendState": ColorBlendState,
    "DepthStencilState": DepthStencilState,
    "VertexBinding": VertexBinding,
    "VertexAttribute": VertexAttribute,
    "VertexInputState": VertexInputState,
    "RasterizationState": RasterizationState,
    "ShaderStage": ShaderStage,
    "PipelineRendering": PipelineRendering,
    "Pipeline": Pipeline,
    "BeginRenderPass": BeginRenderPass,
    "RenderingAttachment": RenderingAttachment,
    "BeginRendering": BeginRendering,
    "Draw": Draw,
    "ClearAttachment": ClearAttachment,
    "ClearAttachments": ClearAttachments,
    "OneImage": OneImage,
    "TwoImages": TwoImages,
    "CopyImageToBuffer": CopyImageToBuffer,
    "CopyBufferToImage": CopyBufferToImage,
    "WriteImage": WriteImage,
    "ReadImage": ReadImage,
    "ImageBarrier": ImageBarrier,
    "PipelineBarrier": PipelineBarrier,
    "Nothing": Nothing,
    "Command": Command,
    "Scene": Scene,
    "SampleCountTest": SampleCountTest,
    "SampleCountChoice": SampleCountChoice,
    "AttachmentConfig": AttachmentConfig,
    "AttachmentConfigMSAA": AttachmentConfigMSAA,
    "RenderTarget": RenderTarget,
    "Description": Description,
    "Metal": Metal,
    "MetalTexture": MetalTexture,
    "MetalColorAttachment": MetalColorAttachment,
    "MetalDepthAttachment": MetalDepthAttachment,
    "MetalStencilAttachment": MetalStencilAttachment,
    "MetalRenderPass": MetalRenderPass,
    "MetalPipelineColor": MetalPipelineColor,
    "MetalRenderPipeline": MetalRenderPipeline,
    "MetalRead": MetalRead,
    "MetalWrite": MetalWrite,
    "MetalCopy": MetalCopy,
    "MetalCommand": MetalCommand,
}
