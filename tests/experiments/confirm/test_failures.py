"""What fails inside `confirm` and `study` is said, with exit code 2, and nothing is left of a run
however it ends.
"""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.scratch import PREFIX
from tests.command import Done, environment_of, run, run_process

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="signals and locks are POSIX; lavapipe is Linux's"
)
GLSLANG = shutil.which("glslangValidator")
needs_compiler = pytest.mark.skipif(GLSLANG is None, reason="glslangValidator is not installed")

FRAME = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64}, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  color: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}, usage: [COLOR_ATTACHMENT]}
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
pipelines:
  p:
    renderPass: forward
    subpass: 0
    multisampleState: {rasterizationSamples: 4}
    stages:
      - {stage: FRAGMENT, module: MODULE, specialization: CONSTANTS}
"""

SHADER = """\
#version 450
layout(constant_id = 0) const uint natural = 1u;
layout(constant_id = 1) const float real = 0.0;
layout(constant_id = 2) const bool truth = false;
layout(constant_id = 3) const int whole = 0;
layout(location = 0) out vec4 color;
void main() {
    bool all_right = natural == 4294967295u && real == 2.0 && truth && whole == -2147483647 - 1;
    color = all_right ? vec4(0.0, 1.0, 0.0, 1.0) : vec4(1.0, 0.0, 0.0, 1.0);
}
"""


@pytest.fixture(scope="module")
def spirv(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    assert GLSLANG is not None
    folder = tmp_path_factory.mktemp("compiled")
    (folder / "s.frag").write_text(SHADER)
    subprocess.run(
        [GLSLANG, "-V", "s.frag", "-o", "s.spv"], cwd=folder, check=True, capture_output=True
    )
    return (folder / "s.spv").read_bytes()


@pytest.fixture
def project(tmp_path: Path, spirv: bytes) -> Path:
    folder = tmp_path / "project"
    (folder / ".git").mkdir(parents=True)
    (folder / "frames" / "shaders").mkdir(parents=True)
    (folder / "frames" / "shaders" / "s.spv").write_bytes(spirv)
    (tmp_path / "outside.spv").write_bytes(spirv)
    return folder


def confirmed(folder: Path, module: str, constants: str = "{}") -> tuple[int, dict[str, Any]]:
    """The exit code, and the verdict on the pass of a frame with a shader."""
    (folder / "frames" / "f.msaa.yaml").write_text(
        FRAME.replace("MODULE", module).replace("CONSTANTS", constants)
    )
    done = run(folder, "confirm", "frames/f.msaa.yaml", "--output", "json", "--image", "pictures")
    (verdict,) = json.loads(done.stdout)["passes"]
    return done.returncode, verdict


@needs_compiler
def test_a_shader_named_by_a_relative_path_runs_with_constants_of_every_type(project: Path) -> None:
    constants = "{0: 4294967295, 1: 2, 2: true, 3: -2147483648, 9: 1.5}"
    code, verdict = confirmed(project, "shaders/s.spv", constants)
    assert (code, verdict["status"], verdict["notes"]) == (0, "confirmed", [])
    green = (project / "pictures" / "frames-f.msaa.yaml-color-as-written.png").read_bytes()
    code, verdict = confirmed(project, "shaders/s.spv", constants.replace("4294967295", "-1"))
    assert (project / "pictures" / "frames-f.msaa.yaml-color-as-written.png").read_bytes() == green
    confirmed(project, "shaders/s.spv", constants.replace("1: 2", "1: 2.5"))
    assert (project / "pictures" / "frames-f.msaa.yaml-color-as-written.png").read_bytes() != green


@needs_compiler
@pytest.mark.parametrize(
    ("constants", "text"),
    [
        (
            "{0: 4294967296}",
            "constant 0 of the fragment shader of p is 4294967296, which its type uint32 cannot "
            "represent",
        ),
        (
            "{0: 1.5}",
            "constant 0 of the fragment shader of p is 1.5, which its type uint32 cannot represent",
        ),
        (
            "{1: 1.0e+60}",
            "constant 1 of the fragment shader of p is 1e+60, which its type float32 cannot "
            "represent",
        ),
        (
            "{3: -2147483649}",
            "constant 3 of the fragment shader of p is -2147483649, which its type int32 cannot "
            "represent",
        ),
    ],
)
def test_a_constant_that_its_type_does_not_have_is_no_success(
    project: Path, constants: str, text: str
) -> None:
    code, verdict = confirmed(project, "shaders/s.spv", constants)
    assert (code, verdict["status"]) == (2, "failed")
    assert verdict["reason"] == f"specialization {text}"


@needs_compiler
@pytest.mark.parametrize("kind", ["path", "link", "folder", "absolute"])
def test_a_shader_outside_the_project_is_refused(project: Path, kind: str) -> None:
    outside = project.parent / "outside.spv"
    (project / "frames" / "link.spv").symlink_to(outside)
    (project / "frames" / "folder").symlink_to(project.parent)
    module = {
        "path": "../../outside.spv",
        "link": "link.spv",
        "folder": "folder/outside.spv",
        "absolute": str(outside),
    }[kind]
    code, verdict = confirmed(project, module)
    assert (code, verdict["status"]) == (2, "failed")
    assert "is outside the project; move it into the project" in verdict["reason"]


@needs_compiler
def test_a_pipe_in_place_of_a_shader_is_not_waited_for(project: Path) -> None:
    os.mkfifo(project / "frames" / "pipe.spv")
    code, verdict = confirmed(project, "pipe.spv")
    assert (code, verdict["status"]) == (2, "failed")
    assert verdict["reason"].endswith("cannot be read: it is a pipe, not a regular file")


def test_no_manifest_of_the_checkout_is_loaded(tmp_path: Path) -> None:
    """Neither by a relative path, nor by an absolute one, nor from a home in the checkout."""
    (tmp_path / "f.msaa.yaml").write_text(FRAME.partition("pipelines:")[0])
    (tmp_path / ".git").mkdir()
    library = tmp_path / "library.so"
    if subprocess.run(
        ["cc", "-shared", "-o", str(library), "-x", "c", "-"], input=LIBRARY.encode(), check=False
    ).returncode:
        pytest.skip("there is no C compiler")
    layer = {"name": "VK_LAYER_EVIL", "type": "GLOBAL", "library_path": str(library),
    "api_version": "1.3.0", "implementation_version": "1",
             "description": "evil", "disable_environment": {"NO_EVIL": "1"}}  # fmt: skip
    driver = {"library_path": str(library), "api_version": "1.3.0"}
    for folder in (
        "vulkan/implicit_layer.d",
        "vulkan/explicit_layer.d",
        "vulkan/icd.d",
        "home/.local/share/vulkan/implicit_layer.d",
    ):
        (tmp_path / folder).mkdir(parents=True)
        kind = {"ICD": driver} if folder.endswith("icd.d") else {"layer": layer}
        (tmp_path / folder / "evil.json").write_text(
            json.dumps({"file_format_version": "1.0.0", **kind})
        )
    environments: list[dict[str, str]] = []
    for root in ("", str(tmp_path)):
        driver_file, layers = (
            os.path.join(root, "vulkan/icd.d/evil.json"),
            os.path.join(root, "vulkan/explicit_layer.d"),
        )
        implicit = os.path.join(root, "vulkan/implicit_layer.d")
        # Only what the loader reads beside the others is together.
        environments += [
            {
                "VK_ICD_FILENAMES": driver_file,
                "VK_LAYER_PATH": layers,
                "VK_INSTANCE_LAYERS": "VK_LAYER_EVIL",
            },
            {
                "VK_DRIVER_FILES": driver_file,
                "VK_IMPLICIT_LAYER_PATH": implicit,
                "LD_LIBRARY_PATH": str(tmp_path),
                "LD_PRELOAD": "",
            },
            {
                "VK_ADD_DRIVER_FILES": driver_file,
                "XDG_DATA_HOME": root or ".",
                "XDG_DATA_DIRS": root,
                "HOME": os.path.join(root, "home"),
            },
        ]
    for environment in environments:
        done = run_process(
            tmp_path,
            "confirm",
            "f.msaa.yaml",
            "--no-layer",
            EVIL=str(tmp_path / "owned"),
            **environment,
        )
        assert not (tmp_path / "owned").exists(), environment
        assert done.returncode == 0, (environment, done.stderr)


LIBRARY = """\
#include <stdio.h>
#include <stdlib.h>
__attribute__((constructor)) static void owned(void) {
    FILE *file = fopen(getenv("EVIL") ? getenv("EVIL") : "/dev/null", "w");
    if (file) fclose(file);
}
"""


def study(folder: Path, *names: str) -> Done:
    return run(
        folder,
        "study",
        *names,
        "--size",
        "32x32",
        "--samples",
        "1",
        "--techniques",
        "msaa",
        "--jobs",
        "1",
        "--output",
        "json",
    )


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
)


@pytest.mark.parametrize(
    ("name", "text", "problem"),
    [
        ("a.obj", f"{TRIANGLE}f 1 2 9\n", "line 4: a face refers to vertex 9, but the file has 3"),
        (
            "a.obj",
            f"{TRIANGLE}f 0 1 2\n",
            "line 4: a face refers to vertex 0, which does not exist",
        ),
        (
            "a.obj",
            f"{TRIANGLE}f -4 -2 -1\n",
            "line 4: a face refers to vertex -4, which does not exist",
        ),
        ("a.obj", f"{TRIANGLE}f 1 2\n", "line 4: a face needs three vertices"),
        ("a.obj", f"{TRIANGLE}f a b c\n", "line 4: a face must consist of numbers of vertices"),
        (
            "a.obj",
            f"{TRIANGLE}f 1 2 {'9' * 30}\n",
            f"line 4: a face refers to vertex {'9' * 30}, but the file has 3",
        ),
        ("a.obj", "v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n", "line 1: a vertex needs x, y, and z"),
        ("a.obj", f"{TRIANGLE}v 1e300 0 0\nf 1 2 4\n", "a vertex has a coordinate above 1e+100"),
        (
            "a.obj",
            f"{TRIANGLE}v nan 0 0\nf 1 2 4\n",
            "a vertex has a coordinate that is not finite",
        ),
        ("a.obj", f"{TRIANGLE}f 1 1 1\n", "the mesh has no visible extent"),
        (
            "a.obj",
            "v 0 0 0\nv 1e-320 0 0\nv 0 1e-320 0\nf 1 2 3\n",
            "the mesh is too small: its extent is not a normal number",
        ),
        (
            "a.ply",
            f"{PLY}3 0 1 9\n",
            "a face refers to vertex 9 (counting from 0), but the file has 3",
        ),
        (
            "a.ply",
            f"{PLY}3 0 1 -1\n",
            "a face refers to vertex -1 (counting from 0), but the file has 3",
        ),
        ("a.ply", "ply\n", "its header and its data do not fit together"),
    ],
)
def test_a_broken_mesh_is_a_finding_and_the_others_are_studied(
    tmp_path: Path, name: str, text: str, problem: str
) -> None:
    (tmp_path / name).write_text(text)
    (tmp_path / "good.obj").write_text(f"{TRIANGLE}f -3 -2 -1\n")
    done = study(tmp_path, name, "good.obj")
    data = json.loads(done.stdout)
    assert done.returncode == 2
    assert [scene["name"] for scene in data["scenes"]] == ["good.obj"]
    (error,) = data["errors"]
    assert (
        error["file"],
        error["message"].removeprefix(f"the file is not a valid {name[2:].upper()} mesh: "),
    ) == (name, problem)
    assert done.stderr == f"msaa-lint: {name}: {error['message']}\n"


STUDY = ("study", "edge-fan", "foliage", "--size", "1024x1024", "--jobs", "2")
DIVIDED = ("confirm", "many", "--no-time", "--jobs", "2")
SLOW = ("confirm", "f.msaa.yaml", "--time", "--repeats", "10000", "--size", "4096x4096")


@contextlib.contextmanager
def started(
    folder: Path, temporary: Path, command: tuple[str, ...]
) -> Iterator[subprocess.Popen[bytes]]:
    """A run that has started its child processes. At the end, it is killed, and so are they."""
    (folder / "f.msaa.yaml").write_text(FRAME.partition("pipelines:")[0])
    (folder / "many").mkdir()
    for number in range(400 if command is DIVIDED else 0):
        shutil.copy(folder / "f.msaa.yaml", folder / "many" / f"{number}.msaa.yaml")
    environment = environment_of({"TMPDIR": str(temporary), "MARK": str(temporary)})
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(
        [sys.executable, "-m", "msaa_lint", *command],
        cwd=folder,
        env=environment,
        stdout=quiet,
        stderr=quiet,
    )
    descendants: list[int] = []
    try:
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None:
            descendants = children(process.pid)
            if descendants and (command is STUDY or list(temporary.glob(f"{PREFIX}*"))):
                break
            time.sleep(0.05)
        # They are at work, not starting.
        time.sleep(0.7)
        assert process.poll() is None, "the run has ended before its signal"
        descendants = children(process.pid)
        yield process
    finally:
        process.kill()
        process.wait()
        for number in alive(descendants):
            with contextlib.suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)


def children(parent: int) -> list[int]:
    """The processes that a process started, and those that they started."""
    try:
        numbers = [
            int(number)
            for number in Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
        ]
    except OSError:
        return []
    return [*numbers, *(below for number in numbers for below in children(number))]


def alive(numbers: list[int]) -> list[int]:
    states = {number: Path(f"/proc/{number}/stat") for number in numbers}
    return [
        number
        for number, path in states.items()
        if path.exists() and path.read_text().rpartition(")")[2].split()[0] != "Z"
    ]


def ended(numbers: list[int]) -> bool:
    """Whether the processes end within five seconds."""
    deadline = time.monotonic() + 5
    while alive(numbers) and time.monotonic() < deadline:
        time.sleep(0.05)
    return not alive(numbers)


@pytest.mark.parametrize("command", [SLOW, DIVIDED, STUDY], ids=["confirm", "jobs", "study"])
@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGQUIT, signal.SIGTERM, signal.SIGINT])
def test_no_signal_leaves_a_folder_or_a_process(
    tmp_path: Path, number: signal.Signals, command: tuple[str, ...]
) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with started(tmp_path, temporary, command) as process:
        descendants = children(process.pid)
        process.send_signal(number)
        assert process.wait(30) == (130 if number == signal.SIGINT else 128 + number)
        assert ended(descendants)
    assert list(temporary.iterdir()) == []


def test_a_killed_run_leaves_nothing_after_the_next_start(tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    with started(tmp_path, temporary, SLOW) as process:
        descendants = children(process.pid)
        # One for the session with the validation layer, and one for that which measures times.
        abandoned = list(temporary.iterdir())
        assert abandoned and all(path.name.startswith(PREFIX) for path in abandoned)
        # Another run does not remove the folders of one that still runs.
        assert (
            run_process(tmp_path, "confirm", "--list-devices", TMPDIR=str(temporary)).returncode
            == 0
        )
        assert all(path.exists() for path in abandoned)
        process.kill()
        process.wait()
        assert ended(descendants)
    assert all(path.exists() for path in abandoned)
    # Neither a link to a folder nor a locked folder is removed.
    victim, other = tmp_path / "victim", temporary / f"{PREFIX}locked"
    for folder in (victim, other):
        folder.mkdir()
        (folder / "lock").write_text("")
    (temporary / f"{PREFIX}link").symlink_to(victim)
    with open(other / "lock") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert (
            run_process(tmp_path, "confirm", "--list-devices", TMPDIR=str(temporary)).returncode
            == 0
        )
    assert {path.name for path in temporary.iterdir()} == {f"{PREFIX}link", f"{PREFIX}locked"}
    assert (victim / "lock").exists()
