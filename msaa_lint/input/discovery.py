"""Finds the inputs: the named files, and the inputs in the named folders."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import excluding
from msaa_lint.core.project import shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.urls import forget_listed, is_url, name_of

from .file_types import DESCRIPTIONS, STDIN, missing_extra
from .folder_search import FolderSearch, KnownKind, Scope, count, excluded_note

InputsAmong = Callable[[Mapping[str, str | None], Mapping[str, str]], Iterable[str]]
"""Of the inputs and the other source files of folders, with their projects: those of the latter
that are inputs, too.
"""


class Discovered(NamedTuple):
    """The input files, each once and sorted, as findings name them; findings about paths; notes for
    the user.

    `projects` has the projects in which the files of folders must be; a file that is named may be
    anywhere. `related` has the other source code in the folders, which may define what that of
    `files` uses, with its project.
    """

    files: list[str]
    findings: list[Finding]
    notes: list[str]
    projects: Mapping[str, str] = {}
    related: Mapping[str, str] = {}


def discover(
    paths: Iterable[str],
    settings_for: Callable[[str], Scope],
    sources: bool = False,
    log: Callable[[str], None] | None = None,
    inputs_among: InputsAmong | None = None,
    speaks: Callable[[str], bool] | None = None,
    known_kind: KnownKind | None = None,
) -> Discovered:
    """The files to lint.

    A named file is linted whatever its name, unless `exclude` matches it; that is only a note,
    since commit hooks name every file. A folder contributes the files that `include` matches, or by
    default those called `*.msaa.yaml` (yml, json) and data files with content that only a frame
    has; a note counts those that nearly have it. `sources` adds source code that mentions
    multisampling, or a note if the extra that reads it is missing. Hidden folders and those of
    tools and environments, what .gitignore ignores, and what msaa-lint itself wrote are skipped.
    Links to folders are not followed; links to files are if they stay in the project. A missing
    path and a folder without inputs are findings (MSAA921).

    `speaks` says whether a source file mentions multisampling, and `known_kind` what a data file
    is. `inputs_among` says which of the other source files of folders are inputs because of the
    programs that they belong to. `settings_for` gives the settings of a file or folder. `-` stays
    as it is. `log` is called with a line for each path that is skipped.

    A path may be a URL. In a folder there, globs are relative to it, and nothing is read from
    ignore files.
    """
    forget_listed()
    walk = FolderSearch(settings_for, sources, log, speaks, known_kind)
    for stated in paths:
        path = name_of(stated)
        if path == STDIN:
            walk.files[STDIN] = None
        elif is_url(path):
            from .url_search import add_url

            add_url(walk, stated)
        elif os.path.isdir(path):
            walk.add_folder(path)
        elif os.path.exists(path):
            glob = excluding(path, settings_for(path).exclude)
            if glob is None:
                walk.files[shown(path)] = None
            else:
                walk.notes.append(excluded_note(path, glob))
        else:
            reason = ": it is a broken link" if os.path.lexists(path) else ""
            walk.findings.append(
                diagnostic("MSAA921", f"no such file or folder {quoted(path)}{reason}", shown(path))
            )
    if walk.related and inputs_among is not None:
        for name in inputs_among(
            walk.files, {name: search.project for name, search in walk.related.items()}
        ):
            if name in walk.related:
                search = walk.related.pop(name)
                walk.files[name] = search.project
                search.inputs += 1
    for search in walk.searches:
        walk.check_inputs(search)
    if walk.unreadable_sources:
        walk.notes.append(
            f"{count(walk.unreadable_sources, 'source file')} skipped: {missing_extra()}"
        )
    near = sorted(walk.near.keys() - walk.files.keys(), key=_by_folder)
    for name in near:
        walk.skip(name, "it looks a little like a description")
    if near:
        walk.notes.append(_nearly(near))
    binary = sorted(walk.binary.keys() - walk.files.keys(), key=_by_folder)
    for name in binary:
        walk.skip(name, "a binary capture that is not named")
    if binary:
        walk.notes.append(_unconverted(binary))
    projects = {file: project for file, project in walk.files.items() if project is not None}
    related = {
        name: walk.related[name].project
        for name in sorted(walk.related.keys() - walk.files.keys(), key=_by_folder)
    }
    return Discovered(
        sorted(walk.files, key=_by_folder),
        walk.findings,
        list(dict.fromkeys(walk.notes)),
        projects,
        related,
    )


def _by_folder(name: str) -> tuple[list[str], str]:
    return name.split("/"), name


def _nearly(names: Sequence[str]) -> str:
    if len(names) == 1:
        return (
            f"{names[0]} looks a little like a description and was skipped: to lint it, name it "
            f"or rename it to *{DESCRIPTIONS[0]}"
        )
    return (
        f"{len(names)} files look a little like descriptions and were skipped, the first one "
        f"{names[0]}: "
        f"to lint them, name them or rename them to *{DESCRIPTIONS[0]}"
    )


def _unconverted(names: Sequence[str]) -> str:
    if len(names) == 1:
        return f"{names[0]} is a binary capture and was skipped: name it to convert and lint it"
    return (
        f"{len(names)} binary captures were skipped, the first one {names[0]}: name them to "
        "convert and lint them"
    )
