"""What the reports of a study say in sentences: what to take and why, what is assumed, and the
origin of the figures.
"""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.experiments.study.effects import TABLE
from msaa_lint.experiments.study.measures import ERROR
from msaa_lint.experiments.study.outcome import SceneSummary, Study
from msaa_lint.experiments.study.shading import Shading, missed

from .escape import display
from .study_tables import MARK, TIE, row_name
from .summary import plural


def software_warning(study: Study) -> str:
    """What holds for the times of a software driver."""
    return (
        f"{display(study.device)} is a software driver: its times say nothing about a GPU, and "
        "nothing is recommended from them"
    )


def compared(scene: SceneSummary, study: Study) -> str:
    """How many pixels of a scene that has points the error is measured over."""
    edges = (
        f"{max(point.edge_pixels for point in study.of(scene.name)):,} of "
        f"{study.size[0] * study.size[1]:,} pixels"
    )
    return f"{edges} {'are crossed by an edge' if scene.coverage else 'are compared by color'}"


def failures(scene: SceneSummary, study: Study) -> list[str]:
    """The techniques that failed, and why."""
    failed = (failure for failure in study.failed if failure.scene == scene.name)
    return [f"{failure.technique.name} failed: {display(failure.reason)}" for failure in failed]


def answered(scene: SceneSummary, study: Study) -> list[str]:
    """The costs of shading under which there is an answer."""
    return list(dict.fromkeys(step.shading for step in study.steps if step.scene == scene.name))


def choices(scene: SceneSummary, study: Study) -> Iterator[str]:
    """What to take under each cost of shading."""
    choices = [choice for choice in study.recommendations if choice.scene == scene.name]
    if not choices:
        return
    names: dict[str, list[str]] = {}
    for choice in choices:
        names.setdefault(choice.technique.name, []).append(display(choice.shading))
    limit = f" within {study.budget_ms:.4g} ms"
    if len(names) == 1:
        (technique,) = names
        yield f"take {technique}{limit}" + (
            " under every cost of shading" if len(choices) > 1 else ""
        )
    else:
        each = (f"{technique} ({', '.join(costs)})" for technique, costs in names.items())
        yield f"take{limit}, by cost of shading: {'; '.join(each)}"


def notes(scene: SceneSummary, study: Study) -> Iterator[str]:
    """What holds under every cost of shading, the effects, and what is assumed."""
    for advice in study.advice:
        if advice.scene == scene.name:
            yield f"- {display(advice.text)} ({display(advice.reason)})"
    yield from _effects(scene, study)
    for note in scene.assumed:
        yield f"timed: {display(note)}"


def _effects(scene: SceneSummary, study: Study) -> Iterator[str]:
    """The effects that ran, each with its reason and its share of the simulation's time."""
    points = study.of(scene.name, (study.shading_names(scene.name) or [""])[0])
    total = sum(point.simulated_ms for point in points)
    times: dict[str, float] = {}
    for point in points:
        for stage, time in point.stages:
            times[stage] = times.get(stage, 0.0) + time
    for name, reason in scene.effects:
        share = (
            f", {100 * times[name] / total:.0f} % of the simulation's time"
            if total > 0 and name in times
            else ""
        )
        yield f"effect {display(name)}" + (f": {display(reason)}" if reason else "") + share
    ran = {name for name, _ in scene.effects}
    if not ran:
        yield "no effects: the scene needs none"
    elif times:
        yield (
            "off, without taking any time: "
            f"{', '.join(effect.name for effect in TABLE if effect.name not in ran)}"
        )


def answer(scene: SceneSummary, name: str, study: Study) -> Iterator[str]:
    """What to take under one cost of shading and why, the steps up, and the front."""
    choice = next(
        (
            choice
            for choice in study.recommendations
            if (choice.scene, choice.shading) == (scene.name, name)
        ),
        None,
    )
    yield ""
    if name or choice is not None:
        shading = next(
            (shading for shading in study.shadings if shading.name == name), Shading(name)
        )
        of_cost = f"shading {display(name)}{_full_screen(shading)}" if name else ""
        yield (
            f"{of_cost}: {choice.text}"
            if of_cost and choice is not None
            else choice.text
            if choice is not None
            else f"{of_cost}:"
        )
    if choice is not None:
        yield f"  {choice.reason}"
        yield f"  {choice.following}"
    for step in study.steps:
        if (step.scene, step.shading) == (scene.name, name):
            yield f"  {step.text}"
    timed = [
        point for point in study.of(scene.name, name) if point.best and point.time_ms is not None
    ]
    if timed and not study.software:
        by = "" if scene.measure == ERROR else f" of {scene.measure.name} and time"
        ordered = sorted(timed, key=lambda point: (point.time_ms or 0.0, point.technique))
        yield f"  front{by}: {'; '.join(row_name(point.technique) for point in ordered)}"


def _full_screen(shading: Shading) -> str:
    return (
        f" ({shading.full_screen_ms:.3g} ms a full screen at 1x)" if shading.full_screen_ms else ""
    )


def summary(study: Study) -> Iterator[str]:
    """The origin of the figures, the meaning of the marks, what was not timed, and what was
    written.
    """
    if study.points:
        times = (
            f"times measured by the clock of {display(study.device)}"
            if study.device
            else "no times: --device NAME measures them"
        )
        yield f"{study.size[0]}x{study.size[1]}, vertices snapped to {study.bits} bits; {times}"
        if study.device and not study.software:
            yield f"{MARK} Pareto-optimal: no other technique has less error in as little time"
        else:
            yield (
                f"{MARK} Pareto-optimal: no other technique has less error for as few samples, "
                "shader invocations, and bytes"
            )
        if study.device:
            yield from _timing(study)
        for scene in study.scenes:
            if scene.measure != ERROR:
                yield (
                    f"{display(scene.name)} is about {', '.join(scene.about)}: its techniques "
                    f"are compared by {scene.measure.name}"
                )
        model = f" for {display(study.model)}" if study.model else ""
        # Only frames that are timed have assumptions.
        own = (
            "; those of a timed frame are of its own passes"
            if any(scene.assumed for scene in study.scenes)
            else ""
        )
        yield f"bytes, power, and memory: the cost model{model}, with samples kept on the tile{own}"
    names: dict[str, list[str]] = {}
    for untimed in study.untimed:
        names.setdefault(untimed.reason, []).append(untimed.name)
    for reason, techniques in names.items():
        yield f"not timed: {'; '.join(techniques)}: {display(reason)}"
    for path in (*study.pictures, *study.records):
        yield f"written: {display(path)}"
    failed = f", {len(study.failed)} failed" if study.failed else ""
    yield f"{plural(len(study.points), 'point')} of {plural(len(study.scenes), 'scene')}{failed}"


def _timing(study: Study) -> Iterator[str]:
    """The marks of times, the calibrated costs of shading, and the models."""
    yield f"{TIE} the same time, within noise, as the next shorter one"
    if any(point.low_ms is not None for point in study.points):
        yield "± distance from the median to the farther bound of its 95 % interval"
    for shading in study.shadings:
        if shading.operations or shading.fetches:
            off = missed(shading)
            yield (
                f"{display(shading.name)}: {_work(shading)} per "
                f"invocation{_full_screen(shading)}{'; ' if off else ''}{off}"
            )
        elif shading.full_screen_ms:
            yield f"{display(shading.name)}: {shading.full_screen_ms:.3g} ms a full screen at 1x"
    for model in study.models:
        residual, rms, noise = 100 * model.residual, 100 * model.rms, 100 * model.noise
        yield (
            f"model of the times of {display(model.scene)}: off by {rms:.1f} % (at most "
            f"{residual:.1f} %); noise is up to {noise:.1f} %"
        )


def _work(shading: Shading) -> str:
    operations = [plural(shading.operations, "operation")] if shading.operations else []
    fetches = (
        [f"{plural(shading.fetches, 'texture fetch')} from {shading.footprint / (1 << 20):.3g} MiB"]
        if shading.fetches
        else []
    )
    return " and ".join([*operations, *fetches])
