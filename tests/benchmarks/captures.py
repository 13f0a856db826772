"""Measures long captures: `python tests/benchmarks/captures.py CAPTURE.jsonl [MB ...]`; 250 and 1000 MB unless told.

Prints a table in Markdown. The capture's lines before its first command buffer stand once; those from there to its last present (or
submission) are repeated, with rising indices, until the file has its size. Measured are whole processes, by wall clock: parsing every line
with orjson and doing nothing else, the reader alone, and `msaa-lint check`. Rounds alternate, and the least of each counts, which other
work on the machine spoils last. Peak memory is that of the process, as the kernel counts it (wait4).
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator

from inputs import ROOT
from run import CHECK, Failed, Sample, Task, measure, verdict

SIZES = (250, 1000)
ROUNDS = 3
MAX_MEMORY = 300

INDEX = re.compile(rb'\{"index":(\d+),')
OBJECT_CALLS = re.compile(rb'"name":"vk(?:Create|Destroy|Allocate|Free)')

PARSE = "import orjson, sys\nfor line in open(sys.argv[1], 'rb'): orjson.loads(line)"
READ = """\
import collections, sys
from msaa_lint.input.captures.tracker import Tracker
from msaa_lint.input.readers import gfxreconstruct
with open(sys.argv[1], "rb") as file:
    collections.deque(gfxreconstruct.calls(file, Tracker().wanted, sys.argv[1]), maxlen=0)
"""


def parts(lines: list[bytes]) -> tuple[list[bytes], list[bytes]]:
    """The lines that stand once, and those of frames without their indices."""
    first = next((at for at, line in enumerate(lines) if b'"vkBeginCommandBuffer"' in line), None)
    for last_call in (b'"vkQueuePresentKHR"', b'"vkQueueSubmit'):
        ends = [at for at, line in enumerate(lines) if last_call in line]
        if first is not None and ends and ends[-1] > first:
            frames = [line for line in lines[first : ends[-1] + 1] if INDEX.match(line) and not OBJECT_CALLS.search(line)]
            return lines[:first], [INDEX.sub(b"", line, count=1) for line in frames]
    raise Failed("the capture has no frame: no command buffer is begun and submitted")


def repeated(lines: list[bytes], size: int) -> Iterator[bytes]:
    """The text of a capture of about so many bytes."""
    once, frames = parts(lines)
    text = b"".join(line + b"\n" for line in once)
    index = max((int(found[1]) for line in once if (found := INDEX.match(line))), default=0)
    while size > 0:
        yield text
        size -= len(text)
        text = b"".join(b'{"index":%d,%b\n' % (index + at, line) for at, line in enumerate(frames, 1))
        index += len(frames)


def write(path: str, texts: Iterable[bytes]) -> tuple[int, int]:
    """Writes a file: its bytes and its lines."""
    size = lines = 0
    with open(path, "wb") as file:
        for text in texts:
            file.write(text)
            size += len(text)
            lines += text.count(b"\n")
    return size, lines


def tasks(path: str) -> list[Task]:
    """What is compared on a file."""
    python = (sys.executable, "-c")
    return [
        Task("orjson.loads of every line", [*python, PARSE, path], (0,)),
        Task("the reader alone", [*python, READ, path], (0,)),
        Task("msaa-lint check", [*CHECK, "--output", "concise", path]),
    ]


def table(capture: str, sizes: Iterable[int], folder: str) -> list[str]:
    """The table of all sizes."""
    with open(capture, "rb") as file:
        lines = [line for line in file.read().split(b"\n") if line.strip()]
    out = ["| what | MB | wall s | MB/s | of orjson's speed | peak MB | goal |", "|---|---:|---:|---:|---:|---:|---|"]
    speeds: list[float] = []
    path = os.path.join(folder, "long.jsonl")
    for size in sizes:
        written, count = write(path, repeated(lines, size * 1_000_000))
        print(f"{written / 1e6:.0f} MB in {count} lines", file=sys.stderr)
        found = measure(tasks(path), ROUNDS, folder)
        least = {name: min(sample.wall for sample in samples) for name, samples in found.items()}
        parsing, _, checking = least
        for name, samples in found.items():
            share = least[parsing] / least[name]
            goals = goal(share, samples) if name == checking else ""
            numbers = f"{written / 1e6:.0f} | {least[name]:.2f} | {written / 1e6 / least[name]:.0f} | {share:.2f} | {peak(samples):.0f}"
            out.append(f"| {name} | {numbers} | {goals} |")
        speeds.append(written / least[checking])
    if len(speeds) > 1:
        out += ["", verdict(speeds[0] / speeds[-1], 1.25, f"Slower by {speeds[0] / speeds[-1]:.2f} at the largest size (at most 1.25)")]
    return out


def peak(samples: list[Sample]) -> float:
    return max(sample.memory for sample in samples) / 1e6


def goal(share: float, samples: list[Sample]) -> str:
    """Half of orjson's speed, within 300 MB."""
    memory = peak(samples)
    return f"{verdict(1 / share, 2.0, f'{1 / share:.2f} times orjson (at most 2.0)')}; {verdict(memory, MAX_MEMORY, f'{MAX_MEMORY} MB')}"


def main() -> int:
    """Measures and prints; 2 where a command failed."""
    if len(sys.argv) < 2 or not hasattr(os, "wait4"):
        print("usage: captures.py CAPTURE.jsonl [MB ...], on a system with wait4", file=sys.stderr)
        return 2
    capture = os.path.abspath(sys.argv[1])
    sizes = sorted(int(size) for size in sys.argv[2:]) or SIZES
    with tempfile.TemporaryDirectory() as folder:
        try:
            lines = table(capture, sizes, folder)
        except Failed as error:
            print(error, file=sys.stderr)
            return 2
        finally:
            os.chdir(ROOT)
    print(f"Python {sys.version.split()[0]}, {os.cpu_count()} cores, {ROUNDS} rounds, frames of {os.path.basename(capture)}.\n")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
