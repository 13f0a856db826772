"""The types that the structures of a description declare their members with.

Each is a Python type, which is what a record holds, with the shape (`shapes`) in which an input may
state it.
"""

from typing import Annotated, Any

MAX_UINT32 = 2**32 - 1
MAX_INT32 = 2**31 - 1
MAX_METAL_COLORS = 8
"""Color attachments of one of Metal's render passes or pipelines."""

NO_ENTRIES: dict[str, Any] = {}
"""What a section holds where the input does not state it; shared, so never changed."""

Index = Annotated[int, ("int", 0, MAX_UINT32)]
Size = Annotated[int, ("int", 1, MAX_INT32)]
Offset = Annotated[int, ("int", -MAX_INT32 - 1, MAX_INT32)]
PositiveNumber = Annotated[float, ("number", True)]
Share = Annotated[float, ("share",)]
Samples = Annotated[int, ("samples",)]
ShadingCost = Annotated[str, ("shading",)]
SubpassIndex = Annotated[int | str, ("subpass",)]

ImageName = Annotated[str, ("name", "images")]
RenderPassName = Annotated[str, ("name", "renderPasses")]
FramebufferName = Annotated[str, ("name", "framebuffers")]
PipelineName = Annotated[str, ("name", "pipelines")]
TextureName = Annotated[str, ("name", "metal.textures")]
MetalPassName = Annotated[str, ("name", "metal.renderPasses")]

Access = Annotated[str, ("enum", "VkAccessFlagBits2")]
BlendFactor = Annotated[str, ("enum", "VkBlendFactor")]
BlendOp = Annotated[str, ("enum", "VkBlendOp")]
CompareOp = Annotated[str, ("enum", "VkCompareOp")]
Format = Annotated[str, ("enum", "VkFormat")]
ImageTiling = Annotated[str, ("enum", "VkImageTiling")]
ImageType = Annotated[str, ("enum", "VkImageType")]
Layout = Annotated[str, ("enum", "VkImageLayout")]
LoadOp = Annotated[str, ("enum", "VkAttachmentLoadOp")]
PipelineBindPoint = Annotated[str, ("enum", "VkPipelineBindPoint")]
PolygonMode = Annotated[str, ("enum", "VkPolygonMode")]
PrimitiveTopology = Annotated[str, ("enum", "VkPrimitiveTopology")]
ResolveMode = Annotated[str, ("enum", "VkResolveModeFlagBits")]
ShaderStageName = Annotated[str, ("enum", "VkShaderStageFlagBits")]
SharingMode = Annotated[str, ("enum", "VkSharingMode")]
Stage = Annotated[str, ("enum", "VkShaderStageFlagBits|VkPipelineStageFlagBits2")]
StoreOp = Annotated[str, ("enum", "VkAttachmentStoreOp")]
VertexInputRate = Annotated[str, ("enum", "VkVertexInputRate")]

Accesses = Annotated[tuple[str, ...], ("flags", "VkAccessFlagBits2")]
Aspects = Annotated[tuple[str, ...], ("flags", "VkImageAspectFlagBits")]
AttachmentFlags = Annotated[tuple[str, ...], ("flags", "VkAttachmentDescriptionFlagBits")]
ColorComponents = Annotated[tuple[str, ...], ("flags", "VkColorComponentFlagBits")]
DependencyFlags = Annotated[tuple[str, ...], ("flags", "VkDependencyFlagBits")]
DynamicStates = Annotated[tuple[str, ...], ("flags", "VkDynamicState")]
FramebufferFlags = Annotated[tuple[str, ...], ("flags", "VkFramebufferCreateFlagBits")]
ImageFlags = Annotated[tuple[str, ...], ("flags", "VkImageCreateFlagBits")]
ImageUsage = Annotated[tuple[str, ...], ("flags", "VkImageUsageFlagBits")]
MemoryProperties = Annotated[tuple[str, ...], ("flags", "VkMemoryPropertyFlagBits")]
RenderingFlags = Annotated[tuple[str, ...], ("flags", "VkRenderingFlagBits")]
RenderPassFlags = Annotated[tuple[str, ...], ("flags", "VkRenderPassCreateFlagBits")]
ResolveModes = Annotated[tuple[str, ...], ("flags", "VkResolveModeFlagBits")]
Stages = Annotated[tuple[str, ...], ("flags", "VkPipelineStageFlagBits2")]
SubpassFlags = Annotated[tuple[str, ...], ("flags", "VkSubpassDescriptionFlagBits")]

DepthResolveFilter = Annotated[str, ("enum", "MTLMultisampleDepthResolveFilter")]
GPUFamily = Annotated[str, ("enum", "MTLGPUFamily")]
LoadAction = Annotated[str, ("enum", "MTLLoadAction")]
PixelFormat = Annotated[str, ("enum", "MTLPixelFormat")]
StencilResolveFilter = Annotated[str, ("enum", "MTLMultisampleStencilResolveFilter")]
StorageMode = Annotated[str, ("enum", "MTLStorageMode")]
StoreAction = Annotated[str, ("enum", "MTLStoreAction")]
TextureType = Annotated[str, ("enum", "MTLTextureType")]
TextureUsage = Annotated[tuple[str, ...], ("flags", "MTLTextureUsage")]
