"""Links from a text: rules to their pages, and paths to the files that they name."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from pygls.uris import from_fs_path

from msaa_lint.core.project import is_inside, project_root
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import ShaderStage
from msaa_lint.frame.devices.paths import is_path, split
from msaa_lint.linter.rules.reference_links import rule_address
from msaa_lint.linter.settings.toml_text import places as toml_places

from .places import descriptions, inner, walk

if TYPE_CHECKING:
    from .view import View

MAX_LINKS = 1000
"""Links of one text."""

_SUPPRESSION = re.compile(r"(?:#|//|/\*|<!--)[^\n]*?msaa-lint[ \t]*:[ \t]*[\w-]+\[([^\]\n]*)\]")
_WORD = re.compile(r"[\w-]+")
_PATHS = frozenset({"extends", "baseline", "profile", "rules"})


class Link(NamedTuple):
    """A place, and the address of what it names."""

    span: Span
    target: str


def links(view: View) -> list[Link]:
    """The links of a text in order. A rule has one where the address of the documentation is set; a
    path, where its file exists.
    """
    found = [
        *_rules(view),
        *(_in_configuration(view) if view.kind == "configuration" else _in_description(view)),
    ]
    return sorted(set(found))[:MAX_LINKS]


def _rules(view: View) -> Iterator[Link]:
    """The rules that suppressions name."""
    for match in _SUPPRESSION.finditer(view.text):
        for word in _WORD.finditer(match[1]):
            yield from _rule(
                view, word[0], Span(match.start(1) + word.start(), match.start(1) + word.end())
            )


def _rule(view: View, word: str, span: Span) -> Iterator[Link]:
    rule = view.rule_names.by_word.get(word)
    address = rule_address(view.docs_url, rule.code, rule.name) if rule is not None else ""
    if address:
        yield Link(span, address)


def _in_description(view: View) -> Iterator[Link]:
    """The shader modules and the device report that a description names."""
    for root in descriptions(view.roots):
        for place in walk(root):
            if (
                place.record is ShaderStage
                and place.path[-1] == "module"
                and place.node.kind == "scalar"
            ):
                yield from _file(view, place.node.text, inner(view.text, place.node))
            elif (
                place.path == ("device",)
                and place.node.kind == "scalar"
                and is_path(place.node.text)
            ):
                yield from _file(view, split(place.node.text)[0], inner(view.text, place.node))


def _in_configuration(view: View) -> Iterator[Link]:
    """The rules and the files that a configuration names."""
    for path, place in toml_places(view.text).items():
        keys = path[2:] if path[:2] == ("tool", "msaa-lint") else path
        for span in (place.key, place.value):
            quote = view.text[span.start : span.start + 1] in ("'", '"')
            word = Span(span.start + quote, span.end - quote)
            text = view.text[word.start : word.end]
            yield from _rule(view, text, word)
            if (
                span == place.value
                and keys
                and keys[0] in _PATHS
                and (keys[0] != "profile" or is_path(text))
            ):
                yield from _file(view, split(text)[0] if keys[0] == "profile" else text, word)


def _file(view: View, path: str, span: Span) -> Iterator[Link]:
    """A file of the project; nothing outside is looked at."""
    if view.folder is None or not path or "\0" in path:
        return
    whole = os.path.normpath(os.path.join(view.folder, path))
    if is_inside(whole, project_root(view.folder)) and os.path.isfile(whole):
        yield Link(span, from_fs_path(whole) or "")
