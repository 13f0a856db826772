"""The facts of images, attachments and their aspects."""

from __future__ import annotations

from .words import Fact

IMAGE = (
    Fact("image.name", "STRING", "name of the image, or of the attachment that it stands for"),
    Fact(
        "image.stated",
        "BOOL",
        "it is declared in `images`; false if it stands for an attachment that names no image",
    ),
    Fact("image.format", "STRING", "format", "VkFormat"),
    Fact("image.samples", "INT", "samples per texel"),
    Fact("image.is_color", "BOOL", "its format has a color aspect"),
    Fact("image.numeric", "STRING", "numeric type of its color", "numeric"),
    Fact("image.is_half_float", "BOOL", "every component is a 16-bit float"),
    Fact("image.type", "STRING", "dimensions", "VkImageType"),
    Fact("image.tiling", "STRING", "tiling", "VkImageTiling"),
    Fact("image.mip_levels", "INT", "number of mip levels"),
    Fact("image.flags", "LIST", "creation flags", "VkImageCreateFlagBits"),
    Fact(
        "image.single_sampled_flag",
        "BOOL",
        "it is created with MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT; unknown where a swapchain "
        "or source code does not state its flags",
    ),
    Fact("image.sharing_mode", "STRING", "sharing mode", "VkSharingMode"),
    Fact("image.usage", "LIST", "usage", "VkImageUsageFlagBits"),
    Fact(
        "image.memory",
        "LIST",
        "property flags of the memory that it is bound to",
        "VkMemoryPropertyFlagBits",
    ),
    Fact("image.transient", "BOOL", "its usage includes TRANSIENT_ATTACHMENT"),
    Fact("image.lazily_allocated", "BOOL", "its memory is LAZILY_ALLOCATED"),
    Fact(
        "image.multisampling_conflicts",
        "LIST",
        "stated properties that Vulkan forbids for more than one sample; unknown for an attachment "
        "without an image",
    ),
    Fact(
        "image.compression_blockers",
        "LIST",
        "stated properties that disable compression on GPUs of the device's vendor, or on those of "
        "AMD, Arm or NVIDIA for other vendors",
    ),
    Fact(
        "image.attachment_usage",
        "BOOL",
        "its usage includes COLOR_ATTACHMENT, DEPTH_STENCIL_ATTACHMENT or INPUT_ATTACHMENT",
    ),
    Fact(
        "image.transient_conflicts",
        "LIST",
        "usages that Vulkan forbids together with TRANSIENT_ATTACHMENT",
        "VkImageUsageFlagBits",
    ),
    Fact(
        "image.missing_usages",
        "LIST",
        "of a multisampled image, or one that a resolve reads or writes: usages that passes and "
        "commands require and that it lacks; empty "
        "where nothing is known to lack",
        "VkImageUsageFlagBits",
    ),
    Fact("image.usage_needed_by", "STRING", "pass or command that needs the first of them"),
    Fact("image.presentable", "BOOL", "it belongs to a swapchain"),
    Fact(
        "image.presented",
        "BOOL",
        "it is stated to belong to a swapchain, or a command presents it; never unknown",
    ),
    Fact("image.is_data", "BOOL", "its values are stated to be data, not color; never unknown"),
    Fact("image.encoding", "STRING", "what its values mean", "encoding"),
    Fact(
        "image.is_render_target", "BOOL", "a pass draws or resolves to it, or its usage allows that"
    ),
    Fact(
        "image.resolved",
        "BOOL",
        "a resolve, in a pass or as a command, reads or writes it; never unknown",
    ),
    Fact(
        "image.read",
        "BOOL",
        "something outside of the passes that draw it reads it; see image.read_on_tile for input "
        "attachments",
    ),
    Fact(
        "image.read_on_tile",
        "BOOL",
        "a pass reads it as input attachment; absent for an attachment without an image",
    ),
    Fact(
        "image.read_in_vain",
        "BOOL",
        "only resolve commands read it, each after a pass that already resolved or discarded its "
        "samples; never unknown",
    ),
    Fact("image.loaded", "BOOL", "a pass loads an aspect of it"),
    Fact(
        "image.supported",
        "BOOL",
        "the device supports its sample count for its aspects, as every device does one sample; "
        "unknown if no pass can draw to it",
    ),
    Fact(
        "image.supported_samples", "INTS", "sample counts that the device supports for its aspects"
    ),
    Fact(
        "image.averaged_by_reader",
        "BOOL",
        "a shader that reads it averages its samples, as stated or as the shader's module shows",
    ),
    Fact(
        "image.taking_turns",
        "LIST",
        "identical multisampled images, this one first, as many as presentable images, of which "
        "each frame uses one; empty elsewhere",
    ),
    Fact("image.turns_stated", "BOOL", "alternating framebuffers state that rotation"),
    Fact(
        "image.share_of_devices",
        "INT",
        "percentage of 2,035 reported devices that support its sample count",
    ),
    Fact("image.share_of_tilers", "INT", "percentage of the tile-based ones among them that do"),
    Fact(
        "image.study",
        "STRING",
        "what the record of `msaa-lint study` beside the description means for a sample count "
        "above the device's max_efficient_samples; "
        "NONE elsewhere; never unknown",
        "study",
    ),
    Fact(
        "image.study_says",
        "STRING",
        "what that record found, or why it does not apply; never unknown",
    ),
    Fact("image.storage_mode", "STRING", "Metal: storage mode", "storage mode"),
    Fact("image.texture_type", "STRING", "Metal: texture type", "texture type"),
    Fact(
        "image.type_fits",
        "BOOL",
        "Metal: its texture type is a multisample type exactly if it has more than one sample",
    ),
    Fact("image.usage_words", "LIST", "Metal: usage in Metal's terms", "texture usage"),
    Fact(
        "image.memoryless_offered",
        "BOOL",
        "Metal: the GPU supports memoryless textures: family apple2 or later, or lazy memory",
    ),
    Fact(
        "image.memoryless_conflicts",
        "LIST",
        "Metal: usages other than renderTarget, which memoryless textures forbid",
        "texture usage",
    ),
)

ATTACHMENT = (
    Fact("attachment.name", "STRING", "name, or index"),
    Fact("attachment.format", "STRING", "format", "VkFormat"),
    Fact("attachment.samples", "INT", "samples per texel"),
    Fact(
        "attachment.used",
        "BOOL",
        "a subpass references it as color, depth-stencil, resolve, input or shading rate "
        "attachment, or it is the density map",
    ),
    Fact(
        "attachment.drawn",
        "BOOL",
        "a subpass draws to it: it is a color or depth-stencil attachment",
    ),
    Fact("attachment.is_resolve_target", "BOOL", "a resolve writes it"),
    Fact("attachment.read_as_input", "BOOL", "a subpass reads it as input attachment"),
    Fact(
        "attachment.single_sampled_render",
        "BOOL",
        "a subpass that has it as color, depth-stencil or input attachment enables "
        "multisampledRenderToSingleSampled",
    ),
    Fact("attachment.render_samples", "INT", "rasterizationSamples of that subpass"),
    Fact(
        "attachment.render_samples_supported",
        "BOOL",
        "the device supports that sample count for its format; absent without such a subpass",
    ),
    Fact(
        "attachment.depth_resolve_missing",
        "BOOL",
        "a subpass of a render pass that has it as depth-stencil attachment states "
        "multisampledRenderToSingleSampled, but no "
        "depthStencilResolve; never unknown",
    ),
    Fact(
        "attachment.lost",
        "BOOL",
        "its contents become undefined in a subpass that neither uses nor preserves it, between "
        "two that depend on each other through it; "
        "never unknown",
    ),
    Fact("attachment.lost_in_subpass", "INT", "that subpass"),
    Fact("attachment.lost_for_subpass", "INT", "the next subpass that draws to it or reads it"),
    Fact("attachment.lost_for_input", "BOOL", "that one reads it as input attachment"),
    Fact("attachment.initial_layout", "STRING", "layout at the start of the pass", "VkImageLayout"),
    Fact("attachment.final_layout", "STRING", "layout at the end of the pass", "VkImageLayout"),
)

ASPECT = (
    Fact("aspect.name", "STRING", "which aspect", "aspect"),
    Fact(
        "aspect.load",
        "STRING",
        "load operation: stencilLoadOp for stencil, else loadOp; RESUMED in a resumed rendering, "
        "which performs none",
        "load operation",
    ),
    Fact(
        "aspect.store",
        "STRING",
        "store operation: stencilStoreOp for stencil, else storeOp; SUSPENDED in a suspended "
        "rendering, which performs none",
        "store operation",
    ),
    Fact(
        "aspect.memory_operations",
        "LIST",
        "those of its operations that access memory: LOAD, STORE; never unknown",
    ),
    Fact("aspect.initial_layout", "STRING", "layout at the start of the pass", "VkImageLayout"),
    Fact("aspect.resolved", "BOOL", "a resolve in the pass reads it, with a mode other than NONE"),
    Fact("aspect.resolved_over", "BOOL", "a resolve in the pass overwrites it"),
    Fact(
        "aspect.read_before_resolve",
        "BOOL",
        "a subpass reads it as input attachment, or tests against it, before that resolve; never "
        "unknown",
    ),
    Fact(
        "aspect.read_after_resolve",
        "BOOL",
        "a subpass reads it as input attachment, or tests against it, after that resolve; never "
        "unknown",
    ),
    Fact(
        "aspect.read_later",
        "BOOL",
        "something after the pass, or the pass itself in the next frame, reads what it stores",
    ),
    Fact(
        "aspect.readers_known",
        "BOOL",
        "the description says whether anything reads it later; never unknown",
    ),
    Fact(
        "aspect.fetched",
        "STRING",
        "stored multisampled depth that only shaders read: ALL if one fetches every sample, ONE if "
        "each fetches one, NOT_STATED if one "
        "does not say; OTHER if something else reads it, or nothing, and for what is not stored "
        "multisampled depth",
        "fetched",
    ),
    Fact("aspect.stored_by", "STRING", "pass that stored what it loads"),
    Fact(
        "aspect.costly_operations",
        "LIST",
        "LOAD, and STORE if nothing reads it later; never unknown",
    ),
    Fact(
        "aspect.store_wasted",
        "BOOL",
        "whenever the pass runs, what it stores is overwritten, or the frame starts again, before "
        "anything reads it",
    ),
    Fact(
        "aspect.waste_certain",
        "BOOL",
        "the usage, or the commands in between, allow no reader; otherwise only the frame's "
        "commands show it",
    ),
    Fact(
        "aspect.overwritten_by",
        "STRING",
        "pass or command that overwrites what it stores before anything reads it",
    ),
    Fact(
        "aspect.reads_undefined",
        "BOOL",
        "it loads contents that the last writer discarded, or a command reads what it discards",
    ),
    Fact("aspect.loads_discarded", "BOOL", "it loads contents that the last writer discarded"),
    Fact("aspect.discarded_by", "STRING", "pass or barrier that discarded what it loads"),
    Fact("aspect.discard_reader", "STRING", "command that reads what it discards"),
    Fact(
        "aspect.undefined_within_frame", "BOOL", "the discarded contents are read in the same frame"
    ),
    Fact(
        "aspect.copied_before",
        "BOOL",
        "it loads what a copy, blit or resolve command has just written; never unknown",
    ),
    Fact("aspect.copy_command", "STRING", "that command"),
    Fact("aspect.copy_source", "STRING", "image that it copies from; unknown for a buffer"),
    Fact(
        "aspect.cleared_by_command",
        "BOOL",
        "whenever the pass runs, a command clears all of it just before the pass, or in the pass "
        "before the first draw; never unknown",
    ),
    Fact("aspect.clear_command", "STRING", "that command"),
    Fact("aspect.clears_in_pass", "BOOL", "that command is recorded in the pass; never unknown"),
    Fact(
        "aspect.undefined_used",
        "BOOL",
        "load operation NONE or DONT_CARE: a draw tests depth against it, or blends with it, or a "
        "shader reads it as input attachment, "
        "before the pass writes it; false if that is not known",
    ),
    Fact("aspect.undefined_user", "STRING", "the pipeline of that draw, or readImage"),
    Fact(
        "aspect.untouched",
        "BOOL",
        "no subpass references the attachment, or no recorded draw or clear touches the aspect; "
        "false if that is not known; never unknown",
    ),
    Fact(
        "aspect.load_action",
        "STRING",
        "Metal: load action; absent for a resolve texture",
        "load action",
    ),
    Fact(
        "aspect.store_action",
        "STRING",
        "Metal: store action; absent for a resolve texture",
        "store action",
    ),
    Fact("aspect.has_resolve_texture", "BOOL", "Metal: it has a resolve texture"),
    Fact("aspect.resolve_texture", "STRING", "Metal: name of that texture"),
    Fact("aspect.resolves_by_action", "BOOL", "Metal: its store action resolves"),
    Fact(
        "aspect.resolve_filter",
        "STRING",
        "Metal: filter of the depth or stencil resolve",
        "resolve filter",
    ),
)
