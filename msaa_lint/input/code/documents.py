"""What was read of source code as a document: what cannot be bound, and names of nothing, are left out and no mistake of anybody's."""

from __future__ import annotations

from msaa_lint.core.quote import shortened
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.source import Source
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Description
from msaa_lint.frame.description.problems import Problem
from msaa_lint.input.readers import description

MAX_ROUNDS = 4
"""How often what is wrong is left out, and the rest read again."""


def bound(source: Source, tree: Node, pieces: bool = False) -> Document:
    """The document of a tree in the form of a description; `pieces` says that a page shows pieces of a program."""
    for _ in range(MAX_ROUNDS):
        document = _read(source, tree)
        if not document.problems:
            break
        tree = _without(tree, document.problems)
    else:
        document = _read(source, mapping([], tree.span))
    # Swift that makes one encoder after another says in which order.
    ordered = document.metal is not None and document.description.commands is not None
    return document._replace(problems=(), whole=False, tree=tree, ordered=ordered, pieces=pieces)


def _read(source: Source, tree: Node) -> Document:
    if tree.kind == "mapping" and ("metal" in tree.value or "renderTargets" in tree.value):
        return description.read(source, tree)
    binder = Binder(dumped=True)
    record: Description = binder.record(Description, tree, "", "", tree.span)
    description.check_names(binder, record)
    return Document(source, record, tuple(binder.problems))


MAX_DEEP = 60
"""Nesting below which a tree is left out; what code is read as is a few levels deep."""


def _without(tree: Node, problems: tuple[Problem, ...]) -> Node:
    """A tree without the members that are wrong: of an element of a list, the list."""
    return _copy(tree, "", {problem.path for problem in problems}, 0)[0]


def _copy(node: Node, path: str, wrong: set[str], depth: int) -> tuple[Node, bool]:
    """A node without its wrong members, and whether it is itself wrong."""
    if (path and path in wrong) or depth > MAX_DEEP:
        return node, True
    if node.kind == "sequence":
        items = [_copy(item, f"{path}[{n}]", wrong, depth + 1) for n, item in enumerate(node.value)]
        copied = Node(node.kind, node.start, node.end, [item for item, _ in items], node.keys)
        return copied, any(bad for _, bad in items)
    if node.kind != "mapping":
        return node, False
    members = []
    for key, value in node.value.items():
        inner, bad = _copy(value, f"{path}.{shortened(key)}" if path else shortened(key), wrong, depth + 1)
        if not bad:
            members.append((key, node.keys[key].span, inner))
    return mapping(members, node.span), False
