"""The baseline: the findings that a project accepts for now, as counts by file and rule.

It is a JSON file, `{"schema": "msaa-lint/baseline-v1", "entries": {file: {rule: count}}}`, sorted
so that diffs are small. Files are relative to its folder. Up to `count` findings are suppressed; if
there are more, all of them are reported, since nothing says which are new. 9xx errors are never
counted.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Suppressed
from msaa_lint.core.project import Outside, folder_of, is_inside, project_root, shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.urls import is_url

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

SCHEMA = "msaa-lint/baseline-v1"
MAX_BYTES = 16 << 20

Counts = Mapping[str, Mapping[str, int]]
"""The number of findings by file and rule."""


class Baseline(NamedTuple):
    """The accepted findings. `root` is the absolute path of the folder that files are relative
    to.
    """

    entries: Counts
    root: str


class Refused(NamedTuple):
    """The problems of an unusable baseline, and the text they point into, by name."""

    findings: tuple[Finding, ...]
    sources: Mapping[str, Source] = {}


class Stale(NamedTuple):
    """An entry that counts more findings than were `reported`: it could hide a new one."""

    file: str
    rule: str
    counted: int
    reported: int

    def __str__(self) -> str:
        verb = "is" if self.reported == 1 else "are"
        return (
            f"the baseline counts {self.counted} of {self.rule} in {self.file}, but there "
            f"{verb} {self.reported}"
        )


def load(path: str, project: str | None) -> Baseline | Refused:
    """The baseline at a path, or its problems (MSAA921). `project` is None for a path of the
    command line.
    """
    from msaa_lint.core.text.files import read
    from msaa_lint.core.text.source import Source, decode

    name = shown(path)
    try:
        source = Source(name, decode(read(path, MAX_BYTES, project)))
    except Outside as error:
        return Refused(
            (
                diagnostic(
                    "MSAA921",
                    f"cannot read the baseline: {error}; only the command line can name such a "
                    "file",
                    name,
                ),
            )
        )
    except FileNotFoundError:
        return Refused(
            (
                diagnostic(
                    "MSAA921",
                    f"no such baseline {quoted(name)}: `msaa-lint baseline` writes one",
                    name,
                ),
            )
        )
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        return Refused((diagnostic("MSAA921", f"cannot read the baseline: {reason}", name),))
    from .baseline_text import read_entries

    entries, findings = read_entries(source, SCHEMA)
    if findings:
        return Refused(tuple(findings), {name: source})
    return Baseline(entries, os.path.abspath(folder_of(path)))


def apply(
    findings: Iterable[Finding], baseline: Baseline
) -> tuple[list[Finding], list[Suppressed]]:
    """The findings that the baseline does not count, and those that it suppresses. All findings of
    a file must be passed together.
    """
    findings = list(findings)
    counts = _counts(findings, baseline.root)
    remaining, suppressed = [], []
    for found in findings:
        key = _key(found.file, baseline.root)
        if found.fatal or counts[key][found.rule] > baseline.entries.get(key, {}).get(
            found.rule, 0
        ):
            remaining.append(found)
        else:
            suppressed.append(Suppressed(found, "baseline"))
    return remaining, suppressed


def stale(
    baseline: Baseline,
    findings: Iterable[Finding],
    files: Collection[str] | None = None,
    rules: Collection[str] | None = None,
) -> list[Stale]:
    """The entries that count more than the given findings, sorted by file and rule.

    `files` are the linted files and `rules` the names of the enabled rules (None: all): only their
    entries can be stale, and those of files that no longer exist. Entries of a file with a 9xx
    error cannot, since no rule ran on it.
    """
    broken: set[str] = set()
    counts = _counts(findings, baseline.root, broken)
    linted = None if files is None else {_key(file, baseline.root) for file in files}

    looked_up = _Existing(baseline.root)

    def is_checked(file: str) -> bool:
        if file in broken:
            return False
        return linted is None or file in linted or looked_up.is_gone(file)

    return [
        Stale(file, rule, counted, counts.get(file, {}).get(rule, 0))
        for file, entries in sorted(baseline.entries.items())
        if is_checked(file)
        for rule, counted in sorted(entries.items())
        if (rules is None or rule in rules) and counts.get(file, {}).get(rule, 0) < counted
    ]


class _Existing:
    """Looks up which files of a baseline exist, in its project only: a baseline has no say in where
    else to look.
    """

    def __init__(self, root: str) -> None:
        self.root = root
        self.project = project_root(root)
        self._inside: dict[str, bool] = {}

    def is_gone(self, file: str) -> bool:
        """Whether a file is in the project and does not exist. URLs are not looked up."""
        if "://" in file:
            return False
        path = os.path.join(self.root, file)
        folder = os.path.dirname(path)
        if folder not in self._inside:
            self._inside[folder] = is_inside(folder, self.project)
        return self._inside[folder] and not os.path.lexists(path)


def build(findings: Iterable[Finding], root: str | None = None) -> Baseline:
    """The baseline that suppresses these findings, with files relative to `root` (None: the current
    folder).
    """
    base = os.path.abspath(root or os.curdir)
    return Baseline(_counts(findings, base), base)


def prune(
    baseline: Baseline,
    findings: Iterable[Finding],
    files: Collection[str] | None = None,
    rules: Collection[str] | None = None,
) -> Baseline:
    """The baseline with its stale entries lowered to what was reported, and nothing added. The
    arguments are those of `stale`.
    """
    lowered = {
        (entry.file, entry.rule): entry.reported
        for entry in stale(baseline, findings, files, rules)
    }
    counts = {
        file: {rule: lowered.get((file, rule), n) for rule, n in rules.items()}
        for file, rules in baseline.entries.items()
    }
    entries = {file: {rule: n for rule, n in rules.items() if n} for file, rules in counts.items()}
    return Baseline({file: rules for file, rules in entries.items() if rules}, baseline.root)


def dump(baseline: Baseline) -> str:
    """The text of a baseline's file."""
    import json

    entries = {file: dict(rules) for file, rules in baseline.entries.items() if rules}
    return json.dumps({"schema": SCHEMA, "entries": entries}, indent=2, sort_keys=True) + "\n"


def save(baseline: Baseline, path: str, force: bool = True) -> None:
    """Writes a baseline atomically; over a file that msaa-lint did not write only if `force` is
    true. Raises OSError.
    """
    from msaa_lint.core.atomic_write import write_file
    from msaa_lint.input.content import is_own_output

    write_file(path, dump(baseline).encode(), None if force else is_own_output)


def _key(file: str, root: str) -> str:
    """A finding's file as the baseline names it; `<stdin>` and other names that are not paths stay
    as they are, as URLs do.
    """
    if file == "-" or file.startswith("<") or is_url(file):
        return file
    try:
        return os.path.relpath(file, root).replace(os.sep, "/")
    except ValueError:
        return file


def _counts(
    findings: Iterable[Finding], root: str, broken: set[str] | None = None
) -> dict[str, dict[str, int]]:
    """The number of findings by file and rule; adds the files with a 9xx error to `broken`."""
    counts: dict[str, dict[str, int]] = {}
    for found in findings:
        key = _key(found.file, root)
        if not found.fatal:
            rules = counts.setdefault(key, {})
            rules[found.rule] = rules.get(found.rule, 0) + 1
        elif broken is not None:
            broken.add(key)
    return counts
