"""What a change to a description costs: two frames side by side, pass by pass."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from .amounts import Amount, FrameCost, PassCost
from .model import difference

NOTHING = Amount(0.0, 0.0, 0.0, 0.0)

SAME, CHANGED, ADDED, REMOVED = "same", "changed", "added", "removed"


class Change(NamedTuple):
    """A pass, or all of a frame, before and after; None on the side where there is none.

    `status` is `same`, `changed`, `added` or `removed`; `difference` is what the new one costs
    more, negative where it costs less; `corrected` the same as the device compresses, None where
    that is not known of one of the two, or is a range.
    """

    name: str
    kind: str
    status: str
    old: Amount | None
    new: Amount | None
    difference: Amount
    corrected: Amount | None

    @property
    def per_cent(self) -> float | None:
        """How much more traffic it is, in per cent of the old; None where that is nothing."""
        before = self.old.traffic_mb_per_s if self.old is not None else 0.0
        return 100 * self.difference.traffic_mb_per_s / before if before else None


class Comparison(NamedTuple):
    """Two frames: their passes in the order of the new one, those that are gone after the one that
    they stood behind; and the total.

    `remarks` say what makes the two hard to compare, such as different rates.
    """

    passes: tuple[Change, ...]
    total: Change
    remarks: tuple[str, ...]


def compare(old: FrameCost | None, new: FrameCost | None) -> Comparison:
    """What the new frame costs more than the old one; None is a frame that is not there.

    Passes are matched by their names, commands by what they are and the images they move; of
    several with one name the first with the first.
    """
    before, after = _named(old.passes if old else ()), _named(new.passes if new else ())
    changes = [
        _change(before.get(key), after.get(key)) for key in _merged(list(before), list(after))
    ]
    total = _between("total", "total", _amounts(old), _amounts(new))
    return Comparison(tuple(changes), total, tuple(_remarks(old, new)))


Key = tuple[str, str, int]


def title(each: PassCost) -> str:
    """What tables call a pass: its name; a command with the images it moves (`resolveImage
    color_ms, color`).
    """
    if each.kind != "command":
        return each.name
    return " ".join(
        [each.name, ", ".join(dict.fromkeys(line.attachment for line in each.lines))]
    ).rstrip()


def _named(passes: Iterable[PassCost]) -> dict[Key, PassCost]:
    found: dict[Key, PassCost] = {}
    counts: dict[tuple[str, str], int] = {}
    for each in passes:
        name = (each.kind, title(each))
        counts[name] = counts.get(name, 0) + 1
        found[*name, counts[name]] = each
    return found


def _merged(before: Sequence[Key], after: Sequence[Key]) -> list[Key]:
    """The new keys in their order; after each, those that stood behind it and are gone."""
    present = set(after)
    gone: dict[Key | None, list[Key]] = {}
    last: Key | None = None
    for key in before:
        if key in present:
            last = key
        else:
            gone.setdefault(last, []).append(key)
    merged = gone.get(None, [])
    for key in after:
        merged += [key, *gone.get(key, ())]
    return merged


def _change(old: PassCost | None, new: PassCost | None) -> Change:
    either = new or old
    assert either is not None
    return _between(title(either), either.kind, _amounts(old), _amounts(new))


Amounts = tuple[Amount | None, Amount | None]
"""What a pass or a frame costs by plain arithmetic, None where there is none; and as the device
compresses, None where that is unknown.
"""


def _amounts(cost: PassCost | FrameCost | None) -> Amounts:
    if cost is None:
        return None, NOTHING
    corrected = cost.corrected if cost.corrected_most in (None, cost.corrected) else None
    return cost.amount if isinstance(cost, PassCost) else cost.total, corrected


def _between(name: str, kind: str, before: Amounts, after: Amounts) -> Change:
    (old, old_corrected), (new, new_corrected) = before, after
    if old is None or new is None:
        status = ADDED if old is None else REMOVED
    else:
        status = SAME if old == new else CHANGED
    corrected = (
        difference(new_corrected, old_corrected)
        if new_corrected is not None and old_corrected is not None
        else None
    )
    return Change(
        name, kind, status, old, new, difference(new or NOTHING, old or NOTHING), corrected
    )


def _remarks(old: FrameCost | None, new: FrameCost | None) -> Iterable[str]:
    if old is None or new is None:
        return
    if old.fps != new.fps:
        yield f"the old frame is shown {old.fps:g} times a second, the new one {new.fps:g}"
    if old.device != new.device:
        yield (
            f"the old frame is for {old.device or 'no device'}, the new one for "
            f"{new.device or 'no device'}"
        )
    if old.milliwatts_per_gbps != new.milliwatts_per_gbps:
        yield (
            f"a GB/s takes {old.milliwatts_per_gbps:g} mW in the old frame, "
            f"{new.milliwatts_per_gbps:g} mW in the new one"
        )
