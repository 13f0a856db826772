"""The scales of a figure's axes: where values are, as Vega-Lite computes it, and which of them have
a tick.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from .figure import FONT_SIZE

LINEAR, LOG, SYMLOG = "linear", "log", "symlog"

_MARGIN = 0.07
"""The part of an axis beyond the first and the last value."""

_LEAST = 1e-300
"""Of the values that a logarithm is drawn of: next to the least ones there is no margin."""

_LETTER = 0.6
"""The greatest width of a digit, a point, or a sign, in font sizes."""


class Scale(NamedTuple):
    """A scale whose ends are `low` and `high`. `constant` is the value about which a `symlog` scale
    turns from linear to logarithmic.
    """

    kind: str
    low: float
    high: float
    constant: float = 1.0

    def share(self, value: float) -> float:
        """Where a value is: 0 at the low end, 1 at the high end."""
        low, high = self._transform(self.low), self._transform(self.high)
        return (self._transform(value) - low) / (high - low)

    def value(self, share: float) -> float:
        """The value at a place; the inverse of `share`."""
        low, high = self._transform(self.low), self._transform(self.high)
        place = low + share * (high - low)
        if self.kind == LOG:
            return math.exp(place)
        return (
            math.copysign(math.expm1(abs(place)), place) * self.constant
            if self.kind == SYMLOG
            else place
        )

    def _transform(self, value: float) -> float:
        if self.kind == LOG:
            return math.log(value)
        return (
            math.copysign(math.log1p(abs(value / self.constant)), value)
            if self.kind == SYMLOG
            else value
        )

    def widened(self) -> "Scale":
        """The scale with a margin at both ends."""
        return self._replace(low=self.value(-_MARGIN), high=self.value(1 + _MARGIN))

    def spec(self) -> dict[str, Any]:
        """The scale in Vega-Lite's terms."""
        scale: dict[str, Any] = {"type": self.kind, "domain": [self.low, self.high], "nice": False}
        if self.kind == SYMLOG:
            scale["constant"] = self.constant
        return scale if self.kind == LOG else {**scale, "zero": False}

    def axis(self, length: float, *, upright: bool) -> dict[str, Any]:
        """The ticks, for an axis of a length in pixels, in Vega-Lite's terms. Labels of `upright`
        axes are above each other.
        """
        if self.kind == LINEAR:
            return {"tickCount": max(2, int(length // (30 if upright else 50)))}
        ticks: dict[float, tuple[float, float]] = {}
        for tick in self._round_values():
            at = self.share(tick) * length
            extent = (2.5 if upright else (len(f"{tick:g}") + 2) * _LETTER) * FONT_SIZE
            if all(
                abs(at - other) >= (extent + other_extent) / 2
                for other, other_extent in ticks.values()
            ):
                ticks[tick] = at, extent
        return {"labelOverlap": False, "values": sorted(ticks)}

    def _round_values(self) -> Iterator[float]:
        """Zero, powers of ten, and their multiples, as far as the scale has them; those that matter
        most first.
        """
        if self.low <= 0 <= self.high:
            yield 0.0
        least = self.low if self.kind == LOG else self.constant / 10
        most = max(abs(self.low), abs(self.high))
        exponents = range(math.floor(math.log10(least)), math.floor(math.log10(most)) + 1)
        for factor in (1, 5, 2, 3, 7):
            for exponent in reversed(exponents):
                for value in (float(f"{factor}e{exponent}"), -float(f"{factor}e{exponent}")):
                    if self.low <= value <= self.high and value:
                        yield value


def linear_or_log(values: Sequence[float], narrow: float = 1.0) -> Scale:
    """A logarithmic scale for values above zero of which the greatest is more than `narrow` times
    the least, else a linear one.
    """
    low, high = min(values, default=0.0), max(values, default=1.0)
    if low > _LEAST and high > narrow * low:
        return Scale(LOG, low, high).widened()
    return _apart(Scale(LINEAR, low, high)).widened()


def from_zero(values: Sequence[float]) -> Scale:
    """A scale for zero and values of very different sizes, which may be negative."""
    low, high = min([0.0, *values]), max([0.0, *values])
    sizes = [abs(value) for value in values if abs(value) > _LEAST]
    most = max(sizes, default=1.0)
    return _apart(Scale(SYMLOG, low, high, max(min(sizes, default=1.0), most / 500))).widened()


def _apart(scale: Scale) -> Scale:
    """The scale, with its ends apart if they are equal or next to each other."""
    size = max(abs(scale.low), abs(scale.high))
    size = size if size > _LEAST else 1.0
    return (
        scale
        if scale.high - scale.low > 1e-9 * size
        else scale._replace(low=scale.low - size / 2, high=scale.high + size / 2)
    )
