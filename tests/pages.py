"""The examples of the rule pages: fenced blocks, and the places that carets under a line mark."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from tests.paths import ROOT

RULES = ROOT / "rules"

_FENCE = re.compile(
    r"^```(?P<language>\w+) (?P<kind>bad|fixed|good)\b[^\n]*\n(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
_MARK = re.compile(r"^(?:#|//)\s*(?P<carets>\^+)\s*(?P<words>.*)$")

DESCRIPTIONS = ("yaml", "json")
PROGRAMS = ("c", "cpp", "swift", "glsl")


@dataclass(frozen=True)
class Mark:
    """A place (1-based line, half-open columns) where the page's rule must fire, and what it weighs
    there, if the page says.
    """

    line: int
    column: int
    end_column: int
    severity: str | None
    confidence: str | None


@dataclass(frozen=True)
class Example:
    """A fenced block of a page."""

    rule: str
    number: int
    kind: str
    language: str
    text: str
    marks: tuple[Mark, ...]

    def __str__(self) -> str:
        return f"{self.rule}-{self.kind}-{self.number}"


def examples(page: Path, languages: tuple[str, ...] = DESCRIPTIONS) -> list[Example]:
    """The examples of a page that are in some languages, in order."""
    found = []
    for match in _FENCE.finditer(page.read_text(encoding="utf-8")):
        assert match["language"] in DESCRIPTIONS + PROGRAMS, (
            f"{page.name}: what language is {match['language']}?"
        )
        if match["language"] in languages:
            text = match["text"]
            found.append(
                Example(
                    page.stem,
                    len(found),
                    match["kind"],
                    match["language"],
                    text,
                    tuple(marks(text)),
                )
            )
    return found


def marks(text: str) -> list[Mark]:
    """The marks of a text: `#      ^^^^^ warning, medium`, in source code `//     ^^^^^`, points at
    the columns of the last line above that is no mark.
    """
    found = []
    above = 0
    for number, line in enumerate(text.splitlines(), 1):
        match = _MARK.match(line)
        if match is None:
            above = number
            continue
        words = re.findall(r"[a-z]+", match["words"])
        severity = next((word for word in words if word in ("error", "warning", "note")), None)
        confidence = next((word for word in words if word in ("high", "medium", "low")), None)
        found.append(
            Mark(above, match.start("carets") + 1, match.end("carets") + 1, severity, confidence)
        )
    return found


def all_examples(languages: tuple[str, ...] = DESCRIPTIONS) -> list[Example]:
    """Every example of the catalogue that is in some languages: descriptions, unless PROGRAMS are
    asked for.
    """
    return [
        example
        for page in sorted(RULES.glob("*.md"))
        if page.name != "README.md"
        for example in examples(page, languages)
    ]
