"""Renderings that are suspended, resumed, and begun again: what they cost, and what is found in
them.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

IMAGES = """\
frame: {width: 1000, height: 500, fps: 60}
images:
  c: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  d: {format: D24_UNORM_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  o: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
commands:
"""
BODY = """\
colorAttachments: [{image: c, loadOp: LOAD, storeOp: STORE, resolveMode: AVERAGE, resolveImage: o}],
 depthAttachment: {image: d, loadOp: LOAD, storeOp: STORE}, stencilAttachment: {image: d, loadOp: LOAD, storeOp: STORE}"""


def rendering(body: str) -> str:
    return f"- beginRendering: {{{body}}}\n- endRendering\n"


def reported(folder: Path, text: str, command: str = "check") -> Any:
    (folder / "frame.msaa.yaml").write_text(text)
    return json.loads(
        run(folder, command, "--output", "json", "--no-cache", "frame.msaa.yaml").stdout
    )


def traffic(folder: Path, text: str) -> tuple[float, float, float]:
    total = reported(folder, text, "cost")["total"]
    return total["read_mb_per_s"], total["write_mb_per_s"], total["milliwatts"]


def findings(folder: Path, text: str) -> list[tuple[str, int]]:
    return [(finding["code"], finding["line"]) for finding in reported(folder, text)["findings"]]


def test_parts_of_a_suspended_rendering_cost_what_one_rendering_does(tmp_path: Path) -> None:
    parts = ("flags: [SUSPENDING], ", "flags: [SUSPENDING, RESUMING], ", "flags: [RESUMING], ")
    whole = traffic(tmp_path, IMAGES + rendering(BODY))
    # A load and a store of 4x color and D24S8, and the resolved color.
    assert whole[:2] == (1000 * 500 * 4 * 8 * 60 / 1e6, 1000 * 500 * (4 * 8 + 4) * 60 / 1e6)
    assert traffic(tmp_path, IMAGES + "".join(rendering(flags + BODY) for flags in parts)) == whole
    assert (
        traffic(tmp_path, IMAGES + rendering(parts[0] + BODY) + rendering(parts[2] + BODY)) == whole
    )


def test_the_operations_of_parts_are_found_where_they_are_performed(tmp_path: Path) -> None:
    text = (
        IMAGES + rendering("flags: [SUSPENDING], " + BODY) + rendering("flags: [RESUMING], " + BODY)
    )
    loads = {
        line for code, line in findings(tmp_path, text) if code in ("MSAA202", "MSAA204", "MSAA403")
    }
    assert loads == {7, 8}
    text = text.replace("loadOp: LOAD", "loadOp: CLEAR")
    assert {
        line
        for code, line in findings(tmp_path, text)
        if code in ("MSAA201", "MSAA203", "MSAA204", "MSAA403")
    } == {10, 11}


IMAGE = "colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]"


@pytest.mark.parametrize(
    ("one", "other", "differs"),
    [
        (IMAGE, IMAGE.replace("CLEAR", "LOAD"), True),
        (IMAGE.replace("STORE", "DONT_CARE"), IMAGE, True),
        (IMAGE, IMAGE.replace("image: c", "image: o"), True),
        (IMAGE, IMAGE.replace("}]", "}, {image: o, loadOp: CLEAR, storeOp: STORE}]"), True),
        (IMAGE, IMAGE.replace("}]", ", resolveMode: AVERAGE, resolveImage: o}]"), True),
        (IMAGE, f"{IMAGE}, depthAttachment: {{image: d, loadOp: CLEAR, storeOp: DONT_CARE}}", True),
        (
            f"{IMAGE}, renderArea: {{x: 0, y: 0, width: 8, height: 8}}",
            f"{IMAGE}, renderArea: {{x: 0, y: 0, width: 8, height: 4}}",
            True,
        ),
        (f"{IMAGE}, viewMask: 3", f"{IMAGE}, viewMask: 1", True),
        (
            IMAGE.replace("c,", "c, imageLayout: GENERAL,"),
            IMAGE.replace("c,", "c, imageLayout: COLOR_ATTACHMENT_OPTIMAL,"),
            True,
        ),
        (IMAGE, IMAGE, False),
        (IMAGE, IMAGE.replace("loadOp: CLEAR, ", ""), False),
        (IMAGE, IMAGE.replace("}]", ", resolveMode: NONE}]"), False),
        (IMAGE, f"{IMAGE}, layerCount: 1, label: opaque", False),
        (IMAGE, f"{IMAGE}, depthAttachment: {{image: null}}", False),
    ],
)
def test_members_of_a_resumed_rendering(
    one: str, other: str, differs: bool, tmp_path: Path
) -> None:
    text = (
        IMAGES + rendering("flags: [SUSPENDING], " + one) + rendering("flags: [RESUMING], " + other)
    )
    assert [code for code, _ in findings(tmp_path, text) if code == "MSAA217"] == [
        "MSAA217"
    ] * differs


def test_a_fix_of_one_part_is_made_in_the_other(tmp_path: Path) -> None:
    body = "depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}"
    text = (
        IMAGES + rendering("flags: [SUSPENDING], " + body) + rendering("flags: [RESUMING], " + body)
    )
    (tmp_path / "frame.msaa.yaml").write_text(text)
    run(tmp_path, "check", "--fix", "--no-cache", "frame.msaa.yaml")
    fixed = (tmp_path / "frame.msaa.yaml").read_text()
    assert fixed.count("storeOp: DONT_CARE") == 2
    assert not [code for code, _ in findings(tmp_path, fixed) if code in ("MSAA203", "MSAA217")]


def test_a_rendering_that_is_begun_again_costs_as_often_however_it_is_written(
    tmp_path: Path,
) -> None:
    body = BODY.replace("\n", "")
    once = IMAGES + rendering(body)
    expanded = IMAGES + rendering(body) * 3
    aliased = (
        IMAGES
        + rendering(body).replace("beginRendering: ", "beginRendering: &r ")
        + "- beginRendering: *r\n- endRendering\n" * 2
    )
    assert (
        traffic(tmp_path, expanded)
        == traffic(tmp_path, aliased)
        == pytest.approx([3 * each for each in traffic(tmp_path, once)])
    )
    reports = [reported(tmp_path, text) for text in (expanded, aliased)]
    assert (
        len(
            {
                tuple(sorted({finding["code"] for finding in report["findings"]}))
                for report in reports
            }
        )
        == 1
    )
    assert (
        reports[0]["summary"]["savings"]["fix"]["price"]
        == reports[1]["summary"]["savings"]["fix"]["price"]
    )


def test_of_aliased_renderings_the_store_that_is_needed_stays(tmp_path: Path) -> None:
    images = (
        "images:\n  o: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, "
        "SAMPLED]}\ncommands:\n"
    )
    first = rendering("colorAttachments: [{image: o, loadOp: CLEAR, storeOp: STORE}]")
    read = "- readImage: {image: o, stage: FRAGMENT, access: SHADER_READ}\n"
    aliased = (
        images
        + first.replace("Rendering: ", "Rendering: &r ")
        + "- beginRendering: *r\n- endRendering\n"
        + read
    )
    assert {code for code, _ in findings(tmp_path, images + first * 2 + read)} == {
        code for code, _ in findings(tmp_path, aliased)
    }
    assert {code for code, _ in findings(tmp_path, aliased)} == {"MSAA208"}
    run(tmp_path, "check", "--fix", "--unsafe-fixes", "--no-cache", "frame.msaa.yaml")
    fixed = (tmp_path / "frame.msaa.yaml").read_text()
    assert re.findall(r"storeOp: \w+", fixed) in (
        ["storeOp: STORE"],
        ["storeOp: DONT_CARE", "storeOp: STORE"],
    )
    assert not {code for code, _ in findings(tmp_path, fixed)} - {"MSAA208"}
