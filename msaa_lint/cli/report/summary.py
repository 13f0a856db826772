"""The figures of a run, and the sentences that state them."""

from typing import NamedTuple

from msaa_lint.core.finding import CONFIDENCES, Finding, Price, Result, is_confident
from msaa_lint.linter.settings.settings import COMMAND_LINE

from . import Options
from .escape import display
from .inputs import checked, unread
from .words import plural as plural


class Tally(NamedTuple):
    """Counts of a run. `missing` has each missing fact with the number of rules that need it, the largest number first."""

    errors: int
    warnings: int
    notes: int
    safe_fixes: int
    unsafe_fixes: int
    files: int
    files_with_findings: int
    suppressed: int
    undecided: int
    undecided_rules: int
    missing: tuple[tuple[str, int], ...]

    @property
    def findings(self) -> int:
        return self.errors + self.warnings + self.notes

    @property
    def fixable(self) -> int:
        return self.safe_fixes + self.unsafe_fixes


def tally(result: Result) -> Tally:
    """The counts of a run."""
    severities = [finding.severity for finding in result.findings]
    edits = [finding.fix.safe for finding in result.findings if finding.fix and finding.fix.edits]
    rules_by_fact: dict[str, set[str]] = {}
    for entry in result.undecided:
        for fact in entry.missing:
            rules_by_fact.setdefault(fact, set()).add(entry.code)
    missing = sorted(((fact, len(codes)) for fact, codes in rules_by_fact.items()), key=lambda item: (-item[1], item[0]))
    with_findings = {finding.file for finding in result.findings} - {COMMAND_LINE}
    return Tally(
        errors=severities.count("error"),
        warnings=severities.count("warning"),
        notes=severities.count("note"),
        safe_fixes=edits.count(True),
        unsafe_fixes=edits.count(False),
        files=len(with_findings.union(result.files)),
        files_with_findings=len(with_findings),
        suppressed=len(result.suppressed),
        undecided=len(result.undecided),
        undecided_rules=len({entry.code for entry in result.undecided}),
        missing=tuple(missing),
    )


def summary(result: Result, options: Options) -> list[str]:
    """The lines that end a report: the findings, what they cost together, how many have a fix, and what was not checked."""
    lines = (sentence(result, options), total_price(result), fixable(result), undecided(tally(result), options))
    return [*(line for line in lines if line), *unread(result, options)]


def sentence(result: Result, options: Options) -> str:
    """One line: the findings, the number of files, what of them was checked, and what is suppressed."""
    count = tally(result)
    if count.findings:
        kinds = [plural(n, word) for n, word in ((count.errors, "error"), (count.warnings, "warning"), (count.notes, "note")) if n]
        files = plural(count.files, "file")
        if count.files_with_findings < count.files:
            files = f"{count.files_with_findings} of {files}"
        places = [files] if count.files_with_findings else []
        if any(finding.file == COMMAND_LINE for finding in result.findings):
            places.append("the command line")
        text = f"Found {plural(count.findings, 'finding')} ({', '.join(kinds)}) in {' and '.join(places)}"
    else:
        text = f"No findings in {plural(count.files, 'file')}"
    if any(each.format for each in result.inputs):
        text += f" ({checked(result.inputs)})"
    unconfident = sum(not is_confident(finding, options.fail_confidence) for finding in result.findings)
    if unconfident:
        levels = " or ".join(CONFIDENCES[: CONFIDENCES.index(options.fail_confidence)])
        text += f"; {unconfident} of {levels} confidence, below --fail-confidence"
    if count.suppressed:
        text += f"; {count.suppressed} suppressed"
    return text


def undecided(count: Tally, options: Options) -> str:
    """`4 rules undecided, missing facts: image.usage (2), ...`; empty if none is."""
    if not count.undecided_rules:
        return ""
    facts = [f"{display(fact)} ({n})" for fact, n in count.missing[: options.max_undecided]]
    if len(count.missing) > options.max_undecided:
        facts.append(f"and {len(count.missing) - options.max_undecided} more")
    return f"{plural(count.undecided_rules, 'rule')} undecided, missing facts: {', '.join(facts)}"


def fixable(result: Result) -> str:
    """`3 fixable: 2 with --fix, 1 more with --unsafe-fixes`; empty if no finding has a fix with edits."""
    count = tally(result)
    safe, unsafe = count.safe_fixes, count.unsafe_fixes
    if not unsafe:
        return f"{safe} fixable with --fix" if safe else ""
    if not safe:
        return f"{unsafe} fixable with --fix --unsafe-fixes"
    return f"{count.fixable} fixable: {safe} with --fix, {unsafe} more with --unsafe-fixes"


def total_price(result: Result) -> str:
    """`Fixing all of them saves 2248 MB/s written, ...`; empty if no finding has a price."""
    subject = "it" if len(result.findings) == 1 else "all of them"
    figures = figures_of(together(result))
    return f"Fixing {subject} saves {', '.join(f'{_number(value)} {unit}' for value, unit in figures)}" if figures else ""


def together(result: Result) -> Price | None:
    """What all findings of a run cost together. Those of one file share costs; files are separate frames, whose costs add up."""
    prices = [price for price in result.together.values() if _is_usable(price)]
    return Price(*(sum(column) for column in zip(*prices, strict=True))) if prices else None


def usable_price(finding: Finding) -> Price | None:
    """The finding's price; None if a figure is out of range, which means nothing and cannot be written as JSON."""
    price = finding.price
    return price if price is not None and _is_usable(price) else None


def _is_usable(price: Price) -> bool:
    limit = 1e300
    return all(-limit < figure < limit for figure in price)


def price_text(finding: Finding) -> str:
    """`+2248 MB/s written, +31.6 MiB of memory`; empty if there is no price or it is zero."""
    return ", ".join(f"{'+' if value > 0 else ''}{_number(value)} {unit}" for value, unit in figures_of(usable_price(finding)))


def figures_of(price: Price | None) -> list[tuple[float, str]]:
    """The nonzero figures of a price, with their units."""
    if price is None:
        return []
    figures = (
        (price.write_mb_per_s, "MB/s written"),
        (price.read_mb_per_s, "MB/s read"),
        (price.memory_mib, "MiB of memory"),
        (price.milliwatts, "mW"),
    )
    return [(value, unit) for value, unit in figures if value]


def _number(value: float) -> str:
    return f"{value:.0f}" if 100 <= abs(value) < 1e7 else f"{value:.3g}"
