"""A table and collapsible details, for a comment on a pull request."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from msaa_lint.core.finding import rank

from .escape import shown
from .full import paragraph
from .paths import shown_path
from .place import place
from .summary import cost, fixable, plural, price_of_all, sentence

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Result

    from . import Options, Write

LONGEST_COMMENT = 65_000
"""Characters; GitHub refuses a comment of more than 65536."""

_LONGEST_TABLE = 40_000
_TABLE_HEAD = "| Severity | Rule | Place | Finding | Cost |\n| --- | --- | --- | --- | --- |\n"
_SPECIAL = re.compile(r"[\\`*_{}\[\]()<>|~!#@$&%]")
# A zero-width space, which hides a mention, a reference or an address from the programs that look for them in the finished page.
_APART = "&#8203;"
_MARKERS = "@#!$~&%"
_ADDRESS = re.compile(r"(?i)(?<=www)(?=\.)|(?<=:)(?=//)|(?<=gh)(?=-\d)")


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the summary, a table of the findings with the worst first, and for each its excerpt, as far as one comment holds them."""
    head = f"<!-- msaa-lint -->\n### msaa-lint\n\n{literal(sentence(result, options))}\n"
    for text in (price_of_all(result), fixable(result)):
        if text:
            head += f"\n{literal(text)}\n"
    out(head)
    if not result.findings:
        return
    left = LONGEST_COMMENT - len(head)
    lines = "".join(["\n", *table(result, options, min(left, _LONGEST_TABLE), len)])
    out(lines)
    left -= len(lines) + 200
    rules = {rule.name for rule in result.rules}
    plain = options._replace(color=False, width=100)
    for done, finding in enumerate(_worst_first(result)):
        details = _details(finding, paragraph(finding, result, plain, rules), result, options)
        if len(details) > left:
            out(f"\nThe details of {plural(len(result.findings) - done, 'more finding')} do not fit here.\n")
            return
        left -= len(details)
        out(details)


def table(result: Result, options: Options, room: int, size: Callable[[str], int]) -> Iterator[str]:
    """The lines of the table, the worst findings first, in at most `room` as `size` counts; the last says how many are missing."""
    room -= size(_TABLE_HEAD) + 100
    yield _TABLE_HEAD
    for done, finding in enumerate(_worst_first(result)):
        cells = (finding.severity, shown(finding.rule), _where(finding, result, options), shown(finding.message), cost(finding))
        line = f"| {' | '.join(literal(cell) for cell in cells)} |\n"
        room -= size(line)
        if room < 0:
            yield f"\n{plural(len(result.findings) - done, 'more finding')} not shown.\n"
            return
        yield line


def literal(text: str) -> str:
    """`text`, already visible, so that Markdown, HTML and what a forge makes of `@name`, `#1` and addresses leave it as it is."""
    text = _ADDRESS.sub("\u200b", text)
    text = _SPECIAL.sub(lambda found: f"&#{ord(found[0])};" + (_APART if found[0] in _MARKERS else ""), text)
    return text.replace("\u200b", _APART)


def _details(finding: Finding, text: str, result: Result, options: Options) -> str:
    runs = [len(run) for run in re.findall("`+", text)]
    fence = "`" * max(3, max(runs, default=0) + 1)
    where = literal(_where(finding, result, options))
    title = f"{finding.severity}: {literal(shown(finding.rule))} at {where}"
    return f"\n<details><summary>{title}</summary>\n\n{fence}text\n{text}\n{fence}\n\n</details>\n"


def _where(finding: Finding, result: Result, options: Options) -> str:
    at = place(result, finding.file, finding.span)
    path = shown_path(finding.file, options.root)
    return f"{path}:{at.line}:{at.column}" if at else path


def _worst_first(result: Result) -> list[Finding]:
    return sorted(result.findings, key=lambda finding: -rank(finding.severity))
