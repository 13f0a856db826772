"""Views of texts for the tests of what an editor asks at a position."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

from msaa_lint.cli.lsp.view import View
from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.span import Edit
from msaa_lint.linter.engine import Engine, load_rules
from msaa_lint.linter.lint_options import LintOptions

EXAMPLES = Path(__file__).parents[2] / "examples"

OPTIONS = LintOptions(severity=lambda rule, severity, case: severity, prices=True)


@cache
def engine() -> Engine:
    return Engine(load_rules())


def view(text: str, kind: str = "description", path: str = "frame.msaa.yaml") -> View:
    """The view of a text after it was linted, if it is a description."""
    result = engine().lint(text.encode(), path, OPTIONS) if kind == "description" else None
    return View(
        text, kind, result, engine().registry, result.findings if result is not None else ()
    )


def at(text: str, mark: str = "^") -> tuple[str, int]:
    """The text without its mark, and the offset of it."""
    offset = text.index(mark)
    return text[:offset] + text[offset + len(mark) :], offset


def descriptions() -> list[Path]:
    """The examples that are descriptions."""
    return sorted(EXAMPLES.rglob("*.msaa.yaml"))


def edited(text: str, edits: Iterable[Edit]) -> str:
    return apply(text, list(edits))
