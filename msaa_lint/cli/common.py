"""What commands share: how they end, outputs, sizes, colour, the settings that arguments state. It imports nothing of what commands do."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import IO, Any, NamedTuple

BROKEN_PIPE = 2
"""The exit code where whoever reads the output has gone."""

MOST_PIXELS = 16384
"""A side of what is drawn, at most."""

OVERRIDES = ("edition", "profile", "fail_on", "fail_on_cost", "fail_confidence", "min_severity", "baseline")
SELECTORS = ("select", "extend_select", "ignore")


class Mistake(Exception):
    """An option that says nothing that can be used; its text is for the user."""


class Target(NamedTuple):
    """An output, and the file it goes to; None is standard output."""

    format: str
    path: str | None


def ended(
    command: Callable[[Mapping[str, Any]], int],
    given: Mapping[str, Any],
    refusals: tuple[type[Exception], ...] = (),
    terminable: bool = False,
) -> int:
    """Runs a command and gives the exit code, however it ends.

    That is the command's own; 2 for a Mistake, for one of the `refusals`, whose texts are for the user too, and where the program itself
    failed, which `--traceback` raises; BROKEN_PIPE; 130 where it is interrupted. SIGTERM ends what is `terminable` in order, so that no
    child and no file is left.
    """
    told: tuple[type[Exception], ...] = (Mistake, *refusals)
    before = _terminable() if terminable else None
    try:
        return command(given)
    except told as error:
        from .report.escape import visible

        print(f"msaa-lint: {visible(str(error))}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # Whoever reads us has gone; Python would complain once more when it closes the stream.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        if given.get("traceback"):
            raise
        from .report.escape import visible

        reason = visible(str(error)[:300])
        print(f"msaa-lint: the program failed: {type(error).__name__}: {reason} (--traceback shows where)", file=sys.stderr)
        return 2
    finally:
        if before is not None:
            import signal

            signal.signal(signal.SIGTERM, before)


def _terminable() -> Any:
    """Has SIGTERM end us in order; what it did before, None where that is not ours to change."""
    import signal

    def end(number: int, _: object) -> None:
        raise SystemExit(128 + number)

    try:
        return signal.signal(signal.SIGTERM, end)
    except ValueError:
        return None


def outputs(stated: Sequence[str], formats: Sequence[str], example: str) -> list[Target]:
    """The outputs that `FORMAT[=FILE]` name. Mistake for one that is none of `formats`, and for two on standard output; `example` is one
    with a file."""
    targets = []
    for text in stated:
        name, equals, path = text.partition("=")
        if name not in formats:
            from msaa_lint.core.suggestions import nearest

            close = nearest(name, formats)
            hint = f"did you mean {close}?" if close else f"there are {', '.join(formats)}"
            raise Mistake(f"no output {name[:40]!r}; {hint}")
        targets.append(Target(name, path if equals and path not in ("", "-") else None))
    if sum(target.path is None for target in targets) > 1:
        raise Mistake(f"two outputs go to standard output: give all but one a file, as in --output {example}")
    return targets


def written(path: str | None, render: Callable[[IO[str]], None]) -> None:
    """Has a file, or standard output, written to in UTF-8. Mistake where a file cannot be."""
    if path is None:
        utf_8(sys.stdout)
        render(sys.stdout)
        sys.stdout.flush()
        return
    try:
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            render(file)
    except OSError as error:
        raise Mistake(f"{path} cannot be written: {error.strerror}") from None


def utf_8(out: IO[str]) -> None:
    """Has a stream take every character: its own encoding may lack what an excerpt shows, and a machine format is UTF-8 whatever the
    locale."""
    reconfigure = getattr(out, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(encoding="utf-8", errors="backslashreplace")


def size(text: str, most: int) -> tuple[int, int]:
    """Width and height in pixels of `1920x1080`. Mistake where it is no such thing, and where one is above `most`."""
    sides = [int(side) for side in text.lower().split("x") if side.isascii() and side.isdigit() and len(side) <= len(str(most))]
    if len(sides) != 2 or text.lower().count("x") != 1 or not all(1 <= side <= most for side in sides):
        raise Mistake(f"--size {text[:40]!r}: WIDTHxHEIGHT in pixels is due, at most {most} each, as in 1920x1080")
    return sides[0], sides[1]


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
