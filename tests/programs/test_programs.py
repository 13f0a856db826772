"""Programs that call Vulkan through another's package: what is found in a capture of each, as
reading its calls tells.

Each is checked twice: in the capture in tests/data/programs, and in one made now where the packages
are installed.
"""

from __future__ import annotations

import json
import lzma
from collections import Counter, defaultdict
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest

from tests.command import run
from tests.paths import ROOT
from tests.programs.capture import Scene, capture, missing

RECORDED = ROOT / "tests" / "data" / "programs"
PIXELS = 640 * 360
MB_PER_S = PIXELS * 16 * 60 / 1e6
"""Four samples of four bytes, 60 times a second: 221.2."""

WASTED = (
    "MSAA201",
    "MSAA202",
    "MSAA203",
    "MSAA204",
    "MSAA207",
    "MSAA301",
    "MSAA307",
    "MSAA401",
    "MSAA406",
)
"""Rules about multisampled images that are stored, loaded, resolved or kept in vain. Those that
`findings` does not name find nothing.
"""


class Program(NamedTuple):
    """A scene, and what its calls show."""

    scene: Scene
    frames: int
    findings: dict[str, int]
    prices: Mapping[str, tuple[str, float]] = MappingProxyType({})
    """The sum over the rule's findings."""

    unclear: tuple[str, ...] = ()
    """Rules that may find something: the calls do not tell whether they should."""


def _zink(script: str, package: str, module: str) -> Scene:
    return Scene(script, None, ((package, module),), window=True, opengl=True)


def _moderngl(mode: str) -> Scene:
    return Scene(
        "moderngl_triangle.py",
        mode,
        (("moderngl", "moderngl"), ("glfw", "glfw")),
        window=True,
        opengl=True,
    )


WGPU = (("wgpu", "wgpu"), ("numpy", "numpy"))
PROGRAMS = {
    # The resolve target is cleared before the resolve overwrites it; the images' usage is not
    # transient.
    "wgpu-discard": Program(
        Scene("wgpu_triangle.py", "discard", WGPU), 4, {"MSAA205": 1, "MSAA401": 2}
    ),
    "wgpu-store": Program(
        Scene("wgpu_triangle.py", "store", WGPU),
        4,
        {"MSAA201": 1, "MSAA203": 1, "MSAA205": 1, "MSAA401": 2},
        {"MSAA201": ("write_mb_per_s", MB_PER_S), "MSAA203": ("write_mb_per_s", MB_PER_S)},
    ),
    # The second pass loads what the first one stored, color and depth.
    "wgpu-two": Program(
        Scene("wgpu_triangle.py", "two", WGPU),
        4,
        {"MSAA202": 2, "MSAA205": 1},
        {"MSAA202": ("read_mb_per_s", 2 * MB_PER_S)},
    ),
    # A shader reads every sample of depth: whether one value per pixel would do, only the shader
    # tells.
    "wgpu-depth": Program(
        Scene("wgpu_triangle.py", "depth", WGPU),
        4,
        {"MSAA205": 1, "MSAA401": 1},
        unclear=("MSAA307",),
    ),
    # The swapchain has three images, each with a multisampled one of its own; the layer's is not
    # transient.
    "qt-quick": Program(
        Scene("qt_quick.py", None, (("PySide6", "PySide6"),), window=True),
        7,
        {"MSAA205": 1, "MSAA401": 1, "MSAA406": 1},
    ),
    # OpenGL resolves when the window is shown, by a command, and stores depth, which nothing reads.
    # In the first frame, zink fills the window by a pass before the program clears it: MSAA201.
    "panda3d": Program(
        _zink("panda3d_card.py", "panda3d", "panda3d"),
        6,
        {"MSAA201": 1, "MSAA203": 1, "MSAA301": 1, "MSAA401": 1},
    ),
    # One frame of six loads what it drew before, so depth has to be in memory.
    "pyglet": Program(
        _zink("pyglet_star.py", "pyglet", "pyglet"),
        6,
        {"MSAA201": 1, "MSAA202": 2, "MSAA203": 1, "MSAA301": 1},
        {"MSAA202": ("read_mb_per_s", 2 * MB_PER_S / 6)},
    ),
    # The texture that is drawn first interrupts the window's pass, which then loads color, depth
    # and stencil. One frame begins a rendering that clears twice in a row.
    "raylib": Program(
        _zink("raylib_cube.py", "raylib", "pyray"),
        7,
        {"MSAA201": 2, "MSAA202": 2, "MSAA203": 1, "MSAA204": 1, "MSAA301": 1},
    ),
    # As raylib's, but the canvas has four samples too, and is resolved by a command of its own. A
    # first window is never shown.
    "love": Program(
        Scene("love_circles", None, (), interpreter="love", window=True, opengl=True),
        7,
        {"MSAA201": 3, "MSAA202": 2, "MSAA203": 1, "MSAA204": 1, "MSAA301": 2, "MSAA401": 1},
    ),
    "moderngl-blit": Program(_moderngl("blit"), 7, {"MSAA203": 1, "MSAA301": 1, "MSAA401": 1}),
    # The shader that averages the samples is not in the capture, but the descriptor and the layout
    # are.
    "moderngl-shader": Program(_moderngl("shader"), 7, {"MSAA203": 1, "MSAA401": 1}),
    "pygfx": Program(Scene("pygfx_cube.py", None, (("pygfx", "pygfx"), *WGPU)), 4, {}),
}


def findings(path: Path, *arguments: str) -> list[dict[str, Any]]:
    """What is found, with confidence medium or high."""
    done = run(path.parent, "check", "--isolated", "--output", "json", *arguments, path.name)
    assert done.returncode in (0, 1), done.stderr
    return [each for each in json.loads(done.stdout)["findings"] if each["confidence"] != "low"]


def expect(program: Program, path: Path) -> None:
    """The findings of a capture and of the description that is made of it."""
    found = findings(path)
    codes = Counter(each["code"] for each in found)
    rules = {*WASTED, *program.findings} - {*program.unclear}
    assert {code: codes[code] for code in rules if codes[code]} == program.findings
    assert {each["seen"]["of"] for each in found if each.get("seen")} <= {program.frames}
    prices: dict[str, float] = defaultdict(float)
    # The software driver that drew the frame has no tiles to load or store.
    for each in findings(path, "--profile", "mali-g76"):
        if each["code"] in program.prices:
            prices[each["code"]] += each["price"][program.prices[each["code"]][0]]
    assert prices == {
        code: pytest.approx(price, rel=0.02) for code, (_, price) in program.prices.items()
    }
    description = path.parent / "scene.msaa.yaml"
    done = run(path.parent, "convert", path.name, "-o", description.name)
    assert done.returncode == 0, done.stderr
    assert Counter(each["code"] for each in findings(description)) == codes


@pytest.mark.parametrize("name", PROGRAMS)
def test_recorded(name: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.gfxr.jsonl"
    path.write_bytes(lzma.decompress((RECORDED / f"{name}.gfxr.jsonl.xz").read_bytes()))
    expect(PROGRAMS[name], path)


@pytest.mark.parametrize("name", PROGRAMS)
def test_captured_now(name: str, tmp_path: Path) -> None:
    needs = missing(PROGRAMS[name].scene)
    if needs:
        pytest.skip(f"not installed: {', '.join(needs)}")
    expect(PROGRAMS[name], capture(PROGRAMS[name].scene, tmp_path))
