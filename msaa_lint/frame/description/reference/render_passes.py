"""What the keys of images, render passes and framebuffers mean."""

from .entries import Key, Structure

UNREAD = Key(
    "Structures that are not described",
    "The structures of the pNext chain, by sType, for which a description has no key. What they "
    "use is unknown: no rule then relies on "
    "nothing using what this structure describes, and no fix of the description is safe.",
    source="",
)

RENDER_PASS_STRUCTURES = {
    "Extent2D": Structure(
        "Size of a texel",
        "VkExtent2D",
        "renderpass-creation",
        {
            "width": Key("Width", "The width.", "pixels"),
            "height": Key("Height", "The height.", "pixels"),
        },
    ),
    "Extent": Structure(
        "Image size",
        "VkExtent3D",
        "resources-images",
        {
            "width": Key("Width", "The width of mip level 0.", "texels"),
            "height": Key("Height", "The height of mip level 0.", "texels"),
            "depth": Key(
                "Depth",
                "The depth of mip level 0; 1 unless the image is three-dimensional.",
                "texels",
                "1",
            ),
        },
    ),
    "Image": Structure(
        "Image",
        "VkImageCreateInfo",
        "resources-images",
        {
            "format": Key(
                "Format",
                "The format of the texels: how many bytes a sample takes, and its aspects.",
                section="formats-definition",
            ),
            "samples": Key(
                "Sample count",
                "The samples of a texel. With 4, the image takes 4 times the memory, and each load "
                "or store of it moves 4 times the bytes.",
            ),
            "usage": Key(
                "Usages",
                "All ways in which the image may be used. TRANSIENT_ATTACHMENT says that its "
                "contents need not outlive a render pass, "
                "so that a tile-based GPU may never allocate memory for it.",
                absent="unknown",
            ),
            "memory": Key(
                "Memory properties",
                "The property flags of the memory type that the image is bound to. "
                "LAZILY_ALLOCATED memory costs nothing as long as "
                "all accesses stay on the tile.",
                absent="unknown",
                source="VkMemoryType::propertyFlags",
                section="memory-device-lazy_allocation",
            ),
            "presentable": Key(
                "Swapchain image",
                "Whether the image belongs to a swapchain. It then has one sample per texel and is "
                "shown by `present`.",
                source="vkGetSwapchainImagesKHR",
                section="wsi-swapchain",
            ),
            "extent": Key(
                "Size",
                "The size of mip level 0, in texels.",
                absent="the size of the framebuffer or render area that uses it",
            ),
            "mipLevels": Key(
                "Mip levels",
                "The number of levels of detail. A multisampled image has one.",
                "levels",
            ),
            "arrayLayers": Key(
                "Array layers",
                "The number of layers, such as 2 for the views of a headset.",
                "layers",
            ),
            "imageType": Key(
                "Dimensions",
                "Whether the image has one, two or three dimensions. A multisampled image has type "
                "2D.",
            ),
            "tiling": Key(
                "Tiling", "The arrangement of texels in memory. A multisampled image needs OPTIMAL."
            ),
            "flags": Key(
                "Creation flags",
                "Additional properties of the image, such as "
                "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT.",
            ),
            "sharingMode": Key(
                "Sharing mode",
                "Whether several queue families may access the image at a time.",
                section="resources-sharing",
            ),
            "initialLayout": Key(
                "Layout at creation",
                "The layout in which the image is created: UNDEFINED or PREINITIALIZED.",
                section="resources-image-layouts",
            ),
            "encoding": Key(
                "Encoding",
                "What the values stand for: LINEAR light, GAMMA-encoded color, or DATA, such as "
                "normals. "
                "An average of samples is right for LINEAR values only.",
                source="",
            ),
            "mayBeRead": Key(
                "May be read elsewhere",
                "True if something that the description leaves out may read the image. No rule "
                "then relies on nothing reading it.",
                absent="false",
                source="",
            ),
            "pNext": UNREAD,
        },
    ),
    "AttachmentDescription": Structure(
        "Attachment of a render pass",
        "VkAttachmentDescription2",
        "renderpass-creation",
        {
            "image": Key(
                "Bound image",
                "The name of the image in `images` that this attachment uses, without a "
                "framebuffer.",
                absent="the image that a framebuffer binds",
                source="VkFramebufferCreateInfo::pAttachments",
            ),
            "format": Key(
                "Format", "The format of the image view.", absent="the format of the bound image"
            ),
            "samples": Key(
                "Sample count",
                "The samples of the image view.",
                absent="the sample count of the bound image",
            ),
            "loadOp": Key(
                "Load operation",
                "What happens to color or depth when the render pass begins. LOAD reads every "
                "sample from memory; "
                "CLEAR and DONT_CARE cost no bandwidth on a tile-based GPU.",
                section="renderpass-load-operations",
            ),
            "storeOp": Key(
                "Store operation",
                "What happens to color or depth when the render pass ends. STORE writes every "
                "sample to memory; "
                "DONT_CARE discards them, which is right if nothing reads them later.",
                section="renderpass-store-operations",
            ),
            "stencilLoadOp": Key(
                "Stencil load operation",
                "What happens to the stencil aspect when the render pass begins; ignored without "
                "one.",
                section="renderpass-load-operations",
            ),
            "stencilStoreOp": Key(
                "Stencil store operation",
                "What happens to the stencil aspect when the render pass ends; ignored without "
                "one.",
                section="renderpass-store-operations",
            ),
            "initialLayout": Key(
                "Layout before the pass",
                "The layout of the image when the render pass begins. From UNDEFINED, its contents "
                "are lost.",
                section="resources-image-layouts",
            ),
            "finalLayout": Key(
                "Layout after the pass",
                "The layout to which the image changes when the render pass ends, such as "
                "PRESENT_SRC_KHR for a swapchain image.",
                section="resources-image-layouts",
            ),
            "stencilInitialLayout": Key(
                "Stencil layout before the pass",
                "The layout of the stencil aspect when the render pass begins, if it differs from "
                "`initialLayout`.",
                absent="`initialLayout`",
                source="VkAttachmentDescriptionStencilLayout::stencilInitialLayout",
            ),
            "stencilFinalLayout": Key(
                "Stencil layout after the pass",
                "The layout of the stencil aspect after the render pass, if it differs from "
                "`finalLayout`.",
                absent="`finalLayout`",
                source="VkAttachmentDescriptionStencilLayout::stencilFinalLayout",
            ),
            "flags": Key(
                "Attachment flags",
                "MAY_ALIAS if the attachment may share memory with another one of the render pass.",
            ),
            "pNext": UNREAD,
        },
    ),
    "AttachmentReference": Structure(
        "Reference to an attachment",
        "VkAttachmentReference2",
        "renderpass-creation",
        {
            "attachment": Key(
                "Attachment",
                "The name or the index of an attachment of the same render pass; null for "
                "VK_ATTACHMENT_UNUSED.",
                "index from 0",
                absent="VK_ATTACHMENT_UNUSED",
            ),
            "layout": Key(
                "Layout",
                "The layout of the attachment in this subpass.",
                section="resources-image-layouts",
            ),
        },
    ),
    "DepthStencilResolve": Structure(
        "Depth and stencil resolve",
        "VkSubpassDescriptionDepthStencilResolve",
        "renderpass-resolve-operations",
        {
            "attachment": Key(
                "Resolve attachment",
                "The single-sampled attachment that depth and stencil are resolved to, without a "
                "pass of its own.",
                "index from 0",
                absent="VK_ATTACHMENT_UNUSED",
                source="VkSubpassDescriptionDepthStencilResolve::pDepthStencilResolveAttachment",
            ),
            "layout": Key(
                "Layout of the resolve attachment",
                "The layout of the resolve attachment in this subpass.",
                source="VkAttachmentReference2::layout",
            ),
            "depthResolveMode": Key(
                "Depth resolve mode",
                "How the depth samples of a pixel become one value. All devices with depth "
                "resolves support SAMPLE_ZERO.",
            ),
            "stencilResolveMode": Key(
                "Stencil resolve mode",
                "How the stencil samples of a pixel become one value. AVERAGE is not allowed.",
            ),
        },
    ),
    "RenderToSingleSampled": Structure(
        "Multisampled rendering to single-sampled images",
        "VkMultisampledRenderToSingleSampledInfoEXT",
        "renderpass",
        {
            "multisampledRenderToSingleSampledEnable": Key(
                "Enabled",
                "Whether the subpass renders with several samples to attachments of one sample, "
                "which are resolved implicitly.",
            ),
            "rasterizationSamples": Key(
                "Sample count", "The samples of a pixel with which the subpass rasterizes."
            ),
        },
    ),
    "Subpass": Structure(
        "Subpass",
        "VkSubpassDescription2",
        "renderpass-creation",
        {
            "flags": Key(
                "Subpass flags",
                "Additional properties of the subpass, such as a custom resolve by a shader.",
            ),
            "pipelineBindPoint": Key(
                "Kind of pipeline", "The kind of pipeline that the subpass uses: GRAPHICS."
            ),
            "inputAttachments": Key(
                "Input attachments",
                "The attachments that fragment shaders read at their own pixel, on the tile.",
                "index from 0",
            ),
            "colorAttachments": Key(
                "Color attachments",
                "The attachments that fragment shaders write, in order of location; null for an "
                "unused one.",
                "index from 0",
            ),
            "resolveAttachments": Key(
                "Resolve attachments",
                "The single-sampled attachments to which the color attachments are resolved at the "
                "end of the subpass, in the same order; "
                "null for a color attachment that is not resolved. On a tile-based GPU the samples "
                "need not leave the tile.",
                "index from 0",
                section="renderpass-resolve-operations",
            ),
            "depthStencilAttachment": Key(
                "Depth-stencil attachment",
                "The attachment of the depth and stencil tests.",
                "index from 0",
                "none",
            ),
            "depthStencilResolve": Key(
                "Depth and stencil resolve",
                "The attachment to which depth and stencil are resolved at the end of the subpass, "
                "and how.",
                absent="not resolved",
                source="VkSubpassDescriptionDepthStencilResolve",
                section="renderpass-resolve-operations",
            ),
            "preserveAttachments": Key(
                "Preserved attachments",
                "The attachments that this subpass does not use and whose contents it keeps.",
                "index from 0",
            ),
            "viewMask": Key(
                "View mask",
                "The views that the subpass renders to, a bit for each; 0 without multiview.",
                "bit mask of views",
            ),
            "multisampledRenderToSingleSampled": Key(
                "Multisampled rendering to single-sampled images",
                "Renders with several samples to attachments of one sample. The samples exist only "
                "on the tile.",
                absent="not used",
                source="VkMultisampledRenderToSingleSampledInfoEXT",
                section="renderpass",
            ),
            "fragmentShadingRateAttachment": Key(
                "Fragment shading rate attachment",
                "The attachment that says for each block of pixels how large a fragment is. The "
                "subpass reads it.",
                "index from 0",
                "none",
                "VkFragmentShadingRateAttachmentInfoKHR::pFragmentShadingRateAttachment",
            ),
            "shadingRateAttachmentTexelSize": Key(
                "Texel size of the shading rate attachment",
                "The pixels that a texel of the fragment shading rate attachment is for.",
                source="VkFragmentShadingRateAttachmentInfoKHR::shadingRateAttachmentTexelSize",
            ),
            "pNext": UNREAD,
        },
    ),
    "SubpassDependency": Structure(
        "Subpass dependency",
        "VkSubpassDependency2",
        "renderpass-creation",
        {
            "srcSubpass": Key(
                "Source subpass",
                "The subpass that must come first, or EXTERNAL for what is outside the render "
                "pass.",
                "index from 0",
            ),
            "dstSubpass": Key(
                "Destination subpass",
                "The subpass that waits, or EXTERNAL for what is outside the render pass.",
                "index from 0",
            ),
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
            "dependencyFlags": Key(
                "Dependency flags",
                "BY_REGION limits the dependency to the same pixels, so that a tile-based GPU need "
                "not flush its tiles.",
            ),
            "viewOffset": Key(
                "View offset",
                "With VIEW_LOCAL, the difference of the views that depend on each other.",
                "views",
            ),
        },
    ),
    "RenderPass": Structure(
        "Render pass",
        "VkRenderPassCreateInfo2",
        "renderpass-creation",
        {
            "flags": Key("Creation flags", "Additional properties of the render pass."),
            "attachments": Key(
                "Attachments",
                "The attachments, as a list, or by name in the order of their indices.",
            ),
            "subpasses": Key("Subpasses", "The subpasses, in order."),
            "dependencies": Key(
                "Dependencies",
                "The execution and memory dependencies between subpasses, and with what is outside "
                "the render pass.",
            ),
            "fragmentDensityMapAttachment": Key(
                "Fragment density map",
                "The attachment that says for each block of pixels how densely it is shaded, such "
                "as for a foveated eye buffer. "
                "The pass reads it, and no subpass names it.",
                "index from 0",
                "none",
                "VkRenderPassFragmentDensityMapCreateInfoEXT::fragmentDensityMapAttachment",
            ),
            "pNext": UNREAD,
        },
    ),
    "Framebuffer": Structure(
        "Framebuffer",
        "VkFramebufferCreateInfo",
        "renderpass-creation",
        {
            "renderPass": Key(
                "Render pass", "The name in `renderPasses` of the render pass that it is used with."
            ),
            "attachments": Key(
                "Images",
                "The names of the images bound to the attachments, in the order of their indices; "
                "null for an imageless one.",
            ),
            "width": Key("Width", "The width of the framebuffer.", "pixels"),
            "height": Key("Height", "The height of the framebuffer.", "pixels"),
            "layers": Key("Layers", "The layers of the framebuffer; 1 with multiview.", "layers"),
            "flags": Key(
                "Creation flags", "IMAGELESS if the images are bound when a render pass begins."
            ),
        },
    ),
}
