"""The fixes of one input, made and written, or only worked out."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ..engine import Linted
from ..finding import Finding
from ..source.text import encode
from . import rounds, write
from .rounds import Unfixed


class Mended(NamedTuple):
    """What fixes make of an input: its text before and after, what is found in that, and what they mended.

    `failed` says why the file could not be written; it is then as it was.
    """

    file: str
    before: str
    after: str
    data: bytes
    linted: Linted
    fixed: tuple[Finding, ...]
    unfixed: tuple[Unfixed, ...]
    failed: str = ""

    @property
    def changed(self) -> bool:
        return self.before != self.after


def mend(
    data: bytes, linted: Linted, lint: Callable[[bytes], Linted], wanted: Callable[[Finding], bool], unsafe: bool, path: str | None
) -> Mended:
    """Fixes an input that was judged. `lint` judges other contents of it; without `path` nothing is written."""
    done = rounds.fix(linted, lambda text: lint(encode(text, data)), unsafe, wanted)
    before = linted.source.text if linted.source is not None else ""
    after = encode(done.text, data) if done.text != before else data
    made = Mended(linted.file, before, done.text, after, done.linted, done.fixed, done.unfixed)
    if path is None or not made.changed:
        return made
    try:
        write.replace(path, data, after)
    except write.NotWritten as error:
        return made._replace(after=before, data=data, linted=linted, fixed=(), failed=str(error))
    return made
