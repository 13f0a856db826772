"""Azure Pipelines: findings as logging commands, which become issues of the step."""

from __future__ import annotations

from itertools import chain

from msaa_lint.core.finding import Finding, Result

from . import Options, Write
from .annotations import annotation_lines, by_importance, unread_notes
from .escape import display, escape
from .paths import relative
from .place import place


def render(result: Result, out: Write, options: Options) -> None:
    """Prints a command per finding and per input that shows no pass to check, the most important
    first: the agent keeps ten errors and ten warnings of a step as issues, and the others only in
    its log.
    """
    for finding in chain(by_importance(result.findings), unread_notes(result)):
        out(_command(finding, result, options) + "\n")


def _command(finding: Finding, result: Result, options: Options) -> str:
    note = finding.severity == "note"
    # There are only errors and warnings.
    properties: dict[str, str | int] = {"type": "warning" if note else finding.severity}
    properties["sourcepath"] = escape(relative(finding.file, options.root))
    at = place(result, finding.file, finding.span)
    if at is not None:
        properties |= {"linenumber": at.line, "columnnumber": at.column}
    properties["code"] = display(finding.code)
    joined = "".join(f"{name}={_property(str(value))};" for name, value in properties.items())
    text = "\n".join(annotation_lines(finding, options))
    return (
        "##vso[task.logissue "
        f"{joined}]{_data(('note: ' if note else '') + f'{display(finding.rule)}: {text}')}"
    )


def _data(text: str) -> str:
    return text.replace("%", "%AZP25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace("]", "%5D").replace(";", "%3B")
