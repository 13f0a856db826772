"""`msaa-lint confirm`."""

from __future__ import annotations

import math
import os
import signal
import sys
from collections.abc import Mapping, Sequence
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from .. import __version__
from ..confirm.child import Limits
from ..confirm.results import NotWritten, Unusable
from ..report.escape import visible
from .common import BROKEN_PIPE, Target, colored, settings

if TYPE_CHECKING:
    from ..confirm.session import Session

FORMATS = ("full", "json")
MOST_PIXELS = 16384
COUNTS = (1, 2, 4, 8, 16, 32, 64)


class Mistake(Exception):
    """An option that says nothing that can be used; its text is for the user."""


class Options(NamedTuple):
    """The options, read. `time` is None where the device decides."""

    targets: list[Target]
    devices: list[str | None]
    limits: Limits
    layer: bool
    gate: bool
    image: str | None
    time: bool | None
    repeats: int
    size: tuple[int, int] | None
    samples: int | None
    resolves: bool


def confirm(given: Mapping[str, Any]) -> int:
    """Tries what the arguments name on a device and prints what came of it; the exit code."""
    handler = _terminable()
    try:
        if given.get("list_devices"):
            return list_devices(given)
        if not given["paths"]:
            raise Mistake("PATH... is due: files and folders to confirm, or --list-devices")
        return _confirm(given, options(given))
    except (Mistake, NotWritten, Unusable) as error:
        print(f"msaa-lint: {visible(str(error))}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        if given.get("traceback"):
            raise
        reason = visible(str(error)[:300])
        print(f"msaa-lint: the program failed: {type(error).__name__}: {reason} (--traceback shows where)", file=sys.stderr)
        return 2
    finally:
        if handler is not None:
            signal.signal(signal.SIGTERM, handler)


def _terminable() -> Any:
    """Has SIGTERM end us in order, so that no child and no file is left; what it did before, None where that is not ours to change."""

    def end(number: int, _: object) -> None:
        raise SystemExit(128 + number)

    try:
        return signal.signal(signal.SIGTERM, end)
    except ValueError:
        return None


def options(given: Mapping[str, Any]) -> Options:
    """The options of the command line. Mistake where one says nothing."""
    if given.get("time") and given.get("no_time"):
        raise Mistake("--time and --no-time contradict each other")
    samples = given.get("samples")
    if samples is not None and samples not in COUNTS:
        raise Mistake(f"--samples {samples}: one of {', '.join(map(str, COUNTS))} is due")
    return Options(
        outputs(given.get("output", ())),
        list(dict.fromkeys(given.get("device", ()))) or [None],
        Limits(seconds=_seconds(given["timeout"])) if "timeout" in given else Limits(),
        not given.get("no_layer"),
        not given.get("no_gate"),
        given.get("image"),
        True if given.get("time") else False if given.get("no_time") else None,
        given.get("repeats", 15),
        size(given["size"]) if "size" in given else None,
        samples,
        bool(given.get("resolves")),
    )


def outputs(stated: Sequence[str]) -> list[Target]:
    """The outputs that `FORMAT[=FILE]` name; `full` where none is."""
    targets = []
    for text in stated:
        name, equals, path = text.partition("=")
        if name not in FORMATS:
            raise Mistake(f"no output {text[:40]!r}; there are {', '.join(FORMATS)}")
        targets.append(Target(name, path if equals and path not in ("", "-") else None))
    if sum(target.path is None for target in targets) > 1:
        raise Mistake("two outputs go to standard output: give all but one a file, as in --output json=confirm.json")
    return targets or [Target("full", None)]


def size(text: str) -> tuple[int, int]:
    """Width and height of `1920x1080`."""
    sides = [int(side) for side in text.lower().split("x") if side.isascii() and side.isdigit() and len(side) < 6]
    if len(sides) != 2 or text.lower().count("x") != 1 or not all(1 <= side <= MOST_PIXELS for side in sides):
        raise Mistake(f"--size {text[:40]!r}: WIDTHxHEIGHT in pixels is due, at most {MOST_PIXELS} each, as in 1920x1080")
    return sides[0], sides[1]


def _seconds(text: object) -> float:
    try:
        value = float(str(text))
    except ValueError:
        value = math.nan
    if not 0 < value <= 86400:
        raise Mistake(f"--timeout {str(text)[:40]!r}: seconds are due, above 0 and at most a day")
    return value


def _confirm(given: Mapping[str, Any], asked: Options) -> int:
    from ..confirm.session import Session, environment

    with Session(asked.devices[0], validation=asked.layer, limits=asked.limits, environment=environment(asked.devices[0])) as first:
        # The device opens while we read.
        first.start()
        return _tried(given, asked, first)


def _tried(given: Mapping[str, Any], asked: Options, first: Session) -> int:
    from ..confirm.session import Session, environment
    from ..confirm.trial import Terms, trial

    terms = Terms(asked.gate, asked.image, asked.time, asked.repeats, asked.size, asked.samples, len(asked.devices) > 1, asked.resolves)
    runs = []
    found: list[Any] = []

    def read() -> Any:
        if not found:
            found.append(_inputs(given))
        return found[0].inputs

    shown = any(target.format == "full" for target in asked.targets)
    runs.append(trial(first, read, terms, meanwhile=_warm if shown else None))
    for name in asked.devices[1:]:
        with Session(name, validation=asked.layer, limits=asked.limits, environment=environment(name)) as session:
            runs.append(trial(session, read, terms, meanwhile=_warm))
    (read_inputs,) = found
    from ..confirm.outcome import exit_code

    for note in read_inputs.notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    for wrong in read_inputs.wrong:
        print(f"msaa-lint: {visible(wrong.file)}: {visible(wrong.message)}", file=sys.stderr)
    for run in runs:
        if run.unusable:
            print(f"msaa-lint: {visible(run.title)}: {visible(run.unusable)}", file=sys.stderr)
        for text in run.printed if given.get("verbose") else ():
            for line in text.splitlines():
                print(f"msaa-lint: driver or layer: {visible(line)}", file=sys.stderr)
    for target in asked.targets:
        if not _print(target, runs, read_inputs.wrong, given):
            return 2
    return exit_code(runs, bool(read_inputs.wrong))


def _warm() -> None:
    """Imports what the text report needs, while the child draws."""
    import rich.box
    import rich.console
    import rich.table  # noqa: F401


def _inputs(given: Mapping[str, Any]) -> Any:
    from ..confirm.inputs import inputs
    from ..run import Request

    return inputs(
        Request(
            paths=given["paths"],
            overrides=settings(given),
            config=given.get("config"),
            isolated=bool(given.get("isolated")),
            format=given.get("input_format"),
            stdin_filename=given.get("stdin_filename"),
        )
    )


def _print(target: Target, runs: Sequence[Any], wrong: Sequence[Any], given: Mapping[str, Any]) -> bool:
    if target.path is None:
        if hasattr(sys.stdout, "reconfigure"):
            sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
        _render(target, runs, wrong, given, sys.stdout)
        sys.stdout.flush()
        return True
    try:
        with open(target.path, "w", encoding="utf-8", newline="\n") as file:
            _render(target, runs, wrong, given, file)
    except OSError as error:
        print(f"msaa-lint: {visible(target.path)} cannot be written: {error.strerror}", file=sys.stderr)
        return False
    return True


def _render(target: Target, runs: Sequence[Any], wrong: Sequence[Any], given: Mapping[str, Any], out: IO[str]) -> None:
    if target.format == "json":
        from ..report.confirm_json import render as as_json

        as_json(runs, wrong, out.write, __version__)
        return
    from ..report import Options as Shown
    from ..report.confirm_text import render

    terminal = out.isatty()
    width = 140
    if terminal:
        import shutil

        width = shutil.get_terminal_size().columns
    shown = Shown(color=colored(given.get("color", "auto"), terminal), width=width, statistics=bool(given.get("verbose")))
    render(runs, out.write, shown)


def list_devices(given: Mapping[str, Any]) -> int:
    """Prints the devices that the loader finds; 2 where it finds none."""
    from ..confirm.outcome import about
    from ..confirm.session import Session

    asked = options(given)
    with Session(limits=asked.limits, execute="msaa_lint.confirm.devices") as session:
        found = [about(device) for device in session.devices()]
    if any(target.format == "json" for target in asked.targets):
        import json

        print(json.dumps({"schema": "msaa-lint/confirm-devices-v1", "devices": [each._asdict() for each in found]}, indent=2))
        return 0
    for device in found:
        words = [device.name, f"Vulkan {device.api_version}", device.type.lower().replace("_", " "), device.driver]
        print(visible(", ".join(word for word in words if word)))
    return 0
