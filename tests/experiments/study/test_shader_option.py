"""`study --shader` on lavapipe, as a user calls it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run
from tests.glsl import HEAD, spirv
from tests.paths import ROOT

COLOR = "layout(location = 0) out vec4 color;\n"
SMALL = (
    "study",
    "edge-fan",
    "--size",
    "64x64",
    "--techniques",
    "msaa",
    "--samples",
    "1,4",
    "--device",
    "llvmpipe",
    "--repeats",
    "3",
)


def test_a_shader_is_timed_beside_no_shading(tmp_path: Path) -> None:
    source = ROOT / "examples" / "lit" / "lit.frag"
    for shader in (str(source), f"{source}.spv"):
        done = run(tmp_path, *SMALL, "--shader", shader, "--output", "json")
        assert (done.returncode, done.stderr) == (0, "")
        points = json.loads(done.stdout)["points"]
        own = [point for point in points if point["shading"] == Path(shader).name]
        assert [point["samples"] for point in own] == [1, 4]
        assert all(point["time_ms"] > 0 for point in own)
        # What a software driver counts is not reported.
        assert all(point["invocations"] is None for point in own)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("void main() { color = missing; }", "line 3: 'missing' : undeclared identifier"),
        ("layout(input_attachment_index = 0, binding = 2) uniform subpassInput i;\nvoid main() { "
            "color = subpassLoad(i); }",
         "reads input attachment 0 at set 0, binding 2, and the passes of a study have none"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_one_line(tmp_path: Path, text: str, reason: str) -> None:
    (tmp_path / "own.frag").write_text(HEAD + COLOR + text)
    done = run(tmp_path, *SMALL, "--shader", "own.frag")
    (line,) = done.stderr.splitlines()
    assert (
        done.returncode == 2
        and line.startswith("msaa-lint: --shader: the shader `own.frag` ")
        and line.endswith(reason)
    )


def test_what_the_device_lacks_is_named(tmp_path: Path) -> None:
    text = (
        "#extension GL_EXT_nonuniform_qualifier : enable\nlayout(binding = 0) uniform sampler2D "
        "t[];\nlayout(location = 0) flat in int n;\n"
    )
    (tmp_path / "own.spv").write_bytes(
        spirv(text + COLOR + "void main() { color = texture(t[n], vec2(0)); }")
    )
    done = run(tmp_path, *SMALL, "--shader", "own.spv")
    # Newer versions of lavapipe have it.
    reason = "needs the feature runtimeDescriptorArray, which the device does not have"
    assert done.returncode == 0 or (
        done.returncode == 2 and reason in done.stderr and len(done.stderr.splitlines()) == 1
    )
