"""Progress bars on standard error: of many inputs, and of a capture that takes a while to read."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from msaa_lint.linter.run import Progress

PROGRESS_INPUTS = 200
"""The number of inputs from which a progress bar is worth the 40 ms that importing rich takes."""

MEGABYTE = 10**6

_bars: list[Any] = []
"""The bars that are on the terminal."""


def shows_progress(quiet: bool) -> bool:
    """Whether standard error is a terminal that a person watches."""
    return (
        not quiet
        and sys.stderr.isatty()
        and os.environ.get("TERM") != "dumb"
        and not os.environ.get("CI")
    )


def input_progress() -> Progress:
    """A callback that draws a bar if there are many inputs."""
    bar: Any = None

    def advance(done: int, total: int, name: str) -> None:
        nonlocal bar
        if total < PROGRESS_INPUTS:
            return
        if bar is None:
            from rich.progress import BarColumn, MofNCompleteColumn, TextColumn

            bar = _bar(TextColumn("linting", markup=False), BarColumn(), MofNCompleteColumn())
            bar.add_task("linting", total=total)
        bar.update(0, completed=done + 1)
        if done + 1 == total:
            bar.stop()
            _bars.remove(bar)

    return advance


class CaptureBar:
    """The bar of the capture that is being read: its name, the megabytes, and the frames."""

    def __init__(self) -> None:
        self._bar: Any = None

    def update(self, name: str, done: int, total: int | None, frames: int) -> None:
        """Draws the bar, unless there is one of the inputs."""
        if self._bar is None:
            if _bars:
                return
            from rich.progress import BarColumn, TextColumn

            self._bar = _bar(
                TextColumn("{task.description}", markup=False),
                BarColumn(),
                TextColumn("{task.fields[read]}", markup=False),
            )
            self._bar.add_task(f"reading {_shown(name)}", total=total and total / MEGABYTE, read="")
        read = (
            f"{done / MEGABYTE:.0f}"
            if total is None
            else f"{done / MEGABYTE:.0f}/{total / MEGABYTE:.0f}"
        )
        self._bar.update(
            0,
            completed=done / MEGABYTE,
            read=f"{read} MB, {frames:,} {'frame' if frames == 1 else 'frames'}",
        )

    def finish(self) -> None:
        """Removes the bar."""
        if self._bar is not None:
            self._bar.stop()
            _bars.remove(self._bar)
            self._bar = None


@contextmanager
def capture_progress(quiet: bool) -> Iterator[None]:
    """Shows how far the reading of captures is, if somebody watches."""
    if not shows_progress(quiet):
        yield
        return
    from msaa_lint.input import reading_progress

    bar = CaptureBar()
    previous, reading_progress.observer = reading_progress.observer, bar
    try:
        yield
    finally:
        reading_progress.observer = previous
        bar.finish()


def _bar(*columns: Any) -> Any:
    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    bar.start()
    _bars.append(bar)
    return bar


def _shown(name: str) -> str:
    from .report.escape import display

    return display(os.path.basename(name))
