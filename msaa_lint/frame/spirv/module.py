"""A module's declarations: entry points, decorations, types, constants, variables, and the places
of its functions.
"""

from __future__ import annotations

import array
from typing import NamedTuple

from . import numbers as op
from .words import HEADER, SpirvError, text_at, words_of

MAX_BYTES = 16 << 20
"""The size of a module; the largest ones in games have a few megabytes."""


class Entry(NamedTuple):
    """An entry point: its execution model, its function, its name, the variables of its
    interface.
    """

    model: int
    function: int
    name: str
    interface: frozenset[int]


class Function(NamedTuple):
    """A function: the words from the one after OpFunction to OpFunctionEnd, and its parameters."""

    start: int
    end: int
    parameters: tuple[int, ...]


class Variable(NamedTuple):
    """A variable: the type of its value, its storage class, the id of its initial value (0 if it
    has none).
    """

    holds: int
    storage: int
    initial: int


class Module:
    """The declarations of a module. Raises SpirvError if it is invalid or too large.

    `declarations_only` reads no functions, which are most of a module.
    """

    def __init__(self, code: bytes, declarations_only: bool = False) -> None:
        if len(code) > MAX_BYTES:
            raise SpirvError(f"it is larger than {MAX_BYTES >> 20} MiB")
        self.words: array.array[int] = words_of(code)
        self.capabilities: set[int] = set()
        self.extensions: set[str] = set()
        self.entries: list[Entry] = []
        self.modes: dict[int, set[int]] = {}
        """Execution modes by the function of an entry point."""
        self.decorations: dict[int, dict[int, tuple[int, ...]]] = {}
        self.members: dict[int, dict[int, dict[int, tuple[int, ...]]]] = {}
        """Decorations of the members of structures: by type, then by member."""
        self.types: dict[int, tuple[int, ...]] = {}
        """The number of the instruction, then its operands without the result."""
        self.constants: dict[int, tuple[int, ...]] = {}
        """The number of the instruction, the type, then the operands; in their order."""
        self.variables: dict[int, Variable] = {}
        self.imports: dict[int, str] = {}
        self.functions: dict[int, Function] = {}
        self.words_read = self._read(declarations_only)

    def _read(self, declarations_only: bool) -> int:
        words = self.words
        end = len(words)
        at = HEADER
        within: tuple[int, int] | None = None
        parameters: list[int] = []
        while at < end:
            first = words[at]
            length, number = first >> 16, first & 0xFFFF
            if not length or at + length > end:
                raise SpirvError("not SPIR-V: an instruction goes beyond its end")
            if within is not None:
                # Function bodies are parsed when they are followed.
                if number == op.FUNCTION_END:
                    self.functions[within[0]] = Function(within[1], at, tuple(parameters))
                    within = None
                elif number == op.FUNCTION_PARAMETER and length >= 3:
                    parameters.append(words[at + 2])
            elif number == op.FUNCTION:
                if declarations_only:
                    return at
                if length < 5:
                    raise SpirvError("not SPIR-V: an instruction is too short")
                within, parameters = (words[at + 2], at + length), []
            elif number in _READ:
                if length < _READ[number]:
                    raise SpirvError("not SPIR-V: an instruction is too short")
                self._declare(number, at, at + length)
            at += length
        if within is not None:
            raise SpirvError("not SPIR-V: a function does not end")
        return end

    def _declare(self, number: int, at: int, end: int) -> None:
        words = self.words
        if number in op.TYPES:
            self.types[words[at + 1]] = (number, *words[at + 2 : end])
        elif number in op.CONSTANTS or number == op.UNDEF:
            self.constants[words[at + 2]] = (number, words[at + 1], *words[at + 3 : end])
        elif number == op.DECORATE:
            self._decorate(self.decorations.setdefault(words[at + 1], {}), at + 2, end)
        elif number == op.MEMBER_DECORATE:
            self._decorate(
                self.members.setdefault(words[at + 1], {}).setdefault(words[at + 2], {}),
                at + 3,
                end,
            )
        elif number == op.GROUP_DECORATE:
            group = self.decorations.get(words[at + 1], {})
            for target in words[at + 2 : end]:
                self.decorations.setdefault(target, {}).update(group)
        elif number == op.GROUP_MEMBER_DECORATE:
            group = self.decorations.get(words[at + 1], {})
            for target, member in zip(
                words[at + 2 : end : 2], words[at + 3 : end : 2], strict=False
            ):
                self.members.setdefault(target, {}).setdefault(member, {}).update(group)
        elif number == op.VARIABLE:
            pointer = self.types.get(words[at + 1], ())
            holds = pointer[2] if len(pointer) > 2 and pointer[0] == op.TYPE_POINTER else 0
            self.variables[words[at + 2]] = Variable(
                holds, words[at + 3], words[at + 4] if end > at + 4 else 0
            )
        elif number == op.ENTRY_POINT:
            name, after = text_at(words, at + 3, end)
            self.entries.append(
                Entry(words[at + 1], words[at + 2], name, frozenset(words[after:end]))
            )
        elif number == op.EXECUTION_MODE:
            self.modes.setdefault(words[at + 1], set()).add(words[at + 2])
        elif number == op.CAPABILITY:
            self.capabilities.add(words[at + 1])
        elif number == op.EXTENSION:
            self.extensions.add(text_at(words, at + 1, end)[0])
        else:
            self.imports[words[at + 1]] = text_at(words, at + 2, end)[0]

    def _decorate(self, decorations: dict[int, tuple[int, ...]], at: int, end: int) -> None:
        # Decoration groups could multiply the irrelevant ones.
        if self.words[at] in _ASKED:
            decorations[self.words[at]] = tuple(self.words[at + 1 : min(end, at + 2)])

    def entry(self, name: str | None) -> Entry:
        """The entry point with a name; without a name the only one, or the only fragment shader.
        Raises SpirvError if there is none.

        Of several with one name (of different stages) the fragment shader.
        """
        if not self.entries:
            raise SpirvError("it has no entry point")
        found = [each for each in self.entries if name is None or each.name == name]
        found = [each for each in found if each.model == op.FRAGMENT] or found
        if len(found) == 1:
            return found[0]
        names = ", ".join(dict.fromkeys(f"`{each.name[:40]}`" for each in self.entries[:8]))
        if name is None:
            raise SpirvError(f"it has several entry points: {names}")
        raise SpirvError(
            f"it has no entry point `{name[:40]}`, but {names}"
            if not found
            else f"several entry points are called `{name[:40]}`"
        )

    def decoration(self, of: int, number: int) -> int | None:
        """The first operand of a decoration; 0 if it has no operand, None if there is no such
        decoration.
        """
        operands = self.decorations.get(of, {}).get(number)
        return None if operands is None else operands[0] if operands else 0


_ASKED = frozenset({
    op.SPEC_ID, op.BLOCK, op.BUFFER_BLOCK, op.ROW_MAJOR, op.ARRAY_STRIDE, op.MATRIX_STRIDE,
    op.BUILT_IN, op.NO_PERSPECTIVE, op.FLAT,
    op.CENTROID, op.SAMPLE, op.NON_WRITABLE, op.NON_READABLE, op.LOCATION, op.COMPONENT, op.INDEX,
    op.BINDING, op.DESCRIPTOR_SET,
    op.OFFSET, op.INPUT_ATTACHMENT_INDEX,
})  # fmt: skip
"""The decorations that are recorded."""

_READ = {
    **dict.fromkeys(op.TYPES, 2),
    **dict.fromkeys(op.CONSTANTS, 3),
    op.UNDEF: 3,
    op.DECORATE: 3,
    op.MEMBER_DECORATE: 4,
    op.GROUP_DECORATE: 2,
    op.GROUP_MEMBER_DECORATE: 2,
    op.VARIABLE: 4,
    op.ENTRY_POINT: 4,
    op.EXECUTION_MODE: 3,
    op.CAPABILITY: 2,
    op.EXTENSION: 2,
    op.EXT_INST_IMPORT: 3,
}
"""The recorded instructions outside of functions, and their minimum number of words."""
