"""What the user states about source code: `// msaa-lint: assume settings.samples=4`, and
`[source.assume]` of the configuration.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice

from msaa_lint.core.quote import quoted
from msaa_lint.core.text.span import Span

from .comments import Comments, comments
from .core.assumed_values import SAMPLES
from .parsing import Assumed, Assumptions, Code, Remark

MAX_ASSUMPTIONS = 1000
"""The number of assumptions of a file; those after it are an error."""

COUNTS = (1, 2, 4, 8, 16, 32, 64)

_BEGINNING = re.compile(r"#\s*msaa-lint\s*:\s*assume\b\s*", re.IGNORECASE)
_ENTRY = re.compile(
    r"(?P<name>[A-Za-z_][\w.:>\[\]()-]*?)\s*=\s*(?P<value>[^\s,]+)(?P<comma>\s*,\s*)?"
)
NAME = re.compile(
    r"(?:[A-Za-z_]\w*(?:\[\w*\])*(?:\(\))?)(?:(?:::|\.|->)[A-Za-z_]\w*(?:\[\w*\])*(?:\(\))?)*\Z"
)
"""`m_state.msaa`, `Settings::samples`, `getSamples()`, `renderer->samples`, `views[]`,
`ENGINE_MSAA`.
"""

_INTEGER = re.compile(r"(?:0[xX][0-9a-fA-F]{1,8}|\d{1,10})[uU]?\Z")
_ENUMERANT = re.compile(r"(?:VK_|VMA_|vk::|MTL|\.)\w+(?:::\w+)*\Z")
_PROTOTYPE = re.compile(
    r"[\w:<>&*,\s]*[\s&*](?P<name>[A-Za-z_]\w*)\s*\([^()]*\)\s*(?:const|noexcept|override|final|=\s*0|\s)*;"
)

EXAMPLE = "write `// msaa-lint: assume samples=4` or `// msaa-lint: assume NAME=VALUE`"


def value_of(text: str) -> bool | int | str | None:
    """Returns the value that a text states: true or false, an integer, or an enumerant of Vulkan or
    Metal; None for any other.
    """
    if text in ("true", "false"):
        return text == "true"
    if _INTEGER.match(text):
        return int(text.rstrip("uU"), 0 if text[:2].lower() == "0x" else 10)
    return text if _ENUMERANT.match(text) else None


def problem_of(name: str, value: bool | int | str | None, text: str) -> str:
    """Returns what is wrong with an assumption; empty if nothing is."""
    if NAME.match(name) is None:
        return (
            f"{quoted(name)} is not a name; write a variable, a member, a call without "
            "arguments, or a macro"
        )
    if value is None:
        return f"{quoted(text)} is not a value; write true, false, an integer, or an enumerant"
    if name == SAMPLES and (type(value) is bool or (type(value) is int and value not in COUNTS)):
        return f"{quoted(text)} is not a sample count; write 1, 2, 4, 8, 16, 32, or 64"
    return ""


def stated(
    codes: Sequence[tuple[Code, int]], configured: Mapping[str, bool | int | str]
) -> Assumptions:
    """Returns the assumptions of the comments in code, given with its offset in the program's text,
    and those of the configuration.
    """
    every = [Assumed(name, value, None, Span(0, 0)) for name, value in configured.items()]
    remarks: list[Remark] = []
    for code, offset in codes:
        if "assume" in code.text and "msaa-lint" in code.text:
            entries = list(islice(_of_code(code, offset, remarks), MAX_ASSUMPTIONS + 1))
            every += entries[:MAX_ASSUMPTIONS]
            if len(entries) > MAX_ASSUMPTIONS and (at := entries[MAX_ASSUMPTIONS].at) is not None:
                remarks.append(
                    Remark(
                        "MSAA906",
                        f"limit exceeded: more than {MAX_ASSUMPTIONS} assumptions; those from here "
                        "on are not read",
                        at,
                    )
                )
    return Assumptions(tuple(every), tuple(remarks), set())


def unused(assumptions: Assumptions) -> Iterator[Remark]:
    """Yields a remark for each comment that changed nothing."""
    for entry in assumptions.entries:
        if entry.at is not None and entry not in assumptions.used:
            where = "on its line" if entry.name == SAMPLES else "in this program"
            message = f"unused assumption: nothing {where} reads an unknown {quoted(entry.name)}"
            yield Remark("MSAA915", message, entry.at)


def _of_code(code: Code, offset: int, remarks: list[Remark]) -> Iterator[Assumed]:
    found = comments((code,))
    starts = [
        0,
        *(match.end() for match in re.finditer(r"\r\n|\r|\n", code.text)),
        len(code.text) + 1,
    ]
    first = line = 0
    for comment in found.comments:
        match = _BEGINNING.match(comment.text)
        if match is not None:
            base = comment.span.start
            number = bisect_left(starts, base + 1)
            if not first <= number < line:
                # The comments of a block are about the same line.
                first, line = number, _line_about(number, found, starts)
            about = Span(starts[line - 1] + offset, starts[line] + offset)
            yield from _entries(
                comment.text,
                match.end(),
                base + offset,
                about,
                code.text[starts[line - 1] : starts[line]],
                remarks,
            )


def _line_about(line: int, found: Comments, starts: Sequence[int]) -> int:
    """Returns the line that a comment on a line is about: its own or, if it is alone there, the
    next one that is not a comment.
    """
    while line in found.alone and line < len(starts) - 1:
        line += 1
    return line


def _entries(
    text: str, at: int, base: int, about: Span, line: str, remarks: list[Remark]
) -> Iterator[Assumed]:
    """Yields the assumptions of a comment, and reports what is wrong with them. What follows the
    last one is a reason.
    """
    first = True
    while True:
        match = _ENTRY.match(text, at)
        if match is None:
            if first:
                remarks.append(
                    Remark(
                        "MSAA916",
                        f"an assumption without `NAME=VALUE`; {EXAMPLE}",
                        Span(base, base + len(text.rstrip())),
                    )
                )
            return
        name, value = (
            match["name"].replace("->", ".").removeprefix("this."),
            value_of(match["value"]),
        )
        problem = problem_of(name, value, match["value"])
        part = "name" if problem and NAME.match(name) is None else "value"
        if problem or value is None:
            remarks.append(
                Remark("MSAA916", problem, Span(base + match.start(part), base + match.end(part)))
            )
        else:
            place = Span(base + match.start("name"), base + match.end("value"))
            prototype = _PROTOTYPE.match(line) if name == SAMPLES else None
            yield Assumed(
                f"{prototype['name']}()" if prototype is not None else name, value, place, about
            )
        if match["comma"] is None:
            return
        first, at = False, match.end()
