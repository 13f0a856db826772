"""What can be configured, and how the command line overrides it."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.globs import Glob

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

COMMAND_LINE = "<command line>"

OUTPUT_FORMATS = ("full", "concise", "json", "sarif", "github", "gitlab", "junit", "markdown")
"""The values of `output` and `--output`."""


class Origin(NamedTuple):
    """Where a key was read: the text of the file, and the table that it stands in (`tool`, `msaa-lint`, or none)."""

    source: "Source"
    table: tuple[str, ...]

    def wrong(self, path: tuple[str | int, ...], message: str, help: str = "", at_key: bool = False) -> Finding:
        """A finding at the value (or key) of a path below the table; where it cannot be found, at the nearest key around it."""
        from .toml_text import places

        known = places(self.source.text)
        whole = (*self.table, *path)
        place = next((known[whole[:n]] for n in range(len(whole), 0, -1) if whole[:n] in known), None)
        span = None if place is None else place.key if at_key else place.value
        return diagnostic("MSAA921", message, self.source.name, span, help=help)


class Choice(NamedTuple):
    """What the command line says of rules. It has the last word over all that a file says; `select` starts anew."""

    select: tuple[str, ...] | None = None
    extend_select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    severity: Mapping[str, str] = {}


class Settings(NamedTuple):
    """What a run is told, for the files that a configuration file governs. Paths are absolute.

    Of rules: `edition` pins the default rules (None: the newest edition's); `select` replaces them (None: they stay), `extend_select`
    adds, `ignore` takes away; `per_file_ignores` takes away in the files of a glob; `severity` gives a rule error, warning, note or off.
    All of them hold rule selectors: a name, a code, the beginning of a code (MSAA2, MSAA), or ALL. `command_line` is what the command
    line says of the same. `rules` are pages of a user's own rules, or folders of them.

    Of outcomes: `fail_on` is the lowest severity that ends the run with 1, `fail_on_cost` the price that does (as in 50MB/s), both of
    findings whose confidence is at least `fail_confidence`; `min_severity` is the lowest severity that is shown, `output` the outputs
    (none: the program's choice), `baseline` the baseline's path.

    Of inputs: `exclude` is never linted, `include` is what is linted of a folder (none: the usual names, and what looks like an input),
    `profile` a class of device or a built-in device's name, `limits` the stated ones of depth, nodes and bytes.

    `root` is the folder of the configuration file, or the current one. `origin` says where each key was read, by its path.
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
    baseline: str | None = None
    limits: Mapping[str, int] = {}
    output: tuple[str, ...] = ()
    root: str = ""
    command_line: Choice = Choice()
    origin: Mapping[tuple[str, ...], Origin] = {}

    def wrong(self, key: str, message: str, help: str = "") -> Finding:
        """A finding at the value of `key` (as a file writes it: `fail-on`), for whoever finds out later that it is of no use."""
        origin = self.origin.get((key,))
        if origin is None:
            return diagnostic("MSAA921", f"{message} (in `--{key}`)", COMMAND_LINE, help=help)
        return origin.wrong((key,), f"{message} (in `{key}` of {origin.source.name})", help)


def override(
    settings: Settings,
    *,
    edition: str | None = None,
    select: Iterable[str] | None = None,
    extend_select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    severity: Mapping[str, str] | None = None,
    fail_on: str | None = None,
    fail_on_cost: str | None = None,
    fail_confidence: str | None = None,
    min_severity: str | None = None,
    profile: str | None = None,
    rules: Iterable[str] = (),
    exclude: Iterable[str] = (),
    include: Iterable[str] = (),
    baseline: str | None = None,
    limits: Mapping[str, int] | None = None,
    output: Iterable[str] = (),
) -> Settings:
    """The settings with what the command line states; None and nothing leave what a file says.

    `rules` and `exclude` add to a file's, the others replace it. Paths and globs count from the current folder. What a word may be is
    checked by the command line, what a rule may be by `unknown_selectors`; a glob that can match nothing is a ValueError.
    """
    from msaa_lint.core.globs import compiled

    here = os.getcwd()
    globs = {"exclude": tuple(exclude), "include": tuple(include)}
    for pattern in (*globs["exclude"], *globs["include"]):
        compiled(pattern)
    single: dict[str, Any] = {
        "edition": edition,
        "fail_on": fail_on,
        "fail_on_cost": fail_on_cost,
        "fail_confidence": fail_confidence,
        "min_severity": min_severity,
        "profile": profile,
        "baseline": None if baseline is None else os.path.abspath(baseline),
        "output": tuple(output) or None,
        "include": tuple(Glob(pattern, here) for pattern in globs["include"]) or None,
        "limits": {**settings.limits, **limits} if limits else None,
    }
    stated = {name: value for name, value in single.items() if value is not None}
    replaced = {name.replace("_", "-") for name in stated}
    return settings._replace(
        **stated,
        rules=(*settings.rules, *(os.path.abspath(path) for path in rules)),
        exclude=(*settings.exclude, *(Glob(pattern, here) for pattern in globs["exclude"])),
        command_line=Choice(None if select is None else tuple(select), tuple(extend_select), tuple(ignore), dict(severity or {})),
        origin={path: origin for path, origin in settings.origin.items() if path[0] not in replaced},
    )
