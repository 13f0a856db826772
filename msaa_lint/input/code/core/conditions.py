"""Conditions in C and C++: known, or a set of guards that must hold."""

from __future__ import annotations

import re
from typing import Any

from msaa_lint.core.text.span import Span

from .elements import Elements
from .guards import Guards, brief, either, negated
from .operators import COMPARISONS
from .scope import Scope
from .terms import ADDRESS, BINARY, CALL, FIELD, INDEX, LABEL, LITERAL, NAME, TARGET, UNARY, Term
from .values import MAX_ALTERNATIVES, ApiObject, Flags, Instance, Symbol, Value, sole_value

_DEFINED = re.compile(r"(!?)\s*defined\s*(?:\(\s*(\w+)\s*\)|(\w+))")


def condition_key(text: str, way: bool = True) -> tuple[str, bool]:
    """Returns the key of a preprocessor condition, the same for #ifdef and #if defined, and its
    value.
    """
    match = _DEFINED.fullmatch(text.strip())
    return (
        (f"#{match[2] or match[3]}", way is not bool(match[1]))
        if match is not None
        else (f"#{text.strip()}", way)
    )


NO_NAMES: dict[str, str] = {}


def canonical_text(term: Term, names: dict[str, str] = NO_NAMES) -> str:
    """Returns the text of an expression, the same for equal expressions. `names` replaces names of
    variables.
    """
    tag = term[0]
    if tag == NAME:
        return names.get(term[1]) or str(term[1]).removeprefix("this->")
    if tag == LITERAL:
        return str(term[1])
    if tag == FIELD:
        return f"{canonical_text(term[1], names)}.{term[2]}"
    if tag == INDEX:
        return f"{canonical_text(term[1], names)}[{canonical_text(term[2], names)}]"
    if tag == CALL:
        return f"{canonical_text(term[1], names)}({','.join(canonical_text(item, names) for item in term[2])})"  # noqa: E501
    if tag == BINARY:
        return f"({canonical_text(term[2], names)}{term[1]}{canonical_text(term[3], names)})"
    if tag in (ADDRESS, TARGET, LABEL):
        return canonical_text(term[2 if tag == LABEL else 1], names)
    return f"?{term[-1][0]}"


def symbol_key(value: Any) -> str:
    return value.key if isinstance(value, Symbol) else ""


class ConditionEvaluator(Elements):
    """Evaluates conditions."""

    def preprocessor_condition(self, text: str) -> bool | Guards:
        bare = brief(text[1:].strip())
        if bare in ("0", "1"):
            return bare == "1"
        return frozenset({condition_key(bare)})

    def condition(self, term: Term, scope: Scope) -> bool | Guards:
        """Returns the value of a condition if it is known, otherwise the guards under which it
        holds.
        """
        kind = term[0]
        if kind == BINARY and term[1] == "&&":
            left, right = self.condition(term[2], scope), self.condition(term[3], scope)
            if left is False or right is False:
                return False
            return right if left is True else left if right is True else left | right
        if kind == BINARY and term[1] == "||":
            left, right = self.condition(term[2], scope), self.condition(term[3], scope)
            if left is True or right is True:
                return True
            if left is False or right is False:
                return right if left is False else left
            return either(left, right)
        if kind == UNARY and term[1] == "!":
            inner = self.condition(term[2], scope)
            return not inner if isinstance(inner, bool) else negated(inner)
        if kind == BINARY and term[1] in ("==", "!=", ">", "<", ">=", "<="):
            return self.comparison(term, scope)
        value = self.value(term, scope)
        constant = sole_value(value)
        if isinstance(constant, (bool, int, float)):
            return bool(constant)
        if len(value) == 2 and {a.value for a in value if isinstance(a.value, bool)} == {
            True,
            False,
        }:
            way = next(a for a in value if a.value is True).guards - scope.guards
            if way:
                return way
        if constant is None and value:
            return False
        if isinstance(constant, (ApiObject, Instance, Flags)):
            return True
        present = [a for a in value if isinstance(a.value, (ApiObject, Instance))]
        if (
            present
            and all(a.value is None for a in value if a not in present)
            and len({a.guards for a in present}) == 1
        ):
            # An object, or null where the conditions of the object do not hold.
            return (present[0].guards - scope.guards) or True
        return frozenset({(symbol_key(constant) or self.canonical_condition(term, scope), True)})

    def canonical_condition(self, term: Term, scope: Scope) -> str:
        """Returns the text of a condition, the same for equal conditions; variables with known
        numbers are replaced by them.
        """
        names: dict[str, str] = {}
        stack = [term]
        while stack:
            subterm = stack.pop()
            if subterm[0] == NAME:
                value = self.number(subterm, scope)
                if value is not None:
                    names[subterm[1]] = str(value)
            else:
                stack += [
                    part
                    for part in subterm[1:-1]
                    if isinstance(part, tuple)
                    and part
                    and isinstance(part[0], int)
                    and not isinstance(part, Span)
                ]
                if subterm[0] == CALL:
                    stack += subterm[2]
        return brief(canonical_text(term, names))

    def key_of_call(self, term: Term, scope: Scope) -> str:
        """Returns what stands for the unknown result of a call. In a loop, each call has its own
        arguments, and its own result.
        """
        return (
            self.canonical_condition(term, scope)
            if scope.iterations
            else brief(canonical_text(term))
        )

    def number(self, name: Term, scope: Scope) -> int | None:
        """Returns the value of a variable or constant if it is a known integer, otherwise None."""
        value = self.library.constant(name[1])
        if value is None and name[1] in self.getters:
            value = self.sole(name, scope)
        elif value is None:
            self.step(scope)
            cell = self.variable(name[1], scope)
            value = sole_value(cell.read(scope.guards)) if cell is not None else None
        return value if type(value) is int else None

    def subject(self, value: Value, term: Term, scope: Scope) -> str:
        return symbol_key(sole_value(value)) or self.canonical_condition(term, scope)

    def comparison(self, term: Term, scope: Scope) -> bool | Guards:
        sign = term[1]
        if term[3][0] == NAME and self.library.is_success(term[3][1]) and sign in ("==", "!="):
            # Assume that calls of the API succeed.
            self.value(term[2], scope)
            return bool(sign == "==")
        every = self.value(term[2], scope)
        left, right = sole_value(every), self.sole(term[3], scope)
        if (
            isinstance(right, (int, float))
            and 1 < len(every) <= MAX_ALTERNATIVES
            and all(isinstance(a.value, (int, float)) for a in every)
        ):
            holds = [a for a in every if COMPARISONS[sign](a.value, right)]
            if not holds or len(holds) == len(every):
                return bool(holds)
            if len(holds) == 1 and (guards := holds[0].guards - scope.guards):
                return guards
            fails = [a for a in every if a not in holds]
            if len(fails) == 1 and (guards := fails[0].guards - scope.guards):
                return negated(guards)
        comparable = (int, float, str) if sign in ("==", "!=") else (int, float)
        if isinstance(left, comparable) and isinstance(right, type(left)):
            return bool(COMPARISONS[sign](left, right))
        if isinstance(left, (int, bool)) and not isinstance(right, int):
            left, right, sign = (
                right,
                left,
                {"<": ">", ">": "<", "<=": ">=", ">=": "<="}.get(sign, sign),
            )
            term = (BINARY, sign, term[3], term[2], term[-1])
        subject = symbol_key(left) or self.canonical_condition(term[2], scope)
        if isinstance(right, bool) and sign in ("==", "!="):
            return frozenset({(subject, (sign == "==") is right)})
        if isinstance(right, int) and right == 1 and sign in ("!=", ">", "==", "<="):
            # The usual ways to test for multisampling.
            return frozenset({(f"{subject}>1", sign in ("!=", ">"))})
        if isinstance(right, int) and right == 2 and sign in (">=", "<"):
            return frozenset({(f"{subject}>1", sign == ">=")})
        other = symbol_key(right) or (
            str(right)
            if isinstance(right, (int, float, str))
            else self.canonical_condition(term[3], scope)
        )
        return frozenset({(f"{subject}{sign.replace('!', '=')}{other}", sign != "!=")})
