"""The frame in Vulkan's words: what a description may hold.

The names are Vulkan's structure members without the `p` prefix and the `...Count` members. In a structure that is stated, absent arrays,
flags and optional structures are none; an absent scalar, boolean or enumerant is unknown (None). The few arrays and flags whose absence
says nothing default to None as well (`Image.usage`, `Image.memory`, the lists of a device).

These models give the JSON Schema and check what a program hands to `msaa_lint`; `python -m msaa_lint.frame.description.generate` writes the
shapes that files are read by from them.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, model_validator

from .fields import (
    Bool,
    ConstantId,
    Count,
    Counted,
    Enumerant,
    FlagBits,
    FramebufferName,
    ImageName,
    Index,
    Null,
    Number,
    Offset,
    PipelineName,
    PositiveNumber,
    RenderPassName,
    Samples,
    Size,
    Slot,
    SubpassNumber,
    Text,
    Word,
)
from .metal_models import Metal
from .struct import Struct

Format = Annotated[str, Enumerant("VkFormat")]
Layout = Annotated[str, Enumerant("VkImageLayout")]
LoadOp = Annotated[str, Enumerant("VkAttachmentLoadOp")]
StoreOp = Annotated[str, Enumerant("VkAttachmentStoreOp")]
ResolveMode = Annotated[str, Enumerant("VkResolveModeFlagBits")]
Stages = Annotated[tuple[str, ...], FlagBits("VkPipelineStageFlagBits2")]
Accesses = Annotated[tuple[str, ...], FlagBits("VkAccessFlagBits2")]
Stage = Annotated[str, Enumerant("VkShaderStageFlagBits|VkPipelineStageFlagBits2")]
Access = Annotated[str, Enumerant("VkAccessFlagBits2")]
MemoryProperties = Annotated[tuple[str, ...], FlagBits("VkMemoryPropertyFlagBits")]
CompareOp = Annotated[str, Enumerant("VkCompareOp")]


class Extent(Struct):
    """VkExtent3D, in texels."""

    width: Size | None = None
    height: Size | None = None
    depth: Size | None = None


class Rect(Struct):
    """VkRect2D, flat, in pixels."""

    x: Offset | None = None
    y: Offset | None = None
    width: Size | None = None
    height: Size | None = None


class FrameSize(Struct):
    """What costs are reckoned by: the size in pixels (by default the framebuffers') and the rate in frames a second."""

    width: Size | None = None
    height: Size | None = None
    fps: PositiveNumber | None = None


class SampleCounts(Struct):
    """The counts a device offers: framebufferColorSampleCounts and its siblings."""

    color: tuple[Samples, ...] | None = None
    depth: tuple[Samples, ...] | None = None
    stencil: tuple[Samples, ...] | None = None
    integer: tuple[Samples, ...] | None = None


class Device(Struct):
    """What a device offers; whatever is absent is unknown."""

    name: Text | None = None
    vendor: (
        Literal["arm", "img", "amd", "nvidia", "qualcomm", "apple", "intel", "broadcom", "samsung", "mesa", "khronos", "huawei"] | None
    ) = None
    tiler: Bool | None = None
    sampleCounts: SampleCounts | None = None
    memoryTypes: tuple[MemoryProperties, ...] | None = None
    depthResolveModes: Annotated[tuple[str, ...], FlagBits("VkResolveModeFlagBits")] | None = None
    stencilResolveModes: Annotated[tuple[str, ...], FlagBits("VkResolveModeFlagBits")] | None = None
    independentResolve: Bool | None = None
    independentResolveNone: Bool | None = None
    features: tuple[Text, ...] | None = None
    extensions: tuple[Text, ...] | None = None
    apiVersion: Text | None = None
    maxEfficientSamples: Samples | None = None
    tile: dict[str, Number | Text] | None = None
    compression: dict[str, Number] | None = None
    milliwattsPerGBps: PositiveNumber | None = None


class Enabled(Struct):
    """What the application turns on: VkApplicationInfo::apiVersion, VkDeviceCreateInfo's extensions and features."""

    apiVersion: Text | None = None
    extensions: tuple[Text, ...] | None = None
    features: tuple[Text, ...] | None = None


class Image(Struct):
    """VkImageCreateInfo, the memory it is bound to, and what its values mean."""

    format: Format | None = None
    samples: Samples | None = None
    usage: Annotated[tuple[str, ...], FlagBits("VkImageUsageFlagBits")] | None = None
    memory: MemoryProperties | None = None
    presentable: Bool | None = None
    extent: Extent | None = None
    mipLevels: Size | None = None
    arrayLayers: Size | None = None
    imageType: Annotated[str, Enumerant("VkImageType")] | None = None
    tiling: Annotated[str, Enumerant("VkImageTiling")] | None = None
    flags: Annotated[tuple[str, ...], FlagBits("VkImageCreateFlagBits")] = ()
    sharingMode: Annotated[str, Enumerant("VkSharingMode")] | None = None
    initialLayout: Layout | None = None
    encoding: Literal["LINEAR", "GAMMA", "DATA"] | None = None


class AttachmentDescription(Struct):
    """VkAttachmentDescription, VkAttachmentDescription2. `image` binds it without a framebuffer."""

    image: ImageName | None = None
    format: Format | None = None
    samples: Samples | None = None
    loadOp: LoadOp | None = None
    storeOp: StoreOp | None = None
    stencilLoadOp: LoadOp | None = None
    stencilStoreOp: StoreOp | None = None
    initialLayout: Layout | None = None
    finalLayout: Layout | None = None
    stencilInitialLayout: Layout | None = None
    stencilFinalLayout: Layout | None = None
    flags: Annotated[tuple[str, ...], FlagBits("VkAttachmentDescriptionFlagBits")] = ()


class AttachmentReference(Struct):
    """VkAttachmentReference: a name, an index, or null for VK_ATTACHMENT_UNUSED."""

    attachment: Annotated[Text | Index | None, Null()] = None
    layout: Layout | None = None


AttachmentSlot = Annotated[AttachmentReference | Text | Index | None, Slot()]


class DepthStencilResolve(Struct):
    """VkSubpassDescriptionDepthStencilResolve."""

    attachment: AttachmentSlot = None
    depthResolveMode: ResolveMode | None = None
    stencilResolveMode: ResolveMode | None = None


class RenderToSingleSampled(Struct):
    """VkMultisampledRenderToSingleSampledInfoEXT."""

    multisampledRenderToSingleSampledEnable: Bool | None = None
    rasterizationSamples: Samples | None = None


class Subpass(Struct):
    """VkSubpassDescription, VkSubpassDescription2."""

    flags: Annotated[tuple[str, ...], FlagBits("VkSubpassDescriptionFlagBits")] = ()
    pipelineBindPoint: Annotated[str, Enumerant("VkPipelineBindPoint")] | None = None
    inputAttachments: tuple[AttachmentSlot, ...] = ()
    colorAttachments: tuple[AttachmentSlot, ...] = ()
    resolveAttachments: tuple[AttachmentSlot, ...] = ()
    depthStencilAttachment: AttachmentSlot = None
    depthStencilResolve: DepthStencilResolve | None = None
    preserveAttachments: tuple[AttachmentSlot, ...] = ()
    viewMask: Index | None = None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None = None


class SubpassDependency(Struct):
    """VkSubpassDependency, VkSubpassDependency2. `EXTERNAL` is VK_SUBPASS_EXTERNAL."""

    srcSubpass: SubpassNumber | None = None
    dstSubpass: SubpassNumber | None = None
    srcStageMask: Stages = ()
    dstStageMask: Stages = ()
    srcAccessMask: Accesses = ()
    dstAccessMask: Accesses = ()
    dependencyFlags: Annotated[tuple[str, ...], FlagBits("VkDependencyFlagBits")] = ()
    viewOffset: Offset | None = None


class RenderPass(Struct):
    """VkRenderPassCreateInfo, VkRenderPassCreateInfo2."""

    flags: Annotated[tuple[str, ...], FlagBits("VkRenderPassCreateFlagBits")] = ()
    attachments: Annotated[dict[str, AttachmentDescription] | tuple[AttachmentDescription, ...], Counted()] = ()
    subpasses: tuple[Subpass, ...] = ()
    dependencies: tuple[SubpassDependency, ...] = ()


class Framebuffer(Struct):
    """VkFramebufferCreateInfo, with images in place of views."""

    renderPass: RenderPassName | None = None
    attachments: tuple[ImageName | None, ...] = ()
    width: Size | None = None
    height: Size | None = None
    layers: Size | None = None
    flags: Annotated[tuple[str, ...], FlagBits("VkFramebufferCreateFlagBits")] = ()


class MultisampleState(Struct):
    """VkPipelineMultisampleStateCreateInfo."""

    rasterizationSamples: Samples | None = None
    sampleShadingEnable: Bool | None = None
    minSampleShading: Number | None = None
    sampleMask: tuple[Index, ...] = ()
    alphaToCoverageEnable: Bool | None = None
    alphaToOneEnable: Bool | None = None


class ColorBlendAttachment(Struct):
    """VkPipelineColorBlendAttachmentState."""

    blendEnable: Bool | None = None
    colorWriteMask: Annotated[tuple[str, ...], FlagBits("VkColorComponentFlagBits")] | None = None
    srcColorBlendFactor: Annotated[str, Enumerant("VkBlendFactor")] | None = None
    dstColorBlendFactor: Annotated[str, Enumerant("VkBlendFactor")] | None = None
    colorBlendOp: Annotated[str, Enumerant("VkBlendOp")] | None = None
    srcAlphaBlendFactor: Annotated[str, Enumerant("VkBlendFactor")] | None = None
    dstAlphaBlendFactor: Annotated[str, Enumerant("VkBlendFactor")] | None = None
    alphaBlendOp: Annotated[str, Enumerant("VkBlendOp")] | None = None


class ColorBlendState(Struct):
    """VkPipelineColorBlendStateCreateInfo."""

    logicOpEnable: Bool | None = None
    attachments: tuple[ColorBlendAttachment, ...] = ()


class DepthStencilState(Struct):
    """VkPipelineDepthStencilStateCreateInfo."""

    depthTestEnable: Bool | None = None
    depthWriteEnable: Bool | None = None
    depthCompareOp: CompareOp | None = None
    depthBoundsTestEnable: Bool | None = None
    stencilTestEnable: Bool | None = None


class VertexBinding(Struct):
    """VkVertexInputBindingDescription."""

    binding: Index | None = None
    stride: Index | None = None
    inputRate: Annotated[str, Enumerant("VkVertexInputRate")] | None = None


class VertexAttribute(Struct):
    """VkVertexInputAttributeDescription."""

    location: Index | None = None
    binding: Index | None = None
    format: Format | None = None
    offset: Index | None = None


class VertexInputState(Struct):
    """VkPipelineVertexInputStateCreateInfo."""

    vertexBindingDescriptions: tuple[VertexBinding, ...] = ()
    vertexAttributeDescriptions: tuple[VertexAttribute, ...] = ()


class RasterizationState(Struct):
    """VkPipelineRasterizationStateCreateInfo."""

    rasterizerDiscardEnable: Bool | None = None
    polygonMode: Annotated[str, Enumerant("VkPolygonMode")] | None = None
    depthClampEnable: Bool | None = None
    depthBiasEnable: Bool | None = None


class ShaderStage(Struct):
    """VkPipelineShaderStageCreateInfo; `module` is the path of a SPIR-V file, relative to the description."""

    stage: Annotated[str, Enumerant("VkShaderStageFlagBits")] | None = None
    module: Text | None = None
    name: Text | None = None
    specialization: dict[ConstantId, Number | Bool] | None = Field(
        default=None, description="Values by constant id.", json_schema_extra={"additionalProperties": False}
    )


class PipelineRendering(Struct):
    """VkPipelineRenderingCreateInfo."""

    viewMask: Index | None = None
    colorAttachmentFormats: tuple[Format | None, ...] = ()
    depthAttachmentFormat: Format | None = None
    stencilAttachmentFormat: Format | None = None


class Pipeline(Struct):
    """VkGraphicsPipelineCreateInfo, of a subpass of a render pass or for dynamic rendering."""

    renderPass: RenderPassName | None = None
    subpass: Index | None = None
    rendering: PipelineRendering | None = None
    multisampleState: MultisampleState | None = None
    colorBlendState: ColorBlendState | None = None
    depthStencilState: DepthStencilState | None = None
    vertexInputState: VertexInputState | None = None
    rasterizationState: RasterizationState | None = None
    dynamicState: Annotated[tuple[str, ...], FlagBits("VkDynamicState")] = ()
    stages: tuple[ShaderStage, ...] = ()


class BeginRenderPass(Struct):
    """VkRenderPassBeginInfo; a list of framebuffers alternates from frame to frame."""

    renderPass: RenderPassName | None = None
    framebuffer: FramebufferName | tuple[FramebufferName, ...] | None = None
    renderArea: Rect | None = None
    clearValueCount: Index | None = None


class RenderingAttachment(Struct):
    """VkRenderingAttachmentInfo, with images in place of views."""

    image: ImageName | None = None
    imageLayout: Layout | None = None
    resolveMode: ResolveMode | None = None
    resolveImage: ImageName | None = None
    resolveImageLayout: Layout | None = None
    loadOp: LoadOp | None = None
    storeOp: StoreOp | None = None


class BeginRendering(Struct):
    """VkRenderingInfo; null is an unused colour attachment."""

    flags: Annotated[tuple[str, ...], FlagBits("VkRenderingFlagBits")] = ()
    renderArea: Rect | None = None
    layerCount: Size | None = None
    viewMask: Index | None = None
    colorAttachments: tuple[RenderingAttachment | None, ...] = ()
    depthAttachment: RenderingAttachment | None = None
    stencilAttachment: RenderingAttachment | None = None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None = None


class Draw(Struct):
    """vkCmdDraw, vkCmdDrawIndexed."""

    pipeline: PipelineName | None = None
    vertexCount: Index | None = None
    indexCount: Index | None = None
    instanceCount: Index | None = None
    firstVertex: Index | None = None
    firstInstance: Index | None = None


class ClearAttachment(Struct):
    """VkClearAttachment."""

    aspect: Annotated[tuple[str, ...], FlagBits("VkImageAspectFlagBits")] = ()
    colorAttachment: Index | None = None


class ClearAttachments(Struct):
    """vkCmdClearAttachments."""

    attachments: tuple[ClearAttachment, ...] = ()
    rects: tuple[Rect, ...] = ()


class OneImage(Struct):
    """vkCmdClearColorImage, vkCmdClearDepthStencilImage, vkQueuePresentKHR."""

    image: ImageName | None = None


class TwoImages(Struct):
    """vkCmdResolveImage, vkCmdCopyImage, vkCmdBlitImage."""

    srcImage: ImageName | None = None
    dstImage: ImageName | None = None


class CopyImageToBuffer(Struct):
    """vkCmdCopyImageToBuffer."""

    srcImage: ImageName | None = None


class CopyBufferToImage(Struct):
    """vkCmdCopyBufferToImage."""

    dstImage: ImageName | None = None


class WriteImage(Struct):
    """A shader writes the image."""

    image: ImageName | None = None
    stage: Stage | None = None
    access: Access | None = None


class ReadImage(Struct):
    """A shader reads the image; of a multisampled one which samples it fetches, and what it does with them."""

    image: ImageName | None = None
    stage: Stage | None = None
    access: Access | None = None
    samples: Annotated[Literal[1, "ALL"], Word] | None = None
    resolves: Literal["AVERAGE", "MIN", "MAX", "OTHER"] | None = None


class ImageBarrier(Struct):
    """VkImageMemoryBarrier's image and layouts."""

    image: ImageName | None = None
    oldLayout: Layout | None = None
    newLayout: Layout | None = None


class PipelineBarrier(Struct):
    """vkCmdPipelineBarrier."""

    srcStageMask: Stages = ()
    dstStageMask: Stages = ()
    srcAccessMask: Accesses = ()
    dstAccessMask: Accesses = ()
    images: tuple[ImageBarrier | ImageName, ...] = ()


class Nothing(Struct):
    """A command without parameters."""


class Command(Struct):
    """One recorded command: a mapping with one key. Those without parameters may be written as a bare word."""

    model_config = ConfigDict(json_schema_extra={"minProperties": 1, "maxProperties": 1})

    @model_validator(mode="before")
    @classmethod
    def _is_one(cls, given: Any) -> Any:
        if isinstance(given, dict) and len(given) != 1:
            raise ValueError("one command is due here")
        return given

    beginRenderPass: BeginRenderPass | None = None
    nextSubpass: Annotated[Nothing | None, Null()] = None
    endRenderPass: Annotated[Nothing | None, Null()] = None
    beginRendering: BeginRendering | None = None
    endRendering: Annotated[Nothing | None, Null()] = None
    setRasterizationSamples: Annotated[int, Count()] | None = None
    draw: Draw | None = None
    clearAttachments: ClearAttachments | None = None
    clearColorImage: OneImage | None = None
    clearDepthStencilImage: OneImage | None = None
    resolveImage: TwoImages | None = None
    copyImage: TwoImages | None = None
    blitImage: TwoImages | None = None
    copyImageToBuffer: CopyImageToBuffer | None = None
    copyBufferToImage: CopyBufferToImage | None = None
    writeImage: WriteImage | None = None
    readImage: ReadImage | None = None
    pipelineBarrier: PipelineBarrier | None = None
    present: OneImage | None = None


class Scene(Struct):
    """What the picture needs; only this is simulated."""

    edges: Bool | None = None
    depth: Literal["STANDARD", "REVERSED"] | None = None
    color: Literal["LDR", "HDR"] | None = None
    peak: PositiveNumber | None = Field(default=None, description="The brightest value, in units of display white.")
    depthResolveWants: Literal["ANY", "NEAREST", "FARTHEST"] | None = None
    toneMapping: Literal["AFTER_RESOLVE", "IN_PASS", "NONE"] | None = None
    alphaTest: Bool | None = None
    textureDetail: Bool | None = None


class SampleCountTest(Struct):
    """A test of the bit of one count in a mask, and the count that the branch behind it gives."""

    tests: Samples | None = None
    gives: Samples | None = None


class SampleCountChoice(Struct):
    """How a program finds its sample count in the masks of VkPhysicalDeviceLimits: of which, how combined, and which bit it takes."""

    limits: (
        tuple[
            Literal[
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
            ],
            ...,
        ]
        | None
    ) = None
    combined: Literal["AND", "OR", "MIN", "MAX", "LOGICAL_AND", "LOGICAL_OR", "NONE"] | None = None
    chosen: Literal["MAXIMUM", "ATMOST"] | None = None
    atMost: Samples | None = None
    tests: tuple[SampleCountTest, ...] = ()
    formats: tuple[Format, ...] | None = None


ImpellerStorage = Literal["kHostVisible", "kDevicePrivate", "kDeviceTransient"]
ImpellerLoad = Literal["kDontCare", "kLoad", "kClear"]
ImpellerStore = Literal["kDontCare", "kStore", "kMultisampleResolve", "kStoreAndMultisampleResolve"]


class AttachmentConfig(Struct):
    """Impeller's RenderTarget::AttachmentConfig."""

    storageMode: ImpellerStorage | None = None
    loadAction: ImpellerLoad | None = None
    storeAction: ImpellerStore | None = None
    clearColor: tuple[Number, ...] | None = None


class AttachmentConfigMSAA(Struct):
    """Impeller's RenderTarget::AttachmentConfigMSAA; of one sample a pixel its AttachmentConfig, and `resolveStorageMode` is nobody's."""

    storageMode: ImpellerStorage | None = None
    resolveStorageMode: ImpellerStorage | None = None
    loadAction: ImpellerLoad | None = None
    storeAction: ImpellerStore | None = None
    clearColor: tuple[Number, ...] | None = None


class RenderTarget(Struct):
    """Impeller's render target: what it expands to is what the engine builds of it."""

    api: Literal["vulkan", "metal"] | None = None
    onscreen: Bool | None = None
    width: Size | None = None
    height: Size | None = None
    colorFormat: (
        Literal[
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
        ]
        | None
    ) = None
    depthFormat: Literal["kS8UInt", "kD24UnormS8Uint", "kD32FloatS8UInt"] | None = None
    sampleCount: (
        Annotated[
            Literal[1, 2, 4, 8, 16, "kCount1", "kCount2", "kCount4", "kCount8", "kCount16", "k1", "k2", "k4", "k8", "k16"],
            Word,
        ]
        | None
    ) = None
    enableStencil: Bool | None = None
    colorAttachmentConfig: AttachmentConfigMSAA | None = None
    stencilAttachmentConfig: AttachmentConfig | None = None


class Description(Struct):
    """A frame, or part of one. Everything is optional but what Vulkan needs to make sense of a structure."""

    frame: FrameSize | None = None
    device: Device | Text | None = None
    enabled: Enabled | None = None
    images: dict[str, Image] = {}
    renderPasses: dict[str, RenderPass] = {}
    framebuffers: dict[str, Framebuffer] = {}
    pipelines: dict[str, Pipeline] = {}
    commands: tuple[Command | Literal["nextSubpass", "endRenderPass", "endRendering"], ...] | None = None
    scene: Scene | None = None
    metal: Metal | None = None
    sampleCountChoices: dict[str, SampleCountChoice] = {}
    renderTargets: dict[str, RenderTarget] = {}
