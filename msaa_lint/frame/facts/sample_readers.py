"""Who fetches the samples that a pass stores: shaders alone, and how many samples of a texel."""

from __future__ import annotations

from msaa_lint.frame.description.models import ReadImage

from .event_search import ENDS, EventSearch, every_time, is_unknown, reads
from .parts import Aspect, Attachment

ONE, ALL, NOT_STATED, OTHER = "ONE", "ALL", "NOT_STATED", "OTHER"


def _is_shader(body: ReadImage) -> bool:
    """Whether a shader reads, as far as the access is stated."""
    return body.access is None or "SHADER" in body.access


def samples_fetched(attachment: Attachment, aspect: Aspect, search: EventSearch) -> str | None:
    """What the readers of a stored aspect are until it is overwritten, round the loop.

    ONE: shaders alone, stated to fetch one sample; ALL: shaders alone, of which one fetches every
    sample; NOT_STATED: shaders alone, of which one does not say; OTHER: something else as well, or
    nothing. None where that is unknown.
    """
    if attachment.input:
        return OTHER
    bodies: list[ReadImage] = []
    for ref in search.written_at(attachment, aspect.name):
        for event, _ in search.after(ref, aspect.name):
            if is_unknown(event):
                return None
            if (
                event.command is not None
                and isinstance(event.command.body, ReadImage)
                and _is_shader(event.command.body)
            ):
                bodies.append(event.command.body)
            elif reads(event):
                return OTHER
            elif every_time(event) and event.kind in ENDS:
                break
    if search.steps_left < 0 or not search.frame.has_commands:
        return None
    # What is done with several samples says that they are fetched.
    answers = {
        ALL
        if body.samples == "ALL" or body.resolves is not None
        else ONE
        if body.samples == 1
        else NOT_STATED
        for body in bodies
    }
    answer = next((answer for answer in (ALL, NOT_STATED, ONE) if answer in answers), OTHER)
    may_be_read = any(search.frame.may_be_read(target.name) for target in attachment.targets)
    return answer if answer in (ALL, OTHER) or not may_be_read else None
