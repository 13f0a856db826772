"""GLSL to SPIR-V, by glslangValidator or glslc. The compiler parses the file natively, so it runs
only for a file that the user names, and in an empty folder.
"""

from __future__ import annotations

import os
import re

from msaa_lint.core.scratch import ScratchFolder

from .capture_stream import StreamFailure
from .child_program import Program, installed

PATIENCE = 60.0
"""Seconds without output after which a compiler is stopped."""

COMPILERS = {
    "glslangValidator": ("-V", "--target-env", "vulkan1.1", "--aml", "--amb", "-S", "frag"),
    "glslc": (
        "--target-env=vulkan1.1",
        "-fauto-map-locations",
        "-fauto-bind-uniforms",
        "-fshader-stage=fragment",
    ),
}
"""The compilers in the order of preference, with their options: inputs, outputs, and descriptors
without places get some.
"""

_ERROR = re.compile(
    r"^(?:ERROR: )?(?P<file>.*?):(?P<line>\d+): (?:error: )?(?P<text>.*)$", re.MULTILINE
)


class CompilationError(Exception):
    """The message of the compiler, or that none is installed."""


def compiled(path: str) -> bytes:
    """The SPIR-V of a fragment shader. Raises CompilationError, with the line of the first error,
    and OSError if the compiler cannot be started.
    """
    compiler = next((name for name in COMPILERS if installed(name) is not None), None)
    if compiler is None:
        raise CompilationError(
            "it is GLSL, and no compiler is installed: install glslangValidator or glslc (on "
            "Debian run `apt install glslang-tools`), or "
            "give SPIR-V"
        )
    folder = ScratchFolder()
    try:
        target = os.path.join(folder.path, "shader.spv")
        with Program(
            [compiler, *COMPILERS[compiler], "-o", target, os.path.abspath(path)],
            folder.path,
            PATIENCE,
        ) as program:
            try:
                program.finish()
                with open(target, "rb") as file:
                    return file.read()
            except (StreamFailure, FileNotFoundError) as error:
                raise CompilationError(_first_error(program.text()) or str(error)) from None
    finally:
        folder.remove()


def _first_error(output: str) -> str:
    """The first error in the output of a compiler, with its line; empty without one."""
    found = _ERROR.search(output)
    return (
        f"line {found['line']}: {' '.join(found['text'].split())[:200]}"
        if found is not None
        else ""
    )
