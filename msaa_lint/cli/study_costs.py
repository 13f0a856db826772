"""What the techniques of `msaa-lint study` cost: times on the device that `--device` names, and
amounts of the cost model.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.experiments.study.checkpoint import Checkpoint
from msaa_lint.experiments.study.points import Technique
from msaa_lint.experiments.study.shading import DEFAULT, SHARES, Shading, target
from msaa_lint.experiments.study.times import REPEATS, CostModel, Costs
from msaa_lint.linter.study_record import AS_DESCRIBED, DEFAULT_SHADING, stated_shading

from .common import UsageError, warn
from .options import Arguments
from .study_subjects import Subject, errors_of

MAX_SHADINGS = 8
LEAST_FOR_INTERVAL = 6
"""The rounds from which an interval contains the median with a probability of 95 %
(confirm/timing.py).
"""

MAX_OVERDRAW = 100
DEVICE_ALONE = ("shading", "shader", "overdraw", "triangle_size")
"""The options that say how a device draws."""

Progress = Callable[[int, int, str], None]


class TimingRequest(NamedTuple):
    """How a device draws: the names of the costs of shading, the file of one's own fragment shader
    (or empty), how often each triangle is drawn, and the longest side of a triangle in pixels (0:
    as the scene has it).
    """

    shadings: tuple[str, ...] = DEFAULT
    shader: str = ""
    overdraw: int = 1
    triangle_size: float = 0.0


class SubjectCosts(NamedTuple):
    """The costs of shading under which a subject is timed, what its techniques cost under each, and
    what is assumed of its frame.
    """

    shadings: Sequence[Shading]
    costs: Costs
    assumed: tuple[str, ...] = ()


class AllCosts(NamedTuple):
    """The costs of each subject by its name, and the device whose clock timed them: its name (empty
    without any), whether it is a CPU, and whether its times had not settled.
    """

    subjects: Mapping[str, SubjectCosts]
    device: str = ""
    software: bool = False
    unstable: bool = False

    @property
    def shadings(self) -> list[Shading]:
        """All costs of shading, the cheapest first."""
        found = {
            shading.name: shading
            for subject in self.subjects.values()
            for shading in subject.shadings
            if shading.name
        }
        return sorted(found.values(), key=lambda shading: shading.full_screen_ms or 0.0)


def timing_request(arguments: Arguments) -> TimingRequest:
    """The options of times. UsageError if one cannot be used."""
    stated = [name for name in DEVICE_ALONE if name in arguments]
    if stated and "device" not in arguments:
        raise UsageError(f"`--{stated[0].replace('_', '-')}` is about times: add `--device NAME`")
    shader = arguments.get("shader", "")
    names: list[str] = [] if shader else list(DEFAULT)
    if "shading" in arguments:
        names = [_shading(word.strip()) for word in arguments["shading"].split(",")]
    if len(names) > MAX_SHADINGS:
        raise UsageError(f"`--shading` takes up to {MAX_SHADINGS} costs, found {len(names)}")
    overdraw = arguments.get("overdraw", 1)
    if overdraw > MAX_OVERDRAW:
        raise UsageError(f"`--overdraw` must be at most {MAX_OVERDRAW}, found {overdraw}")
    size = arguments.get("triangle_size", 0.0)
    return TimingRequest(tuple(dict.fromkeys(names)), shader, overdraw, size)


def _shading(word: str) -> str:
    try:
        return target(word, (1, 1)).shading.name
    except ValueError:
        units = "200ops (operations), 500000ns (a million invocations), or 4ms (a full screen)"
        raise UsageError(
            f"`--shading` takes {', '.join(SHARES)}, or a cost such as {units}; found "
            f"{quoted(word)}"
        ) from None


def subject_costs(
    studied: Sequence[Subject],
    errors: list[Finding],
    arguments: Arguments,
    techniques: Sequence[Technique],
    size: tuple[int, int],
    checkpoint: Checkpoint | None,
    progress: Progress | None,
) -> AllCosts:
    """What each technique costs. An internal error of one scene is added to `errors`."""
    from msaa_lint.experiments.study.calibration import Calibration
    from msaa_lint.experiments.study.sweep import costs

    request = timing_request(arguments)
    found: dict[str, SubjectCosts] = {}
    with _clock(arguments) as clock:
        stages = _own_stages(request, clock) if clock is not None else ()
        calibration = Calibration(clock)
        for number, subject in enumerate(studied):
            if progress is not None and clock is not None:
                progress(number, len(studied), f"{subject.input.name} on {clock.name}")
            with errors_of(subject.input.name, errors, arguments):
                effects = " ".join(subject.picture.effects).lower()
                model = CostModel(subject.device, hdr="hdr" in effects, depth="depth" in effects)
                shadings: Sequence[Shading] = [Shading("")]
                if clock is None:
                    found[subject.input.name] = SubjectCosts(
                        shadings, costs(techniques, shadings, size, model, checkpoint)
                    )
                    continue
                plans = _frame_plans(
                    subject,
                    request,
                    size,
                    clock,
                    built_in="shading" in arguments or "shader" in arguments,
                )
                if plans is not None and plans.as_described:
                    shadings = [Shading(AS_DESCRIBED)]
                else:
                    shadings = _shadings(
                        subject, request, calibration, stages, size, bool(arguments.get("record"))
                    )
                notes = []
                if plans is not None:
                    model = CostModel(subject.device, described=subject.frame)
                    notes += plans.notes
                with _source(subject, request, clock, model, stages, plans) as source:
                    timed = costs(techniques, shadings, size, source, checkpoint)
                if plans is not None:
                    notes.append(_priced(subject.frame, timed))
                notes += _fewer_rounds(timed, arguments)
                found[subject.input.name] = SubjectCosts(shadings, timed, tuple(notes))
        if clock is None:
            return AllCosts(found)
        return AllCosts(found, clock.name, clock.software, clock.unstable)


def _shadings(
    subject: Subject,
    request: TimingRequest,
    calibration: Any,
    stages: tuple[Any, ...],
    size: tuple[int, int],
    record: bool,
) -> list[Shading]:
    """The costs of shading of a subject, the cheapest first: those asked for, its own, and that of
    one's own shader. Its record needs its own, else the default one.
    """
    stated = stated_shading(subject.frame) if subject.frame is not None else None
    own = stated or (DEFAULT_SHADING if record and subject.frame is not None else None)
    names = list(dict.fromkeys([*request.shadings, *([own] if own else [])]))
    shadings: list[Shading] = calibration.shadings(names, size)
    shadings.sort(key=lambda shading: shading.full_screen_ms or 0.0)
    if stages:
        shadings.append(calibration.measured(os.path.basename(request.shader), stages, size))
    return shadings


def _priced(frame: Any, timed: Costs) -> str:
    """A note on what the cost model estimates for a frame."""
    from msaa_lint.experiments.study.frame_plans import described_size

    if all(cost.bytes_per_frame is None for cost in timed.values()):
        return (
            "bytes, power, and memory are not estimated, as the frame leaves out what they "
            "depend on: see msaa-lint cost"
        )
    size = described_size(frame)
    stated = f", {size[0]}x{size[1]}" if size is not None else ""
    return (
        f"bytes, power, and memory are those of the frame at its described size{stated}, with a "
        "technique's sample count"
    )


def _fewer_rounds(timed: Costs, arguments: Arguments) -> list[str]:
    """A note if there are fewer rounds than usual."""
    rounds = max((len(cost.rounds) for cost in timed.values()), default=0)
    if "repeats" in arguments or not 0 < rounds < REPEATS:
        return []
    intervals = (
        "; so few give no interval of 95 %, but that of all" if rounds < LEAST_FOR_INTERVAL else ""
    )
    return [
        f"times are medians of {rounds} rounds instead of {REPEATS}, as a round takes "
        f"long{intervals} (--repeats N takes N)"
    ]


def _frame_plans(
    subject: Subject, request: TimingRequest, size: tuple[int, int], clock: Any, built_in: bool
) -> Any:
    """The plans of a subject's own frame, with `built_in` drawn by built-in shaders; None for a
    scene without one, and for a description without passes.
    """
    if subject.frame is None:
        return None
    from msaa_lint.experiments.study.frame_plans import FramePlans, stated_sizes

    stated = stated_sizes(subject.frame)
    sizes = stated._replace(
        overdraw=request.overdraw if request.overdraw > 1 else stated.overdraw,
        side=request.triangle_size or stated.side,
    )
    plans = FramePlans(subject.frame, subject.file, size, sizes, clock.device, built_in)
    return plans if plans.base.passes else None


def _source(
    subject: Subject,
    request: TimingRequest,
    clock: Any,
    model: CostModel,
    stages: tuple[Any, ...],
    plans: Any,
) -> Any:
    from msaa_lint.experiments.study.scene_timing import Geometry, SceneClock

    # A frame has its own overdraw, and triangles of its own size.
    geometry = Geometry(request.overdraw, request.triangle_size) if plans is None else Geometry()
    return SceneClock(
        clock, subject.picture, model, geometry, plans, stages, os.path.basename(request.shader)
    )


def _own_stages(request: TimingRequest, clock: Any) -> tuple[Any, ...]:
    """The stages of one's own shader. UsageError if it cannot be used on the device."""
    if not request.shader:
        return ()
    from msaa_lint.experiments.confirm.own_shader import UnusableOwnShader, own_shader
    from msaa_lint.experiments.confirm.shader_support import unsupported

    try:
        stages: tuple[Any, ...] = own_shader(request.shader)
    except UnusableOwnShader as error:
        raise UsageError(f"--shader: {error}") from None
    reason = unsupported(stages, clock.device)
    if reason:
        raise UsageError(f"--shader {quoted(request.shader)} {reason}")
    return stages


def _clock(arguments: Arguments) -> contextlib.AbstractContextManager[Any]:
    """The clock of the device that `--device` names; None without one."""
    if "device" not in arguments:
        return contextlib.nullcontext()
    from msaa_lint.core.child_environment import ignored_paths
    from msaa_lint.experiments.study.times import DeviceClock

    for text in ignored_paths():
        warn(text)
    return DeviceClock(arguments["device"], repeats=arguments.get("repeats", 0))
