"""Source code read as documents: a file, or the files of a program together."""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span

from . import code
from .code.parsing import Code

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache


class SourceText(NamedTuple):
    """The text of a source file, before it is read. `data` are its bytes, `language` is one of
    `file_types.LANGUAGES`.

    `is_input` is false for a file that is only read for what it defines; nothing is reported in it.
    `assumed` are values that the configuration states, by name, and `definitions` are directives
    that define the macros of its build.
    """

    data: bytes
    source: Source
    language: str
    is_input: bool = True
    assumed: Mapping[str, bool | int | str] = {}
    definitions: str = ""


class CodeFile(NamedTuple):
    """A file of a program: its text, the code in it, and the offset of its text in that of the
    program.
    """

    source: Source
    codes: tuple[Code, ...]
    language: str
    start: int = 0
    is_input: bool = True


class SourceFile(NamedTuple):
    """Source code and the documents in it.

    `data` is the file's bytes, `language` one of `file_types.LANGUAGES`; `notes` are lines for the
    user. `files` has the files of a program in the order of their texts, which `source` joins; for
    a file that is read alone, only this file.
    """

    data: bytes
    source: Source
    language: str
    program: code.Program
    files: tuple[CodeFile, ...]
    notes: tuple[str, ...] = ()

    @property
    def description(self) -> str:
        """The text of the description of what the code states, a document for each part; empty if
        it states nothing.
        """
        return "---\n".join(
            emit(document.tree) for document in self.program.documents if document.tree is not None
        )

    @property
    def modules(self) -> dict[str, bytes]:
        """The code of the shaders that the description names."""
        return {
            name: module
            for document in self.program.documents
            for name, module in document.modules.items()
        }

    def file_at(self, offset: int) -> CodeFile:
        """The file with an offset of the program's text."""
        return self.files[max(bisect_right(self.files, offset, key=_start) - 1, 0)]

    def place(self, at: Span) -> tuple[CodeFile, Span]:
        """The file of a place in the program's text, and the place in that file."""
        file = self.file_at(at.start)
        return file, Span(at.start - file.start, at.end - file.start)


def _start(file: CodeFile) -> int:
    return file.start


def source_text(data: bytes, name: str, language: str) -> SourceText:
    """The text of source code; bytes that are not UTF-8 are replaced."""
    try:
        text = decode(data)
    except Unreadable:
        # Mostly names in comments.
        text = data.decode("utf-8", "replace")
    return SourceText(data, Source(name, text), language)


def read_source_file(data: bytes, name: str, language: str) -> SourceFile:
    """Reads source code; bytes that are not UTF-8 are replaced.

    Raises `Unreadable` if the code is too long to parse, and `code.parsing.Missing` if the extra
    `source` is not installed.
    """
    return read_source_text(source_text(data, name, language))


def read_source_text(text: SourceText) -> SourceFile:
    """Reads one file alone, with the errors of `read_source_file`."""
    program = code.read(text.source, text.language, text.assumed)
    return SourceFile(
        text.data,
        text.source,
        text.language,
        program,
        (CodeFile(text.source, program.codes, text.language),),
    )


def read_program(
    texts: Sequence[SourceText],
    includes: Sequence[Sequence[int]],
    headers: Sequence[bool],
    cache: "Cache | None" = None,
) -> SourceFile:
    """Reads the files of a program together; `includes` has the numbers of the files that each file
    includes, and `headers` says which are headers. `cache` keeps what was read. With the errors of
    `read_source_file`.
    """
    from .code.project.kept import kept_reads
    from .code.project.reading import ProgramFile, joined, read, starts

    files = [
        ProgramFile(text.source, text.language, included, text.definitions)
        for text, included in zip(texts, includes, strict=True)
    ]
    codes = [file.code for file in files]
    first = next(text for text in texts if text.is_input)
    parts = tuple(
        CodeFile(text.source, (code,), text.language, start, text.is_input)
        for text, code, start in zip(texts, codes, starts(files), strict=True)
    )
    whole = SourceFile(first.data, joined(files), first.language, code.NOTHING, parts)

    def line(at: Span) -> str:
        file, place = whole.place(at)
        return f"{file.source.name}:{file.source.position(place.start).line}"

    assumptions = code.assumptions_of(
        [(part.codes[0], part.start) for part in parts], first.assumed
    )
    # What of assumptions is of use is only known of what is read now.
    reads = kept_reads(
        cache if assumptions is None else None,
        files,
        headers,
        lambda: read(files, headers, assumptions, cache),
    )
    return whole._replace(program=code.program_of(whole.source, codes, reads, line, assumptions))
