"""Facts of the clear values that a render pass is begun with."""

from __future__ import annotations

from msaa_lint.frame.description.models import BeginRenderPass

from .facts import Facts
from .frame import Frame
from .parts import RENDER_PASS, Pass


def clear_value_facts(facts: Facts, render_pass: Pass, frame: Frame) -> None:
    """Adds how many clear values a render pass is begun with, the most that any begin gives, and whether an attachment takes one.

    A rendering has them in its attachments, and is begun with none.
    """
    facts.put("pass.attachments", len(render_pass.attachments), render_pass.record.place("attachments"))
    if render_pass.kind != RENDER_PASS or not render_pass.begun:
        facts.put("pass.clear_values", 0)
        return
    operations = {aspect.load for attachment in render_pass.attachments if attachment.used for aspect in attachment.aspects}
    facts.put("pass.clears", True if "CLEAR" in operations else None if None in operations else False)
    bodies = [frame.commands[position].body for position in render_pass.begun]
    given = [(body.clearValueCount, body) for body in bodies if isinstance(body, BeginRenderPass) and body.clearValueCount is not None]
    if given:
        count, body = max(given, key=lambda one: one[0])
        facts.put("pass.clear_values", count, body.place("clearValueCount"))
