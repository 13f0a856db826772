"""`msaa-lint study` of frames: of descriptions and captures, as a device draws them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
FRAMES = sorted(
    [
        *EXAMPLES.glob("*/*.msaa.yaml"),
        *EXAMPLES.glob("capture/*.jsonl"),
        *EXAMPLES.glob("capture/*.xml"),
    ]
)
SMALL = ("--size", "192x96", "--samples", "1,4", "--jobs", "1", "--isolated")
ON_LAVAPIPE = ("--device", "llvmpipe", "--repeats", "1")


def studied(folder: Path, *arguments: str, code: int = 0) -> dict[str, Any]:
    done = run(folder, "study", *arguments, *SMALL, "--output", "json")
    assert done.returncode == code, done.stderr
    data: dict[str, Any] = json.loads(done.stdout)
    return data


@pytest.mark.parametrize("path", FRAMES, ids=lambda path: path.name)
def test_every_example_is_studied(tmp_path: Path, path: Path) -> None:
    done = run(tmp_path, "study", str(path), *SMALL, "--techniques", "msaa")
    assert (done.returncode, done.stderr) == (0, "")
    assert "what the description calls for: " in done.stdout
    assert "Traceback" not in done.stdout and "internal error" not in done.stdout


@pytest.fixture(scope="module")
def forward(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A study of the phone's frame with all techniques under two costs of shading."""
    return studied(
        tmp_path_factory.mktemp("forward"),
        str(EXAMPLES / "phone/forward.msaa.yaml"),
        *ON_LAVAPIPE,
        "--shading",
        "none,200ops",
    )


def test_a_forward_frame_is_timed_as_it_is(forward: dict[str, Any]) -> None:
    """A software driver's count of invocations is left out."""
    data = forward
    (scene,) = data["scenes"]
    priced = (
        "bytes, power, and memory are those of the frame at its described size, 1080x2400, "
        "with a technique's sample count"
    )
    assert scene["assumed"] == ["the techniques apply to scene", priced]
    assert scene["says"].startswith("what the description calls for: mesh (triangles have ")
    assert (data["untimed"], data["failed"], data["errors"]) == ([], [], [])
    points = {(point["name"], point["shading"]): point for point in data["points"]}
    names = list(dict.fromkeys(point["name"] for point in data["points"]))
    assert names == [
        "1x",
        "4x",
        "4x, half of them shaded",
        "4x, each shaded",
        "SSAA 2x2",
        "SSAA 3x3",
        "SSAA 4x4",
    ]
    assert all(point["time_ms"] > 0 for point in data["points"])
    assert {points[name, "none"]["invocations"] for name in names} == {None}


def test_a_capture_is_timed_as_it_is(tmp_path: Path) -> None:
    data = studied(
        tmp_path,
        str(EXAMPLES / "capture/forward-fixed.jsonl"),
        *ON_LAVAPIPE,
        "--shading",
        "none",
        "--techniques",
        "msaa",
    )
    (scene,) = data["scenes"]
    assert any(note.startswith("the techniques apply to ") for note in scene["assumed"])
    assert [(point["name"], point["time_ms"] is not None) for point in data["points"]] == [
        ("1x", True),
        ("4x", True),
    ]


def test_the_bytes_of_a_frame_are_those_of_its_passes(
    tmp_path: Path, forward: dict[str, Any]
) -> None:
    """What `cost` says of the frame as written is what a study says of its sample count;
    supersampling is not described.
    """
    done = run(
        tmp_path,
        "cost",
        str(EXAMPLES / "phone/forward.msaa.yaml"),
        "--isolated",
        "--output",
        "json",
    )
    total = json.loads(done.stdout)["total"]
    points = {point["name"]: point for point in forward["points"]}
    assert points["4x"]["milliwatts"] == pytest.approx(total["milliwatts"], abs=0.01)
    assert points["4x"]["bytes_per_frame"] == pytest.approx(
        (total["read_mb_per_s"] + total["write_mb_per_s"]) * 1e6 / 60
    )
    assert points["SSAA 2x2"]["bytes_per_frame"] is None


def test_passes_that_are_never_begun_cost_nothing(tmp_path: Path) -> None:
    """A program creates render passes that a captured frame does not use."""
    path = str(ROOT / "tests/data/programs/wgpu-store.gfxr.jsonl.xz")
    data = studied(tmp_path, path, *ON_LAVAPIPE, "--shading", "none", "--techniques", "msaa")
    done = run(tmp_path, "cost", path, "--isolated", "--output", "json")
    cost = json.loads(done.stdout)
    (frame,) = cost["frames"]
    assert frame["unknown"] == ["`pass 4x #106`: no command begins it"]
    assert [point["bytes_per_frame"] is not None for point in data["points"]] == [True, True]
    assert data["points"][1]["memory_mib"] == pytest.approx(frame["total"]["memory_mib"], abs=1e-6)


def test_bytes_that_are_not_known_are_not_promised(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(
        "images: {c: {format: UNDEFINED, samples: 4, extent: {width: 64, height: 64}}}\n"
        "renderPasses: {p: {attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}, "
        "subpasses: [{colorAttachments: [c]}]}}\n"
    )
    data = studied(
        tmp_path, "frame.msaa.yaml", *ON_LAVAPIPE, "--shading", "none", "--techniques", "msaa"
    )
    (scene,) = data["scenes"]
    unknown = (
        "bytes, power, and memory are not estimated, as the frame leaves out what they "
        "depend on: see msaa-lint cost"
    )
    assert unknown in scene["assumed"]
    assert {point["bytes_per_frame"] for point in data["points"]} == {None}


def test_a_frame_with_shaders_has_their_cost(tmp_path: Path) -> None:
    """No cost of shading applies where all that draws has a shader of its own."""
    data = studied(
        tmp_path, str(EXAMPLES / "lit/forward.msaa.yaml"), *ON_LAVAPIPE, "--techniques", "msaa"
    )
    assert [(point["name"], point["shading"]) for point in data["points"]] == [
        ("1x", "as described"),
        ("4x", "as described"),
    ]
    assert all(point["time_ms"] > 0 and point["shading_ms"] == 0 for point in data["points"])


def test_a_stated_cost_replaces_the_shaders_of_a_frame(tmp_path: Path) -> None:
    data = studied(
        tmp_path,
        str(EXAMPLES / "lit/forward.msaa.yaml"),
        *ON_LAVAPIPE,
        "--techniques",
        "msaa",
        "--shading",
        "none,2000ops",
    )
    names = [(point["name"], point["shading"]) for point in data["points"]]
    assert names == [("1x", "none"), ("4x", "none"), ("1x", "2000ops"), ("4x", "2000ops")]
    assert (
        "the frame's own shaders are replaced by those of a stated cost"
        in data["scenes"][0]["assumed"]
    )
    assert all(
        (point["shading_ms"] > 0) == (point["shading"] == "2000ops") for point in data["points"]
    )


def test_a_slow_frame_has_fewer_rounds_and_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("msaa_lint.experiments.study.times.SOFTWARE_SECONDS", 1e-6)
    options = ("--device", "llvmpipe", "--shading", "none", "--techniques", "msaa")
    (scene,) = studied(tmp_path, "wires", *options)["scenes"]
    assert scene["assumed"] == [
        "times are medians of 3 rounds instead of 15, as a round takes long; so few give no "
        "interval of 95 %, but that of all"
        " (--repeats N takes N)"
    ]


def test_a_technique_that_a_frame_cannot_have_says_why(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(
        "images: {c: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}}}\n"
        "renderPasses: {p: {attachments: {c: {image: c, loadOp: LOAD, storeOp: STORE}}, subpasses: "
        "[{colorAttachments: [c]}]}}\n"
    )
    data = studied(
        tmp_path, "frame.msaa.yaml", *ON_LAVAPIPE, "--shading", "none", "--techniques", "msaa"
    )
    reason = "no pass of the frame draws geometry to color attachments that it clears"
    assert data["untimed"] == [{"name": "4x", "reason": reason}]
    assert [(point["name"], point["time_ms"] is not None) for point in data["points"]] == [
        ("1x", True),
        ("4x", False),
    ]


@pytest.mark.parametrize(
    ("text", "size"),
    [
        ("frame: {width: 320, height: 200}\n", [320, 200]),
        (
            "images: {c: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 300, height: 240}}}\n"
            "PASS",
            [300, 240],
        ),
        (
            "images: {c: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 16, height: 16}}}\n"
            "PASS",
            [1920, 1080],
        ),
    ],
)
def test_a_frame_has_its_own_size(tmp_path: Path, text: str, size: list[int]) -> None:
    attachments = "{c: {image: c, loadOp: CLEAR, storeOp: STORE}}"
    frame = text.replace(
        "PASS",
        f"renderPasses: {{p: {{attachments: {attachments}, subpasses: [{{colorAttachments: "
        f"[c]}}]}}}}\n",
    )
    (tmp_path / "frame.msaa.yaml").write_text(frame)
    done = run(
        tmp_path,
        "study",
        "frame.msaa.yaml",
        "--samples",
        "1",
        "--techniques",
        "msaa",
        "--jobs",
        "1",
        "--output",
        "json",
    )
    assert json.loads(done.stdout)["size"] == size
