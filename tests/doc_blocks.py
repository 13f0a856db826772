"""What the documentation tells to run: its fenced blocks and inline commands, page by page, in
order.

A comment `<!-- not run: REASON -->` above a block excludes it. From `<!-- in a clone -->` on,
commands run in a clone of the repository; at first, and from `<!-- in an empty folder -->` on, in
an empty folder. A block whose first line is a comment with a file name is the content of that file.
`python -m tests.doc_blocks` counts the commands that are run, and those that are not by reason.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from markdown_it import MarkdownIt

from msaa_lint.cli.commands import COMMANDS
from tests.paths import ROOT

_PATTERNS = (
    *("README.md", "CONTRIBUTING.md", "docs/*.md", "docs/guides/*.md"),
    *("examples/README.md", "examples/*/README.md", "rules/README.md"),
)
PAGES = tuple(
    path.relative_to(ROOT).as_posix()
    for pattern in _PATTERNS
    for path in sorted(ROOT.glob(pattern))
)
COMMAND = re.compile(r"(?:[A-Z_]+=\S+ )*(?:msaa-lint|python3?|sh|pip|apt|git) (?!-$)\S.*")
"""Inline code that is a command."""
FILE_NAME = re.compile(r"(?:#|//) ([\w./-]+\.\w+)\n")
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}\b(?![=_.-])|\.\.\.|\||<")
"""What stands for a value in a command: FILE, SCENE|PATH."""


class Block(NamedTuple):
    """A fenced block, or inline code that is a command, whose language is `inline`."""

    page: str
    line: int
    language: str
    text: str
    skipped: str = ""
    """The reason why it is not run."""
    in_clone: bool = False

    @property
    def place(self) -> str:
        return f"{self.page}:{self.line}"

    @property
    def file_name(self) -> str | None:
        """The file whose content this is."""
        named = FILE_NAME.match(self.text)
        return named[1] if named else None

    def commands(self) -> list[str]:
        """The shell commands, one per logical line."""
        if self.language == "inline":
            return [self.text]
        if self.language == "sh":
            return [
                line
                for line in self.text.replace("\\\n", " ").splitlines()
                if line.strip() and not line.startswith("#")
            ]
        return [
            line[2:]
            for line in self.text.splitlines()
            if self.language == "console" and line.startswith("$ ")
        ]


def blocks(page: str) -> Iterator[Block]:
    """The blocks of a page in order."""
    skipped, in_clone = "", False
    for token in MarkdownIt().enable("table").parse((ROOT / page).read_text(encoding="utf-8")):
        line = token.map[0] + 1 if token.map else 0
        if token.type == "html_block":
            reason = re.search(r"<!-- not run: (.+?) -->", token.content)
            skipped = reason[1] if reason else ""
            where = re.search(r"<!-- in (a clone|an empty folder) -->", token.content)
            in_clone = where[1] == "a clone" if where else in_clone
        elif token.type in ("fence", "code_block"):
            yield Block(
                page,
                line,
                token.info.strip() if token.type == "fence" else "indented",
                token.content,
                skipped,
                in_clone,
            )
            skipped = ""
        elif token.type == "inline":
            for child in token.children or ():
                if child.type == "code_inline" and COMMAND.fullmatch(child.content):
                    yield Block(
                        page, line, "inline", child.content, _not_run(child.content), in_clone
                    )


def _not_run(command: str) -> str:
    """Why an inline command is not run; empty if it is."""
    if not command.startswith("msaa-lint "):
        return "inline: a script of the repository, or another tool"
    if PLACEHOLDER.search(command):
        return "inline: with a placeholder"
    if "--watch" in command:
        return "inline: runs until it is interrupted"
    _, name, *words = command.split()
    if not words:
        return "inline: the name of a command"
    flags = {word[2:].replace("-", "_") for word in words if word.startswith("--")}
    needs_path = (
        name in COMMANDS
        and COMMANDS[name].paths.min > 0
        and not flags & {*COMMANDS[name].standalone}
    )
    return (
        "inline: without the input that it needs" if needs_path and len(flags) == len(words) else ""
    )


def main() -> None:
    """Prints the counts."""
    counts = Counter(
        "run" if not block.skipped else f"not run: {block.skipped}"
        for page in PAGES
        for block in blocks(page)
        for _ in block.commands()
    )
    for reason, count in counts.most_common():
        print(f"{count:4} {reason}")


if __name__ == "__main__":
    main()
