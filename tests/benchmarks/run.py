"""Measures whole processes: `python tests/benchmarks/run.py [--quick]`. Prints a table in Markdown.

Wall time and CPU time are those of the process, peak memory its resident set, as the kernel counts
them (wait4). Runs of what is compared alternate, so that a machine that slows down slows all of
them; the least and the median of the runs are shown. Bytecode is compiled before. Goals in seconds
are held against the least, which other work on the machine spoils last; comparisons against the
medians.
"""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from typing import NamedTuple

from inputs import DESCRIPTION, PIPELINES, ROOT, descriptions, pipelines

CHECK = (
    sys.executable,
    "-c",
    "from msaa_lint.__main__ import main; main()",
    "check",
    "--isolated",
    "--no-cache",
)
"""What the installed `msaa-lint check` runs."""

MANY = 1000


class Task(NamedTuple):
    """A command, and the exit codes that say it did its work."""

    name: str
    command: Sequence[str]
    codes: Sequence[int] = (0, 1)


class Sample(NamedTuple):
    """One run: seconds, seconds, bytes."""

    wall: float
    cpu: float
    memory: int


class Failed(Exception):
    """A command that did not do its work, and so was not measured."""


def environment(folder: str) -> dict[str, str]:
    """With bytecode, whatever the shell says, in a folder of its own, and without what slows a
    Python down or configures a linter.
    """
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTHON", "COVERAGE", "MSAA_LINT_"))
    }
    return {
        **kept,
        "PYTHONPATH": ROOT,
        "PYTHONPYCACHEPREFIX": os.path.join(folder, "bytecode"),
        "NO_COLOR": "1",
    }


def once(task: Task, folder: str, given: dict[str, str]) -> Sample:
    """Runs a command to its end, its output thrown away."""
    null = [
        (os.POSIX_SPAWN_OPEN, fd, os.devnull, flags, 0)
        for fd, flags in ((0, os.O_RDONLY), (1, os.O_WRONLY), (2, os.O_WRONLY))
    ]
    os.chdir(folder)
    start = time.perf_counter()
    child = os.posix_spawn(task.command[0], list(task.command), given, file_actions=null)
    _, status, usage = os.wait4(child, 0)
    wall = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) not in task.codes:
        raise Failed(
            f"{task.name} ended with {os.waitstatus_to_exitcode(status)}: {' '.join(task.command)}"
        )
    return Sample(
        wall,
        usage.ru_utime + usage.ru_stime,
        usage.ru_maxrss * (1 if sys.platform == "darwin" else 1024),
    )


def measure(tasks: Sequence[Task], rounds: int, folder: str) -> dict[str, list[Sample]]:
    """The samples of each task, in turns. The first turn compiles the bytecode and is not
    counted.
    """
    given = environment(folder)
    found: dict[str, list[Sample]] = {task.name: [] for task in tasks}
    for turn in range(rounds + 1):
        for task in tasks:
            sample = once(task, folder, given)
            if turn:
                found[task.name].append(sample)
    return found


def others(folder: str) -> list[Task]:
    """The linters that are compared with, where they are installed beside this Python or on the
    path.
    """
    beside = os.path.dirname(sys.executable)
    tasks = []
    for name, arguments in (
        ("yamllint", ["-d", "relaxed"]),
        ("check-jsonschema", ["--schemafile", os.path.join(folder, "schema.json")]),
    ):
        found = shutil.which(
            name, path=os.pathsep.join([beside, os.environ.get("PATH", os.defpath)])
        )
        if found is None:
            print(f"{name} is not installed: left out", file=sys.stderr)
        else:
            tasks.append(Task(f"{name}, the same file", [found, *arguments, "one.msaa.yaml"]))
    return tasks


def row(name: str, samples: Sequence[Sample], goal: str = "") -> str:
    """A line of the table."""
    wall, cpu = [s.wall for s in samples], [s.cpu for s in samples]
    memory = max(s.memory for s in samples) / 1e6
    times = " | ".join(
        f"{1000 * seconds:.0f}"
        for seconds in (min(wall), statistics.median(wall), min(cpu), statistics.median(cpu))
    )
    return f"| {name} | {times} | {memory:.0f} | {goal} |"


def verdict(value: float, limit: float, text: str) -> str:
    return f"{text}: {'met' if value <= limit else 'MISSED'}"


def compared(one: Sequence[Sample], found: dict[str, list[Sample]]) -> list[str]:
    """How one description stands against each other linter on the same file, by the medians of wall
    time.
    """
    own = statistics.median(s.wall for s in one)
    lines = []
    for name, samples in found.items():
        limit = (
            2.0
            if name.startswith("yamllint")
            else 1.0
            if name.startswith("check-jsonschema")
            else None
        )
        if limit is not None:
            times = own / statistics.median(s.wall for s in samples)
            lines.append(
                verdict(
                    times, limit, f"{times:.2f} times {name.split(',')[0]} (at most {limit:.1f})"
                )
            )
    return lines


def main() -> int:
    return printed(lambda folder, quick: table(folder, 5 if quick else 21, 2 if quick else 7))


def printed(table: Callable[[str, bool], list[str]]) -> int:
    """Measures and prints, in less time with `--quick`; 2 where a command failed."""
    if not hasattr(os, "wait4"):
        print("this system does not say what a process took", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder:
        try:
            lines = table(folder, "--quick" in sys.argv[1:])
        except (Failed, subprocess.CalledProcessError) as error:
            print(error, file=sys.stderr)
            return 2
        finally:
            os.chdir(ROOT)
    print("\n".join(lines))
    return 0


def table(folder: str, rounds: int, long_rounds: int) -> list[str]:
    with open(os.path.join(folder, "one.msaa.yaml"), "w", encoding="utf-8") as file:
        file.write(DESCRIPTION)
    with open(os.path.join(folder, "schema.json"), "w", encoding="utf-8") as file:
        subprocess.run(
            [sys.executable, "-m", "msaa_lint", "schema"], cwd=ROOT, stdout=file, check=True
        )
    sc, origin = pipelines(folder)
    one = Task(
        f"msaa-lint check, a description of {len(DESCRIPTION)} bytes",
        [*CHECK, "one.msaa.yaml"],
        (1,),
    )
    start = measure(
        [Task("python -c pass", [sys.executable, "-c", "pass"], (0,)), one, *others(folder)],
        rounds,
        folder,
    )
    many = Task(f"msaa-lint check, {MANY} descriptions", [*CHECK, descriptions(folder, MANY)], (1,))
    pipeline_files = Task(f"msaa-lint check, {PIPELINES} Vulkan SC files ({origin})", [*CHECK, sc])
    long = measure([pipeline_files, many], long_rounds, folder)
    out = [
        f"Python {sys.version.split()[0]}, {os.cpu_count()} cores, {rounds} and {long_rounds} "
        "runs.",
        "",
    ]
    out.append("| what | wall ms, least | median | CPU ms, least | median | peak MB | goal |")
    out.append("|---|---:|---:|---:|---:|---:|---|")
    for name, samples in start.items():
        out.append(
            row(
                name,
                samples,
                "; ".join(compared(start[one.name], start)) if name == one.name else "",
            )
        )
    for task, limit in ((pipeline_files, 1.0), (many, 3.0)):
        took = min(s.wall for s in long[task.name])
        out.append(row(task.name, long[task.name], verdict(took, limit, f"{limit:.1f} s")))
    peak = (
        max(
            s.memory
            for name, samples in (start | long).items()
            if name.startswith("msaa-lint")
            for s in samples
        )
        / 1e6
    )
    return [*out, "", verdict(peak, 150, f"Peak memory {peak:.0f} MB (at most 150 MB)")]


if __name__ == "__main__":
    sys.exit(main())
