"""The facts of pipelines, of the reads of their shaders, of copies, and of choices of a sample
count in source code.
"""

from __future__ import annotations

from .words import Fact

PIPELINE = (
    Fact("pipeline.name", "STRING", "name"),
    Fact(
        "pipeline.rasterization_samples",
        "INT",
        "rasterizationSamples; if it is dynamic state, what the commands set for all its draws; "
        "unknown if it rasterizes nothing",
    ),
    Fact("pipeline.samples_dynamic", "BOOL", "its sample count is dynamic state; never unknown"),
    Fact(
        "pipeline.attachment_samples",
        "INT",
        "sample count that its subpass or rendering requires: that of the attachments; with "
        "VK_AMD_mixed_attachment_samples the highest of "
        "them, with VK_NV_framebuffer_mixed_samples that of depth if it tests; unknown with a "
        "custom resolve",
    ),
    Fact(
        "pipeline.may_exceed_attachments",
        "BOOL",
        "VK_NV_framebuffer_mixed_samples allows it more samples than that; never unknown",
    ),
    Fact("pipeline.sample_shading", "BOOL", "sampleShadingEnable"),
    Fact(
        "pipeline.sample_shading_chosen",
        "BOOL",
        "another multisampled pipeline of its subpass, or for dynamic rendering, states "
        "sampleShadingEnable as off",
    ),
    Fact("pipeline.min_sample_shading", "DOUBLE", "minSampleShading"),
    Fact(
        "pipeline.shaded_samples",
        "INT",
        "fragment shader invocations per pixel that sample shading requires: "
        "max(ceil(minSampleShading * samples), 1)",
    ),
    Fact("pipeline.alpha_to_coverage", "BOOL", "alphaToCoverageEnable"),
    Fact("pipeline.alpha_to_one", "BOOL", "alphaToOneEnable; unknown if it is dynamic state"),
    Fact(
        "pipeline.blends_first",
        "BOOL",
        "blending is on for color attachment 0 and uses the shader's alpha, as far as factors and "
        "alphaToOneEnable are stated",
    ),
    Fact(
        "pipeline.dropped_samples",
        "INT",
        "samples below the sample count that sampleMask clears; 0 without a mask",
    ),
    Fact(
        "pipeline.blended_float_formats",
        "LIST",
        "formats of the float color attachments that it blends into and writes",
        "VkFormat",
    ),
    Fact("pipeline.rasterizer_discard", "BOOL", "rasterizerDiscardEnable"),
    Fact(
        "pipeline.module",
        "STRING",
        "module of its fragment shader, if it is stated and can be read",
    ),
    Fact(
        "pipeline.per_sample_reads",
        "LIST",
        "inputs of its fragment shader that force per-sample shading, or may: SampleId, "
        "SamplePosition, `sample` inputs; never unknown",
    ),
    Fact(
        "pipeline.sample_rate_capability",
        "BOOL",
        "its fragment shader's module declares SampleRateShading or InterpolationFunction; false "
        "if the module is not known; never unknown",
    ),
    Fact(
        "pipeline.shaded_per_sample",
        "BOOL",
        "its fragment shader reads SampleId or SamplePosition; never unknown",
    ),
    Fact(
        "pipeline.sample_shading_implied",
        "BOOL",
        "inputs of its fragment shader force per-sample shading, or may, and its state does not "
        "request that; never unknown",
    ),
    Fact(
        "pipeline.alpha_output",
        "BOOL",
        "its fragment shader has an alpha output at location 0, index 0",
    ),
    Fact("pipeline.alpha_written", "BOOL", "its fragment shader stores to that output"),
    Fact(
        "pipeline.alpha_constant",
        "DOUBLE",
        "the constant that it always stores to that output; unknown if there is none",
    ),
)

READ = (
    Fact("read.image", "STRING", "image or input attachment that a shader reads"),
    Fact("read.image_samples", "INT", "samples per texel of that image"),
    Fact("read.is_color", "BOOL", "its format has a color aspect"),
    Fact("read.numeric", "STRING", "numeric type of its color", "numeric"),
    Fact(
        "read.samples",
        "STRING",
        "which samples are fetched: ONE, ALL, OTHER; as stated, else as its shaders show",
        "samples read",
    ),
    Fact(
        "read.resolves",
        "STRING",
        "how they are combined; as stated, else as every shader that may read it shows",
        "resolves",
    ),
    Fact("read.pipeline", "STRING", "pipeline whose fragment shader reads it"),
    Fact("read.module", "STRING", "module of that shader"),
    Fact(
        "read.fetched_samples",
        "INT",
        "number N of samples that it fetches, if these are 0 to N - 1 by constants",
    ),
    Fact(
        "read.highest_sample",
        "INT",
        "highest sample that it always fetches, as far as constants decide",
    ),
    Fact(
        "read.as_all",
        "BOOL",
        "it always loops over those N samples, averages them, or takes their minimum or maximum, "
        "as if the image had no others",
    ),
    Fact(
        "read.alone",
        "BOOL",
        "the description has no pass, no format for the image, and does not say that it has one "
        "sample",
    ),
    Fact("read.on_tile", "BOOL", "the image is attached to the pass around the read"),
    Fact("read.writer", "STRING", "pass that last wrote the image before the read"),
    Fact(
        "read.pass_could_resolve",
        "BOOL",
        "that pass does not resolve it, and could; false if the pass around the read has it "
        "attached",
    ),
)

COPY = (
    Fact("copy.command", "STRING", "the command", "copy command"),
    Fact("copy.source", "STRING", "image that it reads; unknown for a buffer"),
    Fact("copy.target", "STRING", "image that it writes; unknown for a buffer"),
    Fact("copy.source_samples", "INT", "samples per texel of the image that it reads"),
    Fact("copy.target_samples", "INT", "samples per texel of the image that it writes"),
    Fact("copy.multisampled", "BOOL", "one of its images has more than one sample"),
    Fact("copy.counts_differ", "BOOL", "its two images differ in sample count"),
)

CHOICE = (
    Fact("choice.name", "STRING", "function or variable that holds the sample count"),
    Fact("choice.limits", "LIST", "members of VkPhysicalDeviceLimits that are queried"),
    Fact(
        "choice.combined",
        "STRING",
        "how their masks are combined; NONE for a single one",
        "combined",
    ),
    Fact(
        "choice.chosen",
        "STRING",
        "MAXIMUM: the greatest supported count; ATMOST: the greatest up to a stated one",
        "chosen",
    ),
    Fact(
        "choice.at_most",
        "INT",
        "greatest count that it may give: as stated, else by its tests; 64 without a bound",
    ),
    Fact(
        "choice.retested",
        "INT",
        "count whose bit an earlier test of the chain has already tested, for another count",
    ),
    Fact("choice.first_gives", "INT", "count that the earlier test gives"),
    Fact(
        "choice.never_given",
        "INTS",
        "counts of the branches behind later tests of that bit, which are never taken; never "
        "unknown",
    ),
    Fact("choice.depth_counts_asked", "BOOL", "its limits include the depth counts"),
    Fact("choice.stencil_counts_asked", "BOOL", "its limits include the stencil counts"),
    Fact(
        "choice.stencil_formats",
        "LIST",
        "formats with a stencil aspect among those of images that get the count",
        "VkFormat",
    ),
)
