"""Compares `msaa-lint check` on the source code of programs with what a person found in it.

    python tests/programs/source_programs.py FOLDER TABLE... [--program NAME...] [--texts]
    [--findings FOLDER]

FOLDER has a folder for each program. A TABLE has tab-separated columns with a heading: program,
kind, file, line, rule, verdict, reason.

- `expected`: a finding of that rule must be reported on that line. Of several lines with the same
  `MSAA401#name`, or with another rule and the same `#name`, one must have a finding.
- `debatable`: a finding may be reported there, or up to three lines away. It counts neither as true
  nor as false.
- `false`: no finding may be reported there. Neither may one at any place that the table does not
  have.
- `clean`: the program has no mistake; file and line are not used.

With `--texts`, it also counts the literal store operations and the sample counts above one in the
code, and how many of them a description has. `--findings` keeps what the command printed, a file
for each program.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
NEAR = 3
"""How many lines away a debatable finding may be."""

_COMMENTS = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)
_DEAD = re.compile(
    r"^[ \t]*#[ \t]*if[ \t]+0\b.*?^[ \t]*#[ \t]*(?:endif|else|elif)\b", re.DOTALL | re.MULTILINE
)
_VULKAN = re.compile(
    r"\b(?:VkImageCreateInfo|VkAttachmentDescription2?|VkRenderingAttachmentInfo|vk::(?:raii::)?\w+)"
)
_STORE = re.compile(
    r"\b(?:storeOp\s*=(?!=)|[sS]etStoreOp\s*\()[^;{}]*?(?:VK_ATTACHMENT_STORE_OP_|AttachmentStoreOp::e)"
)
_SAMPLES = re.compile(r"(?:[.>]samples\s*=(?!=)\s*|\.[sS]etSamples\s*\(\s*)(?P<count>[^;,\n]+)")
_ONE = re.compile(r"\bVK_SAMPLE_COUNT_1_BIT\b|SampleCountFlagBits::e1\b|^\s*1\s*\)?$|\.samples\b")
_SOURCES = (".c", ".cc", ".cpp", ".cxx", ".h", ".hpp", ".hxx", ".inl", ".ipp")
_LIBRARIES = re.compile(
    r"vk_mem_alloc|vulkan_(?:core|structs|raii|hash|handles|enums|funcs|to_string)|vulkan\.hpp|volk\."
)


@dataclass(frozen=True)
class Row:
    """A row of a table: a place where a finding is expected, debatable, or false. `group` names
    rows of which one suffices.
    """

    program: str
    kind: str
    file: str
    line: int
    code: str
    verdict: str
    group: str
    reason: str

    @property
    def place(self) -> tuple[str, int, str]:
        """The file, line, and rule."""
        return self.file, self.line, self.code


@dataclass(frozen=True)
class Finding:
    """A warning or an error."""

    file: str
    line: int
    code: str
    message: str

    @property
    def place(self) -> tuple[str, int, str]:
        """The file, line, and rule."""
        return self.file, self.line, self.code


@dataclass(frozen=True)
class Outcome:
    """The comparison of one program with its rows: groups of rows found and missed, and findings
    that are debatable or false.
    """

    program: str
    kind: str
    found: tuple[tuple[Row, ...], ...]
    missed: tuple[tuple[Row, ...], ...]
    debatable: tuple[Finding, ...]
    false: tuple[Finding, ...]


@dataclass
class Texts:
    """Lines with literal store operations and with sample counts above one, and those of them that
    a description has.
    """

    stores: int = 0
    stores_read: int = 0
    samples: int = 0
    samples_read: int = 0
    unread: list[str] = field(default_factory=list)

    def add(self, other: Texts) -> None:
        """Adds the counts of another."""
        self.stores += other.stores
        self.stores_read += other.stores_read
        self.samples += other.samples
        self.samples_read += other.samples_read


def table(path: Path) -> list[Row]:
    """Returns the rows of a table. Raises `ValueError` for a row that is not one."""
    rows = []
    with path.open(encoding="utf-8", newline="") as lines:
        for number, entry in enumerate(
            csv.DictReader(lines, delimiter="\t", quoting=csv.QUOTE_NONE), 2
        ):
            code, _, group = entry["rule"].partition("#")
            if entry["verdict"] not in ("expected", "debatable", "false", "clean"):
                raise ValueError(f"{path}:{number}: {entry['verdict']!r} is not a verdict")
            name = f"#{group}" if group else f"{code}:{entry['file']}:{entry['line']}"
            rows.append(
                Row(
                    entry["program"],
                    entry["kind"],
                    entry["file"],
                    int(entry["line"]),
                    code,
                    entry["verdict"],
                    name,
                    entry["reason"],
                )
            )
    return rows


def findings(report: str, folder: Path) -> list[Finding]:
    """Returns the warnings and errors about code in a JSON report on a folder, with paths relative
    to it.
    """
    entries = [
        entry
        for entry in json.loads(report)["findings"]
        if entry["severity"] != "note" and entry["code"] < "MSAA901"
    ]
    return sorted(
        {
            Finding(
                os.path.relpath(entry["file"], folder),
                entry["line"],
                entry["code"],
                entry["message"],
            )
            for entry in entries
        },
        key=lambda finding: (*finding.place, finding.message),
    )


def outcome(program: str, rows: Sequence[Row], reported: Iterable[Finding]) -> Outcome:
    """Compares the findings in a program with its rows."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        if row.verdict == "expected":
            groups.setdefault(row.group, []).append(row)
    listed = {finding.place: finding for finding in reported}
    expected = {row.place for group in groups.values() for row in group}
    denied = {row.place for row in rows if row.verdict == "false"}
    debatable, false = [], []
    for place, finding in listed.items():
        if place in expected:
            continue
        near = any(
            row.verdict == "debatable"
            and (row.file, row.code) == (finding.file, finding.code)
            and abs(row.line - finding.line) <= NEAR
            for row in rows
        )
        (debatable if near and place not in denied else false).append(finding)
    met = [tuple(group) for group in groups.values() if any(row.place in listed for row in group)]
    missed = [
        tuple(group) for group in groups.values() if not any(row.place in listed for row in group)
    ]
    return Outcome(
        program,
        rows[0].kind if rows else "",
        tuple(met),
        tuple(missed),
        tuple(debatable),
        tuple(false),
    )


def check(folder: Path) -> tuple[str, int, float, int]:
    """Returns what `msaa-lint check` prints about a folder as JSON, its exit code, its seconds of
    processor time, and its memory in MB.
    """
    command = [
        sys.executable,
        "-m",
        "msaa_lint",
        "check",
        "--isolated",
        "--no-respect-gitignore",
        "--output",
        "json",
        str(folder),
    ]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT)}, text=True
    ) as process:
        assert process.stdout is not None
        report = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    return report, process.returncode, usage.ru_utime + usage.ru_stime, usage.ru_maxrss // 1024


def without_comments(text: str) -> str:
    """Replaces comments, strings, and code under `#if 0` by blanks; lines stay where they are."""
    for pattern in (_COMMENTS, _DEAD):
        text = pattern.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)
    return text


def stated(text: str) -> tuple[set[int], set[int]]:
    """Returns the lines of code that state a literal store operation, and those that set a sample
    count that may be above one.
    """
    code = without_comments(text)
    if not _VULKAN.search(code):
        return set(), set()

    def line(offset: int) -> int:
        return code.count("\n", 0, offset) + 1

    samples = {
        line(match.start("count"))
        for match in _SAMPLES.finditer(code)
        if not _ONE.search(match["count"])
    }
    return {line(match.end()) for match in _STORE.finditer(code)}, samples


def places_read(folder: Path) -> set[tuple[str, str, int]]:
    """Returns the files, keys, and lines of the store operations and sample counts that the
    descriptions of a folder's programs have.
    """
    from msaa_lint.core.text.source import Unreadable
    from msaa_lint.core.text.span import Span
    from msaa_lint.input.code import language_of
    from msaa_lint.input.code.project.index import Index
    from msaa_lint.input.source_file import read_program, read_source_text, source_text
    from msaa_lint.linter.source_programs import is_read_together, programs

    paths = [
        str(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file() and is_read_together(path.name)
    ]
    places = set()
    for program in programs(paths, {}, {}, Index(os.getcwd(), lambda: None)):
        contents = [Path(path).read_bytes() for path in program.paths]
        languages = [
            language_of(path, data[:4096].decode("utf-8", "replace"))
            for path, data in zip(program.paths, contents, strict=True)
        ]
        files = [
            source_text(data, path, language or "cpp")
            for data, path, language in zip(contents, program.paths, languages, strict=True)
        ]
        try:
            read = (
                read_source_text(files[0])
                if len(files) == 1
                else read_program(files, program.includes, program.headers)
            )
        except Unreadable:
            continue
        for document in read.program.documents:
            for key, offset in _places(document.tree, "") if document.tree is not None else ():
                file, place = read.place(Span(offset, offset))
                places.add(
                    (
                        os.path.relpath(file.source.name, folder),
                        key,
                        file.source.position(place.start).line,
                    )
                )
    return places


def _places(node: object, key: str) -> Iterator[tuple[str, int]]:
    """The keys and offsets of the store operations and sample counts in a description."""
    from msaa_lint.core.text.node import Node

    assert isinstance(node, Node)
    if node.kind == "mapping":
        for name, value in node.value.items():
            yield from _places(value, str(name))
    elif node.kind == "sequence":
        for value in node.value:
            yield from _places(value, key)
    elif key in ("storeOp", "samples"):
        yield key, node.start


def texts(folder: Path) -> Texts:
    """Counts in the code of a program what states a store operation or a sample count, and how much
    of it a description has.
    """
    counts = Texts()
    read = places_read(folder)
    for path in sorted(folder.rglob("*")):
        if path.suffix not in _SOURCES or not path.is_file() or _LIBRARIES.search(path.name):
            continue
        stores, samples = stated(path.read_text(encoding="utf-8", errors="replace"))
        name = str(path.relative_to(folder))
        for key, lines in (("storeOp", stores), ("samples", samples)):
            missing = {line for line in lines if (name, key, line) not in read}
            counts.unread += [f"{name}:{line} {key}" for line in sorted(missing)]
            if key == "storeOp":
                counts.add(Texts(len(lines), len(lines) - len(missing)))
            else:
                counts.add(Texts(samples=len(lines), samples_read=len(lines) - len(missing)))
    return counts


def summary(outcomes: Iterable[Outcome]) -> list[str]:
    """Returns lines with recall and precision by kind of program, and in all."""
    everything = list(outcomes)
    by_kind: dict[str, list[Outcome]] = {}
    for each in everything:
        by_kind.setdefault(each.kind, []).append(each)
    lines = [
        f"{'kind':12} {'programs':>8} {'found':>6} {'of':>4} {'recall':>7} {'false':>6} "
        f"{'precision':>9} {'debatable':>9}"
    ]
    for kind, group in [*sorted(by_kind.items()), ("all", everything)]:
        found = sum(len(each.found) for each in group)
        total = found + sum(len(each.missed) for each in group)
        false = sum(len(each.false) for each in group)
        debatable = sum(len(each.debatable) for each in group)
        recall = f"{found / total:.2f}" if total else "-"
        precision = f"{found / (found + false):.2f}" if found + false else "-"
        lines.append(
            f"{kind:12} {len(group):8} {found:6} {total:4} {recall:>7} {false:6} {precision:>9} "
            f"{debatable:9}"
        )
    return lines


def report(each: Outcome) -> list[str]:
    """Returns the missed, false, and debatable findings of a program as lines."""
    lines = []
    for group in each.missed:
        row = group[0]
        lines.append(
            f"    missed    {row.file}:{row.line} "
            f"{row.code}{row.group if row.group[0] == '#' else ''} {row.reason}"
        )
    lines += [
        f"    false     {finding.file}:{finding.line} {finding.code} {finding.message}"
        for finding in each.false
    ]
    lines += [
        f"    debatable {finding.file}:{finding.line} {finding.code} {finding.message}"
        for finding in each.debatable
    ]
    return lines


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints a comparison for each program, and the totals. Returns 1 if a finding is missed or
    false.
    """
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("tables", type=Path, nargs="+")
    parser.add_argument("--program", action="append", default=[])
    parser.add_argument("--texts", action="store_true")
    parser.add_argument("--findings", type=Path)
    given = parser.parse_args(arguments)
    sys.path.insert(0, str(ROOT))
    rows = [row for path in given.tables for row in table(path)]
    outcomes = []
    total = Texts()
    for program in dict.fromkeys(row.program for row in rows):
        folder = given.folder / program
        if (given.program and program not in given.program) or not folder.is_dir():
            continue
        printed, code, seconds, memory = check(folder)
        if given.findings:
            given.findings.mkdir(parents=True, exist_ok=True)
            (given.findings / f"{program}.json").write_text(printed, encoding="utf-8")
        compared = outcome(
            program,
            [row for row in rows if row.program == program],
            findings(printed, folder) if printed else [],
        )
        outcomes.append(compared)
        expected = len(compared.found) + len(compared.missed)
        head = (
            f"{program:20} {compared.kind:10} found {len(compared.found)} of {expected}, false "
            f"{len(compared.false)}"
        )
        print(
            f"{head}; {seconds:.1f} s, {memory} MB"
            + (f", exit code {code}" if code not in (0, 1) else "")
        )
        print(*report(compared), sep="\n", end="\n" if report(compared) else "")
        if given.texts:
            counts = texts(folder)
            total.add(counts)
            print(
                f"    read      storeOp {counts.stores_read} of {counts.stores}, samples "
                f"{counts.samples_read} of {counts.samples}"
            )
            print(
                *(f"    unread    {place}" for place in counts.unread),
                sep="\n",
                end="\n" if counts.unread else "",
            )
        sys.stdout.flush()
    print(*summary(outcomes), sep="\n")
    if given.texts:
        print(
            f"storeOp read: {total.stores_read} of {total.stores}; samples read: "
            f"{total.samples_read} of {total.samples}"
        )
    return int(any(each.missed or each.false for each in outcomes))


if __name__ == "__main__":
    sys.exit(main())
