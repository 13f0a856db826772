"""Evaluates C and C++ expressions of sample count masks: the limits that they come from and how they are combined."""

import re
from collections.abc import Iterable
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader, fields, span, without_comments

from .arithmetic import arithmetic, whole
from .statements import MAX_DEPTH, unwrapped

LIMITS = frozenset({
    "framebufferColorSampleCounts", "framebufferDepthSampleCounts", "framebufferStencilSampleCounts",
    "framebufferNoAttachmentsSampleCounts", "framebufferIntegerColorSampleCounts", "sampledImageColorSampleCounts",
    "sampledImageIntegerSampleCounts", "sampledImageDepthSampleCounts", "sampledImageStencilSampleCounts", "storageImageSampleCounts",
})  # fmt: skip
"""The members of VkPhysicalDeviceLimits and VkPhysicalDeviceVulkan12Properties that are sample count masks."""

COUNTS = (64, 32, 16, 8, 4, 2, 1)
EVERY = 127
"""The mask with every count."""

RANK = ("NONE", "AND", "LOGICAL_AND", "LOGICAL_OR", "OR", "MAX", "MIN")
"""Ways to combine masks, from correct to wrong."""

_ENUMERANT = re.compile(r"VK_SAMPLE_COUNT_(\d{1,2})_BIT")
_HPP = re.compile(r"(?:(?:vk::)?SampleCountFlagBits::)?e(1|2|4|8|16|32|64)")
_TYPE = re.compile(r"SampleCountFlag|^(?:u?int(?:8|16|32|64)?(?:_t)?|unsigned|size_t|VkFlags|u32|Uint32|uint|to_underlying|move)$")
_CASTS = frozenset({"static_cast", "reinterpret_cast", "const_cast", "bit_cast"})
_LESSER = frozenset({"min", "MIN", "Min", "qMin", "fmin", "SDL_min", "ImMin"})
_GREATER = frozenset({"max", "MAX", "Max", "qMax", "fmax", "SDL_max", "ImMax"})
_FORMS = {
    "bit_floor": "COUNT", "highestBitValue": "COUNT", "highest_one_bit": "COUNT", "prevPowerOfTwo": "COUNT",
    "__builtin_clz": "ZEROS", "__builtin_clzl": "ZEROS", "countl_zero": "ZEROS", "__lzcnt": "ZEROS", "_lzcnt_u32": "ZEROS", "clz": "ZEROS",
    "findMSB": "INDEX", "log2": "INDEX", "ilog2": "INDEX", "log2i": "INDEX", "log2f": "INDEX", "bit_width": "WIDTH",
}  # fmt: skip
"""What functions return of the highest bit of a mask."""

_POWERS = frozenset({"pow", "exp2", "ldexp"})


class Mask(NamedTuple):
    """A sample count mask: the limits that it comes from with their locations, how and where they are combined, and the counts that it may
    contain.

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
    """The highest bit of a mask (COUNT), its index (INDEX), the index plus one (WIDTH), or the number of zeros above it (ZEROS)."""

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


class Expressions(SyntaxReader):
    """Evaluates the expressions of one file. `returns` are the results of functions, `members` the values kept outside of functions."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.returns: Bindings = {}
        self.members: Bindings = {}

    def name(self, node: SyntaxNode | None) -> str:
        """Returns the last part of a name, without object, scope, and template arguments."""
        while node is not None and node.type in ("field_expression", "template_function", "qualified_identifier", "template_method"):
            node = node.child_by_field_name("field") or node.child_by_field_name("name")
        return self.text_of(node) if node is not None and node.end_byte - node.start_byte < 200 else ""

    def value(self, node: SyntaxNode | None, bindings: Bindings, depth: int = 0) -> Value | None:
        """Returns the value of an expression, or None if it is unknown."""
        if node is None or depth > MAX_DEPTH:
            return None
        kind, deeper = node.type, depth + 1
        if kind == "number_literal":
            return whole(self.text_of(node))
        if kind in ("identifier", "qualified_identifier", "field_expression", "field_identifier"):
            return self._named(node, bindings)
        inner = unwrapped(node)
        if inner is not None and inner != node:
            return self.value(inner, bindings, deeper)
        if kind == "binary_expression":
            return self._binary(node, bindings, deeper)
        if kind == "unary_expression":
            return self._unary(node, bindings, deeper)
        if kind == "conditional_expression":
            return self._choice(node, bindings, deeper)
        if kind == "subscript_expression":
            return self._item(node, bindings, deeper)
        if kind in ("assignment_expression", "compound_literal_expression"):
            return self.value(node.child_by_field_name("right") or node.child_by_field_name("value"), bindings, deeper)
        if kind == "initializer_list":
            return self._list(node, bindings, deeper)
        return self._call(node, bindings, deeper) if kind == "call_expression" else None

    def _named(self, node: SyntaxNode, bindings: Bindings) -> Value | None:
        text = self.text_of(node)
        if len(text) < 60:
            match = _ENUMERANT.fullmatch(text) or _HPP.fullmatch(text)
            if match is not None and int(match[1]) in COUNTS and text not in bindings:
                return int(match[1])
        name = self.name(node)
        if name in bindings and node.type != "field_expression":
            return bindings[name]
        if name in LIMITS:
            at = span(node)
            return Mask(((name, at),), "NONE", at)
        value = bindings[name] if name in bindings else self.members.get(name)
        if value is None and name == "sampleCounts" and node.type == "field_expression":
            return Mask((), "NONE", span(node), known=False)
        return value

    def _binary(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        sign, *sides = fields(node, "operator", "left", "right")
        operator = self.text_of(sign)
        left, right = (self.value(side, bindings, depth) for side in sides)
        if sign is None or left is None or right is None:
            return None
        if isinstance(left, int) and isinstance(right, int):
            return arithmetic(operator, left, right)
        at = span(sign)
        if isinstance(left, Mask) and isinstance(right, Mask):
            if operator in ("&", "bitand"):
                return combine((left, right), "AND", at)
            if operator in ("|", "bitor"):
                return combine((left, right), "OR", at)
            if operator in ("&&", "and", "||", "or"):
                if operator in ("&&", "and") and left.bit is not None and left.bit == right.bit:
                    return combine((left, right), "AND", at)
                how = "LOGICAL_AND" if operator in ("&&", "and") else "LOGICAL_OR"
                return combine((left, right), how, at) if left.bit is None and right.bit is None else None
            return None
        if isinstance(left, int) and isinstance(right, Mask) and operator in ("&", "bitand", "==", "!="):
            left, right = right, left
        if isinstance(left, Mask) and isinstance(right, int):
            if operator in ("&", "bitand"):
                return left._replace(allowed=left.allowed & right)
            same = (operator in ("!=", ">", "not_eq") and right == 0) or (operator == "==" and left.bit == right)
            return left if same else None
        return _highest_bit_arithmetic(operator, left, right)

    def _unary(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        inner = node.child_by_field_name("argument")
        operator = self.text_of(node)[:1]
        if operator == "!" and inner is not None and inner.type == "unary_expression" and self.text_of(inner)[:1] == "!":
            return self.value(inner.child_by_field_name("argument"), bindings, depth)
        value = self.value(inner, bindings, depth)
        if operator == "!" and isinstance(value, int):
            return int(not value)
        return EVERY & ~value if operator == "~" and isinstance(value, int) else None

    def comparison(self, node: SyntaxNode | None, bindings: Bindings, depth: int = 0) -> tuple[Mask, Mask, bool, Span] | None:
        """Returns two masks that a condition compares as numbers, whether it holds if the first is less, and its location;

        None for other conditions.
        """
        node = unwrapped(node)
        if node is None or node.type != "binary_expression":
            return None
        sign, *sides = fields(node, "operator", "left", "right")
        operator = self.text_of(sign)
        if operator not in ("<", ">", "<=", ">="):
            return None
        left, right = (self.value(side, bindings, depth + 1) for side in sides)
        if not (isinstance(left, Mask) and isinstance(right, Mask)):
            return None
        return left, right, operator[0] == "<", span(node)

    def minimum(self, compared: tuple[Mask, Mask, bool, Span], then: Value | None, other: Value | None) -> Mask | None:
        """Returns the minimum or maximum of two compared masks, by the branch that is taken; None for other values."""
        left, right, less, at = compared
        if not (isinstance(then, Mask) and isinstance(other, Mask)):
            return None
        names = [[name for name, _ in mask.limits] for mask in (left, right, then, other)]
        if names[0] == names[1] or not (names[2:] == names[:2] or names[2:] == names[1::-1]):
            return None
        return combine((left, right), "MIN" if (names[2] == names[0]) == less else "MAX", at)

    def _choice(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        then, other = (self.value(node.child_by_field_name(side), bindings, depth) for side in ("consequence", "alternative"))
        if not (isinstance(then, Mask) and isinstance(other, Mask)):
            return None
        compared = self.comparison(node.child_by_field_name("condition"), bindings, depth)
        if compared is not None:
            return self.minimum(compared, then, other)
        more = then if len(then.limits) >= len(other.limits) else other
        both = combine((then, other), more.combined, more.at)
        return both._replace(allowed=then.allowed | other.allowed)

    def _item(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        operand, index_node, list_node = fields(node, "argument", "index", "indices")
        if list_node is not None:
            index_node = next(iter(list_node.named_children), None)
        order, index = self.value(operand, bindings, depth), self.value(index_node, bindings, depth)
        if isinstance(order, Order) and isinstance(index, int) and 0 <= index < len(order.counts):
            return order.counts[index]
        return None

    def _list(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        items = without_comments(node)
        if len(items) > 64:
            return None
        values = [self.value(item, bindings, depth) for item in items]
        if len(values) == 1 and not isinstance(values[0], int):
            return values[0]
        counts = tuple(value for value in values if isinstance(value, int))
        return Order(counts) if counts and len(counts) == len(values) else None

    def _call(self, node: SyntaxNode, bindings: Bindings, depth: int) -> Value | None:
        function, list_node = fields(node, "function", "arguments")
        name = self.name(function)
        arguments = without_comments(list_node)
        if len(arguments) == 1 and arguments[0].type == "initializer_list" and name in _LESSER | _GREATER:
            arguments = without_comments(arguments[0])
        if function is None or len(arguments) > 8:
            return None
        values = [self.value(item, bindings, depth) for item in arguments]
        if len(arguments) == 1 and (name in _CASTS or _TYPE.search(name) is not None):
            return values[0]
        if name in _LESSER or name in _GREATER:
            masks = [value for value in values if isinstance(value, Mask)]
            at = span(function)
            return combine(masks, "MIN" if name in _LESSER else "MAX", at) if len(masks) == len(values) > 1 else None
        if name in _POWERS and isinstance(values[-1] if values else None, Highest) and values[:-1] in ([], [2], [1]):
            highest = values[-1]
            return highest._replace(form="COUNT") if isinstance(highest, Highest) and highest.form == "INDEX" else None
        first = values[0] if len(values) == 1 else None
        if isinstance(first, Mask) and name in _FORMS:
            return Highest(first, _FORMS[name])
        if isinstance(first, Highest) and name == "floor":
            return first
        return self.returns.get(name) if function.type in ("identifier", "field_expression", "qualified_identifier") else None


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
