"""One walk over a frame's commands: which pass runs around each of them, and in which subpass."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

from msaa_lint.frame.description.models import Command

from .commands import END_COMMANDS
from .frame import Frame
from .parts import Pass


class PassRun:
    """One run of a pass. `position` is that of the command that begins it, None where no commands
    are stated.

    Times are twice the position of a command, and one more for what follows it. `starts` and `ends`
    are the times of the subpasses; `commands` are the commands recorded in the run, each with its
    subpass.
    """

    __slots__ = ("commands", "ends", "position", "render_pass", "starts")

    def __init__(self, render_pass: Pass, position: int | None, start: int) -> None:
        self.render_pass = render_pass
        self.position = position
        self.starts = [start]
        self.ends: list[int] = []
        self.commands: list[tuple[int, Command]] = []

    @property
    def begin_time(self) -> int:
        """When load operations run."""
        return self.starts[0] - 1

    @property
    def end_time(self) -> int:
        """When store operations run."""
        return self.ends[-1]

    def finish(self, time: int) -> None:
        """Ends the run, with as many subpasses as its pass has."""
        count = max(len(self.render_pass.subpasses), 1)
        self.starts = [*self.starts, *[time] * (count - len(self.starts))][:count]
        self.ends = [*self.ends, *[time] * (count - len(self.ends))][:count]


class Step(NamedTuple):
    """A command where it is recorded: the run that it begins, ends or belongs to (None outside of
    passes), and the subpass.
    """

    position: int
    command: Command
    run: PassRun | None
    subpass: int

    @property
    def begins(self) -> bool:
        """Whether the command begins its run."""
        return self.run is not None and self.run.position == self.position

    @property
    def ends(self) -> bool:
        """Whether the command ends a pass."""
        return self.command.kind in END_COMMANDS


class Walk:
    """The commands of a frame in order, and the runs of its passes."""

    def __init__(self, frame: Frame) -> None:
        self.frame = frame

    @cached_property
    def steps(self) -> list[Step]:
        """Every command."""
        return list(self._walk())

    @cached_property
    def recorded_runs(self) -> dict[int, PassRun]:
        """The runs that the commands begin, in order, by the positions where they begin."""
        return {
            step.position: step.run for step in self.steps if step.begins and step.run is not None
        }

    @cached_property
    def runs(self) -> list[PassRun]:
        """The runs of the passes; where no commands are stated, or their order is unknown, every
        pass runs once, in order.
        """
        return list(
            self.recorded_runs.values() if self.frame.has_commands else once_each(self.frame.passes)
        )

    @cached_property
    def suspended(self) -> dict[int, Pass]:
        """By the identity of a resumed rendering: the suspended one, which is the one before
        (VUID-VkSubmitInfo2-commandBuffer-06012).
        """
        passes = (
            [run.render_pass for run in self.recorded_runs.values()]
            if self.frame.has_commands
            else []
        )
        return {id(other): one for one, other in pairwise(passes) if one.suspends and other.resumes}

    def runs_of(self, render_pass: Pass) -> list[PassRun]:
        """Those of `runs` that are of a pass."""
        return (
            self.recorded_runs_of(render_pass)
            if self.frame.has_commands
            else [self._only_runs[id(render_pass)]]
        )

    @cached_property
    def _only_runs(self) -> dict[int, PassRun]:
        return {id(run.render_pass): run for run in self.runs}

    def recorded_runs_of(self, render_pass: Pass) -> list[PassRun]:
        """Those of `recorded_runs` that are of a pass."""
        return self._runs_of.get(id(render_pass), [])

    @cached_property
    def _runs_of(self) -> dict[int, list[PassRun]]:
        found: dict[int, list[PassRun]] = {}
        for run in self.recorded_runs.values():
            found.setdefault(id(run.render_pass), []).append(run)
        return found

    def _walk(self) -> Iterator[Step]:
        begins = {
            position: render_pass
            for render_pass in self.frame.passes
            for position in render_pass.begun
        }
        run: PassRun | None = None
        subpass = 0
        for position, command in enumerate(self.frame.commands):
            if position in begins:
                if run is not None:
                    run.finish(2 * position - 1)
                run, subpass = PassRun(begins[position], position, 2 * position + 1), 0
            elif run is not None and command.kind in END_COMMANDS:
                run.finish(2 * position)
                yield Step(position, command, run, subpass)
                run = None
                continue
            elif run is not None:
                if command.kind == "nextSubpass":
                    subpass += 1
                    run.ends.append(2 * position)
                    run.starts.append(2 * position + 1)
                run.commands.append((subpass, command))
            yield Step(position, command, run, subpass)
        if run is not None:
            run.finish(2 * len(self.frame.commands))


def once_each(passes: list[Pass]) -> Iterator[PassRun]:
    """A run of every pass, in order."""
    position = 0
    for render_pass in passes:
        count = max(len(render_pass.subpasses), 1)
        times = range(2 * position, 2 * (position + count), 2)
        run = PassRun(render_pass, None, 2 * position + 1)
        run.starts, run.ends = [time + 1 for time in times], [time + 2 for time in times]
        yield run
        position += count + 1
