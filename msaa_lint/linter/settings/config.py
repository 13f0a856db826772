"""Finds and reads the configuration that applies to a file, and the files that it extends.

The nearest folder upward with a `msaa-lint.toml`, or a `pyproject.toml` with `[tool.msaa-lint]`,
applies; in a folder with both, the former. Configurations of outer folders are not merged in.
`extends` names another file of the same project: its keys are the defaults of the file that extends
it, and the tables `severity`, `limits` and `per-file-ignores` are merged key by key.

A configuration may come from an untrusted branch. The files that it names (`extends`, `rules`,
`baseline`, `profile`) must be in its project (`project.project_root`), and so must the file itself
unless the user named it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.project import NAMES, Outside, folder_of, project_root, resolved, shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span
from msaa_lint.core.urls import is_url

from .settings import Origin, Settings

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

    from .config_keys import TableReader

VARIABLE = "MSAA_LINT_CONFIG"
MAX_BYTES = 1 << 20
MAX_CHAIN = 16

_TABLE = r"""(?m)^[ \t]*\[?[ \t]*["']?tool["']?[ \t]*(?:\.[ \t]*["']?msaa-lint|\]|=)"""


class Loaded(NamedTuple):
    """The settings of a configuration file without its invalid values.

    `path` is absolute, None without a file. `findings` are the problems of the file, `sources` the
    texts they point into, by name.
    """

    settings: Settings
    path: str | None = None
    findings: tuple[Finding, ...] = ()
    sources: Mapping[str, Source] = {}


class Configurations:
    """The configuration files of one run. Each folder is searched once and each file is read once.

    `explicit`, or else MSAA_LINT_CONFIG, is the path of the only configuration file to use;
    `isolated` uses none.
    """

    def __init__(self, explicit: str | None = None, isolated: bool = False) -> None:
        self._only: Loaded | None = None
        self._by_folder: dict[str, Loaded | None] = {}
        self._default = Loaded(Settings(root=os.getcwd()))
        path = explicit or os.environ.get(VARIABLE)
        if isolated:
            self._only = self._default
        elif path:
            self._only = _read_named(os.path.abspath(path))

    def load(self, path: str) -> Loaded:
        """The configuration that applies to a file or folder; that of the current folder to a
        URL.
        """
        if self._only is not None:
            return self._only
        start = os.path.abspath(os.curdir if is_url(path) else path)
        folder = start if os.path.isdir(start) else os.path.dirname(start)
        searched = []
        while folder not in self._by_folder:
            searched.append(folder)
            found = read_folder(folder)
            above = os.path.dirname(folder)
            if found is not None or above == folder:
                self._by_folder[folder] = found
                break
            folder = above
        loaded = self._by_folder[folder]
        self._by_folder.update(dict.fromkeys(searched, loaded))
        return loaded or self._default

    def candidates(self, path: str) -> Iterator[str]:
        """The files of its project that apply to a file or folder, or would in place of the one
        that does if they existed.
        """
        if self._only is not None:
            return
        start = os.path.abspath(path)
        folder = start if os.path.isdir(start) else os.path.dirname(start)
        applies, root = self.load(path).path, project_root(folder)
        while True:
            yield from (os.path.join(folder, name) for name in NAMES)
            above = os.path.dirname(folder)
            if (
                above == folder
                or os.path.realpath(folder) == root
                or (applies is not None and folder == os.path.dirname(applies))
            ):
                return
            folder = above


class KnownConfigurations:
    """Configurations that were found elsewhere, by path, and the path of the one that applies."""

    def __init__(self, configurations: Mapping[str | None, Loaded], current: str | None) -> None:
        self._configurations = configurations
        self.current = current

    def load(self, path: str) -> Loaded:
        """The configuration that applies."""
        return self._configurations[self.current]


def _read_named(path: str) -> Loaded:
    text = _text(path, None)
    if isinstance(text, Finding):
        return Loaded(Settings(root=os.path.dirname(path)), path, (text,))
    from .toml_text import parsed

    return _read(path, text, parsed(text, shown(path)))


def read_folder(folder: str) -> Loaded | None:
    """The configuration in a folder itself; None if it has none."""
    for name in NAMES:
        path = os.path.join(folder, name)
        if not os.path.lexists(path) or (os.path.isdir(path) and not os.path.islink(path)):
            continue
        text = _text(path, project_root(folder))
        if isinstance(text, Finding):
            if name == NAMES[0] or os.path.islink(path):
                return Loaded(Settings(root=folder), path, (text,))
            continue
        if name == NAMES[1] and not ("msaa-lint" in text and re.search(_TABLE, text)):
            continue
        from .toml_text import parsed

        table = parsed(text, shown(path))
        if name == NAMES[0] or _has_table(text, table):
            return _read(path, text, table)
    return None


def _has_table(text: str, table: Mapping[str, Any] | Finding) -> bool:
    """Whether a pyproject.toml has the table `[tool.msaa-lint]`, even if its TOML is invalid."""
    if isinstance(table, Finding):
        return "tool.msaa-lint" in text.replace(" ", "").replace('"', "")
    return "msaa-lint" in _tool(table)


def _text(path: str, project: str | None) -> str | Finding:
    """The text of a configuration file, or a finding that says why it cannot be read. `project` is
    None for one that the user named.
    """
    from msaa_lint.core.text.files import read
    from msaa_lint.core.text.source import decode

    try:
        return decode(read(path, MAX_BYTES, project))
    except FileNotFoundError:
        reason = "no such file"
    except Outside as error:
        reason = f"{error}; pass it with --config to use it"
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return diagnostic("MSAA921", f"cannot read the configuration: {reason}", shown(path))


def _tool(table: Mapping[str, Any]) -> Mapping[str, Any]:
    tool = table.get("tool")
    return tool if isinstance(tool, dict) else {}


def _read(path: str, text: str, table: dict[str, Any] | Finding) -> Loaded:
    """The settings of a parsed configuration file and of the files that it extends."""
    from msaa_lint.core.text.source import Source

    from .config_keys import TableReader
    from .toml_text import parsed

    folder = os.path.abspath(folder_of(path))
    root = project_root(folder)
    layers: list[tuple[dict[str, Any], Origin]] = []
    findings: list[Finding] = []
    sources: dict[str, Source] = {}
    chain: list[str] = []
    current: str | None = path
    while current is not None:
        name = shown(current)
        chain.append(resolved(current))
        source = sources[name] = Source(name, text)
        if isinstance(table, Finding):
            findings.append(table)
            break
        origin = Origin(
            source, ("tool", "msaa-lint") if os.path.basename(current) == NAMES[1] else ()
        )
        keys = _tool(table).get("msaa-lint") if origin.table else table
        if not isinstance(keys, dict):
            message = (
                "the configuration has no table [tool.msaa-lint]"
                if keys is None
                else "[tool.msaa-lint] is not a table; write `[tool.msaa-lint]` and its keys below"
            )
            findings.append(origin.finding((), message))
            break
        reader = TableReader(origin, folder if current == path else os.path.dirname(current), root)
        reader.read(keys)
        current = _extended(reader, keys, chain)
        findings.extend(sorted(reader.findings, key=lambda finding: finding.span or Span(0, 0)))
        layers.append((reader.values, origin))
        if current is not None:
            extended = _text(current, root)
            if isinstance(extended, Finding):
                findings.append(
                    origin.finding(("extends",), f"{extended.message}: {shown(current)}")
                )
                break
            text = extended
            table = parsed(text, shown(current))
    return Loaded(_merged(layers, folder), path, tuple(findings), sources)


def _extended(reader: TableReader, table: Mapping[str, Any], chain: list[str]) -> str | None:
    """The path of the file that a file extends; None if it extends none or names an invalid one."""
    if "extends" not in table:
        return None
    text = reader.string(("extends",), table["extends"], "the path of a .toml file")
    if text is None:
        return None
    if not text.endswith(".toml"):
        reader.problem(
            ("extends",), f"{quoted(text)} is not a .toml file", "write a name that ends in .toml"
        )
        return None
    path = reader.project_path(("extends",), text)
    if path is None:
        return None
    real = resolved(path)
    if real in chain:
        cycle = " > ".join(shown(each) for each in [*chain[chain.index(real) :], real])
        reader.problem(("extends",), f"cycle {cycle}")
    elif len(chain) >= MAX_CHAIN:
        reader.problem(("extends",), f"chain of more than {MAX_CHAIN} files")
    elif not os.path.lexists(path):
        reader.problem(
            ("extends",),
            f"no such file {quoted(text)}",
            "write a path relative to the folder of the configuration",
        )
    else:
        return path
    return None


def _merged(layers: Sequence[tuple[dict[str, Any], Origin]], folder: str) -> Settings:
    """The settings of a chain of files, from their values; a file comes before the one that it
    extends.
    """
    values: dict[str, Any] = {}
    origins: dict[tuple[str, ...], Origin] = {}
    for layer, origin in reversed(layers):
        for key, value in layer.items():
            origins[(key,)] = origin
            if isinstance(value, dict):
                values[key] = {**values.get(key, {}), **value}
                origins.update(((key, name), origin) for name in value)
            else:
                values[key] = value
    if "per-file-ignores" in values:
        values["per-file-ignores"] = tuple(values["per-file-ignores"].values())
    return Settings(
        **{key.replace("-", "_"): value for key, value in values.items()},
        root=folder,
        origin=origins,
    )
