"""Frames: the submitted commands from one present to the next, grouped into kinds.

Frames are of the same kind if they begin the same passes in the same order on equally created
images. The contents of a pass are merged over all frames of a kind; between passes, the most
frequent sequence of commands represents the kind.
"""

from __future__ import annotations

from collections.abc import Hashable
from itertools import count

from .call import Place
from .command_buffers import MAX_COMMANDS, CommandBuffer, CommandCache, RecordedCommand
from .frame_boundary import aspect_uses
from .frame_ends import FrameLabel, Repetitions, passes_of
from .frame_kinds import (
    MAX_MERGED,
    MAX_PASS_COMMANDS,
    AspectState,
    DistinctFrame,
    FrameKind,
    Merged,
    Role,
    add_counts,
    merge,
    segments_of,
    shape_of,
)
from .labels import MAX_PASSES, BufferLabels, FrameLabels, Path
from .layouts import ImageLayouts
from .objects import Image
from .set_reads import SetReads
from .submissions import MAX_REPEATED, Executions, Submission, parts_of

MAX_KINDS = 32
"""Maximum number of frame kinds."""

MAX_DISTINCT_FRAMES = 1024
"""Maximum number of different frames in the cache."""

MAX_RECENT_FRAMES = 64
"""Maximum number of frames that are recognized by their submissions."""

MAX_STORED_COMMANDS = 100_000
"""Maximum total number of commands of these frames."""

PASS_WEIGHT = 16
"""A command that begins a pass counts as so many: it keeps a framebuffer and its images."""

MAX_CANDIDATES = 4096
"""Maximum number of kinds of frames that are counted in order to keep the most frequent ones."""

MAX_FOREIGN = 1024
"""Maximum number of images for each kind of frame that no pass uses, and that it reads from earlier
frames or leaves to later ones.
"""

MAX_FRAME_COMMANDS = 200_000
"""Maximum number of commands per frame."""

MAX_DESCRIBED = 100_000
MAX_DESCRIBED_TOTAL = 300_000
"""Maximum number of commands of all kinds of frames, beyond those that the capture records, because
frames that share commands repeat them; and in total.
"""

WORK = 2_000_000
WORK_PER_SUBMISSION = 2048
WORK_PER_COMMAND = 16
"""The number of commands, and of images in descriptor sets, that are looked at: so many, and so
many more for each submission of a command buffer and for each command that it records. Further
frames are not linted: command buffers that execute others, and sets that are bound again, can make
them grow faster than the capture.
"""

REPEATED = (
    f"a frame executes command buffers again that have {MAX_REPEATED:,} commands together; "
    "further repetitions are not checked"
)
TOO_LONG = (
    f"a frame has more than {MAX_FRAME_COMMANDS:,} commands; those after them are not checked"
)
TOO_MANY_RECORDED = (
    f"a command buffer records more than {MAX_COMMANDS:,} commands; those after "
    "them are not checked"
)
TOO_MANY_IN_PASS = (
    f"a pass has more than {MAX_PASS_COMMANDS:,} different commands; those after "
    "them are not checked"
)
TOO_MANY_MERGED = (
    f"later frames add more than {MAX_MERGED:,} commands to the passes of earlier "
    "ones; those after them are not checked"
)
TOO_MUCH_WORK = (
    "frames execute far more commands, or read far more images, than the capture "
    "records; some of them are not checked"
)
"""The limits, as findings state them."""


class Frames:
    """Collects the frames of a capture."""

    def __init__(self) -> None:
        self.kinds: dict[Hashable, FrameKind] = {}
        self.total = 0
        self.dropped = 0
        """The number of frames whose kind was not kept."""
        self.presents = False
        self.frame_end: str | None = None
        """What the user says ends a frame: `present`, `submit`, or `label`."""
        self.frame_label: FrameLabel | None = None
        self._is_openxr = False
        self.is_marked = False
        """Whether a frame ended at a present, mark, or label."""
        self._has_pass = False
        """Whether the current frame begins a pass."""
        self.frameless = False
        self.truncated = False
        self.limits: dict[str, Place] = {}
        """What is not checked because it exceeds a limit, with the first call that does."""
        self._current: list[Submission] = []
        self._labels: list[Path] = []
        """The debug labels of the current frame's passes."""
        self.labels = FrameLabels()
        self._length = 0
        self._is_skipped = False
        """Whether the current frame is not looked at."""
        self._executions = Executions()
        self._reads = SetReads(self.spend)
        self._work_left = WORK
        self._recorded = 0
        """The number of commands in submitted command buffers, each counted once."""
        self._described = 0
        """The number of commands in the first frames of the kinds."""
        self.repetitions = Repetitions()
        """The passes of the current frame, by which it is seen to end if nothing marks that."""
        self._recent: dict[tuple[Submission, ...], DistinctFrame] = {}
        """Frames by what they submit, to recognize command buffers that are submitted in every
        frame.
        """
        self._recent_commands = 0
        self._candidates: dict[int, int] = {}
        """The number of frames of kinds that are not kept, by the hash of the kind."""
        self._kind_numbers = count()
        self._merged = Merged()
        self._distinct: dict[Hashable, DistinctFrame] = {}
        self._stored_commands = 0
        """The number of commands in the cached frames."""
        self._last: DistinctFrame | None = None
        self._repetitions = 0
        """How often the last frame repeated in a row."""

    def mark(self, kind: str) -> None:
        """Processes a mark."""
        if kind == "frameless":
            self.frameless = True
            self.frame_label = None
        elif kind == "truncated":
            self.truncated = True
        elif kind == "frame" and not self.presents and self.frame_end is None:
            self.is_marked = True
            self.end()

    def end_of_present(self) -> None:
        """A present ends the frame, unless OpenXR does: a program then also shows what it draws in
        a window.
        """
        if self.frame_end in (None, "present") and not self._is_openxr:
            self.is_marked = True
            self.end()

    def start_openxr(self) -> None:
        """xrEndFrame ends frames from now on."""
        self.presents = self._is_openxr = True

    def end_of_openxr_frame(self) -> None:
        """xrEndFrame ends the frame."""
        self._is_openxr = True
        if self.frame_end in (None, "present"):
            self.is_marked = True
            self.end()

    def label_mark(self, mark: str) -> None:
        """The label that ends frames begins, ends, or is inserted."""
        label = self.frame_label
        if label is None:
            return
        if self._has_pass and label.ends_frame(mark):
            self.is_marked = True
            self.end()
        label.follow(mark)

    def spend(self, work: int) -> bool:
        """Takes so much from the work that is left; False if there is none."""
        self._work_left -= work
        return self._work_left >= 0

    def start_submission(self, buffers: list[CommandBuffer]) -> None:
        """Starts a submission of command buffers, which may end the frame."""
        for buffer in buffers:
            self._work_left += WORK_PER_SUBMISSION
            if not buffer.counted:
                buffer.counted = True
                self._recorded += len(buffer.commands)
                self._work_left += WORK_PER_COMMAND * len(buffer.commands)
        if self.frame_end == "submit" and not self.frameless:
            executions = Executions()
            if self._has_pass and any(executions.submission(buffer).begins for buffer in buffers):
                self.end()
        elif (
            self.frame_end is None
            and not self.presents
            and not self.is_marked
            and not self.frameless
        ):
            self._split_frames(buffers)

    def submit(
        self,
        buffer: CommandBuffer,
        at: Place,
        cache: CommandCache,
        layouts: ImageLayouts,
        outer: Path = (),
    ) -> None:
        """Adds what a command buffer executes. `layouts` follows it; `outer` are the debug labels
        that are open at its beginning.
        """
        submission = self._executions.submission(buffer)
        if buffer.omitted:
            self.limits.setdefault(TOO_MANY_RECORDED, at)
        if not self._executions.is_complete:
            self.limits.setdefault(REPEATED, at)
        if (buffer.reads or submission is not buffer.submission) and not self.spend(
            len(submission.commands)
        ):
            return self._skip(at)
        if buffer.reads:
            commands = self._reads.resolve(submission.commands, cache, layouts)
            if commands is None:
                return self._skip(at)
            submission = Submission(commands)
        else:
            if submission.layout_changes is None:
                submission.layout_changes = layouts.net_changes(submission.commands)
            if not self.spend(len(submission.layout_changes)):
                return self._skip(at)
            layouts.apply(submission.layout_changes)
        self.add(submission, at, buffer.labels, outer)

    def add(
        self,
        submission: Submission,
        at: Place,
        labels: BufferLabels | None = None,
        outer: Path = (),
    ) -> None:
        """Adds commands to the current frame."""
        self._length += len(submission.commands)
        if self._length > MAX_FRAME_COMMANDS:
            self.limits.setdefault(TOO_LONG, at)
            return
        count = len(submission.begins)
        is_labeled = labels is not None and labels.is_complete and len(labels.passes) == count
        paths = (
            labels.paths(outer)
            if labels is not None and is_labeled
            else [()] * min(count, MAX_PASSES)
        )
        first = 0
        for part, mark in (
            parts_of(submission) if self.frame_label is not None else ((submission, ""),)
        ):
            self._current.append(part)
            self._labels += paths[first : first + len(part.begins)]
            first += len(part.begins)
            self._has_pass = self._has_pass or bool(part.begins)
            if mark:
                self.label_mark(mark)

    def _skip(self, at: Place) -> None:
        """Gives up the current frame: looking at it would take too long."""
        self._is_skipped = True
        self.limits.setdefault(TOO_MUCH_WORK, at)

    def _split_frames(self, buffers: list[CommandBuffer]) -> None:
        """Ends the frame if a submission of command buffers repeats its passes."""
        executions = Executions()
        passes = [each for buffer in buffers for each in passes_of(executions.submission(buffer))]
        if passes:
            if self.repetitions.repeats(passes):
                self.end()
            self.repetitions.add(passes)

    def end_of_capture(self) -> None:
        """Ends the capture. The remaining commands are a frame if they begin a pass, unless what
        ends frames is missing.
        """
        if self._has_pass and not (self.is_marked and self.total):
            self.end()
        elif self.is_marked and not self._is_skipped:
            # What they read is not stored in vain.
            commands = [command for submission in self._current for command in submission.commands]
            self._track_contents(FrameKind(-1, [], [], 0), commands, {})
        self._add_counts()

    def end(self) -> None:
        """Ends the frame."""
        submissions, labels, is_skipped = tuple(self._current), self._labels, self._is_skipped
        self._current = []
        self._has_pass = False
        self._labels = []
        self._length = 0
        self._is_skipped = False
        self._executions = Executions()
        self._reads = SetReads(self.spend)
        self.repetitions.clear()
        self.total += 1
        if is_skipped:
            return
        frame = self._recent.get(submissions)
        if frame is None:
            frame = self._frame_of(
                [command for submission in submissions for command in submission.commands]
            )
            if frame is None:
                return
            if frame.kind is None:
                frame.count = 1
                add_counts(frame)
                return
            self._recent_commands += frame.weight
            if (
                len(self._recent) >= MAX_RECENT_FRAMES
                or self._recent_commands > MAX_STORED_COMMANDS
            ):
                self._recent.clear()
                self._recent_commands = frame.weight
            self._recent[submissions] = frame
        elif frame.kind is not None and self._repetitions < 2:
            self._track_contents(
                frame.kind,
                frame.commands,
                {image: Role(number) for number, image in enumerate(frame.images)},
            )
        if frame.kind is not None:
            self.labels.observe(labels, frame.kind.labels)
            frame.kind.labels = frame.kind.labels or labels
            for image, described in zip(frame.images, frame.kind.images, strict=False):
                described.may_be_read = described.may_be_read or image.may_be_read
        frame.count += 1
        self._repetitions = self._repetitions + 1 if frame is self._last else 0
        self._last = frame

    def _frame_of(self, commands: list[RecordedCommand]) -> DistinctFrame | None:
        """The frame with these commands; None if it has no pass."""
        key = tuple(map(id, commands))
        frame = self._distinct.get(key)
        if frame is not None:
            if frame.kind is not None and self._repetitions < 2:
                self._track_contents(
                    frame.kind,
                    commands,
                    {image: Role(number) for number, image in enumerate(frame.images)},
                )
            return frame
        frame = self._classify(commands)
        if frame is not None and frame.kind is not None:
            frame.weight = len(commands) + PASS_WEIGHT * len(frame.kind.passes)
            self._stored_commands += frame.weight
            if (
                len(self._distinct) >= MAX_DISTINCT_FRAMES
                or self._stored_commands > MAX_STORED_COMMANDS
            ):
                self._add_counts()
                self._distinct.clear()
                self._recent.clear()
                self._stored_commands = frame.weight
            self._distinct[key] = frame
        return frame

    def _add_counts(self) -> None:
        for frame in self._distinct.values():
            add_counts(frame)

    def _classify(self, commands: list[RecordedCommand]) -> DistinctFrame | None:
        """Classifies a new frame; None if it has no pass."""
        parts = segments_of(commands)
        passes = [begin for begin, _ in parts if begin is not None]
        if not passes:
            return None
        self._repetitions = 0
        roles: dict[Image, Role] = {}
        shape = tuple(shape_of(begin, roles) for begin in passes)
        kind = self.kinds.get(shape)
        if kind is None and self._has_room(shape, len(commands)):
            self._described += len(commands)
            kind = self.kinds[shape] = FrameKind(
                next(self._kind_numbers), list(roles), passes, len(commands)
            )
            kind.count = self._candidates.pop(hash(shape), 0)
            self.dropped -= kind.count
        gaps: list[list[RecordedCommand]] = []
        if kind is not None:
            gaps = merge(kind, parts, roles, self._merged)
            if not kind.is_complete:
                self.limits.setdefault(
                    TOO_MANY_MERGED if self._merged.count >= MAX_MERGED else TOO_MANY_IN_PASS,
                    commands[0].at,
                )
            self._track_contents(kind, commands, roles)
        else:
            self.dropped += 1
            if len(self._candidates) >= MAX_CANDIDATES:
                self._candidates = {
                    key: count for key, count in self._candidates.items() if count > 1
                }
            if len(self._candidates) < MAX_CANDIDATES:
                self._candidates[hash(shape)] = self._candidates.get(hash(shape), 0) + 1
        return DistinctFrame(kind, commands, roles, gaps)

    def _has_room(self, shape: Hashable, length: int) -> bool:
        """Whether another kind of frame is kept, whose first frame has so many commands. It may
        replace the least frequent one.
        """
        limit = min(MAX_DESCRIBED + self._recorded, MAX_DESCRIBED_TOTAL)
        if len(self.kinds) < MAX_KINDS and self._described + length <= limit:
            return True
        count = self._candidates.get(hash(shape), 0)
        if not self.kinds or count < 1 or count & (count - 1):
            return False
        # Adding the counts takes time, so this is tried after 1, 2, 4, 8 ... frames.
        self._add_counts()
        rarest_shape, rarest = min(self.kinds.items(), key=lambda item: item[1].count)
        if rarest.count > count or self._described - rarest.length + length > limit:
            return False
        del self.kinds[rarest_shape]
        self._described -= rarest.length
        self.dropped += rarest.count
        self._distinct = {
            key: frame for key, frame in self._distinct.items() if frame.kind is not rarest
        }
        self._stored_commands = sum(frame.weight for frame in self._distinct.values())
        self._recent.clear()
        return True

    def _track_contents(
        self, kind: FrameKind, commands: list[RecordedCommand], roles: dict[Image, Role]
    ) -> None:
        """Updates what frames read from earlier ones, and the state in which this one leaves its
        images.
        """
        for image, uses in aspect_uses(commands).items():
            role = roles.get(image, image)
            for aspect, use in uses.items():
                state: AspectState | None = image.aspect_states.get(aspect)
                if use.first == "read":
                    if state is not None and state.state == "unread":
                        read = (state.role, aspect)
                        if isinstance(state.role, Role) or len(state.kind.later) < MAX_FOREIGN:
                            state.kind.later[read] = (
                                state.kind.later.get(read, False) or use.is_fetched
                            )
                    reads = (
                        kind.undefined
                        if state is not None and state.state == "discarded"
                        else kind.defined
                    )
                    if isinstance(role, Role) or len(reads) < MAX_FOREIGN:
                        reads.add((role, aspect))
                if use.last is not None:
                    image.aspect_states[aspect] = AspectState(use.last, kind, role)
                elif use.first == "read" and state is not None and state.state == "unread":
                    image.aspect_states[aspect] = state._replace(state="read")
