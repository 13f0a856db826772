"""Reads and checks the keys of a configuration file."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding
from msaa_lint.core.globs import Glob
from msaa_lint.core.project import Outside, real_path
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import near_or_all
from msaa_lint.core.text.tree import Limits

from .settings import OUTPUT_FORMATS, Origin

LEVELS = tuple(reversed(SEVERITIES))
MAX_LIMITS = Limits()._asdict()
"""A configuration file can only lower the limits."""

MAX_ITEMS = 1000
"""Of a list or table: a configuration may come from an untrusted branch."""

MAX_GLOBS = 200
MAX_FINDINGS = 50
"""Of one file."""

SELECTOR = re.compile(r"[A-Za-z][A-Za-z0-9-]{0,99}\Z")
WEB_ADDRESS = re.compile(
    r"https?://[A-Za-z0-9][A-Za-z0-9.-]*(:[0-9]{1,5})?(/[A-Za-z0-9._~!$&'()*+,;=:@%-]*)*"
)
"""Of a site or folder: no user name, query, or fragment, so that a page's path can follow it."""

MAX_ADDRESS = 500
_TYPE_NAMES = {
    str: "a string",
    bool: "a boolean",
    int: "a number",
    float: "a number",
    list: "a list",
    dict: "a table",
}

Path = tuple[str | int, ...]


class TableReader:
    """Reads the table of one configuration file: valid values go to `values` by key, and problems
    to `findings`.

    `root` is the folder that paths are relative to, and `project` the one that they must stay in.
    """

    def __init__(self, origin: Origin, root: str, project: str) -> None:
        self.origin = origin
        self.root = root
        self.project = project
        self.values: dict[str, Any] = {}
        self.findings: list[Finding] = []

    def read(self, table: Mapping[str, Any]) -> None:
        """Reads every key but `extends`, whose chain the caller follows."""
        name = self.origin.source.name
        where = f"[{'.'.join(self.origin.table)}] of {name}" if self.origin.table else name
        for key, value in table.items():
            if key == "extends":
                continue
            read = KEYS.get(key)
            if read is None:
                self.unknown_key((key,), [*KEYS, "extends"], where)
                continue
            result = read(self, (key,), value)
            if result is not None:
                self.values[key] = result

    def problem(self, path: Path, message: str, hint: str = "", at_key: bool = False) -> None:
        """Adds a finding about the value at a path."""
        if len(self.findings) < MAX_FINDINGS:
            self.findings.append(self.origin.problem(path, message, hint, at_key))

    def unknown_key(self, path: tuple[str, ...], known: Sequence[str], where: str) -> None:
        """Adds a finding about a key that the table at `where` does not have."""
        if len(self.findings) >= MAX_FINDINGS:
            return
        hint = near_or_all(path[-1], known)
        if path == ("tool",) and not self.origin.table:
            hint = (
                "in this file the keys are at the top level, without [tool.msaa-lint]; remove "
                "that line"
            )
        self.findings.append(
            self.origin.finding(
                path, f"unknown key {quoted(path[-1])} in {where}: {hint}", at_key=True
            )
        )

    def has_type(self, path: Path, value: object, type_: type, expected: str) -> bool:
        """Whether a value has a type; a boolean is not a number."""
        if isinstance(value, type_) and not (type_ is int and isinstance(value, bool)):
            return True
        self.problem(
            path, f"expected {expected}, found {_TYPE_NAMES.get(type(value), 'a date or time')}"
        )
        return False

    def string(self, path: Path, value: Any, expected: str) -> str | None:
        """A string that is not blank."""
        if not self.has_type(path, value, str, expected):
            return None
        if not value.strip():
            self.problem(path, f"expected {expected}, found an empty string")
        elif "\0" in value:
            self.problem(path, f"expected {expected}, found a NUL character")
        else:
            return str(value)
        return None

    def strings(self, path: Path, value: Any, expected: str) -> list[tuple[Path, str]] | None:
        """The strings of a list, each with its path."""
        if not self.has_type(path, value, list, f"a list of {expected}s") or not self.at_most(
            path, len(value), MAX_ITEMS
        ):
            return None
        article = "an" if expected[0] in "aeiou" else "a"
        items = [
            ((*path, i), self.string((*path, i), item, f"{article} {expected}"))
            for i, item in enumerate(value)
        ]
        return [(at, item) for at, item in items if item is not None]

    def table(
        self, path: Path, value: Any, expected: str, limit: int = MAX_ITEMS
    ) -> dict[str, Any]:
        if not self.has_type(path, value, dict, expected) or not self.at_most(
            path, len(value), limit
        ):
            return {}
        return dict(value)

    def at_most(self, path: Path, count: int, limit: int) -> bool:
        if count > limit:
            self.problem(path, f"expected at most {limit} elements, found {count}")
        return count <= limit

    def word(self, path: Path, value: Any, words: Sequence[str]) -> str | None:
        """One of some words."""
        if not self.has_type(path, value, str, f"one of {', '.join(words)}"):
            return None
        if value in words:
            return str(value)
        self.problem(path, f"unknown value {quoted(value)}", near_or_all(value, words))
        return None

    def selectors(self, path: Path, value: Any) -> tuple[str, ...] | None:
        items = self.strings(path, value, "rule")
        return (
            None
            if items is None
            else tuple(item for at, item in items if self.is_selector(at, item))
        )

    def is_selector(self, path: Path, item: str, at_key: bool = False) -> bool:
        if SELECTOR.match(item):
            return True
        hint = "expected a rule name, a code, a code prefix such as MSAA2, or ALL"
        self.problem(path, f"{quoted(item)} is not a rule selector", hint, at_key)
        return False

    def glob(self, path: Path, item: str, at_key: bool = False) -> Glob | None:
        from msaa_lint.core.globs import compiled

        try:
            compiled(item)
        except ValueError as error:
            self.problem(path, f"invalid glob {quoted(item)}", str(error), at_key)
            return None
        return Glob(item, self.root)

    def globs(self, path: Path, value: Any) -> tuple[Glob, ...] | None:
        items = self.strings(path, value, "glob")
        if items is None or not self.at_most(path, len(items), MAX_GLOBS):
            return None
        globs = [self.glob(at, item) for at, item in items]
        return tuple(glob for glob in globs if glob is not None)

    def project_path(self, path: Path, item: str) -> str | None:
        """The absolute path of a file that must be in the project."""
        try:
            real_path(os.path.join(self.root, item), self.project)
        except Outside:
            self.problem(
                path,
                f"{quoted(item)} is outside the project",
                "only the command line can name such a file",
            )
        except OSError as error:
            self.problem(
                path,
                f"{quoted(item)} cannot be read: {error}",
                "write a path relative to the folder of the configuration",
            )
        else:
            return os.path.normpath(os.path.join(self.root, item))
        return None

    def severities(self, path: Path, value: Any) -> dict[str, str]:
        table = self.table(path, value, 'a table such as {MSAA2 = "note"}')
        words = (*LEVELS, "off")
        levels = {
            name: self.word((*path, name), level, words)
            for name, level in table.items()
            if self.is_selector((*path, name), name, True)
        }
        return {name: level for name, level in levels.items() if level is not None}

    def per_file_ignores(self, path: Path, value: Any) -> dict[str, tuple[Glob, tuple[str, ...]]]:
        ignores: dict[str, tuple[Glob, tuple[str, ...]]] = {}
        for name, rules in self.table(
            path, value, 'a table such as {"tests/**" = ["MSAA2"]}', MAX_GLOBS
        ).items():
            glob, selectors = (
                self.glob((*path, name), name, True),
                self.selectors((*path, name), rules),
            )
            if glob is not None and selectors is not None:
                ignores[name] = (glob, selectors)
        return ignores

    def edition(self, path: Path, value: Any) -> str | None:
        from msaa_lint.linter.rules.rule import EDITIONS

        if isinstance(value, float):
            self.problem(path, "expected a string, found a number", f'write edition = "{value}"')
            return None
        return self.word(path, value, EDITIONS)

    def fail_on_cost(self, path: Path, value: Any) -> str | None:
        from .cost_limit import budget

        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        text = str(value) if is_number else self.string(path, value, "a cost such as 50MB/s")
        try:
            return None if text is None else budget(text).text
        except ValueError as error:
            self.problem(path, f"invalid cost {quoted(text or '')}", str(error))
            return None

    def profile(self, path: Path, value: Any) -> str | None:
        from msaa_lint.frame.devices.paths import is_path, split

        text = self.string(
            path, value, "a device class, a device name, or the path of a device report"
        )
        if text is None or not is_path(text):
            return text
        report, device = split(text)
        full = self.project_path(path, report)
        return full and (f"{full}#{device}" if device else full)

    def rules(self, path: Path, value: Any) -> tuple[str, ...] | None:
        items = self.strings(path, value, "path")
        if items is None:
            return None
        paths = []
        for at, item in items:
            full = self.project_path(at, item)
            if full is not None and os.path.exists(full):
                paths.append(full)
            elif full is not None:
                self.problem(
                    at,
                    f"no such file or folder {quoted(item)}",
                    "write a path relative to the folder of the configuration",
                )
        return tuple(paths)

    def baseline(self, path: Path, value: Any) -> str | None:
        text = self.string(path, value, "a path")
        if text is None:
            return None
        if not text.endswith(".json"):
            self.problem(
                path, f"{quoted(text)} is not a .json file", "write a name that ends in .json"
            )
            return None
        return self.project_path(path, text)

    def docs_url(self, path: Path, value: Any) -> str | None:
        """The address of a site, without a slash at its end; empty for no links."""
        expected = "the address of the documentation, such as https://example.com/msaa-lint"
        if value == "":
            return ""
        text = self.string(path, value, expected)
        if text is None or (len(text) <= MAX_ADDRESS and WEB_ADDRESS.fullmatch(text)):
            return text and text.rstrip("/")
        hint = (
            f"expected {expected}, of at most {MAX_ADDRESS} characters, without user name, "
            "query, and fragment; or an empty string"
        )
        self.problem(path, f"{quoted(text)} is not an http or https address", hint)
        return None

    def flag(self, path: Path, value: Any) -> bool | None:
        return bool(value) if self.has_type(path, value, bool, "true or false") else None

    def limits(self, path: Path, value: Any) -> dict[str, int]:
        limits = {}
        for name, number in self.table(path, value, "a table such as {depth = 50}").items():
            if name not in MAX_LIMITS:
                self.unknown_key(
                    ("limits", name), list(MAX_LIMITS), f"`limits` of {self.origin.source.name}"
                )
            elif self.has_type((*path, name), number, int, "an integer"):
                if 1 <= number <= MAX_LIMITS[name]:
                    limits[name] = number
                else:
                    # Python converts no integer of more than 4300 digits to decimal.
                    shown = f"`{number}`" if abs(number) < 1 << 64 else "a longer number"
                    message = (
                        f"`{name}` must be an integer from 1 to {MAX_LIMITS[name]}, found {shown}"
                    )
                    self.problem(
                        (*path, name), message, "a configuration file can only lower limits"
                    )
        return limits

    def source(self, path: Path, value: Any) -> dict[str, bool | int | str] | None:
        """The table `[source]`, whose only key is `assume`."""
        assumptions: dict[str, bool | int | str] | None = None
        for name, table in self.table(
            path, value, 'a table such as {assume = {"settings.samples" = 4}}'
        ).items():
            if name == "assume":
                assumptions = self.assumptions((*path, name), table)
            else:
                self.unknown_key(
                    ("source", name), ["assume"], f"`source` of {self.origin.source.name}"
                )
        return assumptions

    def assumptions(self, path: Path, value: Any) -> dict[str, bool | int | str]:
        from msaa_lint.input.code.assumptions import problem_of, value_of

        assumptions: dict[str, bool | int | str] = {}
        for name, entry in self.table(
            path, value, 'a table such as {"settings.samples" = 4}'
        ).items():
            is_scalar = isinstance(entry, (bool, int, str))
            text = str(entry).lower() if isinstance(entry, bool) else str(entry)[:200]
            stated = value_of(text) if is_scalar else None
            known = name.replace("->", ".").removeprefix("this.")
            problem = problem_of(known, stated, text)
            if problem or stated is None:
                self.problem(
                    (*path, name),
                    problem,
                    'write a table such as {"settings.samples" = 4, ENGINE_MSAA = true}',
                    "not a name" in problem,
                )
            else:
                assumptions[known] = stated
        return assumptions

    def outputs(self, path: Path, value: Any) -> tuple[str, ...] | None:
        items = self.strings(path, value, "output")
        if items is None:
            return None
        outputs = []
        for at, item in items:
            if "=" in item:
                self.problem(
                    at,
                    f"{quoted(item)} names a file",
                    "only the command line can name output files",
                )
            elif self.word(at, item, OUTPUT_FORMATS):
                outputs.append(item)
        return tuple(outputs)


KEYS: dict[str, Callable[[TableReader, Path, Any], Any]] = {
    "edition": TableReader.edition,
    "select": TableReader.selectors,
    "extend-select": TableReader.selectors,
    "ignore": TableReader.selectors,
    "per-file-ignores": TableReader.per_file_ignores,
    "severity": TableReader.severities,
    "fail-on": partial(TableReader.word, words=LEVELS),
    "fail-on-cost": TableReader.fail_on_cost,
    "fail-confidence": partial(TableReader.word, words=CONFIDENCES),
    "min-severity": partial(TableReader.word, words=LEVELS),
    "profile": TableReader.profile,
    "rules": TableReader.rules,
    "exclude": TableReader.globs,
    "include": TableReader.globs,
    "respect-gitignore": TableReader.flag,
    "strict-inputs": TableReader.flag,
    "baseline": TableReader.baseline,
    "limits": TableReader.limits,
    "source": TableReader.source,
    "output": TableReader.outputs,
    "docs-url": TableReader.docs_url,
}
"""The method that reads each key; None from it leaves the key unset."""
