"""Generates docs/finding.svg, which shows what the README's first command prints in a terminal:
`python docs/finding.py [--check]`.
"""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys

from rich.console import Console
from rich.text import Text

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXAMPLE = "examples/khronos-msaa/color-separate.msaa.yaml"
ARGUMENTS = ["check", "--isolated", "--color", "always", "--output", "full", EXAMPLE]
TARGET = os.path.join(ROOT, "docs", "finding.svg")
WIDTH = 140


def picture() -> str:
    """The SVG of a terminal with the run."""
    environment = {**os.environ, "COLUMNS": str(WIDTH)}
    done = subprocess.run(
        [sys.executable, "-m", "msaa_lint", *ARGUMENTS],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        check=False,
    )
    console = Console(
        record=True,
        width=WIDTH,
        file=io.StringIO(),
        force_terminal=True,
        color_system="standard",
        legacy_windows=False,
    )
    console.print(Text.from_ansi(done.stdout.decode()))
    svg = console.export_svg(title=f"msaa-lint check {EXAMPLE}", unique_id="finding")
    # Fonts of another site, which a picture does not load on GitHub anyway.
    return re.sub(r"\s*@font-face \{.*?\}", "", svg, flags=re.DOTALL)


def main() -> int:
    """Writes the picture, or with `--check` compares it."""
    svg = picture()
    if "--check" in sys.argv[1:]:
        with open(TARGET, encoding="utf-8") as file:
            return int(file.read() != svg)
    with open(TARGET, "w", encoding="utf-8") as file:
        file.write(svg)
    return 0


if __name__ == "__main__":
    sys.exit(main())
