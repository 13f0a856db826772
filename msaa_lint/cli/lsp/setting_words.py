"""The keys of a configuration in words."""

from __future__ import annotations

import re

from msaa_lint.core.text.span import Span
from msaa_lint.linter.settings.reference import documentation
from msaa_lint.linter.settings.toml_text import places

_PYPROJECT = ("tool", "msaa-lint")
_UNFINISHED = re.compile(r"^[ \t]*([\w-]+)[ \t]*=?[ \t]*$", re.MULTILINE)
"""A key that has no value yet, with which the text is not TOML."""

TABLE = re.compile(r"^[ \t]*\[([^\[\]\n]+)\]", re.MULTILINE)
"""The header of a table."""

_LINK = re.compile(r"\[([^\]]+)\]\((?!https?://)[^)\s]*\)")


def setting_at(text: str, offset: int) -> tuple[str, Span] | None:
    """What the key of a configuration means that is at an offset, or whose value is, and its
    place.
    """
    found: tuple[str, Span] | None = None
    for path, place in places(text).items():
        names = [
            part for part in (path[2:] if path[:2] == _PYPROJECT else path) if isinstance(part, str)
        ]
        words = next(
            (
                words
                for n in range(len(names), 0, -1)
                if (words := documentation(".".join(names[:n])))
            ),
            "",
        )
        for span in (place.key, place.value):
            if (
                words
                and span.start <= offset <= span.end
                and (found is None or _length(span) <= _length(found[1]))
            ):
                found = without_links(words), span
    unfinished = next(
        (match for match in _UNFINISHED.finditer(text) if match.start(1) <= offset <= match.end(1)),
        None,
    )
    if found is None and unfinished is not None:
        table = ["", *TABLE.findall(text, 0, unfinished.start())][-1].strip()
        own = not table.startswith("tool.") or table.startswith(".".join(_PYPROJECT))
        words = setting_text(unfinished[1]) if own else ""
        return (words, Span(*unfinished.span(1))) if words else None
    return found


def setting_text(name: str) -> str:
    """What a key means, or a key of one of the tables; empty if there is none of that name."""
    return without_links(
        next(
            filter(None, (documentation(f"{table}{name}") for table in ("", "limits.", "source."))),
            "",
        )
    )


def _length(span: Span) -> int:
    return span.end - span.start


def without_links(markdown: str) -> str:
    """Markdown without relative links, which lead nowhere from an editor: their texts remain."""
    return _LINK.sub(r"\1", markdown)
