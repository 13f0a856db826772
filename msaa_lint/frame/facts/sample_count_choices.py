"""How a program finds its sample count in the masks that a device states: what it asks of them, and
what that can give.
"""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Description, SampleCountChoice, SampleCountTest
from msaa_lint.frame.vulkan.formats import format_of

from .facts import Facts, Subject

MAXIMUM, ATMOST = "MAXIMUM", "ATMOST"

GREATEST = 64
"""The greatest VkSampleCountFlagBits."""

DEPTH = ("framebufferDepthSampleCounts", "sampledImageDepthSampleCounts")
STENCIL = ("framebufferStencilSampleCounts", "sampledImageStencilSampleCounts")


def choices(description: Description, around: Facts) -> Iterator[Subject]:
    """The choices of a description, with their facts."""
    for name, record in description.sampleCountChoices.items():
        if record is None:
            continue
        facts = Facts(around)
        facts.put("choice.name", name, record.head)
        facts.put("choice.combined", record.combined, record.place("combined"))
        facts.put("choice.chosen", record.chosen, record.place("chosen", "atMost"))
        facts.put("choice.at_most", _at_most(record), record.place("atMost", "chosen"))
        _retested(facts, record)
        _asked(facts, record)
        yield Subject("choice", record.path, record.head, facts)


def _at_most(record: SampleCountChoice) -> int | None:
    """The greatest count that it may give."""
    if record.atMost is not None:
        return record.atMost
    given = [test.gives for test in record.tests if test is not None]
    if given and record.chosen is not None:
        return None if None in given else max(count for count in given if count is not None)
    return GREATEST if record.chosen == MAXIMUM else None


def _retested(facts: Facts, record: SampleCountChoice) -> None:
    """The tests of a bit that one before has tested: where they are asked, the bit is not set."""
    before: dict[int, SampleCountTest] = {}
    dead: list[SampleCountTest] = []
    for test in record.tests:
        if test is None or test.tests is None:
            continue
        first = before.setdefault(test.tests, test)
        if (
            first is not test
            and None not in (test.gives, first.gives)
            and test.gives != first.gives
        ):
            dead.append(test)
    if dead:
        first = before[dead[0].tests or 0]
        facts.put("choice.retested", dead[0].tests, dead[0].place("tests"))
        facts.put("choice.first_gives", first.gives, first.place("tests"))
    never = [test.gives for test in dead if test.gives is not None and test.tests == dead[0].tests]
    facts.put(
        "choice.never_given", never, dead[0].place("tests") if dead else record.place("tests")
    )


def _asked(facts: Facts, record: SampleCountChoice) -> None:
    """Which limits are asked, and for which formats that is too little."""
    if record.limits is not None:
        limits: list[str] = [limit for limit in record.limits if limit is not None]
        facts.put("choice.limits", limits, record.place("limits"))
        facts.put(
            "choice.depth_counts_asked",
            any(limit in DEPTH for limit in record.limits),
            _item(record, "limits", DEPTH),
        )
        facts.put(
            "choice.stencil_counts_asked",
            any(limit in STENCIL for limit in record.limits),
            _item(record, "limits", STENCIL),
        )
    if record.formats is not None:
        stencil = [name for name in record.formats if name is not None and _has_stencil(name)]
        facts.put("choice.stencil_formats", stencil, _item(record, "formats", stencil))


def _has_stencil(name: str) -> bool:
    found = format_of(name)
    return found is not None and "stencil" in found.aspects


def _item(record: SampleCountChoice, member: str, among: tuple[str, ...] | list[str]) -> Span:
    """Where the first of some items of a list stands; the list's place where there is none."""
    values = getattr(record, member)
    nodes = record.spelled[member][1].value
    return next(
        (node.span for node, value in zip(nodes, values, strict=True) if value in among),
        record.place(member),
    )
