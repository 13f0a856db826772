"""What the values of enumerants mean, as far as it matters for multisampling."""

_STORE_AND_RESOLVE = (
    "Writes the resolved texture and every sample: as many times the bytes of the "
    "texture as there are samples, on top of it."
)

ENUMERANTS: dict[str, dict[str, str]] = {
    "VkAttachmentLoadOp": {
        "LOAD": "Reads the earlier contents from memory: every sample of every pixel of the render "
        "area.",
        "CLEAR": "Clears all samples to the clear value; costs no bandwidth on a tile-based GPU.",
        "DONT_CARE": "Leaves the contents undefined; costs no bandwidth, and is right if every "
        "pixel is overwritten.",
        "NONE": "Does not access the image, which keeps its contents; for an attachment that the "
        "pass does not use or only resolves to.",
    },
    "VkAttachmentStoreOp": {
        "STORE": "Writes the contents to memory: every sample of every pixel of the render area.",
        "DONT_CARE": "Discards the contents; costs no bandwidth, and is right if nothing reads the "
        "samples later.",
        "NONE": "Does not write the image, which keeps what it had in memory; for an attachment "
        "that is only read.",
    },
    "VkResolveModeFlagBits": {
        "NONE": "Does not resolve.",
        "SAMPLE_ZERO": "Takes sample 0 of each pixel. All devices with depth and stencil resolves "
        "support it.",
        "AVERAGE": "Averages the samples of each pixel: the resolve of color.",
        "MIN": "Takes the lowest sample of each pixel: the nearest depth, or the farthest if depth "
        "is reversed.",
        "MAX": "Takes the highest sample of each pixel: the farthest depth, or the nearest if "
        "depth is reversed.",
    },
    "VkImageUsageFlagBits": {
        "TRANSFER_SRC": "May be the source of copies, blits, and resolves outside a pass.",
        "TRANSFER_DST": "May be the destination of copies, blits, clears, and resolves outside a "
        "pass.",
        "SAMPLED": "May be read by shaders through a sampler, which requires it to be stored.",
        "STORAGE": "May be read and written by shaders as a storage image; several samples need a "
        "feature.",
        "COLOR_ATTACHMENT": "May be a color or resolve attachment.",
        "DEPTH_STENCIL_ATTACHMENT": "May be a depth-stencil attachment, or a resolve attachment of "
        "one.",
        "TRANSIENT_ATTACHMENT": "May be used as an attachment alone, so that lazily allocated "
        "memory can back it.",
        "INPUT_ATTACHMENT": "May be read by fragment shaders at their own pixel, on the tile.",
    },
    "VkMemoryPropertyFlagBits": {
        "DEVICE_LOCAL": "The memory that is the fastest for the device.",
        "HOST_VISIBLE": "The host can map the memory.",
        "HOST_COHERENT": "Writes of the host and the device are visible to each other without "
        "flushes.",
        "HOST_CACHED": "The host caches the memory, so that its reads are fast.",
        "LAZILY_ALLOCATED": "Allocated only when a tile is written out, for transient attachments; "
        "takes no memory until then.",
        "PROTECTED": "Only protected queue operations can access the memory.",
    },
    "VkImageLayout": {
        "UNDEFINED": "No layout in particular. A transition from it loses the contents, and loads "
        "nothing.",
        "GENERAL": "Allows every access; on some GPUs without compression.",
        "COLOR_ATTACHMENT_OPTIMAL": "For a color or resolve attachment.",
        "DEPTH_STENCIL_ATTACHMENT_OPTIMAL": "For a depth-stencil attachment that is tested and "
        "written.",
        "DEPTH_STENCIL_READ_ONLY_OPTIMAL": "For depth and stencil that are tested or read by "
        "shaders, not written.",
        "SHADER_READ_ONLY_OPTIMAL": "For reads by shaders.",
        "TRANSFER_SRC_OPTIMAL": "For the source of a copy, a blit, or a resolve.",
        "TRANSFER_DST_OPTIMAL": "For the destination of a copy, a blit, a clear, or a resolve.",
        "PREINITIALIZED": "Keeps what the host wrote; for linear images at creation.",
        "PRESENT_SRC_KHR": "For presentation of a swapchain image.",
    },
    "VkImageTiling": {
        "OPTIMAL": "An arrangement of the implementation's choice. Multisampled images need it.",
        "LINEAR": "Row by row, for the host. Not for multisampled images.",
    },
    "VkImageType": {
        "1D": "One-dimensional; not multisampled.",
        "2D": "Two-dimensional; may be multisampled.",
        "3D": "Three-dimensional; not multisampled.",
    },
    "VkAttachmentDescriptionFlagBits": {
        "MAY_ALIAS": "The attachment may share memory with another one of the render pass."
    },
    "VkDependencyFlagBits": {
        "BY_REGION": "Limits the dependency to the same pixels, so that tiles need not be flushed.",
        "VIEW_LOCAL": "Limits the dependency to the same or a shifted view.",
        "DEVICE_GROUP": "Extends the dependency to all devices of a group.",
    },
    "MTLLoadAction": {
        "dontCare": "Leaves the contents undefined; costs no bandwidth, and is right if every "
        "pixel is overwritten.",
        "load": "Reads the earlier contents from memory: every sample of every pixel.",
        "clear": "Clears all samples; costs no bandwidth on a tile-based GPU.",
    },
    "MTLStoreAction": {
        "dontCare": "Discards the contents; costs no bandwidth.",
        "store": "Writes the contents to memory: every sample of every pixel.",
        "multisampleResolve": "Writes the resolved texture alone; the samples are discarded.",
        "storeAndMultisampleResolve": _STORE_AND_RESOLVE,
        "unknown": "Decided later, before the encoder ends.",
        "customSampleDepthStore": "Writes depth with custom sample positions.",
    },
    "MTLStorageMode": {
        "shared": "In memory that the CPU and the GPU share.",
        "managed": "In a copy for the CPU and one for the GPU, which are synchronized explicitly.",
        "private": "In memory that only the GPU accesses.",
        "memoryless": "On the tile alone: takes no memory, and can be neither loaded nor stored.",
    },
    "MTLTextureUsage": {
        "unknown": "Allows every use, and may disable compression.",
        "shaderRead": "May be read by shaders.",
        "shaderWrite": "May be written by shaders.",
        "renderTarget": "May be an attachment or a resolve texture.",
        "pixelFormatView": "May have views of other formats.",
        "shaderAtomic": "May be accessed by atomic operations of shaders.",
    },
    "MTLMultisampleDepthResolveFilter": {
        "sample0": "Takes sample 0 of each pixel.",
        "min": "Takes the lowest depth of each pixel.",
        "max": "Takes the highest depth of each pixel.",
    },
    "MTLMultisampleStencilResolveFilter": {
        "sample0": "Takes sample 0 of each pixel.",
        "depthResolvedSample": "Takes the sample that the depth resolve selected.",
    },
}
"""By enum, then by the short name of the value."""
