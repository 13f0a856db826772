"""Makes the SPIR-V of the tests', the rule pages', and an example's shaders: `python -m
tests.frame.spirv.generate`.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

SHADERS = Path(__file__).parent / "shaders"
RULES = Path(__file__).parents[3] / "rules" / "shaders"
EXAMPLE = Path(__file__).parents[3] / "examples" / "lit"
ENVIRONMENTS = {SHADERS: "vulkan1.1", RULES: "vulkan1.0", EXAMPLE: "vulkan1.0"}


def sources(folder: Path) -> list[Path]:
    """The shaders of a folder, as GLSL."""
    return sorted(path for path in folder.iterdir() if path.suffix in (".frag", ".comp"))


def compiled(source: Path) -> bytes:
    """The SPIR-V of a shader, without names. CalledProcessError where it does not compile."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "out.spv")
        environment = ENVIRONMENTS.get(source.parent, "vulkan1.1")
        subprocess.run(
            ["glslangValidator", "--target-env", environment, "-g0", "-o", path, source],
            check=True,
            stdout=subprocess.PIPE,
        )
        return path.read_bytes()


def optimised(code: bytes, *passes: str) -> bytes:
    """What spirv-opt makes of SPIR-V."""
    with tempfile.TemporaryDirectory() as folder:
        before, after = Path(folder, "in.spv"), Path(folder, "out.spv")
        before.write_bytes(code)
        subprocess.run(["spirv-opt", *passes, before, "-o", after], check=True)
        return after.read_bytes()


def main() -> int:
    """Writes the SPIR-V beside each shader."""
    for folder in ENVIRONMENTS:
        for source in sources(folder):
            source.with_name(f"{source.name}.spv").write_bytes(compiled(source))
    return 0


if __name__ == "__main__":
    sys.exit(main())
