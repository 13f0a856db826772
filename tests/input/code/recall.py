"""Prints what is found in the programs of the corpus, what is missed and what is false: `python tests/input/code/recall.py [NAME...]`.

With `--compile` it asks gcc and g++ whether they are programs (Vulkan's headers have to be installed; a minute), and finds nothing.
"""

from __future__ import annotations

import subprocess
import sys

from tests.paths import ROOT

COMPILERS = {".c": ("gcc", "-std=c11"), ".cpp": ("g++", "-std=c++20")}


def main() -> int:
    """A line for each program, one for each miss and each false finding, and the sums; 1 where anything is missed or false."""
    sys.path.insert(0, str(ROOT))
    from tests.input.code.expected import PROGRAMS, outcome

    names = [name for name in sys.argv[1:] if name != "--compile"]
    named = [path for path in PROGRAMS if not names or any(name in path.name for name in names)]
    if "--compile" in sys.argv[1:]:
        return max(subprocess.run([*COMPILERS[path.suffix], "-fsyntax-only", "-w", str(path)], check=False).returncode for path in named)
    held = {path: outcome(path) for path in named}
    for path, each in held.items():
        later = f", later {len(each.later_found)} of {len(each.later)}" if each.later else ""
        print(f"{path.name:32} found {len(each.expected) - len(each.missed)} of {len(each.expected)}{later}, false {len(each.false)}")
        for missing in each.missed:
            print(f"    missed {missing}")
        for found in each.false:
            print(f"    false  {found.code}:{found.line} {found.message}")
    expected = sum(len(each.expected) for each in held.values())
    missed = sum(len(each.missed) for each in held.values())
    waiting = sum(len(each.later) - len(each.later_found) for each in held.values())
    false = sum(len(each.false) for each in held.values())
    print(f"{len(held)} programs: {expected - missed} of {expected + waiting} found, {waiting} not expected yet; {false} false")
    return int(missed + false > 0)


if __name__ == "__main__":
    sys.exit(main())
