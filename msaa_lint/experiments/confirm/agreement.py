"""What the validation layer says of a frame against what we find in it: both, theirs alone, ours alone, and why."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Undecided
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.linter.rules.condition import Condition, activation

from .explanations import CONSEQUENCES, EXPLANATIONS
from .families import FAMILIES, Family
from .inputs import of_pass
from .layer_scope import Looking
from .messages import Message, bare, classify, sentence
from .noise import Noise
from .verdict import Said

BOTH = "both"
OURS = "ours"
THEIRS = "theirs"
EXPLAINED = "explained"
NOISE = "noise"

NO_CHECK = "no check of the layer has it"
SILENT = "the layer should have said this"


def agreement(
    frame: Frame,
    passes: Mapping[int, str],
    findings: Sequence[Finding],
    messages: Sequence[Message],
    looking: Looking,
    undecided: Sequence[Undecided] = (),
    device: DeviceProfile | None = None,
) -> dict[int, list[Said]]:
    """The rows of each pass.

    `passes` are those that ran: their numbers and names. `findings` are all of the frame's, silenced ones too, `undecided` what rules
    could not say; `device` is the profile that they were judged for. A message of no pass in particular goes to the first pass whose
    findings or facts answer to it.
    """
    if not passes:
        return {}
    this = _Frame(frame, passes, _Scope(findings, undecided, list(subjects(frame.document, device))))
    rows: dict[int, list[Said]] = {number: [] for number in passes}
    answered: set[Finding] = set()
    for message in _once(messages):
        number, said = this.told(message)
        answered.update(said.answers)
        rows[number].extend(each for each in said.rows if each not in rows[number])
    for number, own in this.own.items():
        for finding in own.findings:
            if finding not in answered:
                rows[number].append(this.unsaid(finding, looking, number))
    return rows


class _Scope(NamedTuple):
    """A pass, or the whole frame: what is found there, and what there is."""

    findings: Sequence[Finding]
    undecided: Sequence[Undecided]
    subjects: Sequence[Subject]


class _Rows(NamedTuple):
    """The rows of a message, and the findings that answer to it."""

    rows: list[Said]
    answers: Sequence[Finding] = ()


_LIKELY = (BOTH, NOISE, EXPLAINED, THEIRS)
"""Of a message that may be about several passes: which it is about, by what is said of it there."""


class _Frame:
    """What is the same for all messages of a frame."""

    def __init__(self, frame: Frame, passes: Mapping[int, str], everything: _Scope) -> None:
        self.everything = everything
        self.own: dict[int, _Scope] = {}
        by_name = {each.name: each for each in frame.passes}
        for number, name in passes.items():
            within = by_name.get(name)
            self.own[number] = _scope(frame, within, self.everything) if within is not None else self.everything
        self._by_path: dict[str, list[Subject]] = {}
        for subject in everything.subjects:
            self._by_path.setdefault(subject.path, []).append(subject)

    def told(self, message: Message) -> tuple[int, _Rows]:
        """The pass that a message is told with, and what is said of it there."""
        numbers = [message.number] if message.number in self.own else list(self.own)
        found = [(number, self.said(message, self.own[number])) for number in numbers]
        family = classify(message.id, message.text)
        if message.number not in self.own or (isinstance(family, Family) and family.looks.at):
            # It is said of the frame, or of what one pass does to another.
            found.append((numbers[0], self.said(message, self.everything)))
        return min(found, key=lambda each: _LIKELY.index(each[1].rows[0].verdict))

    def said(self, message: Message, scope: _Scope) -> _Rows:
        """What is to be said of a message within a scope."""
        family = classify(message.id, message.text)
        row = Said(THEIRS, message.id, family.name if isinstance(family, Family) else "", text=sentence(message.text))
        if isinstance(family, Noise):
            return _Rows([row._replace(verdict=NOISE, reason=family.reason)])
        if family is not None:
            both = [finding for finding in scope.findings if finding.rule in family.rules]
            if both:
                return _Rows([row._replace(verdict=BOTH, rule=rule) for rule in dict.fromkeys(finding.rule for finding in both)], both)
        reason = _follows(message, family, scope.findings) or (_explained(family, scope) if family is not None else "")
        return _Rows([row._replace(verdict=EXPLAINED, reason=reason) if reason else row])

    def unsaid(self, finding: Finding, looking: Looking, number: int) -> Said:
        """Why the layer says nothing of a finding."""
        row = Said(OURS, rule=finding.rule, text=finding.message)
        families = [family for family in FAMILIES if finding.rule in family.rules]
        if not families:
            return row._replace(reason=NO_CHECK)
        about = self._by_path.get(finding.subject, [])
        reasons = [_looks_away(family, about, looking, looking.kinds.get(number, "")) for family in families]
        if all(reasons):
            return row._replace(reason="; ".join(dict.fromkeys(reasons)))
        silent = ", ".join(family.name for family, reason in zip(families, reasons, strict=True) if not reason)
        return row._replace(reason=f"{SILENT} ({silent})", expected=True)


def _scope(frame: Frame, within: Pass, everything: _Scope) -> _Scope:
    """What of a frame has to do with a pass."""
    own = {f.subject for f in of_pass(frame, within, [_at(path) for path in {s.path for s in everything.subjects}])}
    return _Scope(
        of_pass(frame, within, everything.findings),
        [each for each in everything.undecided if each.subject in own],
        [each for each in everything.subjects if each.path in own],
    )


def _at(path: str) -> Finding:
    """Something found at a path, for whoever asks where that is."""
    return Finding("", "", "", "", "", "", None, path)


def _follows(message: Message, family: Family | None, findings: Iterable[Finding]) -> str:
    """Of which finding a message is a consequence."""
    words = bare(message.id)
    there = {finding.rule for finding in findings}
    for each in CONSEQUENCES:
        named = family is not None and family.name in each.ids
        if named or any(words.endswith(f"-{known}") for known in each.ids):
            rule = next((rule for rule in each.rules if rule in there), None)
            if rule is not None:
                return f"follows from {rule}: {each.reason}"
    return ""


def _explained(family: Family, scope: _Scope) -> str:
    for each in EXPLANATIONS:
        if each.family == family.name and any(_holds(each.when, subject) for subject in scope.subjects if subject.kind == each.subject):
            return each.reason
    for unknown in scope.undecided:
        if unknown.rule in family.rules:
            missing = ", ".join(unknown.missing) or "what it asks"
            return f"{unknown.rule} is undecided: the description does not say {missing}"
    return ""


def _looks_away(family: Family, about: Sequence[Subject], looking: Looking, kind: str) -> str:
    """Why a family's check does not look at what is found; empty where it does."""
    looks = family.looks
    if looks.passes and kind and kind not in looks.passes:
        return f"it looks at {_PASSES[looks.passes]} alone"
    if looks.vendors and not looking.vendors & set(looks.vendors):
        return f"the checks for {' and '.join(_VENDOR[each] for each in looks.vendors)} are not on"
    if looks.since is not None and looking.version is not None and looking.version < looks.since:
        return f"layers have it since {'.'.join(map(str, looks.since))}"
    if looks.lazy and looking.lazy_memory is False:
        return f"{looking.device} has no lazily allocated memory"
    if looks.device:
        return f"it judges {looking.device} and what is enabled there, not what the description is for"
    if looks.at:
        return f"it looks at {looks.at}"
    for subject, when, words in looks.when:
        if not any(_holds(when, each) for each in about if each.kind == subject):
            return words
    return ""


_PASSES = {
    ("renderPass",): "passes of vkCreateRenderPass",
    ("renderPass", "renderPass2"): "render passes",
    ("rendering",): "dynamic rendering",
}
_VENDOR = {"arm": "Arm", "amd": "AMD", "img": "IMG", "nvidia": "NVIDIA"}

_conditions: dict[str, Condition] = {}


def _holds(when: str, subject: Subject) -> bool:
    if when not in _conditions:
        _conditions[when] = Condition(when)
    asked = _conditions[when]
    values = subject.facts.values
    return asked.holds(activation(None, {name: values[name] for name in asked.facts if name in values})) is True


def _once(messages: Iterable[Message]) -> list[Message]:
    """Each message of a pass once, whatever objects it is said of."""
    return list({(m.id, m.number, sentence(m.text)): m for m in messages}.values())
