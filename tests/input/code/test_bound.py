"""Documents from trees of source code: members that cannot be bound are removed, not reported."""

from __future__ import annotations

from typing import Any

import pytest

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.code.documents import bound
from msaa_lint.input.code.mentions import speaks

SOURCE = Source("a.cpp", "x" * 1000)


def tree(text: str) -> Node:
    (root,) = parse(Source("tree.yaml", text), Limits()).documents
    return root


def described(text: str) -> Any:
    document = bound(SOURCE, tree(text))
    assert document.problems == ()
    assert not document.whole
    assert document.tree is not None
    return document.description


PASS = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT}
renderPasses:
  main:
    attachments: [{image: ms, samples: VK_SAMPLE_COUNT_4_BIT, loadOp: VK_ATTACHMENT_LOAD_OP_CLEAR, storeOp: STORE}]
    subpasses: [{colorAttachments: [0]}]
"""


def test_c_names_and_ours_are_read() -> None:
    made = described(PASS)
    (attachment,) = made.renderPasses["main"].attachments
    assert (attachment.samples, attachment.loadOp, attachment.storeOp) == (4, "CLEAR", "STORE")
    assert made.images["ms"].usage == ("COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT")


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ("samples: VK_SAMPLE_COUNT_4_BIT", "samples: 3", "samples"),
        ("samples: VK_SAMPLE_COUNT_4_BIT", "samples: [4]", "samples"),
        ("storeOp: STORE", "storeOp: {a: b}", "storeOp"),
        ("storeOp: STORE", "storeOp: STOER", "storeOp"),
        ("image: ms", "image: other", "image"),
        ("image: ms", "image: true", "image"),
    ],
)
def test_a_member_that_cannot_be_is_unknown(old: str, new: str, path: str) -> None:
    (attachment,) = described(PASS.replace(old, new)).renderPasses["main"].attachments
    assert getattr(attachment, path) is None
    assert attachment.loadOp == "CLEAR", "the rest stays"


def test_what_is_wrong_around_it_is_left_out_too() -> None:
    made = described(
        PASS
        + "pipelines: {a: {renderPass: none, multisampleState: {rasterizationSamples: 4}}, b: 3}\n"
        "commands: [nonsense]\n"
    )
    assert made.pipelines["a"].renderPass is None
    assert made.pipelines["a"].multisampleState.rasterizationSamples == 4
    assert "b" not in made.pipelines
    assert made.commands is None


METAL = """\
metal:
  textures:
    ms: {pixelFormat: bgra8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    drawable: {drawable: true}
  renderPasses:
    main: {colorAttachments: [{texture: ms, resolveTexture: drawable, loadAction: clear, storeAction: multisampleResolve}]}
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("pixelFormat: bgra8Unorm", "pixelFormat: nonsense"),
        ("loadAction: clear", "loadAction: 7"),
        ("drawable: true", "drawable: maybe, x: 1"),
    ],
)
def test_metal_is_read_so_too(old: str, new: str) -> None:
    for text in (METAL, METAL.replace(old, new)):
        made = described(text)
        assert made.images["ms"].samples == 4
        assert list(made.renderPasses) == ["main"]


@pytest.mark.parametrize(
    "text",
    [
        "[]",
        "3",
        "{}",
        "images: 3",
        "renderPasses: {a: {attachments: {b: [1, 2]}}}",
        "nonsense: {a: 1}",
    ],
)
def test_any_tree_is_a_document(text: str) -> None:
    described(text)


def test_nesting_is_no_matter() -> None:
    node = tree("images: {a: {samples: 4}}")
    for _ in range(5000):
        node = Node("sequence", 0, 1, [node], {})
    key = Node("scalar", 0, 1, "images", {}, "images")
    assert (
        bound(SOURCE, Node("mapping", 0, 1, {"images": node}, {"images": key})).description.images
        == {}
    )


def test_places_are_the_codes_own() -> None:
    root = tree("images: {a: {samples: 4}}")
    image = root.value["images"].value["a"]
    samples = image.value["samples"]
    samples.start, samples.end = 500, 501
    assert bound(SOURCE, root).description.images["a"].place("samples") == Span(500, 501)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("VkImageCreateInfo info; info.samples = VK_SAMPLE_COUNT_4_BIT;", True),
        ("vk::AttachmentDescription a; a.samples = vk::SampleCountFlagBits::e8;", True),
        ("VkRenderingAttachmentInfo a; // MSAA", True),
        ("vkCmdResolveImage(cmd, a, b)", True),
        ("limits.framebufferColorSampleCounts", True),
        ("MTLRenderPassDescriptor()\nrasterSampleCount = 4", True),
        ("uniform sampler2DMS image;", True),
        ("layout(input_attachment_index = 0) uniform subpassInputMS a;", True),
        ("VkImageCreateInfo info; info.samples = VK_SAMPLE_COUNT_1_BIT;", False),
        ("vk::ImageCreateInfo info; info.samples = vk::SampleCountFlagBits::e1;", False),
        (
            "VkPipelineMultisampleStateCreateInfo "
            "state{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};",
            False,
        ),
        ("int msaa = 4; audio.sampleCount = 2;", False),
        ("uniform sampler2D image;", False),
        ("", False),
    ],
)
def test_what_speaks_of_multisampling(text: str, says: bool) -> None:
    assert speaks(text) == says
