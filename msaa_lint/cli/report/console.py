"""The rich console of reports that print tables."""

from __future__ import annotations

from rich.console import Console
from rich.text import Text

from . import Options, Write
from .escape import display, escape_commands


def open_console(out: Write, options: Options) -> Console:
    """A console that prints to `out`, as wide and as colored as the options say, and interprets no
    markup.

    No line begins with `::`, which CI runners obey, wherever a table breaks a name.
    """

    class Sink:
        def write(self, text: str) -> int:
            out(escape_commands(text))
            return len(text)

        def flush(self) -> None:
            pass

    return Console(
        file=Sink(),  # type: ignore[arg-type]
        width=options.width or 140,
        color_system="standard" if options.color else None,
        force_terminal=options.color,
        highlight=False,
        markup=False,
        emoji=False,
        legacy_windows=False,
    )


def cell(text: str, style: str = "") -> Text:
    """Text from an input, escaped."""
    return Text(display(text), style=style)
