"""Cost limits: `--fail-on-cost 50MB/s`."""

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
"""The quantity and the factor of each unit. MB is 10^6 bytes, MiB is 2^20 bytes."""

_BUDGET = re.compile(r"([0-9]{1,9}(?:\.[0-9]{1,6})?) ?([A-Za-z/]{1,5})\Z")


class Budget(NamedTuple):
    """The highest combined cost of the findings of one input, in MB/s read and written, MiB or mW; `text` is the limit as written."""

    measures: str
    most: float
    text: str


def budget(text: str) -> Budget:
    """Parses a budget. Raises ValueError unless the text is a number above 0 and one of the units."""
    found = _BUDGET.match(text)
    if found is None or found[2] not in UNITS or float(found[1]) == 0:
        raise ValueError(f"expected a number above 0 with one of the units {', '.join(UNITS)}, such as 50MB/s")
    measures, factor = UNITS[found[2]]
    return Budget(measures, float(found[1]) * factor, text)


def reached(price: Price, limit: Budget) -> bool:
    """Whether a price reaches the budget."""
    figures = {
        "traffic": price.read_mb_per_s + price.write_mb_per_s,
        "memory": price.memory_mib,
        "power": price.milliwatts,
    }
    return figures[limit.measures] >= limit.most
