"""Messages of the validation layer: what is said, and which family it belongs to."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from .families import FAMILIES, Family
from .noise import NOISE, Noise


class Message(NamedTuple):
    """What the layer says. `number` is the pass it was said of; None where it is of no pass in particular."""

    id: str
    text: str
    severity: str = "warning"
    number: int | None = None


VENDORS = {"arm": "arm", "amd": "amd", "img": "img", "nvidia": "nvidia"}
"""The words of ids and texts that name a vendor's checks."""

_OWN = re.compile(r"^(?:UNASSIGNED-)?BestPractices-(?:(?P<vendor>Arm|AMD|IMG|NVIDIA)-)?", re.IGNORECASE)
_VUID = re.compile(r"^(?:UNASSIGNED-)?VUID-(?P<of>\w+)-(?P<rest>.+)$")
_NUMBER = re.compile(r"-(\d{5})$")
_PREAMBLE = re.compile(r"^[\w ]+:\s*\[.*?\].*?\|\s*MessageID\s*=\s*0x[0-9a-fA-F]+\s*\|\s*", re.DOTALL)
_NAMED = re.compile(r"0x[0-9a-f]{6,}\[([^\]]+)\]")
_HANDLE = re.compile(r"0x[0-9a-f]{9,}(\[\])?")
_QUOTED = re.compile(r"\s*(?:The Vulkan spec states|Vulkan spec states):.*$", re.DOTALL)
_VENDORS_SAID = re.compile(r"^(?:\[(?:Arm|AMD|IMG|NVIDIA)\]\s*)+", re.IGNORECASE)


def classify(id: str, text: str = "") -> Family | Noise | None:
    """The family of a message, or why it is noise. None where it is neither: then nobody of ours answers to it."""
    words = bare(id)
    for each in _candidates():
        if any(_has(words, known) for known in each.ids):
            return each
    vuid = _VUID.match(id)
    if vuid is None or _NUMBER.search(id) is None:
        return None
    # A number that is not known: renumbered, or new.
    said = sentence(text)
    for family in FAMILIES:
        if family.words and re.fullmatch(family.structures, vuid["of"]) and re.search(family.words, said, re.DOTALL):
            return family
    return None


def bare(id: str) -> str:
    """An id without what versions of the layer put in front of it: `UNASSIGNED-`, `VUID-`, `BestPractices-` and a vendor."""
    return _OWN.sub("", id).removeprefix("VUID-")


def vendors(id: str, text: str = "") -> frozenset[str]:
    """The vendors whose checks say it; none where it is said for all."""
    found = {match["vendor"].lower() for match in (_OWN.match(id),) if match is not None and match["vendor"]}
    named = _VENDORS_SAID.match(_PREAMBLE.sub("", text))
    if named is not None:
        found.update(word.lower() for word in re.findall(r"\w+", named[0]))
    return frozenset(found)


def sentence(text: str) -> str:
    """What a message says, without what the layer puts around it: objects, numbers and links; handles, which are others in every run."""
    said = _QUOTED.sub("", _VENDORS_SAID.sub("", _PREAMBLE.sub("", text)))
    return " ".join(_HANDLE.sub("...", _NAMED.sub(r"`\1`", said)).split())


@cache
def _candidates() -> tuple[Family | Noise, ...]:
    return (*FAMILIES, *NOISE)


def _has(words: str, known: str) -> bool:
    return f"-{known}-" in f"-{words}-"


def numbers() -> Iterator[str]:
    """Every number of a VUID that a family has."""
    return (known for family in FAMILIES for known in family.ids if known.isdecimal())
