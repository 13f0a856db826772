"""The values that a shell completes, with a word on each: what the tables of `options` name as
`values`.
"""

from collections.abc import Iterable

Values = Iterable[tuple[str, str]]


def rules() -> Values:
    """The names and codes of the rules, custom ones of the configuration included."""
    from msaa_lint.linter.request import Request
    from msaa_lint.linter.settings.selectors import RuleNames
    from msaa_lint.linter.workspace import Workspace

    for rule in RuleNames(Workspace(Request([])).current.engine.registry.rules).rules:
        yield rule.name, rule.code
        yield rule.code, rule.name
    yield "ALL", "all rules"


def editions() -> Values:
    """The editions of the default rules."""
    from msaa_lint.linter.rules.rule import EDITIONS

    return [(edition, "") for edition in EDITIONS]


def devices() -> Values:
    """The built-in devices and device classes."""
    from msaa_lint.frame.devices import builtin, names

    return [(name, profile.name) for name in names() if (profile := builtin(name)) is not None]


def profiles() -> Values:
    """What `--profile` knows by name: devices, device classes, and vendors."""
    from msaa_lint.frame.facts.words import WORDS

    return {**dict.fromkeys(WORDS["vendor"], "vendor"), **dict(devices())}.items()


def scenes() -> Values:
    """The scenes of `study`."""
    from msaa_lint.experiments.study.scenes import DESCRIPTIONS

    return DESCRIPTIONS.items()


def techniques() -> Values:
    """The sampling techniques that `study` compares."""
    from msaa_lint.experiments.study.points import KINDS

    return [(kind, "") for kind in KINDS]


def study_samples() -> Values:
    """The sample counts of `study`."""
    from msaa_lint.experiments.study.points import COUNTS

    return _numbers(COUNTS)


def cost_samples() -> Values:
    """The sample counts of `cost` and `confirm`."""
    from msaa_lint.frame.cost.samples import COUNTS

    return _numbers(COUNTS)


def _numbers(counts: Iterable[int]) -> Values:
    return [(str(count), "") for count in counts]
