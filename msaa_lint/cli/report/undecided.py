"""Undecided rules: the keys of the description that they lack."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from msaa_lint.core.finding import MissingKey, Result, Undecided

from . import Options
from .escape import display
from .inputs import SOURCE
from .paths import display_path
from .place import place

MAX_SUBJECTS = 3
"""The places that an explanation names for one rule and one kind of key."""

MAX_LINES = 200

_SECTION = re.compile(
    r"\b(images|renderPasses|framebuffers|pipelines|sampleCountChoices|textures|renderPipelines|attachments)\.(?:[^.\[\]]+)(?=[.\[])"
)
_INDEX = re.compile(r"\[\d+\]")


def pattern(key: MissingKey) -> str:
    """The path of a key for all structures of its kind: `images.*.usage`."""
    return _pattern(key.path)


@lru_cache(maxsize=4096)
def _pattern(path: str) -> str:
    return _INDEX.sub("[*]", _SECTION.sub(r"\1.*", path))


def explanation(result: Result, options: Options) -> Iterator[str]:
    """For each undecided rule a line for each key that it lacks, with the places of the first
    structures that lack it.
    """
    by_rule: dict[
        tuple[str, str], dict[tuple[str, str], list[tuple[Undecided, MissingKey | None]]]
    ] = {}
    for entry in result.undecided:
        keys = by_rule.setdefault((entry.code, entry.rule), {})
        for key in entry.keys:
            keys.setdefault((entry.file, pattern(key)), []).append((entry, key))
        if not entry.keys:
            keys.setdefault((entry.file, ""), []).append((entry, None))
    room = MAX_LINES
    for (code, rule), keys in sorted(by_rule.items()):
        for (file, _), entries in keys.items():
            lacking = list(dict.fromkeys(key for _, key in entries))
            name = f"{display(rule)} ({display(code)})"
            lines = [
                _line(file, entries[0][0], key, name, result, options)
                for key in lacking[:MAX_SUBJECTS]
            ]
            if len(lacking) > MAX_SUBJECTS:
                lines.append(
                    f"{display_path(file, options.root)}: undecided: {name}: the same for "
                    f"{len(lacking) - MAX_SUBJECTS} more"
                )
            room -= len(lines)
            if room >= 0:
                yield from lines
    if room < 0:
        yield f"{-room} more lines not shown; --output json lists all keys"
    for each in result.inputs:
        if each.format in SOURCE:
            name = display_path(each.file, options.root)
            yield (
                f"{name}: undecided rules of source code are not listed; complete the "
                "description that `msaa-lint convert` writes"
            )


def _line(
    file: str, entry: Undecided, key: MissingKey | None, rule: str, result: Result, options: Options
) -> str:
    where = display_path(file, options.root)
    if key is None:
        return (
            f"{where}: undecided: {rule}: no single key decides it for `{display(entry.subject)}`"
        )
    at = place(result, file, key.span)
    if at is not None:
        where += f":{at.line}:{at.column}"
    structure = f"`{display(key.structure)}`" if key.structure else "the description"
    if key.name == "device":
        structure += " (or use `--profile`)"
    elif key.converted:
        structure += " in what `msaa-lint convert` writes"
    return (
        f"{where}: undecided: {rule}: add `{display(key.name)}` to {structure}: "
        f"{display(key.values)}"
    )
