"""When garbage is collected: the command line and the workers of clusters disable the collector,
and collect between inputs.

What is known of a frame has no reference cycles and is freed without it; what is tracked of a
capture has some.
"""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

MAX_GARBAGE = 200_000
"""Container objects allocated since the last collection before another one runs."""


def collect_garbage(limit: int = MAX_GARBAGE) -> None:
    """Collects garbage between inputs, if there is more of it than the limit."""
    if gc.get_count()[0] > limit:
        # Not the oldest generation: the results so far are no garbage, and are not gone through
        # again after each input.
        gc.collect(1)


@contextmanager
def not_collecting() -> Iterator[None]:
    """Disables the collector, which otherwise goes through all that is read again and again."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()
