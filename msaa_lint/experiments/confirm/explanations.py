"""Where the validation layer speaks and we rightly do not: what it overlooks, what our rules leave alone on purpose, and what follows from
another finding of ours."""

from __future__ import annotations

from typing import NamedTuple

_SINGLE = "an attachment of one sample is no matter of multisampling"


class Explanation(NamedTuple):
    """Why messages of a family are right to be without a finding: where `when`, a condition over the facts of a kind of subject, holds for
    one that the pass has. `wrong` where the layer is mistaken, else our rules mean to say nothing there."""

    family: str
    subject: str
    when: str
    reason: str
    wrong: bool = False


class Consequence(NamedTuple):
    """Messages that say again, in other words, what a finding of one of `rules` says. `ids` are families' names, or as in a family."""

    ids: tuple[str, ...]
    rules: tuple[str, ...]
    reason: str


EXPLANATIONS = (
    Explanation(
        "non-transient-ms-image",
        "image",
        "image.samples > 1 && (image.read || image.loaded)",
        "its samples are read or loaded outside the pass that draws them, which those of a transient attachment cannot be",
        wrong=True,
    ),
    Explanation(
        "should-be-transient",
        "image",
        "image.read || image.loaded",
        "another pass or a shader reads the image: the layer looks at one framebuffer",
        wrong=True,
    ),
    Explanation("should-be-transient", "image", "image.samples == 1", "an image of one sample is no matter of multisampling"),
    Explanation(
        "image-requires-memory",
        "aspect",
        'attachment.samples > 1 && aspect.store == "STORE" && aspect.read_later',
        "something reads the samples that are stored",
        wrong=True,
    ),
    Explanation("image-requires-memory", "attachment", "!attachment.used", "no subpass uses the attachment", wrong=True),
    Explanation(
        "image-requires-memory",
        "attachment",
        'attachment.format == "S8_UINT"',
        "loadOp and storeOp mean nothing for a format of stencil alone",
        wrong=True,
    ),
    Explanation("should-not-be-transient", "attachment", "!attachment.used", "no subpass uses the attachment", wrong=True),
    Explanation(
        "attachment-needs-readback",
        "aspect",
        'aspect.load == "LOAD" && device.immediate_mode',
        "the device that the description is for does not render tile by tile",
    ),
    Explanation(
        "attachment-needs-readback",
        "aspect",
        'attachment.is_resolve_target && aspect.load == "LOAD" && (aspect.read_before_resolve || pass.partial_area)',
        "what the resolve target holds is used before the resolve, or kept around it",
    ),
    Explanation(
        "too-large-sample-count",
        "image",
        "image.samples > 4 && image.samples <= device.max_efficient_samples",
        "the device that the description is for keeps its rate with as many",
    ),
    Explanation("discarded-then-loaded", "aspect", 'attachment.samples == 1 && aspect.load == "LOAD"', _SINGLE),
    Explanation("redundant-store", "aspect", 'attachment.samples == 1 && aspect.store == "STORE"', _SINGLE),
    Explanation(
        "redundant-store",
        "aspect",
        'aspect.store == "STORE" && aspect.read_later',
        "something reads what is stored; confirm draws no more than the passes, so that the layer sees nobody",
    ),
    Explanation(
        "redundant-store",
        "image",
        '"SAMPLED" in image.usage || "STORAGE" in image.usage || "TRANSFER_SRC" in image.usage',
        "its usage lets something read what is stored, and the description does not say what",
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
        "the device that the description is for is another vendor's",
    ),
    Explanation("amd-render-targets", "image", "!image.is_render_target", "nothing renders to the image", wrong=True),
    Explanation(
        "nvidia-linear-tiling",
        "image",
        'image.tiling == "LINEAR" && device.known && device.vendor != "nvidia"',
        "the device that the description is for is another vendor's",
    ),
    Explanation("nvidia-linear-tiling", "image", 'image.tiling == "LINEAR" && !image.is_render_target', "nothing renders to the image"),
    Explanation(
        "rasterization-samples",
        "pipeline",
        "pipeline.samples_dynamic && pipeline.rasterization_samples == pipeline.attachment_samples",
        "the count that is set dynamically is that of its attachments: the layer compares the one that the pipeline states",
        wrong=True,
    ),
    Explanation(
        "resolve-source-samples",
        "resolve",
        "resolve.single_sampled_render",
        "its source is multisampled while the pass draws; whether it may then have a resolve attachment is not settled",
    ),
    Explanation(
        "clear-values",
        "aspect",
        'aspect.name == "stencil" && aspect.load == "CLEAR"',
        "stencilLoadOp CLEAR takes a clear value too, which the layer does not count",
        wrong=True,
    ),
)

CONSEQUENCES = (
    Consequence(
        ("rasterization-samples", "00758"),
        ("mixed-sample-counts", "resolve-source-single-sampled"),
        "attachments that differ in their counts leave pipelines none to agree with",
    ),
    Consequence(("sample-count-unsupported", "04972"), ("multisampled-image-invalid",), "such an image can have one sample alone"),
    Consequence(
        ("attachment-needs-readback", "image-requires-memory"),
        ("load-from-undefined", "discarded-then-loaded"),
        "the load is what is wrong there",
    ),
    Consequence(("image-requires-memory",), ("resolve-target-multisampled",), "what is resolved to is stored, and should have one sample"),
    Consequence(
        ("attachment-needs-readback", "image-requires-memory", "discarded-then-loaded", "redundant-store"),
        ("transient-needs-memory",),
        "the operation that needs memory is what is wrong there",
    ),
    Consequence(
        ("non-transient-ms-image",),
        ("lazily-allocated-without-transient",),
        "the same usage is missing",
    ),
    Consequence(
        ("resolving-image",),
        ("resolve-source-single-sampled", "resolve-target-multisampled", "resolve-format-mismatch"),
        "the resolve itself is what is wrong there",
    ),
)
