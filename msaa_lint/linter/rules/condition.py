"""Conditions of rules: CEL, the Common Expression Language, over the facts of one subject.

CEL's `&&` and `||` take an error for an answer where the other side decides, so that a fact that is absent is exactly an unknown of
three-valued logic (CEL specification, "Logical operators").
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from cel_expr_python import cel

from msaa_lint.frame.facts.table import FACTS, SUBJECTS, WORDS, Fact

# A text; or a comment, in which a quote begins none.
_STRING = re.compile(r'''//[^\n]*|(?:\b[rR])?(?P<quote>"""|\'{3}|"|')(?P<text>(?:[^\\]|\\.)*?)(?P=quote)''', re.DOTALL)
_FACT = re.compile(r"\b[a-z]+\.[a-z_0-9]+\b(?!\s*\()")
# What only `check` needs is compiled where it is used: the conditions of the built-in pages are not checked at start-up.
_MACRO = r"\.\s*(?:all|exists|exists_one|map|filter)\s*\("
_MEETS = (
    r"(?P<fact>\b[a-z]+\.[a-z_0-9]+)\s*(?:==|!=)\s*(?P<one>\x00\d+\x00)"
    r"|(?P<left>\x00\d+\x00)\s*(?:==|!=|in)\s*(?P<of>\b[a-z]+\.[a-z_0-9]+)"
    r"|(?P<among>\b[a-z]+\.[a-z_0-9]+)\s+in\s+\[(?P<many>[^\]]*)\]"
)
_MARK = r"\x00(\d+)\x00"
_MAX_MACROS = 2

_environments: dict[str | None, Any] = {}


class ConditionError(ValueError):
    """A condition that cannot be used: what is wrong, and where in its text (an offset of None: all of it)."""

    def __init__(self, message: str, offset: int | None = None, length: int = 1) -> None:
        super().__init__(message)
        self.offset = offset
        self.length = length


class Condition:
    """A compiled condition. `facts` are the facts that it names.

    With a `subject` it may name the facts of that kind only, else every fact there is: a condition that was checked need not be again, and
    one environment for all kinds is made in a third of the time of one for each.
    """

    __slots__ = ("_program", "facts", "text")

    def __init__(self, text: str, subject: str | None = None) -> None:
        self.text = text
        self.facts = named(text)
        try:
            self._program = _environment(subject).compile(text)
        except RuntimeError as error:
            raise _explained(error, text, subject) from None

    def must_decide(self) -> None:
        """Raises `ConditionError` where the condition is no yes or no."""
        if str(self._program.return_type()) != "BOOL":
            raise ConditionError("a condition is true or false, not a value")

    def holds(self, activation: Any) -> bool | None:
        """True or false; None where it hangs on a fact that is absent. ArithmeticError where it cannot be worked out at all."""
        try:
            value = self._program.eval(activation).plain_value()
        except RuntimeError as error:
            # What it may cost is bounded.
            raise ArithmeticError(str(error)) from None
        if isinstance(value, bool):
            return value
        if "No value with name" in str(value):
            return None
        raise ArithmeticError(str(value))


def activation(subject: str | None, facts: Mapping[str, Any]) -> Any:
    """The facts of one subject in the form that conditions made with the same `subject` are worked out with."""
    return _environment(subject).Activation(facts)


def check(text: str, subject: str) -> None:
    """Raises `ConditionError` where a condition cannot be used: a misspelt fact, a wrong type, a text that its fact never has.

    For pages as they are loaded; a condition that passes compiles.
    """
    if len(re.findall(_MACRO, _STRING.sub(" ", text))) > _MAX_MACROS:
        raise ConditionError(f"at most {_MAX_MACROS} of all, exists, exists_one, map and filter may stand in a condition")
    Condition(text, subject).must_decide()
    for fact, literal, offset, length in literals(text):
        words = _words(fact)
        if words is not None and literal not in words:
            from msaa_lint.frame.vulkan.names import nearest_name

            close = nearest_name(literal, words)
            hint = f"; did you mean {close!r}?" if close else ""
            raise ConditionError(f"{fact} is never {literal!r}{hint}", offset, length)


def named(text: str) -> tuple[str, ...]:
    """The facts that a condition names, in their order."""
    return tuple(dict.fromkeys(name for name in _FACT.findall(_STRING.sub(" ", text)) if name in FACTS))


def literals(text: str) -> list[tuple[str, str, int, int]]:
    """Every text that a condition compares a fact with, and where it stands: its offset and length, with its quotes."""
    found: list[tuple[str, int, int]] = []

    def mark(match: re.Match[str]) -> str:
        if match["quote"] is None:
            return " "
        found.append((match["text"], match.start(), len(match[0])))
        return f"\x00{len(found) - 1}\x00"

    marked = _STRING.sub(mark, text)
    out = []
    for match in re.finditer(_MEETS, marked):
        fact = match["fact"] or match["of"] or match["among"]
        out += [(fact, *found[int(index)]) for index in re.findall(_MARK, match["one"] or match["left"] or match["many"])]
    return out


def _words(fact: str) -> frozenset[str] | None:
    """The texts that a fact can have, where they are a Vulkan enum's or ours."""
    enum = FACTS[fact].enum if fact in FACTS else ""
    if not enum:
        return None
    if enum in WORDS:
        return frozenset(WORDS[enum])
    from msaa_lint.frame.vulkan.enums import VALUES

    return frozenset(VALUES[enum])


def _facts_of(subject: str | None) -> Iterable[Fact]:
    return FACTS.values() if subject is None else SUBJECTS[subject]


def _environment(subject: str | None) -> Any:
    if subject not in _environments:
        types = {
            "BOOL": cel.Type.BOOL,
            "INT": cel.Type.INT,
            "DOUBLE": cel.Type.DOUBLE,
            "STRING": cel.Type.STRING,
            "LIST": cel.Type.List(cel.Type.STRING),
            "INTS": cel.Type.List(cel.Type.INT),
        }
        _environments[subject] = cel.NewEnv(variables={fact.name: types[fact.type] for fact in _facts_of(subject)})
    return _environments[subject]


def _explained(error: RuntimeError, text: str, subject: str | None) -> ConditionError:
    """The compiler's first complaint, in our words where it is a misspelt fact."""
    match = re.search(r"<input>:(\d+):(\d+): (.*)", str(error))
    if match is None:
        return ConditionError(str(error).splitlines()[0][:200])
    lines = text.splitlines(keepends=True)
    offset = sum(len(line) for line in lines[: int(match[1]) - 1]) + int(match[2]) - 1
    undeclared = re.search(r"undeclared reference to '([^']*)'", match[3])
    if undeclared is None:
        return ConditionError(match[3], offset)
    from msaa_lint.core.suggestions import nearest

    name = undeclared[1]
    known = [fact.name for fact in _facts_of(subject)]
    # The compiler points at the dot of a dotted name.
    start = max(offset - len(name.split(".")[0]), 0)
    word = re.match(r"[a-z_A-Z0-9.]+", text[start:])
    if word is None or not word[0].startswith(name):
        start, word = offset, re.match(r"[a-z_A-Z0-9.]+", text[offset:])
    spelled = word[0] if word is not None and word[0].startswith(name) else name
    close = nearest(spelled, known)
    hint = f"; did you mean {close}?" if close else ""
    of = f" of {subject}" if subject is not None else ""
    return ConditionError(f"there is no fact {spelled}{of}{hint}", start, len(spelled))
