"""Statements and expressions in C and C++ syntax trees: blocks, `if` chains, parentheses, and casts."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.input.code.parsing import SyntaxNode, fields

MAX_DEPTH = 60
"""The maximum nesting of parentheses and casts."""

MAX_LINKS = 64
"""The maximum number of conditions in an `if` chain."""

_ENDS = ("return_statement", "throw_statement")
_LABELS = ("labeled_statement", "case_statement")
_SPLICED = ("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "ERROR")


def unwrapped(node: SyntaxNode | None) -> SyntaxNode | None:
    """Returns an expression without surrounding parentheses and C casts."""
    for _ in range(MAX_DEPTH):
        if node is None:
            return None
        if node.type in ("parenthesized_expression", "condition_clause", "cast_expression") and node.named_child_count:
            node = node.child_by_field_name("value") or node.named_children[-1]
            continue
        # Without type information, the grammar parses `(Type)(value)` as a call.
        function, list_node = fields(node, "function", "arguments")
        if function is None or list_node is None or function.type != "parenthesized_expression" or list_node.named_child_count != 1:
            return node
        node = list_node.named_children[0]
    return node


def live_children(node: SyntaxNode) -> list[SyntaxNode]:
    """Returns the children of a node without dead code: what follows a `return` or `throw`, `#if 0`, and the `#else` of `#if 1`."""
    if node.type == "compound_statement":
        children = node.named_children
        end = next((n for n, child in enumerate(children, 1) if child.type in _ENDS), len(children))
        return children if any(child.type in _LABELS for child in children[end:]) else children[:end]
    condition, alternative = fields(node, "condition", "alternative") if node.type in ("preproc_if", "preproc_elif") else (None, None)
    holds = {b"0": False, b"1": True}.get(condition.text or b"") if condition is not None else None
    if holds is None:
        return node.named_children
    if not holds:
        return [alternative] if alternative is not None else []
    return [child for child in node.named_children if child != alternative]


def statements(node: SyntaxNode) -> Iterator[SyntaxNode]:
    """Yields the statements of a block or a single statement, including those in preprocessor blocks."""
    stack = [node]
    while stack:
        inner = stack.pop()
        block = inner.type in ("compound_statement", "else_clause", "translation_unit") and (inner is node or node.type == "else_clause")
        if block or inner.type in _SPLICED:
            stack += reversed(live_children(inner))
        else:
            yield inner


def links(node: SyntaxNode) -> Iterator[tuple[SyntaxNode | None, SyntaxNode]]:
    """Yields the conditions of an `if` chain with their branches; the condition of a final `else` is None."""
    current: SyntaxNode | None = node
    for _ in range(MAX_LINKS):
        if current is None:
            return
        condition, then = fields(current, "condition", "consequence")
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
