"""Finds and reads the configuration of a file: the nearest one upwards, and what it extends.

The nearest folder that has a `msaa-lint.toml`, or a `pyproject.toml` with `[tool.msaa-lint]`, governs; where it has both, the former.
Nothing is merged on the way up. `extends` names another file of the same project: what it says comes first, the keys of the file that
extends it win, and tables (`severity`, `limits`, `per-file-ignores`) are joined key by key.

A configuration may come from a stranger's branch. So what it names (`extends`, `rules`, `baseline`) must lie in the project with all
symbolic links followed (`project.project_root`), and so must the file itself where it was found and not named.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.project import NAMES, inside, project_root, shown
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span

from .selectors import unknown_selectors
from .settings import Origin, Settings, override

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source

    from .config_keys import Reading

__all__ = ["Loaded", "Settings", "forget", "load", "override", "unknown_selectors"]

VARIABLE = "MSAA_LINT_CONFIG"
MAX_BYTES = 1 << 20
MAX_CHAIN = 16

_TABLE = r"""(?m)^[ \t]*\[?[ \t]*["']?tool["']?[ \t]*(?:\.[ \t]*["']?msaa-lint|\]|=)"""


class Loaded(NamedTuple):
    """The settings that govern a file, the configuration file they are of (absolute; None: there is none), what is wrong with it, and
    the texts that these findings point into, by name. What is wrong is left out of the settings."""

    settings: Settings
    path: str | None = None
    findings: tuple[Finding, ...] = ()
    sources: Mapping[str, Source] = {}


_by_folder: dict[str, Loaded | None] = {}
_by_file: dict[str, Loaded] = {}


def forget() -> None:
    """Reads every configuration anew from here on."""
    _by_folder.clear()
    _by_file.clear()


def load(for_path: str, explicit: str | None = None, isolated: bool = False) -> Loaded:
    """What governs a file or folder.

    `explicit` (else MSAA_LINT_CONFIG) is the path of the one configuration file, whatever lies around the linted file; `isolated`
    takes none at all. Each folder is looked into once until `forget`.
    """
    if isolated:
        return _nothing()
    explicit = explicit or os.environ.get(VARIABLE) or None
    if explicit is not None:
        return _named(explicit)
    start = os.path.abspath(for_path)
    folder = start if os.path.isdir(start) else os.path.dirname(start)
    passed = []
    found = None
    while True:
        if folder in _by_folder:
            found = _by_folder[folder]
            break
        passed.append(folder)
        found = _in_folder(folder)
        above = os.path.dirname(folder)
        if found is not None or above == folder:
            break
        folder = above
    for each in passed:
        _by_folder[each] = found
    return found or _nothing()


def _nothing() -> Loaded:
    return Loaded(Settings(root=os.getcwd()))


def _named(path: str) -> Loaded:
    full = os.path.abspath(path)
    if full not in _by_file:
        text = _text(full)
        if isinstance(text, str):
            from .toml_text import parsed

            _by_file[full] = _read(full, text, parsed(text, shown(full)))
        else:
            _by_file[full] = Loaded(Settings(root=os.path.dirname(full)), full, (text,))
    return _by_file[full]


def _in_folder(folder: str) -> Loaded | None:
    for name in NAMES:
        path = os.path.join(folder, name)
        if not os.path.isfile(path):
            continue
        if os.path.islink(path) and not inside(path, project_root(folder)):
            message, help = "the configuration is a link that leaves the project", "name it with --config to use it"
            return Loaded(Settings(root=folder), path, (diagnostic("MSAA921", message, shown(path), help=help),))
        text = _text(path)
        if not isinstance(text, str):
            if name == NAMES[0]:
                return Loaded(Settings(root=folder), path, (text,))
            continue
        if name == NAMES[1] and not ("msaa-lint" in text and re.search(_TABLE, text)):
            continue
        from .toml_text import parsed

        table = parsed(text, shown(path))
        if name == NAMES[0] or _is_ours(text, table):
            return _read(path, text, table)
    return None


def _is_ours(text: str, table: Mapping[str, Any] | Finding) -> bool:
    """Whether a pyproject.toml has our table, or would if it could be read."""
    if isinstance(table, Finding):
        return "tool.msaa-lint" in text.replace(" ", "").replace('"', "")
    return "msaa-lint" in _tool(table)


def _text(path: str) -> str | Finding:
    """A configuration file's text, or why it cannot be had."""
    from msaa_lint.core.text.source import Unreadable, decode

    try:
        with open(path, "rb") as file:
            data = file.read(MAX_BYTES + 1)
        if len(data) > MAX_BYTES:
            raise Unreadable(f"a configuration file has at most {MAX_BYTES} bytes")
        return decode(data)
    except FileNotFoundError:
        reason = "no such file"
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return diagnostic("MSAA921", f"the configuration cannot be read: {reason}", shown(path))


def _tool(table: Mapping[str, Any]) -> Mapping[str, Any]:
    tool = table.get("tool")
    return tool if isinstance(tool, dict) else {}


class _Layer(NamedTuple):
    """One file of a chain of `extends`, as it was read."""

    values: dict[str, Any]
    origin: Origin


def _read(path: str, text: str, table: dict[str, Any] | Finding) -> Loaded:
    """A configuration file, as it was parsed, and what it extends."""
    from msaa_lint.core.text.source import Source

    from .config_keys import Reading
    from .toml_text import parsed

    folder = os.path.dirname(path)
    root = project_root(folder)
    layers: list[_Layer] = []
    findings: list[Finding] = []
    sources: dict[str, Source] = {}
    chain: list[str] = []
    current: str | None = path
    while current is not None:
        name = shown(current)
        chain.append(os.path.realpath(current))
        source = sources[name] = Source(name, text)
        if isinstance(table, Finding):
            findings.append(table)
            break
        origin = Origin(source, ("tool", "msaa-lint") if os.path.basename(current) == NAMES[1] else ())
        keys = _tool(table).get("msaa-lint") if origin.table else table
        if not isinstance(keys, dict):
            what = "the configuration has no [tool.msaa-lint]" if keys is None else "[tool.msaa-lint] is no table"
            findings.append(origin.wrong((), what))
            break
        reading = Reading(origin, os.path.dirname(current), lambda target: inside(target, root))
        reading.read(keys)
        current = _extended(reading, keys, chain)
        findings.extend(sorted(reading.problems, key=lambda each: each.span or Span(0, 0)))
        layers.append(_Layer(reading.values, origin))
        if current is not None:
            read = _text(current)
            if isinstance(read, Finding):
                findings.append(origin.wrong(("extends",), f"{read.message}: {shown(current)}"))
                break
            text = read
            table = parsed(text, shown(current))
    return Loaded(_settled(layers, folder), path, tuple(findings), sources)


def _extended(reading: Reading, table: Mapping[str, Any], chain: list[str]) -> str | None:
    """The file that a file extends; None where it extends none, or none that can be."""
    if "extends" not in table:
        return None
    text = reading.text(("extends",), table["extends"], "the path of a .toml file")
    if text is None:
        return None
    if not text.endswith(".toml"):
        reading.wrong(("extends",), f"{quoted(text)} is no .toml file")
        return None
    path = reading.inner_path(("extends",), text)
    if path is None:
        return None
    real = os.path.realpath(path)
    if real in chain:
        circle = " > ".join(shown(each) for each in [*chain[chain.index(real) :], real])
        reading.wrong(("extends",), f"a circle ({circle})")
        return None
    if len(chain) >= MAX_CHAIN:
        reading.wrong(("extends",), f"more than {MAX_CHAIN} files extend each other")
        return None
    if not os.path.isfile(path):
        reading.wrong(("extends",), f"no such file {quoted(text)}")
        return None
    return path


def _settled(layers: list[_Layer], folder: str) -> Settings:
    """The settings of a chain of files, the one that extends the others first."""
    values: dict[str, Any] = {}
    origins: dict[tuple[str, ...], Origin] = {}
    for layer in reversed(layers):
        for key, value in layer.values.items():
            origins[(key,)] = layer.origin
            if isinstance(value, dict):
                values[key] = {**values.get(key, {}), **value}
                origins.update(((key, name), layer.origin) for name in value)
            else:
                values[key] = value
    if "per-file-ignores" in values:
        values["per-file-ignores"] = tuple(values["per-file-ignores"].values())
    return Settings(**{key.replace("-", "_"): value for key, value in values.items()}, root=folder, origin=origins)
