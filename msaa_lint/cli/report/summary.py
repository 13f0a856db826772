"""The figures of a run, and the sentences that give them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import CONFIDENCES, is_confident

from .escape import shown

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Price, Result

    from . import Options


class Tally(NamedTuple):
    """Counts of a run. `missing` is each missing fact with the number of rules that lacked it, most first."""

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


def tally(result: Result) -> Tally:
    severities = [finding.severity for finding in result.findings]
    edits = [finding.fix.safe for finding in result.findings if finding.fix and finding.fix.edits]
    lacking: dict[str, set[str]] = {}
    for entry in result.undecided:
        for fact in entry.missing:
            lacking.setdefault(fact, set()).add(entry.code)
    missing = sorted(((fact, len(codes)) for fact, codes in lacking.items()), key=lambda item: (-item[1], item[0]))
    with_findings = {finding.file for finding in result.findings}
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


def sentence(result: Result, options: Options) -> str:
    """One line: what was found, where, what was silenced and what stayed undecided for lack of which facts."""
    count = tally(result)
    if count.findings:
        kinds = [plural(n, word) for n, word in ((count.errors, "error"), (count.warnings, "warning"), (count.notes, "note")) if n]
        within = plural(count.files, "file")
        if count.files_with_findings < count.files:
            within = f"{count.files_with_findings} of {within}"
        text = f"Found {plural(count.findings, 'finding')} ({', '.join(kinds)}) in {within}"
    else:
        text = f"No findings in {plural(count.files, 'file')}"
    unsure = sum(not is_confident(found, options.fail_confidence) for found in result.findings)
    if unsure:
        below = " or ".join(CONFIDENCES[: CONFIDENCES.index(options.fail_confidence)])
        text += f"; {unsure} of {below} confidence, below --fail-confidence"
    if count.suppressed:
        text += f"; {count.suppressed} suppressed"
    reasons = undecided(count, options)
    return f"{text}; {reasons}" if reasons else text


def undecided(count: Tally, options: Options) -> str:
    """`4 rules undecided for lack of: image.usage (2), ...`; empty where none is."""
    if not count.undecided_rules:
        return ""
    named = [f"{shown(fact)} ({n})" for fact, n in count.missing[: options.max_undecided]]
    if len(count.missing) > options.max_undecided:
        named.append(f"and {len(count.missing) - options.max_undecided} more")
    return f"{plural(count.undecided_rules, 'rule')} undecided for lack of: {', '.join(named)}"


def fixable(result: Result) -> str:
    """`3 with a fix, 2 of them safe: --fix makes the safe ones, ...`; empty where nothing has one."""
    count = tally(result)
    fixes = count.safe_fixes + count.unsafe_fixes
    if not fixes:
        return ""
    how = {0: "--fix --unsafe-fixes makes them", fixes: "--fix makes them"}
    both = "--fix makes the safe ones, with --unsafe-fixes all"
    return f"{fixes} with a fix, {count.safe_fixes} of them safe: {how.get(count.safe_fixes, both)}"


def price_of_all(result: Result) -> str:
    """`CombinedPrice they cost 2248 MB/s written, ...`; empty where nothing has a price."""
    figures = figures_of(together(result))
    return f"Together they cost {', '.join(f'{_size(value)} {unit}' for value, unit in figures)}" if figures else ""


def together(result: Result) -> Price | None:
    """What all findings of a run cost together: those of one file are worked out together, files are frames of their own."""
    every = [price for price in result.together.values() if _usable(price)]
    if not every:
        return None
    # A price is a tuple of four: Price itself is not needed here to make one.
    return type(every[0])(*(sum(column) for column in zip(*every, strict=True)))


def plural(n: int, word: str) -> str:
    return f"{n} {word}" if n == 1 else f"{n} {word}s"


def usable_price(finding: Finding) -> Price | None:
    """The finding's price, or None where a figure went out of range: such a price says nothing and JSON cannot hold it."""
    price = finding.price
    return price if price is not None and _usable(price) else None


def _usable(price: Price) -> bool:
    limit = 1e300
    return all(-limit < figure < limit for figure in price)


def cost(finding: Finding) -> str:
    """`+2248 MB/s written, +31.6 MiB of memory`; empty where there is no price or it is nothing."""
    return ", ".join(f"{'+' if value > 0 else ''}{_size(value)} {unit}" for value, unit in figures_of(usable_price(finding)))


def figures_of(price: Price | None) -> list[tuple[float, str]]:
    """The figures of a price that are not nothing, with their units."""
    if price is None:
        return []
    figures = (
        (price.write_mb_per_s, "MB/s written"),
        (price.read_mb_per_s, "MB/s read"),
        (price.memory_mib, "MiB of memory"),
        (price.milliwatts, "mW"),
    )
    return [(value, unit) for value, unit in figures if value]


def _size(value: float) -> str:
    return f"{value:.0f}" if 100 <= abs(value) < 1e7 else f"{value:.3g}"
