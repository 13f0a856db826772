"""Reads rule pages: YAML front matter, then Markdown."""

import os
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, Node, parse, read

FENCE = "---"
MAX_PAGE_BYTES = 1 << 20
MAX_CONDITION = 2000
"""Characters of a condition. A page may come from an untrusted branch, and the cost of a CEL expression grows with its length."""

SAFETIES = ("safe", "unsafe", "shown")
"""Of a fix: it cannot change the picture; it may change the picture or needs a decision; it is shown with its price, but never applied."""


class Setting(NamedTuple):
    """One change of a fix: a fact, the value to set, add or remove, and its location on the page.

    A value in braces names another fact of the subject, whose value is used.
    """

    fact: str
    value: str | bool | int | float
    at: Span


class FixSpec(NamedTuple):
    """A fix in terms of facts: `set` sets the member that a fact comes from, `add` and `remove` change a list, and `do` names an action of
    `linter.fixes`."""

    title: str
    safety: str
    set: tuple[Setting, ...] = ()
    add: tuple[Setting, ...] = ()
    remove: tuple[Setting, ...] = ()
    do: str = ""
    at: Span = Span(0, 0)

    @property
    def safe(self) -> bool:
        return self.safety == "safe"


APIS = ("vulkan", "metal")
"""The APIs whose frames a rule may be about."""

PASSES = ("begun", "all")
"""The passes that a rule about parts of passes applies to: those that the frame begins, or also those that are only created."""


class Case(NamedTuple):
    """What differs if a rule fires and `when` is true as well. The first such case applies; its `fix` replaces the rule's."""

    when: str
    severity: str | None
    confidence: str | None
    message: str | None
    condition_at: Span = Span(0, 0)
    fix: FixSpec | None = None
    help: str | None = None


class Rule(NamedTuple):
    """A rule as stated by the front matter of its page.

    `when` is a CEL condition. `at` and `labels` name facts and refer to their locations. `apis` are those whose frames the rule applies to,
    `passes` the passes (one of PASSES).
    """

    code: str
    name: str
    severity: str
    confidence: str
    subject: str
    when: str
    message: str
    at: tuple[str, ...]
    labels: tuple[tuple[str, str], ...]
    cases: tuple[Case, ...]
    help: str
    fix: FixSpec | None
    vendors: tuple[str, ...]
    edition: str
    references: tuple[str, ...]
    supersedes: tuple[str, ...]
    summary: str
    path: str
    condition_at: Span
    source: Source
    apis: tuple[str, ...] = APIS[:1]
    passes: str = PASSES[0]

    @property
    def fix_specs(self) -> "tuple[FixSpec, ...]":
        """The fixes of the rule and of its cases."""
        return tuple(dict.fromkeys(fix for fix in (self.fix, *(case.fix for case in self.cases)) if fix is not None))

    def problem(self, message: str, span: Span) -> Finding:
        """A finding about the rule's page (MSAA921)."""
        return page_problem(self.name, self.source.name, message, span)


def page_problem(rule: str, page: str, message: str, span: Span) -> Finding:
    """A finding about the page of a rule (MSAA921)."""
    return diagnostic("MSAA921", f"rule page `{rule}`: {message}", page, span, rule)


class Page(NamedTuple):
    """The result of reader a page: the rule if it is valid, the problems, and the text if it could be read."""

    rule: Rule | None
    problems: tuple[Finding, ...]
    source: Source | None = None


KEYS = (
    "code", "severity", "confidence", "subject", "when", "message", "at", "labels", "cases", "help", "fix", "vendors", "edition",
    "references", "supersedes", "apis", "passes",
)  # fmt: skip
REQUIRED = ("code", "severity", "subject", "when", "message")


def read_page(path: str, shown: str) -> Page:
    """Reads a rule page. `shown` is the path in messages."""
    name = os.path.basename(path).removesuffix(".md")
    try:
        text = decode(read(path, Limits(bytes=MAX_PAGE_BYTES)))
    except (OSError, Unreadable) as error:
        return Page(None, (diagnostic("MSAA921", f"cannot read the rule page: {error}", shown),))
    source = Source(shown, text)
    front, body = split(text)
    if front is None:
        message = "a rule page must begin with front matter between two `---` lines"
        return Page(None, (diagnostic("MSAA921", message, shown, Span(0, 0)),), source)
    parsed = parse(Source(shown, front), Limits())
    if parsed.problems:
        problems = [diagnostic("MSAA921", p.message, shown, p.span, name, tuple(p.labels)) for p in parsed.problems]
        return Page(None, tuple(problems), source)
    reader = _PageReader(shown, name, source)
    root = parsed.documents[0] if parsed.documents else None
    if root is None or root.kind != "mapping":
        reader.problem(Span(0, 0), "the front matter must be a mapping")
        return Page(None, tuple(reader.problems), source)
    rule = reader.rule(root, body, path)
    return Page(rule if not reader.problems else None, tuple(reader.problems), source)


def split(text: str) -> tuple[str | None, str]:
    """The front matter, padded with blanks so that offsets are those of the page, and the Markdown after it."""
    first = text.find("\n") + 1
    if text[:first].rstrip() != FENCE:
        return None, text
    start = text.find("\n" + FENCE, first - 1) + 1
    while start > 0:
        body = text.find("\n", start) + 1 or len(text)
        if text[start:body].rstrip() == FENCE:
            return " " * (first - 1) + "\n" + text[first:start], text[body:]
        start = text.find("\n" + FENCE, start) + 1
    return None, text


def first_sentence(body: str) -> str:
    """The first sentence of the first paragraph."""
    paragraph: list[str] = []
    for line in body.splitlines():
        text = line.strip()
        if text.startswith(("#", "```")) and not paragraph:
            continue
        if not text:
            if paragraph:
                break
            continue
        paragraph.append(text)
    joined = " ".join(paragraph)
    end = joined.find(". ")
    return joined if end < 0 else joined[: end + 1]


class _PageReader:
    """Reads the front matter of one page."""

    def __init__(self, shown: str, name: str, source: Source) -> None:
        self.shown = shown
        self.name = name
        self.source = source
        self.problems: list[Finding] = []

    def problem(self, span: Span, message: str) -> None:
        self.problems.append(page_problem(self.name, self.shown, message, span))

    def rule(self, root: Node, body: str, path: str) -> Rule | None:
        from msaa_lint.frame.facts.table import SUBJECTS
        from msaa_lint.frame.facts.words import WORDS

        members: dict[str, Node] = root.value
        for key in members:
            if key not in KEYS:
                self.unknown(root.keys[key], KEYS)
        missing = [key for key in REQUIRED if key not in members]
        if missing:
            self.problem(Span(0, len(FENCE)), f"missing {', '.join(f'`{key}`' for key in missing)} in the front matter")
            return None
        self.one_of(members["subject"], tuple(SUBJECTS))
        self.one_of(members["severity"], SEVERITIES)
        if "confidence" in members:
            self.one_of(members["confidence"], CONFIDENCES)
        if "passes" in members:
            self.one_of(members["passes"], PASSES)
        for vendor in self.items(members.get("vendors")):
            self.one_of(vendor, WORDS["vendor"])
        apis = self.items(members.get("apis"))
        for api in apis:
            self.one_of(api, APIS)
        when = members["when"]
        at = members.get("at")
        fix = self.fix(members["fix"], None) if "fix" in members else None
        return Rule(
            code=self.text(members["code"]),
            name=self.name,
            severity=members["severity"].text,
            confidence=members["confidence"].text if "confidence" in members else "high",
            subject=members["subject"].text,
            when=self.condition(when),
            message=self.text(members["message"]),
            at=() if at is None else self.texts(at) if at.kind == "sequence" else (self.text(at),),
            labels=self.pairs(members.get("labels")),
            cases=tuple(self.case(node, fix) for node in self.items(members.get("cases"))),
            help=self.text(members["help"]) if "help" in members else "",
            fix=fix,
            vendors=self.texts(members.get("vendors")),
            edition=self.text(members["edition"]) if "edition" in members else "",
            references=self.texts(members.get("references")),
            supersedes=self.texts(members.get("supersedes")),
            summary=first_sentence(body),
            path=path,
            condition_at=when.span,
            source=self.source,
            apis=tuple(dict.fromkeys(api.text for api in apis)) or APIS[:1],
            passes=members["passes"].text if "passes" in members else PASSES[0],
        )

    def unknown(self, key: Node, known: tuple[str, ...]) -> None:
        from msaa_lint.core.suggestions import near_or_all

        self.problem(key.span, f"unknown key {quoted(key.text)}: {near_or_all(key.text, known)}")

    def text(self, node: Node) -> str:
        if node.kind != "scalar" or node.value is None:
            self.problem(node.span, f"expected a string, found {_kind(node)}")
            return ""
        return node.text.strip()

    def condition(self, when: Node) -> str:
        if len(when.text) > MAX_CONDITION:
            self.problem(when.span, f"the condition is longer than {MAX_CONDITION} characters")
        return self.text(when)

    def one_of(self, node: Node, words: tuple[str, ...]) -> None:
        if node.kind != "scalar" or node.text not in words:
            self.problem(node.span, f"expected one of {', '.join(words)}, found {_kind(node)}")

    def items(self, node: Node | None) -> list[Node]:
        if node is None:
            return []
        if node.kind != "sequence":
            self.problem(node.span, f"expected a list, found {_kind(node)}")
            return []
        return list(node.value)

    def texts(self, node: Node | None) -> tuple[str, ...]:
        return tuple(self.text(item) for item in self.items(node))

    def pairs(self, node: Node | None) -> tuple[tuple[str, str], ...]:
        if node is None:
            return ()
        if node.kind != "mapping":
            self.problem(node.span, f"expected a mapping, found {_kind(node)}")
            return ()
        return tuple((key, self.text(value)) for key, value in node.value.items())

    def case(self, node: Node, fix: FixSpec | None) -> Case:
        """A case. Without a `fix`, or with one that only states its safety, it has the fix of the rule."""
        known = ("when", "severity", "confidence", "message", "help", "fix")
        if node.kind != "mapping" or "when" not in node.value:
            self.problem(node.span, "a case must be a mapping with `when` and what differs")
            return Case("true", None, None, None)
        for key in node.value:
            if key not in known:
                self.unknown(node.keys[key], known)
        texts = {key: self.text(value) for key, value in node.value.items() if key not in ("when", "fix")}
        for key, words in (("severity", SEVERITIES), ("confidence", CONFIDENCES)):
            if key in texts:
                self.one_of(node.value[key], words)
        when = node.value["when"]
        case_fix = node.value.get("fix")
        if case_fix is not None:
            fix = None if case_fix.kind == "scalar" and case_fix.value is None else self.fix(case_fix, fix)
        changed = (texts.get("severity"), texts.get("confidence"), texts.get("message"))
        return Case(self.condition(when), *changed, when.span, fix, texts.get("help"))

    def fix(self, node: Node, of_rule: FixSpec | None) -> FixSpec | None:
        """A fix. In a case, one that only states its safety is the fix of the rule with that safety."""
        known = ("title", "safety", "set", "add", "remove", "do")
        members = node.value if node.kind == "mapping" else {}
        inherits = of_rule is not None and list(members) == ["safety"]
        if not inherits and ("title" not in members or "safety" not in members):
            self.problem(node.span, f"a fix must be a mapping with `title`, `safety` ({', '.join(SAFETIES)}) and what it changes")
            return None
        for key in members:
            if key not in known:
                self.unknown(node.keys[key], known)
        self.one_of(members["safety"], SAFETIES)
        safety = members["safety"].text
        if inherits and of_rule is not None:
            return of_rule._replace(safety=safety)
        if {"set", "add", "remove", "do"}.isdisjoint(members):
            self.problem(node.span, "a fix must state what it changes: `set`, `add`, `remove` or `do`")
        set_, added, removed = (self.changes(members.get(key), key) for key in ("set", "add", "remove"))
        do = self.text(members["do"]) if "do" in members else ""
        return FixSpec(self.text(members["title"]), safety, set_, added, removed, do, node.span)

    def changes(self, node: Node | None, action: str) -> tuple[Setting, ...]:
        """The facts that a fix changes with their values; a list of values gives one change for each."""
        if node is None:
            return ()
        if node.kind != "mapping":
            self.problem(node.span, f"expected a mapping of facts to values, found {_kind(node)}")
            return ()
        found = []
        for fact, value in node.value.items():
            many = value.kind == "sequence" and action != "set"
            found += [self.setting(node.keys[fact], item, action) for item in (value.value if many else [value])]
        return tuple(found)

    def setting(self, key: Node, value: Node, action: str) -> Setting:
        from msaa_lint.frame.facts.table import FACTS

        fact = FACTS.get(key.text)
        if fact is None:
            from msaa_lint.core.suggestions import did_you_mean

            self.problem(key.span, f"unknown fact {quoted(key.text)}{did_you_mean(key.text, FACTS, ': ')}")
        elif (fact.type == "LIST") != (action != "set"):
            self.problem(
                key.span, f"{fact.name} is {'a list' if fact.type == 'LIST' else 'not a list'}: it cannot be changed with `{action}`"
            )
        elif value.kind != "scalar" or not (_names_fact(value) or type(value.value) in _TYPES.get(fact.type, ())):
            self.problem(value.span, f"expected a value of {fact.name} ({fact.type}), found {_kind(value)}")
        return Setting(key.text, value.value if value.kind == "scalar" else "", value.span)


_TYPES = {"BOOL": (bool,), "INT": (int,), "DOUBLE": (int, float), "STRING": (str,), "LIST": (str,)}
"""The types of a fact's value, or of its elements."""


def _names_fact(node: Node) -> bool:
    """Whether a value is a fact in braces."""
    return isinstance(node.value, str) and node.text[:1] == "{" and node.text[-1:] == "}"


def _kind(node: Node) -> str:
    if node.kind != "scalar":
        return "a mapping" if node.kind == "mapping" else "a list"
    return "nothing" if node.value is None else quoted(node.text)
