"""Load operation NONE: undefined inside the pass, preserved in memory."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

FRAME = """\
images:
  d: {{format: {format}, samples: {samples}, usage: [DEPTH_STENCIL_ATTACHMENT]}}
  o: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}}
pipelines:
  opaque: {{depthStencilState: {{depthTestEnable: true, depthWriteEnable: true, depthCompareOp: LESS, stencilTestEnable: true}}}}
  glass: {{depthStencilState: {{depthTestEnable: true, depthWriteEnable: false, depthCompareOp: LESS, stencilTestEnable: true}}}}
  off: {{depthStencilState: {{depthTestEnable: false, depthWriteEnable: false, stencilTestEnable: false}}}}
commands:
- beginRendering: {{{aspect}Attachment: {{image: d, loadOp: CLEAR, storeOp: STORE}}}}
- draw: {{pipeline: opaque, vertexCount: 3}}
- endRendering
- beginRendering: {{{aspect}Attachment: {{image: d, loadOp: NONE, storeOp: {store}}}}}
- draw: {{pipeline: {pipeline}, vertexCount: 3}}
- endRendering
{rest}\
- present: {{image: o}}
"""
LOADED = (
    "- beginRendering: {{{aspect}Attachment: {{image: d, loadOp: LOAD, storeOp: "
    "DONT_CARE}}}}\n- endRendering\n"
)


def findings(folder: Path, text: str) -> list[dict[str, Any]]:
    (folder / "frame.yaml").write_text(text)
    return list(
        json.loads(run(folder, "check", "--output", "json", "--no-cache", "frame.yaml").stdout)[
            "findings"
        ]
    )


@pytest.mark.parametrize(("format", "aspect"), [("D32_SFLOAT", "depth"), ("S8_UINT", "stencil")])
@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("store", ["NONE", "DONT_CARE"])
@pytest.mark.parametrize("pipeline", ["glass", "opaque"])
def test_a_store_before_a_test_without_a_load_is_not_unread(
    format: str, aspect: str, samples: int, store: str, pipeline: str, tmp_path: Path
) -> None:
    stated = {
        "format": format,
        "aspect": aspect,
        "samples": samples,
        "store": store,
        "pipeline": pipeline,
    }
    found = findings(tmp_path, FRAME.format(rest="", **stated))
    assert [(f["code"], f["line"]) for f in found if f["code"] == "MSAA216"] == [
        ("MSAA216", 12)
    ] * (aspect == "depth")
    assert not [
        f for f in found if f["code"] in ("MSAA201", "MSAA203", "MSAA204", "MSAA208", "MSAA401")
    ], found
    assert not [f for f in found if f["fixable"] and f["fix"]["safe"]]


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize("pipeline", ["off", "glass", "opaque"])
def test_what_a_pass_without_operations_leaves_is_loaded_later(
    samples: int, pipeline: str, tmp_path: Path
) -> None:
    stated = {
        "format": "D32_SFLOAT",
        "aspect": "depth",
        "samples": samples,
        "store": "NONE",
        "pipeline": pipeline,
    }
    found = findings(tmp_path, FRAME.format(rest=LOADED.format(**stated), **stated))
    assert not [f for f in found if f["code"] in ("MSAA203", "MSAA208", "MSAA209", "MSAA401")], (
        found
    )
    assert ("MSAA216" in {f["code"] for f in found}) == (pipeline != "off")


BLENDS = """\
images: {{c: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}}}}
pipelines:
  first: {{colorBlendState: {{attachments: [{first}]}}}}
  second: {{colorBlendState: {{attachments: [{second}]}}}}
commands:
- beginRendering: {{colorAttachments: [{{image: c, loadOp: {load}, storeOp: STORE}}]}}
- draw: {{pipeline: first, vertexCount: 3}}
- draw: {{pipeline: second, vertexCount: 3}}
- endRendering
- present: {{image: c}}
"""
ALL = "colorWriteMask: [R, G, B, A]"
BLEND = (
    f"{{blendEnable: true, srcColorBlendFactor: ONE, dstColorBlendFactor: ONE_MINUS_SRC_ALPHA, "
    f"colorBlendOp: ADD, {ALL}}}"
)
MULTIPLY = (
    f"{{blendEnable: true, srcColorBlendFactor: DST_COLOR, dstColorBlendFactor: ZERO, "
    f"colorBlendOp: ADD, {ALL}}}"
)
REPLACE = (
    f"{{blendEnable: true, srcColorBlendFactor: ONE, dstColorBlendFactor: ZERO, "
    f"colorBlendOp: ADD, {ALL}}}"
)
OPAQUE = f"{{blendEnable: false, {ALL}}}"
NOTHING = BLEND.replace("R, G, B, A", "")
UNSTATED = "{blendEnable: true}"


@pytest.mark.parametrize(
    ("load", "first", "second", "reported"),
    [
        ("NONE", BLEND, BLEND, True),
        ("NONE", MULTIPLY, OPAQUE, True),
        ("NONE", NOTHING, BLEND, True),
        ("NONE", OPAQUE, BLEND, False),
        ("NONE", REPLACE, REPLACE, False),
        ("NONE", NOTHING, NOTHING, False),
        ("NONE", UNSTATED, BLEND, False),
        ("LOAD", BLEND, BLEND, False),
        ("CLEAR", BLEND, BLEND, False),
        ("DONT_CARE", BLEND, BLEND, False),
    ],
)
def test_blending(load: str, first: str, second: str, reported: bool, tmp_path: Path) -> None:
    found = findings(tmp_path, BLENDS.format(load=load, first=first, second=second))
    assert ("MSAA216" in {f["code"] for f in found}) == reported
