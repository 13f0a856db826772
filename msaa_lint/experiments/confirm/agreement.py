"""How the validation layer's messages about a frame agree with the findings: both, theirs alone,
ours alone, and why.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import NamedTuple

from msaa_lint.core.finding import Finding, Undecided
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.linter.rules.condition import Condition, activation

from .explanations import CONSEQUENCES, EXPLANATIONS, Noise
from .families import FAMILIES, Family
from .inputs import concerns
from .layer_scope import LayerScope
from .message_scope import MessageScope, MessageScopes
from .messages import Message, bare, classify, sentence
from .outcome import AgreementRow

BOTH = "both"
OURS = "ours"
THEIRS = "theirs"
EXPLAINED = "explained"
NOISE = "noise"

NO_CHECK = "the layer has no such check"
NOT_BEGUN = "no command begins the pass"
SILENT = "the layer should have reported this"

_LIKELIHOOD = (BOTH, NOISE, EXPLAINED, THEIRS)
"""The order in which passes are preferred for a message that may be about several of them, by its
verdict there.
"""


def agreement(
    frame: Frame,
    passes: Mapping[int, str],
    findings: Sequence[Finding],
    messages: Sequence[Message],
    layer: LayerScope,
    undecided: Sequence[Undecided] = (),
    device: DeviceProfile | None = None,
    facts: Sequence[Subject] | None = None,
) -> dict[int, list[AgreementRow]]:
    """The rows of each pass.

    `passes` are those that ran: their numbers and names. `findings` are all of the frame's,
    suppressed ones included; `undecided` are the rules that could not be decided; `device` is the
    profile that they were checked against; `facts` are the frame's subjects, by default those of
    this frame alone. A message about no pass in particular goes to the first pass whose findings or
    facts account for it.
    """
    if not passes:
        return {}
    matcher = _Matcher(
        frame,
        passes,
        _Scope(
            findings,
            undecided,
            facts if facts is not None else list(subjects(frame.document, device)),
        ),
    )
    rows: dict[int, list[AgreementRow]] = {number: [] for number in passes}
    reported: set[Finding] = set()
    for message in _unique(messages):
        number, match = matcher.match(message)
        reported.update(match.findings)
        rows[number].extend(row for row in match.rows if row not in rows[number])
    for number, scope in matcher.by_pass.items():
        for finding in scope.findings:
            if finding not in reported:
                rows[number].append(matcher.unreported(finding, layer, number))
    return rows


class _Scope(NamedTuple):
    """A pass or the whole frame: its findings, undecided rules and subjects."""

    findings: Sequence[Finding]
    undecided: Sequence[Undecided]
    subjects: Sequence[Subject]


class _Match(NamedTuple):
    """The rows of a message, and the findings that account for it."""

    rows: list[AgreementRow]
    findings: Sequence[Finding] = ()


class _Matcher:
    """Matches the messages about a frame with its findings."""

    def __init__(self, frame: Frame, passes: Mapping[int, str], frame_scope: _Scope) -> None:
        self.frame_scope = frame_scope
        self.by_pass: dict[int, _Scope] = {}
        self._scopes = MessageScopes(frame, frame_scope.subjects)
        by_name = {described.name: described for described in frame.passes}
        self._passes = {number: by_name[name] for number, name in passes.items() if name in by_name}
        for number in passes:
            described = self._passes.get(number)
            self.by_pass[number] = (
                _pass_scope(frame, described, frame_scope) if described is not None else frame_scope
            )
        self._by_path: dict[str, list[Subject]] = {}
        for subject in frame_scope.subjects:
            self._by_path.setdefault(subject.path, []).append(subject)

    def match(self, message: Message) -> tuple[int, _Match]:
        """The pass that a message is reported with, and its rows there."""
        family = classify(message.id, message.text)
        image = self._scopes.image(message.image) if message.image else None
        if image is not None:
            # An image is created with the first pass that needs it, which may be one that only
            # reads it, and resolved after another pass.
            attaching = [
                number
                for number, described in self._passes.items()
                if described.name in image.pass_names
            ]
            number = next(
                (number for number in (*attaching, message.number) if number in self.by_pass),
                next(iter(self.by_pass)),
            )
            return number, self._match_within(message, _narrowed(self.frame_scope, image))
        numbers = [message.number] if message.number in self.by_pass else list(self.by_pass)
        matches = []
        for number in numbers:
            part = self._scopes.attachment(
                message, family if isinstance(family, Family) else None, self._passes.get(number)
            )
            scope = self.by_pass[number]
            matches.append(
                (
                    number,
                    self._match_within(
                        message, _narrowed(scope, part) if part is not None else scope
                    ),
                )
            )
        if message.number not in self.by_pass or (
            isinstance(family, Family) and family.scope.instead
        ):
            # The message is about the frame, or about the effect of one pass on another.
            matches.append((numbers[0], self._match_within(message, self.frame_scope)))
        return min(matches, key=lambda match: _LIKELIHOOD.index(match[1].rows[0].verdict))

    def _match_within(self, message: Message, scope: _Scope) -> _Match:
        family = classify(message.id, message.text)
        row = AgreementRow(
            THEIRS,
            message.id,
            family.name if isinstance(family, Family) else "",
            text=sentence(message.text),
        )
        if isinstance(family, Noise):
            return _Match([row._replace(verdict=NOISE, reason=family.reason)])
        if family is not None:
            findings = [finding for finding in scope.findings if finding.rule in family.rules]
            if findings:
                rules = dict.fromkeys(finding.rule for finding in findings)
                return _Match([row._replace(verdict=BOTH, rule=rule) for rule in rules], findings)
        reason = _consequence(message, family, scope.findings) or (
            _explanation(family, scope) if family is not None else ""
        )
        return _Match([row._replace(verdict=EXPLAINED, reason=reason) if reason else row])

    def unreported(self, finding: Finding, layer: LayerScope, number: int) -> AgreementRow:
        """The row of a finding that the layer does not report, with the reason."""
        row = AgreementRow(OURS, rule=finding.rule, text=finding.message)
        families = [family for family in FAMILIES if finding.rule in family.rules]
        if not families:
            return row._replace(reason=NO_CHECK)
        about = self._by_path.get(finding.subject, [])
        reasons = [
            _not_checked(family, about, layer, layer.kinds.get(number, "")) for family in families
        ]
        if all(reasons):
            return row._replace(reason="; ".join(dict.fromkeys(reasons)))
        silent = ", ".join(
            family.name for family, reason in zip(families, reasons, strict=True) if not reason
        )
        return row._replace(reason=f"{SILENT} ({silent})", expected=True)


def _pass_scope(frame: Frame, described: Pass, frame_scope: _Scope) -> _Scope:
    """The findings, undecided rules and subjects that concern a pass."""
    return _Scope(
        [
            finding
            for finding in frame_scope.findings
            if concerns(frame, described, finding.subject)
        ],
        [rule for rule in frame_scope.undecided if concerns(frame, described, rule.subject)],
        [subject for subject in frame_scope.subjects if concerns(frame, described, subject.path)],
    )


def _narrowed(scope: _Scope, part: MessageScope) -> _Scope:
    """What of a scope concerns the parts of a frame that a message is about."""
    return _Scope(
        [finding for finding in scope.findings if part.has(finding.subject)],
        [rule for rule in scope.undecided if part.has(rule.subject)],
        [subject for subject in scope.subjects if part.has(subject.path)],
    )


def _consequence(message: Message, family: Family | None, findings: Iterable[Finding]) -> str:
    """The finding that a message is a consequence of, in words; empty for none."""
    name = bare(message.id)
    rules = {finding.rule for finding in findings}
    for consequence in CONSEQUENCES:
        in_family = family is not None and family.name in consequence.ids
        if in_family or any(name.endswith(f"-{id}") for id in consequence.ids):
            rule = next((rule for rule in consequence.rules if rule in rules), None)
            if rule is not None:
                return f"follows from {rule}: {consequence.reason}"
    return ""


def _explanation(family: Family, scope: _Scope) -> str:
    """Why no rule reports messages of a family in a scope; empty if unexplained."""
    for explanation in EXPLANATIONS:
        if explanation.family == family.name and any(
            _holds(explanation.when, subject)
            for subject in scope.subjects
            if subject.kind == explanation.subject
        ):
            return explanation.reason
    for rule in scope.undecided:
        if rule.rule in family.rules:
            missing = ", ".join(key.path for key in rule.keys) or "the required facts"
            return f"{rule.rule} is undecided: the description does not state {missing}"
    passes = [subject for subject in scope.subjects if subject.kind == "pass"]
    return (
        NOT_BEGUN
        if passes and all(subject.facts.values["pass.begun"] == "NO" for subject in passes)
        else ""
    )


def _not_checked(family: Family, about: Sequence[Subject], layer: LayerScope, kind: str) -> str:
    """Why the layer's check of a family does not cover a finding; empty where it does."""
    scope = family.scope
    if scope.passes and kind and kind not in scope.passes:
        return f"it checks {_PASSES[scope.passes]} only"
    if scope.vendors and not layer.vendors & set(scope.vendors):
        return f"the checks for {' and '.join(_VENDOR[vendor] for vendor in scope.vendors)} are off"
    if scope.since is not None and layer.version is not None and layer.version < scope.since:
        return f"layers have this check since {'.'.join(map(str, scope.since))}"
    if scope.lazy and layer.lazy_memory is False:
        return f"{layer.device} has no lazily allocated memory"
    if scope.device:
        return (
            f"it checks against {layer.device} and what is enabled there, not against the "
            "device that the description is for"
        )
    if scope.instead:
        return f"it checks {scope.instead}"
    if any(
        subject.facts.values.get("pass.begun") == "NOT_STATED"
        and subject.facts.values["frame.has_commands"]
        for subject in about
    ):
        return NOT_BEGUN
    for subject_kind, when, text in scope.when:
        if not any(_holds(when, subject) for subject in about if subject.kind == subject_kind):
            return text
    return ""


_PASSES = {
    ("renderPass",): "passes of vkCreateRenderPass",
    ("renderPass", "renderPass2"): "render passes",
    ("rendering",): "dynamic rendering",
}
_VENDOR = {"arm": "Arm", "amd": "AMD", "img": "IMG", "nvidia": "NVIDIA"}


@cache
def _condition(when: str) -> Condition:
    return Condition(when)


def _holds(when: str, subject: Subject) -> bool:
    condition = _condition(when)
    values = subject.facts.values
    return (
        condition.holds(
            activation(None, {name: values[name] for name in condition.facts if name in values})
        )
        is True
    )


def _unique(messages: Iterable[Message]) -> list[Message]:
    """Each message of a pass or an image once, however many objects it is reported for."""
    return list(
        {
            (message.id, message.number, message.image, sentence(message.text)): message
            for message in messages
        }.values()
    )
