"""The standard sample locations of the Vulkan specification."""

from __future__ import annotations

STANDARD: dict[int, tuple[tuple[int, int], ...]] = {
    1: ((8, 8),),
    2: ((12, 12), (4, 4)),
    4: ((6, 2), (14, 6), (2, 10), (10, 14)),
    8: ((9, 5), (7, 11), (13, 9), (5, 3), (3, 13), (1, 7), (11, 15), (15, 1)),
    16: (
        (9, 9), (7, 5), (5, 10), (12, 7), (3, 6), (10, 13), (13, 11), (11, 3),
        (6, 14), (8, 1), (4, 2), (2, 12), (0, 8), (15, 4), (14, 15), (1, 0),
    ),
}  # fmt: skip
"""By the sample count: x and y of every sample in sixteenths of a pixel, from its upper left
corner, in sample order.

The standard sample locations of the Vulkan specification (Rasterization, "Multisampling"); there
are none for 32 and 64.
"""
