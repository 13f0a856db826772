"""SARIF 2.1.0 within the limits of GitHub's code scanning."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import islice

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import Finding, Fix, InputSummary, Result, RuleInfo, Suppressed, rank
from msaa_lint.core.text.span import Span
from msaa_lint.linter.rules.reference_links import link, rule_address

from . import Options, Write
from .data import dump, write_list
from .escape import clip, display, escape_lines, escape_surrogates
from .fingerprint import fingerprints
from .inputs import checked
from .paths import uri
from .place import place
from .summary import files_saving, is_choice, notes_of, summary_line, usable_price

SCHEMA = (
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
)

MAX_RESULTS = 25_000
MAX_LOCATIONS = 1_000
MAX_LINKS = 10
MAX_DESCRIPTION = 1024
MAX_NAME = 255
MAX_UNREAD = 100

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


_Pair = tuple[Finding, Suppressed | None]


def render(result: Result, out: Write, options: Options) -> None:
    """Prints one run, with suppressed findings only if `show_suppressed` is true."""
    rules = _rules(result, (finding for finding, _ in _pairs(result, options)))
    index = {rule.code: n for n, rule in enumerate(rules)}
    levels = Counter(map(_level, _pairs(result, options)))
    driver: dict[str, object] = {"name": "msaa-lint"}
    if options.version:
        key = "semanticVersion" if _SEMANTIC_VERSION.fullmatch(options.version) else "version"
        driver[key] = options.version
    out(f'{{\n"$schema": {dump(SCHEMA)},\n"version": "2.1.0",\n"runs": [{{\n')
    out(f'"tool": {{"driver": {{{dump(driver)[1:-1]}, "rules": ')
    write_list((_descriptor(rule, options) for rule in rules), out)
    out("}},\n")
    out('"columnKind": "unicodeCodePoints",\n')
    out(
        '"invocations": '
        f"[{dump(_invocation(result, options, max(levels.total() - MAX_RESULTS, 0)))}],\n"
        '"results": '
    )
    write_list(
        (
            _result(*pair, name, index, result, options)
            for pair, name in _most_severe(result, options, levels)
        ),
        out,
    )
    price = files_saving(result).all.price
    if price:
        out(f',\n"properties": {dump({"price": price._asdict()})}')
    out("\n}]\n}\n")


def _pairs(result: Result, options: Options) -> Iterator[_Pair]:
    """The findings to print, with how they are suppressed."""
    yield from ((finding, None) for finding in result.findings)
    if options.show_suppressed:
        yield from ((entry.finding, entry) for entry in result.suppressed)


def _level(pair: _Pair) -> tuple[bool, int]:
    """A key that sorts findings from the most severe one."""
    finding, entry = pair
    return (entry is not None, -rank(finding.severity))


def _most_severe(
    result: Result, options: Options, levels: Counter[tuple[bool, int]]
) -> Iterator[tuple[_Pair, str]]:
    """As many as one run can hold, leaving out the least severe, in their order, with their
    fingerprints. `levels` counts them.
    """
    room, left = {}, MAX_RESULTS
    for level, count in sorted(levels.items()):
        room[level] = min(count, left)
        left -= room[level]
    names = fingerprints((finding for finding, _ in _pairs(result, options)), options.root)
    for pair, name in zip(_pairs(result, options), names, strict=True):
        level = _level(pair)
        if room[level]:
            room[level] -= 1
            yield pair, name


def _rules(result: Result, findings: Iterable[Finding]) -> list[RuleInfo]:
    """The enabled rules and the diagnostics (9xx) among the findings, by code."""
    rules = {rule.code: rule for rule in result.rules}
    for finding in findings:
        unlisted = RuleInfo(finding.code, finding.rule, finding.severity, finding.confidence, "")
        rules.setdefault(finding.code, DIAGNOSTICS.get(finding.code, unlisted))
    return [rules[code] for code in sorted(rules)]


def _descriptor(rule: RuleInfo, options: Options) -> dict[str, object]:
    summary = (
        display(rule.summary)
        or display(rule.name).replace("-", " ").capitalize()
        or display(rule.code)
    )
    page = escape_lines(rule.markdown.strip()) or summary
    address = rule_address(options.docs_url, rule.code, rule.name)
    links = [(display(reference), link(reference)) for reference in rule.references]
    listed = [
        _linked(reference, page_address)
        for reference, page_address in links
        if reference not in page
    ]
    references = "\n".join(
        f"- {text}" for text in [*([f"[Documentation]({address})"] if address else []), *listed]
    )
    tags = ["msaa", "vulkan", *_family(rule)]
    descriptor: dict[str, object] = {
        "id": display(rule.code),
        "name": clip(display(rule.name), MAX_NAME) or display(rule.code),
        "shortDescription": {"text": clip(summary, MAX_DESCRIPTION)},
        "fullDescription": {"text": clip(summary, MAX_DESCRIPTION)},
        # GitHub does not show helpUri, so the links are in the page, too.
        "help": {
            "text": page,
            "markdown": f"{page}\n\nReferences:\n\n{references}" if references else page,
        },
        "defaultConfiguration": {"level": rule.severity},
        "properties": {
            "precision": rule.confidence,
            "problem.severity": _PROBLEM[rule.severity],
            "tags": tags,
        },
    }
    help_uri = next(filter(None, [address, *(page_address for _, page_address in links)]), "")
    if help_uri:
        descriptor["helpUri"] = help_uri
    return descriptor


def _linked(reference: str, address: str) -> str:
    """A reference in Markdown, as a link if it has an address that it does not state."""
    return (
        f"[{_bracketless(reference)}]({address})"
        if address and address not in reference
        else reference
    )


def _family(rule: RuleInfo) -> list[str]:
    match = re.fullmatch(r"MSAA(\d)\d\d", rule.code)
    return [_FAMILY[match[1]]] if match and match[1] in _FAMILY else []


def _unread(entry: InputSummary, result: Result, options: Options) -> dict[str, object]:
    """A notification about an input that shows no pass to check."""
    assert entry.unread is not None
    region = _region(result, entry.file, entry.unread.span)
    location: dict[str, object] = {"artifactLocation": {"uri": uri(entry.file, options.root)}}
    return {
        "level": "warning",
        "message": {"text": _linkless(display(entry.unread.message))},
        "locations": [{"physicalLocation": location | ({"region": region} if region else {})}],
    }


def _invocation(result: Result, options: Options, left_out: int) -> dict[str, object]:
    notifications: list[dict[str, object]] = []
    if left_out:
        text = (
            f"{left_out} results of the lowest severity are left out: code scanning accepts at "
            f"most {MAX_RESULTS}."
        )
        notifications.append({"level": "warning", "message": {"text": text}})
    reasons = summary_line(result, options._replace(explain_undecided=True))
    if reasons:
        notifications.append({"level": "note", "message": {"text": _linkless(f"{reasons}.")}})
    if any(each.format for each in result.inputs):
        notifications.append(
            {"level": "note", "message": {"text": f"Checked {checked(result.inputs)}."}}
        )
    unread = (each for each in result.inputs if each.unread is not None)
    notifications += [_unread(entry, result, options) for entry in islice(unread, MAX_UNREAD)]
    invocation: dict[str, object] = {
        "executionSuccessful": not any(finding.fatal for finding in result.findings)
    }
    if notifications:
        invocation["toolExecutionNotifications"] = notifications
    return invocation


def _result(
    finding: Finding,
    entry: Suppressed | None,
    name: str,
    index: dict[str, int],
    result: Result,
    options: Options,
) -> dict[str, object]:
    artifact = {"uri": uri(finding.file, options.root)}
    region = _region(result, finding.file, finding.span)
    # GitHub rejects a file without all four, even for an input without text.
    location: dict[str, object] = {
        "physicalLocation": {
            "artifactLocation": artifact,
            "region": region or {"startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 1},
        }
    }
    if finding.subject:
        location["logicalLocations"] = [
            {"fullyQualifiedName": escape_surrogates(clip(finding.subject))}
        ]
    labels = _labels(finding, result)
    related = [
        {
            "id": n,
            "physicalLocation": {
                "artifactLocation": {"uri": uri(file, options.root)},
                "region": region,
            },
            "message": {"text": text},
        }
        for n, (text, file, region) in enumerate(labels, 1)
    ]
    properties: dict[str, object] = {"confidence": finding.confidence}
    price = usable_price(finding)
    if price:
        properties["price"] = price._asdict()
    if is_choice(finding):
        properties["choice"] = True
    notes = notes_of(finding)
    if notes:
        properties["notes"] = [display(note) for note in notes]
    sarif: dict[str, object] = {
        "ruleId": display(finding.code),
        "ruleIndex": index[finding.code],
        # Code scanning fails a pull request on an error, which an uncertain finding must not do.
        "level": "warning"
        if finding.confidence == "low" and finding.severity == "error"
        else finding.severity,
        "message": {"text": _message(finding, [text for text, _, _ in labels])},
        "locations": [location],
        "partialFingerprints": {"msaaLint/v1": name},
        "properties": properties,
    }
    if related:
        sarif["relatedLocations"] = related
    fixes = list(_fix(finding.fix, finding.file, artifact, result)) if finding.fix else []
    if fixes:
        sarif["fixes"] = fixes
    if result.has_baseline and not finding.fatal and (entry is None or entry.how == "baseline"):
        sarif["baselineState"] = "unchanged" if entry else "new"
    if options.show_suppressed:
        sarif["suppressions"] = []
        if entry:
            reason = {"justification": display(entry.reason)} if entry.reason.strip() else {}
            sarif["suppressions"] = [{"kind": _KIND[entry.how], **reason}]
    return sarif


def _labels(finding: Finding, result: Result) -> list[tuple[str, str, dict[str, int]]]:
    """The texts, files, and regions of the labels, except those at the finding's own span."""
    labels = [
        label for label in finding.labels if label.file is not None or label.span != finding.span
    ][:MAX_LOCATIONS]
    files = [label.file or finding.file for label in labels]
    placed = [
        (_linkless(display(label.text)), file, _region(result, file, label.span))
        for label, file in zip(labels, files, strict=True)
    ]
    return [(text, file, region) for text, file, region in placed if region]


def _message(finding: Finding, labels: list[str]) -> str:
    """The message as the first sentence, which GitHub uses as the title, then the labels, as links,
    and the help text.
    """
    parts = [_linkless(display(finding.message))]
    parts += [
        _linkless(display(label.text))
        for label in finding.labels[:MAX_LINKS]
        if label.file is None and label.span == finding.span
    ]
    for n, text in enumerate(labels[:MAX_LINKS], 1):
        if text:
            parts.append(f"[{_bracketless(text)}]({n})")
    parts.append(_linkless(display(finding.help)))
    return " ".join(
        part if part.endswith((".", "!", "?")) else part + "." for part in parts if part
    )


def _bracketless(text: str) -> str:
    """`text` for the brackets of a link."""
    return text.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]")


def _linkless(text: str) -> str:
    """`text` without embedded links (SARIF 3.11.6)."""
    return text.replace("](", "] (")


def _region(result: Result, file: str, span: Span | None) -> dict[str, int] | None:
    at = place(result, file, span)
    if at is None:
        return None
    return {
        "startLine": at.line,
        "startColumn": at.column,
        "endLine": at.end_line,
        "endColumn": at.end_column,
    }


def _fix(
    fix: Fix, file: str, artifact: dict[str, str], result: Result
) -> Iterator[dict[str, object]]:
    replacements = []
    for edit in fix.edits:
        region = _region(result, file, edit.span)
        if region is None:
            return
        replacements.append(
            {"deletedRegion": region, "insertedContent": {"text": escape_surrogates(edit.text)}}
        )
    if replacements:
        yield {
            "description": {"text": display(fix.title) or "Fix"},
            "artifactChanges": [{"artifactLocation": artifact, "replacements": replacements}],
            "properties": {"safe": fix.safe},
        }
