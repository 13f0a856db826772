"""GitLab's Code Quality report: one JSON list."""

from __future__ import annotations

from msaa_lint.core.finding import Finding, Result
from msaa_lint.linter.rules.reference_links import rule_address

from . import Options, Write
from .data import write_list
from .escape import display, escape
from .fingerprint import fingerprints
from .paths import relative
from .place import place
from .summary import price_text

_SEVERITY = {"note": "info", "warning": "minor", "error": "major"}


def render(result: Result, out: Write, options: Options) -> None:
    """Prints the list, which is empty if there are no findings."""
    names = fingerprints(result.findings, options.root)
    write_list(
        (
            _issue(finding, name, result, options)
            for finding, name in zip(result.findings, names, strict=True)
        ),
        out,
    )
    out("\n")


def _issue(finding: Finding, name: str, result: Result, options: Options) -> dict[str, object]:
    at = place(result, finding.file, finding.span)
    location: dict[str, object] = {"path": escape(relative(finding.file, options.root))}
    if at:
        begin, end = (
            {"line": at.line, "column": at.column},
            {"line": at.end_line, "column": at.end_column},
        )
        location["positions"] = {"begin": begin, "end": end}
    else:
        location["lines"] = {"begin": 1}
    price = price_text(finding)
    address = rule_address(options.docs_url, finding.code, finding.rule)
    return {
        # GitLab does not show check_name.
        "description": f"{display(finding.rule)}: {display(finding.message)}"
        + (f" ({price})" if price else ""),
        "check_name": display(finding.rule),
        "fingerprint": name,
        "severity": _SEVERITY[finding.severity],
        "location": location,
        # Of Code Climate's format, which GitLab's is a part of.
        **({"content": {"body": f"[{display(finding.rule)}]({address})"}} if address else {}),
    }
