"""A whole run: inputs found, each linted under the settings that govern it, one result.

The command line and `msaa_lint.lint` are both this.
"""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import gc
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding, Price, Result, RuleInfo, Suppressed, Undecided, is_confident, rank
from msaa_lint.core.text.source import Source, Unreadable
from msaa_lint.core.text.tree import Limits
from msaa_lint.frame.profiles import Problem, device_of, profile_of
from msaa_lint.input import opening as inputs
from msaa_lint.input.discovery import STDIN, discover
from msaa_lint.input.readers import looks_like

from .engine import Engine, LintOptions, load_rules, rule_infos
from .results import CombinedPrice, FileResult
from .rules.registry import EDITIONS, Registry
from .settings import config
from .settings.selection import Selection
from .settings.selectors import unknown_selectors
from .settings.settings import Settings, override

if TYPE_CHECKING:
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.source_file import SourceFile

    from .fixes.file_fixes import FixedText

Progress = Callable[[int, int, str], None]
"""Told how many of how many inputs are done, and the next one's name."""


PRICED = frozenset({"full", "json", "sarif", "markdown", "statistics"})
"""The outputs that show what findings cost; others need not wait for it."""

GARBAGE = 200_000
"""Containers made and not yet freed since the last collection, from which one is due: the command line turns the collector off, and the
passes of a frame and their attachments refer to each other."""


class Request(NamedTuple):
    """What a run is asked for. `overrides` are keyword arguments of `settings.override`; `data` stands in for standard input.

    `formats` are the outputs that will be printed, in place of those that settings name, and `fallback` where neither is stated: findings
    are priced where one of them shows it. `by_price` puts the dearest first. `fix` is `write`, to mend files, or `show`, to say how; with
    `unsafe_fixes` by fixes that may change the picture too. Standard input is never written to.
    """

    paths: Sequence[str]
    overrides: Mapping[str, Any] = {}
    config: str | None = None
    isolated: bool = False
    ignores: bool = True
    format: str | None = None
    stdin_filename: str | None = None
    data: bytes | None = None
    full_rules: bool = False
    without_baseline: bool = False
    formats: Sequence[str] = ()
    fallback: str = "json"
    by_price: bool = False
    fix: str | None = None
    unsafe_fixes: bool = False


class Outcome(NamedTuple):
    """A run's result, the settings that govern the current folder (its outputs and thresholds), lines for the standard error stream, what
    fixes made of inputs, and by file what the findings cost together that are sure enough to fail the run."""

    result: Result
    settings: Settings
    notes: Sequence[str]
    mended: "Sequence[FixedText]" = ()
    charged: Mapping[str, Price] = {}


class ResolvedSettings(NamedTuple):
    """Settings made ready: the rules that are on under them, and the engine that has them."""

    settings: Settings
    selection: Selection
    engine: Engine


class Run:
    """One run. What is the same for many inputs is made once."""

    def __init__(self, request: Request) -> None:
        self.request = request
        self.findings: list[Finding] = []
        self.undecided: list[Undecided] = []
        self.suppressed: list[Suppressed] = []
        self.sources: dict[str, Source] = {}
        self.priced: dict[str, CombinedPrice] = {}
        self.charged: dict[str, CombinedPrice] = {}
        self._settings: dict[str | None, Settings] = {}
        self._governed: dict[str | None, ResolvedSettings] = {}
        self._catalogues: dict[tuple[str, ...], Registry] = {}
        self._engines: dict[tuple[str, ...], Engine] = {}
        self.prices = False
        self.mended: list[FixedText] = []
        self.notes: list[str] = []

    def settings(self, path: str) -> Settings:
        """The settings that govern a file or folder; what is wrong with their configuration is a finding, once."""
        loaded = config.load(path, self.request.config, self.request.isolated)
        if loaded.path not in self._settings:
            self.findings.extend(loaded.findings)
            self.sources.update(loaded.sources)
            settings = override(loaded.settings, **self.request.overrides)
            self.findings.extend(_unusable(settings))
            self._settings[loaded.path] = settings
        return self._settings[loaded.path]

    def governed(self, path: str) -> ResolvedSettings:
        """The settings and rules for a file."""
        settings = self.settings(path)
        key = config.load(path, self.request.config, self.request.isolated).path
        if key not in self._governed:
            catalogue = self._catalogue(settings)
            self.findings.extend(unknown_selectors(settings, [*catalogue.rules]))
            selection = Selection(settings, catalogue.rules)
            self._governed[key] = ResolvedSettings(settings, selection, self._engines[settings.rules])
        return self._governed[key]

    def _catalogue(self, settings: Settings) -> Registry:
        if settings.rules not in self._catalogues:
            made = load_rules([path for path in settings.rules if os.path.exists(path)])
            self.findings.extend(made.problems)
            self.sources.update(made.sources)
            self._catalogues[settings.rules] = made
            self._engines[settings.rules] = Engine(made)
        return self._catalogues[settings.rules]

    def lint(self, path: str) -> None:
        """Lints one input and keeps what it gave."""
        stdin = path == STDIN
        name = (self.request.stdin_filename or "<stdin>") if stdin else path
        governed = self.governed(self.request.stdin_filename or os.curdir if stdin else path)
        limits = Limits(**{**Limits()._asdict(), **governed.settings.limits})
        try:
            data = inputs.load(path, limits, name, self.request.format, self.request.data)
        except (OSError, Unreadable) as error:
            self.findings.append(inputs.refused(error, name))
            return
        device = device_of(governed.settings.profile)
        severity = governed.selection.for_file(name, device.vendor if device is not None else None)

        options = LintOptions(severity, limits, self.request.format, device, self.request.ignores)

        def judge(data: "bytes | CaptureInput | SourceFile", prices: bool = False) -> FileResult:
            return governed.engine.lint(data, name, options._replace(prices=prices))

        linted = judge(data, self.prices)
        if not isinstance(data, bytes):
            self.notes.extend(data.notes)
            if self.request.fix is not None:
                kind = "source code" if data.source.origins is None else "a capture"
                self.notes.append(f"{name} is {kind}, and stays as it is: `msaa-lint convert` writes a description of it that can be fixed")
                if stdin and linted.is_code:
                    self.mended.append(_as_it_is(data, linted))
        elif self.request.fix is not None and (stdin or any(found.fix is not None for found in linted.findings)):
            from .fixes.file_fixes import fix_input

            write = self.request.fix == "write"
            target = path if write and not stdin else None
            made = fix_input(data, linted, judge, self._wanted(linted, governed), self.request.unsafe_fixes, target)
            self.mended.append(made)
            if made.write_error:
                self.findings.append(diagnostic("MSAA921", f"the fixed text cannot be written: {made.write_error}", name))
            elif write and made.changed:
                linted = judge(made.data, self.prices) if self.prices else made.result
        self._keep(linted, governed)

    def _wanted(self, linted: FileResult, governed: ResolvedSettings) -> Callable[[Finding], bool]:
        """Whether a finding is to be fixed: what is not shown, or counted in the baseline, is left alone."""
        here = self.settings(os.curdir)
        least = rank(here.min_severity)
        kept: Iterable[Finding] = linted.findings
        if here.baseline is not None and not self.request.without_baseline:
            from .suppress import baseline

            loaded = baseline.load(here.baseline)
            if not isinstance(loaded, baseline.Refused):
                kept = baseline.apply(linted.findings, loaded, [linted.file]).kept
        rules = {found.rule for found in kept} | {"unused-suppression"}
        settle = governed.selection.settle
        return lambda found: found.rule in rules and rank(found.severity) >= least and settle(found) is not None

    def _keep(self, linted: FileResult, governed: ResolvedSettings) -> None:
        if linted.source is not None and (linted.findings or linted.suppressed):
            self.sources[linted.file] = linted.source
        settled = [found for found in map(governed.selection.settle, linted.findings) if found is not None]
        self.findings.extend(settled)
        if linted.combined_price is not None:
            self.priced[linted.file] = self._together(linted.combined_price, settled)
            here = self.settings(os.curdir)
            if here.fail_on_cost is not None:
                certain = [found for found in settled if is_confident(found, here.fail_confidence)]
                self.charged[linted.file] = self._together(linted.combined_price, certain)
        self.undecided.extend(linted.undecided)
        self.suppressed.extend(linted.suppressed)

    def _together(self, together: CombinedPrice, findings: Sequence[Finding]) -> CombinedPrice:
        """What works out what findings cost together: done at once, so that documents need not be kept, unless a baseline takes some."""
        here = self.settings(os.curdir)
        if here.baseline is not None:
            return together
        least = rank(here.min_severity)
        price = together([found for found in findings if rank(found.severity) >= least])
        return lambda _: price


def run(request: Request, progress: Progress | None = None) -> Outcome:
    """Lints all that a request names. Nothing raises for what an input, a page or a configuration holds: that is a finding."""
    this = Run(request)
    here = this.governed(os.curdir)
    formats = request.formats or _names(here.settings.output) or [request.fallback]
    this.prices = request.by_price or here.settings.fail_on_cost is not None or not PRICED.isdisjoint(formats)
    found = discover(request.paths, this.settings, looks_like, sources=True)
    this.findings.extend(found.findings)
    for number, path in enumerate(found.files):
        if progress is not None:
            progress(number, len(found.files), path)
        this.lint(path)
        if gc.get_count()[0] > GARBAGE:
            gc.collect()
    files = [request.stdin_filename or "<stdin>" if path == STDIN else path for path in found.files]
    notes = [*found.notes, *this.notes]
    if here.settings.baseline is not None and not request.without_baseline:
        _baseline(this, here, files, notes)
    # After the baseline, which counts what is not shown as well.
    least = rank(here.settings.min_severity)
    this.findings[:] = [found for found in this.findings if found.fatal or rank(found.severity) >= least]
    order = {file: number for number, file in enumerate(files)}
    this.findings.sort(key=lambda f: (order.get(f.file, -1), f.file))
    severity = here.selection.for_file(os.curdir)
    rules: list[RuleInfo] = rule_infos(here.engine.registry, severity, request.full_rules)
    findings = _once(this.findings)
    together = _together(this.priced, findings)
    charged = together
    if here.settings.fail_on_cost is not None:
        charged = _together(this.charged, [found for found in findings if is_confident(found, here.settings.fail_confidence)])
    if request.by_price:
        findings.sort(key=_dearest)
    result = Result(findings, this.undecided, this.suppressed, files, this.sources, rules, together)
    return Outcome(result, here.settings, notes, this.mended, charged)


def _as_it_is(data: "CaptureInput | SourceFile", linted: FileResult) -> "FixedText":
    """Source code from standard input, which is not mended: whoever asks for the mended text gets it back."""
    from msaa_lint.input.source_file import SourceFile

    from .fixes.file_fixes import FixedText

    assert isinstance(data, SourceFile)
    text = data.source.text
    return FixedText(linted.file, text, text, data.data, linted)


def _baseline(this: Run, here: ResolvedSettings, files: list[str], notes: list[str]) -> None:
    from .suppress import baseline

    assert here.settings.baseline is not None
    loaded = baseline.load(here.settings.baseline)
    if isinstance(loaded, baseline.Refused):
        this.findings.extend(loaded.findings)
        this.sources.update(loaded.sources)
        return
    applied = baseline.apply(this.findings, loaded, files, here.selection.names())
    this.findings[:] = applied.kept
    this.suppressed.extend(applied.suppressed)
    notes.extend(str(stale) for stale in applied.stale)


def _unusable(settings: Settings) -> list[Finding]:
    """Words of the settings that mean nothing: an edition, a profile, paths of rules that are not there."""

    found = []
    if settings.fail_on_cost is not None:
        from .settings.cost_limit import budget

        try:
            budget(settings.fail_on_cost)
        except ValueError as error:
            found.append(settings.wrong("fail-on-cost", f"`{settings.fail_on_cost[:40]}` is no price", str(error)))
    if settings.edition is not None and settings.edition not in EDITIONS:
        found.append(settings.wrong("edition", f"no edition `{settings.edition[:40]}`", f"there is {', '.join(EDITIONS)}"))
    unknown = profile_of(settings.profile) if settings.profile is not None else None
    if isinstance(unknown, Problem):
        found.append(settings.wrong("profile", unknown.message, unknown.help))
    missing = [path for path in settings.rules if not os.path.exists(path)]
    return found + [settings.wrong("rules", f"no rule page or folder `{os.path.relpath(path)}`") for path in missing]


def _together(priced: Mapping[str, CombinedPrice], findings: Sequence[Finding]) -> dict[str, Price]:
    """What the findings that are left of each file cost together."""
    left: dict[str, list[Finding]] = {}
    for found in findings:
        if found.price is not None:
            left.setdefault(found.file, []).append(found)
    prices = {file: priced[file](own) for file, own in left.items() if file in priced}
    return {file: price for file, price in prices.items() if price is not None}


def _names(outputs: Iterable[str]) -> list[str]:
    return [text.partition("=")[0] for text in outputs]


def _dearest(found: Finding) -> tuple[float, float]:
    price = found.price
    return (-price.milliwatts, -price.memory_mib) if price is not None else (0.0, 0.0)


def _once(findings: Iterable[Finding]) -> list[Finding]:
    """Each finding once: two configurations may share a broken page."""
    return list(dict.fromkeys(findings))
