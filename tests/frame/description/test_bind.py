"""Mistakes in a description: what is said, at which place, and what was meant."""

from __future__ import annotations

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.bind import MAX_PROBLEMS, Problem
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Description, Device
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
        ("⟦image⟧: {}", "unknown key `image` in a description", "did you mean `images`?", "image"),
        ("images: {a: {⟦formt⟧: D16_UNORM}}", "unknown key `formt` in images.a", "did you mean `format`?", "images.a.formt"),
        ("images: {a: {⟦Format⟧: D16_UNORM}}", "unknown key `Format` in images.a", "did you mean `format`?", "images.a.Format"),
        ("images: {a: {⟦sample⟧: 4}}", "unknown key `sample` in images.a", "did you mean `samples`?", "images.a.sample"),
        (
            "scene: {⟦qqq⟧: 1}",
            "unknown key `qqq` in scene",
            "it may hold alphaTest, color, depth, depthResolveWants, edges, peak, textureDetail, toneMapping",
            "scene.qqq",
        ),
        (
            "renderPasses: {r: {subpasses: [{⟦colorAttachment⟧: [0]}]}}",
            "unknown key `colorAttachment` in renderPasses.r.subpasses[0]",
            "did you mean `colorAttachments`?",
            "renderPasses.r.subpasses[0].colorAttachment",
        ),
        (
            "renderPasses: {r: {⟦pAttachments⟧: []}}",
            "unknown key `pAttachments` in renderPasses.r",
            "did you mean `attachments`?",
            "renderPasses.r.pAttachments",
        ),
        (
            "pipelines: {p: {multisampleState: {⟦minSampleShadin⟧: 1.0}}}",
            "unknown key `minSampleShadin` in pipelines.p.multisampleState",
            "did you mean `minSampleShading`?",
            "pipelines.p.multisampleState.minSampleShadin",
        ),
        (
            "commands: [{⟦beginRenderpass⟧: {}}]",
            "unknown command `beginRenderpass`",
            "did you mean `beginRenderPass`?",
            "commands[0]",
        ),
        ("commands: [⟦nextsubpass⟧]", "unknown command `nextsubpass`", "did you mean `nextSubpass`?", "commands[0]"),
        ('images: {a: {⟦"a b\\n"⟧: 1}}', "unknown key `a b\n` in images.a", None, None),
    ],
)
def test_unknown_keys(marked: str, message: str, help: str | None, path: str | None) -> None:
    if help is None:
        text, spans = unmarked(marked)
        (found,) = problems(text)
        assert (found.code, found.message, found.span) == ("MSAA902", message, spans[0])
        assert found.help.startswith("it may hold arrayLayers, ")
    else:
        check(marked, "MSAA902", message, help, path)


def test_unknown_command_without_a_near_one() -> None:
    text, spans = unmarked("commands: [{⟦xyz⟧: {}}]")
    (found,) = problems(text)
    assert found.span == spans[0]
    assert found.help.startswith("it is one of beginRenderPass, nextSubpass, ")


IS_NO = "MSAA903"


@pytest.mark.parametrize(
    ("marked", "message", "help"),
    [
        # Of another kind.
        ("images: ⟦[⟧]", "a mapping of names is due here, not a list", ""),
        ("images: ⟦4⟧", "a mapping of names is due here, not `4`", ""),
        ("images: {a: ⟦[⟧{}]}", "a mapping is due here, not a list", ""),
        ("images: {a: {usage: ⟦{⟧}}}", "a list of VkImageUsageFlagBits is due here, not a mapping", ""),
        ("images: {a: {usage: {⟦SAMPLED⟧: true}}}", "a list of VkImageUsageFlagBits is due here, not a mapping", ""),
        ("images: {a: {usage: [⟦[⟧SAMPLED]]}}", "one of VkImageUsageFlagBits is due here, not a list", ""),
        ("images: {a: {format: ⟦[⟧D16_UNORM]}}", "one of VkFormat is due here, not a list", ""),
        ("renderPasses: {r: {subpasses: {⟦a⟧: 1}}}", "a list is due here, not a mapping", ""),
        ("commands: ⟦draw⟧", "a list is due here, not `draw`", ""),
        ("commands: [⟦4⟧]", "one command is due here, not `4`", ""),
        ("commands: [{⟦draw⟧: {}, present: {}}]", "one command is due here, not a mapping", ""),
        ("device: ⟦[⟧]", "a mapping or a text is due here, not a list", ""),
        ("device: ⟦4⟧", "a mapping or a text is due here, not `4`", ""),
        # Null is no value, and no unknown one.
        ("frame: ⟦null⟧", "a mapping is due here, not nothing", ""),
        ("images: {a: {samples: ⟦~⟧}}", "a sample count (1, 2, 4, 8, 16, 32, 64) is due here, not nothing", ""),
        ("images: {a: {format: ⟦null⟧}}", "one of VkFormat is due here, not nothing", ""),
        ("images: {a: {usage: ⟦null⟧}}", "a list of VkImageUsageFlagBits is due here, not nothing", ""),
        ("images: {a: {usage: [⟦null⟧]}}", "one of VkImageUsageFlagBits is due here, not nothing", ""),
        ("renderPasses: {r: {attachments: [⟦null⟧]}}", "a mapping is due here, not nothing", ""),
        ("renderPasses: {r: {subpasses: [⟦null⟧]}}", "a mapping is due here, not nothing", ""),
        ("commands: [⟦null⟧]", "one command is due here, not nothing", ""),
        ("commands: [⟦draw⟧: null]", "`draw` is due with its parameters", ""),
        ("commands: [⟦draw⟧]", "`draw` is due with its parameters", ""),
        ("scene: {depth: ⟦null⟧}", "one of STANDARD, REVERSED is due here, not nothing", ""),
        # Booleans of YAML 1.1, and numbers where texts are due.
        ("images: {a: {presentable: ⟦yes⟧}}", "true or false is due here, not `yes`", "YAML 1.2 knows only `true` and `false`"),
        ("images: {a: {presentable: ⟦Off⟧}}", "true or false is due here, not `Off`", "YAML 1.2 knows only `true` and `false`"),
        ("images: {a: {presentable: ⟦'no'⟧}}", "true or false is due here, not `no`", ""),
        ("images: {a: {presentable: ⟦1⟧}}", "true or false is due here, not `1`", ""),
        ("enabled: {apiVersion: ⟦1.2⟧}", "a text is due here, not `1.2`", 'quote it: "1.2"'),
        ("enabled: {extensions: [⟦true⟧]}", "a text is due here, not `true`", 'quote it: "true"'),
        ("pipelines: {p: {renderPass: ⟦1.5⟧}}", "the name of an entry of `renderPasses` is due here, not `1.5`", 'quote it: "1.5"'),
        # Names that no enum, and words that no list has.
        ("images: {a: {format: ⟦RGBA8⟧}}", "`RGBA8` is no VkFormat", "did you mean `R8G8B8A8_UNORM`?"),
        ("images: {a: {format: ⟦r8g8b8a8_unorm⟧}}", "`r8g8b8a8_unorm` is no VkFormat", "did you mean `R8G8B8A8_UNORM`?"),
        ("images: {a: {format: ⟦37⟧}}", "`37` is no VkFormat", ""),
        ("images: {a: {usage: [SAMPLED, ⟦TRANSIENT⟧]}}", "`TRANSIENT` is no VkImageUsageFlagBits", "did you mean `TRANSIENT_ATTACHMENT`?"),
        ("images: {a: {usage: ⟦SAMPLED | TRANSIENT⟧}}", "`TRANSIENT` is no VkImageUsageFlagBits", "did you mean `TRANSIENT_ATTACHMENT`?"),
        ("images: {a: {usage: ⟦16⟧}}", "a list of VkImageUsageFlagBits is due here, not `16`", ""),
        ("images: {a: {encoding: ⟦SRGB⟧}}", "one of LINEAR, GAMMA, DATA is due here, not `SRGB`", ""),
        ("scene: {depth: ⟦reversed⟧}", "one of STANDARD, REVERSED is due here, not `reversed`", "did you mean `REVERSED`?"),
        ("device: {vendor: ⟦ARMM⟧}", None, "did you mean `arm`?"),
        ("device: {vendor: ⟦Arm Ltd⟧}", None, ""),
        (
            "renderPasses: {r: {attachments: [{storeOp: ⟦DONT_CAER⟧}]}}",
            "`DONT_CAER` is no VkAttachmentStoreOp",
            "did you mean `DONT_CARE`?",
        ),
        (
            "commands: [readImage: {stage: ⟦FRAGMNT⟧}]",
            "`FRAGMNT` is no VkShaderStageFlagBits or VkPipelineStageFlagBits2",
            "did you mean `FRAGMENT`?",
        ),
        (
            "renderPasses: {r: {dependencies: [{srcSubpass: ⟦EXTERN⟧}]}}",
            "EXTERNAL or the index of a subpass is due here, not `EXTERN`",
            "did you mean `EXTERNAL`?",
        ),
        # Numbers out of their range.
        ("images: {a: {samples: ⟦3⟧}}", "a sample count (1, 2, 4, 8, 16, 32, 64) is due here, not `3`", ""),
        ("images: {a: {samples: ⟦SAMPLE_COUNT_٤⟧}}", "a sample count (1, 2, 4, 8, 16, 32, 64) is due here, not `SAMPLE_COUNT_٤`", ""),
        ("images: {a: {samples: ⟦4.0⟧}}", "a sample count (1, 2, 4, 8, 16, 32, 64) is due here, not `4.0`", ""),
        ("images: {a: {samples: ⟦true⟧}}", "a sample count (1, 2, 4, 8, 16, 32, 64) is due here, not `true`", ""),
        ("images: {a: {mipLevels: ⟦0⟧}}", "a whole number from 1 to 2147483647 is due here, not `0`", ""),
        ("images: {a: {mipLevels: ⟦1.0⟧}}", "a whole number is due here, not `1.0`", ""),
        ("frame: {width: ⟦2147483648⟧}", "a whole number from 1 to 2147483647 is due here, not `2147483648`", ""),
        ("frame: {fps: ⟦0⟧}", "a number above 0 is due here, not `0`", ""),
        ("frame: {fps: ⟦-60.0⟧}", "a number above 0 is due here, not `-60.0`", ""),
        ("frame: {fps: ⟦.inf⟧}", "a finite number is due here, not `.inf`", ""),
        ("frame: {fps: ⟦.nan⟧}", "a finite number is due here, not `.nan`", ""),
        ("frame: {fps: ⟦1e999⟧}", "a finite number is due here, not `1e999`", ""),
        ("frame: {fps: ⟦sixty⟧}", "a finite number is due here, not `sixty`", ""),
        ("frame: {fps: ⟦true⟧}", "a finite number is due here, not `true`", ""),
        ("pipelines: {p: {multisampleState: {sampleMask: [⟦-1⟧]}}}", "a whole number from 0 to 4294967295 is due here, not `-1`", ""),
        ("pipelines: {p: {multisampleState: {sampleMask: [⟦0x100000000⟧]}}}", None, ""),
        ("pipelines: {p: {stages: [{specialization: {⟦id⟧: 4}}]}}", "a number as key is due here, not `id`", ""),
        ("commands: [readImage: {samples: ⟦4⟧}]", "one of 1, ALL is due here, not `4`", ""),
        ("commands: [readImage: {samples: ⟦1.0⟧}]", "one of 1, ALL is due here, not `1.0`", ""),
        ("commands: [readImage: {samples: ⟦true⟧}]", "one of 1, ALL is due here, not `true`", ""),
        # Attachments.
        (
            "renderPasses: {r: {subpasses: [{colorAttachments: [⟦true⟧]}]}}",
            "an attachment: a name, an index, {attachment, layout} or null is due here, not `true`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{colorAttachments: [⟦-1⟧]}]}}",
            "a whole number from 0 to 4294967295 is due here, not `-1`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{depthStencilAttachment: {attachment: ⟦-1⟧}}]}}",
            "a whole number from 0 to 4294967295 is due here, not `-1`",
            "",
        ),
        (
            "renderPasses: {r: {attachments: [{}, {}]}}\nframebuffers: {f: {renderPass: r, attachments: ⟦[a]⟧}}\nimages: {a: {}}",
            "`r` has 2 attachments, this framebuffer 1",
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


def test_a_document_that_is_no_mapping() -> None:
    check("⟦[⟧1, 2]", "MSAA903", "a mapping is due here, not a list", "", "")
    check("⟦just words⟧", "MSAA903", "a mapping is due here, not `just words`", "", "")


NO_PASSES = "the description has no `renderPasses`"
R = "renderPasses: {r: {attachments: {color: {}, depth: {}}, subpasses: [{}], dependencies: []}}\n"


@pytest.mark.parametrize(
    ("marked", "message", "help", "path"),
    [
        # Names of sections.
        (
            "images: {color: {}}\nrenderPasses: {r: {attachments: [{image: ⟦colour⟧}]}}",
            "no `colour` in `images`",
            "did you mean `color`?",
            "renderPasses.r.attachments[0].image",
        ),
        (
            "images: {a: {}, b: {}}\nrenderPasses: {r: {attachments: [{image: ⟦xyz⟧}]}}",
            "no `xyz` in `images`",
            "`images` has a, b",
            "renderPasses.r.attachments[0].image",
        ),
        ("renderPasses: {r: {attachments: [{image: ⟦x⟧}]}}", "no `x` in `images`", "the description has no `images`", None),
        (f"{R}framebuffers: {{f: {{renderPass: ⟦rr⟧}}}}", "no `rr` in `renderPasses`", "`renderPasses` has r", "framebuffers.f.renderPass"),
        (
            "images: {i0: {}}\nframebuffers: {f: {attachments: [i0, ⟦i1⟧, null]}}",
            "no `i1` in `images`",
            "`images` has i0",
            "framebuffers.f.attachments[1]",
        ),
        (
            "pipelines: {p: {renderPass: ⟦r⟧}}",
            "no `r` in `renderPasses`",
            "the description has no `renderPasses`",
            "pipelines.p.renderPass",
        ),
        (
            "pipelines: {p: {renderPass: ⟦4⟧}}",
            "no `4` in `renderPasses`",
            "the description has no `renderPasses`",
            "pipelines.p.renderPass",
        ),
        (
            "commands: [beginRenderPass: {renderPass: ⟦r⟧}]",
            "no `r` in `renderPasses`",
            "the description has no `renderPasses`",
            "commands[0].beginRenderPass.renderPass",
        ),
        (
            f"{R}commands: [beginRenderPass: {{renderPass: r, framebuffer: ⟦fb⟧}}]",
            "no `fb` in `framebuffers`",
            "the description has no `framebuffers`",
            None,
        ),
        (
            f"{R}framebuffers: {{f0: {{}}}}\ncommands: [beginRenderPass: {{renderPass: r, framebuffer: [f0, ⟦f1⟧]}}]",
            "no `f1` in `framebuffers`",
            "`framebuffers` has f0",
            "commands[0].beginRenderPass.framebuffer[1]",
        ),
        ("commands: [draw: {pipeline: ⟦p⟧}]", "no `p` in `pipelines`", "the description has no `pipelines`", "commands[0].draw.pipeline"),
        (
            "commands: [beginRendering: {colorAttachments: [{image: ⟦i⟧}]}]",
            "no `i` in `images`",
            "the description has no `images`",
            "commands[0].beginRendering.colorAttachments[0].image",
        ),
        (
            "images: {i: {}}\ncommands: [beginRendering: {depthAttachment: {image: i, resolveImage: ⟦j⟧}}]",
            "no `j` in `images`",
            "`images` has i",
            "commands[0].beginRendering.depthAttachment.resolveImage",
        ),
        ("images: {i: {}}\ncommands: [resolveImage: {srcImage: i, dstImage: ⟦j⟧}]", "no `j` in `images`", "`images` has i", None),
        ("images: {i: {}}\ncommands: [pipelineBarrier: {images: [i, ⟦j⟧]}]", "no `j` in `images`", "`images` has i", None),
        (
            "images: {i: {}}\ncommands: [pipelineBarrier: {images: [{image: ⟦j⟧}]}]",
            "no `j` in `images`",
            "`images` has i",
            "commands[0].pipelineBarrier.images[0].image",
        ),
        # Attachments of the pass.
        (
            "renderPasses: {r: {attachments: {color: {}}, subpasses: [{colorAttachments: [⟦colour⟧]}]}}",
            "no attachment `colour` in render pass `r`",
            "did you mean `color`?",
            "renderPasses.r.subpasses[0].colorAttachments[0]",
        ),
        (
            "renderPasses: {r: {attachments: [{}, {}], subpasses: [{resolveAttachments: [⟦2⟧]}]}}",
            "no attachment `2` in render pass `r`",
            "it has 2, counted from 0",
            "renderPasses.r.subpasses[0].resolveAttachments[0]",
        ),
        (
            "renderPasses: {r: {attachments: [{}], subpasses: [{inputAttachments: [{attachment: ⟦1⟧}]}]}}",
            "no attachment `1` in render pass `r`",
            "it has 1, counted from 0",
            None,
        ),
        (
            "renderPasses: {r: {subpasses: [{depthStencilAttachment: ⟦depth⟧}]}}",
            "no attachment `depth` in render pass `r`",
            "the description has no `renderPasses.r.attachments`",
            "renderPasses.r.subpasses[0].depthStencilAttachment",
        ),
        (
            "renderPasses: {r: {attachments: {d: {}}, subpasses: [{depthStencilResolve: {attachment: ⟦e⟧}}]}}",
            "no attachment `e` in render pass `r`",
            "`renderPasses.r.attachments` has d",
            "renderPasses.r.subpasses[0].depthStencilResolve.attachment",
        ),
        (
            "renderPasses: {r: {attachments: {d: {}}, subpasses: [{preserveAttachments: [d, ⟦e⟧]}]}}",
            "no attachment `e` in render pass `r`",
            "`renderPasses.r.attachments` has d",
            "renderPasses.r.subpasses[0].preserveAttachments[1]",
        ),
        # Subpasses.
        (
            f"{R}pipelines: {{p: {{renderPass: r, subpass: ⟦1⟧}}}}",
            "`r` has 1 subpass, no subpass 1",
            "",
            "pipelines.p.subpass",
        ),
        (
            "renderPasses: {r: {subpasses: [{}], dependencies: [{srcSubpass: EXTERNAL, dstSubpass: ⟦1⟧}]}}",
            "`r` has 1 subpass, no subpass 1",
            "",
            "renderPasses.r.dependencies[0].dstSubpass",
        ),
        # The device.
        ("device: ⟦mali-g7⟧", "no device `mali-g7`", "did you mean `mali-g76`?", "device"),
    ],
)
def test_dangling_references(marked: str, message: str, help: str, path: str | None) -> None:
    check(marked, "MSAA904", message, help, path)


def test_a_device_that_nothing_is_near_to() -> None:
    (found,) = problems("device: qqqqqq")
    assert found.code == "MSAA904"
    assert found.help.startswith("built-in devices: ")
    assert "mali-g76" in found.help


@pytest.mark.parametrize(
    "written", ["null", "4294967295", "VK_ATTACHMENT_UNUSED", "UNUSED", "{attachment: null}", "{attachment: 4294967295}"]
)
def test_an_unused_attachment(written: str) -> None:
    document = read(f"renderPasses: {{r: {{subpasses: [{{colorAttachments: [{written}], depthStencilAttachment: {written}}}]}}}}")
    assert document.problems == ()
    subpass = document.description.renderPasses["r"].subpasses[0]
    assert subpass.colorAttachments[0].attachment is None
    assert subpass.depthStencilAttachment is not None and subpass.depthStencilAttachment.attachment is None


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
    assert [each.attachment for each in document.description.renderPasses["r"].subpasses[0].colorAttachments] == ["1", "1", 1, 1]


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
        "images: {a: {}}\nrenderPasses: {r: {attachments: [{}], subpasses: [{}]}}\npipelines: {p: {colorBlendState: {attachments: [{}]}}}"
    ).description
    image, attachment = described.images["a"], described.renderPasses["r"].attachments[0]
    subpass = described.renderPasses["r"].subpasses[0]
    assert (image.usage, image.memory, image.samples, image.presentable, image.flags) == (None, None, None, None, ())
    assert (attachment.loadOp, attachment.storeOp, attachment.initialLayout) == (None, None, None)
    assert (subpass.colorAttachments, subpass.resolveAttachments, subpass.flags, subpass.viewMask) == ((), (), (), None)
    blend = described.pipelines["p"].colorBlendState
    assert blend is not None and blend.attachments[0].colorWriteMask is None
    assert described.commands is None


def test_flags_are_read_in_every_spelling() -> None:
    spelled = ["[SAMPLED, COLOR_ATTACHMENT]", "SAMPLED | COLOR_ATTACHMENT", '"0x14"', '"20"', '"20 (SAMPLED | COLOR_ATTACHMENT)"']
    spelled += ["[VK_IMAGE_USAGE_SAMPLED_BIT, IMAGE_USAGE_COLOR_ATTACHMENT]"]
    for text in spelled:
        assert set(read(f"images: {{a: {{usage: {text}}}}}").description.images["a"].usage or ()) == {"SAMPLED", "COLOR_ATTACHMENT"}, text
    for text in ("[]", "0", '"0"'):
        assert read(f"images: {{a: {{usage: {text}}}}}").description.images["a"].usage == (), text


def test_long_words_are_shortened() -> None:
    (found,) = problems(f"images: {{a: {{{'x' * 200}: 1}}}}")
    assert found.message == f"unknown key `{'x' * 79}…` in images.a"
    (found,) = problems(f"images: {{a: {{format: {'x' * 200}}}}}")
    assert found.message == f"`{'x' * 79}…` is no VkFormat"


def test_an_alias_is_wrong_at_its_own_place() -> None:
    text, spans = unmarked("images: {a: {format: &f D16_UNORM, samples: ⟦*f⟧}}")
    (found,) = problems(text)
    assert (found.code, found.span) == ("MSAA903", spans[0])
