"""Reads how C and C++ choose a sample count from the masks of VkPhysicalDeviceLimits, as section `sampleCountChoices` of a description.

Masks are tracked through variables, functions, and members; tests of their bits through `if` chains, conditional expressions, and loops
over known counts. Choices that depend on anything else, such as a setting, are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode

from .chains import Chain
from .masks import Bindings, Mask, Order
from .reading import Choice, ChoiceReader, Owner
from .statements import live_children
from .uses import Uses

if TYPE_CHECKING:
    from msaa_lint.input.code.parsing import Code

RELEVANT = re.compile(r"[sS]ampleCount|SAMPLE_COUNT")

NOBODY = Owner("", None, "")
"""The owner of statements outside of functions."""


def choices(root: SyntaxNode, code: Code) -> list[tuple[str, Span, Node]]:
    """Returns the sample count choices in a C or C++ syntax tree: name, location, and entry."""
    if RELEVANT.search(code.text) is None:
        return []
    functions, outside = _functions_and_statements(root)
    relevant = [node for node in functions if RELEVANT.search(code.text, node.start_byte, node.end_byte)]
    before = ChoiceReader(code.text)
    for reading in (before, ChoiceReader(code.text)):
        if reading is not before:
            # The results of functions and the values of members are known by now.
            reading.expressions.members |= before.expressions.members
            reading.expressions.returns |= before.expressions.returns
        bindings: Bindings = {}
        chains: dict[str, Chain] = {}
        for node in outside:
            reading.statement(node, bindings, NOBODY, chains, 0)
        for target, chain in chains.items():
            reading.finish(target, chain, NOBODY)
        lists = {name: value for name, value in bindings.items() if isinstance(value, Order)}
        reading.expressions.members = {**lists, **reading.expressions.members}
        for node in relevant:
            reading.function(node)
    uses = Uses(root, reading.expressions) if reading.choices else None
    entries = [(item.name, item.at, _entry(item, uses)) for item in reading.choices if uses is not None]
    covered = {item.mask.at for item in reading.choices}
    # From these masks, no count is selected.
    entries += [(name, mask.at, mapping(_of_mask(mask), mask.at)) for at, (name, mask) in reading.combined.items() if at not in covered]
    return _named(entries)


def _functions_and_statements(root: SyntaxNode) -> tuple[list[SyntaxNode], list[SyntaxNode]]:
    """Returns the functions of a file, and the statements outside of them."""
    functions: list[SyntaxNode] = []
    outside: list[SyntaxNode] = []
    stack = [root]
    while stack:
        node = stack.pop()
        if node.type == "function_definition":
            functions.append(node)
        elif node.type.endswith("statement") or node.type in ("declaration", "for_range_loop"):
            outside.append(node)
            if node.type == "declaration":
                stack += [child for child in node.named_children if child.type.endswith("_specifier")]
        else:
            stack += reversed(live_children(node))
    return functions, outside


def _entry(choice: Choice, uses: Uses) -> Node:
    """Returns the entry of a choice."""
    members = list(_of_mask(choice.mask))
    cap = uses.cap(choice.name)
    most = choice.at_most if cap is None else min(cap, choice.at_most or cap) if cap else None
    if most is not None:
        chosen = "MAXIMUM" if most >= 16 else "ATMOST"
        members += [("chosen", choice.at, scalar(chosen, choice.at)), ("atMost", choice.at, scalar(most, choice.at))]
    if choice.tests:
        tests = [
            mapping([("tests", test.at, scalar(test.bit, test.at)), ("gives", test.at, scalar(test.gives, test.at))], test.at)
            for test in choice.tests
        ]
        members.append(("tests", choice.tests[0].at, sequence(tests, choice.tests[0].at)))
    formats = uses.formats(choice.name)
    if formats:
        at = next(iter(formats.values()))
        members.append(("formats", at, sequence([scalar(name, span) for name, span in formats.items()], at)))
    return mapping(members, choice.at)


def _of_mask(mask: Mask) -> Iterator[tuple[str, Span, Node]]:
    if mask.known:
        at = mask.limits[0][1] if mask.limits else mask.at
        yield "limits", at, sequence([scalar(name, span) for name, span in mask.limits], at)
        yield "combined", mask.at, scalar(mask.combined, mask.at)


def _named(entries: list[tuple[str, Span, Node]]) -> list[tuple[str, Span, Node]]:
    """Returns the entries in source order with unique names."""
    named: dict[str, tuple[str, Span, Node]] = {}
    for name, at, node in sorted(entries, key=lambda entry: entry[1]):
        unique, n = name or "samples", 2
        while unique in named:
            unique, n = f"{name or 'samples'} {n}", n + 1
        named[unique] = (unique, at, node)
    return list(named.values())
