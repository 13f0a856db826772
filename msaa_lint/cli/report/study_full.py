"""The text report of `msaa-lint study`: each scene's tables, effects, and advice under each cost of
shading; the origin of the figures.
"""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console

from msaa_lint.experiments.study.outcome import SceneSummary, Study

from . import Options, Write
from .console import open_console
from .escape import display
from .study_tables import has_times, print_errors, print_times
from .study_text import (
    answer,
    answered,
    choices,
    compared,
    failures,
    notes,
    software_warning,
    summary,
)


def render(study: Study, out: Write, options: Options) -> None:
    """Prints each scene, then the origin of the figures."""
    console = open_console(out, options)
    if study.software:
        console.print(software_warning(study), style="yellow", soft_wrap=True)
        console.print()
    for number, scene in enumerate(study.scenes):
        if number:
            console.print()
        _scene(scene, study, console, out, options)
    if study.scenes:
        console.print()
    for line in () if options.quiet else summary(study):
        console.print(line, soft_wrap=True)


def _scene(
    scene: SceneSummary, study: Study, console: Console, out: Write, options: Options
) -> None:
    points = study.of(scene.name)
    console.print(display(scene.name), style="bold", soft_wrap=True)
    if scene.description:
        console.print(display(scene.description), soft_wrap=True)
    if points:
        console.print(compared(scene, study), soft_wrap=True)
    for line in choices(scene, study):
        console.print(line, style="bold", soft_wrap=True)
    if points:
        console.print()
        for line in _tables(scene, study, out, options):
            console.print(line, soft_wrap=True)
    for line in failures(scene, study):
        console.print(line, style="red", soft_wrap=True)
    for name in answered(scene, study):
        for line in answer(scene, name, study):
            console.print(line, soft_wrap=True)
    console.print()
    for line in notes(scene, study):
        console.print(line, soft_wrap=True)


def _tables(scene: SceneSummary, study: Study, out: Write, options: Options) -> Iterator[str]:
    """Prints the tables, and yields what is said below them."""
    hidden = print_errors(study, scene, out, options)
    if hidden:
        yield f"left out at this width, but in --format json: {', '.join(hidden)}"
    if has_times(study.of(scene.name)):
        yield ""
        if not print_times(study, scene, out, options):
            yield "shading takes the rest of each time"
