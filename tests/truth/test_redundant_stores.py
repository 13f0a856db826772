"""A store whose contents the next use discards, in every way that it can be stated
(BestPractices-RenderPass-redundant-store).
"""

from __future__ import annotations

import pytest

from tests.linter.fixes.linting import lint

STORES = {
    ("color", 1): "MSAA208",
    ("color", 4): "MSAA201",
    ("depth", 1): "MSAA208",
    ("depth", 4): "MSAA203",
}
UNDEFINED = "- pipelineBarrier: {images: [{image: a, oldLayout: UNDEFINED, newLayout: GENERAL}]}"
CLEAR = {"color": "- clearColorImage: {image: a}", "depth": "- clearDepthStencilImage: {image: a}"}
COPIES = (
    "- copyImage: {srcImage: b, dstImage: a}",
    "- blitImage: {srcImage: b, dstImage: a}",
    "- copyBufferToImage: {dstImage: a}",
)


def rendering(aspect: str, operation: str, area: str = "") -> str:
    info = f"{{image: a, loadOp: {operation}, storeOp: STORE}}"
    attachments = f"colorAttachments: [{info}]" if aspect == "color" else f"depthAttachment: {info}"
    return f"- beginRendering: {{{area}{attachments}}}\n- endRendering"


def render_pass(aspect: str, format: str, samples: int, members: str) -> str:
    reference = "colorAttachments: [a]" if aspect == "color" else "depthStencilAttachment: a"
    return (
        f"renderPasses: {{r: {{attachments: {{a: {{image: a, format: {format}, samples: {samples}, "
        f"storeOp: STORE, {members}}}}}, "
        f"subpasses: [{{{reference}}}]}}}}\n"
    )


def codes(aspect: str, samples: int, between: str, passes: str = "") -> list[str]:
    format, usage = (
        ("R8G8B8A8_UNORM", "COLOR") if aspect == "color" else ("D32_SFLOAT", "DEPTH_STENCIL")
    )
    images = "".join(
        f"  {name}: {{format: {format}, samples: {samples}, usage: [{usage}_ATTACHMENT, SAMPLED, "
        "TRANSFER_SRC, TRANSFER_DST], "
        "extent: {width: 64, height: 64}}\n"
        for name in "ab"
    )
    text = (
        f"images:\n{images}  o: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], "
        f"presentable: true}}\n{passes}commands:\n"
        f"{rendering(aspect, 'CLEAR')}\n{between}\n- readImage: {{image: a, stage: FRAGMENT, "
        f"access: SHADER_READ}}\n"
        "- present: {image: o}\n"
    )
    return [
        found.code
        for found in lint(text).findings
        if found.subject.startswith("commands[0].") and found.code in STORES.values()
    ]


@pytest.mark.parametrize(("aspect", "samples"), STORES)
def test_what_discards(aspect: str, samples: int) -> None:
    code = [STORES[aspect, samples]]
    part = "renderArea: {x: 0, y: 0, width: 8, height: 8}, "
    assert codes(aspect, samples, rendering(aspect, "CLEAR")) == code
    assert codes(aspect, samples, rendering(aspect, "DONT_CARE")) == code
    assert codes(aspect, samples, CLEAR[aspect]) == code
    for write in (
        *COPIES,
        CLEAR[aspect],
        rendering(aspect, "CLEAR", part),
        "- writeImage: {image: a}",
    ):
        assert codes(aspect, samples, f"{UNDEFINED}\n{write}") == code, write
    format = "R8G8B8A8_UNORM" if aspect == "color" else "D32_SFLOAT"
    begin = (
        "- beginRenderPass: {renderPass: r, renderArea: {x: 0, y: 0, width: 8, height: 8}}\n- "
        "endRenderPass"
    )
    for operation in ("CLEAR", "DONT_CARE"):
        members = f"loadOp: {operation}, initialLayout: UNDEFINED"
        assert codes(aspect, samples, begin, render_pass(aspect, format, samples, members)) == code


@pytest.mark.parametrize(("aspect", "samples"), STORES)
def test_what_keeps(aspect: str, samples: int) -> None:
    part = "renderArea: {x: 0, y: 0, width: 8, height: 8}, "
    for between in (
        *COPIES,
        rendering(aspect, "LOAD"),
        rendering(aspect, "CLEAR", part),
        "- writeImage: {image: a}",
        "",
    ):
        assert codes(aspect, samples, between) == [], between
    # The barrier is the mistake, not the store.
    assert codes(aspect, samples, f"{UNDEFINED}\n{rendering(aspect, 'LOAD')}") == []
    format = "R8G8B8A8_UNORM" if aspect == "color" else "D32_SFLOAT"
    begin = (
        "- beginRenderPass: {renderPass: r, renderArea: {x: 0, y: 0, width: 8, height: 8}}\n- "
        "endRenderPass"
    )
    members = "loadOp: CLEAR, initialLayout: GENERAL"
    assert codes(aspect, samples, begin, render_pass(aspect, format, samples, members)) == []
