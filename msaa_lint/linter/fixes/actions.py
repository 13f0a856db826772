"""The fixes that rule pages name by `do`, in Vulkan descriptions."""

from __future__ import annotations

from collections.abc import Callable

from msaa_lint.frame.facts.facts import Subject

from .changes import Change
from .clears import clear_on_load, draw_the_copy
from .context import FixContext
from .handovers import keep_on_tile
from .images import allow_multisampling, share_image
from .merges import merge_passes, merge_price_note
from .resolve_depth import resolve_depth
from .resolve_in_pass import resolve_before_read, resolve_in_pass
from .resolves import drop_resolve, resolve_by_sample_zero, resolve_to_copy, wait_for_resolve
from .transient import make_transient

Action = Callable[[Subject, FixContext], list[Change]]
"""The changes that a fix makes for a subject. Raises NoFix if there are none."""

ACTIONS: dict[str, Action] = {
    "make-transient": make_transient,
    "resolve-in-pass": resolve_in_pass,
    "resolve-before-read": resolve_before_read,
    "resolve-by-sample-zero": resolve_by_sample_zero,
    "allow-multisampling": allow_multisampling,
    "clear-on-load": clear_on_load,
    "draw-the-copy": draw_the_copy,
    "drop-resolve": drop_resolve,
    "resolve-to-copy": resolve_to_copy,
    "wait-for-resolve": wait_for_resolve,
    "share-image": share_image,
    "hand-over-depth": resolve_depth,
    "keep-on-tile": keep_on_tile,
    "merge-passes": merge_passes,
}

PRICE_ONLY = frozenset({"keep-on-tile", "merge-passes"})
"""Fixes whose changes are for the price alone. What such a fix is, one pass in place of two, no
edit of a description can write.
"""

PRICE_NOTES: dict[str, Callable[[Subject, FixContext], str | None]] = {
    "merge-passes": merge_price_note
}
"""What the price of such a fix leaves out, for a subject; None if nothing."""
