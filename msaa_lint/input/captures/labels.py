"""Debug labels: the regions that command buffers and queues open, which name the passes that begin
within them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from copy import copy

MAX_TEXT = 80
"""Maximum length of a name or label, in characters."""

MAX_PATH = 120
"""Maximum length of the labels of a pass together, in characters."""

MAX_DEPTH = 16
"""Maximum number of labels that are open at a time; inner ones are not followed."""

MAX_PASSES = 1024
"""Maximum number of passes of a command buffer whose labels are followed: a command buffer may be
submitted again and again.
"""

MAX_VARYING = 1024
"""Maximum number of labels that are known to change from frame to frame."""

SEPARATOR = " / "

Path = tuple[str, ...]
"""The labels around a pass, the outermost first."""

_NUMBER = re.compile(r"0[xX][0-9a-fA-F]+|\d+")


def printable(text: str) -> str:
    """A name or label without what a terminal or an editor would not show, on one line, and no
    longer than MAX_TEXT.
    """
    words = "".join(
        char if char.isprintable() else " " if char.isspace() else "\ufffd"
        for char in text[: 4 * MAX_TEXT]
    ).split()
    joined = " ".join(words)
    return joined if len(joined) <= MAX_TEXT else f"{joined[: MAX_TEXT - 3].rstrip()}..."


NO_LABELS: tuple[int, Path] = (0, ())


class BufferLabels:
    """The labels of a command buffer.

    `passes` has one entry for each pass that the buffer begins: how many labels of earlier command
    buffers have ended by then, and the labels that are open. An inserted label counts for the pass
    that follows it, and a label that begins before the first draw of a pass for that pass, unless
    another one follows beside it.
    """

    __slots__ = (
        "_deeper",
        "_depth",
        "_in_pass",
        "_inserted",
        "_lead",
        "_outer",
        "ended",
        "is_complete",
        "open",
        "passes",
    )

    def __init__(self) -> None:
        self.ended = 0
        self.open: list[str] = []
        self._deeper = 0
        """The number of labels that are open within these."""
        self.passes: list[tuple[int, Path]] = []
        self.is_complete = True
        """Whether `passes` has an entry for each pass."""
        self._inserted = ""
        self._in_pass = False
        self._lead: str | None = None
        """The label that the command buffer begins with; empty if it has none, None before the
        first label.
        """
        self._depth = -1
        """The number of open labels when a label that counts for the current pass began; -1 before
        the first label in the pass.
        """
        self._outer = NO_LABELS
        """The entry of the current pass without that label."""

    def copy(self) -> BufferLabels:
        """Equal labels, which change on their own."""
        labels = copy(self)
        labels.open, labels.passes = self.open.copy(), self.passes.copy()
        return labels

    def begin(self, text: str, pass_is_empty: bool) -> None:
        """Opens a label. `pass_is_empty`: the current pass has no draw so far."""
        depth = len(self.open) + self._deeper
        if self._in_pass:
            self._begin_in_pass(text, depth, pass_is_empty)
        elif not depth and not self.passes:
            is_lead = pass_is_empty if self._lead is None else text == self._lead
            self._lead = text if is_lead else ""
        self._inserted = ""
        if depth < MAX_DEPTH:
            self.open.append(text)
        else:
            self._deeper += 1

    def _begin_in_pass(self, text: str, depth: int, pass_is_empty: bool) -> None:
        """Counts a label for the current pass if it is the first or, beside that, the same
        again.
        """
        if not self.passes:
            return
        if self._depth < 0:
            self._depth = depth if pass_is_empty and text else MAX_DEPTH
            if self._depth == depth:
                self._outer = self.passes[-1]
                self.passes[-1] = (self._outer[0], (*self._outer[1], text))
        elif self._depth == depth and self.passes[-1][1][-1:] != (text,):
            self.passes[-1] = self._outer
            self._depth = MAX_DEPTH

    def end(self) -> None:
        """Closes a label, of this command buffer or of an earlier one."""
        self._inserted = ""
        if self._deeper:
            self._deeper -= 1
        elif self.open:
            self.open.pop()
        else:
            self.ended += 1

    def insert(self, text: str) -> None:
        """Sets a label for the next pass."""
        if not self._in_pass:
            self._inserted = text

    def boundary(self, begins: bool) -> None:
        """The beginning or the end of a pass."""
        self._in_pass = begins
        self._depth = -1
        if not begins:
            return
        path: tuple[int, Path] = NO_LABELS
        if self.open or self.ended or self._inserted:
            path = (self.ended, (*self.open, *filter(None, (self._inserted,))))
        self._inserted = ""
        self._add((path,))

    def execute(self, executed: BufferLabels, pass_is_empty: bool) -> None:
        """Adds the passes of a secondary command buffer, or the label that it begins with, if it
        continues the current pass.
        """
        if self._in_pass:
            self._begin_in_pass(executed._lead or "", len(self.open) + self._deeper, pass_is_empty)
        self.is_complete = self.is_complete and executed.is_complete
        self._add(
            [
                (self.ended + max(ended - len(self.open), 0), inner_path(self.open, ended, path))
                for ended, path in executed.passes
            ]
            if self.is_complete
            else ()
        )

    def paths(self, outer: Path) -> list[Path]:
        """The labels of the passes if these `outer` labels are open at the beginning of the command
        buffer.
        """
        return [inner_path(outer, *entry) for entry in self.passes]

    def _add(self, passes: Sequence[tuple[int, Path]]) -> None:
        if len(self.passes) + len(passes) <= MAX_PASSES:
            self.passes += passes
        else:
            self.is_complete = False


def inner_path(outer: Sequence[str], ended: int, path: Iterable[str]) -> Path:
    """The labels around something within other labels, of which so many have ended by then."""
    if not ended and not outer:
        return tuple(path)[:MAX_DEPTH]
    return (*outer[: max(len(outer) - ended, 0)], *path)[:MAX_DEPTH]


class FrameLabels:
    """Which labels change from frame to frame, such as `Frame 123`: those that differ only in
    numbers. They name no pass.
    """

    def __init__(self) -> None:
        self._varying: set[tuple[int, str]] = set()
        self._last: list[Path] = []

    def observe(self, labels: list[Path], before: list[Path]) -> None:
        """Compares the labels of a frame's passes with those of an earlier frame of its kind, and
        the first one with the last frame's.
        """
        if labels != before:
            # Many passes share their outer labels.
            different = {
                (depth, *texts)
                for paths in zip(labels, before, strict=False)
                if paths[0] != paths[1]
                for depth, texts in enumerate(zip(*paths, strict=False))
            }
            self._compare(different)
        if self._last and labels and self._last[0][:1] != labels[0][:1]:
            self._compare(
                (0, *texts) for texts in zip(labels[0][:1], self._last[0][:1], strict=False)
            )
        self._last = labels

    def _compare(self, different: Iterable[tuple[int, str, str]]) -> None:
        """Compares labels with those at the same depth of the same pass of another frame."""
        for depth, text, text_before in different:
            if text != text_before and len(self._varying) < MAX_VARYING:
                pattern = _NUMBER.sub("#", text)
                if pattern == _NUMBER.sub("#", text_before):
                    self._varying.add((depth, pattern))

    def name(self, path: Path) -> str:
        """The name of a pass with these labels: those that do not change, joined; the innermost
        ones if that is too long.
        """
        texts = [
            text
            for depth, text in enumerate(path)
            if text and (depth, _NUMBER.sub("#", text)) not in self._varying
        ]
        name = SEPARATOR.join(texts)
        while len(name) > MAX_PATH and len(texts) > 1:
            del texts[0]
            name = SEPARATOR.join(("...", *texts))
        return name
