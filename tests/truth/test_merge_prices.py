"""The price of loading samples is that of drawing in the pass that stored them: the load, and the
store if nothing else needs it.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

FRAME = "frame: {width: 1000, height: 1000, fps: 50}\n"
COLOR = (
    "images:\n  c: {format: R8G8B8A8_UNORM, samples: 4}\n  r: {format: R8G8B8A8_UNORM, "
    "samples: 1}\n"
)
RESOLVE = "resolveMode: AVERAGE, resolveImage: r"
FIRST = (
    "- beginRendering: {colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]}\n- "
    "endRendering\n"
)
LAST = (
    f"- beginRendering: {{colorAttachments: [{{image: c, loadOp: LOAD, storeOp: DONT_CARE, "
    f"{RESOLVE}}}]}}\n- endRendering\n"
)
READ = "- readImage: {image: c, stage: FRAGMENT, access: SHADER_READ}\n"
PASSES = (
    "renderPasses:\n"
    "  first:\n    attachments:\n      a: {image: c, loadOp: CLEAR, storeOp: STORE}\n    "
    "subpasses: [{colorAttachments: [a]}]\n"
    "  last:\n    attachments:\n      a: {image: c, loadOp: LOAD, storeOp: DONT_CARE, "
    "initialLayout: COLOR_ATTACHMENT_OPTIMAL}\n"
    "      b: {image: r, loadOp: DONT_CARE, storeOp: STORE}\n    subpasses: [{colorAttachments: "
    "[a], resolveAttachments: [b]}]\n"
)
METAL = """metal:
  textures:
    c: {pixelFormat: rgba8Unorm, textureType: type2DMultisample, sampleCount: 4, width: 1000, height: 1000, usage: [renderTarget]}
    r: {pixelFormat: rgba8Unorm, width: 1000, height: 1000, usage: [renderTarget, shaderRead]}
  renderPasses:
    first: {colorAttachments: [{texture: c, loadAction: clear, storeAction: store}]}
    last: {colorAttachments: [{texture: c, resolveTexture: r, loadAction: load, storeAction: multisampleResolve}]}
"""


def depth(format: str, first: str, last: str, device: str = "") -> str:
    """Two render passes with depth and stencil; `first` and `last` are what states their
    operations.
    """
    return (
        f"{device}{FRAME}images: {{d: {{format: {format}, samples: 4, usage: "
        f"[DEPTH_STENCIL_ATTACHMENT]}}}}\nrenderPasses:\n"
        f"  first: {{attachments: {{a: {{image: d, {first}}}}}, subpasses: "
        f"[{{depthStencilAttachment: a}}]}}\n"
        f"  last: {{attachments: {{a: {{image: d, {last}}}}}, subpasses: "
        f"[{{depthStencilAttachment: a}}]}}\n"
    )


BOTH = (
    "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
    "loadOp: LOAD, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE, "
    "initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
)
STENCIL = (
    "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
    "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE, "
    "initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
)


def checked(folder: Path, text: str) -> dict[str, Any]:
    (folder / "frame.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "check", "--no-cache", "--output", "json", "frame.msaa.yaml")
    assert done.returncode in (0, 1), done.stderr
    result: dict[str, Any] = json.loads(done.stdout)
    return result


def prices(result: dict[str, Any]) -> dict[str, tuple[float, float]]:
    """By code: MB/s read and written, of the rules about loads and stores of samples."""
    return {
        found["code"]: (found["price"]["read_mb_per_s"], found["price"]["write_mb_per_s"])
        for found in result["findings"]
        if found["code"] in ("MSAA201", "MSAA202", "MSAA203", "MSAA204", "MSAA808")
    }


DEPTH = (
    BOTH[0].replace("stencilStoreOp: STORE", "stencilStoreOp: DONT_CARE"),
    BOTH[1].replace("stencilLoadOp: LOAD", "stencilLoadOp: CLEAR"),
)
STORED = "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE"

MERGED = (800.0, 800.0)
ALONE = (800.0, 0.0)

CASES: dict[str, tuple[str, dict[str, tuple[float, float]]]] = {
    "split rendering": (FRAME + COLOR + "commands:\n" + FIRST + LAST, {"MSAA202": MERGED}),
    "split render pass": (FRAME + COLOR + PASSES, {"MSAA202": MERGED}),
    "Metal": (f"{FRAME}{METAL}", {"MSAA808": MERGED}),
    "the store is read before the load": (
        FRAME + COLOR + "commands:\n" + FIRST + READ + LAST,
        {"MSAA202": ALONE},
    ),
    "the store is read after the load": (
        FRAME
        + COLOR
        + "commands:\n"
        + FIRST
        + LAST.replace("storeOp: DONT_CARE", "storeOp: NONE")
        + READ,
        {"MSAA202": ALONE},
    ),
    "something that is not described may read it": (
        FRAME
        + COLOR.replace("samples: 4", "samples: 4, mayBeRead: true")
        + "commands:\n"
        + FIRST
        + LAST,
        {"MSAA202": ALONE},
    ),
    "what the second pass stores is read": (
        FRAME + COLOR + "commands:\n" + FIRST + LAST.replace("DONT_CARE", "STORE") + READ,
        {"MSAA202": MERGED},
    ),
    "the second pass stores in vain": (
        FRAME + COLOR + "commands:\n" + FIRST + LAST.replace("DONT_CARE", "STORE"),
        {"MSAA201": (0.0, 800.0), "MSAA202": MERGED},
    ),
    "a command wrote what is loaded": (
        FRAME + COLOR + "commands:\n" + FIRST + "- writeImage: {image: c, stage: COMPUTE}\n" + LAST,
        {"MSAA202": ALONE},
    ),
    "round the frame": (
        FRAME + COLOR + "commands:\n" + LAST.replace("DONT_CARE", "STORE"),
        {"MSAA202": MERGED},
    ),
    "round the frame, with a reader": (
        FRAME + COLOR + "commands:\n" + LAST.replace("DONT_CARE", "STORE") + READ,
        {"MSAA202": ALONE},
    ),
    "immediate-mode": (
        "device: nvidia\n" + FRAME + COLOR + "commands:\n" + FIRST + LAST,
        {"MSAA202": (0.0, 0.0)},
    ),
    "stencil": (depth("D32_SFLOAT_S8_UINT", *STENCIL), {"MSAA204": (200.0, 200.0)}),
    "depth and stencil in two planes": (
        depth("D32_SFLOAT_S8_UINT", *BOTH),
        {"MSAA202": MERGED, "MSAA204": (200.0, 200.0)},
    ),
    "stencil that is loaded, and stored in vain": (
        depth(
            "D32_SFLOAT_S8_UINT",
            STENCIL[0],
            STENCIL[1].replace("stencilStoreOp: DONT_CARE", "stencilStoreOp: STORE"),
        ),
        {"MSAA204": (200.0, 400.0)},
    ),
}


# By device: what depth and stencil, each alone or both together, cost at 4x in two passes.
PLANES = [
    (device, format, *expected)
    for format, devices, *expected in [
        (
            "D24_UNORM_S8_UINT",
            ("mali-g76", "adreno-740", "{vendor: img}"),
            800.0,
            800.0,
            (800.0, 800.0),
        ),
        # No more than is known: the bits of each aspect.
        ("D24_UNORM_S8_UINT", ("", "{vendor: broadcom}"), 600.0, 200.0, (600.0, 200.0)),
        ("D32_SFLOAT_S8_UINT", ("mali-g76", "adreno-740", ""), 800.0, 200.0, (800.0, 200.0)),
    ]
    for device in devices
]


@pytest.mark.parametrize(("device", "format", "depth_alone", "stencil_alone", "both"), PLANES)
def test_planes(
    tmp_path: Path,
    device: str,
    format: str,
    depth_alone: float,
    stencil_alone: float,
    both: tuple[float, float],
) -> None:
    named = f"device: {device}\n" if device else ""
    assert prices(checked(tmp_path, depth(format, *DEPTH, named))) == {
        "MSAA202": (depth_alone, depth_alone)
    }
    assert prices(checked(tmp_path, depth(format, *STENCIL, named))) == {
        "MSAA204": (stencil_alone, stencil_alone)
    }
    of_depth, of_stencil = both
    merged = checked(tmp_path, depth(format, *BOTH, named))
    assert prices(merged) == {"MSAA202": (of_depth, of_depth), "MSAA204": (of_stencil, of_stencil)}
    unread = checked(tmp_path, depth(format, STORED, DEPTH[0].replace("STORE", "DONT_CARE"), named))
    assert prices(unread) == {"MSAA203": (0.0, of_depth), "MSAA204": (0.0, of_stencil)}
    # Together they save each byte once.
    assert unread["summary"]["savings"]["fix"]["price"]["write_mb_per_s"] == (
        800.0 if "24" in format else 1000.0
    )
    one_plane = of_depth == of_stencil
    for found in (*merged["findings"], *unread["findings"]):
        if found["code"] in ("MSAA202", "MSAA203", "MSAA204"):
            assert (
                "depth and stencil are in one plane of memory: the price is that of both"
                in found["notes"]
            ) == one_plane


def test_a_store_that_goes_with_one_that_is_needed_saves_nothing(tmp_path: Path) -> None:
    """The plane is stored for the stencil that the second pass loads, with or without depth."""
    found = prices(
        checked(tmp_path, depth("D24_UNORM_S8_UINT", STORED, STENCIL[1], "device: mali-g76\n"))
    )
    assert found == {"MSAA203": (0.0, 0.0), "MSAA204": (800.0, 0.0)}


@pytest.mark.parametrize("name", CASES)
def test_price(tmp_path: Path, name: str) -> None:
    text, expected = CASES[name]
    result = checked(tmp_path, text)
    assert prices(result) == expected
    for found in result["findings"]:
        if found["code"] not in expected:
            continue
        alone = any(
            note.startswith("the price is that of the load alone") for note in found["notes"]
        )
        assert alone == (expected[found["code"]] == ALONE)
    # What the prices of merges are is a choice, outside every sum.
    stores = sum(write for code, (_, write) in expected.items() if code in ("MSAA201", "MSAA203"))
    saved = result["summary"]["savings"]["fix"]["price"] or {
        "read_mb_per_s": 0.0,
        "write_mb_per_s": 0.0,
    }
    assert (saved["read_mb_per_s"], saved["write_mb_per_s"]) == (0.0, stores)


def test_no_fix_clears_what_was_stored(tmp_path: Path) -> None:
    for text in (FRAME + COLOR + PASSES, depth("D32_SFLOAT_S8_UINT", *BOTH)):
        (tmp_path / "frame.msaa.yaml").write_text(text, encoding="utf-8")
        run(tmp_path, "check", "--no-cache", "--fix", "--unsafe-fixes", "frame.msaa.yaml")
        assert (tmp_path / "frame.msaa.yaml").read_text(encoding="utf-8").count(
            "LOAD,"
        ) == text.count("LOAD,")


def test_fail_on_cost_counts_what_fixes_save(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(FRAME + COLOR + PASSES, encoding="utf-8")
    assert (
        run(
            tmp_path,
            "check",
            "--no-cache",
            "--exit-zero",
            "--fail-on-cost",
            "1MB/s",
            "frame.msaa.yaml",
        ).returncode
        == 0
    )
