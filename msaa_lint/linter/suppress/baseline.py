"""The baseline: findings that a project has accepted for now, as counts of each rule in each file.

A JSON file, `{"schema": "msaa-lint/baseline-v1", "entries": {file: {rule: count}}}`, sorted, so that a change shows as the lines that
changed. Files are named from its folder. Up to `count` findings are silenced; where there are more, all are shown, since none can be
told from the others. 9xx errors never enter.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Suppressed
from msaa_lint.core.quote import quoted

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

SCHEMA = "msaa-lint/baseline-v1"
MAX_BYTES = 16 << 20

Entries = Mapping[str, Mapping[str, int]]


class Baseline(NamedTuple):
    """Counts by file and rule. `root` is the folder (absolute) that the files are named from."""

    entries: Entries
    root: str


class Refused(NamedTuple):
    """Why a baseline cannot be used, and the text that the findings point into, by its name."""

    findings: tuple[Finding, ...]
    sources: Mapping[str, Source] = {}


class Stale(NamedTuple):
    """An entry that counts more findings than there are (`found`): it could hide a new one."""

    file: str
    rule: str
    counted: int
    found: int

    def __str__(self) -> str:
        return f"the baseline counts {self.counted} of {self.rule} in {self.file}, there {'is' if self.found == 1 else 'are'} {self.found}"


class Applied(NamedTuple):
    kept: list[Finding]
    suppressed: list[Suppressed]
    stale: list[Stale]


def load(path: str) -> Baseline | Refused:
    """The baseline at a path, or what is wrong with it (MSAA921)."""
    from msaa_lint.core.project import shown
    from msaa_lint.core.text.source import Source, Unreadable, decode

    name = shown(path)
    try:
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            raise Unreadable(f"a baseline has at most {MAX_BYTES} bytes")
        source = Source(name, decode(data))
    except FileNotFoundError:
        help = "`msaa-lint baseline` writes one"
        return Refused((diagnostic("MSAA921", f"no such baseline {quoted(name)}", name, help=help),))
    except (OSError, ValueError, Unreadable) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        return Refused((diagnostic("MSAA921", f"the baseline cannot be read: {reason}", name),))
    from .baseline_text import entries

    read, problems = entries(source, SCHEMA)
    if problems:
        return Refused(tuple(problems), {name: source})
    return Baseline(read, os.path.dirname(os.path.abspath(path)))


def apply(
    findings: Iterable[Finding], baseline: Baseline, files: Collection[str] | None = None, rules: Collection[str] | None = None
) -> Applied:
    """The findings that stay, those that the baseline silences, and its stale entries.

    `files` are those that were linted and `rules` the names of those that were on (None: all): an entry for another is not stale, nor
    is one for a file that a 9xx error kept from being judged. One for a file that is gone is.
    """
    findings = list(findings)
    counts = _counts(findings, baseline.root)
    kept, suppressed = [], []
    for found in findings:
        key = _key(found.file, baseline.root)
        allowed = baseline.entries.get(key, {}).get(found.rule, 0)
        if found.fatal or counts[key][found.rule] > allowed:
            kept.append(found)
        else:
            suppressed.append(Suppressed(found, "baseline"))
    judged = _judged(findings, baseline.root, files)
    stale = [
        Stale(file, rule, counted, counts.get(file, {}).get(rule, 0))
        for file, own in sorted(baseline.entries.items())
        if judged(file)
        for rule, counted in sorted(own.items())
        if (rules is None or rule in rules) and counts.get(file, {}).get(rule, 0) < counted
    ]
    return Applied(kept, suppressed, stale)


def build(findings: Iterable[Finding], root: str | None = None) -> Baseline:
    """The baseline that silences these findings, named from `root` (None: the current folder)."""
    base = os.path.abspath(root or os.curdir)
    return Baseline(_counts(findings, base), base)


def prune(
    baseline: Baseline, findings: Iterable[Finding], files: Collection[str] | None = None, rules: Collection[str] | None = None
) -> Baseline:
    """The baseline without what `apply` calls stale. Nothing is added."""
    stale = {(each.file, each.rule): each.found for each in apply(findings, baseline, files, rules).stale}
    left = {file: {rule: stale.get((file, rule), n) for rule, n in own.items()} for file, own in baseline.entries.items()}
    entries = {file: {rule: n for rule, n in own.items() if n} for file, own in left.items()}
    return Baseline({file: own for file, own in entries.items() if own}, baseline.root)


def dump(baseline: Baseline) -> str:
    """The text of a baseline's file."""
    import json

    entries = {file: dict(own) for file, own in baseline.entries.items() if own}
    return json.dumps({"schema": SCHEMA, "entries": entries}, indent=2, sort_keys=True) + "\n"


def save(baseline: Baseline, path: str) -> None:
    """Writes a baseline; OSError where that cannot be. A run that is stopped leaves the old one whole."""
    beside = f"{path}.{os.getpid()}.tmp"
    try:
        with open(beside, "x", encoding="utf-8", newline="\n") as file:
            file.write(dump(baseline))
        os.replace(beside, path)
    except OSError:
        if os.path.lexists(beside):
            os.unlink(beside)
        raise


def _key(file: str, root: str) -> str:
    """A finding's file as the baseline names it; what is no file (`<stdin>`) keeps its name."""
    if file == "-" or file.startswith("<"):
        return file
    try:
        return os.path.relpath(file, root).replace(os.sep, "/")
    except ValueError:
        return file


def _counts(findings: Iterable[Finding], root: str) -> dict[str, dict[str, int]]:
    counts: dict[str, dict[str, int]] = {}
    for found in findings:
        if not found.fatal:
            own = counts.setdefault(_key(found.file, root), {})
            own[found.rule] = own.get(found.rule, 0) + 1
    return counts


def _judged(findings: Iterable[Finding], root: str, files: Collection[str] | None) -> Callable[[str], bool]:
    """Tells of a file, as the baseline names it, whether this run judged it, or it is gone."""
    broken = {_key(found.file, root) for found in findings if found.fatal}
    linted = None if files is None else {_key(file, root) for file in files}

    def judged(file: str) -> bool:
        if file in broken:
            return False
        return linted is None or file in linted or not os.path.lexists(os.path.join(root, file))

    return judged
