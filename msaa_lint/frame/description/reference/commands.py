"""What recorded commands and their keys mean."""

from .entries import Key, Structure
from .render_passes import UNREAD

_STAGE = Key(
    "Shader stage",
    "The stage of the shader that accesses the image, or the pipeline stage of another access.",
    section="synchronization-pipeline-stages",
    source="",
)
_ONE_IMAGE = Key("Image", "The name of the image in `images`.", source="")

COMMAND_STRUCTURES = {
    "Rect": Structure(
        "Rectangle",
        "VkRect2D",
        "renderpass-commands",
        {
            "x": Key(
                "Left edge", "The first column of the rectangle.", "pixels", source="VkOffset2D::x"
            ),
            "y": Key(
                "Top edge", "The first row of the rectangle.", "pixels", source="VkOffset2D::y"
            ),
            "width": Key(
                "Width", "The width of the rectangle.", "pixels", source="VkExtent2D::width"
            ),
            "height": Key(
                "Height", "The height of the rectangle.", "pixels", source="VkExtent2D::height"
            ),
        },
    ),
    "BeginRenderPass": Structure(
        "Begin a render pass",
        "VkRenderPassBeginInfo",
        "renderpass-commands",
        {
            "renderPass": Key(
                "Render pass", "The name in `renderPasses` of the render pass that begins."
            ),
            "framebuffer": Key(
                "Framebuffer",
                "The name in `framebuffers` of the framebuffer that binds the images; a list "
                "alternates from frame to frame.",
                absent="the images that the attachments name",
            ),
            "renderArea": Key(
                "Render area", "The pixels that the pass loads, draws, resolves and stores."
            ),
            "clearValueCount": Key(
                "Number of clear values",
                "How many attachments have a clear value, from index 0.",
                "attachments",
            ),
            "label": Key(
                "Debug label",
                "What the application calls this part of the frame. Findings about the pass begin "
                "with it.",
                source="VkDebugUtilsLabelEXT::pLabelName",
            ),
        },
    ),
    "RenderingAttachment": Structure(
        "Attachment of dynamic rendering",
        "VkRenderingAttachmentInfo",
        "renderpass",
        {
            "image": Key(
                "Image",
                "The name of the image in `images`.",
                absent="no attachment",
                source="VkRenderingAttachmentInfo::imageView",
            ),
            "imageLayout": Key(
                "Layout",
                "The layout of the image while rendering.",
                section="resources-image-layouts",
            ),
            "resolveMode": Key(
                "Resolve mode",
                "How the samples of a pixel become one value in `resolveImage`: AVERAGE for color, "
                "mostly SAMPLE_ZERO for depth.",
                section="renderpass-resolve-operations",
            ),
            "resolveImage": Key(
                "Resolve image",
                "The single-sampled image that rendering resolves to, without a pass of its own.",
                absent="not resolved",
                source="VkRenderingAttachmentInfo::resolveImageView",
                section="renderpass-resolve-operations",
            ),
            "resolveImageLayout": Key(
                "Layout of the resolve image",
                "The layout of the resolve image while rendering.",
                section="resources-image-layouts",
            ),
            "loadOp": Key(
                "Load operation",
                "What happens to the image when rendering begins. LOAD reads every sample from "
                "memory; CLEAR and DONT_CARE cost no "
                "bandwidth on a tile-based GPU.",
                section="renderpass-load-operations",
            ),
            "storeOp": Key(
                "Store operation",
                "What happens to the image when rendering ends. STORE writes every sample to "
                "memory; DONT_CARE discards them, which is "
                "right if nothing reads them later.",
                section="renderpass-store-operations",
            ),
            "pNext": UNREAD,
        },
    ),
    "FragmentDensityMapAttachment": Structure(
        "Fragment density map of dynamic rendering",
        "VkRenderingFragmentDensityMapAttachmentInfoEXT",
        "renderpass",
        {
            "image": Key(
                "Image",
                "The name of the image in `images`.",
                absent="no attachment",
                source="VkRenderingFragmentDensityMapAttachmentInfoEXT::imageView",
            ),
            "imageLayout": Key(
                "Layout",
                "The layout of the image while rendering.",
                section="resources-image-layouts",
            ),
        },
    ),
    "FragmentShadingRateAttachment": Structure(
        "Fragment shading rate attachment of dynamic rendering",
        "VkRenderingFragmentShadingRateAttachmentInfoKHR",
        "renderpass",
        {
            "image": Key(
                "Image",
                "The name of the image in `images`.",
                absent="no attachment",
                source="VkRenderingFragmentShadingRateAttachmentInfoKHR::imageView",
            ),
            "imageLayout": Key(
                "Layout",
                "The layout of the image while rendering.",
                section="resources-image-layouts",
            ),
            "shadingRateAttachmentTexelSize": Key(
                "Texel size", "The pixels that a texel of the attachment is for."
            ),
        },
    ),
    "BeginRendering": Structure(
        "Begin dynamic rendering",
        "VkRenderingInfo",
        "renderpass",
        {
            "flags": Key(
                "Rendering flags",
                "SUSPENDING and RESUMING continue one rendering in several parts, without loads "
                "and stores between them.",
            ),
            "renderArea": Key(
                "Render area", "The pixels that are loaded, drawn, resolved and stored."
            ),
            "layerCount": Key(
                "Layers", "The layers that are rendered to, without a view mask.", "layers"
            ),
            "viewMask": Key(
                "View mask",
                "The views that are rendered to, a bit for each; 0 without multiview.",
                "bit mask of views",
            ),
            "colorAttachments": Key(
                "Color attachments",
                "The color attachments in order of location; null for an unused one.",
            ),
            "depthAttachment": Key(
                "Depth attachment", "The attachment of the depth test.", absent="none"
            ),
            "stencilAttachment": Key(
                "Stencil attachment", "The attachment of the stencil test.", absent="none"
            ),
            "multisampledRenderToSingleSampled": Key(
                "Multisampled rendering to single-sampled images",
                "Renders with several samples to attachments of one sample. The samples exist only "
                "on the tile.",
                absent="not used",
                source="VkMultisampledRenderToSingleSampledInfoEXT",
            ),
            "fragmentDensityMapAttachment": Key(
                "Fragment density map",
                "The image that says for each block of pixels how densely it is shaded, such as "
                "for a foveated eye buffer. It is read.",
                absent="none",
                source="VkRenderingFragmentDensityMapAttachmentInfoEXT",
            ),
            "fragmentShadingRateAttachment": Key(
                "Fragment shading rate attachment",
                "The image that says for each block of pixels how large a fragment is. It is read.",
                absent="none",
                source="VkRenderingFragmentShadingRateAttachmentInfoKHR",
            ),
            "label": Key(
                "Debug label",
                "What the application calls this part of the frame; a list for a rendering that is "
                "begun again. Findings begin with it.",
                source="VkDebugUtilsLabelEXT::pLabelName",
            ),
            "pNext": UNREAD,
        },
    ),
    "Draw": Structure(
        "Draw",
        "",
        "drawing-primitive-shading",
        {
            "pipeline": Key(
                "Pipeline",
                "The name in `pipelines` of the bound pipeline.",
                source="vkCmdBindPipeline",
            ),
            "vertexCount": Key(
                "Vertex count",
                "The number of vertices, without an index buffer.",
                "vertices",
                source="VkDrawIndirectCommand::vertexCount",
            ),
            "indexCount": Key(
                "Index count",
                "The number of vertices, with an index buffer.",
                "indices",
                source="VkDrawIndexedIndirectCommand::indexCount",
            ),
            "instanceCount": Key(
                "Instance count",
                "The number of instances.",
                "instances",
                source="VkDrawIndirectCommand::instanceCount",
            ),
            "firstVertex": Key(
                "First vertex",
                "The index of the first vertex.",
                "index from 0",
                source="VkDrawIndirectCommand::firstVertex",
            ),
            "firstInstance": Key(
                "First instance",
                "The ID of the first instance.",
                "index from 0",
                source="VkDrawIndirectCommand::firstInstance",
            ),
            "drawCount": Key(
                "Number of draws",
                "How many such draws follow each other; the other counts are their averages.",
                "draws",
                "1",
                "",
            ),
        },
    ),
    "ClearAttachment": Structure(
        "Attachment to clear",
        "VkClearAttachment",
        "clears-inside",
        {
            "aspect": Key(
                "Aspects", "The aspects that are cleared.", source="VkClearAttachment::aspectMask"
            ),
            "colorAttachment": Key(
                "Color attachment", "The color attachment that is cleared.", "index from 0"
            ),
        },
    ),
    "ClearAttachments": Structure(
        "Clear attachments within a pass",
        "",
        "clears-inside",
        {
            "attachments": Key("Attachments", "What is cleared.", source="vkCmdClearAttachments"),
            "rects": Key(
                "Rectangles", "The pixels that are cleared.", source="vkCmdClearAttachments"
            ),
        },
    ),
    "OneImage": Structure("Command on an image", "", "", {"image": _ONE_IMAGE}),
    "TwoImages": Structure(
        "Command on two images",
        "",
        "",
        {
            "srcImage": Key(
                "Source image",
                "The name in `images` of the image that is read.",
                source="VkResolveImageInfo2::srcImage",
            ),
            "dstImage": Key(
                "Destination image",
                "The name in `images` of the image that is written.",
                source="VkResolveImageInfo2::dstImage",
            ),
        },
    ),
    "ResolveImage": Structure(
        "Resolve an image",
        "VkResolveImageInfo2",
        "copies-resolve",
        {
            "srcImage": Key(
                "Source image",
                "The name in `images` of the image that is read.",
                source="VkResolveImageInfo2::srcImage",
            ),
            "dstImage": Key(
                "Destination image",
                "The name in `images` of the image that is written.",
                source="VkResolveImageInfo2::dstImage",
            ),
            "resolveMode": Key(
                "Resolve mode",
                "How the samples of color or depth become one value. Without a mode, there is no "
                "VkResolveImageModeInfoKHR, and the "
                "device chooses.",
                source="VkResolveImageModeInfoKHR::resolveMode",
            ),
            "stencilResolveMode": Key(
                "Resolve mode of stencil",
                "How the samples of stencil become one value.",
                source="VkResolveImageModeInfoKHR::stencilResolveMode",
            ),
        },
    ),
    "CopyImageToBuffer": Structure(
        "Copy an image to a buffer",
        "VkCopyImageToBufferInfo2",
        "copies-buffers-images",
        {"srcImage": Key("Source image", "The name in `images` of the image that is read.")},
    ),
    "CopyBufferToImage": Structure(
        "Copy a buffer to an image",
        "VkCopyBufferToImageInfo2",
        "copies-buffers-images",
        {
            "dstImage": Key(
                "Destination image", "The name in `images` of the image that is written."
            )
        },
    ),
    "WriteImage": Structure(
        "Write an image in a shader",
        "",
        "synchronization-access-types",
        {
            "image": _ONE_IMAGE,
            "stage": _STAGE,
            "access": Key("Access", "The kind of write.", absent="a write by a shader", source=""),
        },
    ),
    "ReadImage": Structure(
        "Read an image in a shader",
        "",
        "synchronization-access-types",
        {
            "image": _ONE_IMAGE,
            "stage": _STAGE,
            "access": Key(
                "Access",
                "The kind of read: SHADER_READ, or an access of no shader.",
                absent="a read that may not happen",
                source="",
            ),
            "samples": Key(
                "Samples read",
                "Of a multisampled image: 1 if only one sample of a texel is fetched, ALL if every "
                "one is.",
                "samples per texel",
                source="",
            ),
            "resolves": Key(
                "Combination of samples",
                "What the shader does with the samples of a texel: AVERAGE, MIN, MAX, or OTHER.",
                source="",
            ),
        },
    ),
    "ImageBarrier": Structure(
        "Image barrier",
        "VkImageMemoryBarrier2",
        "synchronization-image-memory-barriers",
        {
            "image": Key("Image", "The name of the image in `images`."),
            "oldLayout": Key(
                "Old layout",
                "The layout before the barrier. From UNDEFINED, the contents are lost.",
            ),
            "newLayout": Key("New layout", "The layout after the barrier."),
        },
    ),
    "PipelineBarrier": Structure(
        "Pipeline barrier",
        "VkImageMemoryBarrier2",
        "synchronization-pipeline-barriers",
        {
            "srcStageMask": Key(
                "Source stages",
                "The pipeline stages that must have finished.",
                section="synchronization-pipeline-stages",
            ),
            "dstStageMask": Key(
                "Destination stages",
                "The pipeline stages that wait.",
                section="synchronization-pipeline-stages",
            ),
            "srcAccessMask": Key(
                "Source accesses",
                "The accesses whose writes are made available.",
                section="synchronization-access-types",
            ),
            "dstAccessMask": Key(
                "Destination accesses",
                "The accesses to which the writes are made visible.",
                section="synchronization-access-types",
            ),
            "images": Key(
                "Images",
                "The images of the barrier: names, or `{image, oldLayout, newLayout}`.",
                source="VkDependencyInfo::pImageMemoryBarriers",
                section="synchronization-image-memory-barriers",
            ),
        },
    ),
    "Nothing": Structure("No parameters", "", "", {}),
    "Command": Structure(
        "Recorded command",
        "",
        "",
        {
            "beginRenderPass": Key(
                "Begin a render pass",
                "Begins a render pass: its attachments are loaded.",
                source="vkCmdBeginRenderPass2",
                section="renderpass-commands",
            ),
            "nextSubpass": Key(
                "Next subpass",
                "Begins the next subpass of the render pass.",
                source="vkCmdNextSubpass2",
                section="renderpass-commands",
            ),
            "endRenderPass": Key(
                "End the render pass",
                "Ends the render pass: its attachments are resolved and stored.",
                source="vkCmdEndRenderPass2",
                section="renderpass-commands",
            ),
            "beginRendering": Key(
                "Begin dynamic rendering",
                "Begins a pass without a render pass object: its attachments are loaded.",
                source="vkCmdBeginRendering",
                section="renderpass",
            ),
            "endRendering": Key(
                "End dynamic rendering",
                "Ends dynamic rendering: its attachments are resolved and stored.",
                source="vkCmdEndRendering",
                section="renderpass",
            ),
            "setRasterizationSamples": Key(
                "Set the sample count",
                "Sets the samples of a pixel for pipelines with this dynamic state.",
                source="vkCmdSetRasterizationSamplesEXT",
                section="primsrast-multisampling",
            ),
            "draw": Key(
                "Draw",
                "Draws with a pipeline, with or without an index buffer.",
                source="vkCmdDraw",
                section="drawing-primitive-shading",
            ),
            "clearAttachments": Key(
                "Clear attachments within a pass",
                "Clears parts of attachments in a pass; CLEAR as load operation is cheaper.",
                source="vkCmdClearAttachments",
                section="clears-inside",
            ),
            "clearColorImage": Key(
                "Clear a color image",
                "Clears a color image outside a pass, in memory.",
                source="vkCmdClearColorImage",
                section="clears-outside",
            ),
            "clearDepthStencilImage": Key(
                "Clear a depth-stencil image",
                "Clears a depth-stencil image outside a pass, in memory.",
                source="vkCmdClearDepthStencilImage",
                section="clears-outside",
            ),
            "resolveImage": Key(
                "Resolve an image outside a pass",
                "Resolves a multisampled color image in memory: all samples are written and read "
                "again, which a resolve attachment avoids.",
                source="vkCmdResolveImage2",
                section="copies-resolve",
            ),
            "copyImage": Key(
                "Copy an image",
                "Copies texels, all of their samples included.",
                source="vkCmdCopyImage2",
                section="copies-images",
            ),
            "blitImage": Key(
                "Blit an image",
                "Copies texels with scaling and conversion; not from or to multisampled images.",
                source="vkCmdBlitImage2",
                section="copies-imagescaling",
            ),
            "copyImageToBuffer": Key(
                "Copy an image to a buffer",
                "Copies texels to a buffer; not from multisampled images.",
                source="vkCmdCopyImageToBuffer2",
                section="copies-buffers-images",
            ),
            "copyBufferToImage": Key(
                "Copy a buffer to an image",
                "Copies texels from a buffer; not to multisampled images.",
                source="vkCmdCopyBufferToImage2",
                section="copies-buffers-images",
            ),
            "writeImage": Key(
                "Write an image in a shader",
                "A shader writes the image, such as a compute shader.",
                source="",
                section="synchronization-access-types",
            ),
            "readImage": Key(
                "Read an image in a shader",
                "A shader reads the image, so that its contents must have been stored.",
                source="",
                section="synchronization-access-types",
            ),
            "pipelineBarrier": Key(
                "Pipeline barrier",
                "Orders commands, makes their writes visible, and changes layouts.",
                source="vkCmdPipelineBarrier2",
                section="synchronization-pipeline-barriers",
            ),
            "present": Key(
                "Present an image",
                "Shows a swapchain image.",
                source="vkQueuePresentKHR",
                section="wsi-swapchain",
            ),
        },
    ),
}
