"""The images that each command of a frame uses, and the usages that it needs."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Iterator

from msaa_lint.frame.description.models import Command
from msaa_lint.frame.facts.commands import accesses, naming_records
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.pass_begin import is_followed, targets_at

COMMAND_USAGES = frozenset({"TRANSFER_SRC", "TRANSFER_DST", "SAMPLED", "STORAGE"})
"""The usages whose need can be seen from the commands alone."""


class CommandUses:
    """The uses of images by commands. Empty, with `complete` False, for a frame with more uses than
    are tracked.
    """

    def __init__(self, frame: Frame) -> None:
        self._usages: dict[str, Counter[str]] = {}
        self._positions: dict[str, list[int]] = {}
        self._command_positions: dict[str, list[int]] = {}
        self.barriers: dict[str, list[int]] = {}
        """The positions of the barriers that name an image."""
        self.complete = is_followed(frame)
        self.positions: dict[int, int] = {}
        """The position of each command, by the identity of its parameters."""
        begins = {position: begun for begun in frame.passes for position in begun.begun}
        for position, command in enumerate(frame.commands if self.complete else ()):
            self.positions[id(command.body)] = position
            names = {name for _, name in naming_records(command)}
            if position in begins:
                attachments = begins[position].attachments
                names.update(
                    target.name
                    for attachment in attachments
                    for target in targets_at(frame, attachment, position)
                )
            by_kind = (
                self.barriers if command.kind == "pipelineBarrier" else self._command_positions
            )
            for name in names:
                self._positions.setdefault(name, []).append(position)
                by_kind.setdefault(name, []).append(position)
            for name, usage in _needed_usages(command):
                self._usages.setdefault(name, Counter())[usage] += 1

    def needed_usages(self, name: str, without: Command | None = None) -> set[str]:
        """The usages that the commands, except `without`, require of an image. A read counts as
        both SAMPLED and STORAGE.
        """
        counts = Counter(self._usages.get(name, {}))
        if without is not None:
            counts.subtract(usage for image, usage in _needed_usages(without) if image == name)
        return {usage for usage, count in counts.items() if count > 0}

    def next_use(self, name: str, position: int) -> int | None:
        """The position of the first command after `position` that uses an image."""
        return _following(self._positions.get(name, []), position)

    def next_use_of_commands(self, name: str, position: int) -> int | None:
        """The same, without barriers."""
        return _following(self._command_positions.get(name, []), position)

    def used_between(self, name: str, start: int, end: int) -> bool:
        """Whether a command other than a barrier, from `start` up to, but not including, `end`,
        uses an image.
        """
        positions = self._command_positions.get(name, [])
        first = bisect_left(positions, start)
        return first < len(positions) and positions[first] < end


def _following(positions: list[int], position: int) -> int | None:
    following = bisect_right(positions, position)
    return positions[following] if following < len(positions) else None


def _needed_usages(command: Command) -> Iterator[tuple[str, str]]:
    return ((name, usage) for name, access in accesses(command) for usage in access.usages)
