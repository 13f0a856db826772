"""Evaluates expressions of sample count masks: the limits that they come from and how they are
combined.
"""

import re
from collections.abc import Iterable
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    ASSIGN,
    BINARY,
    BRACES,
    CALL,
    CHOICE,
    FIELD,
    INDEX,
    LITERAL,
    NAME,
    TARGET,
    UNARY,
    Term,
    at,
)

from .arithmetic import arithmetic
from .names import last

LIMITS = frozenset({
    "framebufferColorSampleCounts", "framebufferDepthSampleCounts",
    "framebufferStencilSampleCounts",
    "framebufferNoAttachmentsSampleCounts", "framebufferIntegerColorSampleCounts",
    "sampledImageColorSampleCounts",
    "sampledImageIntegerSampleCounts", "sampledImageDepthSampleCounts",
    "sampledImageStencilSampleCounts", "storageImageSampleCounts",
})  # fmt: skip
"""The members of VkPhysicalDeviceLimits and VkPhysicalDeviceVulkan12Properties that are sample
count masks.
"""

_LIMITS = {limit.lower(): limit for limit in LIMITS}

MAX_DEPTH = 60
"""The maximum nesting of expressions."""

COUNTS = (64, 32, 16, 8, 4, 2, 1)
EVERY = 127
"""The mask with every count."""

RANK = ("NONE", "AND", "LOGICAL_AND", "LOGICAL_OR", "OR", "MAX", "MIN")
"""Ways to combine masks, from correct to wrong."""

_ENUMERANT = re.compile(r"VK_SAMPLE_COUNT_(\d{1,2})_BIT")
_HPP = re.compile(r"(?:(?:vk::)?SampleCountFlagBits::)?e(1|2|4|8|16|32|64)")
_RUST = re.compile(
    r"(?:\w+::)*(?:SampleCountFlags::(?:TYPE)?_|SampleCounts?::(?:SAMPLE_|Sample))(1|2|4|8|16|32|64)"
)
_TYPE = re.compile(
    r"SampleCountFlag|^(?:u?int(?:8|16|32|64)?(?:_t)?|unsigned|size_t|VkFlags|u32|Uint32|uint|to_underlying|move)$"
)
_LESSER = frozenset({"min", "MIN", "Min", "qMin", "fmin", "SDL_min", "ImMin"})
_GREATER = frozenset({"max", "MAX", "Max", "qMax", "fmax", "SDL_max", "ImMax"})
_FORMS = {
    "bit_floor": "COUNT", "highestBitValue": "COUNT", "highest_one_bit": "COUNT",
    "prevPowerOfTwo": "COUNT",
    "__builtin_clz": "ZEROS", "__builtin_clzl": "ZEROS", "countl_zero": "ZEROS",
    "__lzcnt": "ZEROS", "_lzcnt_u32": "ZEROS", "clz": "ZEROS",
    "findMSB": "INDEX", "log2": "INDEX", "ilog2": "INDEX", "log2i": "INDEX", "log2f": "INDEX",
    "bit_width": "WIDTH",
    "leading_zeros": "ZEROS", "max_count": "COUNT",
}  # fmt: skip
"""What functions return of the highest bit of a mask."""

_TESTS = frozenset({"contains", "intersects", "contains_enum"})
"""Methods that test the bits of a mask."""

_NUMBERS = frozenset({"as_raw", "bits"})
"""Methods that return the number of a mask."""

_POWERS = frozenset({"pow", "exp2", "ldexp"})


class Mask(NamedTuple):
    """A sample count mask: the limits that it comes from with their locations, how and where they
    are combined, and the counts that it may contain.

    `known` is set if those are all its limits.
    """

    limits: tuple[tuple[str, Span], ...]
    combined: str
    at: Span
    allowed: int = EVERY
    known: bool = True

    @property
    def bit(self) -> int | None:
        """The count that is tested if only one bit is left, or None."""
        return self.allowed if self.allowed.bit_count() == 1 else None


class Highest(NamedTuple):
    """The highest bit of a mask (COUNT), its index (INDEX), the index plus one (WIDTH), or the
    number of zeros above it (ZEROS).
    """

    mask: Mask
    form: str


class Order(NamedTuple):
    """A list of counts."""

    counts: tuple[int, ...]


Value = Mask | Highest | Order | int
Bindings = dict[str, Value | None]
"""The values of names; None if unknown."""


def combine(masks: Iterable[Mask], how: str, at: Span) -> Mask:
    """Returns the combination of masks."""
    every = list(masks)
    limits: dict[str, Span] = {}
    allowed = EVERY if how == "AND" else 0
    worst, worst_at = how, at
    for mask in every:
        for name, place in mask.limits:
            limits.setdefault(name, place)
        allowed = allowed & mask.allowed if how == "AND" else allowed | mask.allowed
        if RANK.index(mask.combined) > RANK.index(worst):
            worst, worst_at = mask.combined, mask.at
    return Mask(tuple(limits.items()), worst, worst_at, allowed, all(mask.known for mask in every))


class Expressions:
    """Evaluates the expressions of one file. `returns` are the results of functions, `members` the
    values kept outside of functions.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.returns: Bindings = {}
        self.members: Bindings = {}

    def written(self, term: Term) -> str:
        """Returns the text of a term."""
        return self.text[term[-1].start : term[-1].end]

    def value(self, term: Term | None, bindings: Bindings, depth: int = 0) -> Value | None:
        """Returns the value of an expression, or None if it is unknown."""
        if term is None or depth > MAX_DEPTH:
            return None
        kind, deeper = term[0], depth + 1
        if kind == LITERAL:
            return term[1] if type(term[1]) is int else None
        if kind in (NAME, FIELD):
            return self._named(term, bindings)
        if kind in (ADDRESS, TARGET):
            return self.value(term[1], bindings, deeper)
        if kind == BINARY:
            return self._binary(term, bindings, deeper)
        if kind == UNARY:
            return self._unary(term, bindings, deeper)
        if kind == CHOICE:
            return self._choice(term, bindings, deeper)
        if kind == INDEX:
            return self._item(term, bindings, deeper)
        if kind == ASSIGN:
            return self.value(term[3], bindings, deeper)
        if kind == BRACES:
            return self._list(term, bindings, deeper)
        return self._call(term, bindings, deeper) if kind == CALL else None

    def _named(self, term: Term, bindings: Bindings) -> Value | None:
        text = str(term[1]) if term[0] == NAME else ""
        if 0 < len(text) < 60 and text not in bindings:
            match = _ENUMERANT.fullmatch(text) or _HPP.fullmatch(text) or _RUST.fullmatch(text)
            if match is not None and int(match[1]) in COUNTS:
                return int(match[1])
        name = name_of(term)
        if name in bindings and term[0] == NAME:
            return bindings[name]
        limit = _LIMITS.get(name.replace("_", "").lower())
        if limit is not None:
            return Mask(((limit, place := whole(term)),), "NONE", place)
        value = bindings[name] if name in bindings else self.members.get(name)
        if value is None and name in ("sampleCounts", "sample_counts") and term[0] == FIELD:
            return Mask((), "NONE", term[-1], known=False)
        return value

    def _binary(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        operator = term[1]
        left, right = (self.value(side, bindings, depth) for side in term[2:4])
        if left is None or right is None:
            return None
        if isinstance(left, int) and isinstance(right, int):
            return arithmetic(operator, left, right)
        if isinstance(left, Mask) and isinstance(right, Mask):
            at = self.sign(term)
            if operator in ("&", "bitand"):
                return combine((left, right), "AND", at)
            if operator in ("|", "bitor"):
                return combine((left, right), "OR", at)
            if operator in ("&&", "and", "||", "or"):
                if operator in ("&&", "and") and left.bit is not None and left.bit == right.bit:
                    return combine((left, right), "AND", at)
                how = "LOGICAL_AND" if operator in ("&&", "and") else "LOGICAL_OR"
                return (
                    combine((left, right), how, at)
                    if left.bit is None and right.bit is None
                    else None
                )
            return None
        if (
            isinstance(left, int)
            and isinstance(right, Mask)
            and operator in ("&", "bitand", "==", "!=")
        ):
            left, right = right, left
        if isinstance(left, Mask) and isinstance(right, int):
            if operator in ("&", "bitand"):
                return left._replace(allowed=left.allowed & right)
            same = (operator in ("!=", ">", "not_eq") and right == 0) or (
                operator == "==" and left.bit == right
            )
            return left if same else None
        return _highest_bit_arithmetic(operator, left, right)

    def sign(self, term: Term) -> Span:
        """Returns the place of the operator of a binary expression."""
        start = self.text.find(term[1], term[2][-1].end, term[3][-1].start)
        return Span(start, start + len(term[1])) if start >= 0 else at(term)

    def _unary(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        operator, inner = term[1], term[2]
        if operator == "!":
            negated = self.negated(term)
            if negated is not None and negated[0] == UNARY and negated[1] == "!":
                return self.value(negated[2], bindings, depth)
            empty = empty_of(inner)
            if empty is not None:
                return self.value(empty, bindings, depth)
        value = self.value(inner, bindings, depth)
        if operator == "!" and isinstance(value, int):
            return int(not value)
        return EVERY & ~value if operator == "~" and isinstance(value, int) else None

    def negated(self, term: Term) -> Term | None:
        """Returns the operand of a negated condition."""
        if term[0] == UNARY and term[1] == "!":
            operand: Term = term[2]
            return operand
        if term[0] == BINARY and term[1] == "==" and self.value(term[3], {}) == 0:
            compared: Term = term[2]
            return compared
        return empty_of(term)

    def comparison(
        self, term: Term | None, bindings: Bindings, depth: int = 0
    ) -> tuple[Mask, Mask, bool, Span] | None:
        """Returns two masks that a condition compares as numbers, whether it holds if the first is
        less, and its location;

        None for other conditions.
        """
        if term is None or term[0] != BINARY or term[1] not in ("<", ">", "<=", ">="):
            return None
        left, right = (self.value(side, bindings, depth + 1) for side in term[2:4])
        if not (isinstance(left, Mask) and isinstance(right, Mask)):
            return None
        return left, right, term[1][0] == "<", term[-1]

    def minimum(
        self, compared: tuple[Mask, Mask, bool, Span], then: Value | None, other: Value | None
    ) -> Mask | None:
        """Returns the minimum or maximum of two compared masks, by the branch that is taken; None
        for other values.
        """
        left, right, less, at = compared
        if not (isinstance(then, Mask) and isinstance(other, Mask)):
            return None
        names = [[name for name, _ in mask.limits] for mask in (left, right, then, other)]
        if names[0] == names[1] or not (names[2:] == names[:2] or names[2:] == names[1::-1]):
            return None
        return combine((left, right), "MIN" if (names[2] == names[0]) == less else "MAX", at)

    def _choice(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        then, other = (self.value(side, bindings, depth) for side in term[2:4])
        if not (isinstance(then, Mask) and isinstance(other, Mask)):
            return None
        compared = self.comparison(term[1], bindings, depth)
        if compared is not None:
            return self.minimum(compared, then, other)
        more = then if len(then.limits) >= len(other.limits) else other
        both = combine((then, other), more.combined, more.at)
        return both._replace(allowed=then.allowed | other.allowed)

    def _item(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        order, index = self.value(term[1], bindings, depth), self.value(term[2], bindings, depth)
        if isinstance(order, Order) and isinstance(index, int) and 0 <= index < len(order.counts):
            return order.counts[index]
        return None

    def _list(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        if len(term[2]) > 64:
            return None
        values = [self.value(item, bindings, depth) for _, item in term[2]]
        if len(values) == 1 and (
            not isinstance(values[0], int) or _TYPE.search(last(term[1])) is not None
        ):
            return values[0]
        counts = tuple(value for value in values if isinstance(value, int))
        return Order(counts) if counts and len(counts) == len(values) else None

    def _call(self, term: Term, bindings: Bindings, depth: int) -> Value | None:
        function, arguments = term[1], term[2]
        name = name_of(function)
        if function[0] == FIELD and (
            name in _TESTS or name in _NUMBERS or (name in _FORMS and not arguments)
        ):
            return self._method(function[1], name, arguments, bindings, depth)
        if len(arguments) == 1 and arguments[0][0] == BRACES and name in _LESSER | _GREATER:
            arguments = tuple(item for _, item in arguments[0][2])
        if len(arguments) > 8:
            return None
        values = [self.value(item, bindings, depth) for item in arguments]
        if len(arguments) == 1 and _TYPE.search(name) is not None:
            return values[0]
        if name in _LESSER or name in _GREATER:
            masks = [value for value in values if isinstance(value, Mask)]
            return (
                combine(masks, "MIN" if name in _LESSER else "MAX", at(function))
                if len(masks) == len(values) > 1
                else None
            )
        if (
            name in _POWERS
            and isinstance(values[-1] if values else None, Highest)
            and values[:-1] in ([], [2], [1])
        ):
            highest = values[-1]
            return (
                highest._replace(form="COUNT")
                if isinstance(highest, Highest) and highest.form == "INDEX"
                else None
            )
        first = values[0] if len(values) == 1 else None
        if isinstance(first, Mask) and name in _FORMS:
            return Highest(first, _FORMS[name])
        if isinstance(first, Highest) and name == "floor":
            return first
        return self.returns.get(name) if function[0] in (NAME, FIELD) else None

    def _method(
        self, receiver: Term, name: str, arguments: tuple[Term, ...], bindings: Bindings, depth: int
    ) -> Value | None:
        """Returns the result of a method of a mask or a number."""
        value = self.value(receiver, bindings, depth)
        if name in _NUMBERS:
            return value if not arguments else None
        if not isinstance(value, Mask):
            return None
        if name in _FORMS:
            return Highest(value, _FORMS[name])
        bit = self.value(arguments[0], bindings, depth) if len(arguments) == 1 else None
        return value._replace(allowed=value.allowed & bit) if isinstance(bit, int) else None


def name_of(term: Term | None) -> str:
    """Returns the last part of a name, without object, scope, and template arguments."""
    if term is None or term[0] not in (NAME, FIELD):
        return ""
    return last(str(term[1])) if term[0] == NAME else str(term[2])


def whole(term: Term) -> Span:
    """Returns the place of an expression with the object that it is a member of."""
    first = term
    while first[0] == FIELD:
        first = first[1]
    return Span(first[-1].start, term[-1].end)


def empty_of(term: Term) -> Term | None:
    """Returns the mask of which a call tells whether it is empty, or None."""
    if term[0] == CALL and term[1][0] == FIELD and term[1][2] == "is_empty" and not term[2]:
        mask: Term = term[1][1]
        return mask
    return None


def _highest_bit_arithmetic(operator: str, left: Value, right: Value) -> Value | None:
    """Returns the result of arithmetic on the index of a mask's highest bit."""
    if isinstance(right, Highest) and isinstance(left, int):
        if operator == "<<" and left == 1 and right.form == "INDEX":
            return Highest(right.mask, "COUNT")
        if operator in ("-", "^") and left in (31, 63) and right.form == "ZEROS":
            return Highest(right.mask, "INDEX")
        if operator == "-" and left in (32, 64) and right.form == "ZEROS":
            return Highest(right.mask, "WIDTH")
    if isinstance(left, Highest) and operator == "-" and right == 1 and left.form == "WIDTH":
        return Highest(left.mask, "INDEX")
    return None
