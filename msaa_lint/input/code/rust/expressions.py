"""Converts Rust expressions to terms.

What only says who owns a value, or that it may be missing, is removed: `&*x`, `x.clone()`, `x?`,
`Some(x)`, and `unsafe { x }` are `x`.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod

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
    LAMBDA,
    LITERAL,
    NAME,
    RETURN,
    TARGET,
    UNARY,
    UNPARSED,
    Parameter,
    Term,
)
from msaa_lint.input.code.parsing import SyntaxNode, SyntaxReader, fields, span

from .imports import Imports

MAX_DEPTH = 120
"""The maximum nesting of expressions and blocks."""

MAX_NAME = 300
"""The maximum length of a path; longer ones are unknown."""

BLOCKS = frozenset(
    {"block", "unsafe_block", "async_block", "const_block", "gen_block", "try_block"}
)

_NUMBER = re.compile(
    r"(0x[0-9a-fA-F_]{1,32}|0b[01_]{1,140}|0o[0-7_]{1,44}|[0-9][0-9_]{0,40})(?:[iu](?:8|16|32|64|128|size))?"
)
_REAL = re.compile(r"([0-9][0-9_]{0,40}\.?[0-9_]{0,40}(?:[eE][-+]?[0-9]{1,4})?)(?:_?f(?:32|64))?")
_SAME = frozenset({
    "unwrap", "expect", "unwrap_unchecked", "map_err", "ok", "ok_or", "ok_or_else", "context",
    "with_context", "wrap_err",
    "clone", "to_owned", "into", "try_into", "as_ref", "as_mut", "as_deref", "as_deref_mut",
    "to_vec", "as_slice", "as_mut_slice",
    "into_boxed_slice", "iter", "iter_mut", "into_iter", "cloned", "copied", "collect", "borrow",
    "borrow_mut", "lock", "read",
    "write", "deref", "as_ptr", "as_mut_ptr", "unwrap_or_default", "by_ref", "into_inner", "result",
})  # fmt: skip
"""Methods whose result stands for the object that they are called on."""

_WRAPPERS = frozenset({
    "Some", "Ok", "Box::new", "Arc::new", "Rc::new", "Cell::new", "RefCell::new", "Mutex::new",
    "RwLock::new", "ManuallyDrop::new",
    "Cow::Borrowed", "Cow::Owned", "Vec::from", "slice::from_ref", "std::slice::from_ref",
    "core::slice::from_ref", "Box::pin",
})  # fmt: skip
"""Functions whose result stands for their argument."""

_OTHERWISE = frozenset({"unwrap_or", "or"})
_MAPPED = frozenset(
    {
        "map",
        "for_each",
        "flat_map",
        "filter_map",
        "and_then",
        "map_or",
        "map_or_else",
        "unwrap_or_else",
        "fold",
    }
)
"""Methods that call a closure."""

_EMPTY_LISTS = frozenset({"Vec::new", "Vec::with_capacity", "SmallVec::new", "ArrayVec::new"})


class Expressions(SyntaxReader, ABC):
    """The expressions of one file."""

    text: str
    imports: Imports
    class_name: str
    """The type that `Self` stands for, or empty."""
    current: str
    """The function whose body is read."""
    called_names: set[str]

    @abstractmethod
    def block(self, node: SyntaxNode, depth: int, is_value: bool) -> tuple[Term, ...]:
        """Returns the statements of a block; the last one returns the value of the block if
        `is_value` is set.
        """

    @abstractmethod
    def render_pass(self, node: SyntaxNode) -> Term | None:
        """Returns the render pass that a macro creates, or None for other macros."""

    @abstractmethod
    def conditional(self, node: SyntaxNode, depth: int, is_value: bool) -> Term:
        """Returns an `if` or a `match` as a statement."""

    def expression(self, node: SyntaxNode | None, depth: int) -> Term:
        """Returns the term of an expression."""
        if node is None or depth > MAX_DEPTH:
            return (UNPARSED, "", span(node) if node is not None else Span(0, 0))
        kind, at, deeper = node.type, span(node), depth + 1
        if kind in ("identifier", "scoped_identifier", "self", "generic_function"):
            return self.name(node, deeper)
        if kind == "field_expression":
            return self.field(node, deeper)
        if kind == "call_expression":
            return self.call(node, deeper)
        if kind == "struct_expression":
            return self.structure(node, deeper)
        if kind in (
            "try_expression",
            "await_expression",
            "parenthesized_expression",
            "type_cast_expression",
        ):
            inner = node.child_by_field_name("value")
            return self.expression(inner or next(iter(node.named_children), None), deeper)
        if kind == "reference_expression":
            return self.reference(node.child_by_field_name("value"), deeper, at)
        if kind in ("array_expression", "tuple_expression"):
            return self.listed(node, deeper)
        if kind in ("if_expression", "match_expression"):
            return self.choice(node, deeper)
        if kind in BLOCKS:
            return self.immediate(node, deeper)
        if kind == "macro_invocation":
            return self.render_pass(node) or (UNPARSED, self.text_of(node)[:100], at)
        return self.operation(node, deeper)

    def operation(self, node: SyntaxNode, depth: int) -> Term:
        """Returns a literal or an operation."""
        kind, at = node.type, span(node)
        if kind in ("integer_literal", "float_literal", "boolean_literal"):
            return self.literal(node)
        left, right = fields(node, "left", "right")
        operator = self.text_of(node.child_by_field_name("operator"))
        if kind == "binary_expression":
            return (
                BINARY,
                operator,
                self.expression(left, depth),
                self.expression(right, depth),
                at,
            )
        if kind in ("assignment_expression", "compound_assignment_expr"):
            return (
                ASSIGN,
                operator or "=",
                self.expression(left, depth),
                self.expression(right, depth),
                at,
            )
        if kind == "unary_expression":
            operand = self.expression(next(iter(node.named_children), None), depth)
            sign = self.text[node.start_byte]
            return (TARGET, operand, at) if sign == "*" else (UNARY, sign, operand, at)
        if kind == "index_expression" and node.named_child_count == 2:
            owner, index = node.named_children
            # A range of a list is taken for the list.
            term = self.expression(owner, depth)
            return (
                term
                if index.type == "range_expression"
                else (INDEX, term, self.expression(index, depth), at)
            )
        if kind == "closure_expression":
            return self.closure(node, depth)
        return (UNPARSED, self.text_of(node) if node.end_byte - node.start_byte < 200 else "", at)

    def literal(self, node: SyntaxNode) -> Term:
        text, at = self.text_of(node), span(node)
        if text in ("true", "false"):
            return (LITERAL, text == "true", at)
        match = _NUMBER.fullmatch(text)
        if match is not None:
            return (
                LITERAL,
                int(match[1].replace("_", ""), 0 if match[1][1:2].isalpha() else 10),
                at,
            )
        real = _REAL.fullmatch(text)
        return (
            (LITERAL, float(real[1].replace("_", "")), at)
            if real is not None
            else (UNPARSED, text[:40], at)
        )

    def path(self, node: SyntaxNode | None) -> str:
        """Returns a path without type arguments, with imported names and `Self` resolved."""
        if node is None or node.end_byte - node.start_byte > MAX_NAME:
            return ""
        parts = self.path_parts(node)
        if parts and parts[0] == "Self" and self.class_name:
            parts[0] = self.class_name
        return "::".join(
            self.imports.resolved(
                [part for part in parts if part not in ("crate", "super", "self")]
            )
        )

    def path_parts(self, node: SyntaxNode) -> list[str]:
        if node.type in ("scoped_identifier", "scoped_type_identifier"):
            path, name = fields(node, "path", "name")
            return [*(self.path_parts(path) if path is not None else ()), self.text_of(name)]
        if node.type in ("generic_type", "generic_type_with_turbofish", "generic_function"):
            inner = node.child_by_field_name("type") or node.child_by_field_name("function")
            return self.path_parts(inner) if inner is not None else []
        if node.type == "bracketed_type":
            # `<T as Trait>::name` and `<T>::name`.
            inner = node.named_children[0] if node.named_child_count else None
            inner = (
                inner.child_by_field_name("type")
                if inner is not None and inner.type == "qualified_type"
                else inner
            )
            return self.path_parts(inner) if inner is not None else []
        return [self.text_of(node)]

    def name(self, node: SyntaxNode, depth: int) -> Term:
        at = span(node)
        if node.type == "generic_function":
            inner = node.child_by_field_name("function")
            return self.expression(inner, depth)
        text = "this" if node.type == "self" else self.path(node)
        if not text:
            return (UNPARSED, "", at)
        return (LITERAL, None, at) if text in ("None", "vk::null") else (NAME, text, at)

    def field(self, node: SyntaxNode, depth: int) -> Term:
        owner, name = fields(node, "value", "field")
        term = self.expression(owner, depth)
        if name is None:
            return (UNPARSED, "", span(node))
        if name.type == "integer_literal":
            # A member of a tuple.
            return (INDEX, term, self.literal(name), span(node))
        return (FIELD, term, self.text_of(name)[:MAX_NAME], span(name))

    def reference(self, node: SyntaxNode | None, depth: int, at: Span) -> Term:
        term = self.expression(node, depth)
        if term[0] == TARGET:
            # `&*x`
            inner: Term = term[1]
            return inner
        return (
            (ADDRESS, term, at)
            if term[0] in (NAME, FIELD, INDEX) and term[:2] != (NAME, "this")
            else term
        )

    def listed(self, node: SyntaxNode, depth: int) -> Term:
        """Returns an array or a tuple as a list."""
        at = span(node)
        items = [
            child
            for child in node.named_children
            if "comment" not in child.type and child.type != "attribute_item"
        ]
        length = node.child_by_field_name("length")
        if length is not None and items:
            count = self.literal(length) if length.type == "integer_literal" else (UNPARSED, "", at)
            if type(count[1]) is not int or not 0 <= count[1] <= 64:
                return (UNPARSED, "", at)
            return (BRACES, "", ((None, self.expression(items[0], depth)),) * count[1], at)
        return (BRACES, "", tuple((None, self.expression(child, depth)) for child in items), at)

    def structure(self, node: SyntaxNode, depth: int) -> Term:
        """Returns a structure with designated members; the base after `..` comes first."""
        name, body = fields(node, "name", "body")
        items: Items = []
        for child in body.named_children if body is not None else ():
            if child.type == "field_initializer":
                member, value = fields(child, "field", "value")
                items.append(((self.text_of(member),), self.expression(value, depth)))
            elif child.type == "shorthand_field_initializer":
                inner = child.named_children[-1]
                items.append(((self.text_of(inner),), (NAME, self.text_of(inner), span(inner))))
            elif child.type == "base_field_initializer" and child.named_child_count:
                base = self.expression(child.named_children[0], depth)
                if not is_default(base):
                    items.insert(0, (("..",), base))
        kind = self.path(name)
        if self.imports.is_vulkano and kind == "vk::AttachmentDescription":
            items += stencil_operations(items)
        return (BRACES, kind, tuple(items), span(node))

    def closure(self, node: SyntaxNode, depth: int) -> Term:
        list_node, body = fields(node, "parameters", "body")
        parameters = []
        for child in list_node.named_children if list_node is not None else ():
            pattern, kind = (
                fields(child, "pattern", "type") if child.type == "parameter" else (child, None)
            )
            parameters.append(Parameter(self.type_text(kind), self.bound_name(pattern), True, None))
        if body is None:
            return (UNPARSED, "", span(node))
        statements = (
            self.block(body, depth, True)
            if body.type in BLOCKS
            else ((RETURN, self.expression(body, depth), span(body)),)
        )
        return (LAMBDA, tuple(parameters), statements, span(node))

    def bound_name(self, node: SyntaxNode | None) -> str:
        """Returns the name that a pattern binds, without `mut`, `ref`, `Some`, and `Ok`; empty for
        a pattern of several.
        """
        for _ in range(8):
            if node is None:
                return ""
            if node.type == "identifier":
                return self.text_of(node)
            if node.type == "tuple_struct_pattern" and self.text_of(
                node.child_by_field_name("type")
            ) not in ("Some", "Ok"):
                return ""
            if node.type not in (
                "mut_pattern",
                "ref_pattern",
                "reference_pattern",
                "tuple_struct_pattern",
                "captured_pattern",
            ):
                return ""
            inner = [
                child for child in node.named_children if child.type not in ("mutable_specifier",)
            ]
            node = inner[-1] if inner else None
        return ""

    def call(self, node: SyntaxNode, depth: int) -> Term:
        function, list_node = fields(node, "function", "arguments")
        at = span(node)
        nodes = (
            [child for child in list_node.named_children if "comment" not in child.type]
            if list_node is not None
            else []
        )
        if function is not None and function.type == "generic_function":
            function = function.child_by_field_name("function")
        if function is not None and function.type == "field_expression":
            return self.method(function, nodes, depth, at)
        term = self.expression(function, depth)
        name = str(term[1]) if term[0] == NAME else ""
        if name in _WRAPPERS and len(nodes) == 1:
            return self.expression(nodes[0], depth)
        if name.endswith(("ptr::null", "ptr::null_mut")):
            return (LITERAL, None, at)
        if name in _EMPTY_LISTS:
            return (BRACES, "", (), at)
        owner, _, short = name.rpartition("::")
        if (
            short in ("default", "builder", "new", "zeroed")
            and owner.startswith("vk::")
            and not nodes
        ):
            return (BRACES, owner, (), at)
        if short in ("empty", "null", "from_raw") and owner.startswith("vk::"):
            return (
                (LITERAL, None if short == "null" else 0, at)
                if short != "from_raw"
                else self.expression(next(iter(nodes), None), depth)
            )
        arguments = tuple(self.expression(child, depth) for child in nodes)
        if owner.startswith("vk::") and short.startswith("new"):
            return self.constructed(owner, arguments, at)
        self.note_call(short)
        return (CALL, term, arguments, at)

    def constructed(self, owner: str, arguments: tuple[Term, ...], at: Span) -> Term:
        """Returns the object that a constructor of vulkano creates, as the call of a function of
        Vulkan.
        """
        if owner == "vk::Framebuffer" and len(arguments) == 2 and arguments[1][0] == BRACES:
            # The render pass is not part of the structure.
            kind, items, place = arguments[1][1:]
            arguments = ((BRACES, kind, (*items, (("render_pass",), arguments[0])), place),)
        name = re.sub(r"(?=[A-Z])", "_", owner.rpartition("::")[2]).lower()
        return (CALL, (NAME, f"create{name}", at), arguments, at)

    def method(self, function: SyntaxNode, nodes: list[SyntaxNode], depth: int, at: Span) -> Term:
        """Returns the call of a method."""
        owner, member = fields(function, "value", "field")
        name = self.text_of(member)
        term = self.expression(owner, depth)
        if name in _SAME and len(nodes) <= 1 and not (name in ("read", "write") and nodes):
            return term
        if name in _OTHERWISE and len(nodes) == 1:
            return (
                CHOICE,
                (CALL, (FIELD, term, "is_some", at), (), at),
                term,
                self.expression(nodes[0], depth),
                at,
            )
        if name in _MAPPED and any(node.type == "closure_expression" for node in nodes):
            # What the closure creates is known, but not for which elements.
            calls = tuple(
                (CALL, self.expression(node, depth), (term,), span(node))
                for node in nodes
                if node.type == "closure_expression"
            )
            return (BINARY, ",", calls[0], (UNPARSED, "", at), at)
        if name in ("min", "max") and len(nodes) == 1:
            called = (NAME, name, span(member) if member is not None else at)
            return (CALL, called, (term, self.expression(nodes[0], depth)), at)
        short = {"len": "size"}.get(name, name)
        self.note_call(short)
        return (
            CALL,
            (FIELD, term, short, span(member) if member is not None else at),
            tuple(self.expression(n, depth) for n in nodes),
            at,
        )

    def note_call(self, name: str) -> None:
        if name != self.current:
            self.called_names.add(name)

    def choice(self, node: SyntaxNode, depth: int) -> Term:
        """Returns an `if` or a `match` as a value: a choice between expressions, or the result of
        its statements.
        """
        if node.type == "if_expression":
            test, then, other = fields(node, "condition", "consequence", "alternative")
            last = (
                other.named_children[-1] if other is not None and other.named_child_count else None
            )
            one, two = self.plain_value(then), self.plain_value(last)
            if (
                one is not None
                and two is not None
                and test is not None
                and test.type not in ("let_condition", "let_chain")
            ):
                return (
                    CHOICE,
                    self.expression(test, depth),
                    self.expression(one, depth),
                    self.expression(two, depth),
                    span(node),
                )
        at = span(node)
        return (CALL, (LAMBDA, (), (self.conditional(node, depth, True),), at), (), at)

    @staticmethod
    def plain_value(node: SyntaxNode | None) -> SyntaxNode | None:
        """Returns the only expression of a block, or None if it has statements."""
        if node is None or node.type == "if_expression":
            return node
        inner = [child for child in node.named_children if "comment" not in child.type]
        if len(inner) != 1 or inner[0].type.endswith(("statement", "declaration", "item")):
            return None
        return (
            None
            if inner[0].type in ("return_expression", "break_expression", "continue_expression")
            else inner[0]
        )

    def immediate(self, node: SyntaxNode, depth: int) -> Term:
        """Returns the value of a block."""
        body = (
            next((child for child in node.named_children if child.type == "block"), node)
            if node.type != "block"
            else node
        )
        inner = self.plain_value(body)
        if inner is not None:
            return self.expression(inner, depth)
        at = span(node)
        return (CALL, (LAMBDA, (), self.block(body, depth, True), at), (), at)

    def type_text(self, node: SyntaxNode | None) -> str:
        """Returns a type without references, lifetimes, and owners; lists as the core spells
        them.
        """
        for _ in range(12):
            if node is None or node.end_byte - node.start_byte > MAX_NAME:
                return ""
            if node.type in ("reference_type", "pointer_type"):
                node = node.child_by_field_name("type")
            elif node.type == "array_type":
                element, length = fields(node, "element", "length")
                return f"{self.type_text(element)}[{self.text_of(length) if length is not None else ''}]"  # noqa: E501
            elif node.type in ("dynamic_type", "abstract_type"):
                node = node.child_by_field_name("trait")
            elif node.type == "generic_type":
                name, arguments = fields(node, "type", "type_arguments")
                short = self.text_of(name).rpartition("::")[2]
                inner = (
                    next((c for c in arguments.named_children if c.type != "lifetime"), None)
                    if arguments is not None
                    else None
                )
                if short in ("Vec", "SmallVec", "ArrayVec", "VecDeque"):
                    return f"std::vector<{self.type_text(inner)}>"
                if short not in (
                    "Option",
                    "Result",
                    "Box",
                    "Arc",
                    "Rc",
                    "RefCell",
                    "Mutex",
                    "RwLock",
                    "Cell",
                    "ManuallyDrop",
                    "Cow",
                    "VkResult",
                ):
                    return self.path(name)
                node = inner
            else:
                return (
                    self.path(node)
                    if node.type in ("type_identifier", "scoped_type_identifier")
                    else self.text_of(node)
                )
        return ""


Items = list[tuple[tuple[str, ...] | None, Term]]
"""The members that a structure states, and their values."""


def stencil_operations(items: Items) -> Items:
    """Returns the stencil operations of an attachment of vulkano, which are those of color and
    depth where it states none.
    """
    stated = {path[0]: term for path, term in items if path is not None}
    return [
        ((f"stencil_{name}",), stated[name])
        for name in ("load_op", "store_op")
        if name in stated and f"stencil_{name}" not in stated
    ]


def is_default(term: Term) -> bool:
    """Returns whether a term is a structure of zeros: `Default::default()` or
    `vk::S::default()`.
    """
    if term[0] == BRACES:
        return not term[2]
    return bool(
        term[0] == CALL and term[1][0] == NAME and str(term[1][1]).rpartition("::")[2] == "default"
    )
