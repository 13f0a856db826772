"""The depth and stencil formats of images that have a chosen count, where the choice and the images
are in different functions or files.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.formats import format_of
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    BINARY,
    BRACES,
    CALL,
    CHOICE,
    DECLARE,
    FIELD,
    LAMBDA,
    NAME,
    RETURN,
    SWITCH,
    TARGET,
    Term,
    Unit,
    labeled,
)

from .flow import Flow
from .names import FUNCTION, GLOBAL, MEMBER, PARAMETER, UNDECLARED, Identity

MAX_DEPTH = 6
"""The maximum number of variables and functions that a format is followed through."""

MAX_STEPS = 100_000
"""The maximum number of terms searched for formats in a program."""

MAX_HOLDERS = 64
"""The maximum number of variables and functions that a count is followed through."""

_FORMATS = {name.replace("_", "").lower(): name for name in VALUES["VkFormat"]}
"""The formats by their spelling in vulkan.hpp, in lower case: `D24UnormS8Uint` is
D24_UNORM_S8_UINT.
"""

Choice = tuple[str, Span, Node]
"""A sample count choice: its name, place, and entry."""


def with_formats(choices: Sequence[Choice], unit: Unit) -> list[Choice]:
    """Returns the sample count choices of a program, with the depth and stencil formats of images
    elsewhere that have the count.
    """
    if not any(_lacks_formats(node) for _, _, node in choices):
        return list(choices)
    formats = _Formats(unit)
    return [
        (name, at, _completed(node, formats.of(name, at)) if _lacks_formats(node) else node)
        for name, at, node in choices
    ]


def _lacks_formats(node: Node) -> bool:
    """Returns whether the formats of a choice matter and are unknown: it asks for the counts of
    depth, but not for those of stencil.
    """
    limits = node.value.get("limits")
    names = [str(item.value) for item in limits.value] if limits is not None else []
    return (
        "formats" not in node.value
        and any("DepthSample" in name for name in names)
        and not any("Stencil" in name for name in names)
    )


def _completed(node: Node, formats: dict[str, Span]) -> Node:
    if not formats:
        return node
    at = next(iter(formats.values()))
    members = [(key, node.keys[key].span, value) for key, value in node.value.items()]
    members.append(
        ("formats", at, sequence([scalar(name, place) for name, place in formats.items()], at))
    )
    return mapping(members, node.span)


class _Formats:
    """The formats of the images that have a count."""

    def __init__(self, unit: Unit) -> None:
        self.flow = Flow(unit)
        self.names = self.flow.names
        self._left = MAX_STEPS
        self._order = sorted(
            range(len(unit.functions)), key=lambda number: unit.functions[number].at.start
        )
        self._starts = [unit.functions[number].at.start for number in self._order]
        for variable, term in self.names.members():
            if term[3] is not None:
                self.flow.sources.setdefault(variable, []).append((-1, term[3]))
        for name, term in self.names.globals.items():
            if term[3] is not None:
                self.flow.sources.setdefault((GLOBAL, name), []).append((-1, term[3]))

    def of(self, name: str, at: Span) -> dict[str, Span]:
        """Returns the depth and stencil formats of the images that have the count of a choice, and
        where each is named.
        """
        start = self._chosen(name, at)
        waiting = [(start, False)] if start is not None else []
        reached = set(waiting)
        formats: dict[str, Span] = {}
        while waiting:
            holder, doubtful = waiting.pop()
            for use in self.flow.uses.get(holder, ()):
                self._left -= 1
                if self._left < 0:
                    break
                for expression in use.beside:
                    formats |= self._depth_formats(
                        expression, use.function, doubtful or use.conditional
                    )
            for target, conditional in self.flow.targets.get(holder, ()):
                # A parameter may have another count in another call, in which the format is
                # another, too.
                state = target, doubtful or conditional or target[0] == PARAMETER
                if state not in reached and len(reached) < MAX_HOLDERS:
                    reached.add(state)
                    waiting.append(state)
        return dict(sorted(formats.items(), key=lambda item: item[1]))

    def _chosen(self, name: str, at: Span) -> Identity | None:
        """Returns the function or variable that has the result of a choice."""
        position = bisect_right(self._starts, at.start) - 1
        if position < 0:
            return None
        number = self._order[position]
        function = self.names.functions[number]
        if function.at.start <= at.start and at.end <= function.at.end:
            return FUNCTION, number
        inside = function.body and at.start <= max(term[-1].end for term in function.body)
        return self.names.variable((NAME, name, at), number) if inside else None

    def _depth_formats(self, expression: Term, function: int, doubtful: bool) -> dict[str, Span]:
        """Returns the depth and stencil formats that an expression may have; nothing if it may have
        another format.
        """
        names: dict[str, Span] = {}
        for name, place in self._formats(expression, function, doubtful, 0, set()):
            form = format_of(name)
            if form is None or {"depth", "stencil"}.isdisjoint(form.aspects):
                return {}
            names.setdefault(name, place)
        return names

    def _formats(
        self, term: Term, function: int, doubtful: bool, depth: int, seen: set[Identity]
    ) -> Iterator[tuple[str, Span]]:
        """Yields the formats that an expression may have. If the count is `doubtful`, those that
        depend on an argument or a condition are left out.
        """
        self._left -= 1
        kind = term[0]
        if self._left < 0 or depth > MAX_DEPTH:
            return
        if kind in (ADDRESS, TARGET):
            yield from self._formats(term[1], function, doubtful, depth + 1, seen)
        elif kind == CHOICE and not doubtful:
            for item in term[2:4]:
                yield from self._formats(item, function, doubtful, depth + 1, seen)
        elif kind == BRACES:
            for _, item in term[2]:
                yield from self._formats(item, function, doubtful, depth + 1, seen)
        elif kind in (NAME, FIELD):
            name = format_name(term[1]) if kind == NAME else None
            if name is not None:
                yield from [(name, term[-1])] if name != "UNDEFINED" else []
                return
            variable = (
                self.names.variable(term, function)
                if function >= 0 or (kind == NAME and term[1] in self.names.globals)
                else None
            )
            if (
                variable is not None
                and variable not in seen
                and not (doubtful and variable[0] == PARAMETER)
            ):
                yield from self._received(variable, doubtful, depth, {*seen, variable})
        elif kind == CALL:
            yield from self._returned(term, function, doubtful, depth, seen)

    def _received(
        self, variable: Identity, doubtful: bool, depth: int, seen: set[Identity]
    ) -> Iterator[tuple[str, Span]]:
        """Yields the formats that a variable receives."""
        values = self.flow.sources.get(variable, ())
        received = [
            list(self._formats(value, function, doubtful, depth + 1, seen))
            for function, value in values
        ]
        if doubtful and variable[0] in (MEMBER, UNDECLARED):
            # Which of the values an object with the count has is unknown, unless all of them are
            # known.
            known = all(
                found or _is_undefined(value)
                for found, (_, value) in zip(received, values, strict=True)
            )
            yield from (item for found in received for item in found if known)
            return
        for found in received:
            # Another call or object has another format.
            if variable[0] not in (PARAMETER, MEMBER, UNDECLARED) or not any(
                _is_color(name) for name, _ in found
            ):
                yield from found

    def _returned(
        self, call: Term, function: int, doubtful: bool, depth: int, seen: set[Identity]
    ) -> Iterator[tuple[str, Span]]:
        """Yields the formats that a call may return: those that the function names and those among
        its arguments.
        """
        callee = self.names.callee(call, function) if function >= 0 else None
        called = call[1]
        text = called[1] if called[0] == NAME else called[2] if called[0] == FIELD else ""
        returns = self.names.functions[callee].return_type if callee is not None else ""
        if "ormat" not in (returns if returns not in ("", "auto") else text):
            return
        for item in call[2]:
            yield from self._formats(labeled(item)[1], function, doubtful, depth + 1, seen)
        if callee is None or (FUNCTION, callee) in seen:
            return
        inner = {*seen, (FUNCTION, callee)}
        for term in self._statements(self.names.functions[callee].body):
            if term[0] == NAME:
                name = format_name(term[1])
                if name is not None and name != "UNDEFINED":
                    yield name, term[-1]
            elif term[0] == RETURN and term[1] is not None and term[1][0] in (NAME, FIELD, CALL):
                yield from self._formats(term[1], callee, True, depth + 1, inner)
            elif term[0] == DECLARE and term[3] is not None and term[3][0] == CALL:
                yield from self._formats(term[3], callee, True, depth + 1, inner)

    def _statements(self, body: tuple[Term, ...]) -> Iterator[Term]:
        """Yields the terms of a function body that may be its result: all but comparisons and
        translations of other enumerations.
        """
        stack = list(body)
        while stack and self._left > 0:
            term = stack.pop()
            self._left -= 1
            if term and isinstance(term[-1], Span) and term[0] in (BINARY, SWITCH, LAMBDA):
                continue
            if term and isinstance(term[-1], Span):
                yield term
            stack += [
                part for part in term if isinstance(part, tuple) and not isinstance(part, Span)
            ]


def format_name(text: str) -> str | None:
    """Returns the format that a name denotes in C, vulkan.hpp, or Rust."""
    if text.startswith("VK_FORMAT_"):
        name = text.removeprefix("VK_FORMAT_")
        return name if name in VALUES["VkFormat"] else None
    if "Format::e" in text:
        return _FORMATS.get(text.rpartition("Format::e")[2].lower())
    name = text.rpartition("Format::")[2]
    return name if name != text and name in VALUES["VkFormat"] else None


def _is_undefined(value: Term) -> bool:
    """Returns whether a value stands for no format."""
    if value[0] == BRACES and len(value[2]) <= 1:
        return not value[2] or _is_undefined(value[2][0][1])
    return value[0] == NAME and format_name(value[1]) == "UNDEFINED"


def _is_color(name: str) -> bool:
    form = format_of(name)
    return form is None or {"depth", "stencil"}.isdisjoint(form.aspects)
