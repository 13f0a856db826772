"""The commands on a frame in Metal's words: cost, study, confirm, facts."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests import command
from tests.frame.metal.frames import ARTICLE, BEST

ONE = 1920 * 1080 * 60 / 1e6
"""MB/s of one byte a pixel."""


def run(folder: Path, *arguments: str, code: int = 0) -> str:
    (folder / "article.msaa.yaml").write_text(ARTICLE)
    (folder / "best.msaa.yaml").write_text(BEST)
    done = command.run(folder, *arguments, NO_COLOR="1")
    assert done.returncode == code, done.stderr
    return done.stdout


def cost(folder: Path, file: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(run(folder, "cost", file, "--output", "json"))
    return found


def test_cost(tmp_path: Path) -> None:
    article, best = cost(tmp_path, "article.msaa.yaml"), cost(tmp_path, "best.msaa.yaml")
    # Four samples of colour and of depth, and the picture they are resolved to: r8Unorm is one
    # byte, depth32Float four.
    assert article["total"]["write_mb_per_s"] == pytest.approx((4 + 16 + 1) * ONE)
    assert best["total"]["write_mb_per_s"] == pytest.approx(ONE)
    assert best["total"]["memory_mib"] == pytest.approx(1920 * 1080 / 2**20)
    assert article["total"]["memory_mib"] == pytest.approx(21 * 1920 * 1080 / 2**20)
    assert [each["path"] for each in best["passes"]] == ["metal.renderPasses.forward"]


def test_what_a_finding_costs(tmp_path: Path) -> None:
    found = json.loads(
        run(tmp_path, "check", "article.msaa.yaml", "--output", "json", "--isolated", code=1)
    )
    by_rule = {each["rule"]: each for each in found["findings"]}
    assert by_rule["metal-samples-stored-unread"]["price"]["write_mb_per_s"] == pytest.approx(
        4 * ONE, rel=1e-3
    )
    assert by_rule["metal-memoryless-possible"]["price"]["memory_mib"] == pytest.approx(
        16 * 1920 * 1080 / 2**20, rel=1e-3
    )


def test_study(tmp_path: Path) -> None:
    pytest.importorskip("numpy")
    text = run(
        tmp_path,
        "study",
        "best.msaa.yaml",
        "--samples",
        "1,4",
        "--size",
        "64x36",
        "--techniques",
        "msaa",
        "--output",
        "json",
    )
    found = json.loads(text)
    one, four = found["points"]
    assert (found["model"], one["samples"], four["samples"]) == ("apple7", 1, 4)
    assert four["rmse"] < one["rmse"] / 2
    # As it is described: inline, so that samples cost the tile alone.
    assert four["bytes_per_frame"] == one["bytes_per_frame"] == 64 * 36 * 4


def test_facts(tmp_path: Path) -> None:
    lines = run(tmp_path, "facts", "article.msaa.yaml").splitlines()
    assert "image metal.textures.ms (line 5)" in lines
    assert any(
        line.split() == ["aspect.store_action", "storeAndMultisampleResolve", "(line", "11)"]
        for line in lines
    )


def test_confirm(tmp_path: Path) -> None:
    pytest.importorskip("vulkan")
    found = json.loads(
        run(
            tmp_path,
            "confirm",
            "--isolated",
            "--output",
            "json",
            "article.msaa.yaml",
            "best.msaa.yaml",
        )
    )
    passes = found["passes"]
    assert [(each["path"], each["status"]) for each in passes] == [
        ("metal.renderPasses.forward", "confirmed")
    ] * 2
    for each in passes:
        assert (
            each["notes"][0]
            == "the frame is described in terms of Metal: the equivalent Vulkan pass is drawn"
        )
    both = {each["rule"] for each in passes[0]["messages"] if each["verdict"] == "both"}
    assert {"multisampled-attachment-stored", "multisampled-depth-stored"} <= both
    assert not [each for each in passes[1]["messages"] if each["verdict"] in ("ours", "theirs")]
