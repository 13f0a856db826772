"""The page of `msaa-lint check`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cache
from typing import Any, NamedTuple

from markdown_it import MarkdownIt
from markupsafe import Markup

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding, Price, Result, RuleInfo, rank
from msaa_lint.core.text.source import Source
from msaa_lint.frame.cost.input_cost import CostedFrame
from msaa_lint.linter.rules.reference_links import link, rule_address

from .. import Options, Write
from ..color import SECONDARY, SEVERITY
from ..concise import line, location
from ..cost_rows import figure
from ..escape import display, escape_lines
from ..excerpt import Mark, excerpt_rows
from ..full import elsewhere, marks, remarks
from ..paths import display_path
from ..place import place
from ..summary import (
    ON_TILER,
    converted_saving,
    files_saving,
    is_choice,
    summary,
    tally,
    usable_price,
)
from ..undecided import explanation
from ..words import plural
from .diff import DiffLine, fix_diff
from .frames import frame_section
from .page import write_page

MAX_CARDS = 1000
"""Findings with excerpt, remarks, and diff: the most severe ones, of these the ones that cost
most.
"""

MAX_FINDINGS = 10_000
"""Findings in the page at all; those without a card have a line."""

MAX_FRAMES = 20
"""Frames with a graph and a waterfall."""

MAX_INPUTS = 1000

_WIDTH = 110
_STYLES = {**{style: severity for severity, style in SEVERITY.items()}, SECONDARY: "secondary"}


class Excerpt(NamedTuple):
    """The lines of a file, in pieces with their classes."""

    place: str
    lines: list[list[tuple[str, str]]]


class Card(NamedTuple):
    """A finding as the page shows it. `milliwatts` is what the page sorts and filters by, `page`
    the fragment of its rule's page; without `full` it has no details.
    """

    id: str
    finding: Finding
    place: str
    input: int
    milliwatts: str
    price: str
    page: str
    url: str
    full: bool
    excerpts: list[Excerpt]
    remarks: list[tuple[str, str]]
    diff: list[DiffLine]


class Group(NamedTuple):
    """The findings of a pass, or of another object, of an input."""

    name: str
    cards: list[Card]


def render(
    result: Result, out: Write, options: Options, frames: Sequence[CostedFrame] = ()
) -> None:
    """Writes the findings with their excerpts and fixes, and the graphs and waterfalls of the
    frames.
    """
    cards = _cards(result, options)
    anchors = _anchors(cards)
    frames = [frame for frame in frames if frame.cost.passes]
    shown = sorted(frames, key=_saving, reverse=True)[:MAX_FRAMES]
    context = {
        "title": _title(result, options),
        "tiles": _tiles(result),
        "summary": summary(result, options),
        "inputs": _inputs(result, options),
        "more_inputs": max(len(result.inputs) - MAX_INPUTS, 0),
        "frames": [frame_section(frame, options, _of_frame(frame, anchors)) for frame in shown],
        "more_frames": _more_frames(frames),
        "files": _by_file(cards, frames, options),
        "shown": len(cards),
        "left_out": _left_out(len(result.findings)),
        "filters": _filters(result, cards, options),
        "rules": _rules(result, cards, options),
        "undecided": list(explanation(result, options)) if options.explain_undecided else [],
        "suppressed": [
            line(entry.finding, result, options) for entry in result.suppressed[:MAX_CARDS]
        ]
        if options.show_suppressed
        else [],
    }
    write_page("check.html", context, out)


def _saving(frame: CostedFrame) -> tuple[float, float]:
    """What fixes save of a frame, by which the page sorts: the milliwatts, and the memory."""
    if frame.fixed is None:
        return (0.0, 0.0)
    before, after = frame.cost.total, frame.fixed.total
    return (before.milliwatts - after.milliwatts, before.memory_mib - after.memory_mib)


def _title(result: Result, options: Options) -> str:
    if len(result.files) == 1:
        return f"Multisampling in {display_path(result.files[0], options.root)}"
    return f"Multisampling in {plural(len(result.files), 'input')}"


def _tiles(result: Result) -> list[tuple[str, str, str, str]]:
    count = tally(result)
    tiles = [
        (str(n), "", word if n == 1 else word + "s", word if n else "")
        for n, word in ((count.errors, "error"), (count.warnings, "warning"), (count.notes, "note"))
    ]
    savings = [
        saving.all
        for saving in (files_saving(result), converted_saving(result))
        if saving.all.findings
    ]
    prices = [saving.price for saving in savings if saving.price is not None]
    if prices:
        total = Price(*(sum(column) for column in zip(*prices, strict=True)))
        label = "saved by fixes" + (
            ON_TILER if any(saving.assumes_tiler for saving in savings) else ""
        )
        tiles.append((figure(total.read_mb_per_s + total.write_mb_per_s, 0), "MB/s", label, "good"))
        tiles.append((figure(total.milliwatts, 0), "mW", label, "good"))
    if savings:
        tiles.append(
            (
                str(sum(saving.findings for saving in savings)),
                "",
                "findings that fixes remove",
                "good",
            )
        )
    return tiles


def _inputs(result: Result, options: Options) -> list[dict[str, Any]]:
    counts: dict[str, int] = {}
    for finding in result.findings:
        counts[finding.file] = counts.get(finding.file, 0) + 1
    return [
        {
            "file": display_path(each.file, options.root),
            "format": each.format or ("not read" if each.failed else ""),
            "figures": [
                each.images,
                each.passes,
                each.pipelines,
                each.shaders,
                counts.get(each.file, 0),
            ],
        }
        for each in result.inputs[:MAX_INPUTS]
    ]


def _cards(result: Result, options: Options) -> list[Card]:
    """The findings that the page has, in the order of the result."""
    order = sorted(
        range(len(result.findings)), key=lambda number: _importance(result.findings[number])
    )
    full = set(order[:MAX_CARDS])
    numbers = {
        file: number
        for number, file in enumerate(dict.fromkeys(finding.file for finding in result.findings))
    }
    rules = {rule.name for rule in result.rules}
    return [
        _card(number, result.findings[number], numbers, number in full, result, options, rules)
        for number in sorted(order[:MAX_FINDINGS])
    ]


def _importance(finding: Finding) -> tuple[int, float]:
    return (-rank(finding.severity), -_milliwatts(finding))


def _milliwatts(finding: Finding) -> float:
    price = usable_price(finding)
    return price.milliwatts if price is not None and not is_choice(finding) else 0.0


def _card(
    number: int,
    finding: Finding,
    inputs: Mapping[str, int],
    full: bool,
    result: Result,
    options: Options,
    rules: Set[str],
) -> Card:
    lines = remarks(finding, rules) if full else []
    price = next((text for word, text in remarks(finding, rules) if word in ("cost", "price")), "")
    source = result.sources.get(finding.file)
    edits = finding.fix.edits if finding.fix is not None else ()
    return Card(
        id=f"finding-{number + 1}",
        finding=finding,
        place=location(finding, result, options),
        input=inputs[finding.file],
        milliwatts=f"{_milliwatts(finding):.6g}",
        price=price,
        page=_rule_anchor(finding.rule) if finding.rule in rules else "",
        url=rule_address(options.docs_url, finding.code, finding.rule),
        full=full,
        excerpts=list(_excerpts(finding, result, options)) if full else [],
        remarks=[(word, text) for word, text in lines[1:] if word not in ("cost", "price", "docs")],
        diff=fix_diff(source, edits)
        if full and edits and source is not None and source.origins is None
        else [],
    )


def _excerpts(finding: Finding, result: Result, options: Options) -> Iterator[Excerpt]:
    """The lines of the finding, then those of other files that its labels are in."""
    source = result.sources.get(finding.file)
    if source is not None and finding.span is not None:
        yield _excerpt("", source, marks(finding))
    for file, labels in elsewhere(finding).items():
        other, at = result.sources.get(file), place(result, file, labels[0].span)
        if other is not None and at is not None:
            places = [Mark(*label.span, display(label.text), SECONDARY, False) for label in labels]
            yield _excerpt(
                f"{display_path(file, options.root)}:{at.line}:{at.column}", other, places
            )


def _excerpt(at: str, source: Source, places: Sequence[Mark]) -> Excerpt:
    _, rows = excerpt_rows(source, places, _WIDTH)
    return Excerpt(at, [[(_STYLES.get(style, ""), text) for text, style in row] for row in rows])


_SECTION = re.compile(r"(?:documents\[(\d+)\]\.)?(\w+)(?:\.([^.\[]+)|\[(\d+)\])?")
_NOUNS = {
    "renderPasses": "render pass",
    "images": "image",
    "pipelines": "pipeline",
    "framebuffers": "framebuffer",
    "commands": "command",
}


def _by_file(
    cards: Sequence[Card], frames: Sequence[CostedFrame], options: Options
) -> list[tuple[str, list[Group]]]:
    """The findings by input, and there by pass or other object."""
    names = {
        (frame.file, frame.number, each.path): each.name
        for frame in frames
        for each in frame.cost.passes
    }
    files: dict[str, dict[str, list[Card]]] = {}
    for card in cards:
        files.setdefault(card.finding.file, {}).setdefault(
            _subject(card.finding, names), []
        ).append(card)
    return [
        (display_path(file, options.root), [Group(name, group) for name, group in groups.items()])
        for file, groups in files.items()
    ]


def _subject(finding: Finding, names: Mapping[tuple[str, int, str], str]) -> str:
    """What a finding is about, in words: the pass if its subject is part of one."""
    found = _SECTION.match(finding.subject)
    if found is None or not finding.subject:
        return "The input"
    document, section, name, index = found.groups()
    document = document if document is not None and len(document) < 9 else None
    number = f", document {int(document) + 1}" if document is not None else ""
    path = ".".join(finding.subject.split(".")[: 2 if document is None else 3][-2:])
    known = names.get((finding.file, int(document or 0), path))
    if section == "commands" and known:
        return f"pass {known}{number}"
    return f"{_NOUNS.get(section, section)} {name or index or ''}".rstrip() + number


def _anchors(cards: Sequence[Card]) -> dict[tuple[str, str, str], str]:
    """The fragments of findings by file, code, and subject."""
    return {
        (card.finding.file, card.finding.code, card.finding.subject): card.id
        for card in reversed(cards)
    }


def _of_frame(frame: CostedFrame, anchors: Mapping[tuple[str, str, str], str]) -> dict[int, str]:
    findings = [step.finding for step in frame.fix_steps]
    keys = {id(finding): (finding.file, finding.code, finding.subject) for finding in findings}
    return {identity: anchors[key] for identity, key in keys.items() if key in anchors}


def _more_frames(frames: Sequence[CostedFrame]) -> str:
    left = len(frames) - MAX_FRAMES
    return (
        f"{left} of {len(frames)} frames are not drawn, those of which fixes save least; "
        "`msaa-lint cost` shows them."
        if left > 0
        else ""
    )


def _left_out(count: int) -> str:
    texts = []
    if count > MAX_CARDS:
        texts.append(
            f"{MAX_CARDS} findings have details: the most severe ones, of these the ones that cost "
            "most."
        )
    if count > MAX_FINDINGS:
        texts.append(
            f"{count - MAX_FINDINGS} of {count} findings are not on this page; --output json has "
            "all."
        )
    return " ".join(texts)


def _filters(result: Result, cards: Sequence[Card], options: Options) -> dict[str, Any]:
    """The choices of the filters, of what the findings have."""
    findings = [card.finding for card in cards]
    severities, confidences = (
        {finding.severity for finding in findings},
        {finding.confidence for finding in findings},
    )
    return {
        "severities": [each for each in reversed(SEVERITIES) if each in severities],
        "confidences": [each for each in reversed(CONFIDENCES) if each in confidences],
        "rules": sorted({finding.rule for finding in findings}),
        "inputs": [
            (number, display_path(file, options.root))
            for number, file in enumerate(dict.fromkeys(f.file for f in findings))
        ],
    }


def _rules(result: Result, cards: Sequence[Card], options: Options) -> list[dict[str, Any]]:
    """The pages of the rules that have findings."""
    found = {card.finding.rule for card in cards}
    return [
        {
            "rule": rule,
            "anchor": _rule_anchor(rule.name),
            "url": rule_address(options.docs_url, rule.code, rule.name),
            "page": _page(rule),
            "references": [(text, link(text)) for text in rule.references],
        }
        for rule in sorted(result.rules, key=lambda rule: rule.name)
        if rule.name in found
    ]


def _rule_anchor(name: str) -> str:
    """The fragment of a rule's page; names of rules have no other characters."""
    return "rule-" + re.sub("[^a-z0-9-]", "", name)


def _page(rule: RuleInfo) -> Markup:
    """A rule's page as HTML: without raw HTML, and without links, which would be relative to the
    page's own folder, or a stranger's.
    """
    markdown = _markdown()
    tokens = markdown.parse(escape_lines(rule.markdown))
    for token in tokens:
        if token.type.startswith("heading"):
            token.tag = "h3"
    return Markup(markdown.renderer.render(tokens, markdown.options, {}))


@cache
def _markdown() -> MarkdownIt:
    return (
        MarkdownIt("commonmark", {"html": False})
        .enable("table")
        .disable(["link", "image", "autolink", "reference", "html_inline"])
    )
