"""Descriptions as texts: what is wrong in them, comments, anchors, long lines; findings with fixes,
prices and outputs of all kinds.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from .descriptions import (
    BEGINS,
    FRAME,
    IMAGES,
    PAIR,
    PASSES,
    TEXTURES,
    documents,
    many,
    names,
    program,
)
from .shape import Shape, text

DRAWN = ("images:", "  ms@: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}")
STORED = many(*DRAWN, *PASSES)
"""Passes that each store samples that nothing reads."""
RESOLVED = many(
    *IMAGES,
    *PASSES,
    "commands:",
    "- beginRenderPass: {renderPass: pass@}\n- endRenderPass\n- resolveImage: {srcImage: ms@, "
    "dstImage: one@}\n- readImage: {image: one@, stage: FRAGMENT}",
)
"""Resolves by command, whose fixes are structural."""
PIPELINES = many(
    *PAIR,
    "renderPasses:\n  pass: {attachments: {color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}}, "
    "subpasses: [{colorAttachments: [color]}]}",
    "pipelines:",
    "  p@: {renderPass: pass, subpass: 0, multisampleState: {rasterizationSamples: 4, "
    "sampleShadingEnable: true, minSampleShading: 4}}",
)
"""Pipelines whose fixes cost nothing."""
NAME = "a.msaa.yaml"


def outputs(
    name: str, content: Callable[[int], str], *arguments: str, codes: Sequence[int] = (0, 1)
) -> Shape:
    """A shape whose findings are reported in some way."""
    return Shape(name, text(NAME, content), ("check", "--isolated", *arguments, NAME), codes)


def commanded(name: str, content: Callable[[int], str], *arguments: str) -> Shape:
    """A shape that another command reads."""
    return Shape(name, text(NAME, content), (*arguments, "--isolated", NAME))


def one_line(count: int) -> str:
    """The same as JSON on one line."""
    images = names(
        '"ms@": {"format": "R8G8B8A8_UNORM", "samples": 4, "usage": ["COLOR_ATTACHMENT"]}', count
    )
    passes = names(
        '"pass@": {"attachments": {"color": {"image": "ms@", "loadOp": "CLEAR", "storeOp": '
        '"STORE"}}, "subpasses": [{"colorAttachments": ["color"]}]}',
        count,
    )
    return (
        f'{{"frame": {{"width": 64, "height": 64, "fps": 60}}, "images": {{{images}}}, '
        f'"renderPasses": {{{passes}}}}}'
    )


def files(content: str) -> Callable[[Path, int], None]:
    """Writes as many files with a text."""

    def write(folder: Path, count: int) -> None:
        for number in range(count):
            (folder / f"{number}.msaa.yaml").write_text(content, encoding="utf-8")

    return write


def wrong(name: str, *parts: str, codes: Sequence[int] = (2,)) -> Shape:
    """A shape whose text is wrong everywhere."""
    return Shape(name, text(NAME, many(*parts)), ("check", "--isolated", NAME), codes)


def vulkan_sc(count: int) -> str:
    """A Vulkan SC pipeline with many attachments, subpasses and dependencies."""
    attachment = (
        '{"format": "VK_FORMAT_R8G8B8A8_UNORM", "samples": "VK_SAMPLE_COUNT_4_BIT", '
        '"loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR", "storeOp": "VK_ATTACHMENT_STORE_OP_STORE"}'
    )
    subpass = (
        '{"pipelineBindPoint": "VK_PIPELINE_BIND_POINT_GRAPHICS", "colorAttachmentCount": 1, '
        '"pColorAttachments": [{"attachment": "@", "layout": "VK_IMAGE_LAYOUT_GENERAL"}]}'
    )
    dependency = (
        '{"srcSubpass": "VK_SUBPASS_EXTERNAL", "dstSubpass": "@", "srcStageMask": '
        '"VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT", "dstStageMask": '
        '"VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT"}'
    )
    return (
        '{"GraphicsPipelineState": {"Renderpass": {"sType": '
        '"VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO", '
        f'"attachmentCount": {count}, "pAttachments": [{names(attachment, count)}], "pSubpasses": '
        f"[{names(subpass, count)}], "
        f'"pDependencies": [{names(dependency, count)}]}}, "GraphicsPipeline": {{"subpass": '
        f'"0"}}}}}}'
    )


WRONG = (
    wrong(
        "misspelt names of images",
        *IMAGES,
        "renderPasses:",
        "  pass@: {attachments: {color: {image: ns@}}}",
    ),
    wrong(
        "misspelt names of attachments",
        *PAIR,
        "renderPasses:\n  pass:\n    attachments:",
        "      color@: {image: ms}",
        "    subpasses:",
        "    - {colorAttachments: [colour@]}",
    ),
    wrong(
        "misspelt keys", "images:", "  i@: {fromat: R8G8B8A8_UNORM, smaples: 4, usge: [], key@: 1}"
    ),
    wrong("misspelt sections", "imagse@: {}"),
    wrong(
        "misspelt enumerants",
        "images:",
        "  i@: {format: R8G8B8A8_UNROM@, usage: [COLOR_ATACHMENT], tiling: LINAER}",
    ),
    wrong("misspelt commands", *PAIR, "commands:", "- resolveImages@: {srcImage: ms}"),
    wrong("misspelt devices of documents", "device: mali-g7@\n---"),
    Shape(
        "misspelt names of documents",
        text(
            NAME,
            lambda count: "---\n".join(
                [
                    f"images: {{}}\nrenderPasses: {{p: {{attachments: {{c: {{image: "
                    f"color{number}}}}}}}}}\n"
                    for number in range(count)
                ]
            ),
        ),
        ("check", "--isolated", NAME),
        (2,),
    ),
    Shape(
        "misspelt keys of documents",
        text(
            NAME,
            lambda count: "---\n".join(
                [f"images: {{i: {{fromat{number}: X}}}}\n" for number in range(count)]
            ),
        ),
        ("check", "--isolated", NAME),
        (2,),
    ),
    Shape(
        "files with misspelt enumerants",
        files("images: {i: {format: R8G8B8A8_UNROM, usage: [COLOR_ATACHMENT]}}\n"),
        codes=(2,),
    ),
    wrong("wrong types", "images:", "  i@: {format: 4, samples: [], usage: {a: 1}, memory: null}"),
    wrong("duplicate keys", "images:", "  i: {} # @", codes=(0, 2)),
    wrong(
        "unknown keys of merges",
        "base: &base {unknown: 1}\nimages:",
        "  i@: {<<: *base, format: R8G8B8A8_UNORM}",
    ),
    wrong("merges of many unknown keys", "base: &base", "  key@: 1", "images:\n  i: {<<: *base}"),
    outputs(
        "merges",
        many(
            "x-base: &base {format: R8G8B8A8_UNORM, samples: 4}\nimages:",
            "  i@: {<<: *base, usage: [COLOR_ATTACHMENT]}",
        ),
        codes=(0, 1, 2),
    ),
    outputs(
        "anchors", many("images:", "  i@: &a@ {format: R8G8B8A8_UNORM, samples: 8}", "  j@: *a@")
    ),
    outputs(
        "aliases of one anchor",
        many("images:\n  i: &a {format: R8G8B8A8_UNORM, samples: 8}", "  j@: *a"),
    ),
    wrong(
        "unknown flags",
        "images:\n  i: {format: R8G8B8A8_UNORM, usage: [COLOR_ATTACHMENT]}\n  j:\n    usage:",
        "    - FLAG_@",
    ),
    outputs(
        "flags",
        many(
            "images:\n  i:\n    format: R8G8B8A8_UNORM\n    samples: 4\n    usage:",
            "    - COLOR_ATTACHMENT # @",
        ),
    ),
    Shape(
        "flags in one text",
        text(
            NAME,
            lambda count: f"images: {{i: {{usage: {'|'.join(['COLOR_ATTACHMENT'] * count)}}}}}\n",
        ),
        ("check", "--isolated", NAME),
    ),
    Shape(
        "unknown flags in one text",
        text(
            NAME,
            lambda count: f"images: {{i: {{usage: {names('F@', count).replace(', ', '|')}}}}}\n",
        ),
        ("check", "--isolated", NAME),
        (2,),
    ),
    Shape(
        "a long text",
        text(
            NAME,
            lambda count: (
                FRAME + f"device: {{name: {'x' * 64 * count}, vendor: {'y' * 64 * count}}}\n"
            ),
        ),
        ("check", "--isolated", NAME),
        (0, 1, 2),
    ),
    Shape(
        "nesting",
        text(
            NAME,
            lambda count: (
                FRAME
                + "".join(
                    "images:\n"[: 8 * (n == 0)] + f"  i{n}: {'[' * 90}{']' * 90}\n"
                    for n in range(count)
                )
            ),
        ),
        ("check", "--isolated", NAME),
        (2,),
    ),
    outputs("comments", many("# a comment, @", "images: {}", "# another, @")),
    outputs(
        "suppressions",
        many(
            *IMAGES[:1],
            "  ms@: {format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT]}  # msaa-lint: "
            "ignore[sample-count-above-four] known",
            "renderPasses: {}",
        ),
    ),
    outputs(
        "unused suppressions",
        many(
            "images:",
            "  one@: {format: R8G8B8A8_UNORM, samples: 1}  # msaa-lint: "
            "ignore[sample-count-above-four, no-rule-@] unused",
        ),
    ),
    Shape(
        "blank lines",
        text(NAME, lambda count: FRAME + "\n" * 64 * count + "images: {i: {samples: 8}}\n"),
        ("check", "--isolated", NAME),
    ),
    Shape(
        "lines that end with CR",
        text(NAME, lambda count: STORED(count).replace("\n", "\r")),
        ("check", "--isolated", "--output", "full", NAME),
    ),
)

REPORTED = (
    *(
        outputs(f"findings as {format}", STORED, "--output", format)
        for format in ("full", "json", "sarif", "github", "gitlab", "junit", "markdown")
    ),
    *(
        outputs(f"findings on one line as {format}", one_line, "--output", format)
        for format in ("full", "sarif")
    ),
    outputs(
        "findings suppressed and shown",
        lambda count: (
            STORED(count)
            .replace("storeOp: STORE", "storeOp: STORE")
            .replace("}}}, subpasses", "}}}, subpasses")
        ),
        "--show-suppressed",
        "--output",
        "sarif",
    ),
    outputs("statistics", STORED, "--statistics"),
    outputs(
        "undecided rules explained",
        many("images:", "  ms@: {samples: 4}", *PASSES),
        "--explain-undecided",
        codes=(0, 1),
    ),
    outputs(
        "undecided pipelines as JSON",
        many(
            *PAIR,
            "renderPasses:\n  pass: {attachments: {color: {image: ms}}, subpasses: "
            "[{colorAttachments: [color]}]}",
            "pipelines:",
            "  p@: {renderPass: pass}",
        ),
        "--output",
        "json",
    ),
    outputs("resolves with prices", RESOLVED, "--output", "sarif"),
    outputs("pipelines with prices", PIPELINES, "--output", "sarif"),
    outputs(
        "attachments with prices",
        many(
            *IMAGES,
            "renderPasses:\n  pass:\n    attachments:",
            "      color@: {image: ms@, loadOp: CLEAR, storeOp: STORE}",
            "      out@: {image: one@, loadOp: DONT_CARE, storeOp: STORE}",
            "    subpasses:",
            "    - {colorAttachments: [color@], resolveAttachments: [out@]}",
        ),
        "--output",
        "sarif",
    ),
    outputs("documents with prices", documents(*DRAWN, *PASSES), "--output", "sarif"),
    outputs(
        "Metal passes with prices",
        many(
            *TEXTURES,
            "  renderPasses:",
            "    pass@: {colorAttachments: [{texture: ms@, resolveTexture: one@, loadAction: "
            "clear, storeAction: storeAndMultisampleResolve}]}",
        ),
        "--output",
        "sarif",
    ),
    outputs("a cost limit", STORED, "--fail-on-cost", "1MB/s"),
    outputs("safe fixes", STORED, "--fix"),
    outputs("safe fixes on one line", one_line, "--fix"),
    outputs("unsafe fixes", RESOLVED, "--diff", "--unsafe-fixes"),
    outputs("fixes of pipelines", PIPELINES, "--diff", "--unsafe-fixes"),
    outputs(
        "fixes of aliases",
        many(
            "images:\n  ms: &ms {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, "
            "SAMPLED]}",
            "  ms@: *ms",
            *PASSES,
        ),
        "--diff",
        "--unsafe-fixes",
    ),
    outputs(
        "fixes that fail", many(*IMAGES, *PASSES, "commands:", BEGINS), "--diff", "--unsafe-fixes"
    ),
    outputs("fixes of kinds of frame", program(*DRAWN, *PASSES), "--diff"),
    outputs("fixes of documents", documents(*DRAWN, *PASSES), "--diff"),
    outputs(
        "unsafe fixes of documents",
        documents(
            *IMAGES,
            *PASSES,
            "commands:",
            "- beginRenderPass: {renderPass: pass@}\n- endRenderPass\n- resolveImage: {srcImage: "
            "ms@, dstImage: one@} # a comment\n- readImage: {image: one@, stage: FRAGMENT}",
        ),
        "--diff",
        "--unsafe-fixes",
    ),
    Shape("files", files(many(*PAIR)(1))),
    Shape("files with fixes", files(STORED(1))),
    commanded("costs", RESOLVED, "cost"),
    commanded(
        "costs as JSON",
        many(*IMAGES, *PASSES, "pipelines:", "  p@: {renderPass: pass@, subpass: 0}"),
        "cost",
        "--output",
        "json",
    ),
    Shape("facts", text(NAME, STORED), ("facts", NAME)),
    Shape("a Vulkan SC pipeline", text("a.json", vulkan_sc), ("check", "--isolated", "a.json")),
)

SHAPES = (*WRONG, *REPORTED)
