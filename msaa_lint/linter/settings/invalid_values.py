"""Settings with the right form that name nothing."""

import os

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.files import is_there
from msaa_lint.linter.rules.rule import EDITIONS

from .settings import COMMAND_LINE, Settings


def invalid_values(settings: Settings) -> list[Finding]:
    """A finding for each setting with the right form that names nothing: an unknown edition or
    profile, a missing rule page.
    """
    findings = []
    if settings.fail_on_cost is not None:
        from .cost_limit import budget

        try:
            budget(settings.fail_on_cost)
        except ValueError as error:
            findings.append(
                settings.problem(
                    "fail-on-cost", f"invalid cost {quoted(settings.fail_on_cost)}", str(error)
                )
            )
    if settings.edition is not None and settings.edition not in EDITIONS:
        message = (
            f"unknown edition {quoted(settings.edition)}: expected one of {', '.join(EDITIONS)}"
        )
        findings.append(settings.problem("edition", message))
    if settings.profile is not None:
        from msaa_lint.frame.profiles import Problem, profile_of

        profile = profile_of(settings.profile, settings.project("profile"))
        if isinstance(profile, Problem):
            findings.append(settings.problem("profile", profile.message, profile.help))
    # Those of a configuration are checked where it is read.
    missing = [quoted(os.path.relpath(path), 200) for path in settings.rules if not is_there(path)]
    return findings + [
        diagnostic("MSAA921", f"no such file or folder {path} in `--rules`", COMMAND_LINE)
        for path in missing
    ]
