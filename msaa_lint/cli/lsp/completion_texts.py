# ruff: noqa: E501
"""Completion outside of descriptions' values: rules in suppression comments, `msaa-lint.toml`, the front matter of rule pages, devices."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from msaa_lint.cli.completion import profiles
from msaa_lint.core.finding import CONFIDENCES
from msaa_lint.frame.devices import DeviceProfile, builtin, names
from msaa_lint.frame.devices.tile_models import COUNTS, KINDS, MODELS
from msaa_lint.frame.facts.table import FACTS, SUBJECTS
from msaa_lint.linter.rules.rule import APIS, EDITIONS, PASSES
from msaa_lint.linter.rules.rule_file import KEYS as PAGE_KEYS
from msaa_lint.linter.settings.config_keys import KEYS, LEVELS, MAX_LIMITS
from msaa_lint.linter.settings.reference import SETTINGS
from msaa_lint.linter.settings.selectors import ALL
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from msaa_lint.linter.suppress.comments import WORDS

from .file_paths import paths
from .places import Place
from .setting_words import TABLE

if TYPE_CHECKING:
    from .view import View

Item = tuple[str, str, str]
"""A label, the text that it inserts, and a few words about it."""

_SUPPRESSION = re.compile(
    r"(?:#|//|/\*|<!--)[^\n]*?msaa-lint[ \t]*:[ \t]*(?:(?P<word>[\w-]*)|[\w-]+\[(?:[^\],\n]*,)*[ \t]*(?P<rule>[\w-]*))\Z"
)
_COMMENT = re.compile(r"(?:^|[ \t])#[^\n]*\Z")
_WORD = re.compile(r"[\w-]*")
_PATH = re.compile(r"[\w./-]*")
_FACT = re.compile(r"[\w.]*\Z")

_KEY = re.compile(r"^[ \t]*([\w-]+)[ \t]*=", re.MULTILINE)
_PAGE_KEY = re.compile(r"^([\w-]+):", re.MULTILINE)
_BARE_KEY = re.compile(r"^[ \t]*([\w-]*)\Z", re.MULTILINE)
_STRING = re.compile(r"""(["']?)([\w./-]*)\Z""")

_TABLES = frozenset({"", "severity", "limits", "source", "source.assume", "per-file-ignores"})
_SELECTORS = frozenset({"select", "extend-select", "ignore", "per-file-ignores"})
_VALUES: Mapping[str, Sequence[str]] = {
    "fail-on": LEVELS,
    "min-severity": LEVELS,
    "fail-confidence": CONFIDENCES,
    "edition": EDITIONS,
    "output": OUTPUT_FORMATS,
    "respect-gitignore": ("true", "false"),
    "strict-inputs": ("true", "false"),
}
_FILES: Mapping[str, str] = {
    "extends": ".toml",
    "rules": ".md",
    "baseline": ".json",
    "profile": ".json",
}
"""By key: how the names of the files end that it names."""

_PAGE_VALUES: Mapping[str, Sequence[str]] = {
    "severity": LEVELS,
    "confidence": CONFIDENCES,
    "subject": tuple(SUBJECTS),
    "edition": EDITIONS,
    "apis": APIS,
    "passes": PASSES,
}


API_VERSIONS = ("1.0", "1.1", "1.2", "1.3", "1.4")
"""The versions of Vulkan."""


def rule_names(view: View, offset: int) -> tuple[int, int, list[Item]] | None:
    """What may stand in a comment, a configuration or a rule page, and the place that it replaces; None in a description's values."""
    line_start = view.text.rfind("\n", 0, offset) + 1
    before = view.text[line_start:offset]
    comment = _SUPPRESSION.search(before)
    if comment is not None:
        word = comment["rule"] if comment["rule"] is not None else comment["word"]
        items = (
            _rules(view) if comment["rule"] is not None else [(word, word, "") for word in WORDS]
        )
        return offset - len(word), _word_end(view.text, offset), list(items)
    if view.kind == "configuration":
        return _configuration(view, offset)
    if view.kind == "rule":
        return _rule_page(view, offset, before)
    return (offset, offset, []) if view.kind != "description" or _COMMENT.search(before) else None


def _word_end(text: str, offset: int) -> int:
    match = _WORD.match(text, offset)
    return match.end() if match is not None else offset


def _rules(view: View) -> Iterator[Item]:
    """The names and codes of the rules."""
    rules = view.rule_names.rules
    yield from ((rule.name, rule.name, rule.code) for rule in rules)
    yield from ((rule.code, rule.code, rule.name) for rule in rules)


def _configuration(view: View, offset: int) -> tuple[int, int, list[Item]]:
    """The keys of a table, or the values of a key."""
    text = view.text[:offset]
    header = _last(TABLE, text)
    table = re.sub(r"^tool\.msaa-lint(\.|$)", "", header[1].strip()) if header is not None else ""
    if table not in _TABLES:
        return offset, offset, []
    body = text[header.end() if header is not None else 0 :]
    bare = _BARE_KEY.search(body)
    opened = body.count("[") > body.count("]") or body.count("{") > body.count("}")
    if bare is not None and not opened:
        present = set(_KEY.findall(body)) | set(
            _KEY.findall(view.text[offset:].partition("\n[")[0])
        )
        names: Iterable[str] = {
            "": [*KEYS, "extends"],
            "limits": MAX_LIMITS,
            "source": ["assume"],
        }.get(table, ())
        keys: Iterable[Item] = [
            (name, f"{name} = ", _type(table, name)) for name in names if name not in present
        ]
        if table == "severity":
            keys = ((label, f"{label} = ", detail) for label, _, detail in _rules(view))
        return offset - len(bare[1]), _word_end(view.text, offset), list(keys)
    string = _STRING.search(body)
    word, quote = (string[2], string[1]) if string is not None else ("", "")
    keys_before = _KEY.findall(body)
    key = (
        table
        if table in ("severity", "per-file-ignores")
        else keys_before[-1]
        if keys_before
        else ""
    )
    is_value = bool(re.search(r"=[ \t]*[\"']?[\w.-]*\Z", body))
    items = list(
        _configuration_values(view, key, is_value and (table == "severity" or "{" in body), word)
    )
    start, end = offset - len(word) - len(quote), _PATH.match(view.text, offset).end()  # type: ignore[union-attr]
    if quote:
        end += view.text.startswith(quote, end)
    return (
        start,
        end,
        [
            (label, text if text in ("true", "false") else f'"{text}"', detail)
            for label, text, detail in items
        ],
    )


def _type(table: str, name: str) -> str:
    setting = SETTINGS.get(f"{table}.{name}" if table else name)
    return setting.type if setting is not None else ""


def _configuration_values(view: View, key: str, is_entry: bool, word: str) -> Iterable[Item]:
    """The values of a key; `is_entry` says that the cursor is after the `=` of an entry of its table, `word` is what stands before it."""
    if key in _SELECTORS or (key == "severity" and not is_entry):
        return [*_rules(view), (ALL, ALL, "all rules")]
    if key == "profile" and "/" not in word:
        return [(name, name, detail) for name, detail in profiles()]
    if key in _FILES and view.folder is not None:
        return [(path, path, "") for path in paths(view.folder, (_FILES[key],))]
    words = (*LEVELS, "off") if key == "severity" else _VALUES.get(key, ())
    return [(word, word, "") for word in words]


def _rule_page(view: View, offset: int, before: str) -> tuple[int, int, list[Item]]:
    """The keys of the front matter, their words, and the facts in conditions and messages; nothing in the page's Markdown."""
    fence = view.text.find("\n---", 3)
    if 0 <= fence < offset:
        return offset, offset, []
    key = re.match(r"([\w-]*)\Z", before)
    if key is not None:
        present = set(re.findall(r"^([\w-]+):", view.text[: max(fence, 0)], re.MULTILINE))
        keys = [(name, f"{name}: ", "") for name in PAGE_KEYS if name not in present]
        return offset - len(key[1]), _word_end(view.text, offset), keys
    named = re.match(r"\s*(?:-\s+)?([\w-]+):", before) or _last(_PAGE_KEY, view.text[:offset])
    name = named[1] if named is not None else ""
    start = offset - len(_FACT.search(before)[0])  # type: ignore[index]
    end = _word_end(view.text, offset)
    if name == "supersedes":
        return offset - len(re.search(r"[\w-]*\Z", before)[0]), end, list(_rules(view))  # type: ignore[index]
    if name in _PAGE_VALUES:
        return start, end, [(word, word, "") for word in _PAGE_VALUES[name]]
    subject = re.search(r"^subject:[ \t]*(\w+)", view.text, re.MULTILINE)
    facts = SUBJECTS.get(subject[1], ()) if subject is not None else FACTS.values()
    in_text = name in ("when", "at", "labels", "set", "add", "remove") or "{" in before
    return (
        start,
        end,
        [(fact.name, fact.name, f"{fact.type}: {fact.doc}") for fact in facts] if in_text else [],
    )


def _last(pattern: re.Pattern[str], text: str) -> re.Match[str] | None:
    return next(iter(deque(pattern.finditer(text), maxlen=1)), None)


def word_items(kind: str, member: str, place: Place) -> Iterable[tuple[str, str]]:
    """Texts that a member of a description may hold, beside its enumerants: names of devices, and of what they offer."""
    if kind == "text" and member == "device" and len(place.path) == 1:
        return [(name, profile.name) for name, profile in _profiles()]
    if kind == "text" and member == "apiVersion":
        return [(version, "") for version in API_VERSIONS]
    if kind == "text" and place.path[:2] == ("device", "tile"):
        return [
            (name, "")
            for name in {"model": list(MODELS), "kind": list(KINDS)}.get(place.path[-1], [])
        ]
    if kind == "text" and member in ("extensions", "features"):
        found = sorted(
            {name for _, profile in _profiles() for name in getattr(profile, member) or ()}
        )
        siblings = place.parent.node.value if place.parent is not None else []
        stated = (
            {node.text for node in siblings if node.kind == "scalar"}
            if isinstance(siblings, list)
            else set()
        )
        return [(name, "") for name in found if name not in stated]
    return ()


def map_keys(place: Place) -> Sequence[str]:
    """The keys of a mapping of the device whose values are numbers and names."""
    if place.path == ("device", "tile"):
        return list(
            dict.fromkeys(["model", "kind", *(key for keys in KINDS.values() for key in keys)])
        )
    if place.path == ("device", "compression"):
        return [f"{count}{way}" for count in COUNTS for way in ("", " read", " write")]
    return ()


def _profiles() -> Iterator[tuple[str, DeviceProfile]]:
    """The built-in devices."""
    return ((name, profile) for name in names() if (profile := builtin(name)) is not None)
