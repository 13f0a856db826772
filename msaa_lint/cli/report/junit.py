"""JUnit XML: a test suite per file, a test case per finding, and a passing test case for each clean
file.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import chain, groupby
from operator import attrgetter, itemgetter

from msaa_lint.core.finding import Finding, Result, is_confident
from msaa_lint.core.spool import Spool, SpooledSort

from . import Options, Write
from .escape import display, escape
from .paths import relative
from .place import place
from .summary import price_text

_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&apos;"})


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the document. An unusable input is an error; a note, or a finding below
    `fail_confidence`, is a passing case that prints it; other findings are failures. An input
    without findings that shows no pass to check is a skipped case.
    """
    unread = {each.file: each.unread.message for each in result.inputs if each.unread is not None}
    suites = dict.fromkeys(chain(result.files, (finding.file for finding in result.findings)), 0)
    for finding in result.findings:
        suites[finding.file] += 1
    suites = suites or {"msaa-lint": 0}  # Jenkins and GitLab consider an empty report broken
    tests = sum(max(1, count) for count in suites.values())
    out('<?xml version="1.0" encoding="UTF-8"?>\n')
    out(
        f"<testsuites{_attributes(name='msaa-lint', tests=tests, **_counts(result.findings, options))}>\n"  # noqa: E501
    )
    for file, findings in _by_file(result.findings, suites):
        path = escape(relative(file, options.root))
        counts = _counts(findings, options)
        reason = unread.get(file) if not findings else None
        if reason is not None:
            counts["skipped"] = 1
        out(
            f"  <testsuite{_attributes(name=path, package='org.msaa-lint', tests=max(1, len(findings)), **counts)}>\n"  # noqa: E501
        )
        for finding in findings:
            out(_case(finding, path, result, options))
        if not findings:
            case = _attributes(name="No findings", classname=_class(path))
            body = (
                f">\n      <skipped{_attributes(message=display(reason))}/>\n    </testcase>\n"
                if reason is not None
                else "/>\n"
            )
            out(f"    <testcase{case}{body}")
        out("  </testsuite>\n")
    out("</testsuites>\n")


def _by_file(
    findings: Iterable[Finding], files: Iterable[str]
) -> Iterator[tuple[str, list[Finding]]]:
    """The files, each with its findings."""
    rows: SpooledSort[Finding] = SpooledSort(Spool(), 1)
    numbers = {file: number for number, file in enumerate(files)}
    for file, of_file in groupby(findings, attrgetter("file")):
        rows.add((numbers[file],), list(of_file))
    groups = groupby(rows, itemgetter(0))
    following = next(groups, None)
    for file, number in numbers.items():
        found: list[Finding] = []
        if following is not None and following[0] == (number,):
            found = [finding for _, some in following[1] for finding in some]
            following = next(groups, None)
        yield file, found


def _case(finding: Finding, path: str, result: Result, options: Options) -> str:
    at = place(result, finding.file, finding.span)
    message = display(finding.message)
    attributes: dict[str, str | int] = {
        "name": f"org.msaa-lint.{display(finding.code)}",
        "classname": _class(path),
    }
    price = price_text(finding)
    text = message + (f" ({price})" if price else "")
    if at:
        attributes |= {"file": path, "line": at.line, "column": at.column}
        text = f"line {at.line}, column {at.column}, {text}"
    else:
        text = f"{path}, {text}"
    # One element: Jenkins keeps only the first of several.
    if not _fails(finding, options):
        body = f"<system-out>{_xml(text)}</system-out>"
    else:
        kind = "error" if finding.fatal else "failure"
        body = f"<{kind}{_attributes(message=message, type=display(finding.rule))}>{_xml(text)}</{kind}>"  # noqa: E501
    severity = f"<properties><property{_attributes(name='severity', value=finding.severity)}/></properties>"  # noqa: E501
    return (
        f"    <testcase{_attributes(**attributes)}>\n      {severity}\n      {body}\n    "
        "</testcase>\n"
    )


def _counts(findings: Iterable[Finding], options: Options) -> dict[str, str | int]:
    levels = Counter((finding.fatal, _fails(finding, options)) for finding in findings)
    return {
        "failures": levels[False, True],
        "errors": levels.total() - levels[False, True] - levels[False, False],
    }


def _fails(finding: Finding, options: Options) -> bool:
    return finding.severity != "note" and is_confident(finding, options.fail_confidence)


def _class(path: str) -> str:
    folder, slash, name = path.rpartition("/")
    stem = name.rpartition(".")[0] or name
    return folder + slash + stem


def _attributes(**values: str | int) -> str:
    return "".join(f' {name}="{_xml(str(value))}"' for name, value in values.items())


def _xml(text: str) -> str:
    """`text`, which has none of the characters that XML 1.0 forbids, as character data or an
    attribute value.
    """
    return text.translate(_ESCAPES)
