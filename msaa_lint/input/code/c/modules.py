"""Blanks the declarations of C++20 modules, which the grammar does not know."""

import re

_DECLARATION = re.compile(
    r"^[ \t]*(?:export[ \t]+)?(?:module\b[ \t]*[\w.:]*|import\b[ \t]*[\w.:<>/\"]+)[ \t]*;",
    re.MULTILINE,
)
"""`module;`, `export module a.b:c;`, `import std;`, `export import :part;` ([module.unit],
[module.import]).
"""

_EXPORT = re.compile(r"^[ \t]*export(?=\s+(?!\")\w|\s*\{)", re.MULTILINE)


def without_modules(text: str) -> str:
    """Returns the text without module declarations, imports, and `export`, at the same offsets."""
    if "export" not in text and "import" not in text:
        return text
    return _EXPORT.sub(_blank, _DECLARATION.sub(_blank, text))


def _blank(match: re.Match[str]) -> str:
    return " " * len(match[0])
