"""What several frames of one program say together of the objects that they share.

The documents of a file that state a `share` are the kinds of frame of one program, and objects with the same name are the same object. What
is said of an image or a render pass then holds for all of these frames: what one frame leaves unread, another may read.
"""

from __future__ import annotations

from collections.abc import Sequence

from .facts import Facts, Subject
from .subjects import FrameAnalysis

IN_ONE = (
    "aspect.read_later",
    "image.averaged_by_reader",
    "image.is_render_target",
    "image.loaded",
    "image.read",
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
    "image.turns_stated",
    "resolve.only_copied",
    "resolve.repeats",
    "resolve.resolved_anew",
    "subpass.full_screen",
)
"""What is true only if it is true in all frames."""


def join(frames: Sequence[FrameAnalysis]) -> list[list[Subject]]:
    """The subjects of the frames of one program, frame by frame. The facts of those that several frames share hold for all of these."""
    _join_images(frames)
    subjects = [list(frame.subjects()) for frame in frames]
    shared: dict[tuple[str, str, str | None], list[Facts]] = {}
    for of_frame in subjects:
        for subject in of_frame:
            # A frame that does not begin a pass says nothing of what becomes of it.
            if subject.path.startswith("renderPasses.") and subject.facts.values.get("pass.begun") == "YES":
                aspect = subject.aspect.name if subject.aspect is not None else None
                shared.setdefault((subject.kind, subject.path, aspect), []).append(subject.facts)
    for facts in shared.values():
        if len(facts) > 1:
            _join(facts)
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
        in_vain = all(facts.values.get("image.read") is False or facts.values["image.read_in_vain"] for facts in used)
        in_vain = in_vain and any(facts.values["image.read_in_vain"] for facts in used)
        turns = [facts.values.get("image.taking_turns") for facts in used]
        _join(used, every)
        for facts in every:
            facts.put("image.read_in_vain", in_vain)
            if any(names != turns[0] for names in turns):
                facts.put("image.taking_turns", [])


def _join(facts: Sequence[Facts], every: Sequence[Facts] = ()) -> None:
    """Replaces facts by what holds for all frames that have a say, in `every` frame that has the object."""
    names = dict.fromkeys(name for each in facts for name in each.values)
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
            each.values["aspect.costly_operations"] = [str(operation) for operation in operations if operation != "STORE"]
