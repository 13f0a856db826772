"""Runs the command in a forked child with limits of time and memory, and says what is wrong with
how it ended.
"""

from __future__ import annotations

import faulthandler
import io
import json
import os
import re
import resource
import select
import signal
import sys
import xml.etree.ElementTree
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from msaa_lint.__main__ import main

SECONDS = 10
"""Processor time that one command may take."""
BYTES = 1 << 30
"""Address space that one command may take on top of that of the fuzzer."""
WALL_SECONDS = 120

_FRAME = re.compile(r'File "[^"]*/(msaa_lint/[^"]+|site-packages/[^"]+)", line (\d+)')
_INTERNAL = re.compile(r"internal error: [^\n]*")


class Outcome(NamedTuple):
    """How a command ended: its exit code (negative: a signal), what it printed, processor time in
    seconds, and memory in bytes, with what it shares with the fuzzer.
    """

    code: int
    out: str
    errors: str
    seconds: float
    memory: int


def execute(folder: Path, arguments: Sequence[str], seconds: int = SECONDS) -> Outcome:
    """Runs the command with these arguments in a folder. What the parent has imported the child
    need not import.
    """
    out, errors = folder.with_name(folder.name + ".out"), folder.with_name(folder.name + ".err")
    child = os.fork()
    if child == 0:
        _become(folder, arguments, out, errors, seconds)
    handle = os.pidfd_open(child)
    try:
        if not select.select([handle], [], [], WALL_SECONDS)[0]:
            os.killpg(child, signal.SIGKILL)
    finally:
        os.close(handle)
    _, status, usage = os.wait4(child, 0)
    texts = [
        path.read_bytes()[: 64 << 20].decode("utf-8", "surrogateescape") for path in (out, errors)
    ]
    code = os.waitstatus_to_exitcode(status)
    return Outcome(code, texts[0], texts[1], usage.ru_utime + usage.ru_stime, usage.ru_maxrss << 10)


def _become(folder: Path, arguments: Sequence[str], out: Path, errors: Path, seconds: int) -> None:
    """Turns a forked process into the command; does not return."""
    code = 70
    try:
        os.setsid()
        os.chdir(folder)
        for number, path, flags in (
            (0, Path(os.devnull), os.O_RDONLY),
            (1, out, _NEW),
            (2, errors, _NEW),
        ):
            opened = os.open(path, flags, 0o600)
            os.dup2(opened, number)
            os.close(opened)
        sys.stdin, sys.stdout, sys.stderr = (
            os.fdopen(number, mode, encoding="utf-8") for number, mode in enumerate("rww")
        )
        faulthandler.enable(sys.stderr)
        faulthandler.register(signal.SIGXCPU, sys.stderr)
        used = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
        for limit, soft, hard in (
            (resource.RLIMIT_CPU, seconds, seconds + 2),
            (resource.RLIMIT_AS, used + BYTES, used + BYTES),
            (resource.RLIMIT_FSIZE, 256 << 20, 256 << 20),
            (resource.RLIMIT_CORE, 0, 0),
        ):
            resource.setrlimit(limit, (soft, hard))
        sys.argv = ["msaa-lint", *arguments]
        try:
            main()
            code = 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else int(end.code is not None)
        sys.stdout.flush()
        sys.stderr.flush()
    except BaseException:
        import traceback

        traceback.print_exc()
        sys.stderr.flush()
        code = 71
    finally:
        os._exit(code)


_NEW = os.O_WRONLY | os.O_CREAT | os.O_TRUNC


def problem(outcome: Outcome, arguments: Sequence[str], seconds: int = SECONDS) -> str:
    """What is wrong with how a command ended; empty if nothing is. Two runs with the same bug have
    the same text.
    """
    if outcome.seconds > seconds:
        return f"more than {seconds} s in {_where(outcome.errors)}"
    if outcome.memory > BYTES:
        return "more than 1 GB"
    if outcome.code < 0:
        return f"signal {-outcome.code} in {_where(outcome.errors)}"
    if "Traceback (most recent call last)" in outcome.errors:
        return (
            f"{outcome.errors.strip().splitlines()[-1].partition(':')[0]} in "
            f"{_where(outcome.errors, -1)}"
        )
    internal = _INTERNAL.search(outcome.errors) or _INTERNAL.search(outcome.out)
    if internal:
        return re.sub(r"`[^`]*`|\d+", "_", internal[0])[:120]
    if outcome.code not in (0, 1, 2):
        return f"exit code {outcome.code}"
    return _unreadable(outcome, arguments)


def _where(errors: str, index: int = 0) -> str:
    """The innermost place in a stack of faulthandler (index 0) or a traceback (index -1)."""
    places = _FRAME.findall(errors)
    return ":".join(places[index]) if places else "?"


def _unreadable(outcome: Outcome, arguments: Sequence[str]) -> str:
    """The problem of an output in a machine format: text that no parser of the format reads."""
    format = arguments[arguments.index("--output") + 1] if "--output" in arguments else ""
    try:
        outcome.out.encode()
        if format in ("json", "sarif", "gitlab", "rdjson") and (outcome.out or outcome.code != 2):
            json.loads(outcome.out, parse_constant=_not_json)
        elif format == "junit" and outcome.out:
            xml.etree.ElementTree.parse(io.BytesIO(outcome.out.encode()))
    except (ValueError, RecursionError, xml.etree.ElementTree.ParseError) as error:
        return f"invalid {format or 'text'}: {type(error).__name__}"
    if "\x1b" in outcome.out + outcome.errors:
        return "an escape sequence in the output"
    return ""


def _not_json(word: str) -> None:
    raise ValueError(word)
