"""Finds the inputs at URLs: what a URL names, and the inputs in a folder there.

Globs count from the named folder, or that of the named file. Files that list what to ignore and
configurations are not read there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import NamedTuple

from msaa_lint.core import urls
from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.globs import Glob, excluding
from msaa_lint.core.quote import quoted

from .file_types import INPUT
from .folder_search import SKIPPED_FOLDERS, Folder, FolderSearch, Search, excluded_note
from .ignore_files import IgnoreFiles

MAX_REQUESTS = 16
"""The number of files that are looked into at once: a storage takes a while to answer."""

MAX_WAITING = 1024
"""The number of files that are asked for before the first answer is used."""


class _Candidate(NamedTuple):
    entry: urls.Entry
    path: str
    include: Sequence[Glob]


def add_url(found: FolderSearch, url: str) -> None:
    """Adds what a URL of the command line names."""
    name, problem = urls.name_of(url), urls.problem(url)
    is_folder = False
    if problem is None:
        try:
            is_folder = urls.is_folder(url)
        except FileNotFoundError:
            problem = f"no such file or folder {quoted(name)}"
        except OSError as error:
            problem = f"cannot read the URL: {error.strerror or error}"
    if problem is not None:
        found.findings.append(diagnostic("MSAA921", problem, name))
        return
    if is_folder:
        urls.allow(name)
        found.search(Search(name), IgnoreFiles(), urls.entries, _UrlFolders(found).add_entries)
        return
    folder = name.rpartition("/")[0]
    glob = excluding(name, _below(found.settings_for(name).exclude, folder))
    if glob is None:
        urls.allow(folder)
        found.files[name] = None
    else:
        found.notes.append(excluded_note(name, glob))


class _UrlFolders:
    def __init__(self, found: FolderSearch) -> None:
        self._found = found

    def add_entries(
        self, folder: Folder, entries: Sequence[urls.Entry], search: Search, waiting: list[Folder]
    ) -> None:
        """Adds the inputs among the entries of a folder, and its folders to `waiting`."""
        found, settings = self._found, self._found.settings_for(folder.path)
        include, exclude = (
            _below(settings.include, search.top),
            _below(settings.exclude, search.top),
        )
        candidates = []
        for entry in entries:
            path = f"{folder.path}/{entry.name}"
            if entry.is_dir():
                if not entry.name or entry.name.startswith(".") or entry.name in SKIPPED_FOLDERS:
                    found.skip(path, "a folder that is hidden or of tools")
                elif excluding(path, exclude, folder=True):
                    found.skip(path, "excluded")
                else:
                    waiting.append(Folder(path, folder.depth + 1, folder.above))
            elif not found.is_candidate(entry.name.lower(), path, include):
                continue
            elif excluding(path, exclude):
                found.skip(path, "excluded")
                search.excluded.append((entry, path, include))
            else:
                candidates.append(_Candidate(entry, path, include))
        for candidate, kind in zip(candidates, self._kinds(candidates), strict=True):
            found.add_kind(kind, candidate.entry, candidate.path, search)

    def _kinds(self, candidates: Sequence[_Candidate]) -> Iterator[str | None]:
        """Whether candidates are inputs, None if they cannot be read."""

        def kind(candidate: _Candidate) -> str | None:
            with suppress(OSError):
                return self._found.kind(*candidate)
            return None

        with ThreadPoolExecutor(MAX_REQUESTS) as pool:
            for start in range(0, len(candidates), MAX_WAITING):
                group = candidates[start : start + MAX_WAITING]
                for each in group:
                    urls.list_input(each.path, each.entry.stated)
                for each, answer in zip(group, pool.map(kind, group), strict=True):
                    if answer != INPUT:
                        urls.unlist(each.path)
                    yield answer


def _below(globs: Sequence[Glob], folder: str) -> list[Glob]:
    """Globs that count from a folder."""
    return [glob._replace(root=folder) for glob in globs]
