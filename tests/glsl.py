"""GLSL compiled for tests."""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

HEAD = "#version 460\n"


def spirv(text: str, *, environment: str = "vulkan1.1", stage: str = "frag") -> bytes:
    """The SPIR-V of GLSL without its version. CalledProcessError, with the compiler's output, where
    it does not compile.
    """
    with tempfile.TemporaryDirectory() as folder:
        source, target = Path(folder, f"in.{stage}"), Path(folder, "out.spv")
        source.write_text(HEAD + text, encoding="utf-8")
        subprocess.run(
            ["glslangValidator", "--target-env", environment, "-V", "-o", target, source],
            check=True,
            stdout=subprocess.PIPE,
        )
        return target.read_bytes()
