"""When garbage is collected: the command line disables the collector.

What is known of a frame has no reference cycles and is freed without it; what is tracked of a capture has some.
"""

import gc

MAX_GARBAGE = 200_000
"""Container objects allocated since the last collection before another one runs."""


def collect_garbage(limit: int = MAX_GARBAGE) -> None:
    """Collects garbage between inputs, if there is more of it than the limit."""
    if gc.get_count()[0] > limit:
        # Not the oldest generation: the results so far are no garbage, and are not gone through again after each input.
        gc.collect(1)
