"""Measures passes at several sample counts with `msaa-lint confirm` and prints a table in Markdown.

`python docs/times.py --device NVIDIA --size 3840x2160 examples/khronos-msaa`
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from typing import Any


def confirmed(arguments: argparse.Namespace, samples: int) -> dict[str, Any]:
    """The report of one sample count."""
    command = [
        sys.executable,
        "-m",
        "msaa_lint",
        "confirm",
        "--isolated",
        "--output",
        "json",
        "--time",
    ]
    command += [
        "--device",
        arguments.device,
        "--size",
        arguments.size,
        "--samples",
        str(samples),
        "--repeats",
        str(arguments.repeats),
    ]
    done = subprocess.run([*command, *arguments.paths], stdout=subprocess.PIPE, check=False)
    if done.returncode == 2:
        raise SystemExit(2)
    report: dict[str, Any] = json.loads(done.stdout)
    return report


def cell(timing: dict[str, float] | None) -> str:
    """A median with its interval, in milliseconds."""
    return (
        f"{timing['median']:.3f} ({timing['low']:.3f} to {timing['high']:.3f})" if timing else "-"
    )


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paths", nargs="+")
    parser.add_argument("--device", default="llvmpipe")
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--samples", default="1,2,4,8")
    parser.add_argument("--repeats", type=int, default=31)
    arguments = parser.parse_args()
    print(
        "| samples | file | pass | as written, ms | fixed, ms | difference |\n"
        "|---:|---|---|---:|---:|---|"
    )
    device: dict[str, Any] = {}
    for samples in map(int, arguments.samples.split(",")):
        report = confirmed(arguments, samples)
        device = report["device"]
        for each in report["passes"]:
            name = each["file"].rsplit("/", 1)[-1].removesuffix(".msaa.yaml")
            if each["time_ms"] is None:
                print(
                    f"| {samples} | {name} | {each['name']} | {each['status']}: {each['reason']} | "
                    "| |"
                )
                continue
            times = each["time_ms"]
            told = times.get("difference") or {}
            cells = [cell(times["as_written"]), cell(times.get("fixed")), told.get("says", "")]
            print(f"| {samples} | {name} | {each['name']} | {' | '.join(cells)} |")
    print(
        f"\n{device.get('name')}, {device.get('driver')}, {arguments.size}, {arguments.repeats} "
        "repeats: median and its 95 % interval."
    )


if __name__ == "__main__":
    main()
