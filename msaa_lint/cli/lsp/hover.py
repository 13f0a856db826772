"""What a key means, what a value costs, what an image moves, and what a rule says, at a place of a
text, in Markdown.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.cli.report.escape import display
from msaa_lint.cli.report.markdown import escape_markdown
from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.span import Span
from msaa_lint.frame.cost.amounts import Line, PassCost
from msaa_lint.frame.facts.table import FACTS
from msaa_lint.linter.rules.reference_links import rule_address
from msaa_lint.linter.rules.registry import markdown
from msaa_lint.linter.rules.rule import Rule

from .alternatives import alternative_costs
from .inlay_hints import figure
from .names import names_at
from .places import Place, content, place_at
from .setting_words import setting_at, without_links
from .shape_words import key_documentation, shape_words, value_documentation
from .traffic import costs_at, image_lines, moved, passes

if TYPE_CHECKING:
    from .view import View

_WORD = re.compile(r"[\w.-]+")
_CODE = re.compile(r"MSAA\d{3}\Z")
_COMMENT = re.compile(r"(?:#|//|/\*|<!--)[^\n]*msaa-lint[ \t]*:")

MAX_MISSING = 3
"""What a hover lists of what could not be counted."""


class Answer(NamedTuple):
    """Markdown about a place."""

    markdown: str
    span: Span


def hover(view: View, offset: int) -> Answer | None:
    """What there is to say about a place; None if nothing."""
    rule = _rule_at(view, offset)
    if rule is not None:
        return rule
    about = _description(view, offset) if view.kind == "description" else None
    if view.kind == "configuration":
        setting = setting_at(view.text, offset)
        about = Answer(*setting) if setting is not None else None
    findings = [
        found for found in view.findings if found.span is not None and _contains(found.span, offset)
    ]
    pages = [_page_of(view, found) for found in findings]
    if about is None and not pages:
        return None
    span = about.span if about is not None else findings[0].span
    assert span is not None
    parts = [about.markdown] if about is not None else []
    return Answer("\n\n---\n\n".join([*parts, *dict.fromkeys(pages)]), span)


def _contains(span: Span, offset: int) -> bool:
    return span.start <= offset < max(span.end, span.start + 1)


# Rules.


def _rule_at(view: View, offset: int) -> Answer | None:
    """The page of the rule, or the fact of rules, that is named at a place of a comment, a
    configuration or a rule page.
    """
    start = view.text.rfind("\n", 0, offset) + 1
    end = view.text.find("\n", offset)
    line = view.text[start : end if end >= 0 else len(view.text)]
    if view.kind in ("description", "code", "other") and not _COMMENT.search(line):
        return None
    for match in _WORD.finditer(line):
        if start + match.start() <= offset <= start + match.end():
            span = Span(start + match.start(), start + match.end())
            rule = next(
                (each for each in view.registry.rules if match[0] in (each.name, each.code)), None
            )
            if rule is not None:
                return Answer(_page(view, rule), span)
            info = next(
                (each for each in DIAGNOSTICS.values() if match[0] in (each.name, each.code)), None
            )
            if info is not None:
                return Answer(
                    f"**{info.name}** `{info.code}`, {info.severity}\n\n{info.summary}", span
                )
            fact = FACTS.get(match[0]) if view.kind == "rule" else None
            if fact is not None:
                return Answer(f"`{fact.name}`: {fact.type}\n\n{fact.doc}", span)
    return None


def _page(view: View, rule: Rule) -> str:
    """A rule's page, without relative links."""
    text = without_links(markdown(rule)).strip()
    address = rule_address(view.docs_url, rule.code, rule.name)
    name = f"[**{rule.name}**]({address})" if address else f"**{rule.name}**"
    return f"{name} `{rule.code}`, {rule.severity}, {rule.confidence} confidence\n\n{text}"


def _page_of(view: View, finding: Finding) -> str:
    rule = next((each for each in view.registry.rules if each.code == finding.code), None)
    if rule is not None:
        return _page(view, rule)
    return f"**{finding.rule}** `{finding.code}`\n\n{prose(finding.message)}"


# Descriptions.


def _description(view: View, offset: int) -> Answer | None:
    found = place_at(view.roots, offset)
    if found is None:
        return None
    place, in_key = found
    if in_key and place.key is not None:
        span = content(view.text, place.key)
        parts = _about_key(view, place)
    elif place.node.kind == "scalar" and place.parent is not None:
        span = content(view.text, place.node)
        parts = _about_value(view, place)
    else:
        return None
    parts = [part for part in (*parts, *_about_name(view, offset)) if part]
    return Answer("\n\n".join(parts), span) if parts else None


def _about_key(view: View, place: Place) -> list[str]:
    """What a member means and may hold; the cost of a pass or an attachment."""
    parts = []
    if place.record is not None and place.shape[0] != "unknown":
        documentation = key_documentation(place.record, place.path[-1])
        parts = [documentation, f"Value: {shape_words(place.stated)}"]
    assert place.key is not None
    return [*parts, *_about_part(view, place.key.start)]


def _about_value(view: View, place: Place) -> list[str]:
    """What a value means, and what the frame costs with it and with others."""
    member = next((each for each in place.ancestors if each.record is not None), place)
    parts = [value_documentation(place), _alternatives_table(view, place, member)]
    if any(parts) or member.record is None or member.shape[0] == "unknown":
        return parts
    return [key_documentation(member.record, member.path[-1])]


def _alternatives_table(view: View, place: Place, member: Place) -> str:
    """What the frame costs with this value and with others."""
    costs = costs_at(view, place.node.start)
    if costs is None or member.record is None:
        return ""
    found = alternative_costs(costs, member, place)
    if found is None:
        return ""
    written = costs.written.total
    lines = ["| value | MB/s | mW | MiB |", "| --- | ---: | ---: | ---: |"]
    rows = [
        (f"{code(found.value)} as written", written, True),
        *((code(value), total, False) for value, total in found.others),
    ]
    for title, total, is_written in rows:
        figures = [
            figure(total.traffic_mb_per_s),
            figure(total.milliwatts),
            figure(total.memory_mib),
        ]
        if not is_written:
            before = (written.traffic_mb_per_s, written.milliwatts, written.memory_mib)
            after = (total.traffic_mb_per_s, total.milliwatts, total.memory_mib)
            figures = [_with_difference(new, old) for new, old in zip(after, before, strict=True)]
        lines.append(f"| {title} | {' | '.join(figures)} |")
    own = moved(_lines_at(costs.written.passes, place), costs.written)
    moves = f"Moves {figure(own.total)} MB/s, {figure(own.milliwatts)} mW.\n\n" if own.total else ""
    missing = [prose(text) for text in costs.written.unknown[:MAX_MISSING]]
    unknown = f"\n\nNot counted: {'; '.join(missing)}." if missing else ""
    return (
        f"{moves}Cost of the whole frame with this value and with others:\n\n"
        + "\n".join(lines)
        + unknown
    )


def _with_difference(new: float, old: float) -> str:
    change = new - old
    return (
        f"{figure(new)} ({'+' if change > 0 else '−'}{figure(abs(change))})"
        if abs(change) >= 0.005
        else figure(new)
    )


def _lines_at(costs: Iterable[PassCost], place: Place) -> Iterator[Line]:
    """What the value at a place moves."""
    for each in costs:
        yield from (line for line in each.lines if line.place == place.node.span)


def _about_part(view: View, start: int) -> list[str]:
    """What the pass or the attachment moves whose key is at a place."""
    costs = costs_at(view, start)
    if costs is None or costs.is_expanded:
        return []
    for each in passes(costs):
        if each.head.start == start:
            cost, written = each.cost, costs.written
            rows = [
                f"| {code(line.attachment)} | {line.aspect} | {line.action} | {line.samples} | "
                f"{figure(moved([line], written).total)} |"
                for line in cost.lines
            ]
            total = (
                f"{figure(cost.amount.traffic_mb_per_s)} MB/s, {figure(cost.amount.milliwatts)} mW"
            )
            head = (
                "| attachment | aspect | action | samples | MB/s |\n| --- | --- | --- | ---: | "
                "---: |\n"
            )
            table = [head + "\n".join(rows)] if rows else []
            missing = [f"Not counted: {prose(text)}." for text in cost.unknown]
            return [f"This pass moves {total}.", *table, *missing]
        for head_at, _, lines in each.attachments:
            if head_at.start == start:
                whole = moved(lines, costs.written)
                parts = [
                    f"{line.action} {line.aspect} {figure(moved([line], costs.written).total)} MB/s"
                    for line in lines
                ]
                said = (
                    ": " + ", ".join(parts)
                    if len(parts) > 1
                    else f", by its {lines[0].action}"
                    if parts
                    else ""
                )
                return [
                    f"This attachment moves {figure(whole.total)} MB/s, {figure(whole.milliwatts)} "
                    f"mW{said}."
                ]
    return []


def _about_name(view: View, offset: int) -> list[str]:
    """The traffic of the image that is named at a place, over the frame."""
    image = next(
        (
            name
            for name in names_at(view.names, view.text, offset)
            if name.section in ("images", "metal.textures")
        ),
        None,
    )
    costs = costs_at(view, offset)
    if image is None or costs is None:
        return []
    cost = costs.written
    lines = list(image_lines(cost, image.text))
    total = moved((line for _, line in lines), cost)
    memory = next((each for each in cost.images if each.name == image.text), None)
    size = ""
    if memory is not None and memory.committed is not None:
        lazily = memory.bytes is not None and memory.committed < memory.bytes
        size = f"; {figure(memory.committed / 2**20)} MiB of memory" + (
            f" of {figure((memory.bytes or 0) / 2**20)} MiB" if lazily else ""
        )
    traffic = (
        f"{figure(total.read)} MB/s read, {figure(total.write)} MB/s written, "
        f"{figure(total.milliwatts)} mW"
    )
    said = f"Image {code(image.text)}: {traffic}{size}."
    if not lines:
        return [said]
    rows = [
        f"| {code(name)} | {line.aspect} | {line.action} | {figure(moved([line], cost).total)} | "
        f"{figure(moved([line], cost).milliwatts)} |"
        for name, line in lines
    ]
    return [
        said
        + "\n\n| pass | aspect | action | MB/s | mW |\n| --- | --- | --- | ---: | ---: |\n"
        + "\n".join(rows)
    ]


def code(text: str) -> str:
    """A text of an input as it is, also in a cell of a table: in backquotes, or escaped if it has
    characters that end them or the cell.
    """
    shown = display(text)
    return escape_markdown(shown) if not shown or "`" in shown or "|" in shown else f"`{shown}`"


def prose(text: str) -> str:
    """A sentence with texts of an input in it, some of them in backquotes, so that it is shown as
    it is.
    """
    parts = display(text).split("`")
    if len(parts) % 2 == 0:
        return escape_markdown("`".join(parts))
    return "".join(code(part) if n % 2 else escape_markdown(part) for n, part in enumerate(parts))
