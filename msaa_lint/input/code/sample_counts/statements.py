"""Statements and expressions of C and C++ as syntax trees have them: blocks, chains of `if`, parentheses and casts."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.input.code.parsing import SyntaxNode

MAX_DEPTH = 60
"""Levels of an expression that are read."""

MAX_LINKS = 64
"""Conditions of one chain of `if` and `else if` that are read."""

_SPLICED = ("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "ERROR")


def unwrapped(node: SyntaxNode | None) -> SyntaxNode | None:
    """An expression without the parentheses and C casts around it."""
    for _ in range(MAX_DEPTH):
        if node is None:
            return None
        if node.type in ("parenthesized_expression", "condition_clause", "cast_expression") and node.named_child_count:
            node = node.child_by_field_name("value") or node.named_children[-1]
            continue
        # `(Type)(value)` reads as a call where the grammar knows no types.
        function, list_node = node.child_by_field_name("function"), node.child_by_field_name("arguments")
        if function is None or list_node is None or function.type != "parenthesized_expression" or list_node.named_child_count != 1:
            return node
        node = list_node.named_children[0]
    return node


def statements(node: SyntaxNode) -> Iterator[SyntaxNode]:
    """The statements of a block, or the one that stands for it; those of the preprocessor's blocks among them."""
    stack = [node]
    while stack:
        inner = stack.pop()
        block = inner.type in ("compound_statement", "else_clause", "translation_unit") and (inner is node or node.type == "else_clause")
        if block or inner.type in _SPLICED:
            stack += reversed(inner.named_children)
        else:
            yield inner


def links(node: SyntaxNode) -> Iterator[tuple[SyntaxNode | None, SyntaxNode]]:
    """The conditions of an `if` and its `else if`s, each with what stands behind it; None for a last `else`."""
    current: SyntaxNode | None = node
    for _ in range(MAX_LINKS):
        if current is None:
            return
        condition, then = current.child_by_field_name("condition"), current.child_by_field_name("consequence")
        if then is not None:
            yield condition, then
        other = current.child_by_field_name("alternative")
        current = None
        if other is not None:
            next_node = other.named_children[-1] if other.type == "else_clause" and other.named_child_count else other
            if next_node.type == "if_statement":
                current = next_node
            else:
                yield None, next_node
