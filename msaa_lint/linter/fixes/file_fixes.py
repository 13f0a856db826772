"""The fixes of one input, written to its file or only computed."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from msaa_lint.core import atomic_write
from msaa_lint.core.finding import Finding
from msaa_lint.core.text.source import encode
from msaa_lint.linter.programs import merged
from msaa_lint.linter.results import FileResult, unmerged

from .fixer import FailedFix, fix_text


class FixedText(NamedTuple):
    """An input before and after its fixes.

    `data` is the text after them, encoded like the input, and `result` the result of linting it. If
    the file could not be written, nothing is fixed, and `write_error` is the reason.
    """

    file: str
    before: str
    after: str
    data: bytes
    result: FileResult
    fixed_findings: tuple[Finding, ...] = ()
    failed_fixes: tuple[FailedFix, ...] = ()
    write_error: str = ""

    @property
    def changed(self) -> bool:
        """Whether the fixes change the text."""
        return self.before != self.after


def fix_input(
    data: bytes,
    result: FileResult,
    lint: Callable[[bytes], FileResult],
    selects: Callable[[Finding], bool],
    unsafe: bool,
    path: str | None,
) -> FixedText:
    """Fixes the findings of an input that `selects` accepts and, if `path` is given, writes the
    result there.

    `lint` lints other contents of the same input. `unsafe` applies unsafe fixes as well.
    """
    fixes = fix_text(
        unmerged(result), lambda text: unmerged(lint(encode(text, data))), unsafe, selects
    )
    before = result.source.text if result.source is not None else ""
    after = encode(fixes.text, data) if fixes.text != before else data
    fixed = FixedText(
        result.file,
        before,
        fixes.text,
        after,
        merged(fixes.result),
        fixes.fixed_findings,
        fixes.failed_fixes,
    )
    if path is None or not fixed.changed:
        return fixed
    try:
        atomic_write.replace(path, data, after)
    except atomic_write.NotWritten as error:
        return fixed._replace(
            after=before, data=data, result=result, fixed_findings=(), write_error=str(error)
        )
    return fixed
