"""Which files of a project form a program.

The files of a folder belong together, except those with a `main`: each of these is a program, which
uses the other files of its folder and the files that it includes, with the sources that define what
these declare. Folders that include each other belong together as well. What several programs use is
a library, a program of its own: it is reported once, and the programs see its definitions.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.input.code.mentions import is_api

from .includes import Includes
from .index import Words, is_header

MAX_VISIBLE = 600_000
"""The number of characters of the files of other programs that a program sees, in addition to
`VISIBLE_SHARE` of its own length.
"""

VISIBLE_SHARE = 4


class Entry(NamedTuple):
    """A file of a project: its path with `/`, and its words.

    `target` is that of the build, if it is known; `folder` is the one whose files belong together,
    if that is not the file's own. Findings in an input are reported. A `candidate` becomes an input
    if it can matter to a program that uses the API and mentions multisampling.
    """

    path: str
    words: Words
    is_input: bool
    is_candidate: bool = False
    target: str = ""
    folder: str = ""

    @property
    def is_related(self) -> bool:
        """Whether it can matter to files that use multisampling."""
        return self.words.is_related and not is_api(self.path)


class Program(NamedTuple):
    """The numbers of the files of a program: its own, those of them that are inputs, and those that
    it sees.
    """

    files: tuple[int, ...]
    inputs: tuple[int, ...]
    seen: tuple[int, ...]


class Project:
    """The files of a project and how they refer to each other."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self.entries = entries
        includes = Includes([entry.path for entry in entries])
        self.includes = [
            includes.of(number, entry.words.includes) for number, entry in enumerate(entries)
        ]
        self.folders = [entry.folder or posixpath.dirname(entry.path) for entry in entries]
        self.headers = [is_header(entry.path) for entry in entries]
        self.implementations = self._implementations()
        self.targets: dict[str, list[int]] = {}
        for number, entry in enumerate(entries):
            if entry.target:
                self.targets.setdefault(entry.target, []).append(number)
        self.mates: dict[str, int] = {}
        """For each folder, the first file without a `main`."""
        for number, entry in enumerate(entries):
            if self.headers[number] or not entry.words.has_main:
                self.mates.setdefault(self.folders[number], number)

    def _implementations(self) -> list[list[int]]:
        """Returns for each header the sources that include it and define what it declares."""
        found: list[list[int]] = [[] for _ in self.entries]
        for number, entry in enumerate(self.entries):
            if self.headers[number] or entry.words.has_main:
                continue
            stem = _stem(entry.path)
            for other in self.includes[number]:
                if self.headers[other] and (
                    _stem(self.entries[other].path) == stem
                    or not entry.words.names.isdisjoint(self.entries[other].words.names)
                ):
                    found[other].append(number)
        return found

    def programs(self) -> list[Program]:
        """Returns the programs with inputs, by their first file. Each file belongs to one
        program.
        """
        modules = self._modules()
        owner = {number: module for module, numbers in enumerate(modules) for number in numbers}
        uses = [self._used(numbers, owner) for numbers in modules]
        components = _components(uses)
        of_module = {
            module: component for component, members in enumerate(components) for module in members
        }
        successors = [
            {of_module[used] for module in members for used in uses[module]} - {component}
            for component, members in enumerate(components)
        ]
        groups = _groups(successors)
        programs = []
        for group in groups:
            numbers = sorted(
                number
                for component in group
                for module in components[component]
                for number in modules[module]
            )
            seen = self._seen(numbers)
            inputs = self._inputs(numbers, seen)
            if inputs:
                programs.append(Program(tuple(numbers), inputs, seen))
        return sorted(programs, key=lambda program: program.files)

    def _modules(self) -> list[list[int]]:
        """Returns the files that belong together: those of a folder, and each file with a
        `main`.
        """
        modules: dict[tuple[str, int], list[int]] = {}
        for number, entry in enumerate(self.entries):
            has_main = entry.words.has_main and not self.headers[number]
            modules.setdefault((self.folders[number], number if has_main else -1), []).append(
                number
            )
        return list(modules.values())

    def _used(self, numbers: Sequence[int], owner: Mapping[int, int]) -> set[int]:
        """Returns the modules that a module uses."""
        used: set[int] = set()
        for number in numbers:
            for other in self.includes[number]:
                used.add(owner[other])
                used.update(owner[source] for source in self.implementations[other])
            if self.entries[number].words.has_main and self.folders[number] in self.mates:
                used.add(owner[self.mates[self.folders[number]]])
            if self.entries[number].words.has_main:
                used.update(
                    owner[other] for other in self.targets.get(self.entries[number].target, ())
                )
        used.discard(owner[numbers[0]])
        return used

    def _inputs(self, numbers: Sequence[int], seen: Sequence[int]) -> tuple[int, ...]:
        """Returns the inputs of a program, whose own files have `numbers`."""
        entries = self.entries
        candidates = [
            number
            for number in numbers
            if entries[number].is_candidate and entries[number].words.has_api
        ]
        candidates = [number for number in candidates if not is_api(entries[number].path)]
        if candidates and not any(
            entries[number].words.has_multisampling for number in (*numbers, *seen)
        ):
            candidates = []
        return tuple(
            sorted({*candidates, *(number for number in numbers if entries[number].is_input)})
        )

    def _seen(self, numbers: Sequence[int]) -> tuple[int, ...]:
        """Returns the files of other programs that a program sees, the nearest first, as far as
        there is room.
        """
        seen = set(numbers)
        waiting = list(numbers)
        room = MAX_VISIBLE + VISIBLE_SHARE * sum(
            self.entries[number].words.length for number in numbers
        )
        found: list[int] = []
        for number in waiting:
            for other in (*self.includes[number], *self.implementations[number]):
                if other in seen:
                    continue
                seen.add(other)
                if self.entries[other].is_related:
                    room -= self.entries[other].words.length
                    if room < 0:
                        return tuple(sorted(found))
                    found.append(other)
                waiting.append(other)
        return tuple(sorted(found))


def _stem(path: str) -> str:
    return posixpath.basename(path).partition(".")[0].lower()


def _components(edges: Sequence[Iterable[int]]) -> list[list[int]]:
    """Returns the strongly connected components of a graph (Tarjan), without recursion."""
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    on_stack: set[int] = set()
    components: list[list[int]] = []
    for root in range(len(edges)):
        if root in index:
            continue
        work = [(root, iter(sorted(edges[root])))]
        index[root] = low[root] = len(index)
        stack.append(root)
        on_stack.add(root)
        while work:
            node, rest = work[-1]
            for other in rest:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    on_stack.add(other)
                    work.append((other, iter(sorted(edges[other]))))
                    break
                if other in on_stack:
                    low[node] = min(low[node], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    members: list[int] = []
                    while not members or members[-1] != node:
                        members.append(stack.pop())
                        on_stack.discard(members[-1])
                    components.append(sorted(members))
    return components


def _groups(successors: Sequence[set[int]]) -> list[list[int]]:
    """Returns the components of each program: one that no other uses, with those that only it uses.
    What several programs use is grouped in the same way.

    `successors` are in the order of `_components`: what a component uses comes before it.
    """
    users: list[set[int]] = [set() for _ in successors]
    for component, used in enumerate(successors):
        for other in used:
            users[other].add(component)
    program: dict[int, int] = {}
    groups: dict[int, list[int]] = {}
    for component in reversed(range(len(successors))):
        programs = {program[user] for user in users[component]}
        program[component] = programs.pop() if len(programs) == 1 else component
        groups.setdefault(program[component], []).append(component)
    return list(groups.values())
