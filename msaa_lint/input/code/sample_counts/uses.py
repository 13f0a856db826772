"""How a program uses the sample count that it chooses: what caps it, and the formats of the images that have it."""

from __future__ import annotations

import re

from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import format_of
from msaa_lint.input.code.parsing import SyntaxNode, fields, function_declarator, span, without_comments

from .masks import COUNTS, Expressions

MAX_USES = 200
"""The maximum number of uses of a name; names used more often are skipped."""

MAX_STEPS = 300_000
"""The maximum number of nodes searched for formats in a file."""

MAX_MEMBERS = 2000
"""The maximum number of uses of a member name searched for one structure."""

MAX_NAMES = 12
"""The maximum number of names that hold a count."""

_CAPS = frozenset({"min", "MIN", "Min", "clamp", "Clamp", "CLAMP", "qMin", "qBound", "SDL_min"})
_NOTHING_ELSE = frozenset({"parenthesized_expression", "cast_expression", "static_cast", "initializer_list", "condition_clause"})
_DECLARING = frozenset({"field_expression", "array_declarator", "pointer_declarator", "reference_declarator"})
_FORMATS = {name.replace("_", "").lower(): name for name in VALUES["VkFormat"]}
"""The formats by their spelling in vulkan.hpp, in lower case: `D24UnormS8Uint` is D24_UNORM_S8_UINT."""

_SAMPLES = ("samples", "rasterizationSamples", "sampleCount")


class Uses:
    """The uses of each name in a file, and the functions that it defines."""

    def __init__(self, root: SyntaxNode, expressions: Expressions) -> None:
        self.expressions = expressions
        self._named: dict[str, list[SyntaxNode]] = {}
        self._functions: dict[str, SyntaxNode] = {}
        self._left = MAX_STEPS
        self._used: dict[str, list[SyntaxNode]] = {}
        self._held: dict[str, list[str]] = {}
        stack = [root]
        while stack:
            node = stack.pop()
            if node.type in ("identifier", "field_identifier"):
                self._named.setdefault(expressions.text_of(node), []).append(node)
            elif node.type == "function_definition":
                _, name = function_declarator(node)
                if name is not None:
                    self._functions.setdefault(expressions.name(name), node)
            stack += reversed(node.named_children)

    def holders(self, name: str) -> list[str]:
        """Returns the names that hold a count: a function or variable, and the variables that receive its value."""
        if name in self._held:
            return self._held[name]
        holders = self._held[name] = [name]
        for holder in holders:
            for node in self._uses(holder)[:MAX_USES]:
                receiver = _receiver(node)
                target = self.expressions.name(receiver)
                if receiver is not None and target in _SAMPLES:
                    # Many structures have a member of that name, including the ones that describe images.
                    target = "" if receiver.type == "field_expression" and self._beside(node) else self.expressions.text_of(receiver)
                if target and target not in holders and len(holders) < MAX_NAMES:
                    holders.append(target)
        return holders

    def _uses(self, name: str) -> list[SyntaxNode]:
        """Returns the uses of a name; those of a member only where its object is written the same way."""
        if name in self._used:
            return self._used[name]
        short = re.split(r"->|\.", name)[-1]
        uses = self._named.get(short, [])
        if short != name:
            near = uses if len(uses) <= MAX_MEMBERS else []
            uses = [item for item in near if item.parent is not None and self.expressions.text_of(item.parent) == name]
        elif name in _SAMPLES:
            uses = [item for item in uses if item.type == "identifier"]
        self._used[name] = uses
        return uses

    def cap(self, name: str) -> int | None:
        """Returns the count that caps it, 0 if the cap is unknown, and None if there is none."""
        caps: list[int] = []
        for holder in self.holders(name):
            uses = self._uses(holder)
            if len(uses) > MAX_USES:
                return 0
            for node in uses:
                limit = self._capped(node)
                if limit is not None:
                    caps.append(limit)
        return min(caps) if caps else None

    def _capped(self, node: SyntaxNode) -> int | None:
        """Returns the cap in a use of a count, as `cap` does."""
        value, parent = _enclosing_use(node)
        if parent is None:
            return None
        if parent.type == "argument_list" and parent.parent is not None:
            if self.expressions.name(parent.parent.child_by_field_name("function")) not in _CAPS:
                return None
            others = [child for child in without_comments(parent) if child != value]
            limit = self.expressions.value(others[0], {}) if len(others) == 1 else None
            return limit if isinstance(limit, int) and limit in COUNTS else 0
        if parent.type == "binary_expression":
            operator = self.expressions.text_of(parent.child_by_field_name("operator"))
            other = parent.child_by_field_name("right" if parent.child_by_field_name("left") == value else "left")
            if operator in ("<", ">", "<=", ">=") and self.expressions.value(other, {}) not in (0, 1):
                return 0
        return None

    def formats(self, name: str) -> dict[str, Span]:
        """Returns the depth and stencil formats of images that have the count, and where each is named."""
        formats: dict[str, Span] = {}
        for holder in self.holders(name):
            for node in self._uses(holder)[:MAX_USES]:
                for expression in self._beside(node):
                    self._formats(expression, formats, 0, set())
        return formats

    def _beside(self, node: SyntaxNode) -> list[SyntaxNode]:
        """Returns expressions that may be the format where a count is used for an image: other call arguments, the member `format`."""
        value, parent = _enclosing_use(node)
        if parent is None:
            return []
        if parent.type == "argument_list":
            return [child for child in parent.named_children if child != value]
        if parent.type == "assignment_expression" and parent.child_by_field_name("right") == value:
            left = parent.child_by_field_name("left")
            if left is None or left.type != "field_expression" or self.expressions.name(left) != "samples":
                return []
            structure = left.child_by_field_name("argument")
            name = self.expressions.text_of(structure)
            if len(self._member(parent, name, "samples")) > 1:
                # The structure describes several images; which format goes with the count is unknown.
                return []
            return self._member(parent, name, "format")
        if parent.type == "initializer_pair" and parent.parent is not None:
            members = [child for child in parent.parent.named_children if child.type == "initializer_pair"]
            if self.expressions.text_of(parent).lstrip(". ").startswith("samples"):
                return [child for child in members if self.expressions.text_of(child).lstrip(". ").startswith("format")]
        return []

    def _member(self, node: SyntaxNode, structure: str, member: str) -> list[SyntaxNode]:
        """Returns the values assigned to a member of a structure in the enclosing function."""
        around = node.parent
        while around is not None and around.type not in ("function_definition", "lambda_expression", "translation_unit"):
            around = around.parent
        values = []
        for use in self._named.get(member, ())[:MAX_USES]:
            field = use.parent
            assignment = field.parent if field is not None else None
            if around is None or field is None or assignment is None or assignment.type != "assignment_expression":
                continue
            left, right = fields(assignment, "left", "right")
            if left != field or right is None or not around.start_byte <= use.start_byte < around.end_byte:
                continue
            if self.expressions.text_of(field.child_by_field_name("argument")) == structure:
                values.append(right)
        return values

    def _formats(self, node: SyntaxNode, formats: dict[str, Span], depth: int, names: set[str]) -> None:
        """Adds the formats that an expression names, or that its variables and functions can hold or return."""
        stack = [node]
        while stack and self._left > 0:
            inner = stack.pop()
            self._left -= 1
            if inner.type in ("binary_expression", "case_statement", "lambda_expression"):
                continue
            if inner.type in ("identifier", "field_identifier", "qualified_identifier"):
                name = format_name(self.expressions.text_of(inner))
                if name is not None:
                    form = format_of(name)
                    if form is not None and not {"depth", "stencil"}.isdisjoint(form.aspects):
                        formats.setdefault(name, span(inner))
                    continue
                short = self.expressions.name(inner)
                if depth < 3 and short not in names and ("ormat" in short or short in self._functions):
                    names.add(short)
                    self._left -= min(len(self._named.get(short, ())), MAX_USES)
                    for source in self._sources(short, inner):
                        self._formats(source, formats, depth + 1, names)
                if inner.type == "qualified_identifier":
                    continue
            stack += reversed(inner.named_children)

    def _sources(self, name: str, at: SyntaxNode) -> list[SyntaxNode]:
        """Returns the values assigned to a name, or the body of the function with that name."""
        parent = at.parent
        called = parent is not None and parent.type == "call_expression" and parent.child_by_field_name("function") == at
        if name in self._functions and (called or (parent is not None and parent.type in ("field_expression", "qualified_identifier"))):
            body = self._functions[name].child_by_field_name("body")
            return [body] if body is not None else []
        sources = []
        for node in self._named.get(name, ())[:MAX_USES]:
            holder: SyntaxNode | None = node.parent
            field = node
            while holder is not None and holder.type in _DECLARING:
                field, holder = holder, holder.parent
            if holder is None:
                continue
            value = holder.child_by_field_name("value" if holder.type == "init_declarator" else "right")
            if holder.type in ("init_declarator", "assignment_expression") and value is not None and value != field:
                sources.append(value)
        return sources


def _enclosing_use(node: SyntaxNode) -> tuple[SyntaxNode, SyntaxNode | None]:
    """Returns a name with its surrounding object, call, parentheses, and casts, and the node that contains all of it."""
    for _ in range(12):
        parent = node.parent
        if parent is None:
            return node, None
        same = parent.type in _NOTHING_ELSE or (parent.type in ("field_expression", "qualified_identifier") and _last(parent) == node)
        called = parent.type == "call_expression" and parent.child_by_field_name("function") == node
        cast = parent.type == "argument_list" and parent.parent is not None and parent.named_child_count == 1 and _is_cast(parent.parent)
        if cast and parent.parent is not None:
            node = parent.parent
        elif same or called:
            node = parent
        else:
            return node, parent
    return node, node.parent


def _last(node: SyntaxNode) -> SyntaxNode | None:
    return node.child_by_field_name("field") or node.child_by_field_name("name")


def _is_cast(node: SyntaxNode) -> bool:
    function = node.child_by_field_name("function")
    name = function.child_by_field_name("name") if function is not None and function.type == "template_function" else function
    return node.type == "call_expression" and name is not None and name.text in (b"static_cast", b"reinterpret_cast", b"uint32_t", b"int")


def _receiver(node: SyntaxNode) -> SyntaxNode | None:
    """Returns the node that receives the value of a use, or None."""
    value, parent = _enclosing_use(node)
    if parent is None:
        return None
    source, target = ("value", "declarator") if parent.type == "init_declarator" else ("right", "left")
    if parent.type in ("init_declarator", "assignment_expression") and parent.child_by_field_name(source) == value:
        return parent.child_by_field_name(target)
    around = parent.parent
    if parent.type == "argument_list" and parent.named_child_count == 1 and around is not None and around.type == "field_initializer":
        # `samples(pick())` in a constructor.
        return around.named_children[0]
    return None


def format_name(text: str) -> str | None:
    """Returns the format that a name denotes, in either spelling."""
    if text.startswith("VK_FORMAT_"):
        name = text.removeprefix("VK_FORMAT_")
        return name if name in VALUES["VkFormat"] else None
    return _FORMATS.get(text.rpartition("Format::e")[2].lower()) if "Format::e" in text else None
