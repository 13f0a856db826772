"""`do: merge-passes`: what a frame costs where a pass goes on in the one that stored what it loads.

Which draws are recorded where is the program's, so that this fix is only shown: its changes are for
the price.
"""

from __future__ import annotations

from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import Aspect, Attachment, Pass

from .changes import Change
from .context import FixContext
from .subject_parts import aspect_of, present

LOAD_ALONE = (
    "the price is that of the load alone: the pass that stored the samples is not known, "
    "or something else may need its store"
)


def merge_passes(subject: Subject, context: FixContext) -> list[Change]:
    """Drops a load, and the store of what it loads if nothing else needs that."""
    render_pass, attachment, aspect = in_frame(subject, context)
    changes = [Change(attachment.record, aspect.load_member, "set", "DONT_CARE")]
    source = context.analysis.readers.forced_store(render_pass, attachment, aspect)
    if source is not None:
        stored = next(each for each in source.aspects if each.name == aspect.name)
        changes.append(Change(source.record, stored.store_member, "set", "DONT_CARE"))
    return changes


def merge_price_note(subject: Subject, context: FixContext) -> str | None:
    """What the price of a merge leaves out; None if it includes the store."""
    return (
        LOAD_ALONE
        if context.analysis.readers.forced_store(*in_frame(subject, context)) is None
        else None
    )


def in_frame(subject: Subject, context: FixContext) -> tuple[Pass, Attachment, Aspect]:
    """The aspect that a subject is, with its pass, in the frame of the context."""
    attachment, aspect = aspect_of(subject)
    candidates = (
        candidate
        for target in attachment.targets
        for candidate in context.attachments.get(id(target.record), ())
    )
    found = next(
        (
            (render_pass, each)
            for render_pass, each in candidates
            if each.record is attachment.record
        ),
        None,
    )
    return *present(found, "the pass of the attachment is not known"), aspect
