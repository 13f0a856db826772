"""Who fetches the samples that a pass stores: shaders alone, and how many samples of a texel."""

from __future__ import annotations

from msaa_lint.frame.description.models import Command, ReadImage

from .events import CLEAR, READ, READS, UNKNOWN, Events
from .frame import Aspect, Attachment

ONE, ALL, NOT_STATED, OTHER = "ONE", "ALL", "NOT_STATED", "OTHER"


def fetched(attachment: Attachment, aspect: Aspect, events: Events) -> str | None:
    """What the readers of a stored aspect are until it is overwritten, round the loop.

    ONE: shaders alone, stated to fetch one sample; ALL: shaders alone, of which one fetches every sample; NOT_STATED: shaders alone, of
    which one does not say; OTHER: something else as well, or nothing. None where that is not known.
    """
    if attachment.input:
        return OTHER
    found: list[ReadImage] = []
    for spot in events.stored.get((id(attachment), aspect.name), ()):
        for event, _ in events.after(spot, aspect.name):
            if event.kind == UNKNOWN:
                return None
            if event.kind == READ and isinstance(event.of, Command) and isinstance(event.of.body, ReadImage):
                found.append(event.of.body)
            elif event.kind in READS:
                return OTHER
            elif event.whole and event.kind == CLEAR:
                break
    if events.left < 0 or not events.frame.has_commands:
        return None
    # What is done with several samples says that they are fetched.
    answers = {ALL if body.samples == "ALL" or body.resolves is not None else ONE if body.samples == 1 else NOT_STATED for body in found}
    return next((each for each in (ALL, NOT_STATED, ONE) if each in answers), OTHER)
