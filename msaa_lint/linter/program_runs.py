"""Lints the programs of a run: takes the results of an earlier run if their files are the same, and divides the others among processes."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from msaa_lint.core.finding import (
    CaptureLocation,
    Finding,
    Fix,
    InputSummary,
    Price,
    Saving,
    Savings,
    Suppressed,
    Undecided,
    Unread,
)
from msaa_lint.core.garbage import collect_garbage
from msaa_lint.core.text.span import Edit, Label, Span

from .run_part import RunPart

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source
    from msaa_lint.core.workers import Workers

    from .source_programs import ProgramInput
    from .workspace import Workspace

MIN_KEPT = 4000
"""The number of bytes of a program from which on its result is kept; that of a shorter one takes as little time."""

MIN_DIVIDED = 300_000
"""The number of bytes of programs from which on they are divided among processes: starting these takes as long as reading less."""


class ProgramRuns:
    """The results of linting programs, by their numbers.

    `lint` lints one program. Its result depends on the program's files, on its settings, and on `depends_on`. If `depends_on` is None,
    programs are linted in this process alone, and no result is kept.
    """

    def __init__(
        self, workspace: Workspace, programs: Sequence[ProgramInput], lint: Callable[[ProgramInput], RunPart], depends_on: str | None
    ) -> None:
        self._workspace = workspace
        self._programs = programs
        self._lint = lint
        self._depends_on = depends_on
        self._workers: Workers[RunPart] | None = None
        self._settings: dict[str | None, str] = {}
        """What results depend on by configuration."""
        self._keys: dict[int, str] = {}
        self._kept: dict[int, RunPart] = {}
        if depends_on is None or not programs or workspace.has_own_rules:
            return
        lengths = [sum(map(workspace.index.length, program.paths)) for program in programs]
        for number, length in enumerate(lengths):
            if length >= MIN_KEPT:
                self._look_up(number)
        waiting = sorted((number for number in range(len(programs)) if number not in self._kept), key=lambda number: -lengths[number])
        if len(waiting) > 1 and sum(lengths[number] for number in waiting) >= MIN_DIVIDED:
            from msaa_lint.core.workers import Workers, processes

            if (count := processes()) > 1:
                self._workers = Workers(self._part, waiting, count)

    def part(self, number: int) -> RunPart:
        """Returns the result of linting a program, which is asked for once."""
        if number in self._kept:
            return self._kept.pop(number)
        return self._workers.result(number) if self._workers is not None else self._part(number)

    def close(self) -> None:
        """Ends the other processes."""
        if self._workers is not None:
            self._workers.close()

    def _look_up(self, number: int) -> None:
        """Takes the result for a program from the cache, if it is there."""
        cache, program = self._workspace.cache, self._programs[number]
        if cache is None:
            return
        contents = [self._workspace.index.content(path, root) for path, root in zip(program.paths, program.roots, strict=True)]
        key = self._key(program, contents)
        data = cache.read("result", key) if key is not None else None
        if key is not None:
            self._keys[number] = key
        if data is not None:
            with suppress(ValueError, RecursionError):
                part, names = _loads(data)
                sources = self._texts(program, names, contents)
                if len(sources) == len(names):
                    self._kept[number] = part._replace(sources=sources)

    def _texts(self, program: ProgramInput, names: Sequence[str], contents: Sequence[str | None]) -> dict[str, Source]:
        """Returns those of the texts of a program whose contents are as stated."""
        from msaa_lint.core.cache import digest

        from .source_programs import related_text

        numbers = {path: number for number, path in enumerate(program.paths)}
        texts = [(number, related_text(name, program.roots[number])) for name in names if (number := numbers.get(name)) is not None]
        return {text.source.name: text.source for number, text in texts if text is not None and digest(text.data) == contents[number]}

    def _key(self, program: ProgramInput, contents: Sequence[str | None]) -> str | None:
        """Returns the name of the result for a program whose files have some contents; None if one of them is unknown."""
        if None in contents:
            return None
        from msaa_lint.core.cache import digest

        resolved = self._workspace.resolve(program.inputs[0])
        if resolved.configuration not in self._settings:
            settings = resolved.settings._replace(origin={}, baseline=None, output=())
            self._settings[resolved.configuration] = repr((os.getcwd(), self._depends_on, settings, resolved.device, resolved.limits))
        stated = (self._settings[resolved.configuration], program._replace(roots=()), list(contents))
        return digest(repr(stated).encode("utf-8", "surrogatepass"))

    def _part(self, number: int) -> RunPart:
        """Lints a program. Problems of its files are in the result, not in the workspace."""
        workspace, program = self._workspace, self._programs[number]
        findings, failed = workspace.findings, workspace.failed
        workspace.findings, workspace.failed, workspace.contents = [], set(), {} if number in self._keys else None
        part = RunPart()
        try:
            with workspace.guard(program.inputs[0]):
                part = self._lint(program)
            part = part._replace(problems=workspace.findings, failed=frozenset(workspace.failed))
        finally:
            workspace.findings, workspace.failed = findings, failed
        self._keep(number, part)
        collect_garbage()
        return part

    def _keep(self, number: int, part: RunPart) -> None:
        """Keeps the result for a program, unless files have changed since they were first read, or cannot be read."""
        cache, contents = self._workspace.cache, self._workspace.contents
        key = self._keys.get(number)
        if cache is not None and key is not None and contents is not None and part.summaries and not part.problems:
            program = self._programs[number]
            if key == self._key(program, [contents.get(path) for path in program.paths]):
                with suppress(RecursionError):
                    cache.write("result", key, _dumps(part))


_TYPES = (RunPart, CaptureLocation, Edit, Finding, Fix, InputSummary, Label, Price, Saving, Savings, Span, Suppressed, Undecided, Unread)


def _dumps(part: RunPart) -> bytes:
    """The result for a program as bytes: of the texts, only the names."""
    from msaa_lint.core.serialized import dumps

    return dumps((part._replace(sources={}), list(part.sources)))


def _loads(data: bytes) -> tuple[RunPart, list[str]]:
    """The result for a program that bytes hold, without texts, and the names of the texts. Raises ValueError for other bytes."""
    from msaa_lint.core.serialized import by_name, loads

    match loads(data, by_name(*_TYPES)):
        case (RunPart() as part, list(names)):
            return part, names
    raise ValueError("not the result for a program")
