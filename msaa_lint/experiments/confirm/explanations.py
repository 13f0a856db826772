"""Messages of the validation layer that rightly have no finding: what the layer overlooks, what the
rules ignore on purpose, what follows from another finding, and noise about how `confirm` calls
Vulkan, the scene that it draws, or matters other than multisampling.
"""

from __future__ import annotations

from typing import NamedTuple

_SINGLE = "a single-sampled attachment is outside the scope of multisampling rules"


class Explanation(NamedTuple):
    """Why messages of a family rightly have no finding if `when`, a condition on the facts of a
    kind of subject, holds for a subject of the pass. `wrong` says that the layer is mistaken;
    otherwise the rules ignore it on purpose.
    """

    family: str
    subject: str
    when: str
    reason: str
    wrong: bool = False


class Consequence(NamedTuple):
    """Messages that follow from a finding of one of `rules`. `ids` are names of families, or ids as
    in a family.
    """

    ids: tuple[str, ...]
    rules: tuple[str, ...]
    reason: str


EXPLANATIONS = (
    Explanation(
        "non-transient-ms-image",
        "image",
        "image.samples > 1 && (image.read || image.loaded)",
        "its samples are read or loaded outside the pass that draws them, which is not possible "
        "for a transient attachment",
        wrong=True,
    ),
    Explanation(
        "non-transient-ms-image",
        "image",
        "image.samples > 1 && !image.is_render_target",
        "nothing renders to the image, so that it cannot be a transient attachment",
        wrong=True,
    ),
    Explanation(
        "should-be-transient",
        "image",
        "image.read || image.loaded",
        "another pass or a shader reads the image; the layer checks a single framebuffer",
        wrong=True,
    ),
    Explanation(
        "should-be-transient",
        "image",
        "image.samples == 1",
        "a single-sampled image is outside the scope of multisampling rules",
    ),
    Explanation(
        "image-requires-memory",
        "aspect",
        'attachment.samples > 1 && aspect.store == "STORE" && aspect.read_later',
        "the stored samples are read",
        wrong=True,
    ),
    Explanation(
        "image-requires-memory",
        "attachment",
        "!attachment.used",
        "no subpass uses the attachment",
        wrong=True,
    ),
    Explanation(
        "image-requires-memory",
        "attachment",
        'attachment.format == "S8_UINT"',
        "loadOp and storeOp have no meaning for a stencil-only format",
        wrong=True,
    ),
    Explanation(
        "should-not-be-transient",
        "attachment",
        "!attachment.used",
        "no subpass uses the attachment",
        wrong=True,
    ),
    Explanation(
        "attachment-needs-readback",
        "aspect",
        'aspect.load == "LOAD" && device.immediate_mode',
        "the described device does not render by tiles",
    ),
    Explanation(
        "attachment-needs-readback",
        "aspect",
        'attachment.is_resolve_target && aspect.load == "LOAD" && (aspect.read_before_resolve || '
        "pass.partial_area)",
        "the previous contents of the resolve target are used before the resolve or preserved "
        "around it",
    ),
    Explanation(
        "too-large-sample-count",
        "image",
        "image.samples > 4 && image.samples <= device.max_efficient_samples",
        "the described device keeps its full rate at that sample count",
    ),
    Explanation(
        "discarded-then-loaded",
        "aspect",
        'attachment.samples == 1 && aspect.load == "LOAD"',
        _SINGLE,
    ),
    Explanation(
        "redundant-store", "aspect", 'attachment.samples == 1 && aspect.store == "STORE"', _SINGLE
    ),
    Explanation(
        "redundant-store",
        "aspect",
        'aspect.store == "STORE" && aspect.read_later',
        "the stored contents are read; confirm draws only the passes, so the layer does not see "
        "the read",
    ),
    Explanation(
        "redundant-store",
        "image",
        '"SAMPLED" in image.usage || "STORAGE" in image.usage || "TRANSFER_SRC" in image.usage',
        "its usage allows the stored contents to be read, and the description does not say whether "
        "they are",
    ),
    Explanation(
        "resolving-image",
        "resolve",
        'resolve.kind == "command" && !resolve.pass_could_resolve',
        "no pass before the command could have resolved it",
        wrong=True,
    ),
    Explanation(
        "resolving-image",
        "resolve",
        'resolve.kind == "command" && resolve.aspect != "color" && !enabled.depth_stencil_resolve',
        "without depth-stencil resolves the pass could not have resolved it",
        wrong=True,
    ),
    Explanation(
        "amd-render-targets",
        "image",
        'device.known && device.vendor != "amd"',
        "the described device is another vendor's",
    ),
    Explanation(
        "amd-render-targets",
        "image",
        "image.samples == 1 && !image.resolved",
        "a single-sampled image to which nothing is resolved is outside the scope of multisampling "
        "rules",
    ),
    Explanation(
        "amd-render-targets",
        "image",
        "!image.is_render_target",
        "nothing renders to the image",
        wrong=True,
    ),
    Explanation(
        "layout-usage",
        "image",
        "image.samples == 1 || !image.is_render_target",
        "the usage that a copy or a single-sampled attachment requires is outside the scope of "
        "multisampling rules",
    ),
    Explanation(
        "nvidia-linear-tiling",
        "image",
        'image.tiling == "LINEAR" && device.known && device.vendor != "nvidia"',
        "the described device is another vendor's",
    ),
    Explanation(
        "multisampled-blending",
        "pipeline",
        "device.accelerates_float_blending && size(pipeline.blended_float_formats) > 0",
        "the described device blends 16-bit floats in hardware; the layer does not tell GPU "
        "generations apart",
    ),
    Explanation(
        "nvidia-linear-tiling",
        "image",
        'image.tiling == "LINEAR" && !image.is_render_target',
        "nothing renders to the image",
    ),
    Explanation(
        "rasterization-samples",
        "pipeline",
        "pipeline.samples_dynamic && pipeline.rasterization_samples == pipeline.attachment_samples",
        "the dynamically set count is that of its attachments; the layer compares the count stated "
        "in the pipeline",
        wrong=True,
    ),
    Explanation(
        "rasterization-samples",
        "pipeline",
        "device.single_sampled_render && pipeline.attachment_samples == 1",
        "the described device supports VK_EXT_multisampled_render_to_single_sampled, which allows "
        "it if it is enabled",
    ),
    Explanation(
        "rasterization-samples",
        "pipeline",
        "device.mixed_samples && pipeline.rasterization_samples > pipeline.attachment_samples",
        "the described device supports mixed samples, which allow it if they are enabled",
    ),
    Explanation(
        "resolve-source-samples",
        "resolve",
        "resolve.single_sampled_render",
        "its source is multisampled while the pass draws; the specification does not settle "
        "whether it may have a resolve attachment",
    ),
    Explanation(
        "clear-values",
        "aspect",
        'aspect.name == "stencil" && aspect.load == "CLEAR"',
        "stencilLoadOp CLEAR uses a clear value too, which the layer ignores",
        wrong=True,
    ),
)

CONSEQUENCES = (
    Consequence(
        ("rasterization-samples", "00758"),
        ("mixed-sample-counts", "resolve-source-single-sampled"),
        "no pipeline can match attachments with different sample counts",
    ),
    Consequence(
        ("sample-count-unsupported", "04972"),
        ("multisampled-image-invalid",),
        "such an image can only have one sample",
    ),
    Consequence(
        ("attachment-needs-readback", "image-requires-memory"),
        ("load-from-undefined", "discarded-then-loaded"),
        "the load itself is the mistake",
    ),
    Consequence(
        ("discarded-then-loaded",), ("load-from-undefined",), "the load itself is the mistake"
    ),
    Consequence(
        ("image-requires-memory",),
        ("resolve-target-multisampled",),
        "the resolve target is stored and should have one sample",
    ),
    Consequence(
        (
            "attachment-needs-readback",
            "image-requires-memory",
            "discarded-then-loaded",
            "redundant-store",
        ),
        ("transient-needs-memory",),
        "the operation that needs memory is the mistake",
    ),
    Consequence(
        (
            "attachment-needs-readback",
            "image-requires-memory",
            "discarded-then-loaded",
            "redundant-store",
        ),
        ("attachment-untouched",),
        "the pass does not use the attachment",
    ),
    Consequence(
        ("non-transient-ms-image",),
        ("lazily-allocated-without-transient",),
        "it lacks the same usage",
    ),
    Consequence(
        ("resolving-image",),
        ("resolve-source-single-sampled", "resolve-target-multisampled", "resolve-format-mismatch"),
        "the resolve itself is the mistake",
    ),
    Consequence(
        ("resolving-image",),
        ("depth-resolved-by-command",),
        "without maintenance10, the target's format needs the features of a color attachment",
    ),
)


class Noise(NamedTuple):
    """Messages that say nothing about the description, by parts of their ids, and why."""

    ids: tuple[str, ...]
    reason: str


_MEMORY = "confirm allocates memory for each image separately, as small as the image"
_SCENE = "confirm draws its own scene"
_VALUES = "confirm chooses the clear values"
_CALLS = "how confirm records and submits commands is not part of the description"
_START = "how confirm opens a device is not part of the description"
_OTHER = "it has nothing to do with multisampling"

NOISE = (
    Noise(
        ("vkAllocateMemory-small-allocation", "small-dedicated-allocation", "too-many-objects"),
        _MEMORY,
    ),
    Noise(("AllocateMemory-ReuseAllocations",), _MEMORY),
    Noise(
        (
            "AllocateMemory-SetPriority",
            "BindMemory-NoPriority",
            "CreateDevice-PageableDeviceLocalMemory",
        ),
        _MEMORY,
    ),
    Noise(("requirements-not-retrieved", "requirements-not-all-retrieved"), _MEMORY),
    Noise(
        ("VUID_Undefined",),
        "it is about the layer itself: its limited knowledge of an extension or a driver",
    ),
    Noise(
        (
            "specialuse-extension",
            "deprecated-extension",
            "extension-mismatch",
            "API-version-mismatch",
        ),
        _START,
    ),
    Noise(("physical-device-features-not-retrieved", "RobustBufferAccess"), _START),
    Noise(
        (
            "command-buffer-reset",
            "one-time-submit",
            "simultaneous-use",
            "AvoidSecondaryCmdBuffers",
            "unusable-secondary",
        ),
        _CALLS,
    ),
    Noise(
        (
            "pipeline-stage-flags",
            "CmdBuffer-highBarrierCount",
            "readToReadBarrier",
            "ImageBarrierAccessLayout",
        ),
        _CALLS,
    ),
    Noise(
        (
            "ReduceNumberOfSubmissions",
            "HighNumberOfFences",
            "HighNumberOfSemaphores",
            "vkImage-AvoidGeneral",
        ),
        _CALLS,
    ),
    Noise(
        ("TransitionUndefinedToReadOnly", "AvoidImageToImageCopy", "ClearAttachment-ClearImage"),
        _CALLS,
    ),
    Noise(
        (
            "multiple-pipelines-caches",
            "multiple-pipelines-no-cache",
            "TooManyPipelines",
            "Pipeline-SortAndBind",
        ),
        _CALLS,
    ),
    Noise(
        (
            "MinimizeNumDynamicStates",
            "CreatePipelinesLayout-KeepLayoutSmall",
            "CreatePipelineLayout",
        ),
        _CALLS,
    ),
    Noise(
        ("06193",),
        "the description begins with a resumed rendering: what it resumes is in a command buffer "
        "before",
    ),
    Noise(("SpirvDeprecated_WorkgroupSize",), "it is about a built-in shader of confirm"),
    Noise(
        ("redundant-attachment-on-tile", "depth-pre-pass-usage", "Zcull-LessGreaterRatio"), _SCENE
    ),
    Noise(("small-indexed-drawcalls", "SwitchTessGeometryMesh"), _SCENE),
    Noise(("Shader-OutputNotConsumed", "Shader-InputNotProduced"), _SCENE),
    Noise(
        (
            "ClearColor-NotCompressed",
            "ClearAttachment-FastClearValues",
            "ClearValueCountHigherThanAttachmentCount",
        ),
        _VALUES,
    ),
    Noise(("06662", "06663"), _OTHER),
    Noise(
        (
            "CreateImage-Depth32Format",
            "depthbias-zero",
            "DepthBiasNoAttachment",
            "AvoidPrimitiveRestart",
        ),
        _OTHER,
    ),
)
"""By topic. Every other message that belongs to no family is reported as the layer's alone."""
