"""The documents that an editor has open."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from lsprotocol import types
from pygls.uris import to_fs_path

from msaa_lint.core.text.source import Source

from .positions import Positions


class OpenDocument(NamedTuple):
    """One version of an open document, and the folder of the editor's workspace whose settings
    apply to it.
    """

    uri: str
    version: int
    text: str
    language: str
    folder: str | None

    @property
    def file(self) -> str | None:
        """The path of its file, which may not exist yet; None for a document without one."""
        return to_fs_path(self.uri) if self.uri.startswith("file:") else None

    @property
    def data(self) -> bytes:
        """The bytes of a file with its text."""
        return self.text.encode("utf-8", "surrogatepass")

    def changed(
        self,
        version: int,
        changes: Sequence[types.TextDocumentContentChangeEvent],
        encoding: types.PositionEncodingKind,
    ) -> OpenDocument:
        """The document after changes, each of the text that the ones before it leave."""
        text = self.text
        for change in changes:
            if isinstance(change, types.TextDocumentContentChangePartial):
                positions = Positions(Source("", text), encoding)
                start, end = (
                    positions.offset(change.range.start),
                    positions.offset(change.range.end),
                )
                text = text[:start] + change.text + text[max(start, end) :]
            else:
                text = change.text
        return self._replace(version=version, text=text)


def folder_of(uri: str, folders: Sequence[str]) -> str | None:
    """The path of the innermost of the editor's folders that a document is in, or else of the first
    one; None if there is none.
    """
    local = [folder for folder in folders if folder.startswith("file:")]
    around = [folder for folder in local if uri.startswith(folder.rstrip("/") + "/")]
    folder = max(around, key=len) if around else next(iter(local), None)
    return to_fs_path(folder) if folder is not None else None
