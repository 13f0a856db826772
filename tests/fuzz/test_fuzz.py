"""A short campaign of the fuzzer over each kind of input. `python tests/fuzz/run.py --seconds 3600`
is a long one.
"""

from __future__ import annotations

import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from tests.fuzz.isolation import Outcome, problem
from tests.fuzz.kinds import KINDS
from tests.fuzz.mutations import Mutator
from tests.paths import ROOT

pytestmark = pytest.mark.skipif(not hasattr(os, "pidfd_open"), reason="the fuzzer needs Linux")


def test_no_mutated_input_does_harm(tmp_path: Path) -> None:
    command = [
        sys.executable,
        str(ROOT / "tests/fuzz/run.py"),
        "--inputs",
        "1",
        "--seed",
        "16",
        "--output",
        str(tmp_path / "failures"),
    ]
    environment = {name: value for name, value in os.environ.items() if name != "MSAA_LINT_SAMPLES"}
    done = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{len(KINDS)} inputs" in done.stdout


def test_mutations_are_the_same_for_the_same_seed() -> None:
    first, second = (
        [mutator.mutated(b"a: {b: [1, 2]}\n", b"c: d\n") for _ in range(200)]
        for mutator in map(_mutator, (1, 1))
    )
    assert first == second
    assert len(set(first)) > 100


def _mutator(seed: int) -> Mutator:
    return Mutator(random.Random(seed), ("yaml",), "yaml", [b"a: 1\n"])


TRACEBACK = (
    'Traceback (most recent call last):\n  File "/x/msaa_lint/a/b.py", line 3, in f\nKeyError: 1\n'
)


@pytest.mark.parametrize(
    ("outcome", "arguments", "wrong"),
    [
        (Outcome(0, "", "", 0.1, 0), ("check",), ""),
        (Outcome(2, "", "msaa-lint: unknown rule", 0.1, 0), ("check", "--output", "json"), ""),
        (Outcome(1, "", TRACEBACK, 0.1, 0), ("check",), "KeyError in msaa_lint/a/b.py:3"),
        (
            Outcome(2, "", "x: error: internal error: KeyError: `a` 12; please", 0.1, 0),
            ("check",),
            "internal error: KeyError: _ _; please",
        ),
        (Outcome(-11, "", "", 0.1, 0), ("check",), "signal 11 in ?"),
        (Outcome(3, "", "", 0.1, 0), ("check",), "exit code 3"),
        (
            Outcome(0, '{"a": NaN}', "", 0.1, 0),
            ("check", "--output", "json"),
            "invalid json: ValueError",
        ),
        (
            Outcome(0, "<a>", "", 0.1, 0),
            ("check", "--output", "junit"),
            "invalid junit: ParseError",
        ),
        (Outcome(0, "\x1b[2J", "", 0.1, 0), ("check",), "an escape sequence in the output"),
        (Outcome(0, "", "", 10.5, 0), ("check",), "more than 10 s in ?"),
        (Outcome(0, "", "", 0.1, 2 << 30), ("check",), "more than 1 GB"),
    ],
)
def test_what_is_wrong_with_a_run(outcome: Outcome, arguments: tuple[str, ...], wrong: str) -> None:
    assert problem(outcome, arguments) == wrong
