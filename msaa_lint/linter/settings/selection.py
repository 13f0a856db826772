"""Which rules are on for a file, and what their findings weigh.

Of two selectors that name the same rule the closer one wins: a name or code over the beginning of a code, a longer beginning over a
shorter, any of them over ALL; `ignore` wins where they are equal. What the command line says of a rule wins over the file, and its
`--select` starts anew. `per-file-ignores` wins over all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple

from msaa_lint.core.diagnostics import DIAGNOSTICS
from msaa_lint.core.finding import SEVERITIES, Finding
from msaa_lint.core.globs import matches

from .selectors import EXACT, Named, Weighed, closest, specificity
from .settings import Settings

ABOUT_COMMENTS = ("MSAA911", "MSAA912", "MSAA913")
"""Not of the frame but of what the file says to this program: `select` leaves them on, the rest can turn them off."""


class _Weight(NamedTuple):
    """A rule that is on: the severity it is given, None where it keeps its own."""

    stated: str | None


class Selection:
    """The rules that one configuration turns on.

    A rule of a later edition than the pinned one is on only where it is selected by its name or code; a user's own rules (no edition)
    are among the defaults of every edition. 9xx errors are always on.
    """

    def __init__(self, settings: Settings, rules: Iterable[Weighed]) -> None:
        self._settings = settings
        self._rules: list[Named] = []
        self._on: dict[str, _Weight] = {}
        self._ignored: dict[str, frozenset[str]] = {}
        self._for_all: dict[str | None, Callable[[Weighed, str, str | None], str | None]] = {}
        pinned = None if settings.edition is None else _edition(settings.edition)
        for rule in rules:
            later = pinned is not None and bool(rule.edition) and _edition(rule.edition) > pinned
            self._add(rule, later, False)
        for code in ABOUT_COMMENTS:
            self._add(DIAGNOSTICS[code], False, True)

    def _add(self, rule: Named, later: bool, always: bool) -> None:
        self._rules.append(rule)
        weight = _weight(self._settings, rule, later, always)
        if weight is not None:
            self._on[rule.code] = weight

    def enabled(self, rule: Named, file: str | None = None) -> bool:
        """Whether a rule is on for a file (None: for some file)."""
        if rule.code in self._on:
            return file is None or rule.code not in self._off_in(file)
        return rule.code in DIAGNOSTICS and DIAGNOSTICS[rule.code].severity == "error"

    def severity(self, rule: Weighed, file: str | None = None, suggested: str | None = None) -> str | None:
        """What a finding of a rule weighs in a file, None where it is off. `suggested` is what the rule says of this case."""
        if not self.enabled(rule, file):
            return None
        weight = self._on.get(rule.code)
        return (weight.stated if weight is not None else None) or suggested or rule.severity

    def names(self, file: str | None = None) -> frozenset[str]:
        """The names of the rules that are on for a file."""
        return frozenset(rule.name for rule in self._rules if self.enabled(rule, file))

    def for_file(self, file: str, vendor: str | None = None) -> Callable[[Weighed, str, str | None], str | None]:
        """`severity(rule, suggested, vendor)` for one file, as the engine asks it.

        A vendor's rule weighs a note where the device is not known to be that vendor's, by what the engine says or by `vendor` (the
        profile's), unless the configuration gives it a severity.
        """
        alike = not self._settings.per_file_ignores
        if alike and vendor in self._for_all:
            return self._for_all[vendor]

        def severity(rule: Weighed, suggested: str, of_device: str | None) -> str | None:
            vendors = getattr(rule, "vendors", ())
            if vendors and (of_device or vendor) not in vendors:
                suggested = SEVERITIES[0]
            return self.severity(rule, file, suggested)

        if alike:
            # One for all files: who asks may remember what it said.
            self._for_all[vendor] = severity
        return severity

    def settle(self, found: Finding) -> Finding | None:
        """A 9xx finding with the severity that the configuration gives it; None where it is off for its file."""
        if found.code not in ABOUT_COMMENTS:
            return found
        if not self.enabled(DIAGNOSTICS[found.code], found.file):
            return None
        return found._replace(severity=self._on[found.code].stated or found.severity)

    def _off_in(self, file: str) -> frozenset[str]:
        if not self._settings.per_file_ignores:
            return frozenset()
        if file not in self._ignored:
            selectors = [each for glob, given in self._settings.per_file_ignores if matches(file, glob) for each in given]
            self._ignored[file] = frozenset(rule.code for rule in self._rules if closest(selectors, rule))
        return self._ignored[file]


def _edition(text: str) -> tuple[int, ...]:
    return tuple(int(part) if part.isdecimal() else 0 for part in text.split("."))


def _weight(settings: Settings, rule: Named, later: bool, always: bool) -> _Weight | None:
    """What a configuration makes of a rule, files apart; None where it is off."""
    choice = settings.command_line
    off, stated = _stated(settings.severity, rule)
    on = _outweighs(settings.select, settings.extend_select, max(closest(settings.ignore, rule), off), rule, later, always)
    off, asked = _stated(choice.severity, rule)
    no = max(closest(choice.ignore, rule), off)
    if choice.select is not None:
        on = _outweighs(choice.select, choice.extend_select, no, rule, later, always)
    else:
        yes = _selected(choice.extend_select, rule, later)
        if yes or no:
            on = yes > no
    return _Weight(asked or stated) if on else None


def _outweighs(select: Iterable[str] | None, extend: Iterable[str], no: int, rule: Named, later: bool, always: bool) -> bool:
    """Whether a rule is selected more closely than it is ignored (0: not at all)."""
    yes = max(_selected(select or (), rule, later), _selected(extend, rule, later))
    by_default = not later if select is None else always
    return yes > no or (by_default and not no)


def _selected(selectors: Iterable[str], rule: Named, later: bool) -> int:
    close = closest(selectors, rule)
    return close if close == EXACT or not later else 0


def _stated(severities: Mapping[str, str], rule: Named) -> tuple[int, str | None]:
    """How closely a rule is turned off (0: it is not), and the severity that it is given otherwise: by the closest selector, the graver
    where a name and a code disagree."""
    given = [(specificity(selector, rule), level) for selector, level in severities.items()]
    levels = [(close, SEVERITIES.index(level)) for close, level in given if close and level != "off"]
    off = max((close for close, level in given if level == "off"), default=0)
    closest_level = max(levels, default=None)
    if closest_level is None:
        return off, None
    return (off if off > closest_level[0] else 0), SEVERITIES[closest_level[1]]
