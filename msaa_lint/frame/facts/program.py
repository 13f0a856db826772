"""What several frames of one program say together of the objects that they share.

The documents of a file that state a `share` are the kinds of frame of one program, and objects with
the same name are the same object. What is said of an image or a render pass then holds for all of
these frames: what one frame leaves unread, another may read.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from .facts import Facts, Subject
from .joined_facts import join_facts
from .subjects import FrameAnalysis


def subjects_of(frames: Sequence[FrameAnalysis]) -> Iterator[Iterable[Subject]]:
    """The subjects of the frames of a file, frame by frame."""
    program = [frame for frame in frames if frame.frame.document.is_frame_of_program]
    joined = dict(zip(map(id, program), join(program), strict=True)) if len(program) > 1 else {}
    for frame in frames:
        yield joined.pop(id(frame)) if id(frame) in joined else frame.subjects()


def join(frames: Sequence[FrameAnalysis]) -> list[list[Subject]]:
    """The subjects of the frames of one program, frame by frame. The facts of those that several
    frames share hold for all of these.
    """
    _join_images(frames)
    subjects = [list(frame.subjects()) for frame in frames]
    shared: dict[tuple[str, str, str | None], list[Facts]] = {}
    for of_frame in subjects:
        for subject in of_frame:
            # A frame that does not begin a pass says nothing of what becomes of it.
            if (
                subject.path.startswith("renderPasses.")
                and subject.facts.values.get("pass.begun") == "YES"
            ):
                aspect = subject.aspect.name if subject.aspect is not None else None
                shared.setdefault((subject.kind, subject.path, aspect), []).append(subject.facts)
    for facts in shared.values():
        if len(facts) > 1:
            join_facts(facts)
    return subjects


def _join_images(frames: Sequence[FrameAnalysis]) -> None:
    """Joins the facts of images, before those of other subjects include them."""
    shared: dict[str, list[tuple[Facts, bool]]] = {}
    for frame in frames:
        for name, facts, is_used in frame.stated_images():
            shared.setdefault(name, []).append((facts, is_used))
    for each in shared.values():
        # Where no command touches an image, only its usage speaks.
        used = [facts for facts, is_used in each if is_used] or [facts for facts, _ in each]
        every = [facts for facts, _ in each]
        if len(every) == 1:
            continue
        in_vain = all(
            facts.values.get("image.read") is False or facts.values["image.read_in_vain"]
            for facts in used
        )
        in_vain = in_vain and any(facts.values["image.read_in_vain"] for facts in used)
        turns = [facts.values.get("image.taking_turns") for facts in used]
        stated = all(facts.values["image.turns_stated"] for facts in used)
        join_facts(used, every)
        for facts in every:
            facts.put("image.read_in_vain", in_vain)
            if any(names != turns[0] for names in turns):
                facts.put("image.taking_turns", [])
            facts.put("image.turns_stated", stated)
