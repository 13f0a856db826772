"""The macros that the files of a program define for each other."""

from __future__ import annotations

import re
from collections.abc import Sequence, Set

from msaa_lint.input.code.c.macros import Definitions, Macros, merged

_WORD = re.compile(r"[A-Za-z_]\w*")


class SharedMacros:
    """The macros of the files of a program, by name; `files` are those that each file leaves
    defined.
    """

    def __init__(self, files: Sequence[Macros]) -> None:
        self._by_name: dict[str, list[tuple[int, Definitions]]] = {}
        for number, macros in enumerate(files):
            for name, definitions in macros.items():
                if definitions:
                    self._by_name.setdefault(name, []).append((number, definitions))

    def visible(self, number: int, text: str, included: Set[int]) -> dict[str, Definitions]:
        """Returns the macros that a text uses, and those that their replacements use.

        The files that it includes, directly or not, define them; otherwise any file, since not all
        includes can be followed.
        """
        visible: dict[str, Definitions] = {}
        fresh = set(_WORD.findall(text)) & self._by_name.keys()
        while fresh:
            words: set[str] = set()
            for name in fresh:
                others = [entry for entry in self._by_name[name] if entry[0] != number]
                near = [definitions for other, definitions in others if other in included]
                found = merged(
                    {name: definitions}
                    for definitions in near or [definitions for _, definitions in others]
                ).get(name, ())
                if found:
                    visible[name] = (
                        found if near else tuple(macro._replace(certain=False) for macro in found)
                    )
                    words.update(
                        word for macro in found for word in _WORD.findall(macro.replacement)
                    )
            fresh = (words & self._by_name.keys()) - visible.keys()
            fresh = {
                name for name in fresh if any(other != number for other, _ in self._by_name[name])
            }
        return visible
