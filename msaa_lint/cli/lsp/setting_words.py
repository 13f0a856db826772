"""The keys of a configuration in words."""

from __future__ import annotations

import re

from msaa_lint.core.text.span import Span
from msaa_lint.linter.settings.reference import documentation
from msaa_lint.linter.settings.toml_text import places

_PYPROJECT = ("tool", "msaa-lint")
_LINK = re.compile(r"\[([^\]]+)\]\((?!https?://)[^)\s]*\)")


def setting_at(text: str, offset: int) -> tuple[str, Span] | None:
    """What the key of a configuration means that is at an offset, or whose value is, and its place."""
    found: tuple[str, Span] | None = None
    for path, place in places(text).items():
        names = [part for part in (path[2:] if path[:2] == _PYPROJECT else path) if isinstance(part, str)]
        words = next((words for n in range(len(names), 0, -1) if (words := documentation(".".join(names[:n])))), "")
        for span in (place.key, place.value):
            if words and span.start <= offset <= span.end and (found is None or _length(span) <= _length(found[1])):
                found = without_links(words), span
    return found


def setting_text(name: str) -> str:
    """What a key means, or a key of one of the tables; empty if there is none of that name."""
    return without_links(next(filter(None, (documentation(f"{table}{name}") for table in ("", "limits.", "source."))), ""))


def _length(span: Span) -> int:
    return span.end - span.start


def without_links(markdown: str) -> str:
    """Markdown without relative links, which lead nowhere from an editor: their texts remain."""
    return _LINK.sub(r"\1", markdown)
