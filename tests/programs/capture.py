"""Runs a scene in `scenes` under gfxreconstruct's layer, and converts what the layer wrote."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

SCENES = Path(__file__).parent / "scenes"
_LAYER = "VK_LAYER_LUNARG_gfxreconstruct"
_LAYER_FOLDERS = ("/usr/share", "/usr/local/share", "/etc")
_SECONDS = 120
"""Far more than a scene takes: llvmpipe on a busy machine is slow."""


class Scene(NamedTuple):
    """A script of ours that drives another's package."""

    script: str
    mode: str | None
    packages: tuple[tuple[str, str], ...]
    """Packages of PyPI and the modules that they contain."""

    interpreter: str | None = None
    """The program of Debian's package of that name that runs the script; else it is Python."""

    window: bool = False
    opengl: bool = False
    """Whether the package calls OpenGL, which Mesa's zink turns into Vulkan."""


def missing(scene: Scene) -> list[str]:
    """What has to be installed before the scene can be captured."""
    needs = [
        f"PyPI {package}"
        for package, module in scene.packages
        if importlib.util.find_spec(module) is None
    ]
    layers = [Path(folder, "vulkan", "explicit_layer.d") for folder in _LAYER_FOLDERS]
    if shutil.which("gfxrecon-convert") is None or not any(
        any(each.glob("VkLayer_gfxreconstruct*.json")) for each in layers
    ):
        needs.append("Debian gfxreconstruct")
    if scene.interpreter is not None and shutil.which(scene.interpreter) is None:
        needs.append(f"Debian {scene.interpreter}")
    if scene.window and shutil.which("Xvfb") is None:
        needs.append("Debian xvfb")
    return needs


@contextmanager
def _display(wanted: bool) -> Iterator[dict[str, str]]:
    if not wanted:
        yield {}
        return
    reading, writing = os.pipe()
    command = [
        "Xvfb",
        "-displayfd",
        str(writing),
        "-screen",
        "0",
        "1024x768x24",
        "-nolisten",
        "tcp",
    ]
    with (
        subprocess.Popen(command, pass_fds=[writing], stderr=subprocess.DEVNULL) as server,
        os.fdopen(reading) as number,
    ):
        os.close(writing)
        try:
            yield {"DISPLAY": f":{number.readline().strip()}"}
        finally:
            server.terminate()


def capture(scene: Scene, folder: Path) -> Path:
    """The capture as JSON Lines. AssertionError with the scene's output if it fails or draws
    nothing.
    """
    raw = folder / "scene.gfxr"
    layer = {
        "VK_INSTANCE_LAYERS": _LAYER,
        "GFXRECON_CAPTURE_FILE": str(raw),
        "GFXRECON_CAPTURE_FILE_TIMESTAMP": "false",
        "GFXRECON_MEMORY_TRACKING_MODE": "page_guard",
        "QML_DISABLE_DISK_CACHE": "1",
    }
    zink = (
        {
            "MESA_LOADER_DRIVER_OVERRIDE": "zink",
            "GALLIUM_DRIVER": "zink",
            "LIBGL_ALWAYS_SOFTWARE": "1",
        }
        if scene.opengl
        else {}
    )
    with _display(scene.window) as display:
        done = subprocess.run(
            [
                scene.interpreter or sys.executable,
                SCENES / scene.script,
                *([scene.mode] if scene.mode else []),
            ],
            cwd=folder,
            env={**os.environ, **layer, **zink, **display},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            timeout=_SECONDS,
        )
    assert done.returncode == 0 and raw.is_file(), done.stdout
    lines = raw.with_suffix(".gfxr.jsonl")
    convert = ["gfxrecon-convert", "--output", lines.name, raw.name]
    subprocess.run(
        convert, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    return lines
