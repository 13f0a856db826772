"""What calls of macros and helpers without a definition do, by their shape."""

from __future__ import annotations

import re
from collections.abc import Sequence

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    BRACES,
    CALL,
    DECLARE,
    FIELD,
    INDEX,
    LITERAL,
    NAME,
    TARGET,
    UNPARSED,
    Term,
)

_MACRO = re.compile(r"_*[A-Z][A-Z0-9_]*")

_STRUCTURE = re.compile(r"Vk[A-Z]\w*|vk::[A-Z]\w*|VULKAN_HPP_NAMESPACE::\w+")

_TYPED = re.compile(r"VK_STRUCTURE_TYPE_|(?:vk::)?StructureType::e")

_COUNT = re.compile(
    r"(?!.*BYTE)_*(?:[A-Z][A-Z0-9]*_)*[A-Z0-9]*(?:COUNT|COUNTOF|COUNT_OF|SIZE|LENGTH|LENGTHOF|LEN|ELEMENTS|ELEMS|NELEM|DIM)"
    r"|(?:\w+_)?(?:[aA]rray_?(?:[sS]ize|[cC]ount|[lL]ength|[lL]en)|_?[cC]ount_?[oO]f|[lL]ength_?[oO]f|[nN]elem(?:s|ents)?)"
)
"""Names of what counts the elements of an array, and nothing else."""

_CLEARS = re.compile(
    r"zero|(?:clear|wipe|reset)_?(?:mem|struct|info)|mem_?(?:clear|wipe)|^_*clear$", re.IGNORECASE
)

_KEEPS = re.compile(
    r"hash|crc|cmp|comp|copy|cpy|read|write|print|log|append|upload|update|push|send|store|load|save|find|check",
    re.IGNORECASE,
)
"""Names of functions that take a structure, a zero, and a size, and do something else than to clear
it.
"""

_LOOP = re.compile(r"(?i)(?:\w+_)?for_?(?:each|all|range)\w*")

COUNT = "std::size"


def called(function: Term, arguments: Sequence[Term]) -> str:
    """Returns the standard function that a call stands for, or an empty string."""
    name = _short(function)
    if len(arguments) == 1 and _COUNT.fullmatch(name) and arguments[0][0] in (NAME, FIELD):
        return COUNT
    if (
        len(arguments) == 3
        and arguments[1][:2] == (LITERAL, 0)
        and _is_size(arguments[2])
        and not _KEEPS.search(name)
    ):
        return "memset"
    return ""


def _short(function: Term) -> str:
    return str(function[1]).rpartition("::")[2] if function[0] == NAME else ""


def _is_size(term: Term) -> bool:
    return bool(term[0] == UNPARSED and term[1].startswith("sizeof"))


def declared(term: Term) -> Term | None:
    """Returns the variable that a statement `MACRO(VkType, name)` or `MACRO(VkType, name, count)`
    declares: a zeroed structure.
    """
    if term[0] != CALL or len(term[2]) not in (2, 3) or not _MACRO.fullmatch(_short(term[1])):
        return None
    kind, name = term[2][0], term[2][1]
    if kind[0] != NAME or name[0] != NAME or not _STRUCTURE.fullmatch(kind[1]) or "::" in name[1]:
        return None
    at: Span = name[-1]
    full_type = kind[1]
    if len(term[2]) == 3:
        count = term[2][2]
        if count[0] not in (NAME, LITERAL):
            return None
        full_type = f"{kind[1]}[{count[1]}]"
    return (DECLARE, full_type, name[1], (BRACES, full_type, (), at), False, False, at)


def zeroed(kind: str, term: Term) -> Term | None:
    """Returns the value of `VkType name = MACRO(VkType)`: a zeroed structure."""
    is_macro = term[0] == CALL and len(term[2]) == 1 and _MACRO.fullmatch(_short(term[1]))
    return (
        (BRACES, kind, (), term[-1])
        if is_macro and term[2][0][:2] == (NAME, kind) and _STRUCTURE.fullmatch(kind)
        else None
    )


def cleared(term: Term) -> Term:
    """Returns a statement that calls a function which clears its argument as a call of `memset`,
    and any other as it is.

    That the second argument is the type of the structure says as much as the name of the function.
    """
    if term[0] != CALL or len(term[2]) not in (1, 2) or term[1][0] != NAME:
        return term
    target, *size = term[2]
    typed = bool(size) and size[0][0] == NAME and _TYPED.match(size[0][1]) is not None
    if target[0] not in (ADDRESS, NAME, FIELD, INDEX) or not (
        typed or _CLEARS.search(_short(term[1]))
    ):
        return term
    if size and not typed and not _is_size(size[0]):
        return term
    if typed and (target[0] == NAME and (target[1].isupper() or _STRUCTURE.fullmatch(target[1]))):
        return term
    at: Span = term[-1]
    size = [] if typed else size
    target = target if target[0] == ADDRESS else (ADDRESS, target, target[-1])
    return (
        CALL,
        (NAME, "memset", at),
        (target, (LITERAL, 0, at), size[0] if size else (UNPARSED, "sizeof", at)),
        at,
    )


def loop_variable(term: Term) -> tuple[Term, Term] | None:
    """Returns the variable and the list of a loop `FOREACH(variable, list)`, whose body follows."""
    if term[0] != CALL or len(term[2]) != 2 or not _LOOP.fullmatch(_short(term[1])):
        return None
    name, over = term[2]
    return (
        ((DECLARE, "auto", name[1], None, True, False, name[-1]), over) if name[0] == NAME else None
    )


def iterated(declared: list[Term], body: list[Term]) -> tuple[tuple[Term, ...], Term] | None:
    """Returns the variable and the list of a loop with an iterator, `for (auto it = list.begin();
    it != list.end(); ++it)`, or None. The body must use the iterator only for the element.
    """
    value = declared[0][3] if len(declared) == 1 else None
    if (
        value is None
        or value[0] != CALL
        or value[1][0] != FIELD
        or value[1][2] not in ("begin", "cbegin")
    ):
        return None
    stack: list[object] = list(body)
    while stack:
        term = stack.pop()
        if not isinstance(term, tuple) or isinstance(term, Span) or not term:
            continue
        if term[:2] == (NAME, declared[0][2]):
            return None
        is_element = (
            term[0] in (TARGET, FIELD)
            and isinstance(term[1], tuple)
            and term[1][:2] == (NAME, declared[0][2])
        )
        stack += term[2:] if is_element else term
    return ((*declared[0][:3], None, True, *declared[0][5:]),), value[1][1]
