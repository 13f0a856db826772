"""What a frame costs with another value in place of one that it states."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.frame.cost.amounts import Amount
from msaa_lint.frame.cost.model import difference
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import enumerant, sample_count
from msaa_lint.frame.vulkan.formats import format_of
from msaa_lint.linter.fixes.changes import Change, NoFix
from msaa_lint.linter.fixes.references import nested_records

from .places import Place

if TYPE_CHECKING:
    from .view import Costs

_VALUES: dict[str, tuple[str, ...]] = {
    "VkAttachmentLoadOp": ("LOAD", "CLEAR", "DONT_CARE"),
    "VkAttachmentStoreOp": ("STORE", "DONT_CARE"),
    "VkResolveModeFlagBits": ("NONE", "SAMPLE_ZERO", "AVERAGE"),
    "MTLLoadAction": ("load", "clear", "dontCare"),
    "MTLStoreAction": ("store", "dontCare", "multisampleResolve", "storeAndMultisampleResolve"),
    "MTLStorageMode": ("private", "memoryless"),
}
"""The values that are compared with the one that is stated."""

_FORMATS = (
    "R8G8B8A8_UNORM", "A2B10G10R10_UNORM_PACK32", "B10G11R11_UFLOAT_PACK32", "R16G16B16A16_SFLOAT",
    "D16_UNORM", "D24_UNORM_S8_UINT",
    "D32_SFLOAT", "D32_SFLOAT_S8_UINT",
)  # fmt: skip
_COUNTS = (1, 2, 4, 8)
_RATES = (30, 60, 120)

MAX_WORDS = 4
"""Words of a member of a shorthand that are all compared; of counts, of which there are more, one
spelling each.
"""

_SHORT_COUNTS = frozenset({"k1", "k2", "k4", "k8"})

MOVING = frozenset({"usage", "memory"})
"""The flags that decide what memory an image takes."""


class Alternatives(NamedTuple):
    """The value that is stated, and the frame's total with each of the others in its place."""

    value: str
    others: tuple[tuple[str, Amount], ...]


def alternative_costs(costs: Costs, member: Place, place: Place) -> Alternatives | None:
    """The costs of a frame with other values of a member, or without the flag at a place. None
    where none of them makes a difference.
    """
    found = list(_expanded(costs, member) if costs.is_expanded else _changed(costs, member, place))
    if all(total == costs.written.total for _, total in found):
        return None
    return Alternatives(place.node.text, tuple(found))


def _changed(costs: Costs, member: Place, place: Place) -> Iterator[tuple[str, Amount]]:
    """The totals with the changes made in the structures that were read; only the part of the frame
    that they concern is estimated.
    """
    assert member.record is not None
    name = member.path[-1]
    records = [
        record
        for record in _records(costs, member.record)
        if record.states(name) and _is_at(record, name, member)
    ]
    for title, action, value in _candidates(member, place) if records else ():
        try:
            saving = costs.prices.of([Change(record, name, action, value) for record in records])
        except NoFix:
            continue
        if saving is not None:
            yield (
                title,
                difference(costs.written.total, Amount(*saving))
                if any(saving)
                else costs.written.total,
            )


def _expanded(costs: Costs, member: Place) -> Iterator[tuple[str, Amount]]:
    """The costs of a shorthand with each other word in its text."""
    words = member.shape[1] if member.shape[0] == "word" else ()
    others = [word for word in words if isinstance(word, str) and word != member.node.text]
    if len(others) > MAX_WORDS:
        others = [word for word in others if word in _SHORT_COUNTS]
    for word in others:
        cost = costs.with_text(member.node.span, word)
        if cost is not None:
            yield word, cost.total


def _records(costs: Costs, kind: type[Record]) -> Iterator[Record]:
    description = costs.result.document.description
    return (record for record in nested_records(description) if type(record) is kind)


def _is_at(record: Record, name: str, member: Place) -> bool:
    """Whether a record's member is written at a place; an alias of it counts as well."""
    value = record.spelled[name][1]
    return member.node.start in (value.start, (value.anchor or value).start)


def _candidates(member: Place, place: Place) -> Iterator[tuple[str, str, Any]]:
    """Other values: their titles, and the changes that state them."""
    kind, text = member.shape[0], place.node.text
    if kind == "enum":
        stated = enumerant(member.shape[1], text)
        for value in _enumerants(member.shape[1], stated):
            if value != stated:
                yield value, "set", value
    elif kind == "flags" and member.path[-1] in MOVING:
        flag = enumerant(member.shape[1], text)
        if flag is not None and member.node.kind == "sequence":
            yield f"without {flag}", "remove", flag
    elif kind == "samples":
        stated_count = sample_count(place.node.value)
        for count in _COUNTS:
            if count != stated_count:
                yield str(count), "set", count
    elif member.path == ("frame", "fps"):
        for rate in _RATES:
            if rate != place.node.value:
                yield str(rate), "set", float(rate)


def _enumerants(enums: str, stated: str | None) -> Sequence[str]:
    if enums != "VkFormat":
        return _VALUES.get(enums, ())
    format = format_of(stated) if stated is not None else None
    if format is None:
        return ()
    is_color = "color" in format.aspects
    return [
        name
        for name in _FORMATS
        if (other := format_of(name)) is not None and ("color" in other.aspects) == is_color
    ]
