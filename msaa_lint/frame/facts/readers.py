"""Who reads what a pass stored: by the frame's timeline where it has commands, else as stated
usages allow.

Where the description records commands, only they read. Where it does not, what a stated usage
allows is taken as done. A pass that the commands never begin is judged by itself.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Image, ReadImage

from .commands import CLEAR, COMMAND_READS, COMMAND_WRITES, RESOLVE_WRITE
from .frame import Frame
from .parts import RENDERING, Aspect, Attachment, Pass, Resolve, Target
from .pass_begin import targets_at
from .timeline import BEGIN, DISCARD, ELSEWHERE, LOAD, STORE, Event, Timeline, discards_all, key_of
from .walk import PassRun

READS = "reads"
OVERWRITES = "overwrites"
MAY_READ = "may read"

READING_USAGES = frozenset({
    "SAMPLED", "STORAGE", "INPUT_ATTACHMENT", "TRANSFER_SRC", "FRAGMENT_DENSITY_MAP_EXT",
    "FRAGMENT_SHADING_RATE_ATTACHMENT_KHR",
})  # fmt: skip


class Store(NamedTuple):
    """The pass that stored the contents of an image last, and where that is stated."""

    render_pass: Pass
    place: Span


class Readers:
    """What reads the images of a frame."""

    def __init__(self, timeline: Timeline) -> None:
        self.timeline = timeline
        self.frame: Frame = timeline.frame
        self._uses_of: dict[tuple[str, str | None], list[tuple[Event, str]]] = {}
        self._others: dict[tuple[str, str | None], list[int]] = {}
        self._read_later: dict[tuple[int, Aspect], bool | None] = {}
        self._stores_of: dict[tuple[str, str | None], list[Event]] = {}
        self._stated: dict[tuple[str, str | None, bool], bool | None] = {}

    def uses(self, image: str, aspect: str | None = None) -> list[tuple[Event, str]]:
        """The events that read an aspect of an image, end what was there, or may do either, in
        order; None: of any aspect.
        """
        key = (image, aspect)
        if key not in self._uses_of:
            target = self.frame.targets.get(image)
            events = [
                event
                for event in self.timeline.of.get(image, ())
                if same_aspect(event.aspect, aspect) and not _reads_input_attachment(event, target)
            ]
            uses = [
                (event, _effect_after(events[number - 1], event))
                for number, event in enumerate(events)
            ]
            self._uses_of[key] = [(event, effect) for event, effect in uses if effect is not None]
        return self._uses_of[key]

    def reads(self, image: str) -> list[Event]:
        """The events that read an image."""
        return [event for event, effect in self.uses(image) if effect == READS]

    def read_later(self, render_pass: Pass, attachment: Attachment, aspect: Aspect) -> bool | None:
        """Whether anything reads what a pass stored of an aspect; None where the description does
        not say.
        """
        key = (id(attachment), aspect)
        if key not in self._read_later:
            self._read_later[key] = self._reads_later(render_pass, attachment, aspect)
        return self._read_later[key]

    def _reads_later(
        self, render_pass: Pass, attachment: Attachment, aspect: Aspect
    ) -> bool | None:
        runs = self.timeline.walk.runs_of(render_pass)
        if attachment.rate or render_pass.suspends:
            # What a suspended rendering draws is stored by the one that resumes and ends it.
            return True
        if not self.timeline.followed:
            return None
        answers = set(self._answers(render_pass, runs, attachment, aspect))
        if not answers or True in answers:
            return True if answers else None
        return None if None in answers else False

    def _answers(
        self, render_pass: Pass, runs: list[PassRun], attachment: Attachment, aspect: Aspect
    ) -> Iterator[bool | None]:
        if self.frame.has_commands and not render_pass.begun:
            for target in attachment.targets:
                yield (
                    True
                    if aspect.load == "LOAD"
                    else self._read_as_stated(target, attachment, aspect)
                )
            return
        for run in runs:
            for target in targets_at(self.frame, attachment, run.position):
                if target.image is None:
                    # Nothing else of the description can name it: only its own load in the next
                    # frame shows.
                    yield True if aspect.load == "LOAD" or self._may_be_loaded(aspect) else None
                    continue
                follows = self._next_use(target.name, aspect.name, run)
                if follows == READS or (_is_stranger(target) and self._may_be_loaded(aspect)):
                    yield True
                elif follows == MAY_READ:
                    yield None
                elif run.position is not None:
                    yield None if target.image.mayBeRead else False
                else:
                    yield True if target.image.presentable else _usage_reads(target, attachment)

    def _next_use(self, image: str, aspect: str | None, run: PassRun) -> str | None:
        """What first happens to what a run stored, round the loop; None where nothing does.

        Where the order of the passes is not known, what any of them does that spares the contents
        most.
        """
        uses = self.uses(image, aspect)
        if not self.frame.document.ordered:
            effects = {effect for _, effect in uses}
            return next(
                (effect for effect in (READS, MAY_READ, OVERWRITES) if effect in effects), None
            )
        first = bisect_right(uses, run.begin_time, key=lambda use: use[0].time)
        if first < len(uses) and uses[first][0].run is run:
            first = self._after_run(image, aspect)[first]
        return uses[first][1] if first < len(uses) else uses[0][1] if uses else None

    def _after_run(self, image: str, aspect: str | None) -> list[int]:
        """For each of the `uses` of an image the next one that is not of the same run."""
        key = (image, aspect)
        if key not in self._others:
            uses = self.uses(image, aspect)
            following = [len(uses)] * len(uses)
            for index in range(len(uses) - 2, -1, -1):
                same = uses[index][0].run is uses[index + 1][0].run
                following[index] = following[index + 1] if same else index + 1
            self._others[key] = following
        return self._others[key]

    def _may_be_loaded(self, aspect: Aspect) -> bool:
        """Where the order is not known: whether some pass loads the aspect of a multisampled image
        that is not known either.
        """
        if self.frame.document.ordered:
            return False
        return (
            bool(self._loaded_strangers)
            if aspect.name is None
            else not self._loaded_strangers.isdisjoint((aspect.name, None))
        )

    @cached_property
    def _loaded_strangers(self) -> set[str | None]:
        """The aspects that some pass loads of multisampled images that are not known."""
        attachments = [
            attachment
            for render_pass in self.frame.passes
            for attachment in render_pass.attachments
            if attachment.used
        ]
        strangers = [
            each
            for each in attachments
            if each.target is not None
            and _is_stranger(each.target)
            and (each.samples or (2 if each.target.image is None else 1)) > 1
        ]
        return {
            aspect.name
            for attachment in strangers
            for aspect in attachment.aspects
            if aspect.load == "LOAD"
        }

    def _read_as_stated(
        self, target: Target, attachment: Attachment, aspect: Aspect
    ) -> bool | None:
        """Whether what a pass that is never begun stores has a reader: its usage allows one, or
        something that is described reads.
        """
        if target.image is None:
            return None
        key = (target.name, aspect.name, bool(attachment.input))
        if key not in self._stated:
            idle = (
                _effect(event)
                for event in self.timeline.idle.get(target.name, ())
                if same_aspect(event.aspect, aspect.name)
            )
            read = READS in idle or any(
                effect == READS for _, effect in self.uses(target.name, aspect.name)
            )
            self._stated[key] = (
                True
                if read
                else None
                if target.image.mayBeRead
                else _usage_reads(target, attachment)
            )
        return self._stated[key]

    @cached_property
    def _stores(self) -> dict[str, list[Event]]:
        return {
            key: [event for event in events if _leaves_contents(event)]
            for key, events in self.timeline.of.items()
        }

    def stored_before(
        self, render_pass: Pass, attachment: Attachment, aspect: Aspect
    ) -> Store | None:
        """Which pass stored what an attachment loads, round the loop; None where none did, or where
        that differs from time to time.
        """
        last = self._store_before(render_pass, attachment, aspect)
        return (
            Store(last.run.render_pass, last.place)
            if last is not None and last.run is not None
            else None
        )

    def _store_before(
        self, render_pass: Pass, attachment: Attachment, aspect: Aspect
    ) -> Event | None:
        runs = self.timeline.walk.runs_of(render_pass)
        if aspect.load != "LOAD" or len(runs) != 1 or attachment.target is None:
            return None
        key = (key_of(attachment.target), aspect.name)
        if key not in self._stores_of:
            self._stores_of[key] = [
                event
                for event in self._stores.get(key[0], ())
                if same_aspect(event.aspect, aspect.name)
            ]
        stores = self._stores_of[key]
        # Round the loop: index -1 is the last one of the frame.
        last = (
            stores[bisect_left(stores, runs[0].begin_time, key=lambda event: event.time) - 1]
            if stores
            else None
        )
        if (
            last is None
            or last.run is None
            or last.kind not in (STORE, RESOLVE_WRITE)
            or not last.certain
        ):
            return None
        return last

    def forced_store(
        self, render_pass: Pass, attachment: Attachment, aspect: Aspect
    ) -> Attachment | None:
        """The attachment whose store nothing needs but the load of this one, round the loop; None
        where something else does, or may.
        """
        last = self._store_before(render_pass, attachment, aspect)
        if (
            last is None
            or not isinstance(last.source, Attachment)
            or last.run is None
            or not self.timeline.ordered
        ):
            return None
        target = attachment.target
        image = target.image if target is not None else None
        may_be_read = image is not None and (
            image.mayBeRead
            or (
                not self.frame.has_commands
                and (image.presentable or usage_reads(image, bool(attachment.input)))
            )
        )
        if (
            target is None
            or may_be_read
            or len(self.timeline.walk.runs_of(last.run.render_pass)) != 1
        ):
            return None
        (run,) = self.timeline.walk.runs_of(render_pass)
        events = self.timeline.of[key_of(target)]
        number = bisect_left(events, last.time, key=lambda event: event.time)
        while events[number] is not last:
            number += 1
        loaded = False
        for step in range(1, len(events) + 1):
            event = events[(number + step) % len(events)]
            if not same_aspect(event.aspect, aspect.name):
                continue
            if event.kind == LOAD and event.run is run:
                loaded = True
            elif loaded and event.kind in (STORE, DISCARD) and _replaces(event):
                return last.source
            elif _effect(event) is not None and not _reads_input_attachment(event, target):
                return last.source if loaded and _effect(event) == OVERWRITES else None
        return None


def _is_stranger(target: Target) -> bool:
    """Whether an image is not known but for its count: it may be any other such image."""
    return target.image is None or not (
        target.image.states("format") or target.image.states("usage")
    )


def same_aspect(one: str | None, other: str | None) -> bool:
    """Whether two aspects are one, or may be: None is all, or an unknown one."""
    return one is None or other is None or one == other


def _effect(event: Event) -> str | None:
    """What an event does to what was there; None where nothing, or nothing that is known to
    matter.
    """
    if event.kind in (LOAD, BEGIN):
        return _load_effect(event)
    if event.kind == ELSEWHERE:
        return MAY_READ
    if event.kind == RESOLVE_WRITE or event.kind == CLEAR:
        return OVERWRITES if event.certain and event.whole and event.frames is None else None
    return READS if event.kind in COMMAND_READS and event.command is not None else None


def _replaces(event: Event) -> bool:
    """Whether nothing is left after the end of a pass, or a barrier, of what was stored before."""
    partial = event.run.render_pass.partial_area if event.run is not None else False
    return event.certain and event.frames is None and (event.whole or partial is None)


def _reads_input_attachment(event: Event, target: Target | None) -> bool:
    """Whether a shader reads an attachment of the pass around it, which the load operation of that
    pass filled: by the access, or since the usage allows no other read.
    """
    if event.command is None or not isinstance(event.command.body, ReadImage):
        return False
    access = event.command.body.access
    usage = target.image.usage if target is not None and target.image is not None else None
    only = (
        usage is not None
        and "INPUT_ATTACHMENT" in usage
        and {"SAMPLED", "STORAGE"}.isdisjoint(usage)
    )
    return access == "INPUT_ATTACHMENT_READ" or (access is None and only)


def _effect_after(before: Event, event: Event) -> str | None:
    """The `_effect` of an event after another: after a barrier from UNDEFINED, what is written in
    part leaves nothing of the rest.
    """
    if (
        discards_all(before)
        and event.certain
        and event.frames is None
        and event.kind in (BEGIN, *COMMAND_WRITES)
    ):
        return OVERWRITES
    return _effect(event)


def _load_effect(event: Event) -> str | None:
    attachment = event.source
    assert isinstance(attachment, Attachment)
    if event.kind == LOAD and event.certain:
        return READS
    if not attachment.used:
        return MAY_READ
    # Of images that alternate from frame to frame, each is left as it was in every other frame.
    overwrites = OVERWRITES if event.whole and event.frames is None else None
    if event.kind == BEGIN or any(
        event.aspect in aspects for aspects in attachment.resolve.values()
    ):
        return overwrites
    return MAY_READ if attachment.drawn or attachment.resolve else READS


def _leaves_contents(event: Event) -> bool:
    """Whether an event decides what a later load finds."""
    if event.command is not None:
        return event.kind in COMMAND_WRITES or event.kind == DISCARD
    if isinstance(event.source, Resolve):
        # In a render pass the target's store operation decides.
        return event.kind == RESOLVE_WRITE and event.source.kind == RENDERING
    return event.kind in (STORE, DISCARD, ELSEWHERE)


def _usage_reads(target: Target, attachment: Attachment) -> bool | None:
    """What the usage alone says of readers after a pass; what is an input attachment of the pass
    has INPUT_ATTACHMENT for that.
    """
    return (
        None
        if target.image is None
        else usage_reads(target.image, input_attachment=bool(attachment.input))
    )


def usage_reads(image: Image, input_attachment: bool) -> bool | None:
    """Whether a usage allows reads from memory; that of an input attachment is read within its
    pass.
    """
    if image.usage is None:
        return None
    reading = READING_USAGES - {"INPUT_ATTACHMENT"} if input_attachment else READING_USAGES
    return not reading.isdisjoint(image.usage)
