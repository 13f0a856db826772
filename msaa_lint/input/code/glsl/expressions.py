"""Lowers GLSL expressions to SPIR-V as glslang does, as far as it matters for samples."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import SyntaxNode
from msaa_lint.input.code.sample_counts.arithmetic import whole

from .text import ShaderLimitExceeded
from .types import BOOL, DOUBLE, FLOAT, INT, UINT, scalar_of, size_of, vector
from .values import (
    LOGICAL_AND,
    LOGICAL_NOT,
    LOGICAL_NOT_EQUAL,
    LOGICAL_OR,
    MAX_DEPTH,
    SELECT,
    SIGNS,
    Place,
    Value,
    Values,
    literal_of,
)

FETCHES = ("texelFetch", "texelFetchOffset", "imageLoad", "subpassLoad")
_REAL = re.compile(r"[-+]?(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?")


class Expressions(Values):
    """The expressions of one shader."""

    ended = False
    """Whether the current block has its terminator."""
    root: SyntaxNode
    _effects: tuple[list[int], list[int]] | None = None

    def call(self, node: SyntaxNode, depth: int) -> Value:
        """Returns the value of a call."""
        raise NotImplementedError

    def value(self, node: SyntaxNode, depth: int = 0) -> Value:
        if depth > MAX_DEPTH:
            raise ShaderLimitExceeded(
                f"an expression of the shader nests more than {MAX_DEPTH} levels deep"
            )
        kind, deeper = node.type, depth + 1
        if kind == "number_literal":
            return self.literal(node)
        if kind in ("true", "false"):
            return self.constant_value(BOOL, kind == "true")
        if kind == "parenthesized_expression" and node.named_child_count == 1:
            return self.value(node.named_children[0], deeper)
        if kind == "identifier":
            target = self.lookup(self.text_of(node))
            if isinstance(target, Value):
                return target
        if kind in ("identifier", "field_expression", "subscript_expression"):
            place = self.place(node, depth)
            return self.load(place) if place is not None else self.extract(node, deeper)
        if kind == "call_expression":
            return self.call(node, deeper)
        if kind == "binary_expression":
            return self.binary(node, deeper)
        if kind == "assignment_expression":
            return self.assignment(node, deeper)
        if kind in ("unary_expression", "update_expression"):
            return self.unary(node, deeper)
        if kind == "conditional_expression":
            return self.conditional_value(node, deeper)
        if kind == "comma_expression":
            for child in node.named_children[:-1]:
                self.value(child, deeper)
            return self.value(node.named_children[-1], deeper)
        raise self.unsupported(node, "is not supported")

    def extract(self, node: SyntaxNode, depth: int) -> Value:
        """Returns a component or member of a value."""
        (argument,) = self.parts(node, "argument")
        base = self.value(argument, depth)
        if node.type == "subscript_expression":
            (index_node,) = self.parts(node, "index")
            kind = self.element(base.type, node)
            index = self.value(index_node, depth)
            if base.type[0] == "array":
                variable = self.temporary(base.type)
                self.store(variable, base)
                return self.load(self.access_chain(variable, kind, index.id))
            return self.result(77, kind, base.id, index.id)
        field = node.child_by_field_name("field")
        name = self.text_of(field)
        if base.type[0] != "struct":
            return self.swizzle(base, self.swizzle_parts(name, base.type, node))
        n = self.index(base.type, name, node)
        return self.result(op.COMPOSITE_EXTRACT, base.type[2][n][1], base.id, n)

    def binary(self, node: SyntaxNode, depth: int) -> Value:
        left, right, sign = self.parts(node, "left", "right", "operator")
        operator = self.text_of(sign)
        one = self.value(left, depth)
        if operator in ("&&", "||"):
            if self.has_effects(right):
                return self.short_circuit(one, operator, right, depth)
            other = self.value(right, depth)
            return self.result(
                LOGICAL_AND if operator == "&&" else LOGICAL_OR, BOOL, one.id, other.id
            )
        other = self.value(right, depth)
        if operator == "^^":
            return self.result(LOGICAL_NOT_EQUAL, BOOL, one.id, other.id)
        if operator not in SIGNS:
            raise self.unsupported(node, "is not supported")
        return self.arithmetic(operator, one, other)

    def has_effects(self, node: SyntaxNode) -> bool:
        """Returns whether evaluating an expression has effects: it calls a function or assigns a
        variable.
        """
        if self._effects is None:
            self._effects = self._find_effects()
        starts, ends = self._effects
        first = bisect_left(starts, node.start_byte)
        if first < len(starts) and starts[first] == node.start_byte:
            # What starts at the same place may be around the expression.
            if ends[first] <= node.end_byte:
                return True
            first += 1
        return first < len(starts) and starts[first] < node.end_byte

    def _find_effects(self) -> tuple[list[int], list[int]]:
        """Returns where the text has effects: the offsets at which they start, and the least at
        which one from there ends.
        """
        ends: dict[int, int] = {}
        stack = [self.root]
        while stack:
            inner = stack.pop()
            effect = inner.type in ("assignment_expression", "update_expression")
            if inner.type == "call_expression":
                name = self.text_of(inner.child_by_field_name("function"))
                effect = name in self.functions or name in FETCHES
            if effect:
                ends[inner.start_byte] = min(
                    inner.end_byte, ends.get(inner.start_byte, inner.end_byte)
                )
            stack += inner.named_children
        starts = sorted(ends)
        return starts, [ends[start] for start in starts]

    def short_circuit(self, one: Value, operator: str, right: SyntaxNode, depth: int) -> Value:
        """Lowers `&&` and `||` whose second operand must only be evaluated if it decides the
        result.
        """
        result = self.temporary(BOOL)
        self.store(result, one)
        condition = one.id if operator == "&&" else self.out.instruction(LOGICAL_NOT, BOOL, one.id)
        self.branch(condition, lambda: self.store(result, self.value(right, depth)), None)
        return self.load(result)

    def branch(
        self, condition: int, then: Callable[[], None], other: Callable[[], None] | None
    ) -> None:
        """Lowers a selection with one or two branches."""
        yes, no, merge = self.out.id(), self.out.id(), self.out.id()
        self.out.emit(op.SELECTION_MERGE, merge, 0)
        self.terminate(op.BRANCH_CONDITIONAL, condition, yes, no if other is not None else merge)
        self.label(yes)
        then()
        self.terminate(op.BRANCH, merge)
        if other is not None:
            self.label(no)
            other()
            self.terminate(op.BRANCH, merge)
        self.label(merge)

    def terminate(self, number: int, *operands: int) -> None:
        """Adds the terminator of a block unless it has one."""
        if not self.ended:
            self.out.emit(number, *operands)
        self.ended = True

    def label(self, label: int) -> None:
        """Starts a block; the previous one branches to it unless it has a terminator."""
        if not self.ended:
            self.out.emit(op.BRANCH, label)
        self.out.emit(op.LABEL, label)
        self.ended = False

    def conditional_value(self, node: SyntaxNode, depth: int) -> Value:
        test, then, other = self.parts(node, "condition", "consequence", "alternative")
        condition = self.value(test, depth)
        if not self.has_effects(then) and not self.has_effects(other):
            one, two = self.value(then, depth), self.value(other, depth)
            one, two = self.common_type(one, two)
            return self.result(SELECT, one.type, condition.id, one.id, two.id)
        places: list[Place] = []

        def keep(part: SyntaxNode) -> None:
            value = self.value(part, depth)
            if not places:
                places.append(self.temporary(value.type))
            self.store(places[0], value)

        self.branch(condition.id, lambda: keep(then), lambda: keep(other))
        return self.load(places[0])

    def assignment(self, node: SyntaxNode, depth: int) -> Value:
        left, right, sign = self.parts(node, "left", "right", "operator")
        operator = self.text_of(sign)
        value = self.value(right, depth)
        place = self.place(left, depth)
        if place is None:
            raise self.unsupported(left, "cannot be assigned to")
        if operator != "=":
            value = self.arithmetic(operator[:-1], self.load(place), value)
        value = self.as_type(
            value, vector(scalar_of(place.type), len(place.parts)) if place.parts else place.type
        )
        self.store(place, value)
        return value

    def unary(self, node: SyntaxNode, depth: int) -> Value:
        inner, sign = self.parts(node, "argument", "operator")
        operator = self.text_of(sign)
        if operator in ("++", "--"):
            place = self.place(inner, depth)
            if place is None:
                raise self.unsupported(node, "is not supported")
            before = self.load(place)
            scalar = scalar_of(before.type)
            one = self.constant_value(scalar, literal_of(scalar, 1))
            after = self.arithmetic(operator[0], before, one)
            self.store(place, after)
            return after if sign.start_byte < inner.start_byte else before
        value = self.value(inner, depth)
        if operator == "+":
            return value
        if operator == "!":
            return self.result(LOGICAL_NOT, BOOL, value.id)
        if not size_of(value.type):
            return self.opaque(operator, value.type, (value,))
        if operator == "~":
            return self.result(200, value.type, value.id)
        return self.result(
            127 if scalar_of(value.type) in (FLOAT, DOUBLE) else 126, value.type, value.id
        )

    def literal(self, node: SyntaxNode) -> Value:
        text = self.text_of(node)
        number = whole(text)
        if number is not None:
            kind = UINT if text[-1] in "uU" else INT
            return self.constant_value(kind, number)
        kind = DOUBLE if text.endswith(("lf", "LF")) else FLOAT
        return self.constant_value(kind, self.real(node))

    def real(self, node: SyntaxNode) -> float:
        text = self.text_of(node)
        match = _REAL.match(text)
        if match is None or text[match.end() :] not in (
            "",
            "f",
            "F",
            "lf",
            "LF",
            "hf",
            "HF",
            "u",
            "U",
        ):
            raise self.unsupported(node, "is not a number")
        real = float(match[0])
        if abs(real) > 3e38:
            raise self.unsupported(node, "is too large")
        return real
