"""Measures source code as input: `python tests/benchmarks/programs.py [--quick]`. Prints a table in
Markdown.

`msaa-lint check` on 2,000 lines of C++ against the same on a description that says nothing, in
turns; what the first takes longer is what grammar, reading and judging take. The reading alone is
measured in a process of its own that has it imported: the least of its rounds.
"""

from __future__ import annotations

import os
import subprocess
import sys

from inputs import ROOT
from run import CHECK, Task, environment, measure, printed, row, verdict

LINES = 2_000
GOAL = 0.3
"""Seconds that a check of so many lines may take beyond one of an empty description."""

ALONE = """
import sys, time
from tests.input.code.generated import program
text, places = program(int(sys.argv[1]))
from msaa_lint.input.code import read
from msaa_lint.core.text.source import Source
times = []
for _ in range(int(sys.argv[2])):
    source = Source("program.cpp", text)
    start = time.perf_counter()
    made = read(source, "cpp")
    times.append(time.perf_counter() - start)
print(min(times), len(made.documents))
"""


def main() -> int:
    return printed(lambda folder, quick: table(folder, 5 if quick else 21))


def table(folder: str, rounds: int) -> list[str]:
    sys.path.insert(0, ROOT)
    from tests.input.code.generated import program

    text, _ = program(LINES)
    for name, content in (
        ("program.cpp", text),
        ("empty.cpp", "int main() {}\n"),
        ("empty.msaa.yaml", "frame: {fps: 60}\n"),
    ):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(content)
    lines = text.count("\n")
    nothing = Task("an empty description", [*CHECK, "empty.msaa.yaml"])
    trivial = Task("C++ of one line", [*CHECK, "empty.cpp"])
    full = Task(
        f"{lines} lines of C++, {len(text.encode()) / 1000:.0f} KB", [*CHECK, "program.cpp"]
    )
    found = measure([nothing, trivial, full], rounds, folder)
    given = {**environment(folder), "PYTHONPATH": ROOT}
    command = [sys.executable, "-c", ALONE, str(LINES), str(rounds)]
    alone = subprocess.run(command, env=given, cwd=ROOT, capture_output=True, text=True, check=True)
    seconds, documents = alone.stdout.split()
    longer = min(s.wall for s in found[full.name]) - min(s.wall for s in found[nothing.name])
    share = longer * LINES / lines
    goal = verdict(
        share,
        GOAL,
        f"{1000 * longer:.0f} ms more, {1000 * share:.0f} ms for {LINES} lines (at most "
        f"{1000 * GOAL:.0f} ms)",
    )
    out = [f"Python {sys.version.split()[0]}, {os.cpu_count()} cores, {rounds} runs.", ""]
    out.append("| what | wall ms, least | median | CPU ms, least | median | peak MB | goal |")
    out.append("|---|---:|---:|---:|---:|---:|---|")
    out += [
        row(name, samples, goal if name == full.name else "") for name, samples in found.items()
    ]
    return [
        *out,
        "",
        f"The reading alone: {1000 * float(seconds):.0f} ms, {documents} descriptions.",
    ]


if __name__ == "__main__":
    sys.exit(main())
