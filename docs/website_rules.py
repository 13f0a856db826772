"""The pages of rules on the site: what a rule page states, what its first example costs, and the
list of rules with filters.
"""

from __future__ import annotations

import html
import json
import re
from pathlib import Path
from typing import NamedTuple

import jinja2

from msaa_lint.cli import report
from msaa_lint.cli.report.html.frames import graph_section
from msaa_lint.cli.report.summary import is_choice, price_text
from msaa_lint.cli.rule import FAMILIES as FAMILY_NAMES
from msaa_lint.core.finding import Finding
from msaa_lint.frame.cost.amounts import Terms
from msaa_lint.frame.cost.graph import frame_graph
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.linter.engine import Engine, LintOptions
from msaa_lint.linter.results import DocumentResult
from msaa_lint.linter.rules.reference_links import link
from msaa_lint.linter.rules.registry import folder, load, markdown
from msaa_lint.linter.rules.rule import Rule

__all__ = ["FAMILY_NAMES", "RULES", "picture_style", "rule_list", "rule_page"]

_REGISTRY = load()
_ENGINE = Engine(_REGISTRY)
RULES = _REGISTRY.rules

_HTML = Path(report.__file__).parent / "html"
_FIGURE = jinja2.Environment(
    loader=jinja2.FileSystemLoader(_HTML / "templates"), autoescape=True
).from_string('{% import "frame.html" as parts %}{{ parts.graph(section) }}')
_BAD = re.compile(r"^```(?:yaml|json) bad\b[^\n]*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_FRAME = "frame: {width: 1920, height: 1080, fps: 60}\n"
_SAFETY = {
    "safe": "safe: `--fix`",
    "unsafe": "unsafe: `--fix --unsafe-fixes`",
    "shown": "shown, not applied",
}


class Example(NamedTuple):
    """An example of a mistake, a finding of the rule in it, its document, and whether it states the
    frame's size.
    """

    text: str
    finding: Finding
    document: DocumentResult
    states_frame: bool


def example(rule: Rule) -> Example | None:
    """The first example of a description that the rule has a finding in; one with a price before
    one without.
    """
    found: Example | None = None
    for text in _BAD.findall(markdown(rule)):
        states_frame = "frame:" in text
        result = _ENGINE.lint(
            (text if states_frame else _FRAME + text).encode(),
            f"{folder()}/{rule.name}.yaml",
            LintOptions(_severity, prices=True),
        )
        for finding in result.findings:
            if finding.rule == rule.name and (found is None or price_text(finding)):
                found = Example(text, finding, result.documents[0], states_frame)
        if found is not None and price_text(found.finding):
            break
    return found


def _severity(rule: object, suggested: str, vendor: str | None) -> str:
    return suggested


def rule_page(rule: Rule) -> str:
    """The page of a rule."""
    apis = " and ".join({"vulkan": "Vulkan", "metal": "Metal"}[api] for api in rule.apis)
    facts = {
        "code": rule.code,
        "severity": rule.severity,
        "confidence": rule.confidence,
        "API": apis,
        "subject": rule.subject,
    }
    cells = [" | ".join(facts), " | ".join("---" for _ in facts), " | ".join(facts.values())]
    table = "".join(f"| {row} |\n" for row in cells)
    head = (
        f"---\ntitle: {json.dumps(rule.name)}\ndescription: {json.dumps(rule.summary)}\n---\n\n"
        f"# {rule.name}\n\n"
    )
    shown = example(rule)
    return (
        f"{head}{table}\n{_fixes(rule)}{_price(rule, shown)}\n"
        f"{frame_picture(shown) if shown is not None else ''}"
        f"{markdown(rule).rstrip()}\n\n{_references(rule)}"
    )


def _fixes(rule: Rule) -> str:
    """The fixes, each with how it is applied; one that is safe in some cases only has several
    ways.
    """
    ways: dict[str, list[str]] = {}
    for fix in rule.fix_specs:
        title = re.sub(r"`?\{[^{}]*\}`?", "…", fix.title)
        ways.setdefault(title, []).append(_SAFETY[fix.safety])
    return "".join(
        f"Fix: {title} ({', or '.join(safeties)}).\n\n" for title, safeties in ways.items()
    )


def _price(rule: Rule, shown: Example | None) -> str:
    """What an example costs, in words."""
    price = price_text(shown.finding) if shown is not None else ""
    if shown is None or not price:
        reason = (
            "it makes a frame wrong or invalid, or what it costs depends on the device or the "
            "shaders"
        )
        return f'!!! note "Price"\n\n    The cost model puts no figure on this mistake: {reason}.\n'
    where = (
        "with the frame that it states"
        if shown.states_frame
        else "in a frame of 1920x1080 pixels at 60 Hz"
    )
    which = "The first example" if shown.text in _BAD.findall(markdown(rule))[:1] else "An example"
    clause = f"{which} costs **{price}** {where}"
    if is_choice(shown.finding):
        clause = (
            f"The fix of {which[0].lower()}{which[1:]} changes the cost by "
            f"**{price.removeprefix('if chosen: ')}** {where}"
        )
    return (
        f'!!! warning "Price"\n\n    {clause}, by the [cost model](../docs/cost.md),'
        " at 100 mW per GB/s unless its device states another figure.\n"
    )


def frame_picture(shown: Example) -> str:
    """The passes, images, and resolves of an example, and the bytes between them; empty for one
    whose frame has none.
    """
    frame = Frame(shown.document.document)
    cost = frame_cost(frame, shown.document.device, Terms())
    graph = frame_graph(frame, cost)
    if not any(each.flows for each in graph.passes):
        return ""
    figure = _FIGURE.render(section=graph_section(graph, cost.fps, "as written"))
    # Python-Markdown ends HTML at an empty line.
    lines = [line for line in figure.splitlines() if line.strip()]
    return "\n".join([*lines, "\n"])


def _references(rule: Rule) -> str:
    lines = [
        f"- [{_brackets(each)}]({address})" if (address := link(each)) else f"- {each}"
        for each in rule.references
    ]
    return "## References\n\n" + "\n".join(lines) + "\n"


def _brackets(text: str) -> str:
    return text.replace("[", "\\[").replace("]", "\\]")


def picture_style() -> str:
    """The rules of the HTML report's style that are about graphs."""
    rules = re.findall(
        r"^\.(?:graph|box|life|flow|key)\b[^{\n]*\{[^}\n]*\}$",
        (_HTML / "style.css").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    return "\n".join(rules) + "\n"


def rule_list() -> str:
    """The list of rules, with filters by severity, fix, and API that need no script."""
    filters = {
        "severity": [("error", "errors"), ("warning", "warnings"), ("note", "notes")],
        "fix": [("safe", "safe fixes"), ("other", "other fixes"), ("none", "no fix")],
        "API": [("vulkan", "Vulkan"), ("metal", "Metal")],
    }
    boxes = "".join(
        f"<fieldset><legend>{name}</legend>{''.join(_box(name, value, label) for value, label in values)}</fieldset>\n"
        for name, values in filters.items()
    )
    rows = "".join(_row(rule) for rule in RULES)
    return (
        "# Rules\n\n"
        f"{len(RULES)} rules. A rule's page has its reasons, with numbers and their source, its "
        "examples, and the price of its mistake; "
        "`msaa-lint rule NAME` prints it. [Custom rules](../docs/configuration.md#custom-rules) "
        "are pages of the same form.\n\n"
        f'<form class="rule-filters" autocomplete="off">\n{boxes}</form>\n\n'
        '<table class="rules">\n'
        "<thead><tr><th>Code</th><th>Rule</th><th>Severity</th><th>Fix</th></tr></thead>\n"
        f"<tbody>\n{rows}</tbody>\n</table>\n"
    )


def _box(name: str, value: str, label: str) -> str:
    return f'<label><input type="checkbox" class="{name.lower()}-{value}" checked> {label}</label>'


def _row(rule: Rule) -> str:
    safeties = {fix.safety for fix in rule.fix_specs}
    fix = "safe" if "safe" in safeties else "other" if safeties else "none"
    words = {"safe": "safe", "other": "unsafe" if "unsafe" in safeties else "shown", "none": ""}[
        fix
    ]
    apis = " ".join(f"api-{api}" for api in rule.apis)
    return (
        f'<tr class="severity-{rule.severity} fix-{fix} {apis}"><td>{rule.code}</td>'
        f'<td><a href="{rule.name}/">{rule.name}</a><br>{html.escape(rule.summary)}</td><td>{rule.severity}</td><td>{words}</td></tr>\n'
    )
