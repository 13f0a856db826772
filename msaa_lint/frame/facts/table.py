"""Every fact that a rule may ask, with its type and meaning. `docs/facts.md` and `msaa-lint facts`
are made from this.

A fact that the input does not state is absent; a rule whose condition depends on an absent fact is
undecided.
"""

from __future__ import annotations

from .table_images import ASPECT, ATTACHMENT, IMAGE
from .table_passes import DEPENDENCY, PASS, RESOLVE, SUBPASS
from .table_pipelines import CHOICE, COPY, PIPELINE, READ
from .words import Fact

GLOBAL = (
    Fact("frame.width", "INT", "width of the frame in pixels"),
    Fact("frame.height", "INT", "height of the frame in pixels"),
    Fact("frame.fps", "DOUBLE", "frames per second"),
    Fact("frame.has_commands", "BOOL", "the description records commands"),
    Fact(
        "frame.api",
        "STRING",
        "API in whose terms the frame is described: VULKAN or METAL; never unknown",
        "api",
    ),
    Fact(
        "device.known",
        "BOOL",
        "the device is named or described, and is one device, not a class with guaranteed minimums",
    ),
    Fact(
        "device.minimum",
        "BOOL",
        "it is a class of devices: what it does not list is not guaranteed",
    ),
    Fact("device.name", "STRING", "name of the device"),
    Fact("device.vendor", "STRING", "vendor of the device", "vendor"),
    Fact("device.tiler", "BOOL", "it is a tile-based renderer"),
    Fact(
        "device.accelerates_float_blending",
        "BOOL",
        "it is a Mali GPU of the Valhall generation or later, by its name, which blends 16-bit "
        "floats in hardware; never unknown",
    ),
    Fact(
        "device.immediate_mode",
        "BOOL",
        "it is stated not to be a tile-based renderer; never unknown",
    ),
    Fact("device.lazy_memory", "BOOL", "it offers LAZILY_ALLOCATED memory"),
    Fact("device.lazy_memory_known", "BOOL", "its memory types are stated"),
    Fact(
        "device.max_efficient_samples",
        "INT",
        "largest sample count at full throughput: 4 unless the device states another",
    ),
    Fact("device.sample_rate_shading", "BOOL", "it supports the feature sampleRateShading"),
    Fact("device.metal_family", "STRING", "Metal: GPU family", "family"),
    Fact(
        "device.mixed_samples",
        "BOOL",
        "it offers VK_AMD_mixed_attachment_samples or VK_NV_framebuffer_mixed_samples, and what is "
        "enabled is not stated; never unknown",
    ),
    Fact(
        "device.single_sampled_render",
        "BOOL",
        "it offers VK_EXT_multisampled_render_to_single_sampled, and what is enabled is not "
        "stated; never unknown",
    ),
    Fact("enabled.sample_rate_shading", "BOOL", "the application enables sampleRateShading"),
    Fact("enabled.maintenance10", "BOOL", "the application enables maintenance10"),
    Fact("enabled.alpha_to_one", "BOOL", "the application enables alphaToOne"),
    Fact(
        "enabled.storage_image_multisample",
        "BOOL",
        "the application enables shaderStorageImageMultisample",
    ),
    Fact(
        "enabled.render_to_single_sampled",
        "BOOL",
        "the application enables multisampledRenderToSingleSampled",
    ),
    Fact(
        "enabled.depth_stencil_resolve",
        "BOOL",
        "Vulkan 1.2 or VK_KHR_depth_stencil_resolve is enabled, or offered if what is enabled is "
        "not stated",
    ),
    Fact(
        "enabled.mixed_samples",
        "BOOL",
        "VK_AMD_mixed_attachment_samples or VK_NV_framebuffer_mixed_samples is enabled; never "
        "unknown",
    ),
    Fact(
        "enabled.single_sampled_render",
        "BOOL",
        "the application enables multisampledRenderToSingleSampled; never unknown",
    ),
    Fact("scene.color", "STRING", "LDR or HDR", "scene color"),
    Fact("scene.peak", "DOUBLE", "brightest value, relative to display white"),
    Fact("scene.tone_mapping", "STRING", "where tone mapping happens", "tone mapping"),
    Fact(
        "scene.depth",
        "STRING",
        "direction of depth: with STANDARD 0 is near, with REVERSED 1 is near",
        "depth direction",
    ),
    Fact("scene.depth_resolve_wants", "STRING", "what the reader of resolved depth needs", "wants"),
)
"""The facts that every subject has."""

SUBJECTS: dict[str, tuple[Fact, ...]] = {
    "image": (*IMAGE, *GLOBAL),
    "attachment": (*ATTACHMENT, *IMAGE, *PASS, *GLOBAL),
    "aspect": (*ASPECT, *ATTACHMENT, *IMAGE, *PASS, *GLOBAL),
    "pass": (*PASS, *GLOBAL),
    "subpass": (*SUBPASS, *PASS, *GLOBAL),
    "resolve": (*RESOLVE, *PASS, *GLOBAL),
    "pipeline": (*PIPELINE, *SUBPASS, *PASS, *GLOBAL),
    "dependency": (*DEPENDENCY, *PASS, *GLOBAL),
    "read": (*READ, *GLOBAL),
    "copy": (*COPY, *GLOBAL),
    "choice": (*CHOICE, *GLOBAL),
}
"""The facts that a rule about each kind of subject may ask."""

PASS_PARTS = ("pass", "attachment", "aspect", "subpass", "resolve", "dependency")
"""The kinds of subjects that a frame runs only where a command begins their pass."""

FACTS: dict[str, Fact] = {fact.name: fact for facts in SUBJECTS.values() for fact in facts}
