"""Converts Objective-C and Objective-C++, rewritten as C++, to terms."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.c.syntax import Reader
from msaa_lint.input.code.core.terms import (
    BINARY,
    CALL,
    FIELD,
    LABEL,
    LITERAL,
    NAME,
    UNARY,
    Function,
    Term,
    Unit,
)
from msaa_lint.input.code.parsing import (
    Code,
    SyntaxNode,
    function_declarator,
    span,
    without_comments,
)

from .messages import Message, Rewritten

_NULL = frozenset({"nil", "Nil", "NULL", "nullptr"})
_COMPARED = {"==": "!", "!=": ""}


def unit(code: Code, root: SyntaxNode, rewritten: Rewritten) -> Unit:
    """Returns the functions, class members, and global declarations of a file."""
    program = _Reader(code, rewritten).unit(root)
    return program._replace(bases=rewritten.bases, extended=rewritten.classes)


class _Reader(Reader):
    """Reads one file."""

    def __init__(self, code: Code, rewritten: Rewritten) -> None:
        super().__init__(code.text, code.fragments, ())
        self.rewritten = rewritten
        self.own_class = ""
        """The class whose method is read."""

    def expression(self, node: SyntaxNode | None, depth: int) -> Term:
        if node is None:
            return super().expression(node, depth)
        kind = node.type
        if kind in ("identifier", "this", "field_identifier"):
            name = self.text_of(node)
            if name in ("self", "this"):
                return (NAME, "this", span(node))
            if name in _NULL:
                return (LITERAL, None, span(node))
            if self.own_class and (own := property_name(name)) != name:
                return (FIELD, (NAME, "this", span(node)), own, span(node))
        if kind == "null":
            return (LITERAL, None, span(node))
        term = super().expression(node, depth)
        if kind == "field_expression" and term[0] == FIELD:
            message = self.message_of(term)
            if message is not None and message.labels is None:
                return self.sent(term, message, (), span(node))
            return (FIELD, term[1], property_name(term[2]), term[3])
        if (
            term[0] == BINARY
            and term[1] in _COMPARED
            and (LITERAL, None) in (term[2][:2], term[3][:2])
        ):
            operand = term[3] if term[2][:2] == (LITERAL, None) else term[2]
            return (
                (UNARY, "!", operand, term[-1])
                if term[1] == "=="
                else (UNARY, "!", (UNARY, "!", operand, term[-1]), term[-1])
            )
        return term

    def message_of(self, term: Term) -> Message | None:
        return self.rewritten.messages.get(term[3].start) if term[0] == FIELD else None

    def sent(self, function: Term, message: Message, arguments: tuple[Term, ...], at: Span) -> Term:
        """Returns a message as a call."""
        if message.name != self.current:
            self.called_names.add(message.name)
        return (CALL, (FIELD, function[1], message.name, function[3]), arguments, at)

    def call(self, node: SyntaxNode, depth: int, at: Span) -> Term:
        function = node.child_by_field_name("function")
        member = (
            function.child_by_field_name("field")
            if function is not None and function.type == "field_expression"
            else None
        )
        message = self.rewritten.messages.get(member.start_byte) if member is not None else None
        if function is None or message is None or message.labels is None:
            return super().call(node, depth, at)
        nodes = without_comments(node.child_by_field_name("arguments"))
        labels = ("", *message.labels)
        arguments = []
        for n, child in enumerate(nodes):
            term = self.expression(child, depth)
            arguments.append(
                (LABEL, labels[n], term, term[-1]) if n < len(labels) and labels[n] else term
            )
        receiver = self.expression(function.child_by_field_name("argument"), depth)
        return self.sent(
            (FIELD, receiver, message.name, span(member or function)), message, tuple(arguments), at
        )

    def declared(self, node: SyntaxNode, depth: int = 0) -> list[Term]:
        terms = super().declared(node, depth)
        if node.type != "field_declaration":
            # A pointer to an object is a variable of its own; only a reference of C++ stands for
            # another.
            refers = "&" in self.text_of(node).partition("=")[0]
            return [(*term[:4], term[4] and refers, *term[5:]) for term in terms]
        return [(*term[:2], property_name(term[2]), *term[3:]) for term in terms]

    def function_name(self, node: SyntaxNode) -> str:
        _, name = function_declarator(node)
        method = self.rewritten.methods.get(name.start_byte) if name is not None else None
        return method[1].name if method is not None else super().function_name(node)

    def function(self, node: SyntaxNode, namespace: str, class_name: str) -> Function | None:
        _, name = function_declarator(node)
        method = self.rewritten.methods.get(name.start_byte) if name is not None else None
        if method is None:
            self.own_class = ""
            return super().function(node, namespace, class_name)
        self.own_class, message = method
        function = super().function(node, "", self.own_class)
        self.own_class = ""
        if function is None:
            return None
        labels = ("", *(message.labels or ()))
        parameters = tuple(
            p._replace(label=labels[n] if n < len(labels) else "")
            for n, p in enumerate(function.parameters)
        )
        getter = not parameters and function.return_type != "void"
        return function._replace(name=message.name, parameters=parameters, getter=getter)


def property_name(name: str) -> str:
    """Returns the name of the property whose variable has a name, which begins with an underscore;
    other names are returned as is.
    """
    return name[1:] if name.startswith("_") and name[1:2].islower() else name
