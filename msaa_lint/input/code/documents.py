"""Builds documents from trees read from source code; members that cannot be bound and names that
cannot be resolved are removed, not reported.
"""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.source import Source
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Description
from msaa_lint.input.readers import description
from msaa_lint.input.readers.partial import without

MAX_ROUNDS = 4
"""The maximum number of times that invalid members are removed and the tree is bound again."""


def bound(source: Source, tree: Node, pieces: bool = False) -> Document:
    """Returns the document of a tree. `pieces` is set for fragments of a page."""
    for _ in range(MAX_ROUNDS):
        document = _read(source, tree)
        if not document.problems:
            break
        tree, _ = without(tree, "", {problem.path for problem in document.problems})
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
