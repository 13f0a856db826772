"""The facts of passes, subpasses, resolves and dependencies."""

from __future__ import annotations

from .words import Fact

PASS = (
    Fact("pass.kind", "STRING", "a VkRenderPass or a vkCmdBeginRendering", "pass kind"),
    Fact("pass.name", "STRING", "name of the render pass"),
    Fact(
        "pass.begun",
        "STRING",
        "whether the frame begins it; YES if no commands are stated, NOT_STATED for a part of a "
        "frame and with `commands: []`",
        "begun",
    ),
    Fact(
        "pass.partial_area",
        "BOOL",
        "it begins with a stated render area smaller than its images; unknown if no size is stated",
    ),
    Fact("pass.custom_resolve", "BOOL", "one of its subpasses resolves with a shader"),
    Fact(
        "pass.labels",
        "LIST",
        "debug labels within which it is begun: the labels around one begin are joined by ` / `",
    ),
    Fact("pass.suspends", "BOOL", "it is a suspended rendering: a later one continues it"),
    Fact(
        "pass.resumes_differently",
        "BOOL",
        "it is a resumed rendering, and states another value of a member than the suspended one",
    ),
    Fact(
        "pass.resumed_from",
        "STRING",
        "the suspended rendering that it continues; empty if it is none that is resumed",
    ),
    Fact(
        "pass.resumed_member",
        "STRING",
        "the first member that differs from that one's, as `colorAttachments[0].loadOp`; empty if "
        "none does",
    ),
    Fact(
        "pass.handed_over",
        "LIST",
        "multisampled attachments whose stored samples only the fragment shaders of one later pass "
        "read, which may become one with this",
    ),
    Fact("pass.handed_samples", "INT", "samples per texel of the first of them"),
    Fact("pass.handed_to", "STRING", "that later pass"),
    Fact("pass.attachments", "INT", "number of attachments"),
    Fact(
        "pass.clears",
        "BOOL",
        "render pass: an attachment that a subpass uses has load operation CLEAR for one of its "
        "aspects",
    ),
    Fact(
        "pass.clear_values",
        "INT",
        "largest number of clear values that it begins with; 0 for a rendering and for a pass that "
        "never begins",
    ),
)

SUBPASS = (
    Fact("subpass.index", "INT", "index; 0 in dynamic rendering"),
    Fact(
        "subpass.samples",
        "INT",
        "sample count that its attachments share, or that it renders to single-sampled ones with",
    ),
    Fact("subpass.color_samples", "INTS", "distinct known sample counts of its color attachments"),
    Fact("subpass.depth_stencil_samples", "INT", "sample count of its depth-stencil attachment"),
    Fact(
        "subpass.odd_attachment",
        "STRING",
        "first color or depth-stencil attachment whose sample count differs from the others'",
    ),
    Fact("subpass.odd_samples", "INT", "its sample count"),
    Fact(
        "subpass.expected_samples",
        "INT",
        "sample count of the attachments before it, or the one of render-to-single-sampled",
    ),
    Fact("subpass.mixed_color_samples", "BOOL", "two color attachments differ in sample count"),
    Fact(
        "subpass.mixed_depth_stencil_samples",
        "BOOL",
        "dynamic rendering: depth and stencil attachment differ in sample count",
    ),
    Fact(
        "subpass.depth_below_color",
        "BOOL",
        "the depth-stencil sample count is below a color sample count",
    ),
    Fact(
        "subpass.depth_above_color",
        "BOOL",
        "the depth-stencil sample count is above a color sample count",
    ),
    Fact(
        "subpass.differs_from_single_sampled_count",
        "BOOL",
        "render to single-sampled: an attachment has neither one sample nor the stated sample "
        "count",
    ),
    Fact(
        "subpass.tile_known", "BOOL", "its use of the device's tile memory is known; never unknown"
    ),
    Fact(
        "subpass.tile_bytes",
        "INT",
        "bytes per pixel in the device's tile memory: color, and depth where both share that "
        "memory",
    ),
    Fact("subpass.tile_pixels", "INT", "pixels in a tile of the device with its attachments"),
    Fact("subpass.tile_full", "INT", "pixels in a tile with the same attachments at one sample"),
    Fact(
        "subpass.tile_spills",
        "BOOL",
        "its attachments do not fit even into the device's smallest tile",
    ),
    Fact(
        "subpass.has_pipelines",
        "BOOL",
        "the description is complete and lists pipelines for it; a rendering: draws are recorded "
        "in it",
    ),
    Fact("subpass.partial_coverage", "BOOL", "one of its pipelines can cover pixels in part"),
    Fact(
        "subpass.full_screen",
        "BOOL",
        "it draws only triangles that cover the whole picture, over nothing drawn before; false if "
        "that is not known; never unknown",
    ),
)

RESOLVE = (
    Fact(
        "resolve.kind",
        "STRING",
        "in a subpass, at the end of a rendering, or vkCmdResolveImage",
        "resolve kind",
    ),
    Fact("resolve.aspect", "STRING", "which aspect", "aspect"),
    Fact(
        "resolve.mode",
        "STRING",
        "mode; AVERAGE where Vulkan prescribes it for a color format; of a command for depth and "
        "stencil, that of depth",
        "VkResolveModeFlagBits",
    ),
    Fact(
        "resolve.mode_stated", "BOOL", "command: it has a VkResolveImageModeInfoKHR; never unknown"
    ),
    Fact("resolve.has_source", "BOOL", "the attachment or image that it reads is stated"),
    Fact("resolve.has_target", "BOOL", "the attachment or image that it writes is stated"),
    Fact("resolve.source", "STRING", "name of what it reads"),
    Fact("resolve.target", "STRING", "name of what it writes"),
    Fact("resolve.source_samples", "INT", "samples per texel of what it reads"),
    Fact("resolve.target_samples", "INT", "samples per texel of what it writes"),
    Fact("resolve.source_format", "STRING", "format of what it reads", "VkFormat"),
    Fact("resolve.target_format", "STRING", "format of what it writes", "VkFormat"),
    Fact("resolve.source_numeric", "STRING", "numeric type of the color that it reads", "numeric"),
    Fact(
        "resolve.source_integers",
        "BOOL",
        "color: it reads integers; unknown if the image may be viewed in another format",
    ),
    Fact("resolve.source_encoding", "STRING", "what the values that it reads mean", "encoding"),
    Fact(
        "resolve.source_is_data",
        "BOOL",
        "the values are stated to be data, not color; never unknown",
    ),
    Fact("resolve.formats_match", "BOOL", "Vulkan allows the two formats together"),
    Fact(
        "resolve.single_sampled_render",
        "BOOL",
        "its pass renders multisampled to single-sampled attachments",
    ),
    Fact(
        "resolve.first_of_pair",
        "BOOL",
        "it is the first aspect of its structure; a rule about the pair asks this in order to fire "
        "once",
    ),
    Fact("resolve.all_modes_none", "BOOL", "the modes of all aspects of its structure are NONE"),
    Fact("resolve.mode_supported", "BOOL", "the device supports its mode"),
    Fact(
        "resolve.supported_modes",
        "LIST",
        "modes that the device supports for its aspect",
        "VkResolveModeFlagBits",
    ),
    Fact(
        "resolve.pair_supported",
        "BOOL",
        "the device supports the modes of both aspects together, if it supports each "
        "(independentResolve, independentResolveNone)",
    ),
    Fact(
        "resolve.pass_could_resolve",
        "BOOL",
        "command: the last pass to write the source does not resolve it, and could; false for "
        "other kinds",
    ),
    Fact("resolve.writer", "STRING", "command: the pass that last wrote the source"),
    Fact(
        "resolve.target_too_small",
        "BOOL",
        "an image that it writes is smaller than a framebuffer or render area that it is used with",
    ),
    Fact("resolve.target_extent", "STRING", "width and height of that image"),
    Fact(
        "resolve.rendered_extent",
        "STRING",
        "width and height of that framebuffer, or right and lower end of that render area",
    ),
    Fact(
        "resolve.target_also",
        "STRING",
        "what else its subpass or rendering uses the image for that it writes; NOTHING for a "
        "command",
        "other use",
    ),
    Fact("resolve.target_stored", "BOOL", "what it writes outlives the pass"),
    Fact(
        "resolve.target_read",
        "BOOL",
        "something reads what it writes, later in the pass or the frame, or in the next frame",
    ),
    Fact(
        "resolve.may_be_none",
        "BOOL",
        "its mode may be NONE: the other aspect is not resolved or not read either, or the device "
        "supports independentResolveNone",
    ),
    Fact(
        "resolve.target_readable",
        "BOOL",
        "the usage of the image that it writes has SAMPLED, STORAGE, INPUT_ATTACHMENT or "
        "TRANSFER_SRC",
    ),
    Fact(
        "resolve.only_copied",
        "BOOL",
        "color: what it writes is copied or blitted to all of a presentable image, and nothing "
        "else uses it",
    ),
    Fact("resolve.copied_by", "STRING", "the command that does so, copyImage or blitImage"),
    Fact("resolve.copied_to", "STRING", "that presentable image"),
    Fact("resolve.copied_from", "STRING", "image that is copied"),
    Fact(
        "resolve.copy_fits",
        "STRING",
        "whether the two have the same format, width and height",
        "fits",
    ),
    Fact("resolve.copy_barred", "BOOL", "barriers name one of the two"),
    Fact(
        "resolve.repeats",
        "BOOL",
        "an earlier resolve of the frame read the same samples in the same mode, with nothing "
        "drawn since",
    ),
    Fact(
        "resolve.resolved_anew",
        "BOOL",
        "a later resolve of the frame reads the same samples with more drawn on them, and nothing "
        "reads what this one wrote",
    ),
    Fact("resolve.again_by_command", "BOOL", "one of those two resolves is a command"),
    Fact(
        "resolve.again_on_tile",
        "BOOL",
        "those two resolves write the same image in one pass, so that memory is written once",
    ),
    Fact("resolve.again_to_same_target", "BOOL", "those two resolves write the same image"),
    Fact(
        "resolve.stage",
        "STRING",
        "stage of its write, or of that of the samples that it reads too early",
        "VkPipelineStageFlagBits2",
    ),
    Fact("resolve.access", "STRING", "access of that write", "VkAccessFlagBits2"),
    Fact(
        "resolve.waited_for",
        "BOOL",
        "the dependencies and barriers of the frame make its result visible to its first reader, "
        "and to a resolve command the samples that "
        "it reads; unknown if the frame states none",
    ),
    Fact(
        "resolve.wait_stated",
        "BOOL",
        "one of those dependencies and barriers is stated for that read",
    ),
    Fact(
        "resolve.waiting_stages",
        "LIST",
        "source stages of the first one that is",
        "VkPipelineStageFlagBits2",
    ),
    Fact("resolve.wait_found", "STRING", "if nothing makes it visible: how it is read"),
    Fact(
        "resolve.wait_lacks",
        "STRING",
        "if nothing makes it visible: what to add to the dependency or barrier, or which one",
    ),
    Fact("resolve.read_early", "STRING", "image that is read so"),
    Fact("resolve.reader_stage", "STRING", "stage of that read", "VkPipelineStageFlagBits2"),
    Fact("resolve.reader_access", "STRING", "access of that read", "VkAccessFlagBits2"),
    Fact("resolve.read_in_pass", "BOOL", "that reader is a later subpass of the pass"),
    Fact("resolve.read_next_frame", "BOOL", "that reader is in the next frame"),
    Fact(
        "resolve.filter", "STRING", "Metal: filter of a depth or stencil resolve", "resolve filter"
    ),
    Fact(
        "resolve.share_of_tilers",
        "INT",
        "depth and stencil: percentage of reported tile-based devices that support the mode",
    ),
)

DEPENDENCY = (
    Fact(
        "dependency.stages",
        "LIST",
        "source stages of all dependencies from EXTERNAL into the subpass, and of recorded "
        "barriers for its multisampled attachments",
        "VkPipelineStageFlagBits2",
    ),
    Fact("dependency.accesses", "LIST", "their source accesses", "VkAccessFlagBits2"),
    Fact(
        "dependency.makes_writes_available",
        "BOOL",
        "they make the writes of every multisampled attachment available that the subpass is the "
        "first to use: COLOR_ATTACHMENT_WRITE for "
        "color, DEPTH_STENCIL_ATTACHMENT_WRITE for depth and stencil, or MEMORY_WRITE; true where "
        "there is none",
    ),
    Fact(
        "dependency.unavailable_writes",
        "LIST",
        "write accesses that they do not make available",
        "VkAccessFlagBits2",
    ),
    Fact(
        "dependency.waits_for_late_tests",
        "BOOL",
        "their source stages include LATE_FRAGMENT_TESTS, or a stage that contains it",
    ),
    Fact(
        "dependency.missing",
        "STRING",
        "what they lack for a multisampled attachment that is used again",
    ),
    Fact("dependency.subpass", "INT", "subpass that they lead into"),
    Fact(
        "dependency.multisampled",
        "BOOL",
        "that subpass is the first to use a multisampled attachment",
    ),
    Fact(
        "dependency.multisampled_depth_stencil",
        "BOOL",
        "that subpass is the first to use a multisampled depth-stencil attachment",
    ),
)
