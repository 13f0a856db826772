"""`msaa-lint confirm`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.child_environment import ignored_paths
from msaa_lint.core.execution.backend import Unusable as NoCluster
from msaa_lint.core.quote import quoted
from msaa_lint.experiments.confirm.child import Limits
from msaa_lint.experiments.confirm.outcome import DeviceRun, about, exit_code
from msaa_lint.experiments.confirm.session import Session, SessionOptions
from msaa_lint.experiments.confirm.vulkan_errors import NotWritten, Unusable

from .common import (
    MAX_RENDER_SIDE,
    Target,
    UsageError,
    division,
    input_options,
    note,
    overrides,
    parse_outputs,
    parse_size,
    refuse_inputs,
    report_module,
    report_options,
    run_command,
    warn,
    write_output,
)  # fmt: skip
from .options import PAGE_FORMATS, Arguments
from .report.data import dump_indented
from .report.escape import escape

if TYPE_CHECKING:
    from msaa_lint.experiments.confirm.inputs import Inputs
    from msaa_lint.experiments.confirm.trial import TrialOptions
    from msaa_lint.linter.request import Request

COUNTS = (1, 2, 4, 8, 16, 32, 64)


class ConfirmOptions(NamedTuple):
    """The options, parsed; `trial` are members of `TrialOptions`."""

    targets: list[Target]
    devices: list[str | None]
    limits: Limits
    layer: bool
    trial: dict[str, Any]

    def session(self, device: str | None) -> SessionOptions:
        """The session of a device."""
        return SessionOptions(device, self.layer, self.limits)


def confirm(arguments: Arguments) -> int:
    """Renders what the arguments name on a device and prints the verdicts; returns the exit
    code.
    """
    return run_command(_confirm, arguments, (NotWritten, Unusable, NoCluster), terminable=True)


def _confirm(arguments: Arguments) -> int:
    options = parse_options(arguments)
    refuse_inputs([target.path for target in options.targets], arguments["paths"])
    for text in ignored_paths():
        warn(text)
    if arguments.get("list_devices"):
        return _list_devices(options)
    if not arguments["paths"]:
        raise UsageError("no input: give files or folders to confirm, or --list-devices")
    if _is_divided(arguments, options):
        return _run_divided(arguments, options)
    with options.session(options.devices[0]).session() as session:
        # The device opens while the inputs are read.
        session.start()
        return _run(arguments, options, session)


def parse_options(arguments: Arguments) -> ConfirmOptions:
    """The options of the command line. UsageError if one cannot be used."""
    if arguments.get("time") and arguments.get("no_time"):
        raise UsageError("`--time` and `--no-time` contradict each other: write one of them")
    samples = arguments.get("samples")
    if samples is not None and samples not in COUNTS:
        raise UsageError(
            f"`--samples` must be one of {', '.join(map(str, COUNTS))}; found `{samples}`"
        )
    return ConfirmOptions(
        parse_outputs(arguments.get("output", ()), PAGE_FORMATS, "json=confirm.json")
        or [Target("full", None)],
        list(dict.fromkeys(arguments.get("device", ()))) or [None],
        Limits(seconds=_parse_seconds(arguments["timeout"]))
        if "timeout" in arguments
        else Limits(),
        not arguments.get("no_layer"),
        {
            **{
                name: arguments[name]
                for name in ("image", "force", "repeats", "samples", "resolves")
                if name in arguments
            },
            "gate": not arguments.get("no_gate"),
            "time": True if arguments.get("time") else False if arguments.get("no_time") else None,
            "size": parse_size(arguments["size"], MAX_RENDER_SIDE) if "size" in arguments else None,
        },
    )


def _parse_seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not 0 < seconds <= 86400:
        raise UsageError(
            f"`--timeout` must be seconds, above 0 and at most a day (86400); found {quoted(text)}"
        )
    return seconds


def _is_divided(arguments: Arguments, options: ConfirmOptions) -> bool:
    """Whether other processes try the inputs: not if times are measured, or lines are printed in
    the order in which inputs are tried.
    """
    backend, _, jobs = division(arguments)
    time = options.trial["time"]
    if backend is not None and time:
        raise UsageError("`--time` measures times on this machine: leave out `--backend`")
    if arguments.get("verbose") or arguments.get("traceback"):
        return False
    if backend is not None:
        return True
    return (jobs or 1) > 1 and (
        time is False
        or (not time and all(map(_is_software, map(options.session, options.devices))))
    )


def _is_software(device: SessionOptions) -> bool:
    """Whether times on a device are measured only on request; True if it cannot be opened."""
    with device.session() as session:
        try:
            return about(session.open()).software
        except Unusable:
            return True


def _run_divided(arguments: Arguments, options: ConfirmOptions) -> int:
    from msaa_lint.experiments.confirm.divided_trials import divided_trials

    devices = list(map(options.session, options.devices))
    runs, read = divided_trials(_request(arguments), devices, _trial_options(arguments, options))
    if options.trial["time"] is None and any(
        run.device is not None and not run.device.software for run in runs
    ):
        note("times are not measured by the workers of a cluster")
    return _report(arguments, options, runs, read)


def _request(arguments: Arguments) -> Request:
    from msaa_lint.linter.request import Request

    return Request(**input_options(arguments), overrides=overrides(arguments))


def _trial_options(arguments: Arguments, options: ConfirmOptions) -> TrialOptions:
    from msaa_lint.experiments.confirm.trial import TrialOptions

    shows = any(target.format == "html" for target in options.targets)
    return TrialOptions(
        **options.trial,
        several=len(options.devices) > 1,
        shows=shows,
        traceback=bool(arguments.get("traceback")),
    )


def _run(arguments: Arguments, options: ConfirmOptions, session: Session) -> int:
    from msaa_lint.experiments.confirm.inputs import inputs
    from msaa_lint.experiments.confirm.trial import trial

    terms = _trial_options(arguments, options)
    is_text = any(target.format == "full" for target in options.targets)
    read: list[Inputs] = []

    def documents() -> Any:
        if not read:
            read.append(inputs(_request(arguments)))
        return read[0].inputs

    runs = [trial(session, documents, terms, meanwhile=_import_rich if is_text else None)]
    for name in options.devices[1:]:
        with options.session(name).session() as other:
            runs.append(trial(other, documents, terms))
    return _report(arguments, options, runs, read[0])


def _report(
    arguments: Arguments, options: ConfirmOptions, runs: Sequence[DeviceRun], read: Inputs
) -> int:
    """Writes the reports, and returns the exit code."""
    _, errors, notes, docs_url = read
    for text in notes:
        note(text)
    for error in errors:
        warn(f"{error.file}: {error.message}")
    for run in runs:
        if run.unusable:
            warn(f"{run.title}: {run.unusable}")
        for printed in run.printed if arguments.get("verbose") else ():
            for line in printed.splitlines():
                warn(f"driver or layer: {line}")
    for target in options.targets:
        write_output(
            target.path, partial(_render, target.format, runs, errors, docs_url, arguments)
        )
    return exit_code(runs, bool(errors))


def _import_rich() -> None:
    """Imports what the text report needs, while the child renders."""
    import rich.box
    import rich.console
    import rich.table  # noqa: F401


def _render(
    format: str,
    runs: Sequence[DeviceRun],
    errors: Sequence[Any],
    docs_url: str,
    arguments: Arguments,
    out: IO[str],
) -> None:
    report_module("confirm", format).render(
        runs, errors, out.write, report_options(arguments, out)._replace(docs_url=docs_url)
    )


def _list_devices(options: ConfirmOptions) -> int:
    """Prints the devices that the loader finds."""
    with Session(limits=options.limits, execute="msaa_lint.experiments.confirm.devices") as session:
        devices = [about(device) for device in session.devices()]
    if any(target.format == "json" for target in options.targets):
        print(
            dump_indented(
                {
                    "schema": "msaa-lint/confirm-devices-v1",
                    "devices": [device._asdict() for device in devices],
                }
            )
        )
        return 0
    for device in devices:
        words = [
            device.name,
            f"Vulkan {device.api_version}",
            device.type.lower().replace("_", " "),
            device.driver,
        ]
        print(escape(", ".join(word for word in words if word)))
    return 0
