"""The page of `msaa-lint study`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msaa_lint.experiments.study.outcome import SceneSummary, Study

from .. import Options, Write
from ..study_panels import panels
from ..study_plot import plot
from ..study_tables import MARK, error_table, has_times, time_table
from ..study_text import (
    answer,
    answered,
    choices,
    compared,
    failures,
    notes,
    software_warning,
    summary,
)
from ..tables import FIGURE, Table
from .crops import page_crops
from .page import asset, write_page
from .study_slider import slider
from .vega import PageFigures


def render(study: Study, out: Write, options: Options) -> None:
    """Writes what to take of each scene, then its figures, tables, and reasons, and the origin of
    the figures.
    """
    figures = PageFigures()
    names = [scene.name for scene in study.scenes]
    crops = page_crops(study)
    context = {
        "title": f"Study of {names[0]}" if len(names) == 1 else f"Study of {len(names)} scenes",
        "warning": software_warning(study) if study.software else "",
        "device": study.device,
        "size": study.size,
        "errors": [f"{error.file}: {error.message}" for error in study.wrong],
        "choices": _choices(study),
        "budget": f"{study.budget_ms:.4g} ms",
        "sections": [
            {**_section(scene, study, figures), "crops": crops.get(scene.name)}
            for scene in study.scenes
        ],
        "summary": [] if options.quiet else list(summary(study)),
    }
    write_page(
        "study.html",
        context,
        out,
        data={"figures": figures.data},
        styles=[asset("study.css")],
        scripts=figures.scripts,
    )


def _choices(study: Study) -> Mapping[str, Any] | None:
    """The techniques to take, by scene and cost of shading; None without any."""
    if not study.recommendations:
        return None
    chosen = {(choice.scene, choice.shading): choice for choice in study.recommendations}
    shadings = list(dict.fromkeys(name for _, name in chosen))
    rows = [
        (scene.name, [_choice(chosen.get((scene.name, name))) for name in shadings])
        for scene in study.scenes
    ]
    return {"shadings": [_shading_label(study, name) for name in shadings], "rows": rows}


def _choice(choice: Any) -> tuple[str, str]:
    """A technique, and what it adds."""
    if choice is None:
        return "-", ""
    return (
        choice.technique.name,
        f"{choice.added.ms:+.3g} ms" if choice.added.ms else "adds nothing",
    )


def _shading_label(study: Study, name: str) -> tuple[str, str]:
    shading = next((each for each in study.shadings if each.name == name), None)
    return (
        name or "times",
        f"{shading.full_screen_ms:.3g} ms a full screen"
        if shading and shading.full_screen_ms
        else "",
    )


def _section(scene: SceneSummary, study: Study, figures: PageFigures) -> dict[str, Any]:
    points = study.of(scene.name)
    alone = study._replace(scenes=[scene], points=points)
    has_places = bool(panels(alone))
    return {
        "name": scene.name,
        "description": scene.description,
        "compared": compared(scene, study) if points else "",
        "choices": list(choices(scene, study)),
        "slider": slider(study, scene, figures) if has_places else None,
        "figure": figures.add(plot(alone), f"Error against cost: {scene.name}")
        if has_places
        else None,
        "tables": _tables(scene, study) if points else [],
        "failures": failures(scene, study),
        "answers": [
            [line.strip() for line in answer(scene, name, study) if line]
            for name in answered(scene, study)
        ],
        "notes": list(notes(scene, study)),
    }


def _tables(scene: SceneSummary, study: Study) -> list[dict[str, Any]]:
    tables = [_table("Errors and work", error_table(study, scene))]
    return (
        [*tables, _table("Times", time_table(study, scene))]
        if has_times(study.of(scene.name))
        else tables
    )


def _table(caption: str, table: Table) -> dict[str, Any]:
    """A table for the template. The names of the techniques come first, and the marks of times stay
    before these.
    """
    place = next(number for number, column in enumerate(table.columns) if column.title == "samples")
    order = [place, *(number for number in range(len(table.columns)) if number != place)]
    heads = [(_heading(table.columns[n].title), table.columns[n].kind == FIGURE) for n in order]
    rows = [(bool(style), [cells[n].plain for n in order]) for style, cells in table.rows]
    return {
        "caption": caption,
        "heads": heads,
        "rows": rows,
        "marks": any(MARK in cell for _, cells in rows for cell in cells),
    }


def _heading(title: str) -> str:
    return title.replace("\n", " ")
