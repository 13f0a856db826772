"""The findings of a run, in the order of its files."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby

from msaa_lint.core.finding import Finding, rank
from msaa_lint.core.rendered import RenderedFinding
from msaa_lint.core.spool import SpooledSort

from .results import price_order
from .workspace import Workspace

Found = Finding | RenderedFinding


class RunFindings:
    """The findings of the inputs, and those of the run: about the configuration, rule pages, and
    paths.

    The former are those after settings. Of a file the latter come first.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._rows: SpooledSort[Found] = SpooledSort(workspace.spool, 3)
        self._numbers: dict[str, int] = {}

    def begin(self, files: Sequence[str]) -> None:
        """Sets the order of the files, which others come before."""
        self._numbers = {file: number for number, file in enumerate(files)}

    def number(self, file: str) -> int:
        """The number of a file in the order; -1 for others."""
        return self._numbers.get(file, -1)

    def add(self, problems: Sequence[Finding], findings: Sequence[Found]) -> None:
        """Adds the findings of an input: about reading it, and others. Those of the run up to now
        come before the former.
        """
        of_run = self._workspace.findings
        self._add(0, [*of_run, *problems])
        of_run.clear()
        self._add(1, findings)

    def _add(self, phase: int, findings: Iterable[Found]) -> None:
        by_file: dict[str, list[Found]] = {}
        for finding in findings:
            by_file.setdefault(finding.file, []).append(finding)
        for file, of_file in by_file.items():
            self._rows.add(
                (self.number(file), file.encode("utf-8", "surrogatepass"), phase), of_file
            )

    def __iter__(self) -> Iterator[Finding]:
        """The findings as they were added."""
        self.add((), ())
        for _, findings in self._rows:
            yield from _unrendered(findings)

    def by_file(self) -> Iterator[Finding]:
        """The findings to report, each once."""
        return _unrendered(self.in_order())

    def in_order(self) -> Iterator[Found]:
        """As `by_file`, with those that are rendered."""
        self.add((), ())
        # A broken rule page comes first: other findings of the configuration may be due to it.
        broken = {page.encode("utf-8", "surrogatepass") for page in self._workspace.broken_pages()}
        if broken:
            first = [row for row in self._rows if row[0][1] in broken]
            yield from self._shown(sorted(first, key=lambda row: row[0][1]))
        yield from self._shown(row for row in self._rows if row[0][1] not in broken)

    def by_price(self) -> Iterator[Finding]:
        """The findings to report, the highest price first."""
        rows: SpooledSort[Finding] = SpooledSort(self._workspace.spool, 2)
        for finding in self.by_file():
            rows.add(price_order(finding), [finding])
        for _, findings in rows:
            yield from findings

    def _shown(
        self, rows: Iterable[tuple[tuple[int, bytes, int], Sequence[Found]]]
    ) -> Iterator[Found]:
        """What is reported of sorted rows. Two configurations may name the same broken rule page,
        and two programs the same header.
        """
        current = self._workspace.current
        settle, least = current.selection.settle, rank(current.settings.min_severity)
        for _, of_file in groupby(rows, key=lambda row: row[0][1]):
            findings = (
                settled
                for (_, _, phase), group in of_file
                for found in group
                if (settled := settle(found) if not phase and isinstance(found, Finding) else found)
                is not None
            )
            for found in dict.fromkeys(findings):
                if (
                    isinstance(found, RenderedFinding)
                    or found.fatal
                    or rank(found.severity) >= least
                ):
                    yield found


def _unrendered(findings: Iterable[Found]) -> Iterator[Finding]:
    return (found for found in findings if isinstance(found, Finding))
