"""Measures `msaa-lint confirm` as whole processes on the default device: `python
tests/benchmarks/confirm.py [ROUNDS]`.

Prints a table in Markdown: one pass with the validation layer, the same without it, and what each
further pass of a frame adds, by wall time. Runs of what is compared alternate. The goals (300 ms
for one pass, 10 ms for a further one) are of an idle machine with two cores.
"""

from __future__ import annotations

import os
import statistics
import sys
import tempfile

from inputs import ROOT
from run import Failed, Task, measure, verdict

CONFIRM = (
    sys.executable,
    "-c",
    "from msaa_lint.__main__ import main; main()",
    "confirm",
    "--isolated",
    "--no-time",
)
FURTHER = 20

IMAGES = """\
frame: {width: 256, height: 256, fps: 60}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
renderPasses:
"""
PASS = """\
  pass{n}:
    attachments:
      color_ms: {{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
      color: {{image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}}
    subpasses:
      - {{colorAttachments: [color_ms], resolveAttachments: [color]}}
"""


def main() -> int:
    """Measures and prints; 2 where a command failed."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 15
    with tempfile.TemporaryDirectory() as folder:
        for name, count in (("one", 1), ("many", 1 + FURTHER)):
            with open(os.path.join(folder, f"{name}.msaa.yaml"), "w", encoding="utf-8") as file:
                file.write(IMAGES + "".join(PASS.format(n=n) for n in range(count)))
        tasks = [
            Task("one pass, validation layer", [*CONFIRM, "one.msaa.yaml"]),
            Task("the same, JSON", [*CONFIRM, "--output", "json", "one.msaa.yaml"]),
            Task("one pass, no layer", [*CONFIRM, "--no-layer", "one.msaa.yaml"]),
            Task(f"{1 + FURTHER} passes, validation layer", [*CONFIRM, "many.msaa.yaml"]),
        ]
        try:
            found = measure(tasks, rounds, folder)
        except Failed as error:
            print(error, file=sys.stderr)
            return 2
        finally:
            os.chdir(ROOT)
    print("| | wall ms, least | median | CPU ms, median |\n|---|---:|---:|---:|")
    for name, samples in found.items():
        walls = [1000 * sample.wall for sample in samples]
        print(
            f"| {name} | {min(walls):.0f} | {statistics.median(walls):.0f} | "
            f"{1000 * statistics.median(s.cpu for s in samples):.0f} |"
        )
    one, *_, many = (1000 * min(sample.wall for sample in samples) for samples in found.values())
    print(f"\n{verdict(one, 300, f'one pass: {one:.0f} ms (at most 300)')}")
    print(
        verdict(
            (many - one) / FURTHER,
            10,
            f"each further pass: {(many - one) / FURTHER:.1f} ms (at most 10)",
        )
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
