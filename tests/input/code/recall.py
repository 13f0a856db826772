"""Prints the expected, missed, and false findings in the corpus: `python tests/input/code/recall.py
[NAME...]`.

With `--compile`, it only checks that gcc and g++ accept the programs, which takes a minute and
needs the Vulkan headers.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[3]))

from tests.input.code.expected import PROGRAMS, outcome

COMPILERS = {".c": ("gcc", "-std=c11"), ".cpp": ("g++", "-std=c++20")}


def main() -> int:
    """Prints a line for each program, missed finding, and false finding, and the totals. Returns 1
    if any is missed or false.
    """
    names = [name for name in sys.argv[1:] if name != "--compile"]
    named = [path for path in PROGRAMS if not names or any(name in path.name for name in names)]
    if "--compile" in sys.argv[1:]:
        files = [
            file
            for path in named
            for file in (sorted(path.rglob("*.c*")) if path.is_dir() else [path])
        ]
        return max(
            subprocess.run(
                [*COMPILERS[file.suffix], "-fsyntax-only", "-w", str(file)], check=False
            ).returncode
            for file in files
        )
    held = {path: outcome(path) for path in named}
    for path, each in held.items():
        later = f", later {len(each.later_found)} of {len(each.later)}" if each.later else ""
        print(
            f"{path.name:32} found {len(each.expected) - len(each.missed)} of "
            f"{len(each.expected)}{later}, false {len(each.false)}"
        )
        for missing in each.missed:
            print(f"    missed {missing}")
        for found in each.false:
            print(
                f"    false  {found.code}:{found.file}{found.file and ':'}{found.line} "
                f"{found.message}"
            )
    expected = sum(len(each.expected) for each in held.values())
    missed = sum(len(each.missed) for each in held.values())
    waiting = sum(len(each.later) - len(each.later_found) for each in held.values())
    false = sum(len(each.false) for each in held.values())
    print(
        f"{len(held)} programs: {expected - missed} of {expected + waiting} found, {waiting} not "
        f"expected yet; {false} false"
    )
    return int(missed + false > 0)


if __name__ == "__main__":
    sys.exit(main())
