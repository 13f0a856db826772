"""`msaa-lint rule`: the catalogue and its pages."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import RuleInfo
from msaa_lint.core.suggestions import nearest
from msaa_lint.linter.engine import load_rules
from msaa_lint.linter.rules.registry import markdown
from msaa_lint.linter.rules.rule_file import APIS, Rule

from .report.escape import visible


def explain(name: str, own: Sequence[str], output: str) -> int:
    """Prints one rule's page; 2 where there is no such rule."""
    catalogue = load_rules(own)
    for rule in catalogue.rules:
        if name in (rule.name, rule.code):
            _print(rule, output)
            return 0
    info = next((info for info in DIAGNOSTICS.values() if name in (info.name, info.code)), None)
    if info is not None:
        _print_info(info, output)
        return 0
    known = [word for rule in catalogue.rules for word in (rule.name, rule.code)]
    known += [word for info in DIAGNOSTICS.values() for word in (info.name, info.code)]
    close = nearest(name, known)
    hint = f"; did you mean {close}?" if close else "; `msaa-lint rule --all` lists them"
    print(f"msaa-lint: no rule {visible(name)}{hint}", file=sys.stderr)
    return 2


def listing(own: Sequence[str], output: str) -> int:
    """Prints every rule, a line each."""
    catalogue = load_rules(own)
    infos = [_info(rule) for rule in catalogue.rules] + list(DIAGNOSTICS.values())
    if output == "json":
        import json

        print(json.dumps([_record(info) for info in infos], indent=2, ensure_ascii=False))
    elif output == "markdown":
        print(index(infos), end="")
    else:
        from rich.console import Console
        from rich.table import Table

        table = Table("code", "rule", "severity", "what", box=None, pad_edge=False)
        for info in infos:
            table.add_row(info.code, info.name, info.severity, info.summary)
        Console(markup=False, highlight=False).print(table)
    for problem in catalogue.problems:
        print(f"msaa-lint: {visible(problem.file)}: {visible(problem.message)}", file=sys.stderr)
    return 2 if catalogue.problems else 0


FAMILIES = {
    "1": "Sample counts", "2": "Load and store", "3": "Resolve", "4": "Memory and tiles", "5": "Pipelines and shading",
    "6": "Synchronisation around a resolve", "7": "Numbers: when an average is not the answer", "8": "Metal, and what only source shows",
    "9": "The description itself",
}  # fmt: skip
"""By the first digit of a code."""


def index(infos: Sequence[RuleInfo]) -> str:
    """The catalogue as a Markdown page: what rules/README.md holds."""
    out = [
        "# Rules\n\nMade by `msaa-lint rule --all --output markdown`: do not edit. `msaa-lint rule NAME` prints a page in the terminal.\n"
    ]
    family = ""
    for info in infos:
        digit = info.code.removeprefix("MSAA")[:1]
        if digit != family:
            family = digit
            out.append(f"\n## {FAMILIES.get(digit, 'Yours')}\n\n| code | rule | severity | what |\n|---|---|---|---|\n")
        name = info.name if digit == "9" else f"[{info.name}]({info.name}.md)"
        fix = " A fix is stated." if info.fixable else ""
        out.append(f"| {info.code} | {name} | {info.severity} | {info.summary}{fix} |\n")
    return "".join(out)


def _info(rule: Rule) -> RuleInfo:
    from msaa_lint.linter.rules.registry import info

    return info(rule)


def _record(info: RuleInfo) -> dict[str, object]:
    return {
        "code": info.code,
        "name": info.name,
        "severity": info.severity,
        "confidence": info.confidence,
        "summary": info.summary,
        "fixable": info.fixable,
        "references": list(info.references),
    }


def _head(rule: Rule) -> str:
    lines = [f"**{rule.code}** {rule.name}, {rule.severity}, confidence {rule.confidence}, since edition {rule.edition or '(yours)'}."]
    if rule.apis != APIS[:1]:
        lines.append(f"About frames in the words of {' and '.join(api.capitalize() for api in rule.apis)}.")
    if rule.vendors:
        lines.append(f"A rule of {', '.join(rule.vendors)}: a note on other devices.")
    lines += [f"Fix ({mend.safety}): {mend.title}." for mend in rule.fix_specs]
    return " ".join(lines)


def page(rule: Rule) -> str:
    """A rule's page as Markdown, with its condition and references."""
    references = "".join(f"- {reference}\n" for reference in rule.references)
    return (
        f"# {rule.name}\n\n{_head(rule)}\n\n{markdown(rule).rstrip()}\n\n"
        f"## Condition\n\nAbout each {rule.subject} (`msaa-lint facts` lists what may be asked):\n\n```\n{rule.when}\n```\n\n"
        f"## References\n\n{references}"
    )


def _print(rule: Rule, output: str) -> None:
    if output == "json":
        import json

        print(json.dumps({**_record(_info(rule)), "condition": rule.when, "page": page(rule)}, indent=2, ensure_ascii=False))
    elif output == "markdown" or not sys.stdout.isatty():
        print(page(rule))
    else:
        _show(page(rule))


def _print_info(info: RuleInfo, output: str) -> None:
    if output == "json":
        import json

        print(json.dumps(_record(info), indent=2, ensure_ascii=False))
    else:
        print(f"# {info.name}\n\n**{info.code}**, {info.severity}. {info.summary}")


def _show(text: str) -> None:
    import re

    from rich.console import Console
    from rich.markdown import Markdown

    # A terminal shows no fence: what kind of example it is, it must be told.
    told = re.sub(r"^```(yaml|json) (bad|fixed|good)\b.*$", r"*\2:*\n\n```\1", text, flags=re.MULTILINE)
    Console().print(Markdown(told))
