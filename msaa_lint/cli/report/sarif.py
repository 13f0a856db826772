"""SARIF 2.1.0 within the limits of GitHub's code scanning."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from msaa_lint.core.finding import RuleInfo, rank

from .data import dump, write_list
from .escape import clip, shown, whole
from .fingerprint import fingerprints
from .paths import uri
from .place import place
from .summary import tally, together, undecided, usable_price

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Fix, Result, Suppressed
    from msaa_lint.core.text.span import Span

    from . import Options, Write

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

MOST_RESULTS = 25_000
MOST_LOCATIONS = 1_000
MOST_LINKS = 10
LONGEST_DESCRIPTION = 1024
LONGEST_NAME = 255

_PROBLEM = {"error": "error", "warning": "warning", "note": "recommendation"}
_KIND = {"inline": "inSource", "baseline": "external"}
_FAMILY = {
    "1": "sample-counts",
    "2": "load-store",
    "3": "resolve",
    "4": "memory",
    "5": "shading",
    "6": "synchronization",
    "7": "numbers",
    "8": "source",
    "9": "input",
}
_SEMANTIC_VERSION = re.compile(r"\d+\.\d+\.\d+(-[0-9A-Za-z.-]+)?(\+[0-9A-Za-z.-]+)?")
_LINK = re.compile(r"https://[!-~]+")


def render(result: Result, out: Write, options: Options) -> None:
    """Prints one run. Silenced findings are in it only with `show_suppressed`."""
    pairs: list[tuple[Finding, Suppressed | None]] = [(finding, None) for finding in result.findings]
    if options.show_suppressed:
        pairs += [(entry.finding, entry) for entry in result.suppressed]
    names = fingerprints((finding for finding, _ in pairs), options.root)
    rules = _rules(result, [finding for finding, _ in pairs])
    index = {rule.code: n for n, rule in enumerate(rules)}
    numbered = list(zip(pairs, names, strict=True))
    kept = _worst(numbered)
    driver: dict[str, object] = {"name": "msaa-lint"}
    if options.version:
        key = "semanticVersion" if _SEMANTIC_VERSION.fullmatch(options.version) else "version"
        driver[key] = options.version
    out(f'{{\n"$schema": {dump(SCHEMA)},\n"version": "2.1.0",\n"runs": [{{\n')
    out(f'"tool": {{"driver": {{{dump(driver)[1:-1]}, "rules": ')
    write_list(map(_descriptor, rules), out)
    out("}},\n")
    if options.sarif_category:
        out(f'"automationDetails": {dump({"id": f"msaa-lint/{whole(options.sarif_category)}/"})},\n')
    out('"columnKind": "unicodeCodePoints",\n')
    out(f'"invocations": [{dump(_invocation(result, options, len(numbered) - len(kept)))}],\n"results": ')
    write_list((_result(finding, entry, name, index, result, options) for (finding, entry), name in kept), out)
    price = together(result)
    if price:
        out(f',\n"properties": {dump({"price": price._asdict()})}')
    out("\n}]\n}\n")


def _worst(
    numbered: list[tuple[tuple[Finding, Suppressed | None], str]],
) -> list[tuple[tuple[Finding, Suppressed | None], str]]:
    """As many as one run may hold, the least severe left out first, in the order given."""
    if len(numbered) <= MOST_RESULTS:
        return numbered
    order = sorted(range(len(numbered)), key=lambda n: (numbered[n][0][1] is not None, -rank(numbered[n][0][0].severity), n))
    return [numbered[n] for n in sorted(order[:MOST_RESULTS])]


def _rules(result: Result, findings: Sequence[Finding]) -> list[RuleInfo]:
    """The enabled rules and those of the findings that no page describes (9xx), by code."""
    rules = {rule.code: rule for rule in result.rules}
    for finding in findings:
        if finding.code not in rules:
            rules[finding.code] = RuleInfo(finding.code, finding.rule, finding.severity, finding.confidence, "")
    return [rules[code] for code in sorted(rules)]


def _descriptor(rule: RuleInfo) -> dict[str, object]:
    summary = shown(rule.summary) or shown(rule.name).replace("-", " ").capitalize() or shown(rule.code)
    links = [reference for reference in rule.references if _LINK.fullmatch(reference)]
    page = whole(rule.markdown.strip()) or summary
    seen = "\n".join(f"- {whole(reference)}" for reference in rule.references if reference not in page)
    tags = ["msaa", "vulkan", *_family(rule)]
    made: dict[str, object] = {
        "id": shown(rule.code),
        "name": clip(shown(rule.name), LONGEST_NAME) or shown(rule.code),
        "shortDescription": {"text": clip(summary, LONGEST_DESCRIPTION)},
        "fullDescription": {"text": clip(summary, LONGEST_DESCRIPTION)},
        # GitHub shows no helpUri, so the links are in the page too.
        "help": {"text": page, "markdown": f"{page}\n\nReferences:\n\n{seen}" if seen else page},
        "defaultConfiguration": {"level": rule.severity},
        "properties": {
            "precision": rule.confidence,
            "problem.severity": _PROBLEM[rule.severity],
            "tags": tags,
        },
    }
    if links:
        made["helpUri"] = links[0]
    return made


def _family(rule: RuleInfo) -> list[str]:
    found = re.fullmatch(r"MSAA(\d)\d\d", rule.code)
    return [_FAMILY[found[1]]] if found and found[1] in _FAMILY else []


def _invocation(result: Result, options: Options, left_out: int) -> dict[str, object]:
    notifications = []
    if left_out:
        text = f"{left_out} results of the lowest severity are left out: code scanning takes at most {MOST_RESULTS}."
        notifications.append({"level": "warning", "message": {"text": text}})
    reasons = undecided(tally(result), options)
    if reasons:
        notifications.append({"level": "note", "message": {"text": _linkless(f"{reasons}.")}})
    made: dict[str, object] = {"executionSuccessful": not any(finding.fatal for finding in result.findings)}
    if notifications:
        made["toolExecutionNotifications"] = notifications
    return made


def _result(
    finding: Finding, entry: Suppressed | None, name: str, index: dict[str, int], result: Result, options: Options
) -> dict[str, object]:
    artifact = {"uri": uri(finding.file, options.root)}
    region = _region(result, finding.file, finding.span)
    # Without all four GitHub refuses the file, an input without text or not.
    location: dict[str, object] = {
        "physicalLocation": {
            "artifactLocation": artifact,
            "region": region or {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1},
        }
    }
    if finding.subject:
        location["logicalLocations"] = [{"fullyQualifiedName": whole(clip(finding.subject))}]
    labels = _labels(finding, result)
    related = [
        {"id": n, "physicalLocation": {"artifactLocation": artifact, "region": region}, "message": {"text": text}}
        for n, (text, region) in enumerate(labels, 1)
    ]
    properties: dict[str, object] = {"confidence": finding.confidence}
    price = usable_price(finding)
    if price:
        properties["price"] = price._asdict()
    if finding.notes:
        properties["notes"] = [shown(note) for note in finding.notes]
    made: dict[str, object] = {
        "ruleId": shown(finding.code),
        "ruleIndex": index[finding.code],
        # Code scanning fails a pull request on an error, which what is not sure must not do.
        "level": "warning" if finding.confidence == "low" and finding.severity == "error" else finding.severity,
        "message": {"text": _message(finding, [text for text, _ in labels])},
        "locations": [location],
        "partialFingerprints": {"msaaLint/v1": name},
        "properties": properties,
    }
    if related:
        made["relatedLocations"] = related
    fixes = list(_fix(finding.fix, finding.file, artifact, result)) if finding.fix else []
    if fixes:
        made["fixes"] = fixes
    if options.show_suppressed:
        made["suppressions"] = []
        if entry:
            reason = {"justification": shown(entry.reason)} if entry.reason.strip() else {}
            made["suppressions"] = [{"kind": _KIND[entry.how], **reason}]
    return made


def _labels(finding: Finding, result: Result) -> list[tuple[str, dict[str, int]]]:
    """What the labels say, and where, but for those at the finding's own place."""
    apart = [label for label in finding.labels if label.span != finding.span][:MOST_LOCATIONS]
    placed = [(_linkless(shown(label.text)), _region(result, finding.file, label.span)) for label in apart]
    return [(text, region) for text, region in placed if region]


def _message(finding: Finding, labels: list[str]) -> str:
    """The message as a sentence of its own, which GitHub takes for the title; then the labels, as links, and what helps."""
    parts = [_linkless(shown(finding.message))]
    parts += [_linkless(shown(label.text)) for label in finding.labels[:MOST_LINKS] if label.span == finding.span]
    for n, text in enumerate(labels[:MOST_LINKS], 1):
        if text:
            escaped = text.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]")
            parts.append(f"[{escaped}]({n})")
    parts.append(_linkless(shown(finding.help)))
    return " ".join(part if part.endswith((".", "!", "?")) else part + "." for part in parts if part)


def _linkless(text: str) -> str:
    """`text` without an embedded link (SARIF 3.11.6)."""
    return text.replace("](", "] (")


def _region(result: Result, file: str, span: Span | None) -> dict[str, int] | None:
    at = place(result, file, span)
    if at is None:
        return None
    return {"startLine": at.line, "startColumn": at.column, "endLine": at.end_line, "endColumn": at.end_column}


def _fix(fix: Fix, file: str, artifact: dict[str, str], result: Result) -> Iterator[dict[str, object]]:
    replacements = []
    for edit in fix.edits:
        region = _region(result, file, edit.span)
        if region is None:
            return
        replacements.append({"deletedRegion": region, "insertedContent": {"text": whole(edit.text)}})
    if replacements:
        yield {
            "description": {"text": shown(fix.title) or "Fix"},
            "artifactChanges": [{"artifactLocation": artifact, "replacements": replacements}],
            "properties": {"safe": fix.safe},
        }
