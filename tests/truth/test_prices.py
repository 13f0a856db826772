"""What prices and costs say on immediate-mode GPUs, without a device, and of images that cannot be
compressed.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

FRAME = """
frame: {width: 1000, height: 1000, fps: 100}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  depth_ms: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  output: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  scene:
    attachments:
      color: {image: color_ms, loadOp: CLEAR, storeOp: STORE}
      depth: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}
      output: {image: output, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], depthStencilAttachment: depth, resolveAttachments: [output]}
"""
IMMEDIATE = [
    "nvidia",
    "amd",
    "intel",
    "samsung-xclipse",
    "{vendor: amd}",
    "{vendor: nvidia}",
    "{vendor: intel}",
    "{tiler: false}",
]


def write(folder: Path, text: str, device: str | None) -> str:
    (folder / "frame.msaa.yaml").write_text(
        text + (f"device: {device}\n" if device is not None else "")
    )
    return "frame.msaa.yaml"


def cost(folder: Path, text: str, device: str | None) -> dict[str, Any]:
    done = run(folder, "cost", write(folder, text, device), "--output", "json")
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.mark.parametrize("device", IMMEDIATE)
def test_findings_about_operations_are_notes_without_a_price_on_immediate_mode_gpus(
    tmp_path: Path, device: str
) -> None:
    name = write(tmp_path, FRAME, device)
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--output",
        "full",
        "--fail-on",
        "note",
        "--fail-on-cost",
        "1MB/s",
        name,
    )
    assert "MSAA201" in done.stdout and "MSAA203" in done.stdout
    assert "a hint to the driver" in done.stdout
    assert not any(word in done.stdout for word in ("warning", "MB/s", "mW", ": saves", "cost:")), (
        done.stdout
    )
    assert "fail-on-cost" not in done.stderr


@pytest.mark.parametrize("device", IMMEDIATE)
def test_samples_are_written_and_resolves_read_them_on_immediate_mode_gpus(
    tmp_path: Path, device: str
) -> None:
    found = cost(tmp_path, FRAME, device)
    assert (found["total"]["read_mb_per_s"], found["total"]["write_mb_per_s"]) == (
        1600,
        1600 + 1600 + 400,
    )
    by_count = {
        each["samples"]: each["read_mb_per_s"] + each["write_mb_per_s"]
        for each in found["variants"]
        if each["resolve"] != "separate"
    }
    assert by_count == {1: 800, 2: 2800, 4: 5200, 8: 10000}
    assert found["budget_milliwatts"] is None
    table = run(tmp_path, "cost", "frame.msaa.yaml").stdout
    assert "2500" not in table and "%" not in table
    assert "immediate-mode GPU" in table


def test_prices_say_on_a_tile_based_gpu_where_no_device_is_named(tmp_path: Path) -> None:
    name = write(tmp_path, FRAME, None)
    for output in ("full", "markdown", "html"):
        assert (
            "on a tile-based GPU"
            in run(tmp_path, "check", "--isolated", "--output", output, name).stdout
        ), output
    assert "on a tile-based GPU" in run(tmp_path, "cost", name).stdout
    write(tmp_path, FRAME, "mali-g76")
    assert (
        "on a tile-based GPU"
        not in run(tmp_path, "check", "--isolated", "--output", "full", name).stdout
    )


IMAGE = """
frame: {width: 2220, height: 1080, fps: 60}
images:
  image: {format: FORMAT, samples: SAMPLES, usage: [USAGE], flags: [FLAGS]}
renderPasses:
  scene:
    attachments: [{image: image, loadOp: LOAD, storeOp: STORE}]
    subpasses: [{ATTACHED}]
"""
POSSIBLE, IMPOSSIBLE = (0.484, 0.462), (1.0, 1.0)


@pytest.mark.parametrize(
    ("format", "samples", "usage", "flags", "least"),
    [
        ("R8G8B8A8_UNORM", 1, "COLOR_ATTACHMENT", "", POSSIBLE),
        ("D32_SFLOAT", 1, "DEPTH_STENCIL_ATTACHMENT", "", POSSIBLE),
        ("R16G16B16A16_SFLOAT", 1, "COLOR_ATTACHMENT", "", IMPOSSIBLE),
        ("B10G11R11_UFLOAT_PACK32", 1, "COLOR_ATTACHMENT", "", IMPOSSIBLE),
        ("R8G8B8A8_UNORM", 1, "COLOR_ATTACHMENT, STORAGE", "", IMPOSSIBLE),
        ("R8G8B8A8_UNORM", 1, "COLOR_ATTACHMENT", "MUTABLE_FORMAT", IMPOSSIBLE),
        ("R8G8B8A8_UNORM", 1, "COLOR_ATTACHMENT", "ALIAS", IMPOSSIBLE),
        ("R8G8B8A8_UNORM", 1, "COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT", "", IMPOSSIBLE),
        ("R8G8B8A8_UNORM", 4, "COLOR_ATTACHMENT", "", IMPOSSIBLE),
    ],
)
def test_a_mali_g76_compresses_by_image_and_the_range_holds_its_counters(
    tmp_path: Path, format: str, samples: int, usage: str, flags: str, least: tuple[float, float]
) -> None:
    attached = "depthStencilAttachment: 0" if format[0] == "D" else "colorAttachments: [0]"
    text = (
        IMAGE.replace("FORMAT", format, 1)
        .replace("SAMPLES", str(samples))
        .replace("USAGE", usage)
        .replace("FLAGS", flags)
    )
    total = cost(tmp_path, text.replace("ATTACHED", attached), "mali-g76")["total"]
    for name, low, measured in zip(
        ("read_mb_per_s", "write_mb_per_s"), least, (1.094, 1.011), strict=True
    ):
        assert total["corrected"][name] == pytest.approx(low * total[name])
        assert total["corrected"][name] <= measured * total[name] <= total["corrected_most"][name]


STATED = "{{vendor: {}, name: {}, compression: {{1: 0.5, 4: 0.75}}}}"


@pytest.mark.parametrize(
    ("device", "format", "samples", "least", "most"),
    [
        (STATED.format("qualcomm", "Adreno 740"), "R8G8B8A8_UNORM", 4, 0.75, 0.75),
        (STATED.format("arm", "Mali-G715"), "R8G8B8A8_UNORM", 4, 1, 1),
        (STATED.format("arm", "Mali-G78"), "R16G16B16A16_SFLOAT", 1, 1, 1),
        (STATED.format("arm", "Mali-G310"), "R16G16B16A16_SFLOAT", 1, 0.5, 0.5),
        (STATED.format("arm", "Mali-G510"), "R16G16B16A16_SFLOAT", 1, 0.5, 0.5),
        (STATED.format("arm", "Mali-G710"), "R16G16B16A16_SFLOAT", 1, 0.5, 0.5),
        (STATED.format("arm", "Mali-G710"), "R32G32_SFLOAT", 1, 1, 1),
        (STATED.format("arm", "our board"), "R16G16B16A16_SFLOAT", 1, 0.5, 1),
    ],
)
def test_stated_ratios_apply_to_what_the_gpu_may_compress(
    tmp_path: Path, device: str, format: str, samples: int, least: float, most: float
) -> None:
    text = (
        IMAGE.replace("FORMAT", format, 1)
        .replace("SAMPLES", str(samples))
        .replace("USAGE", "COLOR_ATTACHMENT")
        .replace("FLAGS", "")
    )
    total = cost(tmp_path, text.replace("ATTACHED", "colorAttachments: [0]"), device)["total"]
    assert total["corrected"]["read_mb_per_s"] == pytest.approx(least * total["read_mb_per_s"])
    assert total["corrected_most"]["read_mb_per_s"] == pytest.approx(most * total["read_mb_per_s"])
