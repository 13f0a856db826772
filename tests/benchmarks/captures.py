"""Measures long captures: `python tests/benchmarks/captures.py [MB ...]`; 250 and 1000 MB unless
told.

Prints a table in Markdown, for frames that repeat (those of examples/capture/forward.jsonl), frames
that never do, and a game's frames (long_captures.py), and for RenderDoc's XML (draws of
examples/capture/forward.xml, repeated). Measured are whole processes, by wall clock: parsing every
line with orjson and doing nothing else, the reader alone, and `msaa-lint check`. Rounds alternate,
and the least of each counts, which other work on the machine spoils last. Peak memory is that of
the process, as the kernel counts it (wait4).
"""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Iterable, Iterator

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))

import long_captures
from inputs import ROOT
from run import CHECK, Failed, Sample, Task, measure, verdict

SIZES = (250, 1000)
ROUNDS = 3
MAX_MEMORY = 300

GENERATORS = {"frames that never repeat": long_captures.changing, "a game": long_captures.game}
EXAMPLES = {"frames that repeat": "forward.jsonl", "RenderDoc's XML": "forward.xml"}
GOALS = {
    "frames that repeat": 0.5,
    "frames that never repeat": 0.25,
    "a game": 0.25,
    "RenderDoc's XML": 40,
}
"""The least speed of `check`: as a part of orjson's, or in MB/s for XML."""

PARSING, CHECKING = "orjson.loads of every line", "msaa-lint check"

INDEX = re.compile(rb'\{"index":(\d+),')
OBJECT_CALLS = re.compile(rb'"name":"vk(?:Create|Destroy|Allocate|Free)')

PARSE = "import orjson, sys\nfor line in open(sys.argv[1], 'rb'): orjson.loads(line)"
READ = """\
import collections, sys
from msaa_lint.input.captures.tracker import Tracker
from msaa_lint.input.readers import gfxreconstruct, renderdoc
reader = renderdoc if sys.argv[1].endswith(".xml") else gfxreconstruct
with open(sys.argv[1], "rb") as file:
    collections.deque(reader.calls(file, Tracker().wanted, sys.argv[1]), maxlen=0)
"""


def parts(lines: list[bytes]) -> tuple[list[bytes], list[bytes]]:
    """The lines that stand once, and those of frames without their indices."""
    first = next((at for at, line in enumerate(lines) if b'"vkBeginCommandBuffer"' in line), None)
    for last_call in (b'"vkQueuePresentKHR"', b'"vkQueueSubmit'):
        ends = [at for at, line in enumerate(lines) if last_call in line]
        if first is not None and ends and ends[-1] > first:
            frames = [
                line
                for line in lines[first : ends[-1] + 1]
                if INDEX.match(line) and not OBJECT_CALLS.search(line)
            ]
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
        text = b"".join(
            b'{"index":%d,%b\n' % (index + at, line) for at, line in enumerate(frames, 1)
        )
        index += len(frames)


def repeated_draws(text: bytes, size: int) -> Iterator[bytes]:
    """RenderDoc's XML of about so many bytes: the draws of its first pass again and again."""
    start = text.rindex(b"\n", 0, text.index(b'name="vkCmdBindPipeline"')) + 1
    end = text.rindex(b"\n", 0, text.index(b'name="vkCmdEndRenderPass"', start)) + 1
    yield text[:start]
    for _ in range(max(size - start, 0) // (end - start)):
        yield text[start:end]
    yield text[end:]


def limited(texts: Iterator[bytes], size: int) -> Iterator[bytes]:
    """The first texts, of about so many bytes together."""
    for text in texts:
        yield text
        size -= len(text)
        if size <= 0:
            return


def texts(name: str, size: int) -> Iterator[bytes]:
    """The text of a capture of about so many bytes."""
    if name in GENERATORS:
        return limited(GENERATORS[name](), size)
    with open(os.path.join(ROOT, "examples", "capture", EXAMPLES[name]), "rb") as file:
        example = file.read()
    if EXAMPLES[name].endswith(".xml"):
        return repeated_draws(example, size)
    return repeated([line for line in example.split(b"\n") if line.strip()], size)


def write(path: str, blocks: Iterable[bytes]) -> int:
    """Writes a file, and returns its size in bytes."""
    with open(path, "wb") as file:
        return sum(map(file.write, blocks))


def tasks(path: str) -> list[Task]:
    """What is compared on a file."""
    python = (sys.executable, "-c")
    compared = [Task(PARSING, [*python, PARSE, path], (0,))] if path.endswith(".jsonl") else []
    return [
        *compared,
        Task("the reader alone", [*python, READ, path], (0,)),
        Task(CHECKING, [*CHECK, "--output", "concise", path]),
    ]


def table(sizes: Iterable[int], folder: str) -> list[str]:
    """The table of all sizes."""
    out = [
        "| capture | what | MB | wall s | MB/s | of orjson's speed | peak MB | goal |",
        "|---|---|---:|---:|---:|---:|---:|---|",
    ]
    for size in sizes:
        for name in GOALS:
            path = os.path.join(
                folder, "long.xml" if EXAMPLES.get(name, "").endswith(".xml") else "long.jsonl"
            )
            written = write(path, texts(name, size * 1_000_000)) / 1e6
            print(f"{name}: {written:.0f} MB", file=sys.stderr)
            found = measure(tasks(path), ROUNDS, folder)
            os.unlink(path)
            least = {
                task: min(sample.wall for sample in samples) for task, samples in found.items()
            }
            for task, samples in found.items():
                share = least[PARSING] / least[task] if PARSING in least else None
                numbers = (
                    f"{written:.0f} | {least[task]:.2f} | {written / least[task]:.0f} | "
                    f"{'' if share is None else f'{share:.2f}'}"
                )
                goals = (
                    goal(name, share or written / least[task], samples) if task == CHECKING else ""
                )
                out.append(f"| {name} | {task} | {numbers} | {peak(samples):.0f} | {goals} |")
    return out


def peak(samples: list[Sample]) -> float:
    return max(sample.memory for sample in samples) / 1e6


def goal(name: str, speed: float, samples: list[Sample]) -> str:
    """The speed and the memory against their goals."""
    least, memory = GOALS[name], peak(samples)
    return (
        f"{verdict(least / speed, 1.0, f'at least {least:g}')}; "
        f"{verdict(memory, MAX_MEMORY, f'{MAX_MEMORY} MB')}"
    )


def main() -> int:
    """Measures and prints; 2 where a command failed."""
    if not all(size.isdecimal() for size in sys.argv[1:]) or not hasattr(os, "wait4"):
        print("usage: captures.py [MB ...], on a system with wait4", file=sys.stderr)
        return 2
    sizes = sorted(int(size) for size in sys.argv[1:]) or SIZES
    with tempfile.TemporaryDirectory() as folder:
        try:
            lines = table(sizes, folder)
        except Failed as error:
            print(error, file=sys.stderr)
            return 2
        finally:
            os.chdir(ROOT)
    print(f"Python {sys.version.split()[0]}, {os.cpu_count()} cores, {ROUNDS} rounds.\n")
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
