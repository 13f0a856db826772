"""Builds documents from trees read from source code; members that cannot be bound and names that cannot be resolved are removed, not
reported."""

from __future__ import annotations

from msaa_lint.core.quote import shortened
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.source import Source
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Description
from msaa_lint.input.readers import description

MAX_ROUNDS = 4
"""The maximum number of times that invalid members are removed and the tree is bound again."""


def bound(source: Source, tree: Node, pieces: bool = False) -> Document:
    """Returns the document of a tree. `pieces` is set for fragments of a page."""
    for _ in range(MAX_ROUNDS):
        document = _read(source, tree)
        if not document.problems:
            break
        tree, _ = _without(tree, "", {problem.path for problem in document.problems}, 0)
    else:
        document = _read(source, mapping([], tree.span))
    # Swift code that creates one encoder after another states their order.
    ordered = document.metal is not None and document.description.commands is not None
    return document._replace(problems=(), whole=False, tree=tree, ordered=ordered, pieces=pieces)


def _read(source: Source, tree: Node) -> Document:
    if tree.kind == "mapping" and ("metal" in tree.value or "renderTargets" in tree.value):
        return description.read(source, tree)
    binder = Binder(dumped=True)
    record: Description = binder.record(Description, tree, "", "", tree.span)
    description.check_names(binder, record)
    description.forget_unread(record)
    return Document(source, record, tuple(binder.problems))


MAX_DEEP = 60
"""The maximum nesting of a tree; trees from source code have few levels."""


def _without(node: Node, path: str, wrong: set[str], depth: int) -> tuple[Node, bool]:
    """Returns a node without its invalid members, and whether the node itself is invalid. A list with an invalid element is."""
    if (path and path in wrong) or depth > MAX_DEEP:
        return node, True
    if node.kind == "sequence":
        items = [_without(item, f"{path}[{n}]", wrong, depth + 1) for n, item in enumerate(node.value)]
        copied = Node(node.kind, node.start, node.end, [item for item, _ in items], node.keys)
        return copied, any(bad for _, bad in items)
    if node.kind != "mapping":
        return node, False
    members = []
    for key, value in node.value.items():
        inner, bad = _without(value, f"{path}.{shortened(key)}" if path else shortened(key), wrong, depth + 1)
        if not bad:
            members.append((key, node.keys[key].span, inner))
    return mapping(members, node.span), False
