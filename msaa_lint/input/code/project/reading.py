"""Reads the files of a program as one text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.source import Source, Unreadable
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.c.macros import NO_MACROS, Definitions, Macros
from msaa_lint.input.code.c.preprocessor import definitions
from msaa_lint.input.code.core.assumed_values import Assume, assuming
from msaa_lint.input.code.languages import MODULES
from msaa_lint.input.code.parsing import Assumptions, Code, Missing, Read, Unread, ascii_only
from msaa_lint.input.code.places import Piece, Places
from msaa_lint.input.code.programs import CPP, FileSyntax, executed, located

from .kept_syntax import kept_syntax
from .macros import SharedMacros
from .merge import MAX_REACH, File, merged

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache


PREPROCESSED = ("c", "cpp", "objc", "objcpp")
"""The languages with macros."""


class ProgramFile(NamedTuple):
    """A file of a program: its text, its language, the numbers of the files that it includes, and
    directives that define what its build does.
    """

    source: Source
    language: str
    includes: Sequence[int] = ()
    definitions: str = ""

    @property
    def code(self) -> Code:
        return Code(ascii_only(self.source.text), self.language)


def starts(files: Sequence[ProgramFile]) -> list[int]:
    """Returns the offset of each file in the text of the program, in which a line end follows each
    file.
    """
    offsets = [0]
    for file in files[:-1]:
        offsets.append(offsets[-1] + len(file.source.text) + 1)
    return offsets


def joined(files: Sequence[ProgramFile]) -> Source:
    """Returns the text of a program."""
    return (
        files[0].source
        if len(files) == 1
        else Source(files[0].source.name, "\n".join(file.source.text for file in files))
    )


def read(
    files: Sequence[ProgramFile],
    headers: Sequence[bool],
    assumptions: Assumptions | None = None,
    cache: Cache | None = None,
) -> list[Read]:
    """Returns what a program creates, with places in its text. `headers` says which of its files
    only declare; `assumptions` are stated about it, and `cache` keeps the syntax of its files.

    If following the program takes too long, its files are read one by one. Raises `Missing` if the
    grammar is not installed.
    """
    syntaxes: list[FileSyntax | None] = []
    unread: list[Read] = []
    pieces: list[Piece] = []
    length = 0
    macros = SharedMacros([definitions(file.code) for file in files])
    for number, (file, offset) in enumerate(zip(files, starts(files), strict=True)):
        try:
            code = file.code
            is_preprocessed = code.language in PREPROCESSED
            visible = (
                macros.visible(number, code.text, reach(files, number)) | _built(file)
                if is_preprocessed
                else NO_MACROS
            )
            syntax = kept_syntax(cache, code, visible, length, partial(_syntax, code, visible))
        except Missing:
            raise
        except (Unreadable, RecursionError) as error:
            syntaxes.append(None)
            unread.append(_unread(error, offset))
            continue
        syntaxes.append(syntax)
        pieces += [
            piece.moved(length, offset) for piece in syntax.pieces or (Piece(0, 0, syntax.length),)
        ]
        length += syntax.length + 1
        shift = offset - (length - syntax.length - 1)
        limits = tuple(
            item._replace(at=Span(item.at.start + shift, item.at.end + shift))
            for item in syntax.unread
        )
        unread += [Read(mapping([], Span(0, 0)), unread=limits)] if limits else []
    places = Places(pieces)
    assume = assuming(assumptions, places.original)
    reads = _read(files, syntaxes, headers, assume)
    if any(entry.unread for entry in reads):
        alone = (
            entry for syntax in syntaxes if syntax is not None for entry in _alone(syntax, assume)
        )
        reads = [
            *alone,
            *(entry._replace(tree=mapping([], Span(0, 0))) for entry in reads if entry.unread),
        ]
    return [*located(reads, places), *unread]


def _syntax(code: Code, macros: Macros) -> FileSyntax:
    """Returns the syntax of a file; `macros` are those that other files define."""
    module = import_module(f"msaa_lint.input.code.{MODULES[code.language]}")
    syntax: FileSyntax = (
        module.file_syntax(code, macros)
        if code.language in PREPROCESSED
        else module.file_syntax(code)
    )
    return syntax


def _built(file: ProgramFile) -> dict[str, Definitions]:
    """Returns the macros that the build of a file defines."""
    if not file.definitions:
        return {}
    return {
        name: found
        for name, found in definitions(Code(file.definitions, file.language)).items()
        if found
    }


def reach(files: Sequence[ProgramFile], number: int) -> set[int]:
    """Returns the files that a file includes, and that they include."""
    found: set[int] = set()
    waiting = list(files[number].includes)
    while waiting and len(found) < MAX_REACH:
        other = waiting.pop()
        if other not in found:
            found.add(other)
            waiting += files[other].includes
    return found


def _read(
    files: Sequence[ProgramFile],
    syntaxes: Sequence[FileSyntax | None],
    headers: Sequence[bool],
    assume: Assume,
) -> list[Read]:
    """Returns what a program creates, from the syntax of its files, None for a file without."""
    numbers = [number for number, syntax in enumerate(syntaxes) if syntax is not None]
    position = {number: at for at, number in enumerate(numbers)}
    entries: list[File] = []
    for number in numbers:
        syntax = syntaxes[number]
        assert syntax is not None
        includes = [position[other] for other in files[number].includes if other in position]
        entries.append(File(syntax.unit, not headers[number], includes))
    every = [syntax for syntax in syntaxes if syntax is not None]
    if not every:
        return []
    names: dict[str, int] = {}
    program = FileSyntax(
        merged(entries),
        [(_unique(name, names), at, node) for syntax in every for name, at, node in syntax.choices],
        any(syntax.fills_structures for syntax in every),
        any(syntax.waits for syntax in every),
        any(syntax.begins_frames for syntax in every),
        sum(syntax.length for syntax in every),
        calls_metal=any(syntax.calls_metal for syntax in every),
        platform=next((syntax.platform for syntax in every if syntax.platform is not None), None),
        language=next(
            (syntax.language for syntax in every if syntax.language in CPP), every[0].language
        ),
    )
    return executed(program, False, assume)


def _unique(name: str, names: dict[str, int]) -> str:
    """Returns the name of a sample count choice, with a number if another file has one of the same
    name.
    """
    names[name] = names.get(name, 0) + 1
    return name if names[name] == 1 else _unique(f"{name} {names[name]}", names)


def _alone(syntax: FileSyntax, assume: Assume) -> Iterator[Read]:
    """Yields what a file creates by itself. What takes too long is left to the message about the
    program.
    """
    for entry in executed(syntax, False, assume):
        if entry.tree.value:
            yield entry._replace(unread=())


def _unread(error: Exception, offset: int) -> Read:
    """Returns that a file is not read."""
    reason = (
        "the code nests too deeply to be read" if isinstance(error, RecursionError) else str(error)
    )
    return Read(
        mapping([], Span(offset, offset)),
        unread=(Unread(f"{reason}; it is not checked", Span(offset, offset)),),
    )
