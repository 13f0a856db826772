"""Reads how a program chooses a sample count from the masks of VkPhysicalDeviceLimits, as section
`sampleCountChoices` of a description.

Masks are tracked through variables, functions, and members; tests of their bits through `if`
chains, conditional expressions, and loops over known counts. Choices that depend on anything else,
such as a setting, are left out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import Function, Unit

from .caps import Caps
from .chains import Chain
from .masks import Bindings, Mask, Order
from .reading import Choice, ChoiceReader, Owner

RELEVANT = re.compile(r"[sS]ample_?[cC]ount|SAMPLE_COUNT")

NOBODY = Owner("", None, "")
"""The owner of statements outside of functions."""


def choices(unit: Unit, text: str) -> list[tuple[str, Span, Node]]:
    """Returns the sample count choices of a file: name, location, and entry. The formats of images
    are left out.
    """
    if RELEVANT.search(text) is None:
        return []
    relevant = _relevant(unit, text)
    before = ChoiceReader(text)
    for reading in (before, ChoiceReader(text)):
        if reading is not before:
            # The results of functions and the values of members are known by now.
            reading.expressions.members |= before.expressions.members
            reading.expressions.returns |= before.expressions.returns
        bindings: Bindings = {}
        chains: dict[str, Chain] = {}
        for term in unit.outside:
            reading.statement(term, bindings, NOBODY, chains, 0)
        for target, chain in chains.items():
            reading.finish(target, chain, NOBODY)
        lists = {name: value for name, value in bindings.items() if isinstance(value, Order)}
        reading.expressions.members = {**lists, **reading.expressions.members}
        for function in relevant:
            reading.function(function)
    caps = Caps(unit, reading.expressions) if reading.choices else None
    entries = [
        (item.name, item.at, _entry(item, caps)) for item in reading.choices if caps is not None
    ]
    covered = {item.mask.at for item in reading.choices}
    # From these masks, no count is selected.
    entries += [
        (name, mask.at, mapping(_of_mask(mask), mask.at))
        for at, (name, mask) in reading.combined.items()
        if at not in covered
    ]
    return _named(entries)


def _relevant(unit: Unit, text: str) -> list[Function]:
    """Returns the functions of a file that mention sample counts."""
    starts = sorted(function.at.start for function in unit.functions)
    ends = dict(zip(starts, [*starts[1:], len(text)], strict=False))
    return [
        item
        for item in unit.functions
        if RELEVANT.search(text, item.at.start, ends[item.at.start]) is not None
    ]


def _entry(choice: Choice, caps: Caps) -> Node:
    """Returns the entry of a choice."""
    members = list(_of_mask(choice.mask))
    cap = caps.of(choice.name)
    most = choice.at_most if cap is None else min(cap, choice.at_most or cap) if cap else None
    if most is not None:
        chosen = "MAXIMUM" if most >= 16 else "ATMOST"
        members += [
            ("chosen", choice.at, scalar(chosen, choice.at)),
            ("atMost", choice.at, scalar(most, choice.at)),
        ]
    if choice.tests:
        tests = [
            mapping(
                [
                    ("tests", test.at, scalar(test.bit, test.at)),
                    ("gives", test.at, scalar(test.gives, test.at)),
                ],
                test.at,
            )
            for test in choice.tests
        ]
        members.append(("tests", choice.tests[0].at, sequence(tests, choice.tests[0].at)))
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
