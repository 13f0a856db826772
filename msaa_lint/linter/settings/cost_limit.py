"""Cost limits: `--fail-on-cost 50MB/s`."""

import re
from collections.abc import Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Price
from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import near_or_all

UNITS = {
    "MB/s": ("traffic", 1.0),
    "GB/s": ("traffic", 1000.0),
    "MiB": ("memory", 1.0),
    "GiB": ("memory", 1024.0),
    "mW": ("power", 1.0),
    "W": ("power", 1000.0),
}
"""The quantity and the factor of each unit. MB is 10^6 bytes, MiB is 2^20 bytes."""

_NUMBER = re.compile(r"([0-9]{1,9}(?:\.[0-9]{1,6})?) ?")


class Budget(NamedTuple):
    """The limit of what fixes may save of one input, in MB/s read and written, MiB or mW (`unit`);
    `text` is the limit as written.
    """

    measures: str
    most: float
    text: str
    unit: str


def budget(text: str, quantities: Sequence[str] = ("traffic", "memory", "power")) -> Budget:
    """Parses a budget of one of the quantities. ValueError, with what to write, unless the text is
    a number above 0 and a unit.
    """
    units = {unit: factor for unit, (quantity, factor) in UNITS.items() if quantity in quantities}
    number = _NUMBER.match(text)
    if number is None or float(number[1]) == 0:
        raise ValueError(
            f"expected a number above 0 with one of the units {', '.join(units)}, as in "
            f"50{next(iter(units))}"
        )
    unit = text[number.end() :]
    if not unit:
        same = len(quantities) == 1
        examples = [
            f"{float(number[1]) / factor:g}{unit}"
            for unit, factor in units.items()
            if same or factor == 1
        ]
        raise ValueError(f"a unit is missing; write {', '.join(examples[:-1])} or {examples[-1]}")
    if unit not in units:
        raise ValueError(f"unknown unit {quoted(unit)}; {near_or_all(unit, list(units))}")
    measures = UNITS[unit][0]
    basic = next(unit for unit, terms in UNITS.items() if terms == (measures, 1.0))
    return Budget(measures, float(number[1]) * units[unit], text, basic)


def figure(price: Price, limit: Budget) -> float:
    """The figure of a price that a budget limits, in the budget's unit."""
    figures = {
        "traffic": price.read_mb_per_s + price.write_mb_per_s,
        "memory": price.memory_mib,
        "power": price.milliwatts,
    }
    return figures[limit.measures]
