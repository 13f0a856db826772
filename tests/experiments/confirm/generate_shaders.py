"""Makes the SPIR-V of the shaders: `python -m tests.experiments.confirm.generate_shaders`, with
`glslangValidator` on the path.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from msaa_lint.experiments.confirm.shaders import spirv

FOLDER = spirv.FOLDER
STAGES = (".vert", ".frag", ".comp")


def sources() -> list[str]:
    """The names of the shaders: `scene.vert`, ..."""
    return sorted(name for name in os.listdir(FOLDER) if name.endswith(STAGES))


def compiled(name: str) -> bytes:
    """The SPIR-V of a shader. CalledProcessError where it does not compile, FileNotFoundError
    without a compiler.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "out.spv")
        source = os.path.join(FOLDER, name)
        subprocess.run(
            ["glslangValidator", "--target-env", "vulkan1.0", "-o", path, source],
            check=True,
            stdout=subprocess.PIPE,
        )
        with open(path, "rb") as file:
            return file.read()


def main() -> int:
    """Writes the SPIR-V beside each shader."""
    for name in sources():
        with open(os.path.join(FOLDER, f"{name}.spv"), "wb") as file:
            file.write(compiled(name))
    return 0


if __name__ == "__main__":
    sys.exit(main())
