"""MB/s beside the attachments and passes of a description."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.cost.amounts import FrameCost, Line

from .traffic import Moved, moved, passes

if TYPE_CHECKING:
    from .view import View


class Hint(NamedTuple):
    """A text after an offset, and what it says in full."""

    at: int
    text: str
    tooltip: str


def hints(view: View, span: Span) -> list[Hint]:
    """The hints in a part of the text, in order."""
    found: dict[int, Hint] = {}
    for hint in _hints(view):
        # An anchored pass or attachment that several share has the hint of the first.
        found.setdefault(hint.at, hint)
    return [found[at] for at in sorted(found) if span.start <= at <= span.end]


def _hints(view: View) -> Iterator[Hint]:
    for costs in view.costs:
        if costs.is_expanded:
            continue
        cost = costs.written
        for each in passes(costs):
            amount = each.cost.amount
            total = Moved(amount.read_mb_per_s, amount.write_mb_per_s, amount.milliwatts)
            times = f", begun {each.cost.times} times a frame" if each.cost.times > 1 else ""
            unknown = "; not counted: " + ", ".join(each.cost.unknown) if each.cost.unknown else ""
            more = "+" if each.cost.unknown else ""
            text = f"{figure(total.total)}{more} MB/s, {figure(total.milliwatts)} mW"
            yield Hint(
                _after_key(view.text, each.head),
                text,
                f"the whole pass{times}: {_words(total)}{unknown}",
            )
            for head, node, lines in each.attachments:
                if lines:
                    yield _attachment_hint(view.text, head, node, lines, cost)


def _attachment_hint(
    text: str, head: Span, node: Node, lines: tuple[Line, ...], cost: FrameCost
) -> Hint:
    whole = moved(lines, cost)
    resolved = moved((line for line in lines if line.action == "resolve"), cost)
    share = (
        f", {figure(resolved.total)} of it the resolve"
        if 0 < resolved.total < whole.total
        else " (resolve)"
        if resolved.total
        else ""
    )
    parts = [
        f"{line.action} {line.aspect} {figure(moved([line], cost).total)} MB/s" for line in lines
    ]
    at = node.end if "\n" not in text[head.start : node.end] else _after_key(text, head)
    return Hint(at, f"{figure(whole.total)} MB/s{share}", f"{_words(whole)}: {', '.join(parts)}")


def _after_key(text: str, head: Span) -> int:
    """After the `:` of a key; after a head that is none."""
    rest = text[head.end : head.end + 8]
    blanks = len(rest) - len(rest.lstrip(" "))
    return head.end + blanks + 1 if rest.lstrip(" ").startswith(":") else head.end


def _words(amount: Moved) -> str:
    return (
        f"{figure(amount.read)} MB/s read, {figure(amount.write)} MB/s written, "
        f"{figure(amount.milliwatts)} mW"
    )


def figure(value: float) -> str:
    """A number as people compare them: no decimals from 100, one from 10, else two."""
    return (
        f"{value:,.0f}"
        if abs(value) >= 100
        else f"{value:.1f}"
        if abs(value) >= 10
        else f"{value:.2f}"
    )
