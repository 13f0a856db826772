"""What commands share: outputs, colour, the settings that arguments state. It imports nothing of what commands do."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, NamedTuple

BROKEN_PIPE = 2
"""The exit code where whoever reads the output has gone."""

OVERRIDES = ("edition", "profile", "fail_on", "fail_on_cost", "min_severity", "baseline")
SELECTORS = ("select", "extend_select", "ignore")


class Target(NamedTuple):
    """An output, and the file it goes to; None is standard output."""

    format: str
    path: str | None


def settings(given: Mapping[str, Any]) -> dict[str, Any]:
    """The settings that arguments state, which go before those of a configuration."""
    stated = {name: given[name] for name in OVERRIDES if name in given}
    for name in SELECTORS:
        if name in given:
            stated[name] = [word.strip() for each in given[name] for word in each.split(",") if word.strip()]
    if "rules" in given:
        stated["rules"] = given["rules"]
    return stated


def colored(asked: str, terminal: bool) -> bool:
    """Whether to colour: as asked, else by NO_COLOR (no-color.org), FORCE_COLOR and CLICOLOR_FORCE, else on a terminal that is not dumb."""
    if asked != "auto":
        return asked == "always"
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR") or os.environ.get("CLICOLOR_FORCE", "0") not in ("", "0"):
        return True
    return terminal and os.environ.get("TERM") != "dumb"
