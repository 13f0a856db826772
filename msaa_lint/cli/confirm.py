"""`msaa-lint confirm`."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from functools import partial
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.package import VERSION
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.results import NotWritten, Unusable

from .common import MOST_PIXELS, Mistake, Target, colored, ended, outputs, settings, size, written
from .report.escape import visible

if TYPE_CHECKING:
    from msaa_lint.experiments.confirm.session import Session

FORMATS = ("full", "json")
COUNTS = (1, 2, 4, 8, 16, 32, 64)


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
    return ended(_confirm, given, (NotWritten, Unusable), terminable=True)


def options(given: Mapping[str, Any]) -> Options:
    """The options of the command line. Mistake where one says nothing."""
    if given.get("time") and given.get("no_time"):
        raise Mistake("--time and --no-time contradict each other")
    samples = given.get("samples")
    if samples is not None and samples not in COUNTS:
        raise Mistake(f"--samples {samples}: one of {', '.join(map(str, COUNTS))} is due")
    return Options(
        outputs(given.get("output", ()), FORMATS, "json=confirm.json") or [Target("full", None)],
        list(dict.fromkeys(given.get("device", ()))) or [None],
        Limits(seconds=_seconds(given["timeout"])) if "timeout" in given else Limits(),
        not given.get("no_layer"),
        not given.get("no_gate"),
        given.get("image"),
        True if given.get("time") else False if given.get("no_time") else None,
        given.get("repeats", 15),
        size(given["size"], MOST_PIXELS) if "size" in given else None,
        samples,
        bool(given.get("resolves")),
    )


def _seconds(text: object) -> float:
    try:
        value = float(str(text))
    except ValueError:
        value = math.nan
    if not 0 < value <= 86400:
        raise Mistake(f"--timeout {str(text)[:40]!r}: seconds are due, above 0 and at most a day")
    return value


def _confirm(given: Mapping[str, Any]) -> int:
    if given.get("list_devices"):
        return list_devices(given)
    if not given["paths"]:
        raise Mistake("PATH... is due: files and folders to confirm, or --list-devices")
    asked = options(given)
    from msaa_lint.experiments.confirm.session import Session, environment

    with Session(asked.devices[0], validation=asked.layer, limits=asked.limits, environment=environment(asked.devices[0])) as first:
        # The device opens while we read.
        first.start()
        return _tried(given, asked, first)


def _tried(given: Mapping[str, Any], asked: Options, first: Session) -> int:
    from msaa_lint.experiments.confirm.session import Session, environment
    from msaa_lint.experiments.confirm.trial import Terms, trial

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
    from msaa_lint.experiments.confirm.outcome import exit_code

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
        written(target.path, partial(_render, target.format, runs, read_inputs.wrong, given))
    return exit_code(runs, bool(read_inputs.wrong))


def _warm() -> None:
    """Imports what the text report needs, while the child draws."""
    import rich.box
    import rich.console
    import rich.table  # noqa: F401


def _inputs(given: Mapping[str, Any]) -> Any:
    from msaa_lint.experiments.confirm.inputs import inputs
    from msaa_lint.linter.run import Request

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


def _render(format: str, runs: Sequence[Any], wrong: Sequence[Any], given: Mapping[str, Any], out: IO[str]) -> None:
    if format == "json":
        from .report.confirm_json import render as as_json

        as_json(runs, wrong, out.write, VERSION)
        return
    from .report import Options as Shown
    from .report.confirm_text import render

    terminal = out.isatty()
    width = 140
    if terminal:
        import shutil

        width = shutil.get_terminal_size().columns
    shown = Shown(color=colored(given.get("color", "auto"), terminal), width=width, statistics=bool(given.get("verbose")))
    render(runs, out.write, shown)


def list_devices(given: Mapping[str, Any]) -> int:
    """Prints the devices that the loader finds; 2 where it finds none."""
    from msaa_lint.experiments.confirm.outcome import about
    from msaa_lint.experiments.confirm.session import Session

    asked = options(given)
    with Session(limits=asked.limits, execute="msaa_lint.experiments.confirm.devices") as session:
        found = [about(device) for device in session.devices()]
    if any(target.format == "json" for target in asked.targets):
        import json

        print(json.dumps({"schema": "msaa-lint/confirm-devices-v1", "devices": [each._asdict() for each in found]}, indent=2))
        return 0
    for device in found:
        words = [device.name, f"Vulkan {device.api_version}", device.type.lower().replace("_", " "), device.driver]
        print(visible(", ".join(word for word in words if word)))
    return 0
