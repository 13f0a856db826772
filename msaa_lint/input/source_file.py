"""Source code read as documents."""

from typing import NamedTuple

from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source, Unreadable, decode

from . import code


class SourceFile(NamedTuple):
    """Source code and the documents in it.

    `data` is the file's bytes, `language` one of `file_types.LANGUAGES`; `notes` are lines for the user.
    """

    data: bytes
    source: Source
    language: str
    program: code.Program
    notes: tuple[str, ...] = ()

    @property
    def description(self) -> str:
        """The text of the description of what the code states, a document for each part; empty if it states nothing."""
        return "---\n".join(emit(document.tree) for document in self.program.documents if document.tree is not None)

    @property
    def modules(self) -> dict[str, bytes]:
        """The code of the shaders that the description names."""
        return {name: module for document in self.program.documents for name, module in document.modules.items()}


def read_source_file(data: bytes, name: str, language: str) -> SourceFile:
    """Reads source code; bytes that are not UTF-8 are replaced.

    Raises `Unreadable` if the code is too long to parse, and `code.parsing.Missing` if the extra `source` is not installed.
    """
    try:
        text = decode(data)
    except Unreadable:
        # Mostly names in comments.
        text = data.decode("utf-8", "replace")
    source = Source(name, text)
    return SourceFile(data, source, language, code.read(source, language))
