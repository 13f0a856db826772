"""The settings, rules and inputs of one run: settings are resolved for a file before it is
opened.
"""

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cached_property
from typing import TYPE_CHECKING

from msaa_lint.core import urls
from msaa_lint.core.allowance import Allowance
from msaa_lint.core.diagnostics import diagnostic, internal_error
from msaa_lint.core.finding import Finding
from msaa_lint.core.garbage import collect_garbage
from msaa_lint.core.spool import Spool, SpooledDict
from msaa_lint.core.text.files import is_there
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Source, Unreadable
from msaa_lint.input.discovery import Discovered, discover
from msaa_lint.input.file_types import STDIN
from msaa_lint.input.known_kinds import KnownKinds

from .engine import Engine, load_rules
from .input_file import InputFile, ResolvedSettings, configuration_name
from .lint_options import LintOptions
from .request import Request
from .rules.budget import Spent
from .rules.page_files import folder as pages_folder
from .rules.rule import EDITIONS
from .run_limits import RunLimits
from .settings.config import Configurations, KnownConfigurations, Loaded
from .settings.invalid_values import invalid_values
from .settings.selection import Selection
from .settings.selectors import Weighed, unknown_selectors
from .settings.settings import Settings, override
from .source_programs import ProgramInput, is_read_together, programs, related_text

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache
    from msaa_lint.frame.devices import DeviceProfile
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.code.project.index import Index
    from msaa_lint.input.source_file import SourceFile, SourceText

    from .rules.budget import Budget


MAX_TEXTS = 64
"""The number of texts that findings point into, from which on they are not kept in memory."""

Unit = str | ProgramInput
"""What is read at once: an input by its path, or the files of a program."""


class UnitRead:
    """What reading an input or a program met: problems of its files, the inputs that could not be
    read as part of a program, and what custom rules have spent.
    """

    def __init__(self) -> None:
        self.findings: list[Finding] = []
        self.failed: set[str] = set()
        self.spent = Spent()


class Workspace:
    """The settings, rules and inputs of one run, each loaded once.

    `findings` are the problems met so far with configuration files, rule pages and inputs, and
    `sources` the texts that they point into; `spool` has what does not stay in memory. `current`
    are the settings that apply to the current folder.
    """

    def __init__(
        self, request: Request, configurations: Configurations | KnownConfigurations | None = None
    ) -> None:
        self.request = request
        self.findings: list[Finding] = []
        self.spool = Spool()
        self.sources: SpooledDict[Source] = SpooledDict(self.spool, MAX_TEXTS)
        self.configurations = configurations or Configurations(request.config, request.isolated)
        self.loaded: dict[str | None, Loaded] = {}
        """The configurations that are used, by path."""
        self._settings: dict[str | None, Settings] = {}
        self._resolved: dict[str | None, ResolvedSettings] = {}
        self._engines: dict[object, Engine] = {}
        self._projects: Mapping[str, str] = {}
        self._programs: list[ProgramInput] | None = None
        self.failed: set[str] = set()
        """The inputs that could not be read as part of a program."""
        self.contents: dict[str, str] = {}
        """Names for the contents of the files of the program that was read last."""
        self._limits = RunLimits()
        self._begun: Budget | None = None
        self._keys = self._new_keys()
        self.current = self.resolve(os.curdir)

    def settings(self, path: str) -> Settings:
        """The settings that apply to a file or folder."""
        return self._override(self.configurations.load(path))

    def _override(self, loaded: Loaded) -> Settings:
        if loaded.path not in self._settings:
            self.findings.extend(loaded.findings)
            self.sources.update(loaded.sources)
            settings = override(loaded.settings, **self.request.overrides)
            self.findings.extend(invalid_values(settings))
            self._settings[loaded.path] = settings
        return self._settings[loaded.path]

    def resolve(self, path: str) -> ResolvedSettings:
        """The resolved settings for a file or folder."""
        return self.resolve_loaded(self.configurations.load(path))

    def resolve_loaded(self, loaded: Loaded) -> ResolvedSettings:
        """The resolved settings of a configuration."""
        if loaded.path not in self._resolved:
            self.loaded[loaded.path] = loaded
            settings = self._override(loaded)
            engine = self._engine(settings)
            self.findings.extend(unknown_selectors(settings, lambda: engine.registry.names))
            selection = Selection(settings, lambda: engine.registry.rules)
            if self.request.log is not None:
                enabled = sum(map(selection.enabled, engine.registry.rules))
                profile = f", profile {settings.profile}" if settings.profile is not None else ""
                self.request.log(
                    f"{configuration_name(loaded.path)}: edition "
                    f"{settings.edition or EDITIONS[-1]}, {enabled} rules enabled{profile}"
                )
            self._resolved[loaded.path] = ResolvedSettings(
                settings,
                selection,
                engine,
                _device(settings),
                Limits()._replace(**settings.limits),
                loaded.path,
            )
        return self._resolved[loaded.path]

    @property
    def resolved(self) -> Sequence[ResolvedSettings]:
        """The settings that have been resolved, one for each configuration file."""
        return list(self._resolved.values())

    def _engine(self, settings: Settings) -> Engine:
        projects = settings.page_projects()
        key = settings.rules, tuple(sorted(projects.items()))
        if key not in self._engines:
            paths = [path for path in settings.rules if is_there(path)]
            registry = (
                load_rules(paths, projects, self._limits.rules, self.request.traceback)
                if paths
                else None
            )
            if registry is not None:
                self.findings.extend(registry.problems)
                self.sources.update(registry.sources)
            self._engines[key] = Engine(registry, self._limits)
        return self._engines[key]

    def broken_pages(self) -> list[str]:
        """The files of the custom rules that cannot be used."""
        return [page for engine in self._engines.values() for page in engine.broken_pages]

    def discover(self, sources: bool = False) -> Discovered:
        """The inputs that the request names; `sources` includes the source code in folders."""
        inputs_among = self._inputs_among if sources else None
        kinds = KnownKinds(lambda: self.cache)
        found = discover(
            self.request.paths,
            self.settings,
            sources,
            self.request.log,
            inputs_among,
            self._speaks,
            kinds.of,
        )
        kinds.close()
        self.findings.extend(found.findings)
        self._projects = found.projects
        return found

    @contextmanager
    def guard(self, path: str) -> Iterator[None]:
        """Reports an exception that an input causes as a finding of that input, so that the others
        are still linted.
        """
        try:
            yield
        except Exception as error:
            if self.request.traceback:
                raise
            self.findings.append(
                diagnostic("MSAA941", internal_error(error), self.request.input_name(path))
            )

    def open(self, path: str) -> InputFile | None:
        """Reads an input; None, after adding a finding, if it cannot be read."""
        from msaa_lint.input import opening

        request, name = self.request, self.request.input_name(path)
        resolved = self.resolve(request.stdin_filename or os.curdir if path == STDIN else path)
        try:
            project, assumed = self._projects.get(path), resolved.settings.source
            data = opening.load(
                path,
                resolved.limits,
                name,
                request.format,
                request.data,
                project,
                request.frame_end,
                assumed,
            )
        except (OSError, Unreadable) as error:
            self.findings.append(opening.unreadable(error, name))
            return None
        return self._input(path, name, data, resolved)

    def length(self, unit: Unit) -> int:
        """The number of bytes of an input, or of the files of a program; 0 if that is unknown."""
        if isinstance(unit, ProgramInput):
            return sum(map(self.index.length, unit.paths))
        with suppress(OSError, ValueError):
            return urls.length(unit) if urls.is_url(unit) else os.path.getsize(unit)
        return 0

    @contextmanager
    def reading(self, unit: Unit) -> Iterator[UnitRead]:
        """Reads an input or a program in the `with` statement: what is met belongs to it, and not
        to the workspace.
        """
        name = unit if isinstance(unit, str) else unit.inputs[0]
        # Problems of a configuration are not those of the first input that it applies to.
        self.resolve(self.request.stdin_filename or os.curdir if name == STDIN else name)
        findings, failed, read = self.findings, self.failed, UnitRead()
        self.findings, self.failed = read.findings, read.failed
        self._limits.begin_input()
        self._keys = self._new_keys()
        before = self._limits.rules.copy()
        try:
            yield read
            read.spent = self._limits.rules.spent_since(before)
        finally:
            self.findings, self.failed = findings, failed
            collect_garbage()

    def not_read(self, unit: Unit, reason: str) -> Finding:
        """The finding about an input that could not be read in another process."""
        return diagnostic(
            "MSAA941",
            f"not linted: {reason}",
            self.request.input_name(unit if isinstance(unit, str) else unit.inputs[0]),
        )

    def _new_keys(self) -> Allowance:
        return Allowance() if self.request.keys is None else Allowance(self.request.keys)

    def forget_spent(self) -> None:
        """Makes the budget of custom rules what it was when this was called first: what they spend
        is counted by another process.
        """
        if self._begun is None:
            self._begun = self._limits.rules.copy()
        self._limits.rules.restore(self._begun)

    def include(self, spent: Spent) -> bool:
        """Counts what custom rules have spent elsewhere; False if that may be more than is left
        here.
        """
        return self._limits.rules.include(spent)

    def use(self, configuration: str | None) -> None:
        """Makes a configuration apply to all inputs from here on, where the files that state them
        need not be.
        """
        if isinstance(self.configurations, KnownConfigurations):
            self.configurations.current = configuration

    def enter(self, projects: Mapping[str, str]) -> None:
        """Makes inputs known, with the projects that they must be in."""
        self._projects = projects

    def project(self, path: str) -> str | None:
        """The project that an input must be in; None for one that is named."""
        return self._projects.get(path)

    def _input(
        self,
        path: str,
        name: str,
        data: "bytes | CaptureInput | SourceFile",
        resolved: ResolvedSettings,
    ) -> InputFile:
        """An input that has been read."""
        request, device = self.request, resolved.device
        self._limits.rules.extend(len(data if isinstance(data, bytes) else data.source.text))
        severity = resolved.selection.for_file(name, device.vendor if device is not None else None)
        options = LintOptions(
            severity,
            resolved.limits,
            request.format,
            device,
            request.ignores,
            False,
            self._keys,
            request.all_keys,
            edits=request.edits,
        )
        return InputFile(
            path, name, data, resolved, options, self.current.settings.min_severity, request.log
        )

    @cached_property
    def index(self) -> "Index":
        """The words of source files."""
        from msaa_lint.input.code.project.index import Index

        return Index("\n".join([os.getcwd(), *self.request.paths]), lambda: self.cache)

    @cached_property
    def cache(self) -> "Cache | None":
        """What is kept between runs, if the request permits."""
        if not self.request.cache:
            return None
        from msaa_lint.core.cache import user_cache
        from msaa_lint.input.code.project.version import version

        return user_cache(version(pages_folder()))

    def flush(self) -> None:
        """Keeps what the cache is for, as far as it is known: this process may be ended after any
        task.
        """
        if (cache := self.__dict__.get("cache")) is not None:
            cache.flush()

    def close(self) -> list[str]:
        """Keeps what the cache is for; returns lines for the user."""
        if "index" in self.__dict__:
            self.index.close()
        cache: Cache | None = self.__dict__.get("cache")
        if cache is None:
            return []
        cache.close()
        return cache.notes

    def _speaks(self, path: str) -> bool:
        from msaa_lint.input.code.mentions import is_api

        return not is_api(path) and self.index.of_entry(path).speaks

    def _inputs_among(
        self, files: Mapping[str, str | None], related: Mapping[str, str]
    ) -> list[str]:
        """The inputs among source files of folders: those of the programs that use
        multisampling.
        """
        from msaa_lint.input.code import installed

        if self.request.format is None and installed():
            self._programs = self._find_programs(files, related)
        return [path for program in self._programs or () for path in program.inputs]

    def programs(self, discovered: Discovered) -> list[ProgramInput]:
        """The programs that the source files among the inputs form; files under different
        configurations are in different ones.
        """
        if self._programs is None:
            files = {path: discovered.projects.get(path) for path in discovered.files}
            self._programs = (
                self._find_programs(files, discovered.related)
                if self.request.format is None
                else []
            )
        return self._programs

    def _find_programs(
        self, files: Mapping[str, str | None], related: Mapping[str, str]
    ) -> list[ProgramInput]:
        by_settings: dict[str | None, tuple[list[str], dict[str, str]]] = {}
        for path in (*files, *related):
            if path != STDIN and is_read_together(path):
                inputs, others = by_settings.setdefault(self.resolve(path).configuration, ([], {}))
                if path in files:
                    inputs.append(path)
                else:
                    others[path] = related[path]
        projects = {path: project for path, project in files.items() if project is not None}
        return [
            program
            for inputs, others in by_settings.values()
            for program in programs(inputs, others, projects, self.index)
        ]

    def open_program(self, program: ProgramInput) -> InputFile | None:
        """Reads the files of a program, with a finding for each input that cannot be read; None if
        they cannot be read together.
        """
        inputs = set(program.inputs)
        texts = [
            text._replace(definitions=definitions)
            if (text := self._text(path, path in inputs, root)) is not None
            else None
            for path, root, definitions in zip(
                program.paths, program.roots, program.definitions, strict=True
            )
        ]
        if self.request.cache:
            from msaa_lint.core.cache import digest

            self.contents = {
                path: digest(text.data)
                for path, text in zip(program.paths, texts, strict=True)
                if text is not None
            }
        kept = [number for number, text in enumerate(texts) if text is not None]
        position = {number: at for at, number in enumerate(kept)}
        read = [text for text in texts if text is not None]
        first = next((text for text in read if text.is_input), None)
        if first is None:
            return None
        from msaa_lint.input.source_file import read_program, read_source_text

        name = first.source.name
        try:
            if len(read) == 1 and not first.definitions:
                data = read_source_text(first)
            else:
                includes = [
                    [position[other] for other in program.includes[number] if other in position]
                    for number in kept
                ]
                data = read_program(
                    read, includes, [program.headers[number] for number in kept], self.cache
                )
        except Unreadable:
            return None
        resolved = self.resolve(name)
        file = self._input(name, name, data, resolved)
        if len(read) == 1 or not resolved.settings.per_file_ignores:
            return file
        vendor = resolved.device.vendor if resolved.device is not None else None
        in_files = [
            resolved.selection.for_file(text.source.name, vendor) for text in read if text.is_input
        ]

        def severity(rule: Weighed, suggested: str, device_vendor: str | None) -> str | None:
            return next(
                (
                    found
                    for each in in_files
                    if (found := each(rule, suggested, device_vendor)) is not None
                ),
                None,
            )

        options = file.options._replace(
            severity=severity, severity_in=lambda other: resolved.selection.for_file(other, vendor)
        )
        return file._replace(options=options)

    def _text(self, path: str, is_input: bool, project: str | None) -> "SourceText | None":
        """The text of a source file; None, after adding a finding if it is an input, if it cannot
        be read. An input with other content than its name states is left to `open`.
        """
        from msaa_lint.input import opening
        from msaa_lint.input.code import check_length
        from msaa_lint.input.source_file import SourceText

        if not is_input:
            return related_text(path, project)
        try:
            content = opening.load_text(path, self.resolve(path).limits, path, None, None, project)
            if isinstance(content, bytes) or not isinstance(content, SourceText):
                return None
            check_length(content.source)
            content = content._replace(assumed=self.resolve(path).settings.source)
        except (OSError, Unreadable) as error:
            self.findings.append(opening.unreadable(error, path))
            self.failed.add(path)
            return None
        return content


def _device(settings: Settings) -> "DeviceProfile | None":
    """The profile that settings name; None if it cannot be used."""
    if settings.profile is None:
        return None
    from msaa_lint.frame.profiles import Problem, profile_of

    device = profile_of(settings.profile, settings.project("profile"))
    return None if isinstance(device, Problem) else device
