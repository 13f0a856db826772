"""Plans the changes that a rule page's fix makes for one subject."""

from __future__ import annotations

import re

from msaa_lint.frame.facts.facts import Subject, Value
from msaa_lint.linter.rules.rule import FixSpec, Setting

from .actions import ACTIONS, Action
from .changes import Change, NoFix, distinct
from .context import FixContext
from .fact_sources import FACT_SOURCES, SET_BY_UNSET, FindSources

_FACT_REFERENCE = re.compile(r"\{([a-z_.0-9]+)\}")


def plan(spec: FixSpec, subject: Subject, context: FixContext) -> tuple[Change, ...]:
    """The changes that a fix makes for a subject. Raises NoFix if it cannot be made or changes
    nothing.
    """
    actions, sources = _tables(context)
    api = "Vulkan" if context.document.metal is None else "Metal"
    changes: list[Change] = []
    if spec.do:
        if spec.do not in actions:
            raise NoFix(f"the fix does not apply to {api} descriptions")
        changes += actions[spec.do](subject, context)
    for action, settings in (("set", spec.set), ("add", spec.add), ("remove", spec.remove)):
        for setting in settings:
            values = _values(setting, subject)
            if setting.fact not in sources:
                raise NoFix(f"the fix does not apply to {api} descriptions")
            member_action = "unset" if action == "set" and setting.fact in SET_BY_UNSET else action
            for record, member in sources[setting.fact](subject, context):
                changes += (Change(record, member, member_action, value) for value in values)
    changes += [
        change._replace(record=record)
        for change in changes
        if not change.structural
        for record in context.continued.get(id(change.record), ())
    ]
    effective = distinct(change for change in changes if change.effective)
    if not effective:
        raise NoFix("the description already states this")
    return tuple(effective)


def _tables(context: FixContext) -> tuple[dict[str, Action], dict[str, FindSources]]:
    """The actions and the sources of facts for the API of a frame."""
    if context.document.metal is None:
        return ACTIONS, FACT_SOURCES
    from .metal import METAL_ACTIONS, METAL_FACT_SOURCES

    return METAL_ACTIONS, METAL_FACT_SOURCES


def _values(setting: Setting, subject: Subject) -> list[Value]:
    """The value of a setting, or the values of the fact that it refers to, one per item of a
    list.
    """
    reference = _FACT_REFERENCE.fullmatch(setting.value) if isinstance(setting.value, str) else None
    if reference is None:
        return [setting.value]
    value = subject.facts.values.get(reference[1])
    if value is None:
        raise NoFix(f"the value of {reference[1]} is not known")
    return [*value] if isinstance(value, list) else [value]
