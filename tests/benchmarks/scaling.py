"""Doubles inputs and prints how time grows: `python tests/benchmarks/scaling.py [--quick]
[NAME...]`. A table in Markdown.

Each shape is an input of one structure at any size, and a command that reads it. Its size starts
where the command's work can be told from its start, and is doubled four times (twice with
`--quick`, which takes one in twelve). The exponent is that of a power law through the last three
sizes: 1 is linear, 2 quadratic. Times are CPU times of a process forked from one that has imported
everything, so they hold no start; the time of the smallest input is taken off. A shape above the
limit is measured again, and its least exponent counts: other work on the machine only adds to one.

`NAME` selects the shapes whose names contain it. Exits with 1 where an exponent is above the limit
(not with `--quick`, whose times are too short to tell), and with 2 where a command failed: a signal
ended it, or its code says something else than "linted".
"""

from __future__ import annotations

import gc
import math
import os
import resource
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from shapes import SHAPES, Shape  # noqa: E402

LIMIT = 1.3
MOST_SECONDS = 60
"""Of processor time, of one run; a run that takes longer is ended, and its shape counts as above
the limit.
"""
START_SECONDS = 0.1
"""What the first size takes beyond the smallest input."""
MOST_BYTES = 4 << 20
"""Of the first size: a command that is this fast needs no larger input."""


QUICK = 12
"""Of so many shapes, `--quick` doubles one, unless names select them."""


class Failed(Exception):
    """A command that did not do its work."""


class Run(NamedTuple):
    """CPU time in seconds, peak memory of the process in bytes."""

    seconds: float
    memory: int


class Row(NamedTuple):
    """One line of the table; sizes in bytes, times in seconds."""

    name: str
    sizes: list[int]
    runs: list[Run]
    exponent: float


def warm() -> None:
    """Imports what the commands import, so that no run pays for it: each command reads a small
    input of each kind in this process.
    """
    known = set()
    with tempfile.TemporaryDirectory() as folder:
        for number, shape in enumerate(SHAPES):
            path = Path(folder) / str(number)
            path.mkdir()
            shape.write(path, 1)
            kind = (*shape.arguments, *sorted({each.suffix for each in path.rglob("*")}))
            if kind not in known:
                known.add(kind)
                call(shape, path)
                gc.collect()


def call(shape: Shape, folder: Path) -> int:
    """Runs the command in this process, its output thrown away; its exit code."""
    from msaa_lint.__main__ import main

    here, streams, argv = os.getcwd(), (sys.stdin, sys.stdout, sys.stderr), sys.argv
    with (
        open(os.devnull, encoding="utf-8") as empty,
        open(os.devnull, "w", encoding="utf-8") as null,
    ):
        os.chdir(folder)
        sys.argv = ["msaa-lint", *shape.arguments]
        sys.stdin, sys.stdout, sys.stderr = empty, null, null
        try:
            main()
        except SystemExit as ended:
            return ended.code if isinstance(ended.code, int) else int(ended.code is not None)
        finally:
            sys.stdin, sys.stdout, sys.stderr = streams
            sys.argv = argv
            os.chdir(here)
            gc.unfreeze()
            gc.enable()
    return 0


def run(shape: Shape, size: int, folder: Path) -> tuple[int, Run]:
    """Writes the shape at that size and runs its command in a forked process; the input's bytes,
    and what the run took. Raises: Failed.
    """
    path = folder / "input"
    path.mkdir()
    try:
        shape.write(path, size)
        size_bytes = sum(each.stat().st_size for each in path.rglob("*") if each.is_file())
        child = os.fork()
        if child == 0:
            code = 70
            try:
                resource.setrlimit(resource.RLIMIT_CPU, (MOST_SECONDS, MOST_SECONDS + 1))
                code = call(shape, path)
            finally:
                os._exit(code)
        _, status, usage = os.wait4(child, 0)
        seconds = usage.ru_utime + usage.ru_stime
        code = os.waitstatus_to_exitcode(status)
        if code not in shape.codes and seconds < MOST_SECONDS:
            raise Failed(
                f"{shape.name}, size {size}: ended with {code}: msaa-lint "
                f"{' '.join(shape.arguments)}"
            )
        return size_bytes, Run(seconds, usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024))
    finally:
        shutil.rmtree(path)


def exponent(sizes: Sequence[int], runs: Sequence[Run], least: float) -> float:
    """The slope of log time over log size, of the last three sizes."""
    points = [
        (math.log(size), math.log(max(each.seconds - least, 0.001)))
        for size, each in zip(sizes[-3:], runs[-3:], strict=True)
    ]
    mean_x, mean_y = (sum(values) / len(points) for values in zip(*points, strict=True))
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / sum(
        (x - mean_x) ** 2 for x, _ in points
    )


def measure(shape: Shape, folder: Path, quick: bool) -> Row:
    """A row of the table. Raises: Failed."""
    _, smallest = run(shape, 1, folder)
    least, enough = smallest.seconds, START_SECONDS / (4 if quick else 1)
    size = 8
    while size < shape.most >> (2 if quick else 4):
        size_bytes, first = run(shape, size, folder)
        if first.seconds - least >= enough or size_bytes >= MOST_BYTES:
            break
        size *= 2
    counts, sizes, runs = [], [], []
    for doubling in range(3 if quick else 5):
        size_bytes, taken = run(shape, size << doubling, folder)
        counts.append(size << doubling)
        sizes.append(size_bytes)
        runs.append(taken)
        if taken.seconds >= MOST_SECONDS:
            return Row(shape.name, sizes, runs, math.inf)
    return Row(shape.name, sizes, runs, exponent(counts, runs, least))


def line(row: Row) -> str:
    times = " ".join(f"{each.seconds:.2f}" for each in row.runs)
    memory = max(each.memory for each in row.runs) / 1e6
    shown = f"over {MOST_SECONDS} s" if row.exponent == math.inf else f"{row.exponent:.2f}"
    return (
        f"| {row.name} | {row.sizes[0] / 1e3:.0f} to {row.sizes[-1] / 1e3:.0f} | {times} | "
        f"{memory:.0f} | {shown} |"
    )


def main() -> int:
    names = [each for each in sys.argv[1:] if each != "--quick"]
    quick = "--quick" in sys.argv[1:]
    chosen = [shape for shape in SHAPES if not names or any(name in shape.name for name in names)]
    if quick and not names:
        chosen = chosen[::QUICK]
    for name in [name for name in os.environ if name.startswith(("COVERAGE", "MSAA_LINT_"))]:
        del os.environ[name]
    os.environ["NO_COLOR"] = "1"
    warm()
    print(
        "| shape | kB | CPU seconds | peak memory, MB | exponent |\n|---|---:|---:|---:|---:|",
        flush=True,
    )
    above, failures = [], []
    with tempfile.TemporaryDirectory() as folder:
        for shape in chosen:
            try:
                row = measure(shape, Path(folder), quick)
                for _ in range(0 if quick else 2):
                    if row.exponent <= LIMIT:
                        break
                    row = min(
                        row, measure(shape, Path(folder), quick), key=lambda each: each.exponent
                    )
            except Failed as error:
                failures.append(str(error))
                continue
            print(line(row), flush=True)
            if row.exponent > LIMIT:
                above.append(row.name)
    print(
        f"\n{len(chosen)} shapes, {len(above)} above "
        f"{LIMIT}{': ' + ', '.join(above) if above else ''}"
    )
    for failure in failures:
        print(failure, file=sys.stderr)
    return 2 if failures else int(bool(above) and not quick)


if __name__ == "__main__":
    sys.exit(main())
