"""`do: keep-on-tile`: what a frame costs where a later pass becomes part of the one whose samples
it reads.

Its shaders have to be rewritten, so that this fix is only shown: its changes are for the price.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import ReadImage
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.handovers import handover
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT

from .changes import Change, NoFix
from .context import FixContext
from .transient import lazy_memory


def keep_on_tile(subject: Subject, context: FixContext) -> list[Change]:
    """Reads samples as input attachments instead of storing them; images that nothing else reads
    become transient.
    """
    analysis = context.analysis
    passes = {render_pass.path: render_pass for render_pass in context.frame.passes}
    found = (
        handover(passes[subject.path], analysis.search, analysis.shaders.fetched)
        if subject.path in passes
        else None
    )
    if found is None:
        raise NoFix("the pass whose shaders read the samples is not known")
    changes: list[Change] = []
    for position in found.positions:
        body = context.frame.commands[position].body
        if isinstance(body, ReadImage):
            changes.append(Change(body, "access", "set", "INPUT_ATTACHMENT_READ"))
    for attachment in found.attachments:
        stored = [
            aspect
            for aspect in attachment.aspects
            if aspect.store == "STORE" and aspect.name in ("color", "depth")
        ]
        changes += [
            Change(attachment.record, aspect.store_member, "set", "DONT_CARE") for aspect in stored
        ]
        image = attachment.target.image if attachment.target is not None else None
        if image is None or image.usage is None or context.document.metal is not None:
            continue
        others = [usage for usage in image.usage if usage not in BESIDE_TRANSIENT]
        if others in (["SAMPLED"], []) and not any(
            aspect.load == "LOAD" for aspect in attachment.aspects
        ):
            changes += [Change(image, "usage", "remove", usage) for usage in others]
            changes += [
                Change(image, "usage", "add", usage)
                for usage in ("INPUT_ATTACHMENT", "TRANSIENT_ATTACHMENT")
            ]
            changes += lazy_memory(image, subject)
    return changes
