"""The figures of a run, and the sentences that state them."""

from collections import Counter
from collections.abc import Iterable
from operator import add
from typing import NamedTuple

from msaa_lint.core.finding import (
    CONFIDENCES,
    Finding,
    Price,
    Result,
    Saving,
    Savings,
    is_confident,
)
from msaa_lint.linter.settings.settings import COMMAND_LINE

from . import Options
from .counts import counts, missing, undecided_rules
from .escape import display
from .inputs import captured, checked, unread
from .words import plural as plural


class Tally(NamedTuple):
    """Counts of a run. `missing` has each missing fact with the number of rules that need it, the
    largest number first. `savings` are what fixes save of the inputs that they edit.
    """

    errors: int
    warnings: int
    notes: int
    files: int
    files_with_findings: int
    suppressed: int
    undecided: int
    undecided_rules: int
    missing: tuple[tuple[str, int], ...]
    savings: Savings

    @property
    def findings(self) -> int:
        return self.errors + self.warnings + self.notes

    @property
    def fixable(self) -> int:
        """The number of findings that `--fix --unsafe-fixes` removes."""
        return self.savings.all.findings


def tally(result: Result) -> Tally:
    """The counts of a run."""
    figures = counts(result)
    severities: Counter[str] = Counter()
    for (severity, _, _), number in figures.levels.items():
        severities[severity] += number
    return Tally(
        errors=severities["error"],
        warnings=severities["warning"],
        notes=severities["note"],
        files=len(figures.files.union(result.files) - {COMMAND_LINE}),
        files_with_findings=len(figures.files - {COMMAND_LINE}),
        suppressed=figures.numbers.get("suppressed", 0),
        undecided=figures.numbers.get("undecided", 0),
        undecided_rules=undecided_rules(figures),
        missing=tuple(missing(figures, "fact")),
        savings=files_saving(result),
    )


def summary(result: Result, options: Options) -> list[str]:
    """The lines that end a report: the findings, what fixes do about them, and what was not
    checked.
    """
    lines = (sentence(result, options), *fixable(result), summary_line(result, options))
    return [*(line for line in lines if line), *captured(result, options), *unread(result, options)]


def sentence(result: Result, options: Options) -> str:
    """One line: the findings, the number of files, what of them was checked, and what is
    suppressed.
    """
    count = tally(result)
    if count.findings:
        kinds = [
            plural(n, word)
            for n, word in (
                (count.errors, "error"),
                (count.warnings, "warning"),
                (count.notes, "note"),
            )
            if n
        ]
        files = plural(count.files, "file")
        if count.files_with_findings < count.files:
            files = f"{count.files_with_findings} of {files}"
        places = [files] if count.files_with_findings else []
        if any(finding.file == COMMAND_LINE for finding in result.findings):
            places.append("the command line")
        text = (
            f"Found {plural(count.findings, 'finding')} ({', '.join(kinds)}) in "
            f"{' and '.join(places)}"
        )
    else:
        text = f"No findings in {plural(count.files, 'file')}"
    if any(each.format for each in result.inputs):
        text += f" ({checked(result.inputs)})"
    unconfident = sum(
        not is_confident(finding, options.fail_confidence) for finding in result.findings
    )
    if unconfident:
        levels = " or ".join(CONFIDENCES[: CONFIDENCES.index(options.fail_confidence)])
        text += f"; {unconfident} of {levels} confidence, below --fail-confidence"
    if count.suppressed:
        text += f"; {count.suppressed} suppressed"
    return text


def summary_line(result: Result, options: Options) -> str:
    """`4 rules undecided, missing keys: images.*.usage (2), ...`; empty if none is."""
    figures = counts(result)
    rules = undecided_rules(figures)
    if not rules:
        return ""
    lacking = missing(figures, "key")
    keys = [f"{display(key)} ({count})" for key, count in lacking[: options.max_undecided]]
    if len(lacking) > options.max_undecided:
        keys.append(f"and {len(lacking) - options.max_undecided} more")
    text = f"{plural(rules, 'rule')} undecided" + (
        f", missing keys: {', '.join(keys)}" if keys else ""
    )
    return text if options.explain_undecided else f"{text}; --explain-undecided lists what to add"


def fixable(result: Result) -> list[str]:
    """How many findings fixes remove, and what that saves; empty if no finding has a fix that can
    be made.
    """
    files, converted = files_saving(result), converted_saving(result)
    lines = [
        *_fixable(files, "fixable with"),
        *_fixable(converted, "fixable in the description that `msaa-lint convert` writes, with"),
    ]
    for is_converted, first in ((False, ""), (True, "`msaa-lint convert`, then ")):
        count = list(result.untried.values()).count(is_converted)
        if count:
            verb = "is" if count == 1 else "are"
            lines.append(
                f"{plural(count, 'file')} {verb} too large to try fixes here; {first}`check "
                "--diff` tries them"
            )
    return lines


def _fixable(savings: Savings, words: str) -> list[str]:
    safe, everything = savings.safe, savings.all
    saves_more = everything.findings > safe.findings or everything.price not in (None, safe.price)
    options = [(everything, "--fix --unsafe-fixes")] if saves_more else []
    if safe.findings:
        options.insert(0, (safe, "--fix"))
    return [f"{saving.findings} {words} {option}{_saved(saving)}" for saving, option in options]


ON_TILER = " on a tile-based GPU"
"""After the price of what names no device."""


def _saved(saving: Saving) -> str:
    """`: saves 2248 MB/s written, 225 mW; adds 3 MiB of memory`; empty if there is no price or it
    is zero.
    """
    figures = figures_of(saving.price)
    saved = ", ".join(f"{_number(value)} {unit}" for value, unit in figures if value > 0)
    added = ", ".join(f"{_number(-value)} {unit}" for value, unit in figures if value < 0)
    text = "; ".join(
        f"{verb} {amounts}" for verb, amounts in (("saves", saved), ("adds", added)) if amounts
    )
    return f": {text}{ON_TILER if saving.assumes_tiler else ''}" if text else ""


def files_saving(result: Result) -> Savings:
    """What fixes save of the inputs that they edit. Files are separate frames, whose costs add
    up.
    """
    return _sum(savings for savings in result.savings.values() if not savings.converted)


def converted_saving(result: Result) -> Savings:
    """What fixes save of captures and source code, in the descriptions that they are converted
    to.
    """
    return _sum(savings for savings in result.savings.values() if savings.converted)


def _sum(savings: Iterable[Savings]) -> Savings:
    safe, everything = Saving(), Saving()
    for entry in savings:
        safe, everything = _both(safe, entry.safe), _both(everything, entry.all)
    return Savings(safe, everything)


def _both(one: Saving, other: Saving) -> Saving:
    price = one.price
    if other.price is not None and _is_usable(other.price):
        price = Price(*map(add, price or Price(0.0, 0.0, 0.0, 0.0), other.price))
    return Saving(one.findings + other.findings, price, one.assumes_tiler or other.assumes_tiler)


def usable_price(finding: Finding) -> Price | None:
    """The finding's price; None if a figure is out of range, which means nothing and cannot be
    written as JSON.
    """
    price = finding.price
    return price if price is not None and _is_usable(price) else None


def notes_of(finding: Finding) -> list[str]:
    """The notes of a finding, and what its price assumes, for outputs that have the figures
    alone.
    """
    return (
        [*finding.notes, f"the price is that{ON_TILER}"]
        if finding.assumes_tiler
        else [*finding.notes]
    )


def _is_usable(price: Price) -> bool:
    limit = 1e300
    return all(-limit < figure < limit for figure in price)


def price_text(finding: Finding) -> str:
    """`+2248 MB/s written, +31.6 MiB of memory`, `on a tile-based GPU` if no device is named; empty
    if there is no price or it is zero.

    The price of a choice begins with `if chosen: `, and has the signs of the change that it makes.
    """
    choice = is_choice(finding)
    figures = [
        (-value if choice else value, unit) for value, unit in figures_of(usable_price(finding))
    ]
    text = ", ".join(
        f"{'+' if value > 0 else ''}{_number(value)} {unit}" for value, unit in figures
    )
    text += ON_TILER if text and finding.assumes_tiler else ""
    return f"if chosen: {text}" if text and choice else text


def is_choice(finding: Finding) -> bool:
    """Whether the fix of a finding is a choice, whose price is no waste and part of no sum."""
    return finding.fix is not None and finding.fix.choice


def is_summed(finding: Finding) -> bool:
    """Whether the price of a finding counts: that of a choice, or of a fix that cannot be made, is
    nobody's saving.
    """
    return finding.fix is not None and not finding.fix.choice and not finding.fix.refusal


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
