"""The spelling of enumerants and sample counts that a text uses, and enumerants in it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import islice

from msaa_lint.core.text.node import Node
from msaa_lint.frame.metal.names import ENUMS as METAL
from msaa_lint.frame.metal.names import spelled
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.linter.fixes.spelling import Form, form_of, in_form

from .places import Place, descriptions, walk
from .recovery import MARK

_COUNT = re.compile(r"((?:VK_)?SAMPLE_COUNT_)[0-9]+((?:_BIT)?)")

MAX_PLACES = 2000
"""Values of a document that are looked at for its spelling."""


class Style:
    """How a text spells enumerants: in the form of its first ones."""

    def __init__(self, text: str, roots: Sequence[Node]) -> None:
        self.text = text
        self._roots = roots

    @property
    def _spellings(self) -> Iterator[tuple[str, str]]:
        """The enums and spellings of the enumerants of the text, in order."""
        for root in descriptions(self._roots):
            for place in islice(walk(root), MAX_PLACES):
                node = place.node
                if (
                    place.shape[0] in ("enum", "flags")
                    and node.kind == "scalar"
                    and node.value is not None
                    and MARK not in node.text
                ):
                    yield place.shape[1].partition("|")[0], node.text.partition("|")[0].strip()

    def form(self, enum: str) -> Form:
        """The form of the first enumerant of the same enum, else of the same kind, else of any;
        else without prefix.
        """
        is_flag = "FlagBits" in enum
        found: dict[int, Form] = {}
        for other, text in self._spellings:
            form = form_of(other, text) if other in VALUES else None
            if form is not None and other == enum:
                return form
            if form is not None and ("FlagBits" in other) == is_flag:
                found.setdefault(0, form)
            elif form is not None:
                found.setdefault(1, Form(form.start, is_flag and form.start == 0))
        return found[min(found)] if found else Form(None, False)

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
    """The canonical names of an enum, or of several that `|` joins, and how the text spells
    them.
    """
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
