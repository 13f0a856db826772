"""Conditions of rules: expressions in CEL, the Common Expression Language, over the facts of one
subject.

CEL's `&&` and `||` absorb an error if their other operand decides the result. An absent fact is
such an error: it behaves like the unknown of three-valued logic (CEL specification, "Logical
operators").
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

from cel_expr_python import cel

from msaa_lint.core.interrupts import HELD
from msaa_lint.frame.facts.facts import Value
from msaa_lint.frame.facts.table import FACTS, SUBJECTS
from msaa_lint.frame.facts.words import WORDS, Fact

if TYPE_CHECKING:
    from .condition_cost import ConditionCost

# A string literal, or a comment, which may contain quotes.
_STRING = re.compile(
    r'''//[^\n]*|(?:\b[rR])?(?P<quote>"""|\'{3}|"|')(?P<text>(?:[^\\]|\\.)*?)(?P=quote)''',
    re.DOTALL,
)
_FACT = re.compile(r"\b[a-z]+\.[a-z_0-9]+\b(?!\s*\()")
# Only `check` needs these, and it does not run on the built-in pages at startup: they are compiled
# on first use.
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
    """An invalid condition: the problem, and its offset in the text (None: all of it)."""

    def __init__(self, message: str, offset: int | None = None, length: int = 1) -> None:
        super().__init__(message)
        self.offset = offset
        self.length = length


class Condition:
    """A compiled condition. `facts` are the facts that it names.

    With a `subject` it may only name the facts of that kind of subject. Without one it may name any
    fact: conditions that were checked before share one environment, which is faster to create than
    one for each kind.
    """

    def __init__(self, text: str, subject: str | None = None) -> None:
        self.text = text
        self.facts = named(text)
        try:
            with HELD:
                self._program = _environment(subject).compile(text)
        except RuntimeError as error:
            raise _condition_error(error, text, subject) from None

    @cached_property
    def cost(self) -> ConditionCost:
        """What an evaluation takes at most."""
        from .condition_cost import ConditionCost

        return ConditionCost(self._program.serialize())

    def must_decide(self) -> None:
        """Raises `ConditionError` if the condition is not a boolean, or takes an unknown
        pattern.
        """
        if "matches" in self.text and not self.cost.literal_patterns:
            raise ConditionError("the pattern of `matches` must be a text in quotes")
        if str(self._program.return_type()) != "BOOL":
            raise ConditionError(
                "the condition must be a boolean expression, found "
                f"{str(self._program.return_type()).lower()}"
            )

    def holds(self, activation: Any) -> bool | None:
        """True or false; None if that depends on an absent fact. Raises ArithmeticError if the
        evaluation fails.
        """
        try:
            with HELD:
                value = self._program.eval(activation).plain_value()
        except RuntimeError as error:
            # CEL bounds the cost of an evaluation.
            raise ArithmeticError(str(error)) from None
        if isinstance(value, bool):
            return value
        if "No value with name" in str(value):
            return None
        raise ArithmeticError(str(value))

    def first_absent(self, activation: Any) -> str:
        """An absent fact that an undecided condition depends on."""
        with HELD:
            value = self._program.eval(activation).plain_value()
        found = re.search(r'No value with name "([^"]*)"', str(value))
        return found[1] if found is not None else ""

    def decides(self, activation: Any) -> bool:
        """Whether the condition is true or false."""
        try:
            return self.holds(activation) is not None
        except ArithmeticError:
            return False

    def trials(self, fact: str) -> list[Value]:
        """Values of a fact, so that the condition takes every value that it can if only this fact
        changes.
        """
        kind = FACTS[fact].type
        if kind == "BOOL":
            return [True, False]
        if kind in ("INT", "DOUBLE", "INTS"):
            numbers = [
                float(number) for number in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?", self.text)
            ]
            near = sorted(
                {number + step for number in (*numbers, 1.0) for step in (-1.0, 0.0, 1.0)}
            )
            return (
                [*near]
                if kind == "DOUBLE"
                else [[], *([int(n)] for n in near)]
                if kind == "INTS"
                else [int(n) for n in near]
            )
        words = [
            match["text"] for match in _STRING.finditer(self.text) if match["quote"] is not None
        ]
        return ["", *words] if kind == "STRING" else [[], *([word] for word in words), ["?"]]


def activation(subject: str | None, facts: Mapping[str, Any]) -> Any:
    """The facts of one subject, prepared for conditions that were compiled with the same
    `subject`.
    """
    with HELD:
        return _environment(subject).Activation(facts)


def check(text: str, subject: str) -> None:
    """Raises `ConditionError` for an invalid condition: an unknown fact, a wrong type, or a string
    that its fact never equals.
    """
    if len(re.findall(_MACRO, _STRING.sub(" ", text))) > _MAX_MACROS:
        raise ConditionError(
            f"the condition uses all, exists, exists_one, map and filter more than {_MAX_MACROS} "
            "times"
        )
    Condition(text, subject).must_decide()
    for fact, literal, offset, length in literals(text):
        words = _words(fact)
        if words is not None and literal not in words:
            from msaa_lint.frame.vulkan.names import nearest_name

            close = nearest_name(literal, words)
            hint = f"; did you mean {close!r}?" if close else ""
            raise ConditionError(f"{fact} is never {literal!r}{hint}", offset, length)


def named(text: str) -> tuple[str, ...]:
    """The facts that a condition names, in order."""
    return tuple(
        dict.fromkeys(name for name in _FACT.findall(_STRING.sub(" ", text)) if name in FACTS)
    )


def literals(text: str) -> list[tuple[str, str, int, int]]:
    """The string literals that a condition compares facts with: the fact, the string, and the
    offset and length of the quoted literal.
    """
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
        out += [
            (fact, *found[int(index)])
            for index in re.findall(_MARK, match["one"] or match["left"] or match["many"])
        ]
    return out


def _words(fact: str) -> frozenset[str] | None:
    """The strings that a fact can equal; None if they are not those of an enum."""
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
        with HELD:
            _environments[subject] = cel.NewEnv(
                variables={fact.name: types[fact.type] for fact in _facts_of(subject)}
            )
    return _environments[subject]


def _condition_error(error: RuntimeError, text: str, subject: str | None) -> ConditionError:
    """The compiler's first error; for an unknown fact with a suggestion."""
    match = re.search(r"<input>:(\d+):(\d+): (.*)", str(error))
    if match is None:
        return ConditionError(str(error).splitlines()[0][:200])
    lines = text.splitlines(keepends=True)
    offset = sum(len(line) for line in lines[: int(match[1]) - 1]) + int(match[2]) - 1
    undeclared = re.search(r"undeclared reference to '([^']*)'", match[3])
    if undeclared is None:
        return _plain_error(match[3], text, offset)
    name = undeclared[1]
    # The compiler points at the dot of a dotted name.
    start = max(offset - len(name.split(".")[0]), 0)
    word = re.match(r"[a-z_A-Z0-9.]+", text[start:])
    if word is None or not word[0].startswith(name):
        start, word = offset, re.match(r"[a-z_A-Z0-9.]+", text[offset:])
    spelled = word[0] if word is not None and word[0].startswith(name) else name
    if text.startswith("(", start + len(spelled)):
        return ConditionError(f"unknown function {spelled}", start, len(spelled))
    return ConditionError(unknown_fact(spelled, subject), start, len(spelled))


def unknown_fact(name: str, subject: str | None) -> str:
    """The message about a name that is not a fact of a kind of subject (None: of any)."""
    from msaa_lint.core.suggestions import nearest

    message = f"unknown fact {name}" + (f" of {subject}" if subject is not None else "")
    if name in FACTS:
        others = [other for other, facts in SUBJECTS.items() if FACTS[name] in facts]
        return f"{message}; it is a fact of {', '.join(others)}"
    if name.isupper():
        return f'{message}; a text is written in quotes: "{name}"'
    close = nearest(name, [fact.name for fact in _facts_of(subject)])
    return (
        f"{message}; did you mean {close}?"
        if close
        else f"{message}; `msaa-lint facts` lists the facts"
    )


_OPERATORS = {"and": "&&", "or": "||", "not": "!", "&": "&&", "|": "||", "=": "=="}
"""What CEL has in place of what other languages write."""


def _plain_error(message: str, text: str, offset: int) -> ConditionError:
    """An error of the compiler in plain words."""
    overload = re.match(r"found no matching overload for '([^']*)' applied to '\((.*)\)'", message)
    if overload is not None:
        types = re.split(r", (?![^(]*\))", overload[2])
        return ConditionError(
            f"`{overload[1].strip('_@')}` cannot be applied to {' and '.join(types)}", offset
        )
    if not message.startswith("Syntax error"):
        return ConditionError(message, offset)
    word = re.match(r"\s*(\w+|[^\w\s]{1,3}|$)", text[offset:], re.DOTALL)
    token = word[1] if word is not None else ""
    if not token:
        return ConditionError("the condition is incomplete")
    if token[0] in "\"'":
        return ConditionError(
            "the quote of a text is not closed", offset + text[offset:].index(token)
        )
    hint = f": write `{_OPERATORS[token]}`" if token in _OPERATORS else ""
    start = offset + text[offset:].index(token)
    return ConditionError(f"unexpected `{token}` in the condition{hint}", start, len(token))
