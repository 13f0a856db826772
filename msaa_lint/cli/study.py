"""`msaa-lint study`."""

from __future__ import annotations

import contextlib
import gc
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.package import VERSION
from msaa_lint.experiments.confirm.results import NotWritten
from msaa_lint.experiments.confirm.results import Unusable as NoDevice
from msaa_lint.experiments.study.outcome import SceneSummary, Study, UntimedTechnique
from msaa_lint.experiments.study.points import COUNTS, KINDS, MSAA, Point, Technique, techniques
from msaa_lint.experiments.study.tasks import FailedPoint, Task, Unusable

from .common import MOST_PIXELS, Mistake, Target, colored, ended, outputs, size, written
from .report.escape import visible
from .study_subjects import Subject, subjects

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding
    from msaa_lint.experiments.study.checkpoint import Checkpoint
    from msaa_lint.experiments.study.times import Cost, CostModel, CostSource

FORMATS = ("full", "json")
PLOTS = (".svg", ".png")


class Wanted(NamedTuple):
    """The options, read. `size` is None where inputs decide."""

    targets: list[Target]
    techniques: list[Technique]
    size: tuple[int, int] | None
    bits: int
    ssim: bool
    jobs: int
    backend: str | None


def study(given: Mapping[str, Any]) -> int:
    """Measures what the arguments name and prints it; the exit code."""
    # Pictures are large, and the command line turned the collector off.
    gc.enable()
    return ended(_interruptible, given, (NotWritten, Unusable, NoDevice), terminable=True)


def _interruptible(given: Mapping[str, Any]) -> int:
    try:
        if given.get("list_scenes"):
            return list_scenes()
        if not given["paths"]:
            raise Mistake("SCENE|PATH... is due: scenes by name (--list-scenes), meshes, descriptions")
        return _study(given, wanted(given))
    except KeyboardInterrupt:
        print(f"msaa-lint: interrupted; {_going_on(given.get('resume'))}", file=sys.stderr)
        raise


def _going_on(folder: str | None) -> str:
    if folder is None:
        return "--resume FOLDER keeps what is done"
    return f"what was done is kept in {visible(folder)}, and the same command goes on from there"


def wanted(given: Mapping[str, Any]) -> Wanted:
    """The options of the command line. Mistake where one says nothing."""
    counts = _words(given["samples"], "--samples", {str(count): count for count in COUNTS}) if "samples" in given else list(COUNTS)
    kinds = _words(given["techniques"], "--techniques", {kind: kind for kind in KINDS}) if "techniques" in given else list(KINDS)
    chosen = techniques(tuple(kinds), tuple(sorted(counts)))
    if not chosen:
        raise Mistake("--samples and --techniques leave nothing to measure: sample shading needs a count above 1")
    if "plot" in given and os.path.splitext(given["plot"])[1].lower() not in PLOTS:
        raise Mistake(f"--plot {given['plot'][:80]!r}: the name of an .svg or .png file is due")
    if given.get("ssim"):
        _needs_scikit_image()
    return Wanted(
        outputs(given.get("output", ()), FORMATS, "json=study.json") or [Target("full", None)],
        chosen,
        size(given["size"], MOST_PIXELS) if "size" in given else None,
        int(given.get("bits", 8)),
        bool(given.get("ssim")),
        given.get("jobs") or (-1 if given.get("backend") in ("dask", "ray") else _cores()),
        given.get("backend"),
    )


def _needs_scikit_image() -> None:
    """Mistake where it is not installed, before anything is measured."""
    from importlib.util import find_spec

    if find_spec("skimage") is None:
        raise Mistake("--ssim needs scikit-image, which is not installed: pip install 'msaa-lint[ssim]'")


def _words(text: str, option: str, known: Mapping[str, Any]) -> list[Any]:
    """What a list with commas names, each once."""
    words = [word.strip() for word in text.split(",")]
    wrong = [word for word in words if word not in known]
    if wrong:
        raise Mistake(f"{option} {text[:40]!r}: one or more of {', '.join(known)} are due, with commas between")
    return list(dict.fromkeys(known[word] for word in words))


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def list_scenes() -> int:
    """Prints the scenes that can be named, and what each is for."""
    from msaa_lint.experiments.study.scenes import DESCRIPTIONS

    for name, says in DESCRIPTIONS.items():
        print(f"{name:16} {says}")
    return 0


def _study(given: Mapping[str, Any], asked: Wanted) -> int:
    from msaa_lint.experiments.study.checkpoint import Checkpoint
    from msaa_lint.experiments.study.sweep import ordered, sweep, with_cost

    kept = Checkpoint(given["resume"]) if "resume" in given else None
    pixels, studied, wrong, notes = subjects(given, asked.size)
    for note in notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    for each in wrong:
        print(f"msaa-lint: {visible(each.file)}: {visible(each.message)}", file=sys.stderr)
    if given.get("record") and not any(subject.file for subject in studied) and not wrong:
        raise Mistake("--record: the file of a description is due, for the record to lie beside")
    priced, device = _priced(studied, given, asked, pixels, kept)
    tasks = [Task(subject.input, technique, *pixels, asked.bits, asked.ssim) for subject in studied for technique in asked.techniques]
    with _bar(len(tasks)) as progress:
        results = list(sweep(tasks, jobs=asked.jobs, backend=asked.backend, checkpoint=kept, progress=progress))
    names = [subject.input.name for subject in studied]
    points: list[Point] = []
    failed: list[FailedPoint] = []
    for result in ordered(results, names, asked.techniques):
        if isinstance(result, FailedPoint):
            failed.append(result)
            print(f"msaa-lint: {visible(result.scene)}: {result.technique.name}: {visible(result.reason)}", file=sys.stderr)
        else:
            points.append(with_cost(result, priced[result.scene], device))
    found = _found(given, asked, pixels, studied, points, failed, priced, device, wrong)
    for target in asked.targets:
        written(target.path, partial(_render, target.format, found, given))
    return 2 if wrong or failed else 0


def _found(
    given: Mapping[str, Any],
    asked: Wanted,
    pixels: tuple[int, int],
    studied: Sequence[Subject],
    points: Sequence[Point],
    failed: Sequence[FailedPoint],
    priced: Mapping[str, Mapping[Technique, Cost]],
    device: str,
    wrong: Sequence[Finding],
) -> Study:
    """All that there is to print; pictures and records are written."""
    from msaa_lint.experiments.study.advice import advice
    from msaa_lint.experiments.study.pareto import mark_best

    best = mark_best(points)
    reasons = {technique.name: cost.reason for own in priced.values() for technique, cost in own.items() if cost.reason}
    models = {subject.device.name if subject.device is not None else "" for subject in studied}
    made = Study(
        device,
        models.pop() if len(models) == 1 else "",
        pixels,
        asked.bits,
        [_pictured(subject, [point for point in best if point.scene == subject.input.name]) for subject in studied],
        best,
        failed,
        [UntimedTechnique(name, reason) for name, reason in reasons.items()],
        advice(best),
        wrong,
    )
    pictures = _crops(given, asked, studied) if "crops" in given else []
    if "plot" in given:
        _plot(given["plot"], made)
    records = _records(studied, made) if given.get("record") else []
    return made._replace(pictures=pictures, records=records)


def _pictured(subject: Subject, points: Sequence[Point]) -> SceneSummary:
    """The scene with the effects that it calls for, and those that a technique of it called for."""
    picture = subject.picture
    effects = {name: picture.why.get(name, "") for name in picture.effects}
    for point in points:
        for name in point.effects:
            effects.setdefault(name, "techniques ask for it")
    return SceneSummary(subject.input.name, picture.description, tuple(effects.items()), picture.coverage_matter)


def _priced(
    studied: Sequence[Subject], given: Mapping[str, Any], asked: Wanted, pixels: tuple[int, int], kept: Checkpoint | None
) -> tuple[dict[str, dict[Technique, Cost]], str]:
    """By scene what each technique takes, and the device whose clock it is by."""
    from msaa_lint.experiments.study.sweep import costs
    from msaa_lint.experiments.study.times import CostModel

    found: dict[str, dict[Technique, Cost]] = {}
    with _clock(given) as clock, _bar(len(studied)) as progress:
        for number, subject in enumerate(studied):
            effects = " ".join(subject.picture.effects).lower()
            model = CostModel(subject.device, hdr="hdr" in effects, depth="depth" in effects)
            if progress is not None and clock is not None:
                progress(number, len(studied), f"{subject.input.name} on {clock.name}")
            with _source(clock, subject, model) as source:
                found[subject.input.name] = costs(asked.techniques, pixels, source, kept)
        return found, clock.name if clock is not None else ""


def _source(clock: Any, subject: Subject, model: CostModel) -> contextlib.AbstractContextManager[CostSource]:
    """Where the costs of a scene are from."""
    if clock is None:
        return contextlib.nullcontext(model)
    from msaa_lint.experiments.study.scene_timing import SceneClock

    return SceneClock(clock, subject.picture, model)


@contextlib.contextmanager
def _clock(given: Mapping[str, Any]) -> Iterator[Any]:
    """The clock of the device that is named; None where none is."""
    if "device" not in given:
        yield None
        return
    from msaa_lint.experiments.study.times import DeviceClock

    with DeviceClock(given["device"], repeats=given.get("repeats", 15)) as clock:
        yield clock


@contextlib.contextmanager
def _bar(total: int) -> Iterator[Any]:
    """A progress bar on a terminal; None elsewhere."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.description}", markup=False),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as shown:
        bar = shown.add_task("", total=total)
        yield lambda done, _, last: shown.update(bar, completed=done, description=visible(last))


def _crops(given: Mapping[str, Any], asked: Wanted, studied: Sequence[Subject]) -> list[str]:
    from msaa_lint.experiments.confirm.png import Album
    from msaa_lint.experiments.study.crops import crops

    album = Album(given["crops"])
    return [crops(album, subject.input.name, subject.picture, asked.techniques, asked.bits) for subject in studied]


def _plot(path: str, found: Study) -> None:
    from .report import study_plot

    try:
        data = study_plot.plot(found, os.path.splitext(path)[1].lower().removeprefix("."))
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "matplotlib":
            raise
        raise Mistake("--plot needs matplotlib, which is not installed: pip install 'msaa-lint[chart]'") from None
    try:
        with open(path, "wb") as file:
            file.write(data)
    except OSError as error:
        raise Mistake(f"{path} cannot be written: {error.strerror}") from None


def _records(studied: Sequence[Subject], found: Study) -> list[str]:
    """Writes the records of the descriptions, each for all documents of its file; none where a point of it failed."""
    from msaa_lint.experiments.study.record import DocumentStudy, write

    files: dict[str, list[Subject]] = {}
    for subject in studied:
        if subject.frame is not None and os.path.isfile(subject.file):
            files.setdefault(subject.file, []).append(subject)
    written = []
    for file, own in files.items():
        names = {subject.input.name for subject in own}
        if any(each.scene in names for each in found.failed):
            continue
        studies = [DocumentStudy(each.frame, found.device, found.size, found.of(each.input.name)) for each in own if each.frame is not None]
        if not any(point.technique.kind == MSAA for each in studies for point in each.points):
            raise Mistake("--record: no sample count was measured (--techniques leaves msaa out)")
        try:
            written.append(write(file, studies))
        except OSError as error:
            raise Mistake(f"the record of {file} cannot be written: {error.strerror}") from None
    return written


def _render(format: str, found: Study, given: Mapping[str, Any], out: IO[str]) -> None:
    if format == "json":
        from .report.study_json import render as as_json

        as_json(found, out.write, VERSION)
        return
    from .report import Options as Shown
    from .report.study_text import render

    terminal = out.isatty()
    width = 160
    if terminal:
        import shutil

        width = shutil.get_terminal_size().columns
    render(found, out.write, Shown(color=colored(given.get("color", "auto"), terminal), width=width))
