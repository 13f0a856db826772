"""A table and collapsible details, for a comment on a pull request."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from msaa_lint.core.finding import Finding, Result, rank
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options, Write
from .escape import display
from .full import paragraph
from .paths import display_path
from .place import place
from .summary import plural, price_text, summary

MAX_COMMENT = 65_000
"""Characters of a comment; GitHub rejects more than 65536."""

_MAX_TABLE = 40_000
_TABLE_HEAD = "| Severity | Rule | Place | Finding | Cost |\n| --- | --- | --- | --- | --- |\n"
_SPECIAL = re.compile(r"[\\`*_{}\[\]()<>|~!#@$&%]")
# A zero-width space, which hides mentions, references, and addresses from programs that look for
# them in the rendered page.
_SEPARATOR = "&#8203;"
_MARKERS = "@#!$~&%"
_ADDRESS = re.compile(r"(?i)(?<=www)(?=\.)|(?<=:)(?=//)|(?<=gh)(?=-\d)")


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the summary, a table of the findings, the most severe first, and the excerpt of each,
    as far as one comment can hold them.
    """
    head = "<!-- msaa-lint -->\n### msaa-lint\n" + "".join(
        f"\n{escape_markdown(line)}\n" for line in summary(result, options)
    )
    out(head)
    if not result.findings:
        return
    left = MAX_COMMENT - len(head)
    lines = "".join(["\n", *table(result, options, min(left, _MAX_TABLE), len)])
    out(lines)
    left -= len(lines) + 200
    rules = {rule.name for rule in result.rules}
    plain = options._replace(color=False, hyperlinks=False, width=100)
    for done, finding in enumerate(_by_severity(result)):
        details = _details(finding, paragraph(finding, result, plain, rules), result, options)
        if len(details) > left:
            out(
                f"\nThe details of {plural(len(result.findings) - done, 'more finding')} do not "
                "fit into this comment.\n"
            )
            return
        left -= len(details)
        out(details)


def table(result: Result, options: Options, room: int, size: Callable[[str], int]) -> Iterator[str]:
    """The lines of the table, the most severe findings first, in at most `room` as `size` counts;
    the last line counts the missing ones.
    """
    room -= size(_TABLE_HEAD) + 100
    yield _TABLE_HEAD
    for done, finding in enumerate(_by_severity(result)):
        texts = (
            finding.severity,
            display(finding.rule),
            _where(finding, result, options),
            display(finding.message),
            price_text(finding),
        )
        cells = list(map(escape_markdown, texts))
        address = rule_address(options.docs_url, finding.code, finding.rule)
        if address:
            cells[1] = f"[{cells[1]}](<{address}>)"
        line = f"| {' | '.join(cells)} |\n"
        room -= size(line)
        if room < 0:
            yield f"\n{plural(len(result.findings) - done, 'more finding')} not shown.\n"
            return
        yield line


def escape_markdown(text: str) -> str:
    """`text`, already escaped by `escape`, so that Markdown, HTML, and a forge's links (`@name`,
    `#1`, addresses) leave it unchanged.
    """
    text = _ADDRESS.sub("\u200b", text)
    text = _SPECIAL.sub(
        lambda match: f"&#{ord(match[0])};" + (_SEPARATOR if match[0] in _MARKERS else ""), text
    )
    return text.replace("\u200b", _SEPARATOR)


def _details(finding: Finding, text: str, result: Result, options: Options) -> str:
    runs = [len(run) for run in re.findall("`+", text)]
    fence = "`" * max(3, max(runs, default=0) + 1)
    where = escape_markdown(_where(finding, result, options))
    title = f"{finding.severity}: {escape_markdown(display(finding.rule))} at {where}"
    return f"\n<details><summary>{title}</summary>\n\n{fence}text\n{text}\n{fence}\n\n</details>\n"


def _where(finding: Finding, result: Result, options: Options) -> str:
    at = place(result, finding.file, finding.span)
    path = display_path(finding.file, options.root)
    return f"{path}:{at.line}:{at.column}" if at else path


def _by_severity(result: Result) -> Iterator[Finding]:
    ranks = [-rank(finding.severity) for finding in result.findings]
    return (result.findings[number] for number in sorted(range(len(ranks)), key=ranks.__getitem__))
