"""Reports of many findings: none of those that say so has all of them in memory."""

from __future__ import annotations

import tracemalloc
from collections.abc import Iterator, Sequence

import pytest

from msaa_lint.cli.report import Options, render, statistics
from msaa_lint.core import spool
from msaa_lint.core.finding import Finding, Result, Suppressed
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from msaa_lint.linter.suppress import baseline
from tests.cli.report.sample import finding, result

COUNT = 3000
LENGTH = 3000


class Findings(Sequence[Finding]):
    """Findings that are created when they are read, as those of a temporary file."""

    def __len__(self) -> int:
        return COUNT

    def __getitem__(self, index: int) -> Finding:  # type: ignore[override]
        if index >= COUNT:
            raise IndexError
        severity = ("error", "warning", "note")[index % 3]
        return finding(
            f"{index} {'x' * LENGTH}",
            file=f"{index // 10}.yaml",
            severity=severity,
            subject=f"images.i{index % 10}",
        )


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch) -> Result:
    monkeypatch.setattr(spool, "MAX_VALUES", 50)
    monkeypatch.setattr(spool, "MAX_UNWRITTEN", 1)
    return result()._replace(
        findings=Findings(), files=[f"{number}.yaml" for number in range(COUNT // 10)]
    )


def peak(work: Iterator[None]) -> int:
    """The most bytes of Python objects that are allocated meanwhile."""
    next(work)
    tracemalloc.start()
    try:
        next(work, None)
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("format", sorted({*OUTPUT_FORMATS, "statistics"} - {"html"}))
def test_findings_are_not_kept(run: Result, format: str) -> None:
    def printing() -> Iterator[None]:
        # What is imported for the first report is not of this one.
        small = result(finding("m"))
        options = Options(step_summary="", show_suppressed=True)
        for each in (small, run):
            if format == "statistics":
                statistics.render(each, len, options)
            else:
                render(format, each, len, options)
            yield

    assert peak(printing()) < COUNT * LENGTH / 4


def test_a_baseline_counts_findings_without_keeping_them(run: Result) -> None:
    def counting() -> Iterator[None]:
        yield
        assert baseline.stale(baseline.build(run.findings), run.findings) == []

    assert peak(counting()) < COUNT * LENGTH / 4


def test_sarif_leaves_out_the_least_severe_of_those_that_are_suppressed_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from msaa_lint.cli.report import sarif

    monkeypatch.setattr(sarif, "MAX_RESULTS", 4)
    suppressed = [
        Suppressed(finding(f"s{number}", severity="error"), "inline") for number in range(2)
    ]
    found = [
        finding(f"m{number}", severity=severity)
        for number, severity in enumerate(("note", "warning", "note"))
    ]
    run = result(*found)._replace(suppressed=suppressed)
    texts: list[str] = []
    render("sarif", run, texts.append, Options(show_suppressed=True))
    text = "".join(texts)
    assert [name for name in ("m0", "m1", "m2", "s0", "s1") if f'"{name}."' in text] == [
        "m0",
        "m1",
        "m2",
        "s0",
    ]
