"""Messages of the validation layer, and the families they belong to."""

from __future__ import annotations

import re
from typing import NamedTuple

from .explanations import NOISE, Noise
from .families import FAMILIES, Family


class Message(NamedTuple):
    """A message of the layer. `number` is the pass that it is about, None for no pass in
    particular; `image` is the image that it is about, by its name in the plan: one that was being
    created, copied, or resolved.
    """

    id: str
    text: str
    number: int | None = None
    image: str = ""


_OWN = re.compile(r"^(?:UNASSIGNED-)?BestPractices-(?:(?:Arm|AMD|IMG|NVIDIA)-)?", re.IGNORECASE)
_VUID = re.compile(r"^(?:UNASSIGNED-)?VUID-(?P<of>\w+)-(?P<rest>.+)$")
_NUMBER = re.compile(r"-(\d{5})$")
_PREAMBLE = re.compile(
    r"^[\w ]+:\s*\[.*?\].*?\|\s*MessageID\s*=\s*0x[0-9a-fA-F]+\s*\|\s*", re.DOTALL
)
_NAMED = re.compile(r"0x[0-9a-f]{6,}\[([^\]]+)\]")
_HANDLE = re.compile(r"0x[0-9a-f]{9,}(\[\])?")
_QUOTED = re.compile(r"\s*(?:The Vulkan spec states|Vulkan spec states):.*$", re.DOTALL)
_VENDORS_SAID = re.compile(r"^(?:\[(?:Arm|AMD|IMG|NVIDIA)\]\s*)+", re.IGNORECASE)


def classify(id: str, text: str = "") -> Family | Noise | None:
    """The family of a message, or the kind of noise it is. None for neither: no rule corresponds to
    it.
    """
    name = bare(id)
    for candidate in (*FAMILIES, *NOISE):
        if any(f"-{id_part}-" in f"-{name}-" for id_part in candidate.ids):
            return candidate
    vuid = _VUID.match(id)
    if vuid is None or _NUMBER.search(id) is None:
        return None
    # An unknown number: renumbered, or new.
    message = sentence(text)
    for family in FAMILIES:
        if (
            family.text_pattern
            and re.fullmatch(family.structure_pattern, vuid["of"])
            and re.search(family.text_pattern, message, re.DOTALL)
        ):
            return family
    return None


def bare(id: str) -> str:
    """An id without the prefixes of various layer versions: `UNASSIGNED-`, `VUID-`,
    `BestPractices-` and a vendor.
    """
    return _OWN.sub("", id).removeprefix("VUID-")


def sentence(text: str) -> str:
    """The text of a message without the preamble and the quotation of the specification; handles,
    which differ in every run, are elided.
    """
    message = _QUOTED.sub("", _VENDORS_SAID.sub("", _PREAMBLE.sub("", text)))
    return " ".join(_HANDLE.sub("...", _NAMED.sub(r"`\1`", message)).split())
