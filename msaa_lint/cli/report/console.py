"""rich's console for the reports that print tables: it writes where a report is told to, and takes nothing of texts for markup."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import Options, Write

if TYPE_CHECKING:
    from rich.console import Console


def opened(out: Write, options: Options) -> Console:
    """A console that prints to `out`, as wide and as coloured as the options say."""
    from rich.console import Console

    class Sink:
        def write(self, text: str) -> int:
            out(text)
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
