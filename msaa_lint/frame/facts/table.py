"""Every fact that a rule may ask, with its type and what it means. `docs/facts.md` and `msaa-lint facts` are made from this.

A fact that the input does not state is absent; a rule whose condition hangs on an absent fact stays undecided.
"""

from __future__ import annotations

from typing import NamedTuple


class Fact(NamedTuple):
    """`type` is BOOL, INT, DOUBLE, STRING, LIST (of text) or INTS; `enum` the Vulkan enum (or our words) that its texts come from."""

    name: str
    type: str
    doc: str
    enum: str = ""


WORDS: dict[str, tuple[str, ...]] = {
    "aspect": ("color", "depth", "stencil"),
    "pass kind": ("renderPass", "rendering"),
    "resolve kind": ("subpass", "rendering", "command"),
    "encoding": ("LINEAR", "GAMMA", "DATA"),
    "scene color": ("LDR", "HDR"),
    "tone mapping": ("AFTER_RESOLVE", "IN_PASS", "NONE"),
    "depth direction": ("STANDARD", "REVERSED"),
    "wants": ("ANY", "NEAREST", "FARTHEST"),
    "fetched": ("ONE", "ALL", "NOT_STATED", "OTHER"),
    "samples read": ("ONE", "ALL", "OTHER"),
    "resolves": ("AVERAGE", "MIN", "MAX", "OTHER"),
    "api": ("VULKAN", "METAL"),
    "storage mode": ("shared", "managed", "private", "memoryless"),
    "texture type": (
        "type1D", "type1DArray", "type2D", "type2DArray", "type2DMultisample", "typeCube", "typeCubeArray", "type3D",
        "type2DMultisampleArray", "typeTextureBuffer",
    ),
    "texture usage": ("shaderRead", "shaderWrite", "renderTarget", "pixelFormatView", "shaderAtomic"),
    "load action": ("dontCare", "load", "clear"),
    "store action": ("dontCare", "store", "multisampleResolve", "storeAndMultisampleResolve", "unknown", "customSampleDepthStore"),
    "resolve filter": ("sample0", "min", "max", "depthResolvedSample"),
    "family": (
        *(f"apple{number}" for number in range(1, 11)), "mac1", "mac2", "macCatalyst1", "macCatalyst2", "common1", "common2", "common3",
        "metal3", "metal4",
    ),
    "fits": ("SAME", "DIFFERENT", "NOT_STATED"),
    "combined": ("AND", "OR", "MIN", "MAX", "LOGICAL_AND", "LOGICAL_OR", "NONE"),
    "chosen": ("MAXIMUM", "ATMOST"),
    "study": ("NONE", "JUSTIFIES", "DECLINES", "STALE", "UNUSABLE"),
    "numeric": ("UNORM", "SNORM", "USCALED", "SSCALED", "UINT", "SINT", "UFLOAT", "SFLOAT", "SRGB", "SFIXED5", "BOOL"),
    "vendor": (
        "arm", "img", "amd", "nvidia", "qualcomm", "apple", "intel", "broadcom", "samsung", "mesa", "khronos", "huawei",
    ),
}  # fmt: skip
"""The words of facts whose texts are ours, not a Vulkan enum's."""

_FRAME = (
    Fact("frame.width", "INT", "width of the frame in pixels"),
    Fact("frame.height", "INT", "height of the frame in pixels"),
    Fact("frame.fps", "DOUBLE", "frames a second"),
    Fact("frame.has_commands", "BOOL", "the description records commands"),
    Fact("frame.api", "STRING", "in whose words the frame is: VULKAN or METAL; never unknown", "api"),
)
_DEVICE = (
    Fact("device.known", "BOOL", "the device is named or described, and is one device, not a class with guaranteed minimums"),
    Fact("device.minimum", "BOOL", "a class of devices: what it does not list is not guaranteed"),
    Fact("device.name", "STRING", "the device's name"),
    Fact("device.vendor", "STRING", "who makes it", "vendor"),
    Fact("device.tiler", "BOOL", "it renders tile by tile"),
    Fact("device.immediate_mode", "BOOL", "it is stated not to render tile by tile; never unknown"),
    Fact("device.lazy_memory", "BOOL", "it offers LAZILY_ALLOCATED memory"),
    Fact("device.lazy_memory_known", "BOOL", "its memory types are stated"),
    Fact("device.max_efficient_samples", "INT", "the largest count that keeps full throughput: 4 unless the device says otherwise"),
    Fact("device.sample_rate_shading", "BOOL", "it offers the feature sampleRateShading"),
    Fact("device.metal_family", "STRING", "Metal: the GPU family that is stated", "family"),
    Fact(
        "device.mixed_samples",
        "BOOL",
        "it offers VK_AMD_mixed_attachment_samples or VK_NV_framebuffer_mixed_samples, and what is enabled is not stated; never unknown",
    ),
    Fact(
        "device.single_sampled_render",
        "BOOL",
        "it offers VK_EXT_multisampled_render_to_single_sampled, and what is enabled is not stated; never unknown",
    ),
)
_ENABLED = (
    Fact("enabled.sample_rate_shading", "BOOL", "the application enables sampleRateShading"),
    Fact(
        "enabled.depth_stencil_resolve", "BOOL", "Vulkan 1.2 or VK_KHR_depth_stencil_resolve is enabled; where that is not stated: offered"
    ),
    Fact("enabled.mixed_samples", "BOOL", "VK_AMD_mixed_attachment_samples or VK_NV_framebuffer_mixed_samples is enabled; never unknown"),
    Fact("enabled.single_sampled_render", "BOOL", "the application enables multisampledRenderToSingleSampled; never unknown"),
)
_SCENE = (
    Fact("scene.color", "STRING", "LDR or HDR", "scene color"),
    Fact("scene.peak", "DOUBLE", "the brightest value, in units of display white"),
    Fact("scene.tone_mapping", "STRING", "where tone mapping happens", "tone mapping"),
    Fact("scene.depth", "STRING", "the direction of depth: STANDARD is 0 near, REVERSED is 1 near", "depth direction"),
    Fact("scene.depth_resolve_wants", "STRING", "what the reader of resolved depth needs", "wants"),
)
_IMAGE = (
    Fact("image.name", "STRING", "the image's name; the attachment's, where it stands for one without an image"),
    Fact("image.stated", "BOOL", "it stands in `images`; false where it stands for an attachment that names none"),
    Fact("image.format", "STRING", "its format", "VkFormat"),
    Fact("image.samples", "INT", "samples a texel"),
    Fact("image.is_color", "BOOL", "its format has a colour aspect"),
    Fact("image.numeric", "STRING", "the numeric type of its colour", "numeric"),
    Fact("image.is_half_float", "BOOL", "every component is a 16-bit float"),
    Fact("image.type", "STRING", "its dimensions", "VkImageType"),
    Fact("image.tiling", "STRING", "its tiling", "VkImageTiling"),
    Fact("image.mip_levels", "INT", "its mip levels"),
    Fact("image.flags", "LIST", "its creation flags", "VkImageCreateFlagBits"),
    Fact("image.sharing_mode", "STRING", "its sharing mode", "VkSharingMode"),
    Fact("image.usage", "LIST", "its usage", "VkImageUsageFlagBits"),
    Fact("image.memory", "LIST", "the property flags of the memory it is bound to", "VkMemoryPropertyFlagBits"),
    Fact("image.transient", "BOOL", "its usage has TRANSIENT_ATTACHMENT"),
    Fact("image.lazily_allocated", "BOOL", "its memory is LAZILY_ALLOCATED"),
    Fact("image.multisampling_conflicts", "LIST", "what it states that Vulkan forbids beside more than one sample; never unknown"),
    Fact(
        "image.compression_blockers",
        "LIST",
        "what it states that turns compression off on GPUs of the device's vendor; of amd, arm or nvidia where that is none of them",
    ),
    Fact("image.attachment_usage", "BOOL", "its usage has COLOR_ATTACHMENT, DEPTH_STENCIL_ATTACHMENT or INPUT_ATTACHMENT"),
    Fact("image.transient_conflicts", "LIST", "usages it has that Vulkan forbids beside TRANSIENT_ATTACHMENT", "VkImageUsageFlagBits"),
    Fact("image.presentable", "BOOL", "it belongs to a swapchain"),
    Fact("image.is_data", "BOOL", "its values are stated to be no colour; never unknown"),
    Fact("image.encoding", "STRING", "what its values mean", "encoding"),
    Fact("image.is_render_target", "BOOL", "a pass draws or resolves to it, or its usage allows that"),
    Fact("image.read", "BOOL", "something other than a resolve inside a pass reads it"),
    Fact(
        "image.read_in_vain",
        "BOOL",
        "nothing but resolve commands reads it, each after a pass that resolved it itself, or threw it away; never unknown",
    ),
    Fact("image.loaded", "BOOL", "a pass loads an aspect of it"),
    Fact("image.supported", "BOOL", "the device offers its sample count for its aspects; unknown where no pass can draw to it"),
    Fact("image.supported_samples", "INTS", "the counts that the device offers for its aspects"),
    Fact("image.averaged_by_reader", "BOOL", "a shader that reads it averages its samples: it is stated, or the shader's module says so"),
    Fact(
        "image.taking_turns",
        "LIST",
        "multisampled images alike, this first, that take turns with as many presentable ones, one a frame; empty elsewhere",
    ),
    Fact("image.turns_stated", "BOOL", "alternating framebuffers state those turns"),
    Fact("image.share_of_devices", "INT", "per cent of 2,035 devices in reports that offer its sample count"),
    Fact("image.share_of_tilers", "INT", "per cent of the tile-based ones among them that do"),
    Fact(
        "image.study",
        "STRING",
        "how the record of `msaa-lint study` beside the description stands to its sample count, where that is above the device's "
        "max_efficient_samples; NONE elsewhere; never unknown",
        "study",
    ),
    Fact("image.study_says", "STRING", "what that record found, or why it does not count; never unknown"),
    Fact("image.storage_mode", "STRING", "Metal: its storage mode", "storage mode"),
    Fact("image.texture_type", "STRING", "Metal: its texture type", "texture type"),
    Fact("image.type_fits", "BOOL", "Metal: its texture type is a multisample one where it has several samples, and none where it has one"),
    Fact("image.usage_words", "LIST", "Metal: its usage, in Metal's words", "texture usage"),
    Fact("image.memoryless_offered", "BOOL", "Metal: the GPU has memoryless textures: a family from apple2 on, or one with lazy memory"),
    Fact("image.memoryless_conflicts", "LIST", "Metal: its usage but renderTarget: no memoryless texture may have it", "texture usage"),
)
_PASS = (
    Fact("pass.kind", "STRING", "a VkRenderPass or a vkCmdBeginRendering", "pass kind"),
    Fact("pass.name", "STRING", "the render pass's name"),
    Fact("pass.partial_area", "BOOL", "it is begun with a stated render area smaller than its images; unknown where no size is stated"),
    Fact("pass.custom_resolve", "BOOL", "a subpass of it resolves by its own shader"),
    Fact("pass.suspends", "BOOL", "a rendering that is suspended: what is left of it comes later"),
    Fact("pass.attachments", "INT", "how many attachments it has"),
    Fact("pass.clears", "BOOL", "a render pass: an attachment that a subpass uses begins with CLEAR, depth and stencil apart"),
    Fact("pass.clear_values", "INT", "the most clear values that it is begun with; 0 for a rendering, and where nothing begins it"),
)
_ATTACHMENT = (
    Fact("attachment.name", "STRING", "its name, or its index"),
    Fact("attachment.format", "STRING", "its format", "VkFormat"),
    Fact("attachment.samples", "INT", "samples a texel"),
    Fact("attachment.used", "BOOL", "a subpass refers to it as colour, depth-stencil, resolve target or input"),
    Fact("attachment.drawn", "BOOL", "a subpass draws to it: it is a colour or depth-stencil attachment"),
    Fact("attachment.is_resolve_target", "BOOL", "a resolve writes it"),
    Fact("attachment.read_as_input", "BOOL", "a subpass reads it as input attachment"),
    Fact("attachment.initial_layout", "STRING", "its layout when the pass begins", "VkImageLayout"),
    Fact("attachment.final_layout", "STRING", "its layout when the pass ends", "VkImageLayout"),
)
_ASPECT = (
    Fact("aspect.name", "STRING", "which aspect", "aspect"),
    Fact("aspect.load", "STRING", "its load operation: stencilLoadOp for stencil, else loadOp", "VkAttachmentLoadOp"),
    Fact("aspect.store", "STRING", "its store operation: stencilStoreOp for stencil, else storeOp", "VkAttachmentStoreOp"),
    Fact("aspect.memory_operations", "LIST", "those of its operations that need memory behind it: LOAD, STORE; never unknown"),
    Fact("aspect.initial_layout", "STRING", "its layout when the pass begins", "VkImageLayout"),
    Fact("aspect.resolved", "BOOL", "a resolve with a mode other than NONE reads it in the pass"),
    Fact("aspect.resolved_over", "BOOL", "a resolve in the pass overwrites it"),
    Fact(
        "aspect.read_before_resolve",
        "BOOL",
        "a subpass reads it as input attachment, or tests against it, before that resolve; never unknown",
    ),
    Fact(
        "aspect.read_after_resolve",
        "BOOL",
        "a subpass reads it as input attachment, or tests against it, after that resolve; never unknown",
    ),
    Fact("aspect.read_later", "BOOL", "something after the pass, or the pass itself in the next frame, reads what it stores"),
    Fact("aspect.readers_known", "BOOL", "the description says whether anything reads it later; never unknown"),
    Fact(
        "aspect.fetched",
        "STRING",
        "stored multisampled depth: shaders alone read it, of which one fetches ALL samples, or all fetch ONE, or one does not say "
        "(NOT_STATED); OTHER where something else reads it, or nothing",
        "fetched",
    ),
    Fact("aspect.stored_by", "STRING", "the pass whose store it loads"),
    Fact("aspect.costly_operations", "LIST", "LOAD, and STORE where nothing reads it later; never unknown"),
    Fact(
        "aspect.store_wasted",
        "BOOL",
        "every time that the pass is begun, what it stores is overwritten, or the frame comes round, before anything reads it",
    ),
    Fact("aspect.waste_certain", "BOOL", "the usage, or the commands in between, allow no reader; else only the frame's commands tell"),
    Fact("aspect.overwritten_by", "STRING", "the pass or command that overwrites what it stores and nothing reads"),
    Fact("aspect.reads_undefined", "BOOL", "what it loads was thrown away by the last to write it, or a command reads what it throws away"),
    Fact("aspect.loads_discarded", "BOOL", "what it loads was thrown away by the last to write it"),
    Fact("aspect.discarded_by", "STRING", "the pass or barrier that threw away what it loads"),
    Fact("aspect.discard_reader", "STRING", "the command that reads what it throws away"),
    Fact("aspect.undefined_within_frame", "BOOL", "what was thrown away is read in the same frame"),
    Fact("aspect.copied_before", "BOOL", "it loads what a copy, blit or resolve command wrote just before; never unknown"),
    Fact("aspect.copy_command", "STRING", "that command"),
    Fact("aspect.copy_source", "STRING", "the image that it copies from; unknown where that is a buffer"),
    Fact(
        "aspect.cleared_by_command",
        "BOOL",
        "a command clears all of it just before the pass begins, or in the pass before anything is drawn, each time that it is begun; "
        "never unknown",
    ),
    Fact("aspect.clear_command", "STRING", "that command"),
    Fact("aspect.clears_in_pass", "BOOL", "that command is recorded in the pass; never unknown"),
    Fact(
        "aspect.untouched",
        "BOOL",
        "no subpass refers to the attachment, or no draw and no clear that is recorded touches the aspect; false where that is not known; "
        "never unknown",
    ),
)
_ACTION = (
    Fact("aspect.load_action", "STRING", "Metal: its load action; absent for what is only resolved to", "load action"),
    Fact("aspect.store_action", "STRING", "Metal: its store action; absent for what is only resolved to", "store action"),
    Fact("aspect.has_resolve_texture", "BOOL", "Metal: a resolve texture is stated for it"),
    Fact("aspect.resolve_texture", "STRING", "Metal: that texture's name"),
    Fact("aspect.resolves_by_action", "BOOL", "Metal: its store action is one that resolves"),
    Fact("aspect.resolve_filter", "STRING", "Metal: the filter that is stated for the resolve of depth, or of stencil", "resolve filter"),
)
_SUBPASS = (
    Fact("subpass.index", "INT", "its index; 0 in dynamic rendering"),
    Fact("subpass.samples", "INT", "the sample count its attachments share, or the one it renders to single-sampled ones with"),
    Fact("subpass.color_samples", "INTS", "the distinct known counts of its colour attachments"),
    Fact("subpass.depth_stencil_samples", "INT", "the count of its depth-stencil attachment"),
    Fact("subpass.odd_attachment", "STRING", "the first colour or depth-stencil attachment whose count is not the others'"),
    Fact("subpass.odd_samples", "INT", "its count"),
    Fact("subpass.expected_samples", "INT", "the count of those before it, or the one that is rendered to single-sampled ones with"),
    Fact("subpass.mixed_color_samples", "BOOL", "two colour attachments differ in samples"),
    Fact("subpass.mixed_depth_stencil_samples", "BOOL", "dynamic rendering: the depth and the stencil attachment differ in samples"),
    Fact("subpass.depth_below_color", "BOOL", "the depth-stencil count is below a colour count"),
    Fact("subpass.depth_above_color", "BOOL", "the depth-stencil count is above a colour count"),
    Fact(
        "subpass.differs_from_single_sampled_count",
        "BOOL",
        "render to single-sampled: an attachment has neither one sample nor the stated count",
    ),
    Fact("subpass.tile_known", "BOOL", "what it takes of the device's tile is known; never unknown"),
    Fact(
        "subpass.tile_bytes",
        "INT",
        "bytes that a pixel's samples take on the device's tile: colour, and depth where it is in the same memory",
    ),
    Fact("subpass.tile_pixels", "INT", "pixels of the device's tile with its attachments"),
    Fact("subpass.tile_full", "INT", "pixels that the tile has with the same attachments at one sample"),
    Fact("subpass.tile_spills", "BOOL", "not even the device's smallest tile holds its attachments"),
    Fact("subpass.has_pipelines", "BOOL", "the description is whole and lists pipelines for it; a rendering: draws are recorded in it"),
    Fact("subpass.partial_coverage", "BOOL", "some pipeline of it can cover a pixel in part"),
    Fact(
        "subpass.full_screen",
        "BOOL",
        "all that is recorded in it are triangles over the whole picture, on nothing that was drawn before; false where that is not known; "
        "never unknown",
    ),
)
_RESOLVE = (
    Fact("resolve.kind", "STRING", "in a subpass, at the end of a rendering, or vkCmdResolveImage", "resolve kind"),
    Fact("resolve.aspect", "STRING", "which aspect", "aspect"),
    Fact("resolve.mode", "STRING", "its mode; AVERAGE where Vulkan fixes it for a colour format", "VkResolveModeFlagBits"),
    Fact("resolve.has_source", "BOOL", "the attachment or image that it reads is stated"),
    Fact("resolve.has_target", "BOOL", "the attachment or image that it writes is stated"),
    Fact("resolve.source", "STRING", "the name of what it reads"),
    Fact("resolve.target", "STRING", "the name of what it writes"),
    Fact("resolve.source_samples", "INT", "samples a texel of what it reads"),
    Fact("resolve.target_samples", "INT", "samples a texel of what it writes"),
    Fact("resolve.source_format", "STRING", "the format it reads", "VkFormat"),
    Fact("resolve.target_format", "STRING", "the format it writes", "VkFormat"),
    Fact("resolve.source_numeric", "STRING", "the numeric type of the colour it reads", "numeric"),
    Fact("resolve.source_encoding", "STRING", "what the values it reads mean", "encoding"),
    Fact("resolve.source_is_data", "BOOL", "the values are stated to be no colour; never unknown"),
    Fact("resolve.formats_match", "BOOL", "Vulkan allows the two formats together"),
    Fact("resolve.single_sampled_render", "BOOL", "it belongs to a pass that renders multisampled to single-sampled attachments"),
    Fact("resolve.first_of_pair", "BOOL", "it is the first aspect of its structure: a rule on the pair asks this, to fire once"),
    Fact("resolve.all_modes_none", "BOOL", "the modes of all its structure's aspects are NONE"),
    Fact("resolve.mode_supported", "BOOL", "the device offers its mode"),
    Fact("resolve.supported_modes", "LIST", "the modes that the device offers for its aspect", "VkResolveModeFlagBits"),
    Fact(
        "resolve.pair_supported",
        "BOOL",
        "the device offers the modes of both aspects together, where it offers each (independentResolve, independentResolveNone)",
    ),
    Fact("resolve.pass_could_resolve", "BOOL", "a command: the source was last written by a pass that does not resolve it, and could"),
    Fact("resolve.writer", "STRING", "a command: the pass that last wrote the source"),
    Fact("resolve.target_stored", "BOOL", "what it writes outlives the pass"),
    Fact("resolve.target_read", "BOOL", "something reads what it writes, later in the pass or the frame, or in the next frame"),
    Fact(
        "resolve.may_be_none",
        "BOOL",
        "its mode may be NONE: the other aspect is not resolved or not read either, or the device offers independentResolveNone",
    ),
    Fact("resolve.target_readable", "BOOL", "the image that it writes may be read: SAMPLED, STORAGE, INPUT_ATTACHMENT or TRANSFER_SRC"),
    Fact(
        "resolve.only_copied",
        "BOOL",
        "colour: what it writes is copied or blitted to all of a presentable image, and nothing else uses it",
    ),
    Fact("resolve.copied_by", "STRING", "the command that does, copyImage or blitImage"),
    Fact("resolve.copied_to", "STRING", "that presentable image"),
    Fact("resolve.copied_from", "STRING", "the image that it is copied from"),
    Fact("resolve.copy_fits", "STRING", "whether the two have the same format, width and height", "fits"),
    Fact("resolve.copy_barred", "BOOL", "barriers name one of the two"),
    Fact("resolve.repeats", "BOOL", "an earlier resolve of the frame took the same samples by the same mode, and nothing was drawn since"),
    Fact(
        "resolve.resolved_anew",
        "BOOL",
        "a later resolve of the frame takes the same samples with more drawn on them, and nothing reads what this one wrote",
    ),
    Fact("resolve.again_by_command", "BOOL", "one of those two resolves is a command"),
    Fact("resolve.again_on_tile", "BOOL", "those two belong to one pass, and to the same image, so that memory is written once"),
    Fact("resolve.again_to_same_target", "BOOL", "those two resolves write to the same image"),
    Fact("resolve.stage", "STRING", "the stage that it runs in", "VkPipelineStageFlagBits2"),
    Fact(
        "resolve.waited_for",
        "BOOL",
        "the dependencies and barriers stated for the first reader of what it writes wait for its stage; unknown where none is stated",
    ),
    Fact("resolve.waiting_stages", "LIST", "the source stages of those", "VkPipelineStageFlagBits2"),
    Fact("resolve.read_in_pass", "BOOL", "that reader is a later subpass of the pass"),
    Fact("resolve.read_next_frame", "BOOL", "that reader is in the next frame"),
    Fact("resolve.filter", "STRING", "Metal: the filter that is stated for it, of depth or stencil", "resolve filter"),
    Fact("resolve.share_of_tilers", "INT", "depth and stencil: per cent of tile-based devices in reports that offer the mode"),
)
_PIPELINE = (
    Fact("pipeline.name", "STRING", "its name"),
    Fact(
        "pipeline.rasterization_samples",
        "INT",
        "rasterizationSamples; where it is dynamic state, what the commands set for all its draws; unknown where it rasterizes nothing",
    ),
    Fact("pipeline.samples_dynamic", "BOOL", "its sample count is dynamic state; never unknown"),
    Fact("pipeline.attachment_samples", "INT", "the sample count that its subpass or rendering has; unknown beside a custom resolve"),
    Fact("pipeline.sample_shading", "BOOL", "sampleShadingEnable"),
    Fact(
        "pipeline.sample_shading_chosen",
        "BOOL",
        "another multisampled pipeline of its subpass, or for dynamic rendering, states sampleShadingEnable off",
    ),
    Fact("pipeline.min_sample_shading", "DOUBLE", "minSampleShading"),
    Fact(
        "pipeline.shaded_samples",
        "INT",
        "fragment shader runs a pixel that sample shading demands: max(ceil(minSampleShading * samples), 1)",
    ),
    Fact("pipeline.alpha_to_coverage", "BOOL", "alphaToCoverageEnable"),
    Fact(
        "pipeline.blends_first",
        "BOOL",
        "blending is on for colour attachment 0 and weighs by the shader's alpha, as far as factors and alphaToOneEnable are stated",
    ),
    Fact("pipeline.dropped_samples", "INT", "samples below the count that sampleMask clears; 0 without a mask"),
    Fact("pipeline.blended_float_formats", "LIST", "formats of float colour attachments that it blends into and writes", "VkFormat"),
    Fact("pipeline.rasterizer_discard", "BOOL", "rasterizerDiscardEnable"),
    Fact("pipeline.module", "STRING", "the module of its fragment shader, where that is stated and can be read"),
    Fact(
        "pipeline.per_sample_reads",
        "LIST",
        "what its fragment shader reads that has it run for every sample, or may: SampleId, SamplePosition, `sample` inputs; never unknown",
    ),
    Fact("pipeline.shaded_per_sample", "BOOL", "its fragment shader reads SampleId or SamplePosition; never unknown"),
    Fact(
        "pipeline.sample_shading_implied",
        "BOOL",
        "what its fragment shader reads has it run for each of several samples, or may, and its state does not ask for that; never unknown",
    ),
    Fact("pipeline.alpha_output", "BOOL", "its fragment shader has an alpha output at location 0, index 0"),
    Fact("pipeline.alpha_written", "BOOL", "its fragment shader stores something to that"),
    Fact("pipeline.alpha_constant", "DOUBLE", "the constant that it always stores to that; unknown where it is none"),
)
_READ = (
    Fact("read.image", "STRING", "the image or input attachment that a shader reads"),
    Fact("read.image_samples", "INT", "samples a texel of it"),
    Fact("read.is_color", "BOOL", "its format has a colour aspect"),
    Fact("read.numeric", "STRING", "the numeric type of its colour", "numeric"),
    Fact("read.samples", "STRING", "which samples are fetched: ONE, ALL, OTHER; as stated, else as its shaders say", "samples read"),
    Fact("read.resolves", "STRING", "what becomes of them; as stated, else as every shader that may read it says", "resolves"),
    Fact("read.pipeline", "STRING", "the pipeline whose fragment shader reads it"),
    Fact("read.module", "STRING", "that shader's module"),
    Fact("read.fetched_samples", "INT", "the count N of samples that it fetches, where they are 0 to N - 1 and constants say so"),
    Fact("read.highest_sample", "INT", "the highest sample that it fetches under no condition that constants do not decide"),
    Fact(
        "read.as_all",
        "BOOL",
        "it loops over those N, averages them, or takes their least or greatest, under no such condition: as if the image had no others",
    ),
    Fact("read.alone", "BOOL", "no pass is described, nor the image's format, nor that it has one sample: the reader is all there is"),
    Fact("read.on_tile", "BOOL", "the image is attached to the pass around the read"),
    Fact("read.writer", "STRING", "the pass that last wrote the image before"),
    Fact("read.pass_could_resolve", "BOOL", "that pass does not resolve it, and could; false where the pass around has the image attached"),
)
_DEPENDENCY = (
    Fact(
        "dependency.stages",
        "LIST",
        "the source stages of all dependencies from EXTERNAL into the subpass, and of recorded barriers for its multisampled attachments",
        "VkPipelineStageFlagBits2",
    ),
    Fact("dependency.accesses", "LIST", "their source accesses", "VkAccessFlagBits2"),
    Fact(
        "dependency.makes_writes_available",
        "BOOL",
        "they make the writes of every multisampled attachment available that the subpass is the first to use: COLOR_ATTACHMENT_WRITE for "
        "color, DEPTH_STENCIL_ATTACHMENT_WRITE for depth and stencil, or MEMORY_WRITE",
    ),
    Fact("dependency.unavailable_writes", "LIST", "the write accesses that they do not make available", "VkAccessFlagBits2"),
    Fact("dependency.waits_for_late_tests", "BOOL", "LATE_FRAGMENT_TESTS, or a stage that includes it, is among the source stages"),
    Fact("dependency.missing", "STRING", "what a multisampled attachment that is used again needs of them, and they do not state"),
    Fact("dependency.subpass", "INT", "the subpass they lead into"),
    Fact("dependency.multisampled", "BOOL", "that subpass is the first to use a multisampled attachment"),
    Fact("dependency.multisampled_depth_stencil", "BOOL", "that subpass is the first to use a multisampled depth-stencil attachment"),
)
_CHOICE = (
    Fact("choice.name", "STRING", "the function or variable that holds the count"),
    Fact("choice.limits", "LIST", "the members of VkPhysicalDeviceLimits whose masks are asked"),
    Fact("choice.combined", "STRING", "how the masks are combined; NONE for one alone", "combined"),
    Fact("choice.chosen", "STRING", "MAXIMUM: the greatest count that is offered; ATMOST: the greatest up to a stated one", "chosen"),
    Fact("choice.at_most", "INT", "the greatest count that it may give: as stated, else by its tests; 64 where nothing caps it"),
    Fact("choice.retested", "INT", "a count whose bit an earlier test of the chain has asked, which gives another count"),
    Fact("choice.first_gives", "INT", "the count that the earlier test gives"),
    Fact("choice.never_given", "INTS", "the counts of the branches behind later tests of that bit, which are never taken; never unknown"),
    Fact("choice.depth_counts_asked", "BOOL", "the counts for depth are among its limits"),
    Fact("choice.stencil_counts_asked", "BOOL", "the counts for stencil are among its limits"),
    Fact("choice.stencil_formats", "LIST", "the formats with a stencil aspect among those of images that get the count", "VkFormat"),
)

GLOBAL = (*_FRAME, *_DEVICE, *_ENABLED, *_SCENE)

SUBJECTS: dict[str, tuple[Fact, ...]] = {
    "image": (*_IMAGE, *GLOBAL),
    "attachment": (*_ATTACHMENT, *_IMAGE, *_PASS, *GLOBAL),
    "aspect": (*_ASPECT, *_ACTION, *_ATTACHMENT, *_IMAGE, *_PASS, *GLOBAL),
    "pass": (*_PASS, *GLOBAL),
    "subpass": (*_SUBPASS, *_PASS, *GLOBAL),
    "resolve": (*_RESOLVE, *_PASS, *GLOBAL),
    "pipeline": (*_PIPELINE, *_SUBPASS, *_PASS, *GLOBAL),
    "dependency": (*_DEPENDENCY, *_PASS, *GLOBAL),
    "read": (*_READ, *GLOBAL),
    "choice": (*_CHOICE, *GLOBAL),
}
"""The facts that a rule about each kind of subject may ask."""

FACTS: dict[str, Fact] = {fact.name: fact for facts in SUBJECTS.values() for fact in facts}
