"""The settings of a run, and how the command line overrides those of a configuration file."""

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob
from msaa_lint.core.package import DOCUMENTATION
from msaa_lint.core.project import project_root

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

COMMAND_LINE = "<command line>"

OUTPUT_FORMATS = (
    "full",
    "concise",
    "json",
    "sarif",
    "github",
    "gitlab",
    "azure",
    "teamcity",
    "rdjson",
    "junit",
    "markdown",
    "html",
)
"""The values of `output` and `--output` that print text."""

TABLE_FORMATS = ("parquet", "sqlite")
"""The values of `--output` of `check` that write tables to files."""


class Origin(NamedTuple):
    """The configuration file that a key was read from, and the path of its table: `tool`,
    `msaa-lint`, or empty.
    """

    source: "Source"
    table: tuple[str, ...]

    def finding(self, path: tuple[str | int, ...], message: str, at_key: bool = False) -> Finding:
        """A finding at the value, or the key, of a path below the table, or at the nearest
        enclosing key that has a location.
        """
        from .toml_text import places

        locations = places(self.source.text)
        whole = (*self.table, *path)
        location = next(
            (locations[whole[:n]] for n in range(len(whole), 0, -1) if whole[:n] in locations), None
        )
        span = None if location is None else location.key if at_key else location.value
        return diagnostic("MSAA921", message, self.source.name, span)

    def problem(
        self, path: tuple[str | int, ...], message: str, hint: str = "", at_key: bool = False
    ) -> Finding:
        """A finding about the value of a key, which the message names."""
        return self.finding(
            path, _located(message, f"`{path[0]}` of {self.source.name}", hint), at_key
        )


class Choice(NamedTuple):
    """The rules that the command line selects. They take precedence over those of a file; `select`
    replaces them. `pages` are the rule pages, and folders of rule pages, that it names.
    """

    select: tuple[str, ...] | None = None
    extend_select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    severity: Mapping[str, str] = {}
    pages: tuple[str, ...] = ()


class Settings(NamedTuple):
    """The settings that apply to the files below one configuration file. Paths are absolute.

    Rules: `edition` pins the default rules (None: the newest edition); `select` replaces them
    (None: keep them), `extend_select` adds to them, `ignore` removes from them; `per_file_ignores`
    removes rules for the files that match a glob; `severity` sets a rule to error, warning, note or
    off. Each of them holds rule selectors: a name, a code, a code prefix (MSAA2, MSAA), or ALL.
    `command_line` holds the selectors of the command line. `rules` are the user's own rule pages,
    and folders of rule pages.

    Results: `fail_on` is the lowest severity that makes the exit code 1, and `fail_on_cost` the
    cost that does (50MB/s); both count only findings with a confidence of at least
    `fail_confidence`. `min_severity` is the lowest severity to report, `output` the output formats
    (empty: the command's default), `baseline` the path of the baseline. `docs_url` is the address
    of the documentation, without a slash at its end, whose pages of rules reports link to (empty:
    no links).

    Inputs: files that match `exclude` are not linted. In folders, only files that match `include`
    are (empty: files with the usual endings and files that contain a frame), and with
    `respect_gitignore` none that .gitignore ignores. `strict_inputs` makes an input that creates
    something multisampled, but shows no pass to check, an error. `profile` names a device, a device
    class or a vendor. `limits` overrides `Limits`. `source` are the values that source code is
    assumed to have, by name.

    `root` is the folder of the configuration file, or the current folder. `origin` maps the path of
    each key to its configuration file.
    """

    edition: str | None = None
    select: tuple[str, ...] | None = None
    extend_select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    per_file_ignores: tuple[tuple[Glob, tuple[str, ...]], ...] = ()
    severity: Mapping[str, str] = {}
    fail_on: str = "warning"
    fail_on_cost: str | None = None
    fail_confidence: str = "medium"
    min_severity: str = "note"
    profile: str | None = None
    rules: tuple[str, ...] = ()
    exclude: tuple[Glob, ...] = ()
    include: tuple[Glob, ...] = ()
    respect_gitignore: bool = True
    baseline: str | None = None
    strict_inputs: bool = False
    source: Mapping[str, bool | int | str] = {}
    limits: Mapping[str, int] = {}
    output: tuple[str, ...] = ()
    docs_url: str = DOCUMENTATION
    root: str = ""
    command_line: Choice = Choice()
    origin: Mapping[tuple[str, ...], Origin] = {}

    def project(self, key: str) -> str | None:
        """The project in which the file that `key` names must be; None if the command line names
        it.
        """
        return project_root(self.root) if (key,) in self.origin else None

    def page_projects(self) -> dict[str, str]:
        """The projects of the rule pages, and folders of rule pages, that only a configuration
        names.
        """
        project = self.project("rules")
        return (
            {}
            if project is None
            else dict.fromkeys(set(self.rules).difference(self.command_line.pages), project)
        )

    def problem(self, key: str, message: str, hint: str = "") -> Finding:
        """A finding about the value of `key`, spelled as in a file (`fail-on`), wherever it was
        set.
        """
        origin = self.origin.get((key,))
        if origin is None:
            return diagnostic("MSAA921", _located(message, f"`--{key}`", hint), COMMAND_LINE)
        return origin.problem((key,), message, hint)


def _located(message: str, where: str, hint: str) -> str:
    return f"{message} in {where}: {hint}" if hint else f"{message} in {where}"


def override(
    settings: Settings,
    *,
    select: Iterable[str] | None = None,
    extend_select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    severity: Mapping[str, str] | None = None,
    rules: Iterable[str] = (),
    exclude: Iterable[str] = (),
    include: Iterable[str] = (),
    baseline: str | None = None,
    limits: Mapping[str, int] | None = None,
    output: Iterable[str] = (),
    **single: Any,
) -> Settings:
    """The settings with those of the command line; None and empty values keep a file's.

    `rules` and `exclude` add to a file's, the others replace them; `single` are the settings that
    are one text or flag. Paths and globs are relative to the current folder. Raises ValueError for
    a glob that cannot match anything; the other values are not checked here.
    """
    from msaa_lint.core.globs import compiled

    here = os.getcwd()
    globs = {"exclude": tuple(exclude), "include": tuple(include)}
    for pattern in (*globs["exclude"], *globs["include"]):
        compiled(pattern)
    values: dict[str, Any] = {
        **single,
        "baseline": None if baseline is None else os.path.abspath(baseline),
        "output": tuple(output) or None,
        "include": tuple(Glob(pattern, here) for pattern in globs["include"]) or None,
        "limits": {**settings.limits, **limits} if limits else None,
    }
    stated = {name: value for name, value in values.items() if value is not None}
    pages = tuple(map(os.path.abspath, rules))
    replaced = {name.replace("_", "-") for name in stated}
    return settings._replace(
        **stated,
        rules=(*settings.rules, *pages),
        exclude=(*settings.exclude, *(Glob(pattern, here) for pattern in globs["exclude"])),
        command_line=Choice(
            None if select is None else tuple(select),
            tuple(extend_select),
            tuple(ignore),
            dict(severity or {}),
            pages,
        ),
        origin={
            path: origin for path, origin in settings.origin.items() if path[0] not in replaced
        },
    )
