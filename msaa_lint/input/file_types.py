"""File name endings of inputs. Nothing of a reader is imported for them."""

from msaa_lint.core.extras import needs_extra

STDIN = "-"
"""The path of standard input."""

HEAD_BYTES = 64 << 10
"""The bytes at the beginning of a file from which its format is detected."""

INPUT, NEAR, OTHER = "input", "near", "other"
"""What a file in a folder is: an input; a file with the structure of a description, but without what only a frame has; any other file."""

DESCRIPTIONS = (".msaa.yaml", ".msaa.yml", ".msaa.json")
"""Inputs by their name."""

DATA = (".yaml", ".yml", ".json", ".jsonl", ".xml", ".foz")
"""Inputs if their content shows a frame; never source code."""

LANGUAGES: dict[str, tuple[str, ...]] = {
    "c": (".c", ".h"),
    "cpp": (".cc", ".cpp", ".cxx", ".hpp", ".hh", ".hxx", ".inl", ".ipp", ".h++"),
    "swift": (".swift",),
    "glsl": (".glsl", ".vert", ".frag", ".comp", ".tesc", ".tese", ".geom", ".mesh", ".task"),
    "markdown": (".md", ".markdown", ".mdx"),
}
"""The endings of source code by language, as `--input-format` names it. In Markdown, fenced code is read."""

SOURCES = tuple(ending for language, endings in LANGUAGES.items() if language != "markdown" for ending in endings)
"""Source code: inputs of a folder if they mention multisampling. Markdown is linted only if it is named."""


def missing_extra() -> str:
    """The message that source code cannot be read without the extra `source`."""
    return needs_extra("reading source code", "source")
