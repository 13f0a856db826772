"""Facts of one object, or of objects that stand for each other, that are known from several
frames.
"""

from __future__ import annotations

from collections.abc import Sequence

from .facts import Facts

IN_ONE = (
    "aspect.read_later",
    "image.averaged_by_reader",
    "image.is_render_target",
    "image.loaded",
    "image.read",
    "image.resolved",
    "pass.partial_area",
    "resolve.target_read",
    "subpass.partial_coverage",
)
"""What is true if it is true in one frame."""

IN_ALL = (
    "aspect.readers_known",
    "aspect.store_wasted",
    "aspect.waste_certain",
    "aspect.untouched",
    "aspect.cleared_by_command",
    "resolve.only_copied",
    "resolve.repeats",
    "resolve.resolved_anew",
    "subpass.full_screen",
)
"""What is true only if it is true in all frames."""


def join_facts(facts: Sequence[Facts], every: Sequence[Facts] = ()) -> None:
    """Replaces facts by what holds for all frames that have a say, in `every` frame that has the
    object.
    """
    names = dict.fromkeys(name for each in facts for name in each.values)
    if not facts:
        return
    for joined, decisive in ((IN_ONE, True), (IN_ALL, False)):
        for name in filter(names.__contains__, joined):
            values = [each.values.get(name) for each in facts]
            value = decisive if decisive in values else None if None in values else not decisive
            for each in every or facts:
                if value is None:
                    each.values.pop(name, None)
                else:
                    each.put(name, value)
    for each in facts if "aspect.costly_operations" in names else ():
        operations = each.values["aspect.costly_operations"]
        assert isinstance(operations, list)
        if "STORE" in operations and each.values.get("aspect.read_later") is not False:
            each.values["aspect.costly_operations"] = [
                str(operation) for operation in operations if operation != "STORE"
            ]
