"""`msaa-lint facts`: what rules may ask, and what is known of an input."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from functools import partial

from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.table import FACTS, GLOBAL, SUBJECTS, Fact
from msaa_lint.input.capture_input import CaptureInput
from msaa_lint.input.opening import load

from .report.escape import visible

TYPES = {"BOOL": "bool", "INT": "int", "DOUBLE": "double", "STRING": "string", "LIST": "list(string)", "INTS": "list(int)"}


def reference(output: str) -> int:
    """Prints every fact by the subjects that have it."""
    if output == "json":
        import json

        rows = [
            {"fact": f.name, "type": TYPES[f.type], "texts": f.enum, "subjects": _subjects(f), "meaning": f.doc} for f in FACTS.values()
        ]
        print(json.dumps(rows, indent=2))
    elif output == "markdown":
        print(document(), end="")
    else:
        for subject, facts in SUBJECTS.items():
            print(f"{subject}:")
            for fact in facts:
                if fact not in GLOBAL:
                    print(f"  {fact.name:42} {TYPES[fact.type]:13} {fact.doc}")
        print("every subject:")
        for fact in GLOBAL:
            print(f"  {fact.name:42} {TYPES[fact.type]:13} {fact.doc}")
    return 0


def document() -> str:
    """The reference page of all facts, as Markdown."""
    out = [
        "# Facts\n\nWhat a rule's condition may ask. Made by `msaa-lint facts --output markdown`: do not edit.\n\n"
        "A fact that the input does not state is absent. "
        "A condition that hangs on an absent fact leaves its rule undecided; it never fires.\n"
    ]
    groups: dict[str, list[Fact]] = {}
    for fact in FACTS.values():
        groups.setdefault(fact.name.partition(".")[0], []).append(fact)
    for group, facts in groups.items():
        used = _subjects(facts[0])
        of = "every subject" if len(used) == len(SUBJECTS) else ", ".join(used)
        out.append(f"\n## {group}\n\nFor rules about: {of}.\n\n| fact | type | meaning |\n|---|---|---|\n")
        for fact in facts:
            texts = f" ({fact.enum})" if fact.enum.startswith("Vk") else ""
            out.append(f"| `{fact.name}` | {TYPES[fact.type]} | {fact.doc}{texts} |\n")
    return "".join(out)


def _subjects(fact: Fact) -> list[str]:
    return [subject for subject, facts in SUBJECTS.items() if fact in facts]


def of_input(path: str, output: str, profile: str | None) -> int:
    """Prints the facts of every subject of an input; 2 where it cannot be read."""
    from msaa_lint.frame.profiles import Problem, device_for, device_of
    from msaa_lint.input import readers
    from msaa_lint.input.source_file import SourceFile

    try:
        data = load(path, Limits())
        source = Source(path, decode(data)) if isinstance(data, bytes) else data.source
    except (OSError, Unreadable) as error:
        print(f"msaa-lint: {visible(path)}: {visible(str(error))}", file=sys.stderr)
        return 2
    rows: list[dict[str, object]] = []
    wrong = False
    documents: Iterable[Document]
    if isinstance(data, SourceFile):
        documents = data.program.documents
    else:
        parsed = parse(source, Limits())
        for problem in parsed.problems:
            print(f"msaa-lint: {visible(path)}: {visible(problem.message)}", file=sys.stderr)
        wrong = bool(parsed.problems)
        documents = (readers.read(source, root) for root in parsed.documents)
    for document in documents:
        from msaa_lint.frame.facts.subjects import subjects
        from msaa_lint.input.shader_modules import Modules
        from msaa_lint.linter.study_record import studied

        if isinstance(data, CaptureInput):
            document = document._replace(modules=data.modules)
        for mistake in document.problems:
            where = source.position(mistake.span.start)
            print(f"msaa-lint: {visible(path)}:{where.line}:{where.column}: {visible(mistake.message)}", file=sys.stderr)
        device = device_for(document.description, path, device_of(profile)) if not document.problems else None
        if isinstance(device, Problem):
            print(f"msaa-lint: {visible(path)}: {visible(device.message)}", file=sys.stderr)
        wrong = wrong or bool(document.problems) or isinstance(device, Problem)
        if not document.problems and not isinstance(device, Problem):
            study = partial(studied, file=path)
            shader = Modules(document, path).reflected
            rows.extend(_row(subject, source) for subject in subjects(document, device, study, shader))
    if output == "json":
        import json

        print(json.dumps(rows, indent=2, ensure_ascii=True))
    else:
        for line in _lines(rows):
            print(line)
    return 2 if wrong else 0


def _row(subject: Subject, source: Source) -> dict[str, object]:
    place = source.position(subject.head.start)
    facts = {}
    for fact in SUBJECTS[subject.kind]:
        at = subject.facts.places.get(fact.name)
        line = source.position(at.start).line if at is not None else None
        facts[fact.name] = {"value": subject.facts.values.get(fact.name), "line": line}
    return {"subject": subject.kind, "path": subject.path, "line": place.line, "column": place.column, "facts": facts}


def _lines(rows: list[dict[str, object]]) -> Iterator[str]:
    for row in rows:
        yield f"{row['subject']} {visible(str(row['path']))} (line {row['line']})"
        facts = row["facts"]
        assert isinstance(facts, dict)
        for name, fact in facts.items():
            if name.partition(".")[0] in ("frame", "device", "enabled", "scene") and fact["value"] is None:
                continue
            shown = "unknown" if fact["value"] is None else visible(_worded(fact["value"]))
            yield f"  {name:42} {shown}" + (f"  (line {fact['line']})" if fact["line"] is not None else "")


def _worded(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return "[" + ", ".join(str(item) for item in value) + "]" if isinstance(value, list) else str(value)
