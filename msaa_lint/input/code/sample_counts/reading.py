"""Reads how the functions of a file choose their sample count, statement by statement.

See `choices` for what is tracked.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ASSIGN,
    BLOCK,
    BREAK,
    CALL,
    CHOICE,
    DECLARE,
    DO,
    FIELD,
    IF,
    LAMBDA,
    LEAVE,
    LOOP,
    Function,
    Parameter,
    Term,
)
from msaa_lint.input.code.core.terms import RETURN as RETURN_STATEMENT

from .chains import MAX_TESTS, Chain, Test, greatest
from .loops import halving_loop, loop_iterations, parts_of
from .masks import COUNTS, Bindings, Expressions, Highest, Mask, Order, Value, combine, name_of
from .names import last
from .statements import links, statements

MAX_DEPTH = 40
"""The maximum nesting of blocks."""

RETURN = ""
"""The target of a chain that returns its count; other targets are variables."""

_MASK_TYPE = re.compile(r"SampleCountFlags\b")
_SPELLED = re.compile(
    r"SAMPLE_COUNT_\d|SampleCountFlagBits|SampleCounts?(?:Flags)?::\w|\be(?:2|4|8|16|32|64)\b"
)


class Owner(NamedTuple):
    """The function or lambda that contains statements: its name, the location of the name, and its
    return type. Empty for global code.
    """

    name: str
    at: Span | None
    returns: str


class Choice(NamedTuple):
    """A choice: its name and location, the mask, the tests, and the highest count that it selects
    if known.
    """

    name: str
    at: Span
    mask: Mask
    tests: tuple[Test, ...]
    at_most: int | None


class ChoiceReader:
    """Reads the functions of a file."""

    def __init__(self, text: str) -> None:
        self.expressions = Expressions(text)
        self.choices: list[Choice] = []
        self.combined: dict[Span, tuple[str, Mask]] = {}
        """Masks that are combined incorrectly, by the location of the operator: the name of the
        target, and the mask.
        """

    def function(self, function: Function) -> None:
        """Reads a function definition."""
        owner = Owner(last(function.name), function.at, function.return_type)
        self.block(function.body, self.parameters(function.parameters, function.at), owner, 0)

    def parameters(self, items: Sequence[Parameter], at: Span) -> Bindings:
        """Returns the parameters; those whose type is a mask are unknown masks."""
        return {
            item.name: Mask((), "NONE", at, known=False)
            if _MASK_TYPE.search(item.type) is not None
            else None
            for item in items
            if item.name
        }

    def block(self, body: Sequence[Term], bindings: Bindings, owner: Owner, depth: int) -> None:
        """Reads a sequence of statements."""
        chains: dict[str, Chain] = {}
        every = list(statements(body)) if depth < MAX_DEPTH else []
        for number, term in enumerate(every):
            self.statement(term, bindings, owner, chains, depth + 1, every[number + 1 : number + 2])
        for target, chain in chains.items():
            self.finish(target, chain, owner)

    def statement(
        self,
        term: Term,
        bindings: Bindings,
        owner: Owner,
        chains: dict[str, Chain],
        depth: int,
        following: Sequence[Term] = (),
    ) -> None:
        kind = term[0]
        if kind == IF:
            self.branches(term, bindings, owner, chains, depth, following)
        elif kind == LOOP:
            if not self.loop(term, bindings, chains):
                # What a loop counts with has another value in each iteration.
                _, step, _ = parts_of(term)
                changed = [item[2] for item in term[1]] + (
                    [name_of(step[2])] if step is not None else []
                )
                self.block(term[3], {**bindings, **dict.fromkeys(changed)}, owner, depth)
        elif kind == BLOCK:
            self.block(term[1], bindings, owner, depth)
        elif kind in (DECLARE, DO, RETURN_STATEMENT) and not self.immediate(
            term, bindings, owner, depth
        ):
            self.plain(term, bindings, owner, chains)
            self.lambdas(term, bindings, depth)

    def immediate(self, term: Term, bindings: Bindings, owner: Owner, depth: int) -> bool:
        """Reads a statement whose value is a block: `let samples = { ... };`. Returns whether it is
        one.
        """
        declares = term[0] == DECLARE
        value = term[3] if declares else term[1]
        if term[0] == DO and value[0] == ASSIGN:
            value = value[3]
        if value is None or value[0] != CALL or value[2] or value[1][0] != LAMBDA or value[1][1]:
            return False
        if declares:
            owner = Owner(last(term[2]), term[-1], term[1])
        elif term[0] == DO and term[1][0] == ASSIGN:
            owner = Owner(name_of(term[1][2]), term[1][2][-1], "")
        self.block(value[1][2], bindings, owner, depth)
        if declares:
            bindings[owner.name] = None
        return True

    def plain(self, term: Term, bindings: Bindings, owner: Owner, chains: dict[str, Chain]) -> None:
        """Reads a declaration, an assignment, or a return."""
        if term[0] == RETURN_STATEMENT:
            self.assign(RETURN, term[1], owner.returns, bindings, owner, chains)
        elif term[0] == DECLARE:
            name, kind, source = last(term[2]), term[1], term[3]
            if name and source is not None:
                bindings[name] = None
                self.assign(name, source, kind, bindings, owner, chains)
            elif name:
                bindings[name] = (
                    Mask((), "NONE", term[-1], known=False) if _MASK_TYPE.search(kind) else None
                )
        elif term[1][0] == ASSIGN:
            _, operator, target, source, at = term[1]
            name = name_of(target)
            if operator == "&=" and name:
                before = bindings.get(name, self.expressions.members.get(name))
                bindings[name] = _apply_mask(before, self.expressions.value(source, bindings), at)
            elif operator == "=":
                self.assign(name, source, "", bindings, owner, chains)

    def assign(
        self,
        target: str,
        term: Term | None,
        typed: str,
        bindings: Bindings,
        owner: Owner,
        chains: dict[str, Chain],
    ) -> None:
        """Assigns the value of an expression to a variable, or returns it."""
        value = self.expressions.value(term, bindings)
        if value is None and term is not None and _MASK_TYPE.search(typed) and target:
            value = Mask((), "NONE", term[-1], known=False)
        if isinstance(value, Mask):
            logical = value.combined.startswith("LOGICAL") and not re.search(
                r"SampleCount|int|VkFlags", typed
            )
            if value.combined not in ("NONE", "AND", "OR") and not logical:
                self.combined.setdefault(value.at, (target or owner.name, value))
        if isinstance(value, Highest) and value.form == "COUNT":
            at = (
                owner.at
                if target == RETURN and owner.at is not None
                else term[-1]
                if term is not None
                else value.mask.at
            )
            # The highest count of a mask from elsewhere, such as a setting, is not the device's
            # highest.
            most = (
                1 << (value.mask.allowed.bit_length() - 1)
                if value.mask.allowed and value.mask.limits and value.mask.known
                else None
            )
            self.choices.append(Choice(target or owner.name, at, value.mask, (), most))
        elif target == RETURN and owner.name:
            returns = self.expressions.returns
            returns[owner.name] = (
                value
                if isinstance(value, Mask) and returns.get(owner.name, value) == value
                else None
            )
        elif target:
            if target not in bindings:
                members = self.expressions.members
                members[target] = value if members.get(target, value) == value else None
            bindings[target] = value
        self.conditional(target, term, bindings, chains)

    def conditional(
        self, target: str, term: Term | None, bindings: Bindings, chains: dict[str, Chain]
    ) -> None:
        """Reads a chain of conditional expressions, or the search of a list of counts."""
        tests: list[Test] = []
        for _ in range(MAX_TESTS):
            if term is None or term[0] != CHOICE:
                break
            found = self.found(term[2], bindings)
            if found:
                tests += found
                term = term[3]
                continue
            mask, count = (
                self.expressions.value(term[1], bindings),
                self.expressions.value(term[2], bindings),
            )
            if (
                not isinstance(mask, Mask)
                or mask.bit is None
                or not isinstance(count, int)
                or count not in COUNTS
            ):
                break
            tests.append(
                Test(mask, mask.bit, count, term[1][-1], 0, True, self.spells_count((term,)))
            )
            term = term[3]
        if term is not None and not tests:
            tests = self.found(term, bindings)
        if tests and (term is None or term[0] != CHOICE):
            chain = chains.setdefault(target, Chain())
            chain.groups += 1
            chain.tests += tests

    def found(self, term: Term, bindings: Bindings) -> list[Test]:
        """Returns the tests of `counts.iter().find(|c| mask.contains(c))`, and of a filter whose
        first or greatest count is taken.
        """
        if term[0] != CALL or term[1][0] != FIELD:
            return []
        name, receiver, arguments = term[1][2], term[1][1], term[2]
        if (
            name in ("next", "max", "last")
            and not arguments
            and receiver[0] == CALL
            and receiver[1][0] == FIELD
        ):
            if receiver[1][2] != "filter":
                return []
            name, receiver, arguments, selection = "find", receiver[1][1], receiver[2], name
        else:
            selection = "next"
        if (
            name != "find"
            or len(arguments) != 1
            or arguments[0][0] != LAMBDA
            or len(arguments[0][1]) != 1
            or len(arguments[0][2]) != 1
        ):
            return []
        reverse = (
            receiver[0] == CALL
            and receiver[1][0] == FIELD
            and receiver[1][2] == "rev"
            and not receiver[2]
        )
        order = self.expressions.value(receiver[1][1] if reverse else receiver, bindings)
        condition = arguments[0][2][0]
        if not isinstance(order, Order) or condition[0] != RETURN_STATEMENT:
            return []
        counts = list(order.counts)
        counts = (
            sorted(counts, reverse=True)
            if selection == "max"
            else counts[::-1]
            if reverse != (selection == "last")
            else counts
        )
        tests = []
        for count in counts[:MAX_TESTS]:
            mask = self.expressions.value(
                condition[1], {**bindings, arguments[0][1][0].name: count}
            )
            if not isinstance(mask, Mask) or mask.bit != count:
                return []
            tests.append(Test(mask, count, count, condition[1][-1], 0, True, True))
        return tests

    def lambdas(self, term: Term, bindings: Bindings, depth: int) -> None:
        """Reads the lambdas in an expression."""
        stack = [term]
        while stack:
            item = stack.pop()
            if not item or not isinstance(item[-1], Span) or item[0] != LAMBDA:
                stack += [
                    part for part in item if isinstance(part, tuple) and not isinstance(part, Span)
                ]
            elif depth < MAX_DEPTH:
                owner = (
                    Owner(last(term[2]), term[-1], "")
                    if term[0] == DECLARE and term[3] is item
                    else Owner("", None, "")
                )
                self.block(
                    item[2], {**bindings, **self.parameters(item[1], item[-1])}, owner, depth + 1
                )

    def branches(
        self,
        term: Term,
        bindings: Bindings,
        owner: Owner,
        chains: dict[str, Chain],
        depth: int,
        following: Sequence[Term],
    ) -> None:
        """Reads an `if` chain: its tests and its blocks."""
        self.read_tests(term, bindings, chains)
        first = True
        for condition, then in links(term):
            if first:
                self.comparison(condition, then, term[3] or following, bindings, owner)
            first = False
            self.block(then, bindings, owner, depth)

    def comparison(
        self,
        condition: Term | None,
        then: Sequence[Term],
        other: Sequence[Term],
        bindings: Bindings,
        owner: Owner,
    ) -> None:
        """Reads `if (a < b) counts = a; else counts = b;` and the same with returns."""
        compared = self.expressions.comparison(condition, bindings)
        if compared is None:
            return
        one, two = self.assignment_of(then), self.assignment_of(other)
        if one is None or two is None or one[0] != two[0]:
            return
        lesser = self.expressions.minimum(
            compared,
            self.expressions.value(one[1], bindings),
            self.expressions.value(two[1], bindings),
        )
        if lesser is not None:
            self.combined.setdefault(lesser.at, (one[0] or owner.name, lesser))

    def assignment_of(self, body: Sequence[Term]) -> tuple[str, Term] | None:
        """Returns the target and the value that a branch assigns or returns."""
        for term in statements(body):
            if term[0] == RETURN_STATEMENT and term[1] is not None:
                return RETURN, term[1]
            if term[0] == DO and term[1][0] == ASSIGN and term[1][1] == "=":
                return name_of(term[1][2]), term[1][3]
        return None

    def spells_count(self, body: Sequence[Term]) -> bool:
        """Returns whether terms name a sample count."""
        text = self.expressions.text
        return (
            bool(body)
            and _SPELLED.search(text[body[0][-1].start : body[-1][-1].end][:4000]) is not None
        )

    def read_tests(
        self, term: Term, bindings: Bindings, chains: dict[str, Chain], spelled: bool | None = None
    ) -> bool:
        """Reads the tests of an `if`. Returns whether it selects a count. `spelled` is whether a
        loop around it names a count.
        """
        gave = False
        touched: set[str] = set()
        for condition, then in links(term):
            assignment = self.assignment_of(then)
            if condition is None or assignment is None:
                continue
            target, expression = assignment
            count, mask = (
                self.expressions.value(expression, bindings),
                self.expressions.value(condition, bindings),
            )
            if not isinstance(count, int) or count not in COUNTS:
                if isinstance(mask, Mask) and mask.bit is not None and target in chains:
                    chains[target].pure = False
                continue
            chain = chains.setdefault(target, Chain())
            gave = True
            if isinstance(mask, Mask) and mask.bit is not None and len(chain.tests) < MAX_TESTS:
                if target not in touched:
                    chain.groups += 1
                touched.add(target)
                leaves = target == RETURN or any(
                    item[0] in (BREAK, LEAVE, RETURN_STATEMENT) for item in statements(then)
                )
                is_spelled = self.spells_count(then) if spelled is None else spelled
                chain.tests.append(
                    Test(mask, mask.bit, count, condition[-1], chain.groups, leaves, is_spelled)
                )
            elif count > 1:
                chain.pure = False
        return gave

    def loop(self, term: Term, bindings: Bindings, chains: dict[str, Chain]) -> bool:
        """Reads a loop over known counts. Returns whether it is one."""
        is_loop = False
        waited = halving_loop(term, self.expressions, bindings)
        if waited is not None:
            name, tests = waited
            chain = chains.setdefault(name, Chain())
            chain.groups += 1
            chain.tests += [
                Test(mask, mask.bit or 1, count, at, chain.groups, True, True)
                for mask, count, at in tests
            ]
            return True
        spelled = self.spells_count((term,))
        body = parts_of(term)[2]
        for inner in loop_iterations(term, self.expressions, bindings):
            for child in body:
                is_loop |= child[0] == IF and self.read_tests(child, inner, chains, spelled)
        return is_loop

    def finish(self, target: str, chain: Chain, owner: Owner) -> None:
        """Adds the choice of a chain at the end of its block."""
        tests = chain.ordered()
        mask = tests[0].mask if tests else None
        if mask is None or not (mask.known or all(test.spelled for test in tests)):
            return
        if (
            len(
                {
                    (tuple(name for name, _ in test.mask.limits), test.mask.combined)
                    for test in tests
                }
            )
            > 1
        ):
            # The variable was assigned another mask in between.
            return
        at = owner.at if target == RETURN and owner.at is not None else tests[0].at
        # The maximum of a mask from elsewhere is the device's maximum only if the mask is the
        # device's.
        most = greatest(tests) if chain.pure and mask.limits else None
        self.choices.append(Choice(target or owner.name or "samples", at, mask, tuple(tests), most))


def _apply_mask(value: Value | None, other: Value | None, at: Span) -> Value | None:
    """Returns the result of `&=` on a mask."""
    if isinstance(value, Mask) and isinstance(other, Mask):
        return combine((value, other), "AND", at)
    return (
        value._replace(allowed=value.allowed & other)
        if isinstance(value, Mask) and isinstance(other, int)
        else None
    )
