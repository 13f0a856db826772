"""The built-in SPIR-V, with fragment shaders reduced to the outputs that their attachments need."""

from __future__ import annotations

import array
import os
import sys
from collections.abc import Iterator, Sequence

from msaa_lint.frame.spirv.words import (
    HEADER,
    OP_DECORATE,
    OP_ENTRY_POINT,
    OP_NAME,
    OP_STORE,
    OP_VARIABLE,
    instructions,
    words_of,
)

FOLDER = os.path.dirname(os.path.abspath(__file__))
OUTPUTS = {"float": 0, "sint": 8, "uint": 16}
"""The kinds of outputs, and the location of the first of the eight outputs of each kind."""

SLOTS = 8

DECORATION_LOCATION, OUTPUT = 30, 3
"""A decoration and a storage class of SPIR-V."""


def read(shader: str, outputs: Sequence[str] | None = None) -> bytes:
    """The SPIR-V of a built-in shader (`scene.frag`). `outputs` are the kinds of outputs by
    attachment, empty for none; None leaves the shader unchanged.
    """
    with open(os.path.join(FOLDER, f"{shader}.spv"), "rb") as file:
        code = file.read()
    return code if outputs is None else with_outputs(code, outputs)


def with_outputs(code: bytes, outputs: Sequence[str]) -> bytes:
    """SPIR-V with the requested outputs at the locations of their attachments, and without the
    others.
    """
    words = words_of(code)
    written = {i[2] for op, i in instructions(words) if op == OP_VARIABLE and i[3] == OUTPUT}
    if len(outputs) > SLOTS:
        raise ValueError(f"a built-in shader has {SLOTS} outputs of each kind")
    locations = {i[1]: i[3] for i in _located(words) if i[1] in written}
    kept = {OUTPUTS[kind] + slot: slot for slot, kind in enumerate(outputs) if kind}
    dropped = {variable for variable, location in locations.items() if location not in kept}
    made = words[:HEADER]
    for op, each in instructions(words):
        if op == OP_ENTRY_POINT:
            each = _without(each, dropped)
        elif (op in (OP_NAME, OP_DECORATE, OP_STORE) and each[1] in dropped) or (
            op == OP_VARIABLE and each[2] in dropped
        ):
            continue
        elif op == OP_DECORATE and each[2] == DECORATION_LOCATION and each[1] in locations:
            each = each[:3] + array.array("I", [kept[locations[each[1]]]])
        made += each
    return made.tobytes()


def _located(words: array.array[int]) -> Iterator[array.array[int]]:
    """The location decorations."""
    return (
        i
        for op, i in instructions(words)
        if op == OP_DECORATE and i[2] == DECORATION_LOCATION and len(i) > 3
    )


def _without(entry: array.array[int], dropped: set[int]) -> array.array[int]:
    """An entry point without some variables of its interface."""
    name = 3
    # The name is a string that ends with a zero byte.
    while name < len(entry) and all(entry[name].to_bytes(4, sys.byteorder)):
        name += 1
    if name == len(entry):
        raise ValueError("not SPIR-V: the name of an entry point does not end")
    made = entry[: name + 1] + array.array(
        "I", [each for each in entry[name + 1 :] if each not in dropped]
    )
    made[0] = len(made) << 16 | OP_ENTRY_POINT
    return made
