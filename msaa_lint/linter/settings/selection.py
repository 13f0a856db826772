"""Which rules are enabled for a file, and the severity of their findings.

If two selectors name the same rule, the more specific one wins: a name or code, then a longer code
prefix, then a shorter one, then ALL; between equals, `ignore` wins. The command line takes
precedence over a file, and its `--select` replaces everything a file selects. `per-file-ignores`
takes precedence over both.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property

from msaa_lint.core.diagnostics import DIAGNOSTICS, HIDDEN_CHARACTER
from msaa_lint.core.finding import SEVERITIES, Finding
from msaa_lint.core.globs import matches

from .selectors import EXACT, Named, Weighed, max_specificity, specificity
from .settings import Settings

ABOUT_TEXT = ("MSAA911", "MSAA912", "MSAA913", "MSAA915", HIDDEN_CHARACTER)
"""Diagnostics of suppression comments and of characters: `select` leaves them enabled, everything
else can disable them.
"""

Severity = Callable[[Weighed, str, str | None], str | None]
"""`severity(rule, suggested, vendor)`: the severity of a rule's finding in one file; None where the
rule is off.
"""


class Selection:
    """The rules that one configuration enables.

    A rule of an edition later than the pinned one is enabled only by its name or code. A user's own
    rules have no edition and are among the defaults of every edition. 9xx errors are always
    enabled.
    """

    def __init__(self, settings: Settings, rules: Callable[[], Iterable[Weighed]]) -> None:
        self._settings = settings
        self._load = rules
        self._ignored: dict[str, frozenset[str]] = {}
        self._for_all: dict[str | None, Severity] = {}

    @cached_property
    def _rules(self) -> Sequence[Named]:
        return [*self._load(), *(DIAGNOSTICS[code] for code in ABOUT_TEXT)]

    @cached_property
    def _severities(self) -> Mapping[str, str | None]:
        """The configured severities of the enabled rules by code, None for the rule's own."""
        pinned = None if self._settings.edition is None else _edition(self._settings.edition)
        found: dict[str, str | None] = {}
        for rule in self._rules:
            edition = getattr(rule, "edition", "")
            is_later = pinned is not None and bool(edition) and _edition(edition) > pinned
            is_on, severity = _enabled(self._settings, rule, is_later, rule.code in ABOUT_TEXT)
            if is_on:
                found[rule.code] = severity
        return found

    def enabled(self, rule: Named, file: str | None = None) -> bool:
        """Whether a rule is enabled for a file (None: for any file)."""
        if rule.code in self._severities:
            return file is None or rule.code not in self._ignored_in(file)
        return rule.code in DIAGNOSTICS and DIAGNOSTICS[rule.code].severity == "error"

    def severity(
        self, rule: Weighed, file: str | None = None, suggested: str | None = None
    ) -> str | None:
        """The severity of a rule's finding in a file; None if the rule is off. `suggested` is the
        rule's own severity in this case.
        """
        return (
            (self._severities.get(rule.code) or suggested or rule.severity)
            if self.enabled(rule, file)
            else None
        )

    def names(self, file: str | None = None) -> frozenset[str]:
        """The names of the rules that are enabled for a file (None: for any file)."""
        return frozenset(rule.name for rule in self._rules if self.enabled(rule, file))

    def for_file(self, file: str, vendor: str | None = None) -> Severity:
        """The severities of one file, for the engine. `vendor` is that of the profile.

        A rule about one vendor's devices gives a note if the device is not known to be that
        vendor's, unless a severity is configured.
        """
        shared = not self._settings.per_file_ignores
        if shared and vendor in self._for_all:
            return self._for_all[vendor]

        def severity(rule: Weighed, suggested: str, device_vendor: str | None) -> str | None:
            vendors = getattr(rule, "vendors", ())
            if vendors and (device_vendor or vendor) not in vendors:
                suggested = SEVERITIES[0]
            return self.severity(rule, file, suggested)

        if shared:
            # The rule runner caches by this function.
            self._for_all[vendor] = severity
        return severity

    def settle(self, finding: Finding) -> Finding | None:
        """A finding with the severity that is configured for it if it is in ABOUT_TEXT; None if
        that is off for its file.
        """
        if finding.code not in ABOUT_TEXT:
            return finding
        if not self.enabled(DIAGNOSTICS[finding.code], finding.file):
            return None
        return finding._replace(severity=self._severities[finding.code] or finding.severity)

    def _ignored_in(self, file: str) -> frozenset[str]:
        """The codes of the rules that `per-file-ignores` disables for a file."""
        if not self._settings.per_file_ignores:
            return frozenset()
        if file not in self._ignored:
            selectors = [
                each
                for glob, ignored in self._settings.per_file_ignores
                if matches(file, glob)
                for each in ignored
            ]
            self._ignored[file] = frozenset(
                rule.code for rule in self._rules if max_specificity(selectors, rule)
            )
        return self._ignored[file]


def _edition(text: str) -> tuple[int, ...]:
    return tuple(int(part[:9]) if part.isdecimal() else 0 for part in text.split("."))


def _enabled(settings: Settings, rule: Named, later: bool, always: bool) -> tuple[bool, str | None]:
    """Whether a configuration enables a rule, `per-file-ignores` aside, and the severity that it
    gives it.
    """
    choice = settings.command_line
    off, severity = _severity(settings.severity, rule)
    ignored = max(max_specificity(settings.ignore, rule), off)
    is_on = _is_selected(settings.select, settings.extend_select, ignored, rule, later, always)
    off, chosen_severity = _severity(choice.severity, rule)
    ignored = max(max_specificity(choice.ignore, rule), off)
    if choice.select is not None:
        is_on = _is_selected(choice.select, choice.extend_select, ignored, rule, later, always)
    else:
        selected = _specificity(choice.extend_select, rule, later)
        if selected or ignored:
            is_on = selected > ignored
    return is_on, chosen_severity or severity


def _is_selected(
    select: Iterable[str] | None,
    extend: Iterable[str],
    ignored: int,
    rule: Named,
    later: bool,
    always: bool,
) -> bool:
    """Whether a rule is selected more specifically than it is ignored (0: not at all)."""
    selected = max(_specificity(select or (), rule, later), _specificity(extend, rule, later))
    by_default = not later if select is None else always
    return selected > ignored or (by_default and not ignored)


def _specificity(selectors: Iterable[str], rule: Named, later: bool) -> int:
    """How specifically selectors name a rule; a rule of a `later` edition must be named exactly."""
    found = max_specificity(selectors, rule)
    return found if found == EXACT or not later else 0


def _severity(severities: Mapping[str, str], rule: Named) -> tuple[int, str | None]:
    """How specifically a rule is turned off (0: it is not), and the severity it is given otherwise.

    That is the severity of the most specific selector; if a name and a code disagree, the higher
    one.
    """
    selected = [(specificity(selector, rule), level) for selector, level in severities.items()]
    levels = [
        (found, SEVERITIES.index(level)) for found, level in selected if found and level != "off"
    ]
    off = max((found for found, level in selected if level == "off"), default=0)
    most_specific = max(levels, default=None)
    if most_specific is None:
        return off, None
    return (off if off > most_specific[0] else 0), SEVERITIES[most_specific[1]]
