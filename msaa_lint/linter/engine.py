"""The rules of a run, and what lints inputs by them. Both are loaded with the first input to lint:
all may be known from an earlier run.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from msaa_lint.core.finding import Finding, RuleInfo
from msaa_lint.core.text.source import Source

from .lint_options import LintOptions
from .results import FileResult
from .rules.budget import Budget
from .run_limits import RunLimits
from .settings.selection import Severity

if TYPE_CHECKING:
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.source_file import SourceFile

    from .input_linter import InputLinter
    from .rules.registry import Registry
    from .rules.rule import Rule


class Engine:
    """A set of rules for any number of inputs.

    The `limits` are those of the run. An engine without them belongs to no run. Without a registry,
    the rules are the built-in ones.
    """

    def __init__(self, registry: "Registry | None", limits: RunLimits | None = None) -> None:
        self._stated = registry
        self._limits = limits

    @property
    def custom_pages(self) -> Mapping[str, Source]:
        """The pages of the user's own rules, by name."""
        return self._stated.sources if self._stated is not None else {}

    @property
    def broken_pages(self) -> Sequence[str]:
        """The files of the user's own rules that cannot be used."""
        return [page.page for page in self._stated.broken] if self._stated is not None else []

    @cached_property
    def registry(self) -> "Registry":
        """The rules."""
        if self._stated is not None:
            return self._stated
        from .rules.registry import built_in

        return built_in()

    @cached_property
    def linter(self) -> "InputLinter":
        """What lints inputs by the rules."""
        from .input_linter import InputLinter

        return InputLinter(self.registry, self._limits)

    def lint(
        self, data: "bytes | CaptureInput | SourceFile", file: str, options: LintOptions
    ) -> FileResult:
        """The findings of one input in order of location. `data` is a file's bytes, or a capture or
        source code already read.
        """
        return self.linter.lint(data, file, options)

    def lint_description(
        self, source: Source, file: str, options: LintOptions, modules: Mapping[str, bytes]
    ) -> FileResult:
        """The findings of a description that msaa-lint wrote, of a capture or source code;
        `modules` are its shaders by name.
        """
        return self.linter.lint_description(source, file, options, modules)


def load_rules(
    paths: Sequence[str] = (),
    projects: Mapping[str, str] = {},
    budget: Budget | None = None,
    traceback: bool = False,
) -> "Registry":
    """The built-in rules and the user's own rules at `paths`, the latter checked within the
    `budget` of the run. `projects` has those of paths in a configuration. `traceback` is as for
    `registry.load`.
    """
    from .rules.registry import load

    def check_fixes(rule: "Rule") -> list[Finding]:
        from .fixes.fix_checks import problems

        return problems(rule)

    return load(paths, check_fixes, projects, budget, traceback)


def rule_infos(registry: "Registry", severity: Severity, full: bool) -> list[RuleInfo]:
    """The enabled rules by code, as reports describe them; `full` includes their pages."""
    from .rules.registry import info

    severities = [(rule, severity(rule, rule.severity, None)) for rule in registry.rules]
    return [info(rule, level, full) for rule, level in severities if level is not None]
