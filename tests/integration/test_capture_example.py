"""The program in examples/capture: it runs, draws the same picture with its mistakes and without,
and captured anew, by gfxreconstruct and by RenderDoc, it has the findings of the captures that are
kept beside it.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections import Counter
from pathlib import Path

import pytest

from tests.command import run
from tests.paths import ROOT

EXAMPLE = ROOT / "examples" / "capture"
CAPTURES = ("forward.jsonl", "forward-fixed.jsonl", "forward.xml")
WIDTH, HEIGHT = 320, 180


def findings(path: Path) -> Counter[tuple[str, str, str]]:
    """Rule, severity and subject of what is found. Numbers of commands and passes depend on how
    many frames a capture has.
    """
    done = run(ROOT, "check", "--isolated", "--output", "json", str(path))
    assert done.returncode in (0, 1), done.stderr
    return Counter(
        (each["rule"], each["severity"], each["subject"])
        for each in json.loads(done.stdout)["findings"]
    )


@pytest.fixture(scope="module")
def anew(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with captures made now."""
    folder = tmp_path_factory.mktemp("captured")
    done = subprocess.run(
        ["sh", EXAMPLE / "capture.sh", folder], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return folder


@pytest.fixture(scope="module")
def forward(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The program, built with every warning an error."""
    program = tmp_path_factory.mktemp("built") / "forward"
    sources = [str(EXAMPLE / name) for name in ("forward.c", "device.c")]
    warnings = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Werror"]
    subprocess.run(
        [os.environ.get("CC", "cc"), *warnings, "-o", str(program), *sources, "-lvulkan", "-ldl"],
        check=True,
    )
    return program


def drawn(forward: Path, *arguments: str) -> bytes:
    """The picture of a run, three bytes to a pixel."""
    path = forward.with_suffix(".ppm")
    subprocess.run(
        [forward, "--frames", "3", "--picture", path, *arguments],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    head, pixels = path.read_bytes().split(b"\n255\n", 1)
    assert head == f"P6\n{WIDTH} {HEIGHT}".encode()
    assert len(pixels) == WIDTH * HEIGHT * 3
    return pixels


def test_the_mistakes_do_not_show(forward: Path) -> None:
    """Half floats and bytes round differently, by two steps of 255 at most."""
    wrong, right = drawn(forward), drawn(forward, "--fixed")
    assert len(set(right)) > 100, "a picture of something"
    assert max(abs(one - other) for one, other in zip(wrong, right, strict=True)) <= 2


def test_the_layer_finds_no_error(forward: Path, tmp_path: Path) -> None:
    """Mistakes are of what is allowed."""
    (tmp_path / "vk_layer_settings.txt").write_text(
        "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
        "khronos_validation.log_filename = said.txt\n"
        "khronos_validation.report_flags = error,warn,perf\n"
        "khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT\n",
        encoding="utf-8",
    )
    layer = {
        **os.environ,
        "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
        "VK_LAYER_SETTINGS_PATH": str(tmp_path),
    }
    subprocess.run(
        [forward, "--frames", "3"], cwd=tmp_path, env=layer, check=True, stdout=subprocess.DEVNULL
    )
    said = (tmp_path / "said.txt").read_text(encoding="utf-8")
    assert "vkCreateRenderPass-image-requires-memory" in said, "the layer is on"
    assert re.findall(r"^.*\(ERROR .*$", said, re.MULTILINE) == []


@pytest.mark.parametrize("name", CAPTURES)
def test_captured_anew_it_has_the_same_findings(anew: Path, name: str) -> None:
    assert findings(anew / name) == findings(EXAMPLE / name)


def test_two_tools_show_the_same(anew: Path) -> None:
    assert findings(anew / "forward.xml") == findings(anew / "forward.jsonl")


@pytest.mark.parametrize(
    ("name", "text"), [("forward.gfxr", "forward.jsonl"), ("forward.rdc", "forward.xml")]
)
def test_a_binary_capture_has_the_findings_of_the_converted_one(
    anew: Path, name: str, text: str
) -> None:
    """Through the tools' converters, and with the code of its shaders, which neither text has."""
    assert findings(anew / name) == findings(anew / text)
    assert "shaders/" in run(anew, "convert", name).stdout
    assert "shaders/" not in run(anew, "convert", text).stdout


@pytest.mark.parametrize("name", ["forward-fixed.jsonl", "forward-fixed.xml"])
def test_without_its_mistakes_nothing_is_found(anew: Path, name: str) -> None:
    assert not findings(anew / name)


@pytest.mark.parametrize("name", CAPTURES)
def test_captures_are_small_and_name_no_folder(name: str) -> None:
    text = (EXAMPLE / name).read_text(encoding="utf-8")
    assert len(text) < 400_000
    assert re.findall(r"/(?:tmp|home|root|usr|build|work)\b[^\"<]*", text) == []


def test_shaders_are_fresh(tmp_path: Path) -> None:
    subprocess.run(["sh", EXAMPLE / "shaders.sh", tmp_path / "shaders.h"], check=True)
    assert (tmp_path / "shaders.h").read_bytes() == (EXAMPLE / "shaders.h").read_bytes()


def mistakes() -> list[tuple[int, str, str, str]]:
    """Number, rule, pass and words of the comments."""
    text = (EXAMPLE / "forward.c").read_text(encoding="utf-8")
    comments = re.findall(
        r"/\* Mistake (\d+), ([a-z-]+), (scene|mirror|glow|composite): (.*?)\. \*/", text
    )
    assert len(comments) == text.count("/* Mistake")
    return sorted((int(number), rule, where, words) for number, rule, where, words in comments)


def test_every_mistake_has_a_number_and_a_rule_and_is_told_of() -> None:
    """docs/replayed.py writes the page."""
    count = int(
        re.findall(r"MISTAKES = (\d+)", (EXAMPLE / "forward.c").read_text(encoding="utf-8"))[0]
    )
    assert [number for number, *_ in mistakes()] == list(range(1, count + 1))
    page = (ROOT / "docs" / "captures-and-the-layer.md").read_text(encoding="utf-8")
    for number, rule, where, words in mistakes():
        assert (ROOT / "rules" / f"{rule}.md").is_file()
        assert f"| {number} | {where}: {words} |" in page


def test_every_mistake_is_found_among_all() -> None:
    """By its rule; docs/captures-and-the-layer.md has each alone."""
    found = {rule for rule, _, _ in findings(EXAMPLE / "forward.jsonl")}
    assert {rule for _, rule, _, _ in mistakes()} <= found
