"""Depth and stencil in one plane of memory, which are loaded and stored together: a fix of one
aspect alone saves nothing.
"""

from __future__ import annotations

from msaa_lint.frame.cost.traffic import in_one_plane
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.linter.rules.rule import FixSpec

from .context import FixContext
from .merges import in_frame

BOTH = "depth and stencil are in one plane of memory: the price is that of both"


def other_aspect(
    spec: FixSpec, subject: Subject, context: FixContext, device: DeviceProfile | None
) -> Subject | None:
    """The other aspect of a plane, if the same fix applies to it: it is loaded, too, or stored
    although nothing reads it.
    """
    if (
        subject.attachment is None
        or subject.aspect is None
        or not in_one_plane(subject.attachment.format, device)
    ):
        return None
    render_pass, attachment, aspect = in_frame(subject, context)
    stores = any(setting.fact in ("aspect.store", "aspect.store_action") for setting in spec.set)
    for other in render_pass.attachments:
        for its in other.aspects if other.target is attachment.target and other.used else ():
            loaded = spec.do == "merge-passes" and its.load == "LOAD"
            unread = (
                stores
                and its.store == "STORE"
                and context.analysis.readers.read_later(render_pass, other, its) is False
            )
            if its.name != aspect.name and (loaded or unread):
                return subject._replace(attachment=other, aspect=its)
    return None
