"""The configuration that is described for a program that can render with one sample or with
several.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis

from .guards import chosen
from .values import UNKNOWN, ApiObject, Ref, Symbol, Value, possible_writes, sole_value

ASSUMED = 4
"""The sample count above 1 that every device supports for color, depth, and stencil (Vulkan
specification, "Required Limits"; Apple's documentation of supportsTextureSampleCount).
"""


_VALUE = re.compile(r"(?:>1|=\d+)\Z")
"""What a condition says of its subject."""

_UNION = re.compile(r"[^=]=\d+\Z")
"""The condition that a member has one of the values that several functions write to it; comparisons
have another sign.
"""


class Configuration:
    """The values of a program in one configuration, a set of decided conditions."""

    def __init__(self, objects: Sequence[ApiObject]) -> None:
        self.current_objects = list(objects)
        self.configuration: dict[str, bool] = {}
        self.equal: dict[str, str] = {}
        """What the subject of a comparison equals, as text."""
        self.multisampled: set[str] = set()
        """The keys of unknown sample counts that are above 1."""
        self.assumed: dict[str, tuple[str, Span, str]] = {}
        self.conditions: dict[Span, set[str]] = {}
        """The subjects of the conditions that were decided for the value at each place."""
        self.assumed_places: dict[Span, str] = {}
        """The places of values that are assumed, with the assumption in words."""

    def assume_multisampled(self, symbol: Symbol, guards: Iterable[tuple[str, bool]]) -> None:
        if self.assume(guards):
            self.multisampled.add(symbol.key)
            self.configuration.setdefault(f"{symbol.key}>1", True)

    def assume(self, guards: Iterable[tuple[str, bool]]) -> bool:
        """Adds guards to the configuration; returns False if they contradict it."""
        guards = list(guards)
        if any(chosen(text, self.configuration) not in (way, None) for text, way in guards):
            return False
        for subject, compared in [
            text.split("==", 1) for text, way in guards if way and "==" in text
        ]:
            # A value that equals one thing does not equal another.
            if self.equal.setdefault(subject, compared) != compared:
                return False
        for text, way in guards:
            self.configuration[text] = way
            key, _, number = text.rpartition("=")
            if way and key and number.isdecimal():
                for other in range(12):
                    self.configuration.setdefault(f"{key}={other}", str(other) == number)
                self.configuration.setdefault(f"{key}>1", True)
                self.configuration.setdefault(f"{key.rpartition('::')[2]}>1", True)
        return True

    def is_excluded(self, obj: ApiObject) -> bool:
        """Returns whether an object is created only in another configuration."""
        return any(chosen(text, self.configuration) not in (way, None) for text, way in obj.guards)

    @property
    def basis(self) -> Basis:
        """What the values rest on that were read so far."""
        return Basis(self.conditions, self.assumed_places)

    def settle(self, value: Value) -> Value:
        settled = possible_writes(value, self.configuration)
        if len(value) > 1 or (value and value[0].guards):
            texts = {
                text for write in value for text, _ in write.guards if text in self.configuration
            }
            subjects = {_VALUE.sub("", text) for text in texts}
            for alternative in settled if subjects else ():
                self.conditions.setdefault(alternative.at, set()).update(subjects)
                for text in sorted(filter(_UNION.search, texts))[:1]:
                    name = _VALUE.sub("", text).rpartition("::")[2]
                    self.assumed_places.setdefault(
                        alternative.at, f"functions write different values to `{name}`"
                    )
        return settled

    def dereference(self, value: Any) -> Any:
        for _ in range(4):
            if not isinstance(value, Ref):
                return value
            value = sole_value(self.settle(value.cell.writes))
        return UNKNOWN

    def count_of(self, value: Any, at: Span) -> int | None:
        """Returns a sample count; an unknown count that is above 1 is assumed to be `ASSUMED`."""
        if type(value) is int:
            return value
        if isinstance(value, Symbol) and value.key in self.multisampled:
            return self.assumed_count(value.key, value.name, at)
        return None

    def assumed_count(self, key: str, name: str, at: Span) -> int:
        """Returns the count that stands for an unknown one above 1, which the user is told."""
        self.assumed.setdefault(key, (name, at, str(ASSUMED)))
        self.assumed_places.setdefault(at, "")
        return ASSUMED
