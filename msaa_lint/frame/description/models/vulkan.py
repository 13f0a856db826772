"""Images, render passes, framebuffers and pipelines."""

from __future__ import annotations

from typing import Annotated, Literal

from ..members import (
    MAX_UINT32,
    Accesses,
    AttachmentFlags,
    BlendFactor,
    BlendOp,
    ColorComponents,
    CompareOp,
    DependencyFlags,
    DynamicStates,
    Format,
    FramebufferFlags,
    ImageFlags,
    ImageName,
    ImageTiling,
    ImageType,
    ImageUsage,
    Index,
    Layout,
    LoadOp,
    MemoryProperties,
    Offset,
    PipelineBindPoint,
    PolygonMode,
    PrimitiveTopology,
    RenderPassFlags,
    RenderPassName,
    ResolveMode,
    Samples,
    ShaderStageName,
    SharingMode,
    Size,
    Stages,
    StoreOp,
    SubpassFlags,
    SubpassIndex,
    VertexInputRate,
)
from ..record import Record


class Extent(Record):
    """VkExtent3D, in texels."""

    width: Size | None = None
    height: Size | None = None
    depth: Size | None = None


class Extent2D(Record):
    """VkExtent2D, in pixels."""

    width: Size | None = None
    height: Size | None = None


UnreadStructures = tuple[str, ...]
"""The structures of a pNext chain, by sType, that a description has no keys for: what they do is
unknown.
"""


class Image(Record):
    """VkImageCreateInfo, the memory it is bound to, what its values encode, and whether something
    that is not described may read it.
    """

    format: Format | None = None
    samples: Samples | None = None
    usage: ImageUsage | None = None
    memory: MemoryProperties | None = None
    presentable: bool | None = None
    extent: Extent | None = None
    mipLevels: Size | None = None
    arrayLayers: Size | None = None
    imageType: ImageType | None = None
    tiling: ImageTiling | None = None
    flags: ImageFlags = ()
    sharingMode: SharingMode | None = None
    initialLayout: Layout | None = None
    encoding: Literal["LINEAR", "GAMMA", "DATA"] | None = None
    mayBeRead: bool | None = None
    pNext: UnreadStructures = ()


class AttachmentDescription(Record):
    """VkAttachmentDescription, VkAttachmentDescription2. `image` binds an image without a
    framebuffer.
    """

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
    flags: AttachmentFlags = ()
    pNext: UnreadStructures = ()


class AttachmentReference(Record):
    """VkAttachmentReference: a name, an index, or null for VK_ATTACHMENT_UNUSED."""

    attachment: Annotated[
        str | int | None, ("null", ("either", ("text",), ("int", 0, MAX_UINT32)))
    ] = None
    layout: Layout | None = None


AttachmentSlot = Annotated[AttachmentReference, ("slot",)]


class DepthStencilResolve(Record):
    """VkSubpassDescriptionDepthStencilResolve; `layout` is that of its VkAttachmentReference2."""

    attachment: AttachmentSlot | None = None
    layout: Layout | None = None
    depthResolveMode: ResolveMode | None = None
    stencilResolveMode: ResolveMode | None = None


class RenderToSingleSampled(Record):
    """VkMultisampledRenderToSingleSampledInfoEXT."""

    multisampledRenderToSingleSampledEnable: bool | None = None
    rasterizationSamples: Samples | None = None


class Subpass(Record):
    """VkSubpassDescription, VkSubpassDescription2, VkFragmentShadingRateAttachmentInfoKHR."""

    flags: SubpassFlags = ()
    pipelineBindPoint: PipelineBindPoint | None = None
    inputAttachments: tuple[AttachmentSlot, ...] = ()
    colorAttachments: tuple[AttachmentSlot, ...] = ()
    resolveAttachments: tuple[AttachmentSlot, ...] = ()
    depthStencilAttachment: AttachmentSlot | None = None
    depthStencilResolve: DepthStencilResolve | None = None
    preserveAttachments: tuple[AttachmentSlot, ...] = ()
    viewMask: Index | None = None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None = None
    fragmentShadingRateAttachment: AttachmentSlot | None = None
    shadingRateAttachmentTexelSize: Extent2D | None = None
    pNext: UnreadStructures = ()


class SubpassDependency(Record):
    """VkSubpassDependency, VkSubpassDependency2. `EXTERNAL` is VK_SUBPASS_EXTERNAL."""

    srcSubpass: SubpassIndex | None = None
    dstSubpass: SubpassIndex | None = None
    srcStageMask: Stages = ()
    dstStageMask: Stages = ()
    srcAccessMask: Accesses = ()
    dstAccessMask: Accesses = ()
    dependencyFlags: DependencyFlags = ()
    viewOffset: Offset | None = None


class RenderPass(Record):
    """VkRenderPassCreateInfo, VkRenderPassCreateInfo2,
    VkRenderPassFragmentDensityMapCreateInfoEXT.
    """

    flags: RenderPassFlags = ()
    attachments: Annotated[
        tuple[AttachmentDescription, ...], ("counted", ("record", AttachmentDescription))
    ] = ()
    subpasses: tuple[Subpass, ...] = ()
    dependencies: tuple[SubpassDependency, ...] = ()
    fragmentDensityMapAttachment: AttachmentSlot | None = None
    pNext: UnreadStructures = ()


class Framebuffer(Record):
    """VkFramebufferCreateInfo, with images in place of views."""

    renderPass: RenderPassName | None = None
    attachments: tuple[ImageName | None, ...] = ()
    width: Size | None = None
    height: Size | None = None
    layers: Size | None = None
    flags: FramebufferFlags = ()


class MultisampleState(Record):
    """VkPipelineMultisampleStateCreateInfo."""

    rasterizationSamples: Samples | None = None
    sampleShadingEnable: bool | None = None
    minSampleShading: float | None = None
    sampleMask: tuple[Index, ...] = ()
    alphaToCoverageEnable: bool | None = None
    alphaToOneEnable: bool | None = None


class ColorBlendAttachment(Record):
    """VkPipelineColorBlendAttachmentState."""

    blendEnable: bool | None = None
    colorWriteMask: ColorComponents | None = None
    srcColorBlendFactor: BlendFactor | None = None
    dstColorBlendFactor: BlendFactor | None = None
    colorBlendOp: BlendOp | None = None
    srcAlphaBlendFactor: BlendFactor | None = None
    dstAlphaBlendFactor: BlendFactor | None = None
    alphaBlendOp: BlendOp | None = None


class ColorBlendState(Record):
    """VkPipelineColorBlendStateCreateInfo."""

    logicOpEnable: bool | None = None
    attachments: tuple[ColorBlendAttachment, ...] = ()


class DepthStencilState(Record):
    """VkPipelineDepthStencilStateCreateInfo."""

    depthTestEnable: bool | None = None
    depthWriteEnable: bool | None = None
    depthCompareOp: CompareOp | None = None
    depthBoundsTestEnable: bool | None = None
    stencilTestEnable: bool | None = None


class VertexBinding(Record):
    """VkVertexInputBindingDescription."""

    binding: Index | None = None
    stride: Index | None = None
    inputRate: VertexInputRate | None = None


class VertexAttribute(Record):
    """VkVertexInputAttributeDescription."""

    location: Index | None = None
    binding: Index | None = None
    format: Format | None = None
    offset: Index | None = None


class VertexInputState(Record):
    """VkPipelineVertexInputStateCreateInfo."""

    vertexBindingDescriptions: tuple[VertexBinding, ...] = ()
    vertexAttributeDescriptions: tuple[VertexAttribute, ...] = ()


class InputAssemblyState(Record):
    """VkPipelineInputAssemblyStateCreateInfo."""

    topology: PrimitiveTopology | None = None


class RasterizationState(Record):
    """VkPipelineRasterizationStateCreateInfo."""

    rasterizerDiscardEnable: bool | None = None
    polygonMode: PolygonMode | None = None
    depthClampEnable: bool | None = None
    depthBiasEnable: bool | None = None


Specialization = Annotated[
    dict[str, float | bool], ("numbered", ("either", ("number", False), ("bool",)))
]


class ShaderStage(Record):
    """VkPipelineShaderStageCreateInfo; `module` is the path of a SPIR-V file, relative to the
    description.
    """

    stage: ShaderStageName | None = None
    module: str | None = None
    name: str | None = None
    specialization: Specialization | None = None


class PipelineRendering(Record):
    """VkPipelineRenderingCreateInfo."""

    viewMask: Index | None = None
    colorAttachmentFormats: tuple[Format | None, ...] = ()
    depthAttachmentFormat: Format | None = None
    stencilAttachmentFormat: Format | None = None


class Pipeline(Record):
    """VkGraphicsPipelineCreateInfo, of a subpass of a render pass or for dynamic rendering."""

    renderPass: RenderPassName | None = None
    subpass: Index | None = None
    rendering: PipelineRendering | None = None
    multisampleState: MultisampleState | None = None
    colorBlendState: ColorBlendState | None = None
    depthStencilState: DepthStencilState | None = None
    vertexInputState: VertexInputState | None = None
    inputAssemblyState: InputAssemblyState | None = None
    rasterizationState: RasterizationState | None = None
    dynamicState: DynamicStates = ()
    stages: tuple[ShaderStage, ...] = ()
