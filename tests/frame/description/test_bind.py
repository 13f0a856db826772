"""Mistakes in a description: what is said, at which place, and what was meant."""

from __future__ import annotations

import time

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Description, Device, Image
from msaa_lint.frame.description.problems import MAX_PROBLEMS, Problem
from msaa_lint.input.readers import description
from tests.marked import unmarked


def read(text: str) -> Document:
    source = Source("frame.yaml", text)
    parsed = parse(source, Limits())
    assert not parsed.problems
    return description.read(source, parsed.documents[0])


def problems(text: str) -> tuple[Problem, ...]:
    return read(text).problems


def check(marked: str, code: str, message: str, help: str = "", path: str | None = None) -> None:
    """One mistake, at the mark, that says this."""
    text, spans = unmarked(marked)
    found = problems(text)
    assert [(p.code, p.message, p.help) for p in found] == [(code, message, help)]
    assert [p.span for p in found] == spans
    if path is not None:
        assert found[0].path == path


@pytest.mark.parametrize(
    ("marked", "message", "help", "path"),
    [
        (
            "⟦image⟧: {}",
            "unknown key `image` in the description: did you mean `images`?",
            "",
            "image",
        ),
        (
            "images: {a: {⟦formt⟧: D16_UNORM}}",
            "unknown key `formt` in images.a: did you mean `format`?",
            "",
            "images.a.formt",
        ),
        (
            "images: {a: {⟦Format⟧: D16_UNORM}}",
            "unknown key `Format` in images.a: did you mean `format`?",
            "",
            "images.a.Format",
        ),
        (
            "images: {a: {⟦sample⟧: 4}}",
            "unknown key `sample` in images.a: did you mean `samples`?",
            "",
            "images.a.sample",
        ),
        (
            "scene: {⟦qqq⟧: 1}",
            "unknown key `qqq` in scene: expected one of edges, depth, color, peak, "
            "depthResolveWants, "
            "toneMapping, alphaTest, textureDetail, overdraw, triangleSize, shading",
            "",
            "scene.qqq",
        ),
        (
            "renderPasses: {r: {subpasses: [{⟦colorAttachment⟧: [0]}]}}",
            "unknown key `colorAttachment` in renderPasses.r.subpasses[0]: did you mean "
            "`colorAttachments`?",
            "",
            "renderPasses.r.subpasses[0].colorAttachment",
        ),
        (
            "renderPasses: {r: {⟦pAttachments⟧: []}}",
            "unknown key `pAttachments` in renderPasses.r: did you mean `attachments`?",
            "",
            "renderPasses.r.pAttachments",
        ),
        (
            "pipelines: {p: {multisampleState: {⟦minSampleShadin⟧: 1.0}}}",
            "unknown key `minSampleShadin` in pipelines.p.multisampleState: did you mean "
            "`minSampleShading`?",
            "",
            "pipelines.p.multisampleState.minSampleShadin",
        ),
        (
            "commands: [{⟦beginRenderpass⟧: {}}]",
            "unknown command `beginRenderpass`: did you mean `beginRenderPass`?",
            "",
            "commands[0]",
        ),
        (
            "commands: [⟦nextsubpass⟧]",
            "unknown command `nextsubpass`: did you mean `nextSubpass`?",
            "",
            "commands[0]",
        ),
        (
            'images: {a: {⟦"a b\\n"⟧: 1}}',
            "unknown key `a b\n` in images.a: it contains the invisible character U+000A; write "
            "ordinary spaces, or delete it",
            None,
            None,
        ),
    ],
)
def test_unknown_keys(marked: str, message: str, help: str | None, path: str | None) -> None:
    if help is None:
        text, spans = unmarked(marked)
        (found,) = problems(text)
        assert (found.code, found.message, found.span) == ("MSAA902", message, spans[0])
        assert found.help == ""
    else:
        check(marked, "MSAA902", message, help, path)


def test_unknown_command_without_a_near_one() -> None:
    text, spans = unmarked("commands: [{⟦xyz⟧: {}}]")
    (found,) = problems(text)
    assert found.span == spans[0]
    assert found.message.startswith(
        "unknown command `xyz`: expected one of beginRenderPass, nextSubpass, "
    )


IS_NO = "MSAA903"


@pytest.mark.parametrize(
    ("marked", "message", "help"),
    [
        # Of another kind.
        (
            "images: ⟦[⟧]",
            "`images` must be a mapping by name, found a list; write `name: {...}` for each entry, "
            "without `- `",
            "",
        ),
        ("images: ⟦4⟧", "`images` must be a mapping by name, found `4`", ""),
        (
            "images: {a: ⟦[⟧{}]}",
            "`images.a` must be a mapping, found a list; its keys are format, samples, usage, "
            "memory, "
            "presentable, extent, mipLevels, arrayLayers, imageType, tiling, flags, sharingMode, "
            "initialLayout, encoding, mayBeRead, pNext",
            "",
        ),
        (
            "images: {a: {usage: ⟦{⟧}}}",
            "`usage` must be a list of VkImageUsageFlagBits, found a mapping",
            "",
        ),
        (
            "images: {a: {usage: {⟦SAMPLED⟧: true}}}",
            "`usage` must be a list of VkImageUsageFlagBits, found a mapping",
            "",
        ),
        (
            "images: {a: {usage: [⟦[⟧SAMPLED]]}}",
            "`usage[0]` must be a VkImageUsageFlagBits, found a list; write `SAMPLED`, without "
            "brackets",
            "",
        ),
        (
            "images: {a: {format: ⟦[⟧D16_UNORM]}}",
            "`format` must be a VkFormat, found a list; write `D16_UNORM`, without brackets",
            "",
        ),
        (
            "renderPasses: {r: {subpasses: {⟦a⟧: 1}}}",
            "`renderPasses.r.subpasses` must be a list, found a mapping; begin each item with `- "
            "`, or write `[{...}]`",
            "",
        ),
        ("commands: ⟦draw⟧", "`commands` must be a list, found `draw`; write `[draw]`", ""),
        ("commands: [⟦4⟧]", "`commands[0]` must be one command, found `4`", ""),
        (
            "commands: [{⟦draw⟧: {}, present: {}}]",
            "`commands[0]` must be one command, found a mapping; write `- ` before `present`",
            "",
        ),
        (
            "device: ⟦[⟧]",
            "`device` must be a mapping or a string, found a list; write one value, without "
            "brackets",
            "",
        ),
        ("device: ⟦4⟧", "`device` must be a mapping or a string, found `4`", ""),
        # Null is no value, and no unknown one.
        (
            "frame: ⟦null⟧",
            "`frame` must be a mapping, found null; leave it out if it is unknown",
            "",
        ),
        (
            "images: {a: {samples: ⟦~⟧}}",
            "`samples` must be 1, 2, 4, 8, 16, 32 or 64, found null; leave it out if it is unknown",
            "",
        ),
        (
            "images: {a: {format: ⟦null⟧}}",
            "`format` must be a VkFormat, found null; leave it out if it is unknown",
            "",
        ),
        (
            "images: {a: {usage: ⟦null⟧}}",
            "`usage` must be a list of VkImageUsageFlagBits, found null; leave it out if it is "
            "unknown",
            "",
        ),
        (
            "images: {a: {usage: [⟦null⟧]}}",
            "`usage[0]` must be a VkImageUsageFlagBits, found null; leave it out if it is unknown",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [⟦null⟧]}}",
            "`renderPasses.r.attachments[0]` must be a mapping, found null; leave it out if it is "
            "unknown",
            "",
        ),
        (
            "renderPasses: {r: {subpasses: [⟦null⟧]}}",
            "`renderPasses.r.subpasses[0]` must be a mapping, found null; leave it out if it is "
            "unknown",
            "",
        ),
        ("commands: [⟦null⟧]", "`commands[0]` must be one command, found null", ""),
        (
            "commands: [⟦draw⟧: null]",
            "the command `draw` needs parameters; write `draw: {pipeline: ...}`",
            "",
        ),
        (
            "commands: [⟦draw⟧]",
            "the command `draw` needs parameters; write `draw: {pipeline: ...}`",
            "",
        ),
        (
            "scene: {depth: ⟦null⟧}",
            "`depth` must be STANDARD or REVERSED, found null; leave it out if it is unknown",
            "",
        ),
        # Booleans of YAML 1.1, and numbers where texts are due.
        (
            "images: {a: {presentable: ⟦yes⟧}}",
            "`presentable` must be true or false, found `yes`; write `true`",
            "",
        ),
        (
            "images: {a: {presentable: ⟦Off⟧}}",
            "`presentable` must be true or false, found `Off`; write `false`",
            "",
        ),
        (
            "images: {a: {presentable: ⟦'no'⟧}}",
            "`presentable` must be true or false, found `no`; write `false`",
            "",
        ),
        (
            "images: {a: {presentable: ⟦1⟧}}",
            "`presentable` must be true or false, found `1`; write `true`",
            "",
        ),
        (
            "enabled: {apiVersion: ⟦1.2⟧}",
            '`apiVersion` must be a string, found `1.2`; write "1.2"',
            "",
        ),
        (
            "enabled: {extensions: [⟦true⟧]}",
            '`extensions[0]` must be a string, found `true`; write "true"',
            "",
        ),
        (
            "pipelines: {p: {renderPass: ⟦1.5⟧}}",
            '`renderPass` must be the name of an entry of `renderPasses`, found `1.5`; write "1.5"',
            "",
        ),
        # Names that no enum, and words that no list has.
        (
            "images: {a: {format: ⟦RGBA8⟧}}",
            "`format` must be a VkFormat, found `RGBA8`; did you mean `R8G8B8A8_UNORM`?",
            "",
        ),
        (
            "images: {a: {format: ⟦r8g8b8a8_unorm⟧}}",
            "`format` must be a VkFormat, found `r8g8b8a8_unorm`; did you mean `R8G8B8A8_UNORM`?",
            "",
        ),
        (
            "images: {a: {format: ⟦37⟧}}",
            "`format` must be a VkFormat, found `37`; did you mean `R8G8B8A8_UNORM`?",
            "",
        ),
        (
            "images: {a: {usage: [SAMPLED, ⟦TRANSIENT⟧]}}",
            "`usage[1]` must be a VkImageUsageFlagBits, found `TRANSIENT`; did you mean "
            "`TRANSIENT_ATTACHMENT`?",
            "",
        ),
        (
            "images: {a: {usage: ⟦SAMPLED | TRANSIENT⟧}}",
            "`usage` must be a VkImageUsageFlagBits, found `TRANSIENT`; did you mean "
            "`TRANSIENT_ATTACHMENT`?",
            "",
        ),
        (
            "images: {a: {usage: ⟦16⟧}}",
            "`usage` must be a list of VkImageUsageFlagBits, found `16`",
            "",
        ),
        (
            "images: {a: {encoding: ⟦SRGB⟧}}",
            "`encoding` must be one of LINEAR, GAMMA, DATA, found `SRGB`; did you mean `GAMMA`?",
            "",
        ),
        (
            "scene: {depth: ⟦reversed⟧}",
            "`depth` must be STANDARD or REVERSED, found `reversed`; did you mean `REVERSED`?",
            "",
        ),
        ("device: {vendor: ⟦ARMM⟧}", None, ""),
        ("device: {vendor: ⟦Arm Ltd⟧}", None, ""),
        (
            "renderPasses: {r: {attachments: [{storeOp: ⟦DONT_CAER⟧}]}}",
            "`storeOp` must be a VkAttachmentStoreOp, found `DONT_CAER`; did you mean `DONT_CARE`?",
            "",
        ),
        (
            "commands: [readImage: {stage: ⟦FRAGMNT⟧}]",
            "`stage` must be a VkShaderStageFlagBits or VkPipelineStageFlagBits2, found `FRAGMNT`; "
            "did you mean `FRAGMENT`?",
            "",
        ),
        (
            "renderPasses: {r: {dependencies: [{srcSubpass: ⟦EXTERN⟧}]}}",
            "`srcSubpass` must be EXTERNAL or the index of a subpass, found `EXTERN`; did you mean "
            "`EXTERNAL`?",
            "",
        ),
        # Numbers out of their range.
        (
            "images: {a: {samples: ⟦3⟧}}",
            "`samples` must be 1, 2, 4, 8, 16, 32 or 64, found `3`",
            "",
        ),
        (
            "images: {a: {samples: ⟦SAMPLE_COUNT_٤⟧}}",
            "`samples` must be 1, 2, 4, 8, 16, 32 or 64, found `SAMPLE_COUNT_٤`",
            "",
        ),
        (
            "images: {a: {samples: ⟦4.0⟧}}",
            "`samples` must be 1, 2, 4, 8, 16, 32 or 64, found `4.0`; write `4`",
            "",
        ),
        (
            "images: {a: {samples: ⟦true⟧}}",
            "`samples` must be 1, 2, 4, 8, 16, 32 or 64, found `true`",
            "",
        ),
        (
            "images: {a: {mipLevels: ⟦0⟧}}",
            "`mipLevels` must be an integer from 1 to 2147483647, found `0`",
            "",
        ),
        (
            "images: {a: {mipLevels: ⟦1.0⟧}}",
            "`mipLevels` must be an integer from 1 to 2147483647, found `1.0`",
            "",
        ),
        (
            "frame: {width: ⟦2147483648⟧}",
            "`width` must be an integer from 1 to 2147483647, found `2147483648`",
            "",
        ),
        ("frame: {fps: ⟦0⟧}", "`fps` must be a number above 0, found `0`", ""),
        ("frame: {fps: ⟦-60.0⟧}", "`fps` must be a number above 0, found `-60.0`", ""),
        ("frame: {fps: ⟦.inf⟧}", "`fps` must be a finite number, found `.inf`", ""),
        ("frame: {fps: ⟦.nan⟧}", "`fps` must be a finite number, found `.nan`", ""),
        ("frame: {fps: ⟦1e999⟧}", "`fps` must be a finite number, found `1e999`", ""),
        ("frame: {fps: ⟦sixty⟧}", "`fps` must be a finite number, found `sixty`", ""),
        ("frame: {fps: ⟦true⟧}", "`fps` must be a finite number, found `true`", ""),
        (
            "pipelines: {p: {multisampleState: {sampleMask: [⟦-1⟧]}}}",
            "`sampleMask[0]` must be an integer from 0 to 4294967295, found `-1`",
            "",
        ),
        ("pipelines: {p: {multisampleState: {sampleMask: [⟦0x100000000⟧]}}}", None, ""),
        (
            "pipelines: {p: {stages: [{specialization: {⟦id⟧: 4}}]}}",
            "the keys of `pipelines.p.stages[0].specialization` must be integers, found `id`",
            "",
        ),
        ("commands: [readImage: {samples: ⟦4⟧}]", "`samples` must be 1 or ALL, found `4`", ""),
        ("commands: [readImage: {samples: ⟦1.0⟧}]", "`samples` must be 1 or ALL, found `1.0`", ""),
        (
            "commands: [readImage: {samples: ⟦true⟧}]",
            "`samples` must be 1 or ALL, found `true`",
            "",
        ),
        # Costs of shading.
        (
            "scene: {shading: ⟦meduim⟧}",
            "`shading` must be none, light, medium, heavy, or a cost of at most 1000000ops, "
            "1000000000ns or 1000ms, found `meduim`; "
            "did you mean `medium`?",
            "",
        ),
        *(
            (f"scene: {{shading: ⟦{text}⟧}}", None, "")
            for text in ("1000001", "1.5ops", "1001ms", "-1", "1.5", "true", "1e99ms")
        ),
        # Attachments.
        (
            "renderPasses: {r: {subpasses: [{colorAttachments: [⟦true⟧]}]}}",
            "`colorAttachments[0]` must be an attachment (a name, an index, {attachment, layout} "
            "or null), found `true`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{colorAttachments: [⟦-1⟧]}]}}",
            "`colorAttachments[0]` must be an attachment (a name, an index, {attachment, layout} "
            "or null), found `-1`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{depthStencilAttachment: "
            "{attachment: ⟦-1⟧}}]}}",
            "`attachment` must be an integer from 0 to 4294967295, found `-1`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}, {}]}}\nframebuffers: {f: {renderPass: r, "
            "attachments: ⟦[a]⟧}}\nimages: {a: {}}",
            "`attachments` has 1 image, but render pass `r` has 2 attachments (0, 1); list one "
            "image for each",
            "",
        ),
    ],
)
def test_wrong_values(marked: str, message: str | None, help: str) -> None:
    text, spans = unmarked(marked)
    found = problems(text)
    assert [p.code for p in found] == [IS_NO]
    assert [p.span for p in found] == spans
    if message is not None:
        assert found[0].message == message
    assert found[0].help == help


SECTIONS = f"its keys are {', '.join(Description.SHAPE)}"


def test_a_document_that_is_no_mapping() -> None:
    check(
        "⟦[⟧1, 2]",
        "MSAA903",
        f"the description must be a mapping, found a list; {SECTIONS}",
        "",
        "",
    )
    check(
        "⟦just words⟧",
        "MSAA903",
        f"the description must be a mapping, found `just words`; {SECTIONS}",
        "",
        "",
    )


R = "renderPasses: {r: {attachments: {color: {}, depth: {}}, subpasses: [{}], dependencies: []}}\n"


@pytest.mark.parametrize(
    ("marked", "message", "help", "path"),
    [
        # Names of sections.
        (
            "images: {color: {}}\nrenderPasses: {r: {attachments: [{image: ⟦colour⟧}]}}",
            "`image` names `colour`, which is not in `images`; did you mean `color`?",
            "",
            "renderPasses.r.attachments[0].image",
        ),
        (
            "images: {a: {}, b: {}}\nrenderPasses: {r: {attachments: [{image: ⟦xyz⟧}]}}",
            "`image` names `xyz`, which is not in `images`; write one of a, b",
            "",
            "renderPasses.r.attachments[0].image",
        ),
        (
            "renderPasses: {r: {attachments: [{image: ⟦x⟧}]}}",
            "`image` names `x`, which is not in `images`; the description has no `images`",
            "",
            None,
        ),
        (
            f"{R}framebuffers: {{f: {{renderPass: ⟦rr⟧}}}}",
            "`renderPass` names `rr`, which is not in `renderPasses`; write one of r",
            "",
            "framebuffers.f.renderPass",
        ),
        (
            "images: {i0: {}}\nframebuffers: {f: {attachments: [i0, ⟦i1⟧, null]}}",
            "`attachments[1]` names `i1`, which is not in `images`; write one of i0",
            "",
            "framebuffers.f.attachments[1]",
        ),
        (
            "pipelines: {p: {renderPass: ⟦r⟧}}",
            "`renderPass` names `r`, which is not in `renderPasses`; the description has no "
            "`renderPasses`",
            "",
            "pipelines.p.renderPass",
        ),
        (
            "pipelines: {p: {renderPass: ⟦4⟧}}",
            "`renderPass` names `4`, which is not in `renderPasses`; the description has no "
            "`renderPasses`",
            "",
            "pipelines.p.renderPass",
        ),
        (
            "commands: [beginRenderPass: {renderPass: ⟦r⟧}]",
            "`renderPass` names `r`, which is not in `renderPasses`; the description has no "
            "`renderPasses`",
            "",
            "commands[0].beginRenderPass.renderPass",
        ),
        (
            f"{R}commands: [beginRenderPass: {{renderPass: r, framebuffer: ⟦fb⟧}}]",
            "`framebuffer` names `fb`, which is not in `framebuffers`; the description has no "
            "`framebuffers`",
            "",
            None,
        ),
        (
            f"{R}framebuffers: {{f0: {{}}}}\ncommands: [beginRenderPass: {{renderPass: r, "
            f"framebuffer: [f0, ⟦f1⟧]}}]",
            "`framebuffer[1]` names `f1`, which is not in `framebuffers`; write one of f0",
            "",
            "commands[0].beginRenderPass.framebuffer[1]",
        ),
        (
            "commands: [draw: {pipeline: ⟦p⟧}]",
            "`pipeline` names `p`, which is not in `pipelines`; the description has no `pipelines`",
            "",
            "commands[0].draw.pipeline",
        ),
        (
            "commands: [beginRendering: {colorAttachments: [{image: ⟦i⟧}]}]",
            "`image` names `i`, which is not in `images`; the description has no `images`",
            "",
            "commands[0].beginRendering.colorAttachments[0].image",
        ),
        (
            "images: {i: {}}\ncommands: [beginRendering: {depthAttachment: {image: i, "
            "resolveImage: ⟦j⟧}}]",
            "`resolveImage` names `j`, which is not in `images`; write one of i",
            "",
            "commands[0].beginRendering.depthAttachment.resolveImage",
        ),
        (
            "images: {i: {}}\ncommands: [resolveImage: {srcImage: i, dstImage: ⟦j⟧}]",
            "`dstImage` names `j`, which is not in `images`; write one of i",
            "",
            None,
        ),
        (
            "images: {i: {}}\ncommands: [pipelineBarrier: {images: [i, ⟦j⟧]}]",
            "`images[1]` names `j`, which is not in `images`; write one of i",
            "",
            None,
        ),
        (
            "images: {i: {}}\ncommands: [pipelineBarrier: {images: [{image: ⟦j⟧}]}]",
            "`image` names `j`, which is not in `images`; write one of i",
            "",
            "commands[0].pipelineBarrier.images[0].image",
        ),
        # Attachments of the pass.
        (
            "renderPasses: {r: {attachments: {color: {}}, subpasses: [{colorAttachments: "
            "[⟦colour⟧]}]}}",
            "`colorAttachments[0]` names `colour`, which is not an attachment of render pass `r`; "
            "did you mean `color`?",
            "",
            "renderPasses.r.subpasses[0].colorAttachments[0]",
        ),
        (
            "renderPasses: {r: {attachments: [{}, {}], subpasses: [{resolveAttachments: [⟦2⟧]}]}}",
            "`resolveAttachments[0]` is 2, but render pass `r` has 2 attachments, counted from 0; "
            "write 0 to 1",
            "",
            "renderPasses.r.subpasses[0].resolveAttachments[0]",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{inputAttachments: [{attachment: "
            "⟦1⟧}]}]}}",
            "`inputAttachments[0]` is 1, but render pass `r` has 1 attachment, counted from 0; "
            "write 0",
            "",
            None,
        ),
        (
            "renderPasses: {r: {subpasses: [{depthStencilAttachment: ⟦depth⟧}]}}",
            "`depthStencilAttachment` names `depth`, which is not an attachment of render pass "
            "`r`; the "
            "description has no `renderPasses.r.attachments`",
            "",
            "renderPasses.r.subpasses[0].depthStencilAttachment",
        ),
        (
            "renderPasses: {r: {attachments: {d: {}}, subpasses: [{depthStencilResolve: "
            "{attachment: ⟦e⟧}}]}}",
            "`attachment` names `e`, which is not an attachment of render pass `r`; write one of d",
            "",
            "renderPasses.r.subpasses[0].depthStencilResolve.attachment",
        ),
        (
            "renderPasses: {r: {attachments: {d: {}}, subpasses: [{preserveAttachments: [d, "
            "⟦e⟧]}]}}",
            "`preserveAttachments[1]` names `e`, which is not an attachment of render pass `r`; "
            "write one of d",
            "",
            "renderPasses.r.subpasses[0].preserveAttachments[1]",
        ),
        # Subpasses.
        (
            f"{R}pipelines: {{p: {{renderPass: r, subpass: ⟦1⟧}}}}",
            "`subpass` is 1, but render pass `r` has 1 subpass, counted from 0; write 0",
            "",
            "pipelines.p.subpass",
        ),
        (
            "renderPasses: {r: {subpasses: [{}], dependencies: [{srcSubpass: EXTERNAL, dstSubpass: "
            "⟦1⟧}]}}",
            "`dstSubpass` is 1, but render pass `r` has 1 subpass, counted from 0; write 0",
            "",
            "renderPasses.r.dependencies[0].dstSubpass",
        ),
        # The device.
        ("device: ⟦mali-g7⟧", "unknown device `mali-g7`; did you mean `mali-g76`?", "", "device"),
    ],
)
def test_dangling_references(marked: str, message: str, help: str, path: str | None) -> None:
    check(marked, "MSAA904", message, help, path)


def test_a_device_that_nothing_is_near_to() -> None:
    (found,) = problems("device: qqqqqq")
    assert found.code == "MSAA904"
    assert found.message.startswith("unknown device `qqqqqq`; write one of mali-g76, ")


@pytest.mark.parametrize(
    "written",
    [
        "null",
        "4294967295",
        "VK_ATTACHMENT_UNUSED",
        "UNUSED",
        "{attachment: null}",
        "{attachment: 4294967295}",
    ],
)
def test_an_unused_attachment(written: str) -> None:
    document = read(
        f"renderPasses: {{r: {{subpasses: [{{colorAttachments: [{written}], "
        f"depthStencilAttachment: {written}}}]}}}}"
    )
    assert document.problems == ()
    subpass = document.description.renderPasses["r"].subpasses[0]
    assert subpass.colorAttachments[0].attachment is None
    assert (
        subpass.depthStencilAttachment is not None
        and subpass.depthStencilAttachment.attachment is None
    )


def test_the_layout_of_a_depth_resolve_is_that_of_its_reference() -> None:
    resolve = "depthStencilResolve: {attachment: d, layout: GENERAL, depthResolveMode: MIN}"
    document = read(
        f"renderPasses: {{r: {{attachments: {{d: {{}}}}, subpasses: [{{{resolve}}}]}}}}"
    )
    assert document.problems == ()
    read_resolve = document.description.renderPasses["r"].subpasses[0].depthStencilResolve
    assert read_resolve is not None and read_resolve.attachment is not None
    assert (read_resolve.attachment.attachment, read_resolve.attachment.layout) == ("d", "GENERAL")


def test_many_dangling_references_take_little_time() -> None:
    count = 5000
    attachments = "".join(f"      attachment_{n}: {{image: imagine_{n}}}\n" for n in range(count))
    images = "".join(f"  image_{n}: {{}}\n" for n in range(count))
    references = ", ".join(f"attachmnt_{n}" for n in range(count))
    text = (
        f"images:\n{images}renderPasses:\n  r:\n    attachments:\n{attachments}    subpasses: "
        f"[{{inputAttachments: [{references}]}}]\n"
    )
    begin = time.process_time()
    assert len(problems(text)) == MAX_PROBLEMS
    assert time.process_time() - begin < 10


@pytest.mark.parametrize("written", ["EXTERNAL", "VK_SUBPASS_EXTERNAL", "4294967295"])
def test_the_subpass_outside(written: str) -> None:
    document = read(f"renderPasses: {{r: {{dependencies: [{{srcSubpass: {written}}}]}}}}")
    assert document.problems == ()
    assert document.description.renderPasses["r"].dependencies[0].srcSubpass == "EXTERNAL"


def test_a_name_that_looks_like_an_index_is_a_name_in_every_spelling() -> None:
    text = """
    renderPasses:
      r:
        attachments: {"1": {samples: 1}, "0": {samples: 4}}
        subpasses: [{colorAttachments: ["1", {attachment: "1"}, 1, {attachment: 1}]}]
    """
    document = read(text)
    assert document.problems == ()
    assert [
        each.attachment
        for each in document.description.renderPasses["r"].subpasses[0].colorAttachments
    ] == ["1", "1", 1, 1]


@pytest.mark.parametrize("written", ["amd", "AMD", "Amd"])
def test_a_vendor_in_any_case(written: str) -> None:
    document = read(f"device: {{vendor: {written}}}")
    assert document.problems == ()
    assert isinstance(document.description.device, Device)
    assert document.description.device.vendor == "amd"


def test_numbers_may_be_names() -> None:
    text = """
    images: {0: {}}
    framebuffers: {0: {}}
    renderPasses: {r: {attachments: [{image: 0}]}}
    commands: [beginRenderPass: {framebuffer: 0}]
    """
    assert read(text).problems == ()


def test_every_mistake_is_told_up_to_a_limit() -> None:
    text = "images:\n" + "".join(f"  i{n}: {{samples: 3, formt: 1}}\n" for n in range(100))
    found = problems(text)
    assert len(found) == MAX_PROBLEMS
    assert {p.code for p in found} == {"MSAA902", "MSAA903"}


def test_what_is_wrong_is_unknown_and_the_rest_is_read() -> None:
    document = read("images: {a: {samples: 3, format: D16_UNORM, usage: [NOPE]}}")
    image = document.description.images["a"]
    assert (image.samples, image.format, image.usage) == (None, "D16_UNORM", None)
    assert [p.code for p in document.problems] == ["MSAA903", "MSAA903"]


def test_absent_members_are_unknown_or_none() -> None:
    described: Description = read(
        "images: {a: {}}\nrenderPasses: {r: {attachments: [{}], subpasses: [{}]}}\npipelines: {p: "
        "{colorBlendState: {attachments: [{}]}}}"
    ).description
    image, attachment = described.images["a"], described.renderPasses["r"].attachments[0]
    subpass = described.renderPasses["r"].subpasses[0]
    assert (image.usage, image.memory, image.samples, image.presentable, image.flags) == (
        None,
        None,
        None,
        None,
        (),
    )
    assert (attachment.loadOp, attachment.storeOp, attachment.initialLayout) == (None, None, None)
    assert (
        subpass.colorAttachments,
        subpass.resolveAttachments,
        subpass.flags,
        subpass.viewMask,
    ) == ((), (), (), None)
    blend = described.pipelines["p"].colorBlendState
    assert blend is not None and blend.attachments[0].colorWriteMask is None
    assert described.commands is None


def test_flags_are_read_in_every_spelling() -> None:
    spelled = [
        "[SAMPLED, COLOR_ATTACHMENT]",
        "SAMPLED | COLOR_ATTACHMENT",
        '"0x14"',
        '"20"',
        '"20 (SAMPLED | COLOR_ATTACHMENT)"',
    ]
    spelled += ["[VK_IMAGE_USAGE_SAMPLED_BIT, IMAGE_USAGE_COLOR_ATTACHMENT]"]
    for text in spelled:
        assert set(
            read(f"images: {{a: {{usage: {text}}}}}").description.images["a"].usage or ()
        ) == {"SAMPLED", "COLOR_ATTACHMENT"}, text
    for text in ("[]", "0", '"0"'):
        assert read(f"images: {{a: {{usage: {text}}}}}").description.images["a"].usage == (), text


def test_long_words_are_shortened() -> None:
    (found,) = problems(f"images: {{a: {{{'x' * 200}: 1}}}}")
    assert (
        found.message
        == f"unknown key `{'x' * 79}…` in images.a: expected one of {', '.join(Image.SHAPE)}"
    )
    (found,) = problems(f"images: {{a: {{format: {'x' * 200}}}}}")
    assert found.message == f"`format` must be a VkFormat, found `{'x' * 79}…`"


def test_an_alias_is_wrong_at_its_own_place() -> None:
    text, spans = unmarked("images: {a: {format: &f D16_UNORM, samples: ⟦*f⟧}}")
    (found,) = problems(text)
    assert (found.code, found.span) == ("MSAA903", spans[0])
