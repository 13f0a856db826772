"""Many inputs: `python tests/benchmarks/corpus.py [--share 0.1] [--backend dask] [--folder FOLDER]
[KIND...]`. Prints a table in Markdown.

The corpus is made by variation: 10,000 descriptions, 10,000 pipelines as the Vulkan SC tools write
them, 200 captures of 5 MB, and 1,000 Fossilize databases; `--share` makes a part of it. Each kind
is linted by one process, by two, by two workers of each `--backend` (of a cluster that runs, and of
one that starts and ends with the run), and again from the cache; the JSON must be the same bytes
each time. Memory is that of the process that divides the work. With `--kill`, one of the processes
of this machine is killed every so many seconds, at random.
"""

from __future__ import annotations

import argparse
import contextlib
import filecmp
import itertools
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).parents[2]))

from captures import limited
from inputs import DESCRIPTION, ROOT, pipeline
from long_captures import game

from tests.input.readers.dialects_binary import fossilize

COUNTS = {"descriptions": 10_000, "pipelines": 10_000, "captures": 200, "fossilize": 1_000}

KILLED = "2 processes that are killed"

CAPTURE_BYTES = 5_000_000

FOLDER_FILES = 500
"""The number of files in a folder."""

MEASURED = """
import os, resource, sys
from msaa_lint.__main__ import main
own = os.getpid()
sys.argv = ["msaa-lint", *sys.argv[2:]]
try:
    main()
finally:
    if os.getpid() == own:
        with open(os.environ["MEASURED"], "w") as file:
            usage = resource.getrusage(resource.RUSAGE_SELF)
            print(usage.ru_maxrss, usage.ru_utime + usage.ru_stime, file=file)
"""

CLUSTERS = {
    "dask": """if __name__ == "__main__":
        import sys
        from distributed import LocalCluster
        cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0", memory_limit=0)
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
    """,
    "ray": """if True:
        import sys, ray
        ray.init(address="local", num_cpus=2, include_dashboard=False, logging_level="ERROR")
        print(ray.get_runtime_context().gcs_address, flush=True)
        sys.stdin.read()
    """,
}
"""Programs that start a cluster, print its address, and end it with their input."""


class Sample(NamedTuple):
    """Seconds of wall and processor time, the latter of all processes that ended and of the first
    one alone, the memory of the first process in bytes, and how many processes were killed.
    """

    wall: float
    cpu: float
    own_cpu: float
    memory: int
    killed: int


def descriptions() -> Iterator[tuple[str, bytes]]:
    """Frames with one pass, some of which have mistakes."""
    varied = itertools.product(
        (2, 4, 8),
        ("STORE", "DONT_CARE"),
        ("CLEAR", "LOAD", "DONT_CARE"),
        ("D32_SFLOAT", "D24_UNORM_S8_UINT"),
    )
    for number, (samples, store, load, depth) in enumerate(itertools.cycle(varied)):
        text = (
            DESCRIPTION.replace("forward", f"forward_{number}")
            .replace("samples: 4", f"samples: {samples}")
            .replace("D32_SFLOAT", depth)
        )
        text = text.replace("rasterizationSamples: 4", f"rasterizationSamples: {samples}").replace(
            "storeOp: STORE", f"storeOp: {store}", 1
        )
        yield f"{number:05}.msaa.yaml", text.replace("loadOp: CLEAR", f"loadOp: {load}", 1).encode()


def pipelines() -> Iterator[tuple[str, bytes]]:
    """Pipelines of Vulkan SC."""
    for number in itertools.count():
        yield (
            f"{number:05}.json",
            pipeline(number).replace('"offset": 0', f'"offset": {number}', 1).encode(),
        )


def captures() -> Iterator[tuple[str, bytes]]:
    """Frames of a game, of which each capture has others."""
    for number in itertools.count():
        yield f"{number:03}.jsonl", b"".join(limited(game(), CAPTURE_BYTES + 1000 * number))


def databases() -> Iterator[tuple[str, bytes]]:
    """Render passes and pipelines."""
    for number in itertools.count():
        calls: list[tuple[str, dict[str, object]]] = []
        for index in range(1, 1 + number % 40):
            attachment = {
                "format": 37,
                "samples": 2 << index % 3,
                "loadOp": 1,
                "storeOp": index % 2,
                "initialLayout": 0,
                "finalLayout": 2,
            }
            subpass = {"pColorAttachments": [{"attachment": 0, "layout": 2}]}
            state = {
                "rasterizationSamples": 2 << index % 3,
                "minSampleShading": number / 1000,
                "sampleShadingEnable": index % 5 == 0,
            }
            calls.append(
                (
                    "vkCreateRenderPass",
                    {
                        "pCreateInfo": {"pAttachments": [attachment], "pSubpasses": [subpass]},
                        "pRenderPass": index,
                    },
                )
            )
            create = {"pMultisampleState": state, "renderPass": index, "subpass": 0}
            calls.append(
                (
                    "vkCreateGraphicsPipelines",
                    {"createInfoCount": 1, "pCreateInfos": [create], "pPipelines": [100 + index]},
                )
            )
        yield f"{number:04}.foz", fossilize(calls)


KINDS: dict[str, Callable[[], Iterator[tuple[str, bytes]]]] = {
    "descriptions": descriptions,
    "pipelines": pipelines,
    "captures": captures,
    "fossilize": databases,
}


def make(folder: Path, kind: str, share: float) -> int:
    """Writes the inputs of a kind into folders of `FOLDER_FILES`, unless they are there, and
    returns their number.
    """
    count = max(round(COUNTS[kind] * share), 2)
    if len(list((folder / kind).rglob("*.*"))) != count:
        for number, (name, data) in enumerate(itertools.islice(KINDS[kind](), count)):
            path = folder / kind / f"{number // FOLDER_FILES:03}" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
    return count


def kill(parent: int, seconds: float, ended: threading.Event, killed: list[int]) -> None:
    """Kills a child of a process every so many seconds."""
    numbers = random.Random(1)
    while not ended.wait(seconds):
        children = (
            Path(f"/proc/{parent}/task/{parent}/children").read_text(encoding="utf-8").split()
        )
        if children:
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(numbers.choice(children)), signal.SIGKILL)
                killed.append(1)


def lint(folder: Path, kept: Path, output: Path, *options: str, killing: float = 0.0) -> Sample:
    """Lints a folder to its end; `killing` is the time in seconds after which a process is killed,
    again and again.
    """
    measured = output.with_suffix(".measured")
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("PYTHON", "MSAA_LINT_"))
    }
    environment |= {"PYTHONPATH": ROOT, "XDG_CACHE_HOME": str(kept), "MEASURED": str(measured)}
    command = [
        sys.executable,
        "-c",
        MEASURED,
        "-",
        "check",
        "--isolated",
        str(folder),
        "--output",
        f"json={output}",
        *options,
    ]
    start = time.perf_counter()
    child = os.posix_spawn(sys.executable, command, environment)
    ended, killed = threading.Event(), list[int]()
    if killing:
        threading.Thread(target=kill, args=(child, killing, ended, killed), daemon=True).start()
    _, status, usage = os.wait4(child, 0)
    ended.set()
    wall = time.perf_counter() - start
    if os.waitstatus_to_exitcode(status) not in (0, 1):
        raise SystemExit(f"exit code {os.waitstatus_to_exitcode(status)}: {' '.join(command[3:])}")
    memory, own_cpu = measured.read_text(encoding="utf-8").split()
    return Sample(
        wall, usage.ru_utime + usage.ru_stime, float(own_cpu), 1024 * int(memory), len(killed)
    )


@contextlib.contextmanager
def running(backends: list[str]) -> Iterator[dict[str, str]]:
    """Clusters that run in the `with` statement: their addresses by name."""
    with contextlib.ExitStack() as ends:
        addresses = {}
        environment = {**os.environ, "PYTHONPATH": ROOT}
        for name in backends:
            command = [sys.executable, "-c", CLUSTERS[name]]
            cluster = subprocess.Popen(
                command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
            ends.enter_context(cluster)
            assert cluster.stdin is not None and cluster.stdout is not None
            ends.callback(cluster.stdin.close)
            addresses[name] = cluster.stdout.readline().strip()
        yield addresses


def rows(
    folder: Path, kind: str, share: float, clusters: dict[str, str], killing: float
) -> Iterator[str]:
    """The lines of the table for a kind."""
    count = make(folder, kind, share)
    kept, one, other = folder / "kept", folder / "one.json", folder / "other.json"
    ways = {
        "1 process": ("--jobs", "1", "--no-cache"),
        "2 processes": ("--jobs", "2", "--no-cache"),
    }
    ways |= {KILLED: ways["2 processes"]} if killing else {}
    for name, address in clusters.items():
        ways[f"2 workers of {name}"] = ("--backend", name, "--cluster", address, "--no-cache")
        ways[f"2 workers of {name}, started"] = ("--backend", name, "--jobs", "2", "--no-cache")
    ways |= {
        "1 process, which keeps": ("--jobs", "1"),
        "1 process, from the cache": ("--jobs", "1"),
    }
    first = 0.0
    for way, options in ways.items():
        sample = lint(
            folder / kind,
            kept,
            other if first else one,
            *options,
            killing=killing if way == KILLED else 0.0,
        )
        way += f" ({sample.killed})" if way == KILLED else ""
        same = not first or filecmp.cmp(one, other, shallow=False)
        first = first or sample.wall
        speed = (
            f"{first / sample.wall:.2f}"
            if "cache" not in way
            else f"{100 * sample.wall / first:.1f} % of its time"
        )
        yield (
            f"| {count} {kind} | {way} | {sample.wall:.1f} | {sample.cpu:.1f} | "
            f"{sample.own_cpu:.1f} "
            f"| {1000 * sample.wall / count:.2f} | {speed} | {sample.memory / 1e6:.0f} | "
            f"{'yes' if same else 'NO'} |"
        )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "kinds", nargs="*", metavar="KIND", default=list(KINDS), help=", ".join(KINDS)
    )
    parser.add_argument("--share", type=float, default=1.0, help="the part of the corpus to make")
    parser.add_argument("--backend", action="append", default=[], choices=("dask", "ray"))
    parser.add_argument("--kill", type=float, default=0.0, metavar="SECONDS")
    parser.add_argument("--folder", type=Path, help="where to keep the corpus")
    arguments = parser.parse_args()
    os.environ |= {"RAY_AUTH_MODE": "disabled", "RAY_USAGE_STATS_ENABLED": "0"}
    columns = (
        "inputs",
        "linted by",
        "wall, s",
        "processor, s",
        "of the first process",
        "ms an input",
        "times as fast as one process",
    )
    print(f"| {' | '.join(columns)} | MB | same bytes |")
    print("|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        folder = (arguments.folder or Path(temporary)).absolute()
        for kind in arguments.kinds:
            with running(arguments.backend) as clusters:
                for line in rows(folder, kind, arguments.share, clusters, arguments.kill):
                    print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
