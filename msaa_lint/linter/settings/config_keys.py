"""What each key of a configuration file takes."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding
from msaa_lint.core.globs import Glob
from msaa_lint.core.quote import quoted

from .settings import OUTPUT_FORMATS, Origin

LEVELS = (*reversed(SEVERITIES), "off")
LIMITS = {"depth": 100, "nodes": 1_000_000, "bytes": 64 << 20}
"""The limits that a file can lower: nesting, nodes after aliases, bytes of a description."""

MAX_ITEMS = 1000
"""Elements of a list or table: more is a mistake, or an attack."""

MAX_GLOBS = 200

SELECTOR = re.compile(r"[A-Za-z][A-Za-z0-9-]{0,99}\Z")
MAX_PROBLEMS = 50
"""Findings of one file."""

Path = tuple[str | int, ...]


class Reading:
    """One table of a configuration file while its keys are checked: what is right goes to `values`, what is wrong to `problems`.

    `within` tells whether a path stays in the project.
    """

    def __init__(self, origin: Origin, root: str, within: Callable[[str], bool]) -> None:
        self.origin = origin
        self.root = root
        self.within = within
        self.values: dict[str, Any] = {}
        self.problems: list[Finding] = []

    def read(self, table: Mapping[str, Any]) -> None:
        """Checks every key; `extends` is read elsewhere."""
        for key, value in table.items():
            if key == "extends" or len(self.problems) >= MAX_PROBLEMS:
                continue
            check = KEYS.get(key)
            if check is None:
                self.unknown((key,), [*KEYS, "extends"], self._table())
                continue
            read = check(self, key, value)
            if read is not None:
                self.values[key] = read

    def _table(self) -> str:
        return f"[{'.'.join(self.origin.table)}] of {self.origin.source.name}" if self.origin.table else self.origin.source.name

    def wrong(self, path: Path, what: str, help: str = "", at_key: bool = False) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems.append(self.origin.wrong(path, f"{what} in `{path[0]}` of {self.origin.source.name}", help, at_key))

    def unknown(self, path: tuple[str, ...], known: Sequence[str], where: str) -> None:
        from msaa_lint.core.suggestions import nearest

        if len(self.problems) >= MAX_PROBLEMS:
            return
        if path == ("tool",) and not self.origin.table:
            help = "the keys of this file stand at its top, without [tool.msaa-lint]"
        else:
            close = nearest(path[-1], known)
            help = f"did you mean `{close}`?" if close else f"there are {', '.join(known)}"
        self.problems.append(self.origin.wrong(path, f"unknown key {quoted(path[-1])} in {where}", help, at_key=True))

    def typed(self, path: Path, value: object, kind: type, due: str) -> bool:
        """Whether a value is of a type: a boolean is no number."""
        if isinstance(value, kind) and not (kind is int and isinstance(value, bool)):
            return True
        self.wrong(path, f"{_kind(value)} where {due} is due")
        return False

    def text(self, path: Path, value: object, due: str) -> str | None:
        if not self.typed(path, value, str, due):
            return None
        assert isinstance(value, str)
        if not value.strip() or "\0" in value:
            self.wrong(path, f"an empty value where {due} is due" if not value.strip() else "a NUL")
            return None
        return value

    def texts(self, path: Path, value: object, due: str) -> list[tuple[Path, str]] | None:
        """The elements of a list of strings, each with its path; None where it is no list."""
        if not self.typed(path, value, list, f"a list of {due}s"):
            return None
        assert isinstance(value, list)
        if not self.few(path, len(value)):
            return None
        article = "an" if due[0] in "aeiou" else "a"
        read = [((*path, i), self.text((*path, i), item, f"{article} {due}")) for i, item in enumerate(value)]
        return [(at, item) for at, item in read if item is not None]

    def table(self, path: Path, value: object, due: str) -> dict[str, Any]:
        if not self.typed(path, value, dict, due):
            return {}
        assert isinstance(value, dict)
        return value if self.few(path, len(value)) else {}

    def few(self, path: Path, count: int, most: int = MAX_ITEMS) -> bool:
        if count > most:
            self.wrong(path, f"{count} elements where at most {most} are allowed")
        return count <= most

    def one_of(self, path: Path, value: object, words: Sequence[str]) -> str | None:
        if not self.typed(path, value, str, f"one of {', '.join(words)}"):
            return None
        assert isinstance(value, str)
        if value in words:
            return value
        from msaa_lint.core.suggestions import nearest

        close = nearest(value, words)
        help = f"did you mean `{close}`? There are {', '.join(words)}" if close else f"there are {', '.join(words)}"
        self.wrong(path, f"unknown value {quoted(value)}", help)
        return None

    def selectors(self, path: Path, value: object) -> tuple[str, ...] | None:
        items = self.texts(path, value, "rule")
        if items is None:
            return None
        return tuple(item for at, item in items if self.selector(at, item))

    def selector(self, path: Path, item: str, at_key: bool = False) -> bool:
        if SELECTOR.match(item):
            return True
        help = "a rule's name, its code, the beginning of a code (MSAA2), or ALL is due"
        self.wrong(path, f"{quoted(item)} cannot be a rule", help, at_key)
        return False

    def glob(self, path: Path, item: str, at_key: bool = False) -> Glob | None:
        from msaa_lint.core.globs import compiled

        try:
            compiled(item)
        except ValueError as error:
            self.wrong(path, f"{quoted(item)}: {error}", at_key=at_key)
            return None
        return Glob(item, self.root)

    def inner_path(self, path: Path, item: str) -> str | None:
        """A path from the folder of the file, absolute; it must stay in the project."""
        full = os.path.normpath(os.path.join(self.root, item))
        if not self.within(full):
            self.wrong(path, f"{quoted(item)} leaves the project", "only the command line can name what lies outside")
            return None
        return full


def _edition(reading: Reading, key: str, value: object) -> str | None:
    from msaa_lint.linter.rules.registry import EDITIONS

    if isinstance(value, float):
        reading.wrong((key,), "a number where a string is due", f'write edition = "{value}"')
        return None
    return reading.one_of((key,), value, EDITIONS)


def _selectors(reading: Reading, key: str, value: object) -> tuple[str, ...] | None:
    return reading.selectors((key,), value)


def _level(reading: Reading, key: str, value: object) -> str | None:
    return reading.one_of((key,), value, LEVELS[:-1])


def _confidence(reading: Reading, key: str, value: object) -> str | None:
    return reading.one_of((key,), value, CONFIDENCES)


def _severity(reading: Reading, key: str, value: object) -> dict[str, str]:
    table = reading.table((key,), value, 'a table such as {MSAA2 = "note"}')
    read = {name: reading.one_of((key, name), level, LEVELS) for name, level in table.items() if reading.selector((key, name), name, True)}
    return {name: level for name, level in read.items() if level is not None}


def _per_file(reading: Reading, key: str, value: object) -> dict[str, tuple[Glob, tuple[str, ...]]]:
    read: dict[str, tuple[Glob, tuple[str, ...]]] = {}
    table = reading.table((key,), value, 'a table such as {"tests/**" = ["MSAA2"]}')
    if not reading.few((key,), len(table), MAX_GLOBS):
        return read
    for name, rules in table.items():
        glob, selectors = reading.glob((key, name), name, True), reading.selectors((key, name), rules)
        if glob is not None and selectors is not None:
            read[name] = (glob, selectors)
    return read


def _globs(reading: Reading, key: str, value: object) -> tuple[Glob, ...] | None:
    items = reading.texts((key,), value, "glob")
    if items is None or not reading.few((key,), len(items), MAX_GLOBS):
        return None
    return tuple(glob for glob in (reading.glob(at, item) for at, item in items) if glob is not None)


def _fail_on_cost(reading: Reading, key: str, value: object) -> str | None:
    from .cost_limit import budget

    text = reading.text((key,), value, "a price such as 50MB/s")
    try:
        return text if text is None else budget(text).text
    except ValueError as error:
        reading.wrong((key,), f"{quoted(text or '')} is no price", str(error))
        return None


def _profile(reading: Reading, key: str, value: object) -> str | None:
    from msaa_lint.frame.devices.paths import is_path, split

    text = reading.text((key,), value, "a class of device, a device's name, or the path of a report")
    if text is None or not is_path(text):
        return text
    path, which = split(text)
    full = reading.inner_path((key,), path)
    return full and (f"{full}#{which}" if which else full)


def _rules(reading: Reading, key: str, value: object) -> tuple[str, ...] | None:
    items = reading.texts((key,), value, "path")
    if items is None:
        return None
    found = []
    for at, item in items:
        path = reading.inner_path(at, item)
        if path is not None and os.path.exists(path):
            found.append(path)
        elif path is not None:
            reading.wrong(at, f"no such file or folder {quoted(item)}")
    return tuple(found)


def _baseline(reading: Reading, key: str, value: object) -> str | None:
    text = reading.text((key,), value, "a path")
    if text is None:
        return None
    if not text.endswith(".json"):
        reading.wrong((key,), f"{quoted(text)} is no .json file")
        return None
    return reading.inner_path((key,), text)


def _limits(reading: Reading, key: str, value: object) -> dict[str, int]:
    read = {}
    for name, number in reading.table((key,), value, "a table such as {depth = 50}").items():
        if name not in LIMITS:
            reading.unknown((key, name), list(LIMITS), f"`limits` of {reading.origin.source.name}")
        elif reading.typed((key, name), number, int, "a whole number"):
            if 1 <= number <= LIMITS[name]:
                read[name] = number
            else:
                reading.wrong((key, name), f"{_number(number)} is not in 1 to {LIMITS[name]}", "a file can lower a limit, not raise it")
    return read


def _output(reading: Reading, key: str, value: object) -> tuple[str, ...] | None:
    items = reading.texts((key,), value, "output")
    if items is None:
        return None
    read = []
    for at, item in items:
        if "=" in item:
            reading.wrong(at, f"{quoted(item)} names a file", "only the command line can say what file to write")
        elif reading.one_of(at, item, OUTPUT_FORMATS):
            read.append(item)
    return tuple(read)


KEYS: dict[str, Callable[[Reading, str, Any], Any]] = {
    "edition": _edition,
    "select": _selectors,
    "extend-select": _selectors,
    "ignore": _selectors,
    "per-file-ignores": _per_file,
    "severity": _severity,
    "fail-on": _level,
    "fail-on-cost": _fail_on_cost,
    "fail-confidence": _confidence,
    "min-severity": _level,
    "profile": _profile,
    "rules": _rules,
    "exclude": _globs,
    "include": _globs,
    "baseline": _baseline,
    "limits": _limits,
    "output": _output,
}
"""What a key takes; `extends` is the one besides."""


def _number(value: int) -> str:
    # An int of more than 4300 digits has no decimal text in Python.
    return str(value) if abs(value) < 1 << 64 else "the number"


def _kind(value: object) -> str:
    names = {str: "a string", bool: "a boolean", int: "a number", float: "a number", list: "a list", dict: "a table"}
    return names.get(type(value), "a date or time")
