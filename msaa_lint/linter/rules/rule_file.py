"""A rule's page: YAML front matter, then Markdown."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import os
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, Node, parse, read

FENCE = "---"
MAX_PAGE = 1 << 20
MAX_CONDITION = 2000
"""Characters of a condition: a user's page may come from an untrusted branch, and what CEL does is bounded by what it is given."""


SAFETIES = ("safe", "unsafe", "shown")
"""Of a fix: the picture cannot change by it; it may, or the fix is a choice; it is said and priced, and never made."""


class Setting(NamedTuple):
    """One change of a fix: a fact, the value that it gets, gains or loses, and where the page states it.

    A text in braces names a fact of the subject, whose value is meant.
    """

    fact: str
    value: str | bool | int | float
    at: Span


class FixSpec(NamedTuple):
    """A fix, in terms of what the facts are made from: `set` gives a member a value, `add` and `remove` change a list, `do` names a
    change that `fixes.deeds` knows."""

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
"""Whose frames a rule may be about, as pages name them."""


class Case(NamedTuple):
    """What changes where a rule fires and `when` holds as well; the first case that holds is taken. `fix` is the one that then counts."""

    when: str
    severity: str | None
    confidence: str | None
    message: str | None
    condition_at: Span = Span(0, 0)
    fix: FixSpec | None = None
    help: str | None = None


class Rule(NamedTuple):
    """A rule, as its page's front matter states it.

    `when` and the cases are CEL; `at` and the labels name facts, whose places they point to. `apis` are those whose frames it is asked of.
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

    @property
    def fix_specs(self) -> "tuple[FixSpec, ...]":
        """Its fixes: its own and those of its cases."""
        return tuple(dict.fromkeys(mend for mend in (self.fix, *(case.fix for case in self.cases)) if mend is not None))


class Page(NamedTuple):
    """A page as it was read: the rule, if it could be, what is wrong with it, and its text, if it has one."""

    rule: Rule | None
    problems: tuple[Finding, ...]
    source: Source | None = None


KEYS = (
    "code", "severity", "confidence", "subject", "when", "message", "at", "labels", "cases", "help", "fix", "vendors", "edition",
    "references", "supersedes", "apis",
)  # fmt: skip
REQUIRED = ("code", "severity", "subject", "when", "message")


def read_page(path: str, shown: str) -> Page:
    """The rule that a page states. `shown` is the path as messages name it."""
    name = os.path.basename(path).removesuffix(".md")
    try:
        text = decode(read(path, Limits(bytes=MAX_PAGE)))
    except (OSError, Unreadable) as error:
        return Page(None, (diagnostic("MSAA921", f"the rule page cannot be read: {error}", shown),))
    source = Source(shown, text)
    front, body = split(text)
    if front is None:
        return Page(
            None, (diagnostic("MSAA921", "a rule page begins with front matter between two lines of ---", shown, Span(0, 0)),), source
        )
    parsed = parse(Source(shown, front), Limits())
    if parsed.problems:
        found = [diagnostic("MSAA921", p.message, shown, p.span, name, tuple(p.labels)) for p in parsed.problems]
        return Page(None, tuple(found), source)
    reading = _Reading(shown, name, source)
    root = parsed.documents[0] if parsed.documents else None
    if root is None or root.kind != "mapping":
        reading.wrong(Span(0, 0), "the front matter is a mapping")
        return Page(None, tuple(reading.problems), source)
    rule = reading.rule(root, body, path)
    return Page(rule if not reading.problems else None, tuple(reading.problems), source)


def split(text: str) -> tuple[str | None, str]:
    """The front matter, at its offsets (what stands before it is blank), and the Markdown after it."""
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
    """What a page says first: the first sentence of its first paragraph."""
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


class _Reading:
    """One page while its front matter is read."""

    def __init__(self, shown: str, name: str, source: Source) -> None:
        self.shown = shown
        self.name = name
        self.source = source
        self.problems: list[Finding] = []

    def wrong(self, span: Span, message: str, help: str = "") -> None:
        self.problems.append(diagnostic("MSAA921", f"rule page `{self.name}`: {message}", self.shown, span, self.name, (), help))

    def rule(self, root: Node, body: str, path: str) -> Rule | None:
        from msaa_lint.frame.facts.table import SUBJECTS, WORDS

        members: dict[str, Node] = root.value
        for key in members:
            if key not in KEYS:
                self.unknown(root.keys[key], KEYS)
        missing = [key for key in REQUIRED if key not in members]
        if missing:
            self.wrong(Span(0, len(FENCE)), f"the front matter lacks {', '.join(missing)}")
            return None
        self.one_of(members["subject"], tuple(SUBJECTS))
        self.one_of(members["severity"], SEVERITIES)
        if "confidence" in members:
            self.one_of(members["confidence"], CONFIDENCES)
        for vendor in self.items(members.get("vendors")):
            self.one_of(vendor, WORDS["vendor"])
        apis = self.items(members.get("apis"))
        for api in apis:
            self.one_of(api, APIS)
        when = members["when"]
        self.bounded(when)
        at = members.get("at")
        fix = self.mend(members["fix"], None) if "fix" in members else None
        return Rule(
            code=self.text(members["code"]),
            name=self.name,
            severity=members["severity"].text,
            confidence=members["confidence"].text if "confidence" in members else "high",
            subject=members["subject"].text,
            when=self.text(when),
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
        )

    def unknown(self, key: Node, known: tuple[str, ...]) -> None:
        from msaa_lint.core.suggestions import nearest

        close = nearest(key.text, known)
        self.wrong(key.span, f"unknown key `{key.text[:80]}`", f"did you mean `{close}`?" if close else f"it may have {', '.join(known)}")

    def text(self, node: Node) -> str:
        if node.kind != "scalar" or node.value is None:
            self.wrong(node.span, "a text is due here")
            return ""
        return node.text.strip()

    def bounded(self, when: Node) -> None:
        if len(when.text) > MAX_CONDITION:
            self.wrong(when.span, f"a condition has at most {MAX_CONDITION} characters")

    def one_of(self, node: Node, words: tuple[str, ...]) -> None:
        if node.kind != "scalar" or node.text not in words:
            self.wrong(node.span, f"one of {', '.join(words)} is due here")

    def items(self, node: Node | None) -> list[Node]:
        if node is None:
            return []
        if node.kind != "sequence":
            self.wrong(node.span, "a list is due here")
            return []
        return list(node.value)

    def texts(self, node: Node | None) -> tuple[str, ...]:
        return tuple(self.text(item) for item in self.items(node))

    def pairs(self, node: Node | None) -> tuple[tuple[str, str], ...]:
        if node is None:
            return ()
        if node.kind != "mapping":
            self.wrong(node.span, "a mapping is due here")
            return ()
        return tuple((key, self.text(value)) for key, value in node.value.items())

    def case(self, node: Node, fix: FixSpec | None) -> Case:
        """A case; without `fix`, or where that states its safety alone, the rule's own is its fix."""
        known = ("when", "severity", "confidence", "message", "help", "fix")
        if node.kind != "mapping" or "when" not in node.value:
            self.wrong(node.span, "a case is a mapping with `when` and what it changes")
            return Case("true", None, None, None)
        for key in node.value:
            if key not in known:
                self.unknown(node.keys[key], known)
        given = {key: self.text(value) for key, value in node.value.items() if key != "fix"}
        if "severity" in given:
            self.one_of(node.value["severity"], SEVERITIES)
        if "confidence" in given:
            self.one_of(node.value["confidence"], CONFIDENCES)
        when = node.value["when"]
        self.bounded(when)
        own = node.value.get("fix")
        if own is not None:
            fix = None if own.kind == "scalar" and own.value is None else self.mend(own, fix)
        texts = (given.get("severity"), given.get("confidence"), given.get("message"))
        return Case(given["when"], *texts, when.span, fix, given.get("help"))

    def mend(self, node: Node, of_rule: FixSpec | None) -> FixSpec | None:
        """A fix. One that states its safety alone, in a case, is the rule's with that safety."""
        known = ("title", "safety", "set", "add", "remove", "do")
        members = node.value if node.kind == "mapping" else {}
        inherits = of_rule is not None and list(members) == ["safety"]
        if not inherits and ("title" not in members or "safety" not in members):
            self.wrong(node.span, f"a fix is a mapping with `title`, `safety` ({', '.join(SAFETIES)}) and what it changes")
            return None
        for key in members:
            if key not in known:
                self.unknown(node.keys[key], known)
        self.one_of(members["safety"], SAFETIES)
        safety = members["safety"].text
        if inherits and of_rule is not None:
            return of_rule._replace(safety=safety)
        if {"set", "add", "remove", "do"}.isdisjoint(members):
            self.wrong(node.span, "a fix states what it changes: `set`, `add`, `remove` or `do`")
        given, added, removed = (self.changes(members.get(key), key) for key in ("set", "add", "remove"))
        do = self.text(members["do"]) if "do" in members else ""
        return FixSpec(self.text(members["title"]), safety, given, added, removed, do, node.span)

    def changes(self, node: Node | None, action: str) -> tuple[Setting, ...]:
        """The facts that a fix changes, with their values; a list of values is as many changes."""
        if node is None:
            return ()
        if node.kind != "mapping":
            self.wrong(node.span, "a mapping of facts to values is due here")
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
            from msaa_lint.core.suggestions import nearest

            close = nearest(key.text, FACTS)
            self.wrong(key.span, f"there is no fact {key.text[:80]}", f"did you mean `{close}`?" if close else "")
        elif (fact.type == "LIST") != (action != "set"):
            self.wrong(key.span, f"{fact.name} is {'a list' if fact.type == 'LIST' else 'no list'}: `{action}` is not for it")
        elif value.kind != "scalar" or not (_names_fact(value) or _is_of(value.value, fact.type)):
            self.wrong(value.span, f"a value of {fact.name} ({fact.type}) is due here")
        return Setting(key.text, value.value if value.kind == "scalar" else "", value.span)


_TYPES = {"BOOL": (bool,), "INT": (int,), "DOUBLE": (int, float), "STRING": (str,), "LIST": (str,)}


def _is_of(value: object, type_name: str) -> bool:
    """Whether a value is of a fact's type, or one of its list's."""
    return type(value) in _TYPES.get(type_name, ())


def _names_fact(node: Node) -> bool:
    """Whether a value is a fact in braces."""
    return isinstance(node.value, str) and node.text[:1] == "{" and node.text[-1:] == "}"
