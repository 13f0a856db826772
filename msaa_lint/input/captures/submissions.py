"""What submitted command buffers execute in a frame, secondary command buffers included."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .command_buffers import PASS_BEGINS, PASS_ENDS, CommandBuffer, Execution, RecordedCommand

MAX_REPEATED = 20_000
"""Maximum number of commands that a frame executes again: those of command buffers that it has
executed before.
"""

Item = RecordedCommand | Execution


class Submission:
    """The commands that a command buffer executes, and those of them that begin passes."""

    __slots__ = ("begins", "commands", "layout_changes", "parts", "passes")

    def __init__(self, commands: list[RecordedCommand]) -> None:
        self.commands = commands
        self.begins = tuple(command for command in commands if command.kind in PASS_BEGINS)
        self.passes: tuple[Any, ...] | None = None
        """The identities of the passes; None until they are asked."""
        self.parts: list[tuple[Submission, str]] | None = None
        """The commands up to each mark of a frame's end, with the mark; None until that is
        asked.
        """
        self.layout_changes: Any = None
        """The changes of layouts that the commands make together; None until that is asked."""


def parts_of(submission: Submission) -> list[tuple[Submission, str]]:
    """The commands of a submission up to each mark of a frame's end, with the mark, and those after
    the last one, with an empty mark.

    A pass is not divided.
    """
    if submission.parts is None:
        submission.parts = []
        commands: list[RecordedCommand] = []
        pending: list[str] = []
        in_pass = False
        for command in submission.commands:
            if command.kind == "frameMark":
                pending.append(str(command.key))
            else:
                commands.append(command)
                in_pass = command.kind in PASS_BEGINS or (in_pass and command.kind not in PASS_ENDS)
            if pending and not in_pass:
                for mark in pending:
                    submission.parts.append((Submission(commands), mark))
                    commands = []
                pending.clear()
        submission.parts.append(
            (Submission(commands) if submission.parts or pending else submission, "")
        )
    return submission.parts


class Executions:
    """The command buffers that a frame executes. `is_complete` is False once a repetition was left
    out.
    """

    def __init__(self) -> None:
        self.executed: dict[int, list[Item]] = {}
        """The lists of commands so far, by identity."""
        self.repeated = 0
        self.is_complete = True

    def submission(self, buffer: CommandBuffer) -> Submission:
        """What a command buffer executes: the same object in every frame, unless it records
        more.
        """
        length = len(buffer.commands)
        cached: Submission | None = buffer.submission if buffer.submitted_length == length else None
        if cached is not None and self._may_execute(buffer.commands, len(cached.commands)):
            return cached
        complete, self.is_complete = self.is_complete, True
        if buffer.executes or cached is not None:
            commands = list(self._expand(Execution(buffer.commands, length)))
        else:
            self._may_execute(buffer.commands, length)
            commands = buffer.commands.copy()  # type: ignore[assignment]
        submission = Submission(commands)
        if self.is_complete:
            buffer.submission, buffer.submitted_length = submission, length
        self.is_complete = self.is_complete and complete
        return submission

    def _expand(self, execution: Execution) -> Iterator[RecordedCommand]:
        """The commands of an execution and those within it. There are no cycles: an execution is of
        what was recorded before it.
        """
        opened: list[Iterator[Item]] = []
        items = self._items(execution)
        while True:
            item = next(items, None)
            if item is None:
                if not opened:
                    return
                items = opened.pop()
            elif isinstance(item, Execution):
                opened.append(items)
                items = self._items(item)
            else:
                yield item

    def _items(self, execution: Execution) -> Iterator[Item]:
        commands, length = execution
        return iter(commands[:length] if self._may_execute(commands, length) else ())

    def _may_execute(self, commands: list[Item], length: int) -> bool:
        """Whether a list of commands is executed; not if the frame would repeat too many. `length`
        is the number of commands that count.
        """
        if id(commands) in self.executed:
            if self.repeated + length > MAX_REPEATED:
                self.is_complete = False
                return False
            self.repeated += length
        self.executed[id(commands)] = commands
        return True
