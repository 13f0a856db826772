"""`msaa-lint rule`: the list of rules and their pages."""

from __future__ import annotations

import re
import shutil
import sys
import textwrap
from collections.abc import Collection, Sequence

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import RuleInfo
from msaa_lint.core.quote import quoted
from msaa_lint.linter.request import Request
from msaa_lint.linter.rules.registry import markdown
from msaa_lint.linter.rules.rule import APIS, PASSES, Rule
from msaa_lint.linter.settings.selectors import RuleNames
from msaa_lint.linter.workspace import Workspace

from .common import overrides, run_command, warn
from .options import Arguments
from .report.data import dump_indented
from .report.escape import display, escape_lines
from .report.markdown import escape_markdown
from .report.paths import uri

CODE_WIDTH, NAME_WIDTH = 8, 44
"""Columns of the list of rules; a longer code or name moves the rest of its line."""


def rule(arguments: Arguments) -> int:
    """Prints what the arguments ask for; returns the exit code."""
    return run_command(_rule, arguments)


def _rule(arguments: Arguments) -> int:
    output = arguments.get("output", "text")
    workspace = Workspace(
        Request(
            [],
            overrides(arguments),
            arguments.get("config"),
            bool(arguments.get("isolated")),
            traceback=bool(arguments.get("traceback")),
        )
    )
    if arguments.get("all") or not arguments["paths"]:
        return list_rules(workspace, output)
    return explain_rule(arguments["paths"][0], workspace, output)


def explain_rule(name: str, workspace: Workspace, output: str) -> int:
    """Prints the page of the rule with a name or code, in any case; returns 2, after the problems
    of pages, if there is none.
    """
    registry = workspace.current.engine.registry
    wanted = name.upper()
    for rule in registry.rules:
        if wanted in (rule.name.upper(), rule.code):
            _print_page(rule, output)
            return 0
    for diagnostic in DIAGNOSTICS.values():
        if wanted in (diagnostic.name.upper(), diagnostic.code):
            _print_diagnostic(diagnostic, output)
            return 0
    pages = [
        page.page
        for page in registry.broken
        if wanted in (page.name.upper(), page.code.upper() or None)
    ]
    _warn_of_problems(workspace, pages)
    if not pages:
        close = RuleNames(registry.names).suggestions.nearest(name)
        warn(
            f"unknown rule {quoted(name)}: "
            + (f"did you mean `{close}`?" if close else "`msaa-lint rule --all` lists the rules")
        )
    return 2


def list_rules(workspace: Workspace, output: str) -> int:
    """Prints the rules; returns 2 if the configuration or a custom page cannot be used."""
    rules: list[Rule | RuleInfo] = [*workspace.current.engine.registry.rules, *DIAGNOSTICS.values()]
    if output == "json":
        print(dump_indented([_record(rule) for rule in rules]))
    elif output == "markdown":
        print(index(rules), end="")
    else:
        _print_list(rules)
    _warn_of_problems(workspace)
    return 2 if any(found.fatal for found in workspace.findings) else 0


def _print_list(rules: Sequence[Rule | RuleInfo]) -> None:
    """Prints one line for each rule; in a terminal that is too narrow, its summary below."""
    rows = [
        (f"{rule.code:{CODE_WIDTH}} {rule.name:{NAME_WIDTH}} {rule.severity:7}", _summary(rule))
        for rule in rules
    ]
    longest = max(len(row) + len(summary) + 1 for row, summary in rows)
    width = shutil.get_terminal_size().columns if sys.stdout.isatty() else longest
    for row, summary in rows:
        if longest <= width:
            print(f"{row} {summary}")
        else:
            print(row.rstrip())
            print(
                textwrap.fill(
                    summary,
                    max(width, 40),
                    initial_indent="    ",
                    subsequent_indent="    ",
                    break_on_hyphens=False,
                )
            )


def _summary(rule: Rule | RuleInfo) -> str:
    """A rule's summary; that of a custom rule begins with its page."""
    return (
        display(f"({rule.source.name}) {rule.summary}")
        if isinstance(rule, Rule) and rule.is_custom
        else rule.summary
    )


def _warn_of_problems(workspace: Workspace, pages: Collection[str] = ()) -> None:
    """Prints the problems of the configuration and of custom pages, or only those of some `pages`,
    with their places.
    """
    for found in dict.fromkeys(workspace.findings):
        source = workspace.sources.get(found.file)
        place = (
            source.position(found.span.start)
            if source is not None and found.span is not None
            else None
        )
        if not pages or found.file in pages:
            at = f"{found.file}:{place.line}:{place.column}" if place is not None else found.file
            warn(f"{at}: {found.message}" + (f": {found.help}" if found.help else ""))


FAMILIES = {
    "1": "Sample counts", "2": "Load and store", "3": "Resolve", "4": "Memory and tiles",
    "5": "Pipelines and shading",
    "6": "Synchronization around a resolve", "7": "Numbers: when an average is wrong",
    "8": "Metal, and what only source code shows",
    "9": "Inputs and configuration",
}  # fmt: skip
"""Headings by the first digit of a code."""


def index(rules: Sequence[Rule | RuleInfo]) -> str:
    """The list of rules as a Markdown page: rules/README.md."""
    out = [
        "# Rules\n\nGenerated by `msaa-lint rule --all --output markdown`; do not edit. `msaa-lint "
        "rule NAME` prints a page.\n"
    ]
    family = ""
    for rule in rules:
        heading = (
            "Custom"
            if isinstance(rule, Rule) and rule.is_custom
            else FAMILIES[rule.code.removeprefix("MSAA")[:1]]
        )
        if heading != family:
            family = heading
            out.append(
                f"\n## {heading}\n\n| code | rule | severity | summary |\n|---|---|---|---|\n"
            )
        name, summary = rule.name, rule.summary
        if isinstance(rule, Rule) and rule.is_custom:
            name, summary = (
                f"[{name}]({uri(rule.source.name, '')})",
                escape_markdown(display(summary)),
            )
        elif isinstance(rule, Rule):
            name = f"[{name}]({rule.source.name.removeprefix('rules/')})"
        fix = " Has a fix." if isinstance(rule, Rule) and rule.fix_specs else ""
        out.append(f"| {rule.code} | {name} | {rule.severity} | {summary}{fix} |\n")
    return "".join(out)


def _record(rule: Rule | RuleInfo) -> dict[str, object]:
    custom = isinstance(rule, Rule) and rule.is_custom
    return {
        "code": rule.code,
        "name": rule.name,
        "severity": rule.severity,
        "confidence": rule.confidence,
        "summary": rule.summary,
        "fixable": isinstance(rule, Rule) and bool(rule.fix_specs),
        "references": list(rule.references),
        "page_path": rule.source.name if isinstance(rule, Rule) and custom else None,
    }


def page(rule: Rule) -> str:
    """A rule's page as Markdown, with its condition and references."""
    since = (
        f"since edition {rule.edition}"
        if rule.edition
        else f"a custom rule in `{rule.source.name}`"
    )
    lines = [
        f"**{rule.code}** {rule.name}, {rule.severity}, confidence {rule.confidence}, {since}."
    ]
    if rule.apis != APIS[:1]:
        lines.append(f"Applies to {' and '.join(api.capitalize() for api in rule.apis)} frames.")
    if rule.vendors:
        lines.append(f"Applies to {', '.join(rule.vendors)}; a note on other devices.")
    if rule.passes != PASSES[0]:
        lines.append("Applies also to render passes that no command begins.")
    lines += [f"Fix ({fix.safety}): {fix.title}." for fix in rule.fix_specs]
    references = "".join(f"- {reference}\n" for reference in rule.references)
    return (
        f"# {rule.name}\n\n{' '.join(lines)}\n\n{markdown(rule).rstrip()}\n\n"
        f"## Condition\n\nEvaluated for each {rule.subject} (`msaa-lint facts` lists the facts):\n"
        f"\n```\n{rule.when}\n```\n\n"
        f"## References\n\n{references}"
    )


def _print_page(rule: Rule, output: str) -> None:
    text = page(rule)
    if output == "json":
        print(dump_indented({**_record(rule), "condition": rule.when, "page": text}))
    elif output == "markdown" or not sys.stdout.isatty():
        print(escape_lines(text))
    else:
        # rich hides the info string of a fence, which says what kind of example it is.
        from .report.rendered_page import print_markdown

        print_markdown(
            re.sub(
                r"^```(yaml|json) (bad|fixed|good)\b.*$",
                r"*\2:*\n\n```\1",
                text,
                flags=re.MULTILINE,
            )
        )


def _print_diagnostic(diagnostic: RuleInfo, output: str) -> None:
    if output == "json":
        print(dump_indented(_record(diagnostic)))
    else:
        print(
            f"# {diagnostic.name}\n\n**{diagnostic.code}**, {diagnostic.severity}. "
            f"{diagnostic.summary}"
        )
