"""What is kept between runs of what inputs add to their results, in the user's cache folder.

What an input adds depends on its settings, on what the run determines, and on the files that were
opened for it, whose contents are kept with it by name: the input itself, shader modules, and the
compilers that were looked up. Of what is at a URL, the version that its storage states takes the
place of the content.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core import urls
from msaa_lint.core.cache import digest, text_digest
from msaa_lint.core.finding import (
    CaptureLocation,
    CaptureSummary,
    Finding,
    Fix,
    InputSummary,
    MissingKey,
    PassTraffic,
    Price,
    Saving,
    Savings,
    Suppressed,
    Undecided,
    Unread,
)
from msaa_lint.core.project import Outside, real_path
from msaa_lint.core.rendered import Counts, RenderedFinding, RenderedPart
from msaa_lint.core.serialized import by_name, dumps, loads
from msaa_lint.core.text.files import Opened, content, file_state, is_settled, recording
from msaa_lint.core.text.source import Origin, Source, Unreadable, decode
from msaa_lint.core.text.span import Edit, Label, Span
from msaa_lint.input.file_types import STDIN

from .input_runs import Linter
from .part_linter import PartLinter
from .rules.budget import Spent
from .run_part import RunPart
from .source_programs import ProgramInput, related_text
from .workspace import Unit, Workspace

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache

MAX_TEXT = 16 << 20
"""The number of bytes of an input up to which its text is read again, and not kept."""

MIN_PROGRAM = 4000
"""The number of bytes of a program from which on its part is kept; that of a shorter one takes as
little time.
"""

_KIND = "part"

State = list[Any]
"""A name for the content of a file, and what differs if it has been written; of a program, only the
latter. Empty if there is none.
"""

_REFUSED: State = ["outside"]
"""The state of a file outside of the project that it must be in."""


class _Text(NamedTuple):
    """A text that reports show. `text` is None if it is that of the file of its name."""

    name: str
    text: str | None
    origins: Sequence[Origin | None] | None


class _Entry(NamedTuple):
    """A kept part without its texts; `files` are the states of the files that it depends on,
    `projects` where those must be that content names, `programs` the states of programs, and `urls`
    the versions of what is elsewhere.
    """

    part: RunPart
    texts: list[_Text]
    files: dict[str, State]
    projects: dict[str, str]
    programs: dict[str, State]
    urls: dict[str, str]


_TYPES = by_name(
    RunPart, CaptureLocation, CaptureSummary, Counts, Edit, Finding, Fix, InputSummary, Label,
    MissingKey, Origin, PassTraffic, Price,
    RenderedFinding, RenderedPart, Saving, Savings, Span, Spent, Suppressed, Undecided, Unread,
    _Entry, _Text,
)  # fmt: skip


class KeptParts:
    """The kept parts of the inputs of a run, as `linter` would determine them."""

    def __init__(self, linter: PartLinter, cache: Cache, depends_on: str) -> None:
        self._linter = linter
        self.workspace = linter.workspace
        self._cache = cache
        self._depends_on = depends_on
        self._settings: dict[str | None, str] = {}
        """What parts depend on by configuration."""

    def part(self, unit: Unit) -> RunPart:
        """What an input or a program adds, which is then kept."""
        key = self._key(unit)
        start = time.time_ns()
        with recording() as opened:
            part = self._linter.part(unit)
        if key is not None and _is_whole(part) and not part.problems and not part.spent.turned_off:
            entry = (
                self._program_entry(unit, part)
                if isinstance(unit, ProgramInput)
                else _entry(part, opened, start)
            )
            if entry is not None:
                with suppress(RecursionError):
                    self._cache.write(_KIND, key, dumps(entry))
        return part

    def known(self, units: Sequence[Unit]) -> Mapping[int, RunPart]:
        """What inputs and programs add that is kept, if their files are as they were."""
        keys = list(map(self._key, units))
        kept = self._cache.read_all(_KIND, filter(None, keys))
        found: dict[int, RunPart] = {}
        for number, (unit, key) in enumerate(zip(units, keys, strict=True)):
            if key in kept:
                with suppress(ValueError, RecursionError):
                    entry = loads(kept[key], _TYPES)
                    if (
                        isinstance(entry, _Entry)
                        and (part := self._unchanged(unit, entry)) is not None
                    ):
                        found[number] = part
        return found

    def included(self, part: RunPart) -> bool:
        """Whether custom rules may take what they took for a part in another process, which then
        counts here.
        """
        return self._linter.included(part)

    def failed(self, unit: Unit, reason: str) -> RunPart:
        """What an input or a program adds that ended the processes that read it."""
        return self._linter.failed(unit, reason)

    def travelling(self) -> Callable[[Workspace], Linter[RunPart]]:
        """Creates such a linter in another process, with the cache there."""
        return partial(keeping, self._linter.travelling(), self._depends_on)

    def _unchanged(self, unit: Unit, entry: _Entry) -> RunPart | None:
        """The part of an entry with its texts, if the files that it depends on are as they were."""
        texts: dict[str, str] = {}
        if isinstance(unit, ProgramInput):
            roots = dict(zip(unit.paths, unit.roots, strict=True))
            index = self.workspace.index
            if any(
                index.content(path, roots.get(path)) != state[0]
                for path, state in entry.files.items()
            ):
                return None
            for each in entry.texts:
                text = related_text(each.name, roots.get(each.name))
                if text is None or digest(text.data) != entry.files[each.name][0]:
                    return None
                texts[each.name] = text.source.text
        else:
            if any(_program_state(name) != state for name, state in entry.programs.items()):
                return None
            if any(
                not _is_unchanged(path, entry.projects.get(path), state)
                for path, state in entry.files.items()
            ):
                return None
            if any(urls.version(url) != version for url, version in entry.urls.items()):
                return None
            for each in entry.texts:
                if each.text is None:
                    path = os.path.abspath(each.name)
                    data = content(path, entry.projects.get(path))
                    if data is None or digest(data) != entry.files[path][0]:
                        return None
                    texts[each.name] = decode(data)
        sources = {
            each.name: Source(each.name, each.text or texts[each.name], each.origins)
            for each in entry.texts
        }
        return entry.part._replace(sources=sources)

    def _program_entry(self, program: ProgramInput, part: RunPart) -> _Entry | None:
        """What is kept of a program; None if its files have changed since they were first read."""
        index, contents = self.workspace.index, self.workspace.contents
        if any(
            index.content(path, root) != contents.get(path)
            for path, root in zip(program.paths, program.roots, strict=True)
        ):
            return None
        texts = [_Text(name, None, source.origins) for name, source in part.sources.items()]
        return _Entry(
            part._replace(sources={}),
            texts,
            {path: [name] for path, name in contents.items()},
            {},
            {},
            {},
        )

    def _key(self, unit: Unit) -> str | None:
        """The name of the part of an input or a program; None if it is not kept."""
        if isinstance(unit, str):
            if unit == STDIN:
                return None
            path, stated = unit, repr((unit, self.workspace.project(unit)))
        else:
            if self.workspace.length(unit) < MIN_PROGRAM:
                return None
            path, stated = unit.inputs[0], repr(unit._replace(roots=()))
        resolved = self.workspace.resolve(path)
        if resolved.configuration not in self._settings:
            settings = resolved.settings._replace(origin={}, baseline=None, output=())
            pages = {
                name: text_digest(source.text)
                for name, source in resolved.engine.custom_pages.items()
            }
            values = (
                os.getcwd(),
                self._depends_on,
                settings,
                resolved.device,
                resolved.limits,
                pages,
            )
            self._settings[resolved.configuration] = text_digest(repr(values))
        return text_digest(f"{self._settings[resolved.configuration]} {stated}")


def keeping(
    linter: Callable[[Workspace], PartLinter], depends_on: str, workspace: Workspace
) -> Linter[RunPart]:
    """A linter that keeps its parts, if the workspace permits."""
    cache = workspace.cache
    return (
        KeptParts(linter(workspace), cache, depends_on) if cache is not None else linter(workspace)
    )


def _entry(part: RunPart, opened: Opened, start: int) -> _Entry | None:
    """What is kept of an input; None if a file that it depends on has just been written, or is
    where its version is unknown.
    """
    if any(
        not version or urls.version(url, is_fresh=True) != version
        for url, version in opened.urls.items()
    ):
        return None
    files: dict[str, State] = {}
    contents: dict[str, bytes] = {}
    for path, project in opened.files.items():
        state = _state(path, project)
        if state == _REFUSED:
            files[path] = state
            continue
        data = content(path, project)
        if state and (data is None or not is_settled(state, start)):
            return None
        files[path] = [digest(data), *state] if data is not None else []
        if data is not None and len(data) <= MAX_TEXT:
            contents[path] = data
    texts = []
    for name, source in part.sources.items():
        data = contents.get(os.path.abspath(name))
        texts.append(
            _Text(
                name,
                None if data is not None and _is_text(data, source.text) else source.text,
                source.origins,
            )
        )
    programs = {name: _program_state(name) for name in opened.programs}
    projects = {path: project for path, project in opened.files.items() if project is not None}
    return _Entry(part._replace(sources={}), texts, files, projects, programs, opened.urls)


def _is_whole(part: RunPart) -> bool:
    """Whether it is known what of an input was checked."""
    return bool(part.summaries or (part.rendered is not None and part.rendered.inputs))


def _is_text(data: bytes, text: str) -> bool:
    try:
        return decode(data) == text
    except Unreadable:
        return False


def _is_unchanged(path: str, project: str | None, known: State) -> bool:
    """Whether a file is as it was: nobody can set when its state changed last, and a file that was
    written may have the same content.
    """
    state = _state(path, project)
    if _REFUSED in (state, known):
        return state == known
    if state == known[1:]:
        return True
    data = content(path, project) if state and known else None
    return data is not None and digest(data) == known[0]


def _state(path: str, project: str | None) -> State:
    """The state of a file; of one that must be in a project and is not, nothing is looked at."""
    try:
        return file_state(os.stat(path if project is None else real_path(path, project)))
    except Outside:
        return _REFUSED
    except (OSError, ValueError):
        return []


def _program_state(name: str) -> State:
    """The state of a program that is installed; empty if it is not."""
    from msaa_lint.input.child_program import installed

    path = installed(name)
    return [path, *_state(path, None)] if path is not None else []
