"""Fuzzes what the command reads: every format of inputs, the configuration, rule pages, baselines,
records, reports, and meshes.

    python tests/fuzz/run.py --seconds 3600
    python tests/fuzz/run.py --seconds 300 --kind yaml --kind json --seed 7

Each input is an input of the tests after a few changes (`mutations`), read by the real command in a
forked child (`isolation`). An input whose output shows something new is changed further. Wrong are
a traceback, an internal error, a signal, an exit code other than 0, 1, or 2, output that no parser
of its format reads, more than 10 s of processor time, and more than 1 GB. What is wrong is
shortened and saved to `--output`, once for each cause. Exits with 1 if anything is wrong.
"""

from __future__ import annotations

import argparse
import functools
import gc
import os
import random
import re
import shlex
import shutil
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[2]))

from msaa_lint.linter import engine
from tests.fuzz.corpus import points
from tests.fuzz.isolation import Outcome, execute, problem
from tests.fuzz.kinds import KINDS, Kind, seeds
from tests.fuzz.mutations import Mutator

MAX_POOL = 2000
_loaded: set[tuple[str, ...]] = set()
_VARIABLE = re.compile(r"`[^`]*`|\"[^\"]*\"|'[^']*'|[-+]?\d[\w.]*")


class Campaign:
    """The fuzzing of one kind of input."""

    def __init__(self, name: str, seed: int, output: Path, folder: Path) -> None:
        self.name, self.kind, self.output, self.folder = name, KINDS[name], output, folder
        self.random = random.Random(f"{seed} {name}")
        self.pool = seeds(self.kind)
        self.accepted: list[bytes] = []
        self.mutator = Mutator(self.random, self.kind.languages, self.kind.tree, self.pool)
        self.features: set[str] = set()
        self.problems: set[str] = set()
        self.inputs = self.runs = 0
        self.slowest = self.largest = 0.0
        self.seconds = 0.0
        self.codes: Counter[int] = Counter()

    def step(self) -> None:
        """Mutates one input, and runs one or two commands on it."""
        data = self.random.choice(
            self.accepted if self.accepted and self.random.random() < 0.6 else self.pool
        )
        if self.random.random() < 0.98:
            data = self.mutator.mutated(data, self.random.choice(self.pool))
        self.inputs += 1
        for _ in range(self.random.choice((1, 1, 2))):
            self.examine(data, self.random.choice(self.kind.commands))

    def examine(self, data: bytes, command: tuple[str, ...]) -> None:
        """Runs a command on an input. Saves an input that shows a problem; keeps one whose output
        has new features.
        """
        outcome, wrong = self.run(data, command)
        self.runs += 1
        self.codes[outcome.code] += 1
        self.seconds += outcome.seconds
        self.slowest, self.largest = (
            max(self.slowest, outcome.seconds),
            max(self.largest, outcome.memory),
        )
        if wrong and wrong not in self.problems:
            self.problems.add(wrong)
            self.save(self.shortened(data, command, wrong), command, wrong)
        new = set() if wrong else _features(command, outcome) - self.features
        if new and len(data) <= 200_000:
            self.features |= new
            pool = self.accepted if outcome.code < 2 else self.pool
            if len(pool) < MAX_POOL:
                pool.append(data)

    def run(self, data: bytes, command: tuple[str, ...]) -> tuple[Outcome, str]:
        """Runs a command on an input; the outcome and what is wrong with it."""
        place(self.folder, self.kind, data)
        arguments = arguments_of(self.kind, command)
        outcome = execute(self.folder, arguments)
        wrong = problem(outcome, arguments)
        if "internal error" in wrong:
            wrong = problem(execute(self.folder, [*arguments, "--traceback"]), arguments) or wrong
        return outcome, wrong

    def shortened(self, data: bytes, command: tuple[str, ...], wrong: str) -> bytes:
        """A shorter input with the same problem, after at most 60 tries."""
        unit = b"\n" if data.count(b"\n") > 4 else b""
        parts = data.split(unit) if unit else [data[at : at + 1] for at in range(len(data))]
        tries = 60 if "more than" not in wrong else 8
        size = len(parts) // 2
        while size and tries:
            at = 0
            while at < len(parts) and tries:
                tries -= 1
                shorter = parts[:at] + parts[at + size :]
                if self.run(unit.join(shorter), command)[1] == wrong:
                    parts = shorter
                else:
                    at += size
            size //= 2
        return unit.join(parts)

    def save(self, data: bytes, command: tuple[str, ...], wrong: str) -> None:
        """Writes a folder in which the command fails, and how it is called."""
        slug = re.sub(r"\W+", "-", wrong).strip("-")[:80]
        folder = self.output / f"{self.name}-{slug}"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        place(folder, self.kind, data)
        line = shlex.join(["msaa-lint", *arguments_of(self.kind, command)])
        folder.with_name(folder.name + ".txt").write_text(
            f"{wrong}\n{line}\n", encoding="utf-8", errors="surrogateescape"
        )
        print(f"{self.name}: {wrong}: {line} in {folder}", flush=True)

    def summary(self) -> str:
        """A line of a table in Markdown."""
        mean = 1000 * self.seconds / max(1, self.runs)
        codes = ", ".join(f"{code}: {count}" for code, count in sorted(self.codes.items()))
        return (
            f"| {self.name} | {self.inputs} | {self.runs} | {self.seconds:.0f} | {mean:.0f} | "
            f"{self.slowest:.2f} "
            f"| {self.largest / 1e6:.0f} | {codes} | {len(self.problems)} |"
        )


def _features(command: tuple[str, ...], outcome: Outcome) -> set[str]:
    """The forms of the lines that a command prints."""
    lines = (outcome.out[:20_000] + outcome.errors[:20_000]).splitlines()
    return {f"{command[0]} {_VARIABLE.sub('_', line[:300])}" for line in lines}


def place(folder: Path, kind: Kind, data: bytes) -> None:
    """Writes an input, and what lies beside it, to an empty folder."""
    shutil.rmtree(folder, ignore_errors=True)
    names = points() if kind.name == "points/*" else ()
    for name, content in {
        **kind.files,
        **({f"points/{name}": data for name in names} or {kind.name: data}),
    }.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)


def arguments_of(kind: Kind, command: tuple[str, ...]) -> tuple[str, ...]:
    """A command line on the input of a kind."""
    return command if command[0] == "rule" else (*command, kind.input or kind.name)


def load(kind: Kind, folder: Path) -> None:
    """Imports what the commands of a kind need, and reads the packaged rules, so that children need
    not.
    """
    from msaa_lint.linter import workspace
    from tests.command import run

    packaged = functools.cache(lambda: engine.load_rules([]))
    workspace.load_rules = lambda paths, *more: (
        engine.load_rules(paths, *more) if paths else packaged()
    )  # type: ignore[attr-defined]
    place(folder, kind, next(iter(kind.seeds())))
    for command in kind.commands[:1] + tuple(set(kind.commands) - _loaded):
        run(folder, *arguments_of(kind, command))
    _loaded.update(kind.commands)
    gc.collect()


def main() -> int:
    """Fuzzes in rounds over the kinds until the time is over, and prints a table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[0])
    parser.add_argument("--seconds", type=float, help="processor time of all commands together")
    parser.add_argument("--inputs", type=int, help="inputs of each kind, instead of a time")
    parser.add_argument(
        "--kind", choices=list(KINDS), action="append", help="kinds of input; all by default"
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--output", type=Path, default=Path("fuzz-failures"))
    options = parser.parse_args()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "input"
        campaigns = []
        for kind in options.kind or KINDS:
            load(KINDS[kind], folder)
            campaigns.append(Campaign(kind, options.seed, options.output.resolve(), folder))
        if options.inputs is not None:
            for campaign in campaigns:
                while campaign.inputs < options.inputs:
                    campaign.step()
        else:
            seconds = options.seconds or 60
            while sum(campaign.seconds for campaign in campaigns) < seconds:
                min(campaigns, key=lambda campaign: campaign.seconds).step()
    print(
        "| input | inputs | runs | s | ms a run | slowest s | largest MB | exit codes | problems "
        "|\n|---|---|---|---|---|---|---|---|---|"
    )
    for campaign in campaigns:
        print(campaign.summary())
    total = (
        sum(campaign.inputs for campaign in campaigns),
        sum(campaign.seconds for campaign in campaigns),
    )
    problems = sum(len(campaign.problems) for campaign in campaigns)
    print(
        f"{total[0]} inputs, {total[1]:.0f} s of processor time, {time.monotonic() - begin:.0f} s "
        f"in all, {problems} problems"
    )
    return int(problems > 0)


if __name__ == "__main__":
    sys.exit(main())
