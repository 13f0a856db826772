"""Says why a sample count in source code is unknown: the first name on the way to its value that
nothing gives one.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.quote import quoted

from .creations import blanked
from .parsing import Code

MAX_STEPS = 8
"""The number of names that are followed from a sample count to the first unknown one."""

MAX_CHARACTERS = 1 << 23
"""The number of characters that are searched for the names of one program."""

MAX_OCCURRENCES = 2000
"""The number of uses of a name that are looked at."""

_CAST = re.compile(
    r"\(\s*(?:const\s+)?(?:Vk\w+|vk::[\w:]+|u?int\w*|unsigned)\s*\)\s*|static_cast<[^<>]*>\s*|^[&*(\s]+"
)
_PATH = re.compile(
    r"(?<!\w)(?P<path>(?:this->)?[A-Za-z_]\w*(?:(?:\.|->|::)[A-Za-z_]\w*|\[[^\[\]]{0,40}\])*)\s*(?P<call>\()?"
)
_KNOWN = re.compile(r"(?:VK_|vk::|MTL|\.)\w|(?:true|false|nullptr|NULL|nil)\b")
_LAST = re.compile(r"[A-Za-z_]\w*(?=(?:\[[^\]]*\])*\Z)")
_MACRO = re.compile(r"[A-Z][A-Z0-9_]{2,}\Z")
_DEFINE = re.compile(r"#[ \t]*define[ \t]+\Z")
_ASSIGNED = re.compile(r"[ \t]*=(?!=)\s*([^;\n]{1,200})")
_OBJECT = re.compile(r"([A-Za-z_]\w*)(?:\(\)|\[[^\[\]]{0,40}\])?\s*(\.|->|::)\s*\Z")
_DECLARED = re.compile(
    r"([A-Za-z_][\w:]*(?:<[^<>]{0,80}>)?)(?:[ \t]+|[ \t]*[*&]+[ \t]*)(?:\w+::)*\Z"
)
_BODY = re.compile(r"[ \t]*\([^;{}]{0,200}\)[\w \t\n]{0,40}\{([^{}]{0,300})")
_KEYWORD = re.compile(r"(?:return|else|case|goto|new|delete|typedef|using|throw|sizeof)\b")


class SearchedFile(NamedTuple):
    """A file of a program: its name, and its code."""

    name: str
    codes: Sequence[Code]


class Unknown(NamedTuple):
    """A name whose value is unknown, as an assumption names it, and the reason in words."""

    name: str
    reason: str


class _Definition(NamedTuple):
    """Where a name is declared, what it is set to (empty if nothing sets it), and whether it is a
    variable, a parameter, or a function.
    """

    place: str
    values: tuple[str, ...]
    kind: str


class Unknowns:
    """Searches the files of one program for what gives names their values."""

    def __init__(self, files: Sequence[SearchedFile]) -> None:
        self._files = files
        self._texts: dict[int, str] = {}
        self._left = MAX_CHARACTERS
        self._definitions: dict[tuple[str, str], _Definition | None] = {}

    def first(self, value: str) -> Unknown | None:
        """Returns the first unknown on the way to a value; None if there is none, or none is
        found.
        """
        seen: set[str] = set()
        for _ in range(MAX_STEPS):
            path, is_call = _name_in(value)
            last = _LAST.search(path)
            if last is None or last[0] in seen:
                return None
            seen.add(last[0])
            owners = re.findall(r"\w+", path[: last.start()])
            definition = self._definition(owners[-1] if owners else "", last[0])
            if self._left < 0:
                return None
            name = f"{path}()" if is_call else path
            if definition is not None and len(set(definition.values)) == 1:
                value = definition.values[0]
                continue
            return Unknown(name, f"{quoted(name)} {_reason(definition, last[0], is_call)}")
        return None

    def _definition(self, owner: str, name: str) -> _Definition | None:
        key = (owner, name)
        if key not in self._definitions:
            self._definitions[key] = self._search(owner, name)
        return self._definitions[key]

    def _search(self, owner: str, name: str) -> _Definition | None:
        """What the files say about a name, of an object `owner` if there is one."""
        place, kind = "", "variable"
        values: list[str] = []
        occurrences = 0
        for number, file in enumerate(self._files):
            if not any(name in code.text for code in file.codes):
                continue
            text = self._text(number)
            for match in re.finditer(rf"\b{re.escape(name)}\b", text):
                occurrences += 1
                if occurrences > MAX_OCCURRENCES:
                    return None
                start = text.rfind("\n", 0, match.start()) + 1
                before, after = (
                    text[max(start, match.start() - 200) : match.start()],
                    text[match.end() : match.end() + 400],
                )
                found = _use(before, after, owner)
                if found is None:
                    continue
                found_kind, found_values = found
                values += found_values
                if found_kind and not place:
                    place, kind = f"{file.name}:{text.count(chr(10), 0, start) + 1}", found_kind
        return _Definition(place, tuple(values), kind) if place or values else None

    def _text(self, number: int) -> str:
        if number not in self._texts:
            self._left -= sum(len(code.text) for code in self._files[number].codes)
            # Of a page, the code in its first language.
            self._texts[number] = (
                "".join(blanked(code) for code in self._files[number].codes[:1])
                if self._left >= 0
                else ""
            )
        return self._texts[number]


def _reason(definition: _Definition | None, name: str, is_call: bool) -> str:
    if definition is None:
        return (
            f"is {'defined' if is_call or _MACRO.match(name) else 'declared'} nowhere in what "
            "was read"
        )
    verb = "defined" if definition.kind == "function" else "declared"
    declared = f"{verb} in {definition.place}" if definition.place else f"{verb} elsewhere"
    if definition.values:
        return f"is {declared}, and has several values"
    if definition.kind == "function":
        return f"is {declared}, and returns what is not known"
    return (
        f"is {declared}, as a parameter"
        if definition.kind == "parameter"
        else f"is {declared}, and set nowhere in what was read"
    )


def _use(before: str, after: str, owner: str) -> tuple[str, list[str]] | None:
    """What a use of a name states: the kind of its declaration (empty: none), and values that it is
    set to. None for another use.
    """
    if _DEFINE.search(before):
        return "variable", [after.partition("\n")[0].strip()] if after.partition("\n")[
            0
        ].strip() else []
    assigned = _ASSIGNED.match(after)
    object_of = _OBJECT.search(before)
    if object_of is not None and object_of[2] != "::":
        if object_of[1] not in ("this", "self", owner):
            return None
        if before[: object_of.start()].endswith("&"):
            return "", ["&"]
        return ("", [assigned[1].strip()]) if assigned is not None else None
    declared = _DECLARED.search(before)
    if declared is None or _KEYWORD.match(declared[1]):
        if before.endswith("&"):
            return "", ["&"]
        return ("", [assigned[1].strip()]) if assigned is not None else None
    body = _BODY.match(after)
    if body is not None:
        return "function", re.findall(r"\breturn\s+([^;]{1,200});", body[1])
    if assigned is not None:
        return "variable", [assigned[1].strip()]
    next = after.lstrip()[:1]
    return ("parameter" if next in ",)" else "variable", []) if next in ",);[{" and next else None


def _name_in(value: str) -> tuple[str, bool]:
    """Returns the name that decides an expression, and whether it is called; for `a ? b : c`, that
    is the condition.
    """
    if value.lstrip().startswith("."):
        # An enumerant of Swift.
        return "", False
    for match in _PATH.finditer(_CAST.sub("", value.strip())):
        if _KNOWN.match(match["path"]) is None:
            return match["path"].removeprefix("this->"), match["call"] is not None
    return "", False
