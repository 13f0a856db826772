"""The configuration that is described for a program that calls Metal, and the members of its
descriptors in it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.metal.names import MULTISAMPLE_RESOLVES, MULTISAMPLE_TYPES
from msaa_lint.input.code.core.configurations import ASSUMED, Configuration
from msaa_lint.input.code.core.guards import ALWAYS, Guards, covers
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Struct, Symbol, Value, sole_value

from .creation import MetalInterpreter
from .objects import is_unknown

_SWITCHED = re.compile(r"msaa|multisampl|antialias", re.IGNORECASE)
_ABOUT_SAMPLES = re.compile(r"sample|msaa|antialias", re.IGNORECASE)
_NUMBERED = re.compile(r"[^=]=\d+\Z")
_ABOVE_ONE = re.compile(r"(.*)>1$")


class Field(NamedTuple):
    """The value of a member, its location, and whether it is a default."""

    value: Any
    at: Span
    default: bool = False


class MetalConfiguration(Configuration):
    """The values of a program in one configuration."""

    def __init__(self, program: MetalInterpreter) -> None:
        super().__init__(list(program.current_objects.values()))
        self.program = program
        self.choose_configuration()
        self.current_objects = [obj for obj in self.current_objects if not self.is_excluded(obj)]

    def choose_configuration(self) -> None:
        """Selects the conditions under which the program is multisampled."""
        writes = [
            (name, write, obj.guards)
            for obj in self.current_objects
            for name, value in members_of(obj.info)
            for write in value
        ]
        view = self.program.instances.get(("view",))
        if view is not None:
            writes += [
                ("sampleCount", write, ALWAYS)
                for write in self.program.snapshot(view, ALWAYS).cell("sampleCount").writes
            ]
        counts = [
            item
            for item in writes
            if item[0] in ("sampleCount", "rasterSampleCount") and type(item[1].value) is int
        ]
        # Prefer the count that every device supports, then the lowest.
        for _, write, guards in sorted(
            (c for c in counts if c[1].value > 1), key=lambda c: (c[1].value != ASSUMED, c[1].value)
        ):
            self.assume(write.guards | guards)
        for name, write, guards in writes:
            value = write.value
            if (
                (name == "textureType" and value in MULTISAMPLE_TYPES)
                or (name == "resolveTexture" and isinstance(value, (ApiObject, Symbol)))
                or (name in ("sampleCount", "rasterSampleCount") and isinstance(value, Symbol))
            ):
                self.assume(write.guards | guards)
        for obj in self.current_objects:
            for name, value in members_of(obj.info):
                resolving = [
                    write.guards
                    for write in value
                    if name == "storeAction" and write.value in MULTISAMPLE_RESOLVES
                ]
                if resolving:
                    # Which of several resolves it is stays open.
                    self.assume(frozenset.intersection(*resolving) | obj.guards)
        for guards in (guards | write.guards for _, write, guards in writes):
            self.assume_by_words(guards)
        for text, way in self.program.passed.items():
            self.configuration.setdefault(text, way)

    def assume_by_words(self, guards: Guards) -> None:
        """Decides conditions that are about multisampling by their names."""
        for text, _ in guards:
            above = _ABOVE_ONE.match(text)
            about = (
                _ABOUT_SAMPLES.search(above[1])
                if above is not None
                else _SWITCHED.search(text)
                if "=" not in text
                else None
            )
            if about is not None:
                self.configuration.setdefault(text, True)

    def field(self, struct: Struct, name: str) -> Field | None:
        """Returns a member, or None if it is not set. Its value is UNKNOWN if it may not be, or has
        several values.
        """
        cell = struct.fields.get(name)
        if cell is None or not cell.writes:
            return None
        value = self.settle(cell.writes)
        if not value:
            return None
        if not is_certain([write.guards for write in value]):
            return Field(UNKNOWN, value[-1].at)
        return Field(sole_value(value), value[-1].at)

    def alternatives(self, struct: Struct, name: str) -> Value:
        cell = struct.fields.get(name)
        return self.settle(cell.writes) if cell is not None else ()


def is_certain(guards: list[Guards]) -> bool:
    """Returns whether one of several sets of conditions certainly holds."""
    # What several functions assign is numbered; one of them is the value.
    numbered = [
        {text.rpartition("=")[0] for text, way in one if way and _NUMBERED.search(text)}
        for one in guards
    ]
    keys = set.intersection(*numbered) if numbered else set()
    return covers(
        tuple(
            frozenset(guard for guard in one if guard[0].rpartition("=")[0] not in keys)
            for one in guards
        )
    )


def members_of(struct: Struct) -> Iterator[tuple[str, Value]]:
    """Yields the members of a structure and its attachments."""
    for name, cell in struct.fields.items():
        inner = sole_value(cell.writes)
        if isinstance(inner, Struct):
            yield from members_of(inner)
        else:
            yield name, cell.writes


def constant_of(field: Field | None) -> Any:
    """Returns the value of a member if it is a number, a word, or a boolean; otherwise None."""
    return (
        field.value
        if field is not None
        and isinstance(field.value, (str, int, bool))
        and not is_unknown(field.value)
        else None
    )
