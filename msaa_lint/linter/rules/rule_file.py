"""Reads rule pages: YAML front matter, then Markdown."""

import os
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import CONFIDENCES, SEVERITIES, Finding
from msaa_lint.core.project import Outside
from msaa_lint.core.quote import quoted
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, Node, parse

from .front_matter import FENCE, first_sentence, mistake, split
from .rule import APIS, PASSES, SAFETIES, Case, FixSpec, Rule, Setting, page_problem

MAX_PAGE_BYTES = 1 << 20
MAX_CONDITION = 2000
"""Characters of a condition. A page may come from an untrusted branch, and the cost of a CEL
expression grows with its length.
"""

MAX_TEXT = 2000
"""Characters of any other text of the front matter: every finding has a copy of it, with its facts
filled in.
"""

MAX_ITEMS = 100
"""Of each list and mapping: cases, labels, references, the facts that a fix changes."""

MAX_PROBLEMS = 50
"""Problems of a page that are reported."""

FRONT_MATTER = Limits(depth=20, nodes=10_000)
"""Aliases expanded."""


def _in_front_matter(message: str) -> str:
    """The message of a YAML error, for a page: what begins with an exclamation mark there is a
    condition.
    """
    return (
        f"{message}; put a condition that begins with `!` in quotes"
        if message.startswith("the tag `!")
        else message
    )


class Page(NamedTuple):
    """The result of reading a page: the rule if it is valid, the problems, the text if it could be
    read, and the code if it is stated.
    """

    rule: Rule | None
    problems: tuple[Finding, ...]
    source: Source | None = None
    code: str = ""


KEYS = (
    "code", "severity", "confidence", "subject", "when", "message", "at", "labels", "cases",
    "help", "fix", "vendors", "edition",
    "references", "supersedes", "apis", "passes",
)  # fmt: skip
REQUIRED = ("code", "severity", "subject", "when", "message")


def read_page(path: str, shown: str, project: str | None) -> Page:
    """Reads a rule page. `shown` is the path in messages; `project` is None for a built-in page,
    and for a page of the command line.
    """
    name = os.path.basename(path).removesuffix(".md")
    try:
        text = decode(read(path, MAX_PAGE_BYTES, project))
    except Outside as error:
        return Page(
            None,
            (
                diagnostic(
                    "MSAA921",
                    f"cannot read the rule page: {error}; only `--rules` can name such a page",
                    shown,
                ),
            ),
        )
    except (OSError, Unreadable) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        return Page(None, (diagnostic("MSAA921", f"cannot read the rule page: {reason}", shown),))
    source = Source(shown, text)
    front, body = split(text)
    if front is None:
        return Page(None, (page_problem(name, shown, *mistake(text)),), source)
    parsed = parse(Source(shown, front), FRONT_MATTER)
    if parsed.problems:
        problems = [
            page_problem(name, shown, _in_front_matter(p.message), p.span)._replace(
                labels=tuple(p.labels)
            )
            for p in parsed.problems
        ]
        return Page(None, tuple(problems), source)
    reader = _PageReader(shown, name, source)
    root = parsed.documents[0] if parsed.documents else None
    if root is None or root.kind != "mapping":
        stated = f"found {_kind(root)}" if root is not None else "it is empty"
        reader.problem(
            root.span if root is not None else Span(0, len(FENCE)),
            f"the front matter must be a mapping of keys, {stated}",
        )
        return Page(None, tuple(reader.problems), source)
    rule = reader.rule(root, body, path)
    code = root.value["code"].text.strip() if "code" in root.value else ""
    return Page(rule if not reader.problems else None, tuple(reader.problems), source, code)


class _PageReader:
    """Reads the front matter of one page."""

    def __init__(self, shown: str, name: str, source: Source) -> None:
        self.shown = shown
        self.name = name
        self.source = source
        self.problems: list[Finding] = []
        self.texts: list[tuple[str, Span]] = []
        self.named: list[tuple[str, Span]] = []

    def problem(self, span: Span, message: str) -> None:
        if len(self.problems) < MAX_PROBLEMS:
            self.problems.append(page_problem(self.name, self.shown, message, span))

    def rule(self, root: Node, body: str, path: str) -> Rule | None:
        from msaa_lint.frame.facts.table import SUBJECTS
        from msaa_lint.frame.facts.words import WORDS

        members: dict[str, Node] = root.value
        meant = self.unknown(root, KEYS)
        missing = [key for key in REQUIRED if key not in members]
        if missing:
            unmentioned = [f"`{key}`" for key in missing if key not in meant]
            if unmentioned:
                self.problem(
                    Span(0, len(FENCE)), f"missing {', '.join(unmentioned)} in the front matter"
                )
            return None
        for key, words in (
            ("subject", tuple(SUBJECTS)),
            ("severity", SEVERITIES),
            ("confidence", CONFIDENCES),
            ("passes", PASSES),
        ):
            if key in members:
                self.one_of(members[key], words, key)
        for vendor in self.items(members.get("vendors"), "vendors"):
            self.one_of(vendor, WORDS["vendor"], "vendors")
        apis = self.items(members.get("apis"), "apis")
        for api in apis:
            self.one_of(api, APIS, "apis")
        for key in ("code", "when", "message"):
            if (
                members[key].kind == "scalar"
                and members[key].value is not None
                and not members[key].text.strip()
            ):
                self.problem(members[key].span, f"`{key}` must not be empty")
        when = members["when"]
        at = self.items(members.get("at"), "at", scalar=True)
        fix = self.fix(members["fix"], None) if "fix" in members else None
        self.named += [(node.text, node.span) for node in at if len(node.text) <= MAX_TEXT]
        return Rule(
            code=self.text(members["code"], "code"),
            name=self.name,
            severity=members["severity"].text,
            confidence=members["confidence"].text if "confidence" in members else "high",
            subject=members["subject"].text,
            when=self.condition(when),
            message=self.prose(members["message"], "message"),
            at=tuple(self.text(node, "at") for node in at),
            labels=self.labels(members.get("labels")),
            cases=tuple(self.case(node, fix) for node in self.items(members.get("cases"), "cases")),
            help=self.prose(members["help"], "help") if "help" in members else "",
            fix=fix,
            vendors=self.strings(members, "vendors"),
            edition=self.text(members["edition"], "edition") if "edition" in members else "",
            references=self.strings(members, "references"),
            supersedes=self.strings(members, "supersedes"),
            summary=first_sentence(body),
            path=path,
            condition_at=when.span,
            source=self.source,
            apis=tuple(dict.fromkeys(api.text for api in apis)) or APIS[:1],
            passes=members["passes"].text if "passes" in members else PASSES[0],
            places={key: node.span for key, node in members.items()},
            texts=tuple(self.texts),
            named=tuple(self.named),
        )

    def unknown(self, mapping: Node, known: Sequence[str]) -> set[str]:
        """Reports the keys of a mapping that are not known; returns the known ones that are likely
        meant by them.
        """
        from msaa_lint.core.suggestions import near_or_all, nearest

        keys = [key for key in mapping.value if key not in known][
            : MAX_PROBLEMS - len(self.problems)
        ]
        for key in keys:
            self.problem(
                mapping.keys[key].span, f"unknown key {quoted(key)}: {near_or_all(key, known)}"
            )
        return {meant for key in keys if (meant := nearest(key, known)) is not None}

    def prose(self, node: Node, key: str) -> str:
        """A text with facts in braces."""
        text = self.text(node, key)
        self.texts.append((node.text if text else "", node.span))
        return text

    def text(self, node: Node, key: str = "", what: str = "", limit: int = MAX_TEXT) -> str:
        if node.kind != "scalar" or node.value is None:
            self.problem(node.span, f"{_of(key)}expected a string, found {_kind(node)}")
            return ""
        if len(node.text) > limit:
            self.problem(node.span, f"{what or f'`{key}`'} is longer than {limit} characters")
            return ""
        return node.text.strip()

    def condition(self, when: Node) -> str:
        return self.text(when, "when", "the condition", MAX_CONDITION)

    def one_of(self, node: Node, words: Sequence[str], key: str) -> None:
        if node.kind != "scalar" or node.text not in words:
            from msaa_lint.core.suggestions import did_you_mean

            hint = did_you_mean(node.text, words) if node.kind == "scalar" else ""
            self.problem(
                node.span, f"`{key}`: expected one of {', '.join(words)}, found {_kind(node)}{hint}"
            )

    def items(self, node: Node | None, key: str, scalar: bool = False) -> list[Node]:
        """The items of a list; `scalar` allows one item instead of a list of it."""
        if node is None:
            return []
        if node.kind == "sequence":
            return list(node.value) if self.at_most(node, key) else []
        if scalar:
            return [node]
        example = (
            f"; write `[{node.text}]`" if node.kind == "scalar" and node.value is not None else ""
        )
        self.problem(node.span, f"{_of(key)}expected a list, found {_kind(node)}{example}")
        return []

    def at_most(self, node: Node, key: str) -> bool:
        """Whether a list or mapping has no more items than the limit."""
        if len(node.value) > MAX_ITEMS:
            self.problem(
                node.span, f"`{key}`: expected at most {MAX_ITEMS} items, found {len(node.value)}"
            )
        return len(node.value) <= MAX_ITEMS

    def strings(self, members: Mapping[str, Node], key: str) -> tuple[str, ...]:
        return tuple(self.text(item, key) for item in self.items(members.get(key), key))

    def labels(self, node: Node | None) -> tuple[tuple[str, str], ...]:
        if node is None:
            return ()
        if node.kind != "mapping":
            self.problem(node.span, f"`labels`: expected a mapping, found {_kind(node)}")
            return ()
        if not self.at_most(node, "labels"):
            return ()
        self.named += [(key, node.keys[key].span) for key in node.value]
        return tuple((key, self.prose(value, key)) for key, value in node.value.items())

    def case(self, node: Node, fix: FixSpec | None) -> Case:
        """A case. Without a `fix`, or with one that only states its safety, it has the fix of the
        rule.
        """
        known = ("when", "severity", "confidence", "message", "help", "fix")
        meant = self.unknown(node, known) if node.kind == "mapping" else set()
        if node.kind != "mapping" or "when" not in node.value:
            if "when" not in meant:
                self.problem(node.span, "a case must be a mapping with `when` and what differs")
            return Case("true", None, None, None)
        texts = {
            key: self.prose(value, key)
            for key, value in node.value.items()
            if key in ("message", "help")
        }
        for key, words in (("severity", SEVERITIES), ("confidence", CONFIDENCES)):
            if key in node.value:
                self.one_of(node.value[key], words, key)
                texts[key] = node.value[key].text
        when = node.value["when"]
        case_fix = node.value.get("fix")
        if case_fix is not None:
            fix = (
                None
                if case_fix.kind == "scalar" and case_fix.value is None
                else self.fix(case_fix, fix)
            )
        changed = (texts.get("severity"), texts.get("confidence"), texts.get("message"))
        return Case(self.condition(when), *changed, when.span, fix, texts.get("help"))

    def fix(self, node: Node, of_rule: FixSpec | None) -> FixSpec | None:
        """A fix. In a case, one that only states its safety is the fix of the rule with that
        safety.
        """
        known = ("title", "safety", "set", "add", "remove", "do")
        members = node.value if node.kind == "mapping" else {}
        inherits = of_rule is not None and list(members) == ["safety"]
        meant = self.unknown(node, known) if members else set()
        missing = [key for key in ("title", "safety") if key not in members and not inherits]
        if missing:
            if meant.isdisjoint(missing):
                stated = f"; missing {', '.join(f'`{key}`' for key in missing)}" if members else ""
                self.problem(
                    node.span,
                    f"a fix must be a mapping with `title`, `safety` ({', '.join(SAFETIES)}) and "
                    f"what it changes{stated}",
                )
            return None
        self.one_of(members["safety"], SAFETIES, "safety")
        safety = members["safety"].text
        if inherits and of_rule is not None:
            return of_rule._replace(safety=safety)
        if _CHANGES.isdisjoint(members) and _CHANGES.isdisjoint(meant):
            self.problem(
                node.span, "a fix must state what it changes: `set`, `add`, `remove` or `do`"
            )
        set_, added, removed = (
            self.changes(members.get(key), key) for key in ("set", "add", "remove")
        )
        do = self.text(members["do"], "do") if "do" in members else ""
        return FixSpec(
            self.prose(members["title"], "title"),
            safety,
            set_,
            added,
            removed,
            do,
            members.get("do", node).span,
        )

    def changes(self, node: Node | None, action: str) -> tuple[Setting, ...]:
        """The facts that a fix changes with their values; a list of values gives one change for
        each.
        """
        if node is None:
            return ()
        if node.kind != "mapping":
            self.problem(node.span, f"expected a mapping of facts to values, found {_kind(node)}")
            return ()
        if not self.at_most(node, action):
            return ()
        found = []
        for fact, value in node.value.items():
            items = (
                self.items(value, fact) if value.kind == "sequence" and action != "set" else [value]
            )
            found += [self.setting(node.keys[fact], item, action) for item in items]
        return tuple(found)

    def setting(self, key: Node, value: Node, action: str) -> Setting:
        from msaa_lint.frame.facts.table import FACTS

        fact = FACTS.get(key.text)
        if fact is None:
            from msaa_lint.core.suggestions import did_you_mean

            self.problem(
                key.span, f"unknown fact {quoted(key.text)}{did_you_mean(key.text, FACTS, ': ')}"
            )
        elif (fact.type == "LIST") != (action != "set"):
            kind, instead = (
                ("a list", "`add` or `remove`") if fact.type == "LIST" else ("not a list", "`set`")
            )
            self.problem(
                key.span,
                f"{fact.name} is {kind}: it cannot be changed with `{action}`; use {instead}",
            )
        elif value.kind != "scalar" or not (
            _names_fact(value) or type(value.value) in _TYPES.get(fact.type, ())
        ):
            self.problem(
                value.span, f"expected a value of {fact.name} ({fact.type}), found {_kind(value)}"
            )
        return Setting(
            key.text, value.value if value.kind == "scalar" else "", value.span, key.span
        )


_CHANGES = frozenset({"set", "add", "remove", "do"})
_TYPES = {"BOOL": (bool,), "INT": (int,), "DOUBLE": (int, float), "STRING": (str,), "LIST": (str,)}
"""The types of a fact's value, or of its elements."""


def _names_fact(node: Node) -> bool:
    """Whether a value is a fact in braces."""
    return isinstance(node.value, str) and node.text[:1] == "{" and node.text[-1:] == "}"


def _of(key: str) -> str:
    return f"`{key}`: " if key else ""


def _kind(node: Node) -> str:
    if node.kind != "scalar":
        return "a mapping" if node.kind == "mapping" else "a list"
    return "nothing" if node.value is None else quoted(node.text)
