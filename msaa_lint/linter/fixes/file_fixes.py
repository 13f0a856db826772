"""The fixes of one input, made and written, or only worked out."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from msaa_lint.core import atomic_write as write
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.source import encode
from msaa_lint.linter.results import FileResult

from . import fixer as rounds
from .fixer import Unfixed


class FixedText(NamedTuple):
    """What fixes make of an input: its text before and after, what is found in that, and what they mended.

    `failed` says why the file could not be written; it is then as it was.
    """

    file: str
    before: str
    after: str
    data: bytes
    linted: FileResult
    fixed: tuple[Finding, ...]
    unfixed: tuple[Unfixed, ...]
    failed: str = ""

    @property
    def changed(self) -> bool:
        return self.before != self.after


def mend(
    data: bytes, linted: FileResult, lint: Callable[[bytes], FileResult], wanted: Callable[[Finding], bool], unsafe: bool, path: str | None
) -> FixedText:
    """Fixes an input that was judged. `lint` judges other contents of it; without `path` nothing is written."""
    done = rounds.fix(linted, lambda text: lint(encode(text, data)), unsafe, wanted)
    before = linted.source.text if linted.source is not None else ""
    after = encode(done.text, data) if done.text != before else data
    made = FixedText(linted.file, before, done.text, after, done.linted, done.fixed, done.unfixed)
    if path is None or not made.changed:
        return made
    try:
        write.replace(path, data, after)
    except write.NotWritten as error:
        return made._replace(after=before, data=data, linted=linted, fixed=(), failed=str(error))
    return made
