"""The spelling of enumerants and sample counts that a text uses, and enumerants in it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property

from msaa_lint.core.text.node import Node
from msaa_lint.frame.metal.names import ENUMS as METAL
from msaa_lint.frame.metal.names import spelled
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.linter.fixes.spelling import Form, form_of, in_form

from .places import Place, descriptions, walk
from .recovery import MARK

_COUNT = re.compile(r"((?:VK_)?SAMPLE_COUNT_)[0-9]+((?:_BIT)?)")


class Style:
    """How a text spells enumerants: those nearest to a place first, then those of the whole text."""

    def __init__(self, text: str, roots: Sequence[Node]) -> None:
        self.text = text
        self._roots = roots

    @cached_property
    def _spellings(self) -> list[tuple[str, str]]:
        """The enums and spellings of the enumerants of the text, in order."""
        places = (place for root in descriptions(self._roots) for place in walk(root))
        return [
            (place.shape[1].partition("|")[0], place.node.text.partition("|")[0].strip())
            for place in places
            if place.shape[0] in ("enum", "flags")
            and place.node.kind == "scalar"
            and place.node.value is not None
            and MARK not in place.node.text
        ]

    def form(self, enum: str) -> Form:
        """The form of the first enumerant of the same enum, else of the same kind, else of any; else without prefix."""
        is_flag = "FlagBits" in enum
        vulkan = [(other, text) for other, text in self._spellings if other in VALUES]
        ranked = sorted(vulkan, key=lambda each: (each[0] != enum, ("FlagBits" in each[0]) != is_flag))
        for other, text in ranked:
            form = form_of(other, text)
            if form is not None:
                return form if other == enum or ("FlagBits" in other) == is_flag else Form(form.start, is_flag and form.start == 0)
        return Form(None, False)

    @property
    def metal(self) -> str:
        """A spelling of a Metal enumerant; empty if there is none."""
        return next((text for enum, text in self._spellings if enum in METAL), "")

    def samples(self, counts: Sequence[int]) -> Iterator[str]:
        """Sample counts as the text spells them."""
        match = _COUNT.search(self.text)
        for count in counts:
            yield f"{match[1]}{count}{match[2]}" if match is not None else str(count)


def enumerants(enums: str, style: Style, place: Place) -> Iterator[tuple[str, str]]:
    """The canonical names of an enum, or of several that `|` joins, and how the text spells them."""
    if enums.startswith("MTL"):
        model = style.metal
        for name in METAL[enums]:
            yield name, spelled(enums, name, model)
        return
    found: dict[str, str] = {}
    for enum in enums.split("|"):
        form = style.form(enum)
        for name in VALUES[enum]:
            found.setdefault(name, in_form(enum, name, form))
    yield from found.items()
