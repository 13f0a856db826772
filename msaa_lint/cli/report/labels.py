"""Places for the labels of marks in a panel: beside their marks, with nothing beneath them. All
lengths are in pixels.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from .figure import FONT_SIZE

LETTER = 0.65
"""No technique's name takes more of the font's size per letter, in bold, in any of the usual fonts
without serifs.
"""

HEIGHT = FONT_SIZE + 2.0
"""Of a label's box."""

_EDGE = 2.0
"""Between a label and the border of its panel."""

_NEAR, _FAR = 8.0, 16.0
"""How far a label is from the center of its mark at least; and where it needs a line that leads to
it.
"""

_ANGLES = 24
_STEP = 4.0
_RINGS = (_NEAR, _NEAR, 40.0, 80.0)
"""How far from their mark labels begin where many marks are at one place, from attempt to
attempt.
"""

_MANY = 4


Place = tuple[float, float]
Line = tuple[Place, Place]


class Box(NamedTuple):
    """A rectangle from its left top to its right bottom corner."""

    left: float
    top: float
    right: float
    bottom: float

    def meets(self, other: "Box") -> bool:
        """Whether two rectangles have an area in common."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )

    def crossed_by(self, line: Line) -> bool:
        """Whether a line has a point inside (Liang and Barsky 1984)."""
        (x, y), (end_x, end_y) = line
        start, end = 0.0, 1.0
        for at, step, low, high in (
            (x, end_x - x, self.left, self.right),
            (y, end_y - y, self.top, self.bottom),
        ):
            if step == 0:
                if not low < at < high:
                    return False
                continue
            one, other = sorted(((low - at) / step, (high - at) / step))
            start, end = max(start, one), min(end, other)
        return start < end


class Label(NamedTuple):
    """The box of a label, and the line that leads to it from its mark; None for a label beside its
    mark.
    """

    box: Box
    leader: Line | None


def width_of(name: str) -> float:
    """An upper bound of a technique's name's width."""
    return len(name) * LETTER * FONT_SIZE


def around(place: Place, radius: float) -> Box:
    """The square around a place."""
    return Box(place[0] - radius, place[1] - radius, place[0] + radius, place[1] + radius)


def place_labels(
    places: Sequence[Place],
    names: Sequence[str],
    marks: Sequence[Box],
    lines: Sequence[Box],
    size: tuple[float, float],
    *,
    reach: float,
) -> list[Label | None]:
    """The labels of marks at `places`; None for one without room.

    No label meets another, a box of `marks` or `lines`, a leader, or the border of the panel of
    this size. No leader is longer than `reach`, crosses another one, or crosses a mark that is not
    its own. Earlier labels are the first to choose.
    """
    order = list(range(len(places)))
    best: dict[int, Label] = {}
    fixed = [*marks, *lines]
    crowds = [sum(mark.meets(around(place, 0.5)) for mark in marks) for place in places]
    for ring in _RINGS:
        found: dict[int, Label] = {}
        for n in order:
            others = [mark for mark in marks if not mark.meets(around(places[n], _NEAR / 2))]
            for label in _candidates(
                places[n], width_of(names[n]), size, ring if crowds[n] > _MANY else _NEAR, reach
            ):
                if not any(label.box.meets(box) for box in fixed) and _clear(
                    label, others, found.values()
                ):
                    found[n] = label
                    break
        best = max(best, found, key=len)
        missing = [n for n in order if n not in found]
        if not missing:
            break
        order = missing + [n for n in order if n in found]
    return [best.get(n) for n in range(len(places))]


def _clear(label: Label, marks: Sequence[Box], others: Iterable[Label]) -> bool:
    """Whether a label and its leader keep clear of others and theirs, and its leader of other
    marks.
    """
    leader = label.leader
    if leader is not None and any(mark.crossed_by(leader) for mark in marks):
        return False
    for other in others:
        if label.box.meets(other.box) or (
            other.leader is not None and label.box.crossed_by(other.leader)
        ):
            return False
        if leader is not None and (
            other.box.crossed_by(leader)
            or (other.leader is not None and _cross(leader, other.leader))
        ):
            return False
    return True


def _cross(one: Line, other: Line) -> bool:
    """Whether two lines cross; not if they start at the same place."""

    def side(line: Line, place: Place) -> float:
        (x, y), (end_x, end_y) = line
        return (end_x - x) * (place[1] - y) - (end_y - y) * (place[0] - x)

    return (
        side(one, other[0]) * side(one, other[1]) < 0
        and side(other, one[0]) * side(other, one[1]) < 0
    )


def _candidates(
    place: Place, width: float, size: tuple[float, float], radius: float, reach: float
) -> Iterator[Label]:
    """The places for a label within a panel, from a radius outward, to the right first."""
    x, y = place
    while radius <= min(reach, math.hypot(*size)):
        for turn in range(_ANGLES):
            # 0, 1, -1, 2, -2, ...: from the right to both sides.
            angle = (turn + 1) // 2 * (1 if turn % 2 else -1) * 2 * math.pi / _ANGLES
            toward_x, toward_y = math.cos(angle), -math.sin(angle)
            center_x = x + toward_x * (radius - _NEAR / 2 + width / 2)
            center_y = y + toward_y * (radius - _NEAR / 2 + HEIGHT / 2)
            box = Box(
                center_x - width / 2,
                center_y - HEIGHT / 2,
                center_x + width / 2,
                center_y + HEIGHT / 2,
            )
            if (
                box.left >= _EDGE
                and box.top >= _EDGE
                and box.right <= size[0] - _EDGE
                and box.bottom <= size[1] - _EDGE
            ):
                yield Label(box, _leader(place, box) if radius > _FAR else None)
        radius += _STEP


def _leader(place: Place, box: Box) -> Line:
    """The line from a mark's rim to the nearest place on a box."""
    x, y = place
    end = min(max(x, box.left), box.right), min(max(y, box.top), box.bottom)
    share = _NEAR / 2 / math.dist(place, end)
    return (x + share * (end[0] - x), y + share * (end[1] - y)), end
