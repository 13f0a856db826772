"""Rules as data: what the front matter of a rule page states."""

from collections.abc import Mapping
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span

SAFETIES = ("safe", "unsafe", "shown")
"""Of a fix: it cannot change the picture; it may change the picture or needs a decision; it is
shown with its price, but never applied.
"""


class Setting(NamedTuple):
    """One change of a fix: a fact, the value to set, add or remove, and its location on the page.

    A value in braces names another fact of the subject, whose value is used. `fact_at` is the
    location of the fact's name.
    """

    fact: str
    value: str | bool | int | float
    at: Span
    fact_at: Span = Span(0, 0)


class FixSpec(NamedTuple):
    """A fix in terms of facts: `set` sets the member that a fact comes from, `add` and `remove`
    change a list, and `do` names an action of `linter.fixes`. `at` is the location of that name, or
    of the fix.
    """

    title: str
    safety: str
    set: tuple[Setting, ...] = ()
    add: tuple[Setting, ...] = ()
    remove: tuple[Setting, ...] = ()
    do: str = ""
    at: Span = Span(0, 0)

    @property
    def safe(self) -> bool:
        return self.safety == "safe"


EDITIONS = ("2026.1",)
"""In order. A rule of an edition later than the pinned one is off by default."""

APIS = ("vulkan", "metal")
"""The APIs whose frames a rule may be about."""

PASSES = ("begun", "all")
"""The passes that a rule about parts of passes applies to: those that the frame begins, or also
those that are only created.
"""


class Case(NamedTuple):
    """What differs if a rule fires and `when` is true as well. The first such case applies; its
    `fix` replaces the rule's.
    """

    when: str
    severity: str | None
    confidence: str | None
    message: str | None
    condition_at: Span = Span(0, 0)
    fix: FixSpec | None = None
    help: str | None = None


class Rule(NamedTuple):
    """A rule as stated by the front matter of its page.

    `when` is a CEL condition. `at` and `labels` name facts and refer to their locations. `apis` are
    those whose frames the rule applies to, `passes` the passes (one of PASSES).
    """

    code: str
    name: str
    severity: str
    confidence: str
    subject: str
    when: str
    message: str
    at: tuple[str, ...]
    labels: tuple[tuple[str, str], ...]
    cases: tuple[Case, ...]
    help: str
    fix: FixSpec | None
    vendors: tuple[str, ...]
    edition: str
    references: tuple[str, ...]
    supersedes: tuple[str, ...]
    summary: str
    path: str
    condition_at: Span
    source: Source
    apis: tuple[str, ...] = APIS[:1]
    passes: str = PASSES[0]
    places: Mapping[str, Span] = {}
    """The locations of the values of the front matter's keys."""
    texts: tuple[tuple[str, Span], ...] = ()
    """The texts with facts in braces, and their locations."""
    named: tuple[tuple[str, Span], ...] = ()
    """The facts that `at` and `labels` name, and their locations."""

    @property
    def is_custom(self) -> bool:
        """Whether it is one of the user's own rules; their codes cannot begin with MSAA."""
        return not self.code.startswith("MSAA")

    @property
    def fix_specs(self) -> "tuple[FixSpec, ...]":
        """The fixes of the rule and of its cases."""
        return tuple(
            dict.fromkeys(
                fix for fix in (self.fix, *(case.fix for case in self.cases)) if fix is not None
            )
        )

    def problem(self, message: str, span: Span) -> Finding:
        """A finding about the rule's page (MSAA921)."""
        return page_problem(self.name, self.source.name, message, span)


def page_problem(rule: str, page: str, message: str, span: Span) -> Finding:
    """A finding about the page of a rule (MSAA921)."""
    return diagnostic("MSAA921", f"rule page `{rule}`: {message}", page, span, rule)
