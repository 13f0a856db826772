"""What findings may cost before a build fails: `--fail-on-cost 50MB/s`."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import re
from typing import NamedTuple

from msaa_lint.core.finding import Price

UNITS = {
    "MB/s": ("traffic", 1.0),
    "GB/s": ("traffic", 1000.0),
    "MiB": ("memory", 1.0),
    "GiB": ("memory", 1024.0),
    "mW": ("power", 1.0),
    "W": ("power", 1000.0),
}
"""Each unit with what it measures, and its factor: MB is 10^6 bytes, MiB 2^20 bytes."""

_BUDGET = re.compile(r"([0-9]{1,9}(?:\.[0-9]{1,6})?) ?([A-Za-z/]{1,5})\Z")


class Budget(NamedTuple):
    """The most that the findings of one input may cost together, in MB/s read and written, MiB or mW; `text` is how it was written."""

    measures: str
    most: float
    text: str


def budget(text: str) -> Budget:
    """The budget that a text states. ValueError for anything but a number above 0 and one of the units."""
    found = _BUDGET.match(text)
    if found is None or found[2] not in UNITS or float(found[1]) == 0:
        raise ValueError(f"a number above 0 with one of the units {', '.join(UNITS)} is due, as in 50MB/s")
    measures, factor = UNITS[found[2]]
    return Budget(measures, float(found[1]) * factor, text)


def reached(price: Price, limit: Budget) -> bool:
    """Whether a price is at least what the budget allows."""
    figures = {
        "traffic": price.read_mb_per_s + price.write_mb_per_s,
        "memory": price.memory_mib,
        "power": price.milliwatts,
    }
    return figures[limit.measures] >= limit.most
