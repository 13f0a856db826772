"""Families of the Khronos validation layer's messages about multisampling, and the rules that
correspond to each.

A family outlives the ids of its messages: from one version of the layer to the next VUIDs are
renumbered, and best practices lose prefixes and gain vendors. `messages.classify` finds the family
of a message.
"""

from __future__ import annotations

from typing import NamedTuple

Version = tuple[int, int, int]

RENDER_PASS, RENDER_PASS_2, RENDERING = "renderPass", "renderPass2", "rendering"
"""How a pass is created: vkCreateRenderPass, vkCreateRenderPass2 or vkCmdBeginRendering."""

LEGACY = (RENDER_PASS, RENDER_PASS_2)
MOBILE = ("arm", "img")


class CheckScope(NamedTuple):
    """What a check of the layer covers; outside it the layer's silence means nothing. Empty members
    impose no limit.

    `passes` are kinds of passes. `vendors` are those with the check, one of which must be enabled.
    `since` is the first version of the layer with the check. `lazy` checks need a device with
    lazily allocated memory. `device` checks are made against the device that runs, whatever device
    the description is for. `when` are conditions on the facts of a finding's subject: the kind of
    subject, the condition, and the reason in words if it does not hold. `instead` says what the
    layer checks if that differs from what the rules check.
    """

    passes: tuple[str, ...] = ()
    vendors: tuple[str, ...] = ()
    since: Version | None = None
    lazy: bool = False
    device: bool = False
    when: tuple[tuple[str, str, str], ...] = ()
    instead: str = ""


class Family(NamedTuple):
    """Messages with the same meaning.

    `ids` are the numbers of VUIDs (`03067`) and the parts that the names of best practices share
    across versions and vendors (`non-transient-ms-image`). A VUID with an unknown number belongs to
    the family if the structure or command in its id matches `structure_pattern` and its text
    matches `text_pattern`. `of_attachment` says that its texts name an attachment by its index.
    """

    name: str
    rules: tuple[str, ...]
    ids: tuple[str, ...]
    description: str
    structure_pattern: str = ""
    text_pattern: str = ""
    scope: CheckScope = CheckScope()
    of_attachment: bool = False


def _ids(text: str) -> tuple[str, ...]:
    return tuple(text.split())


_SUBPASS = r"VkSubpassDescription2?"
_RENDERING = r"VkRendering(Attachment)?Info"
_RESOLVE = r"(vkCmdResolveImage|VkResolveImageInfo)\w*"
_DEPTH_RESOLVE = r"VkSubpassDescriptionDepthStencilResolve\w*"
_IMAGE = r"VkImageCreateInfo"
_ATTACHMENT = r"VkAttachmentDescription2?"

_DRAWN_LOAD = 'aspect.load == "LOAD" && attachment.drawn'
_ATTACHABLE = '"COLOR_ATTACHMENT" in image.usage || "DEPTH_STENCIL_ATTACHMENT" in image.usage'
_AMD = '"STORAGE" in image.usage || "MUTABLE_FORMAT" in image.flags'

FAMILIES = (
    Family(
        "sample-count-unsupported",
        ("sample-count-unsupported",),
        _ids("02258 08745"),
        "the device does not support an image's sample count for its format",
        _IMAGE,
        r"samples.*(not supported|imageCreateSampleCounts)",
        scope=CheckScope(device=True),
    ),
    Family(
        "mixed-sample-counts",
        ("mixed-sample-counts",),
        _ids(
            "01418 09430 09431 09456 06868 06869 06870 06872 01417 03071 01506 03070 06857 06858 "
            "09429"
        ),
        "attachments of one subpass or rendering differ in their sample counts",
        rf"{_SUBPASS}|VkRenderingInfo",
        r"[Ss]ubpass.*(sample|color).*(differ|inconsistent|match|same)|sample "
        r"count.*(differ|inconsistent|match|same)"
        r"|MultisampledRenderToSingleSampled.*not VK_SAMPLE_COUNT_1",
        scope=CheckScope(
            when=(
                (
                    "subpass",
                    "!subpass.mixed_depth_stencil_samples",
                    "it checks depth and stencil against color, not against each other",
                ),
            )
        ),
    ),
    Family(
        "rasterization-samples",
        ("rasterization-samples-mismatch",),
        _ids(
            "06853 06854 00757 01505 01411 01412 04740 07284 07285 07286 07287 08644 07935 09211 "
            "06185 06186 06187 07474 06856"
        ),
        "a pipeline's rasterizationSamples is not the sample count of what it draws to",
        r"VkGraphicsPipelineCreateInfo|vkCmdDraw\w*",
        r"(rasterizationSamples|PipelineMultisampleState|VkPipeline|sample "
        r"count).*(match|equal|!=|same)",
        scope=CheckScope(
            when=(
                (
                    "pipeline",
                    "!pipeline.samples_dynamic",
                    "it checks the count in the pipeline, not one set by a command",
                ),
            )
        ),
    ),
    Family(
        "multisampled-image",
        ("multisampled-image-invalid",),
        _ids("02257 06411 02558 02083 10253 06883 00973 00974 00975 00976 04460"),
        "a multisampled image has mip levels, is not 2D, is cube compatible, has linear tiling, or "
        "else requires one sample",
        _IMAGE,
        r"([Mm]ulti-?sampl|samples).*(mips|mipLevels|VK_IMAGE_TYPE_2D|CUBE_COMPATIBLE)",
        scope=CheckScope(
            instead="what an image is created with: confirm creates no swapchain, and no sparse "
            "image"
        ),
    ),
    Family(
        "single-sampled-render",
        ("single-sampled-render-invalid",),
        _ids("06859 06871 06878 06880 06881 06882 07009 07010"),
        "multisampled rendering to a single-sampled attachment lacks the feature, or the "
        "attachment the creation flag",
        r"VkRenderingInfo|VkFramebufferCreateInfo|VkImageCreateInfo",
        r"MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_BIT_EXT",
        scope=CheckScope(device=True),
    ),
    Family(
        "transient-usage",
        ("transient-usage-conflict",),
        _ids("00963 00966 01925 02539 02797 02798"),
        "TRANSIENT_ATTACHMENT is combined with a usage other than attachments, or with none",
        _IMAGE,
        r"TRANSIENT_ATTACHMENT|Transient attachment",
    ),
    Family(
        "lazy-memory",
        ("lazily-allocated-without-transient",),
        _ids("01047 01615"),
        "an image that is not a transient attachment is bound to a memory type that its "
        "requirements exclude",
        r"vkBindImageMemory|VkBindImageMemoryInfo",
        r"memoryTypeBits|[mM]emory[ _]type",
        scope=CheckScope(lazy=True),
    ),
    Family(
        "load-from-undefined",
        ("load-from-undefined",),
        (
            *_ids("06699 06700 06704 06705 vkCreateRenderPass-attatchment"),
            *_ids(
                "vkCreateRenderPass-attachment-color-depth vkCreateRenderPass-attachment-stencil"
            ),
        ),
        "an attachment is loaded from the layout UNDEFINED",
        _ATTACHMENT,
        r"LOAD_OP_LOAD.*UNDEFINED|UNDEFINED.*LOAD_OP_LOAD",
        of_attachment=True,
    ),
    Family(
        "resolve-without-ends",
        ("resolve-target-missing",),
        _ids("00847 03065 09335 03177 06862"),
        "a resolve has a target without a source, or a mode without a target",
        rf"{_SUBPASS}|{_DEPTH_RESOLVE}|{_RENDERING}",
        r"resolve (from|attachment).*VK_ATTACHMENT_UNUSED|resolveImageView must not be "
        r"VK_NULL_HANDLE",
    ),
    Family(
        "resolve-source-samples",
        ("resolve-source-single-sampled",),
        _ids("00848 03066 09338 03179 06861 00257"),
        "the source of a resolve has one sample",
        rf"{_SUBPASS}|{_DEPTH_RESOLVE}|{_RENDERING}|{_RESOLVE}",
        r"resolve from.*SAMPLE_COUNT_1|srcImage sample count is "
        r"VK_SAMPLE_COUNT_1|DepthStencilAttachment has sample count"
        r"|(imageView|Image sample count).* must not have a VK_SAMPLE_COUNT_1",
    ),
    Family(
        "resolve-target-samples",
        ("resolve-target-multisampled",),
        _ids("00849 03067 03180 06864 00259"),
        "the target of a resolve has more than one sample",
        rf"{_SUBPASS}|{_DEPTH_RESOLVE}|{_RENDERING}|{_RESOLVE}",
        r"resolve into.*must have VK_SAMPLE_COUNT_1|dstImage sample count.*is not"
        r"|resolve attachment \d+ which has sample count|resolveImageView sample count must",
    ),
    Family(
        "resolve-formats",
        ("resolve-format-mismatch",),
        _ids("00850 03068 09339 03181 03182 06865 01386"),
        "the source and the target of a resolve differ in format",
        rf"{_SUBPASS}|{_DEPTH_RESOLVE}|{_RENDERING}|{_RESOLVE}",
        r"different format|must have the same (VkFormat|number of bits)|[Ff]ormat.*(differ|not "
        r"equal|identical|match)",
    ),
    Family(
        "depth-resolve-modes-none",
        ("depth-resolve-mode-none",),
        _ids("03178 06873"),
        "there is a depth-stencil resolve attachment, but both modes are NONE",
        _DEPTH_RESOLVE,
        r"resolve modes? (is|are) VK_RESOLVE_MODE_NONE",
    ),
    Family(
        "depth-resolve-modes",
        ("depth-resolve-mode-unsupported", "depth-averaged", "stencil-resolve-average"),
        _ids(
            "03183 03184 03185 03186 06102 06103 06104 06105 06874 06875 06876 06877 10989 10990 "
            "10991 10992"
        ),
        "depth or stencil is resolved with a mode, or a pair of modes, that the device does not "
        "support",
        rf"{_DEPTH_RESOLVE}|VkRenderingInfo|VkResolveImageInfo2",
        r"supported(Depth|Stencil)ResolveModes|invalid "
        r"(depth|stencil)ResolveMode|independentResolve"
        r"|stencilResolveMode \(\w+\) must be identical|resolveMode structure with invalid mode",
        scope=CheckScope(device=True),
    ),
    Family(
        "depth-resolve-structure",
        ("depth-resolve-unavailable",),
        ("VkSubpassDescription2-pNext-pNext",),
        "a depth-stencil resolve is chained to a subpass without Vulkan 1.2 or "
        "VK_KHR_depth_stencil_resolve",
        scope=CheckScope(device=True),
    ),
    Family(
        "color-resolve-mode",
        ("color-resolve-mode-invalid",),
        _ids("06130 06129 10983 10984 10985"),
        "integers are resolved with a mode other than SAMPLE_ZERO, or other colors with a mode "
        "other than AVERAGE",
        rf"{_RENDERING}|{_RESOLVE}",
        r"[rR]esolve ?[mM]ode.*for (non-)?integer formats",
        scope=CheckScope(
            instead="the modes of renderings; those of commands with VK_KHR_maintenance10, which "
            "confirm does not enable"
        ),
    ),
    Family(
        "depth-resolve-command",
        ("depth-resolved-by-command",),
        _ids("00266 02003 10981 10986 10987 10988 10994"),
        "a command resolves depth or stencil without maintenance10, or without a mode",
        rf"VkImageResolve2?|{_RESOLVE}",
        r"aspectMask.*(COLOR|maintenance10)|VkResolveImageModeInfoKHR",
        scope=CheckScope(
            instead="resolves without VK_KHR_maintenance10, which confirm does not enable"
        ),
    ),
    Family(
        "image-usage",
        ("image-usage-missing",),
        _ids("00877 02633 02634 00879 06087 09476 06088 09477 06089 09478 06762 06764"),
        "an attachment, or an image of a resolve command, lacks the usage that this requires",
        rf"VkFramebufferCreateInfo|VkRenderingInfo|{_RESOLVE}",
        r"VK_IMAGE_USAGE_\w+",
        scope=CheckScope(
            instead="framebuffers, renderings, and commands; resolve targets of renderings since "
            "1.3.278"
        ),
    ),
    Family(
        "layout-usage",
        ("image-usage-missing",),
        _ids("01208 01209 01210 01211 01212 01213 00895 01758 02842 02844 03094 03096"),
        "an image is in a layout whose usage it lacks",
        scope=CheckScope(instead="the layouts of barriers, some of which are those of confirm"),
    ),
    Family(
        "resolve-target-uses",
        ("resolve-target-used-twice",),
        _ids("09045 00854 03074"),
        "an attachment has another use in the subpass that resolves to it",
        rf"{_SUBPASS}|vkCmdBeginRenderPass2?",
        r"uses attachment \d+ as both",
        scope=CheckScope(instead="preserved attachments, not what a resolve writes"),
    ),
    Family(
        "framebuffer-size",
        ("resolve-target-too-small",),
        _ids("04533 04534 04541 04542 02852 02853"),
        "a framebuffer is larger than an image in it, or a render area than its framebuffer",
        r"VkFramebufferCreateInfo|VkRenderPassBeginInfo",
        r"(width|height).*(smaller|less|greater)",
        scope=CheckScope(
            instead="the framebuffers and render areas of confirm, which are as small as their "
            "images"
        ),
    ),
    Family(
        "copy-samples",
        ("copy-sample-count-invalid",),
        _ids("00136 00233 00234 07973 00188 00179"),
        "a copy is between different sample counts, or a blit or a copy of a buffer has a "
        "multisampled image",
        r"(vkCmd|Vk)(Copy|Blit)\w*",
        r"SAMPLE_COUNT",
        scope=CheckScope(
            instead="copies and blits between images: confirm records none from or to buffers"
        ),
    ),
    Family(
        "sample-shading-feature",
        ("sample-shading-feature-missing",),
        ("00784",),
        "sample shading is enabled without the feature sampleRateShading",
        r"VkPipelineMultisampleStateCreateInfo|VkShaderModuleCreateInfo",
        r"sampleRateShading|SampleRateShading|InterpolationFunction",
        scope=CheckScope(device=True),
    ),
    Family(
        "alpha-to-one-feature",
        ("alpha-to-one-feature-missing",),
        ("00785",),
        "alphaToOneEnable is set without the feature alphaToOne",
        r"VkPipelineMultisampleStateCreateInfo",
        r"alphaToOne",
        scope=CheckScope(device=True),
    ),
    Family(
        "storage-image-multisample-feature",
        ("storage-image-multisample-feature-missing",),
        _ids("00968 02538"),
        "a multisampled image has the usage STORAGE without the feature "
        "shaderStorageImageMultisample",
        _IMAGE,
        r"shaderStorageImageMultisample",
        scope=CheckScope(device=True),
    ),
    Family(
        "min-sample-shading",
        ("min-sample-shading-out-of-range",),
        ("00786",),
        "minSampleShading is not from 0 to 1",
        r"VkPipelineMultisampleStateCreateInfo",
        r"minSampleShading",
        scope=CheckScope(
            when=(
                (
                    "pipeline",
                    "pipeline.sample_shading",
                    "it checks minSampleShading only with sample shading enabled",
                ),
            )
        ),
    ),
    Family(
        "alpha-to-coverage-output",
        ("alpha-to-coverage-without-alpha",),
        ("08891",),
        "alpha to coverage is enabled, but the shader writes no alpha to location 0",
        r"VkGraphicsPipelineCreateInfo",
        r"alphaToCoverageEnable.*(alpha|component)",
        scope=CheckScope(instead="the shader of the draw, which is the built-in one of confirm"),
    ),
    Family(
        "non-transient-ms-image",
        ("multisampled-image-not-transient",),
        ("non-transient-ms-image",),
        "a multisampled image is not TRANSIENT_ATTACHMENT",
        scope=CheckScope(vendors=MOBILE),
    ),
    Family(
        "should-be-transient",
        ("multisampled-image-not-transient",),
        ("attachment-should-be-transient",),
        "an attachment that a framebuffer neither loads nor stores is not TRANSIENT_ATTACHMENT",
        scope=CheckScope(passes=LEGACY, lazy=True),
        of_attachment=True,
    ),
    Family(
        "should-not-be-transient",
        ("transient-needs-memory",),
        ("attachment-should-not-be-transient",),
        "a transient attachment of a framebuffer is loaded or stored",
        scope=CheckScope(passes=LEGACY),
        of_attachment=True,
    ),
    Family(
        "non-lazy-transient-image",
        ("transient-not-lazily-allocated",),
        ("non-lazy-transient-image",),
        "a transient attachment is not in lazily allocated memory although the device offers it",
        scope=CheckScope(lazy=True),
    ),
    Family(
        "too-large-sample-count",
        ("sample-count-above-four",),
        ("too-large-sample-count",),
        "an image has more than four samples",
        scope=CheckScope(vendors=MOBILE),
    ),
    Family(
        "image-requires-memory",
        (
            "multisampled-attachment-stored",
            "multisampled-attachment-loaded",
            "multisampled-depth-stored",
            "multisampled-stencil-stored",
        ),
        ("image-requires-memory",),
        "a multisampled attachment is loaded or stored",
        scope=CheckScope(passes=(RENDER_PASS,)),
        of_attachment=True,
    ),
    Family(
        "attachment-needs-readback",
        (
            "multisampled-attachment-loaded",
            "framebuffer-readback",
            "resolve-target-loaded",
            "multisampled-stencil-stored",
            "copied-then-loaded",
            "clear-command-instead-of-load-op",
        ),
        ("attachment-needs-readback",),
        "an attachment is loaded",
        scope=CheckScope(
            passes=LEGACY,
            vendors=MOBILE,
            when=(
                (
                    "aspect",
                    _DRAWN_LOAD,
                    "it checks loads of what is drawn to, not clears and stores",
                ),
            ),
        ),
        of_attachment=True,
    ),
    Family(
        "discarded-then-loaded",
        (
            "discarded-then-loaded",
            "multisampled-result-lost",
            "resolve-target-not-stored",
            "multisampled-attachment-loaded",
            "multisampled-stencil-stored",
        ),
        ("StoreOpDontCareThenLoadOpLoad",),
        "a pass loads what the previous pass discarded",
        scope=CheckScope(passes=LEGACY, instead="what a later pass loads"),
    ),
    Family(
        "redundant-store",
        (
            "multisampled-attachment-stored",
            "multisampled-depth-stored",
            "multisampled-stencil-stored",
            "stored-then-discarded",
        ),
        ("RenderPass-redundant-store",),
        "a pass clears what the previous pass stored",
        scope=CheckScope(passes=LEGACY, vendors=MOBILE, instead="what a later pass clears"),
    ),
    Family(
        "transfer-then-loaded",
        (
            "copied-then-loaded",
            "clear-command-instead-of-load-op",
            "multisampled-attachment-loaded",
            "framebuffer-readback",
        ),
        (
            "RenderPass-inefficient-clear",
            "blitimage-loadopload",
            "copyimage-loadopload",
            "resolveimage-loadopload",
        ),
        "a pass loads what a clear, copy, blit or resolve command wrote",
        scope=CheckScope(passes=LEGACY, vendors=MOBILE, instead="what transfer commands wrote"),
    ),
    Family(
        "clear-values",
        ("clear-value-without-clear",),
        ("ClearValueWithoutLoadOpClear",),
        "a pass begins with clear values but clears no attachment",
        scope=CheckScope(
            passes=LEGACY, instead="the clear values that confirm passes, one per attachment"
        ),
    ),
    Family(
        "clear-before-draw",
        ("clear-command-instead-of-load-op",),
        ("ClearCmdBeforeDraw", "RenderPass-redundant-clear", "clear-after-load"),
        "a command clears what the pass could have cleared at its start",
        scope=CheckScope(passes=LEGACY),
    ),
    Family(
        "resolve-mode-none",
        ("resolve-mode-none",),
        ("ResolveModeNone",),
        "a rendering has a resolve image, but its resolve mode is NONE",
        scope=CheckScope(
            passes=(RENDERING,),
            since=(1, 3, 278),
            when=(("resolve", 'resolve.aspect == "color"', "it checks color only"),),
        ),
    ),
    Family(
        "resolving-image",
        ("resolve-outside-pass",),
        ("resolving-image",),
        "an image is resolved by vkCmdResolveImage",
        scope=CheckScope(
            vendors=("arm",),
            when=(
                (
                    "resolve",
                    'resolve.aspect == "color"',
                    "it checks color: confirm does not enable VK_KHR_maintenance10",
                ),
            ),
        ),
    ),
    Family(
        "multisampled-blending",
        ("multisampled-float-blending",),
        ("multisampled-blending",),
        "a multisampled pipeline blends into a float format",
        scope=CheckScope(passes=LEGACY, vendors=("arm",)),
    ),
    Family(
        "amd-render-targets",
        ("attachment-blocks-compression",),
        (
            "vkImage-AvoidConcurrentRenderTargets",
            "vkImage-DontUseMutableRenderTargets",
            "vkImage-DontUseStorageRenderTargets",
        ),
        "a render target has STORAGE usage, MUTABLE_FORMAT or CONCURRENT sharing",
        scope=CheckScope(
            vendors=("amd",),
            when=(
                (
                    "image",
                    _AMD,
                    "it checks usage and flags; sharing only with several queue families",
                ),
                ("image", _ATTACHABLE, "it checks images with the usage of an attachment"),
            ),
        ),
    ),
    Family(
        "nvidia-linear-tiling",
        ("attachment-blocks-compression",),
        ("CreateImage-TilingLinear",),
        "an image has linear tiling",
        scope=CheckScope(
            vendors=("nvidia",),
            when=(("image", 'image.tiling == "LINEAR"', "it checks tiling only"),),
        ),
    ),
)
"""In the order of the documentation: what Vulkan forbids, then what best practices recommend."""
