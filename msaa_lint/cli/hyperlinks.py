"""Whether a terminal shows text as a link (OSC 8). Others may print the sequence, so only those
known to support it count.
"""

import os
from typing import IO

_PROGRAMS = frozenset(
    {
        "Hyper",
        "iTerm.app",
        "terminology",
        "WezTerm",
        "vscode",
        "ghostty",
        "zed",
        "Tabby",
        "rio",
        "mintty",
    }
)
"""Values of TERM_PROGRAM."""

_TERMINALS = frozenset(
    {
        "xterm-kitty",
        "xterm-ghostty",
        "alacritty",
        "alacritty-direct",
        "foot",
        "foot-direct",
        "contour",
    }
)
"""Values of TERM."""

_VARIABLES = ("DOMTERM", "WT_SESSION", "KONSOLE_VERSION", "KITTY_WINDOW_ID")
"""Set by the terminals DomTerm, Windows Terminal, Konsole, and kitty."""

_VTE = 5000
"""The version of the library of GNOME Terminal and others from which it shows links: 0.50."""


def shows_hyperlinks(out: IO[str]) -> bool:
    """Whether a stream is a terminal that shows links: as FORCE_HYPERLINK states (0: no), else by
    the variables that terminals set.
    """
    if not out.isatty() or os.environ.get("TERM") == "dumb":
        return False
    forced = os.environ.get("FORCE_HYPERLINK")
    if forced:
        return forced != "0"
    vte = os.environ.get("VTE_VERSION", "")
    return (
        (vte.isascii() and vte.isdigit() and int(vte[:9]) >= _VTE)
        or os.environ.get("TERM_PROGRAM") in _PROGRAMS
        or os.environ.get("TERM") in _TERMINALS
        or any(os.environ.get(name) for name in _VARIABLES)
    )
