"""Time and memory of writing findings as rows, and of summarizing them.

    python tests/benchmarks/rows.py [FINDINGS]

The findings are those of descriptions that differ in their names and prices. The peak is that of
Python's objects while they are written, beyond the findings themselves.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
import tracemalloc
from pathlib import Path

from msaa_lint.cli.report import Options, check_parquet, check_sqlite
from msaa_lint.cli.report.rows import rows
from msaa_lint.core.finding import Finding, Fix, InputSummary, PassTraffic, Price, Result
from msaa_lint.linter.corpus.database import Database
from msaa_lint.linter.corpus.files import corpus_files
from msaa_lint.linter.corpus.summary import summarize

PER_INPUT = 10
RULES = [f"rule-{number}" for number in range(80)]


def corpus(count: int) -> tuple[Result, list[PassTraffic]]:
    """A result with so many findings, and the passes that they are in."""
    findings, passes, inputs = [], [], []
    for number in range(count):
        file = f"captures/level-{number // PER_INPUT:06}/frame.msaa.yaml"
        rule, path = number * 7919 % len(RULES), f"renderPasses.pass{number % PER_INPUT}"
        price = Price(number % 997 / 3, number % 991 / 7, number % 89 / 11, number % 997 / 30)
        message = f"`color{number}` stores 4x samples that nothing reads; set storeOp to DONT_CARE"
        findings.append(
            Finding(f"MSAA{rule:03}", RULES[rule], "warning", "high", message, file, None,
            f"{path}.attachments.color", fix=Fix("x", True))
            ._replace(price=price)
        )  # fmt: skip
        passes.append(
            PassTraffic(
                file,
                0,
                f"pass{number % PER_INPUT}",
                path,
                "renderPass",
                1920,
                1080,
                1,
                4,
                *price,
                "",
            )
        )
        if number % PER_INPUT == 0:
            inputs.append(
                InputSummary(file, "description", 2, PER_INPUT, device=f"GPU {number % 17}")
            )
    return Result(findings, [], [], [each.file for each in inputs], {}, [], inputs=inputs), passes


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    result, passes = corpus(count)
    options = Options(version="0", edition="0")
    with tempfile.TemporaryDirectory() as folder:
        for name, write in (("parquet", check_parquet.write), ("sqlite", check_sqlite.write)):
            path = os.path.join(folder, f"findings.{name}")
            start = time.process_time()
            write(path, rows(result, passes, "", options), "0")
            taken = time.process_time() - start
            tracemalloc.start()
            write(path, rows(result, passes, "", options), "0")
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            size = sum(
                each.stat().st_size for each in Path(folder).iterdir() if each.suffix == f".{name}"
            )
            print(
                f"{name}: {count} findings written in {taken:.2f} s of processor time, "
                f"{size / 1e6:.1f} MB, peak {peak / 2**20:.0f} MiB"
            )
            start = time.process_time()
            files = corpus_files([path])
            with Database(files, files) as database:
                summarize(database, "device", 20)
            print(
                f"{name}: opened, summarized by device, and compared in "
                f"{time.process_time() - start:.2f} s of processor time"
            )


if __name__ == "__main__":
    main()
