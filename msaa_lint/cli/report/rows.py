"""The rows of the tables of a run, in the columns of `linter.corpus.tables`. Texts of inputs have
their lone surrogates escaped, and figures six decimals.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain

from msaa_lint.core.finding import (
    CaptureSummary,
    InputSummary,
    PassTraffic,
    Price,
    Result,
    Suppressed,
)
from msaa_lint.linter.corpus.tables import SCHEMA, Row
from msaa_lint.linter.results import location_order

from . import Options
from .data import rounded, text
from .escape import escape_surrogates
from .fingerprint import fingerprints
from .paths import relative
from .place import place
from .summary import is_summed, usable_price

_DOCUMENT = re.compile(r"documents\[(\d{1,9})\]\.")
_PATH_END = re.compile(r"[.\[]")
_VERSION = re.compile(r"(.*\S) (\d+(?:\.\d+)+)")

_LIMIT = 2**63 - 1


def rows(
    result: Result,
    passes: Sequence[PassTraffic],
    configuration: str,
    options: Options,
    owners: Mapping[str, Sequence[str]] = {},
) -> dict[str, Iterable[Row]]:
    """The rows of each table by its name, which are made as they are read. Findings in files with
    `owners` are about their passes.
    """
    counts = (len(result.inputs), len(result.findings) + len(result.suppressed), len(passes))
    return {
        "findings": _findings(result, passes, owners, options),
        "passes": (_pass(each, options) for each in passes),
        "inputs": (_input(each, options) for each in result.inputs),
        "run": [(SCHEMA, options.version, text(options.edition), configuration, *counts)],
    }


def _findings(
    result: Result,
    passes: Sequence[PassTraffic],
    owners: Mapping[str, Sequence[str]],
    options: Options,
) -> Iterator[Row]:
    """The rows of the findings with those that are suppressed, by file and place, whatever order
    the run prints them in.
    """
    # A long run has its findings in a file, in which they are looked up by number.
    count = len(result.findings)
    by_file: dict[str, list[int]] = {}
    for number, found in enumerate(
        chain(result.findings, (entry.finding for entry in result.suppressed))
    ):
        by_file.setdefault(found.file, []).append(number)
    numbers = _by_file(passes)
    order = {file: number for number, file in enumerate(result.files)}
    for file in sorted(by_file, key=lambda file: (order.get(file, -1), file)):
        names = _names(
            passes,
            chain.from_iterable(numbers.get(owner, ()) for owner in owners.get(file, [file])),
        )
        entries = [
            Suppressed(result.findings[number], "")
            if number < count
            else result.suppressed[number - count]
            for number in by_file.pop(file)
        ]
        entries.sort(key=lambda entry: (location_order(entry.finding), entry.finding.subject))
        identifiers = fingerprints((entry.finding for entry in entries), options.root)
        for entry, identifier in zip(entries, identifiers, strict=True):
            yield _finding(entry, identifier, names, result, options)


def _names(
    passes: Sequence[PassTraffic], numbers: Iterable[int]
) -> dict[tuple[int, str], str | None]:
    """The names of passes by frame and path; None if they differ, since a file may be of several
    programs.
    """
    names: dict[tuple[int, str], str | None] = {}
    for each in map(passes.__getitem__, numbers):
        key = each.frame, each.path
        names[key] = each.name if names.get(key, each.name) == each.name else None
    return names


def _by_file(passes: Sequence[PassTraffic]) -> dict[str, range]:
    """The places of the passes of each file, which are together."""
    numbers: dict[str, range] = {}
    for number, each in enumerate(passes):
        numbers[each.file] = range(
            numbers[each.file].start if each.file in numbers else number, number + 1
        )
    return numbers


def _finding(
    entry: Suppressed,
    identifier: str,
    names: Mapping[tuple[int, str], str | None],
    result: Result,
    options: Options,
) -> Row:
    """The row of a finding, or of a suppressed one, of which it is said how."""
    found = entry.finding
    frame, subject = _frame(found.subject)
    price, at, call = (
        usable_price(found),
        place(result, found.file, found.span),
        found.capture_location,
    )
    return (
        _file(found.file, options),
        frame,
        _pass_of(frame or 0, subject, names),
        text(found.rule),
        text(found.code),
        found.severity,
        found.confidence,
        *_figures(price),
        price is not None and is_summed(found),
        at.line if at else None,
        at.column if at else None,
        text(call.by) if call else None,
        _integer(call.call) if call else None,
        _integer(call.frames) if call else None,
        text(found.subject),
        text(found.message),
        entry.how or None,
        text(entry.reason) or None,
        identifier,
    )


def _figures(price: Price | None) -> Iterable[float | None]:
    """The figures of a price in the order of the columns."""
    if price is None:
        return (None,) * 4
    return map(
        rounded, (price.read_mb_per_s, price.write_mb_per_s, price.memory_mib, price.milliwatts)
    )


def _frame(subject: str) -> tuple[int | None, str]:
    """The index of the frame that a subject is in, and its path there."""
    stated = _DOCUMENT.match(subject)
    if stated is None:
        return (0 if subject else None), subject
    return int(stated[1]), subject[stated.end() :]


def _pass_of(frame: int, subject: str, names: Mapping[tuple[int, str], str | None]) -> str | None:
    """The name of the pass that a subject belongs to: that of the longest path that it begins
    with.
    """
    if not names:
        return None
    ends = [len(subject), *reversed([match.start() for match in _PATH_END.finditer(subject)])]
    found = (names.get((frame, subject[:end])) for end in ends)
    return next((text(name) for name in found if name is not None), None)


def _pass(each: PassTraffic, options: Options) -> Row:
    return (
        _file(each.file, options),
        each.frame,
        text(each.name),
        text(each.path),
        each.kind,
        _integer(each.width),
        _integer(each.height),
        _integer(each.times),
        _integer(each.samples),
        rounded(each.read_mb_per_s),
        rounded(each.write_mb_per_s),
        rounded(each.memory_mib),
        rounded(each.milliwatts),
        text(each.unknown) or None,
    )


def _input(summary: InputSummary, options: Options) -> Row:
    capture = summary.capture
    frames, kinds = (capture.frames, capture.kinds) if capture else (summary.frames, summary.frames)
    engine, version = _engine(capture)
    return (
        _file(summary.file, options),
        summary.format or None,
        text(capture.program) or None if capture else None,
        engine,
        version,
        text(capture.device if capture and capture.device else summary.device) or None,
        _integer(frames),
        _integer(kinds),
        summary.images,
        summary.passes,
        summary.pipelines,
        summary.shaders,
        summary.choices,
        summary.failed,
        text(summary.unread.message) if summary.unread else None,
    )


def _engine(capture: CaptureSummary | None) -> tuple[str | None, str | None]:
    """The engine of a capture's program, and its version."""
    stated = text(capture.engine) if capture else ""
    parts = _VERSION.fullmatch(stated)
    return (parts[1], parts[2]) if parts is not None else (stated or None, None)


def _file(file: str, options: Options) -> str:
    return escape_surrogates(relative(file, options.root))


def _integer(value: int | None) -> int | None:
    """A number that 64 bits hold."""
    return None if value is None else min(value, _LIMIT)
