"""`msaa-lint study`."""

from __future__ import annotations

import contextlib
import gc
import os
import re
import sys
from collections.abc import Iterator, Sequence
from functools import partial
from importlib.util import find_spec
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.execution.processes import cores
from msaa_lint.core.extras import needs_extra
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.experiments.confirm.vulkan_errors import NotWritten
from msaa_lint.experiments.confirm.vulkan_errors import Unusable as NoDevice
from msaa_lint.experiments.study.checkpoint import Checkpoint
from msaa_lint.experiments.study.outcome import SceneSummary, Study, UntimedTechnique
from msaa_lint.experiments.study.points import COUNTS, KINDS, MSAA, Point, Technique, techniques
from msaa_lint.experiments.study.recommendation import DEFAULT_BUDGET_MS
from msaa_lint.experiments.study.tasks import FailedPoint, Task, Unusable

from .common import (
    MAX_RENDER_SIDE,
    Target,
    UsageError,
    figure_format,
    note,
    parse_list,
    parse_outputs,
    parse_size,
    refuse_inputs,
    report_module,
    report_options,
    require_figures,
    run_command,
    warn,
    write_figure,
    write_output,
    writes,
)  # fmt: skip
from .options import PAGE_FORMATS, Arguments
from .report.escape import escape
from .study_costs import AllCosts, subject_costs, timing_request
from .study_subjects import Subject, subjects

MAX_BUDGET_MS = 1000.0

if TYPE_CHECKING:
    from msaa_lint.experiments.study.record import DocumentStudy
    from msaa_lint.experiments.study.time_model import TimeModel
    from msaa_lint.frame.facts.frame import Frame


class StudyOptions(NamedTuple):
    """The options, parsed. `size` is None if the inputs decide."""

    targets: list[Target]
    techniques: list[Technique]
    size: tuple[int, int] | None
    bits: int
    ssim: bool
    flip: bool
    jobs: int | None
    backend: str | None
    cluster: str | None
    budget_ms: float


def study(arguments: Arguments) -> int:
    """Measures what the arguments name and prints it; returns the exit code."""
    # Pictures are large, and `__main__` turned the collector off.
    gc.enable()
    return run_command(_interruptible, arguments, (NotWritten, Unusable, NoDevice), terminable=True)


def _interruptible(arguments: Arguments) -> int:
    try:
        if arguments.get("list_scenes"):
            return _list_scenes()
        if not arguments["paths"]:
            raise UsageError(
                "no input: give scenes by name (--list-scenes), meshes, or descriptions"
            )
        return _study(arguments, parse_options(arguments))
    except KeyboardInterrupt:
        folder = arguments.get("resume")
        saved = (
            f"finished points are in {folder}; run the same command to continue"
            if folder
            else "--resume FOLDER saves finished points"
        )
        warn(f"interrupted; {saved}")
        raise


def parse_options(arguments: Arguments) -> StudyOptions:
    """The options of the command line. UsageError if one cannot be used."""
    counts = (
        parse_list(arguments["samples"], "--samples", {str(n): n for n in COUNTS})
        if "samples" in arguments
        else COUNTS
    )
    kinds = (
        parse_list(arguments["techniques"], "--techniques", {kind: kind for kind in KINDS})
        if "techniques" in arguments
        else KINDS
    )
    chosen = techniques(tuple(dict.fromkeys(kinds)), tuple(sorted(set(counts))))
    if not chosen:
        raise UsageError(
            "--samples and --techniques leave nothing to measure: sample shading needs a count "
            "above 1"
        )
    if "plot" in arguments:
        require_figures("--plot", figure_format(arguments["plot"], "--plot"))
    targets = parse_outputs(arguments.get("output", ()), PAGE_FORMATS, "json=study.json") or [
        Target("full", None)
    ]
    drawn = ["--output html"] if any(target.format == "html" for target in targets) else []
    for option in (*(["--crops"] if "crops" in arguments else []), *drawn):
        require_figures(option)
    if "budget" in arguments and "device" not in arguments:
        raise UsageError(
            "--budget needs times: name the GPU that measures them with `--device NAME`"
        )
    if "budget" in arguments and Technique(MSAA, 1) not in chosen:
        raise UsageError(
            "--budget is added to the time of one sample: add 1 to --samples, and msaa to "
            "--techniques"
        )
    if arguments.get("ssim") and find_spec("skimage") is None:
        raise UsageError(needs_extra("--ssim", "ssim"))
    if arguments.get("flip") and find_spec("flip_evaluator") is None:
        raise UsageError(needs_extra("--flip", "flip"))
    return StudyOptions(
        targets,
        chosen,
        parse_size(arguments["size"], MAX_RENDER_SIDE) if "size" in arguments else None,
        int(arguments.get("bits", 8)),
        bool(arguments.get("ssim")),
        bool(arguments.get("flip")),
        arguments.get("jobs") or (None if arguments.get("backend") else cores()),
        arguments.get("backend"),
        arguments.get("cluster"),
        parse_budget(arguments["budget"]) if "budget" in arguments else DEFAULT_BUDGET_MS,
    )


def parse_budget(text: str) -> float:
    """The milliseconds of `0.5ms`, `500us`, or `0.5`. UsageError for anything else, and for more
    than a second.
    """
    match = re.fullmatch(r"([0-9]{1,9}(?:\.[0-9]{1,9})?|\.[0-9]{1,9}) ?(ms|us|µs)?", text)
    budget = float(match[1]) * (1e-3 if match[2] in ("us", "µs") else 1.0) if match else 0.0
    if not 0 < budget <= MAX_BUDGET_MS:
        raise UsageError(
            f"`--budget` must be a time above 0 and up to {MAX_BUDGET_MS:g}ms, as in 0.5ms or "
            f"500us; found {quoted(text)}"
        )
    return budget


def _list_scenes() -> int:
    """Prints the scenes that can be named, and what each is for."""
    from msaa_lint.experiments.study.scenes import DESCRIPTIONS

    for name, summary in DESCRIPTIONS.items():
        print(f"{name:16} {summary}")
    return 0


def _study(arguments: Arguments, options: StudyOptions) -> int:
    from msaa_lint.experiments.study.answer import conclude
    from msaa_lint.experiments.study.sweep import ordered, sweep, with_cost

    # Wrong options are errors before anything is read.
    timing_request(arguments)
    refuse_inputs(
        [*(target.path for target in options.targets), arguments.get("plot")], arguments["paths"]
    )
    checkpoint = Checkpoint(arguments["resume"]) if "resume" in arguments else None
    size, studied, errors, notes = subjects(arguments, options.size)
    for text in notes:
        note(text)
    if (
        arguments.get("record")
        and not any(os.path.isfile(subject.file) for subject in studied)
        and not errors
    ):
        raise UsageError("--record needs a description in a file, to write the record next to it")
    with _progress(len(studied), arguments) as progress:
        costs = subject_costs(
            studied, errors, arguments, options.techniques, size, checkpoint, progress
        )
    if costs.unstable:
        warn(
            f"the times of {costs.device} had not settled after 3 s: something else may be using "
            "the device"
        )
    studied = [subject for subject in studied if subject.input.name in costs.subjects]
    untimed = _warn_of_failures(costs, errors)
    tasks = [
        Task(
            subject.input,
            technique,
            *size,
            options.bits,
            options.ssim,
            options.flip,
            subject.picture.shade is not None,
        )
        for subject in studied
        for technique in options.techniques
    ]
    with _progress(len(tasks), arguments) as progress:
        results = list(
            sweep(
                tasks,
                jobs=options.jobs,
                backend=options.backend,
                cluster=options.cluster,
                checkpoint=checkpoint,
                progress=progress,
            )
        )
    points: list[Point] = []
    failures: list[FailedPoint] = []
    names = [subject.input.name for subject in studied]
    for result in ordered(results, names, options.techniques):
        if isinstance(result, FailedPoint):
            failures.append(result)
            warn(f"{result.scene}: {result.technique.name}: {result.reason}")
        else:
            subject_shadings, subject_times, _ = costs.subjects[result.scene]
            points += [
                with_cost(result, subject_times, shading, costs.device)
                for shading in subject_shadings
            ]
    order = [(name, shading.name) for name in names for shading in costs.subjects[name].shadings]
    points.sort(key=lambda point: order.index((point.scene, point.shading)))
    outcome = _outcome(size, options.bits, studied, points, failures, costs, errors)
    outcome = conclude(outcome._replace(budget_ms=options.budget_ms))
    if "crops" in arguments:
        outcome = _with_crops(
            outcome, arguments["crops"], bool(arguments.get("force")), options, studied
        )
    if "plot" in arguments:
        from .report import study_plot

        write_figure(arguments["plot"], "--plot", partial(study_plot.plot, outcome))
    if arguments.get("record"):
        outcome = outcome._replace(
            records=_write_records(studied, outcome, bool(arguments.get("force")))
        )
    for target in options.targets:
        write_output(target.path, partial(_render, target.format, outcome, arguments))
    return 2 if errors or failures or untimed else 0


def _warn_of_failures(costs: AllCosts, errors: Sequence[Finding]) -> bool:
    """Prints the errors, and the techniques that a device failed to time; returns whether there are
    such techniques.
    """
    for error in errors:
        warn(f"{error.file}: {error.message}")
    failed = {
        f"{scene}: {technique.name}: {cost.reason}"
        for scene, found in costs.subjects.items()
        for (technique, _), cost in found.costs.items()
        if cost.failed
    }
    for text in sorted(failed):
        warn(text)
    return bool(failed)


def _outcome(
    size: tuple[int, int],
    bits: int,
    studied: Sequence[Subject],
    points: Sequence[Point],
    failures: Sequence[FailedPoint],
    costs: AllCosts,
    errors: Sequence[Finding],
) -> Study:
    """What there is to report."""
    many = len(costs.subjects) > 1
    untimed = {
        (technique.name, f"{name}: {cost.reason}" if many else cost.reason): None
        for name, subject in costs.subjects.items()
        for (technique, _), cost in subject.costs.items()
        if cost.reason
    }
    models = {subject.device.name if subject.device is not None else "" for subject in studied}
    return Study(
        costs.device,
        models.pop() if len(models) == 1 else "",
        size,
        bits,
        [
            _scene(
                subject,
                [point for point in points if point.scene == subject.input.name],
                costs.subjects[subject.input.name].assumed,
            )
            for subject in studied
        ],
        points,
        failures,
        [UntimedTechnique(name, reason) for name, reason in untimed],
        wrong=errors,
        software=costs.software,
        shadings=costs.shadings,
        models=_models(costs),
    )


def _models(costs: AllCosts) -> list[TimeModel]:
    """The models of the measured times; none of a software driver, whose times no model of a GPU
    fits.
    """
    from msaa_lint.experiments.study.time_model import model_of

    if not costs.device or costs.software:
        return []
    models = (
        model_of(name, subject.costs, subject.shadings) for name, subject in costs.subjects.items()
    )
    return [model for model in models if model is not None]


def _scene(subject: Subject, points: Sequence[Point], assumed: tuple[str, ...]) -> SceneSummary:
    """The scene with the effects that it needs, and those that one of its techniques needs."""
    from msaa_lint.experiments.study.scenes.about import about

    picture = subject.picture
    effects = {name: picture.why.get(name, "") for name in picture.effects}
    for point in points:
        for name in point.effects:
            effects.setdefault(name, "a technique needs it")
    return SceneSummary(
        subject.input.name,
        picture.description,
        tuple(effects.items()),
        picture.coverage_matter,
        about(picture),
        assumed=assumed,
    )


@contextlib.contextmanager
def _progress(total: int, arguments: Arguments) -> Iterator[Any]:
    """A callback that advances a progress bar on a terminal; None elsewhere, and with `--quiet`."""
    if arguments.get("quiet") or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}", markup=False),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bars:
        bar = bars.add_task("", total=total)
        yield lambda done, _, last: bars.update(bar, completed=done, description=escape(last))


def _with_crops(
    outcome: Study, folder: str, force: bool, options: StudyOptions, studied: Sequence[Subject]
) -> Study:
    """The study with the crops of its scenes, after writing their figures."""
    from msaa_lint.experiments.confirm.png import PictureFolder, signed
    from msaa_lint.experiments.study.crops import crops

    from .report.figure import draw
    from .report.study_crops import crops_figure

    album = PictureFolder(folder, force)
    found = {
        subject.input.name: crops(subject.picture, options.techniques, options.bits)
        for subject in studied
    }
    paths = [
        album.write_file(signed(draw(crops_figure(name, of_scene), "png")), name, "crops")
        for name, of_scene in found.items()
    ]
    return outcome._replace(pictures=paths, crops=found)


def _write_records(studied: Sequence[Subject], outcome: Study, force: bool) -> list[str]:
    """Writes one record per file of descriptions, except for files with a failed point; returns the
    paths.
    """
    from msaa_lint.experiments.study.record import write
    from msaa_lint.linter.study_record import path_of

    files: dict[str, list[Subject]] = {}
    for subject in studied:
        if subject.frame is not None and os.path.isfile(subject.file):
            files.setdefault(subject.file, []).append(subject)
    paths = []
    for file, documents in files.items():
        names = {subject.input.name for subject in documents}
        if any(failure.scene in names for failure in outcome.failed):
            continue
        studies = [
            _document_study(subject.input.name, subject.frame, outcome)
            for subject in documents
            if subject.frame is not None
        ]
        if not any(point.technique.kind == MSAA for study in studies for point in study.points):
            raise UsageError("--record: no sample count was measured; add msaa to --techniques")
        with writes(path_of(file)):
            paths.append(write(file, studies, force))
    return paths


def _document_study(name: str, frame: Frame, outcome: Study) -> DocumentStudy:
    """What the record keeps of a description's study: the points with its own fragment shaders,
    else those under its own cost of shading, else under the default one.
    """
    from msaa_lint.experiments.study.record import DocumentStudy
    from msaa_lint.experiments.study.shading import Shading
    from msaa_lint.linter.study_record import AS_DESCRIBED, DEFAULT_SHADING, stated_shading

    names = outcome.shading_names(name)
    deciding = AS_DESCRIBED if AS_DESCRIBED in names else stated_shading(frame) or DEFAULT_SHADING
    if names != [""] and deciding not in names:
        raise UsageError(
            f"--record: {name} is judged under {deciding} shading, which was not timed; add "
            f"{deciding} to --shading"
        )
    shading = next((each for each in outcome.shadings if each.name == deciding), Shading(deciding))
    measure = next(scene.measure for scene in outcome.scenes if scene.name == name)
    points = outcome.of(name, deciding if deciding in names else None)
    return DocumentStudy(
        frame, outcome.device, outcome.size, points, shading, measure, outcome.software
    )


def _render(format: str, outcome: Study, arguments: Arguments, out: IO[str]) -> None:
    report_module("study", format).render(outcome, out.write, report_options(arguments, out))
