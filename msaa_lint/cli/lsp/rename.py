"""Renames images, attachments, passes, framebuffers, pipelines and anchors, wherever a document
names them.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.quote import quoted
from msaa_lint.core.text.anchors import Anchor, anchors_of
from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.node import Limits, Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Edit, Span
from msaa_lint.core.text.tree import parse
from msaa_lint.core.visible import is_visible
from msaa_lint.frame.description.scalars import UNUSED
from msaa_lint.input import readers
from msaa_lint.linter.fixes.value_writer import quote_scalar

from .names import (
    ATTACHMENTS,
    Name,
    Names,
    Occurrence,
    anchor_at,
    connected,
    names_at,
    names_of,
    occurrences,
)
from .places import content, inner

if TYPE_CHECKING:
    from .view import View

MAX_NAME = 256
"""Characters of a new name; YAML limits a key to 1024 bytes."""

_ANCHOR = re.compile(r"[^\s,\[\]{}]+\Z")


class Refused(Exception):
    """A rename that would change what the document means; the message says why."""


class Renamable(NamedTuple):
    """The place of a name at a cursor, without quotes, and the name."""

    span: Span
    text: str


def prepare(view: View, offset: int) -> Renamable | None:
    """The name at an offset, if it can be renamed: not an index, and defined in the document."""
    anchored = anchor_at(view.text, offset)
    if anchored is not None:
        return Renamable(anchored[1], anchored[0].text)
    at = names_at(view.names, view.text, offset)
    places = [
        place
        for place in occurrences(view.names, at)
        if not place.is_index and content(view.text, place.node).start <= offset <= place.node.end
    ]
    if not places or not any(
        place.is_definition and not place.is_index for name in at for place in view.names[name]
    ):
        return None
    return Renamable(inner(view.text, places[0].node), at[0].text)


def rename(view: View, offset: int, new: str) -> list[Edit]:
    """The edits that give what is named at an offset a new name everywhere in the document. Raises
    Refused.
    """
    found = prepare(view, offset)
    if found is None:
        raise Refused(
            "there is no name of an image, a pass, an attachment, a framebuffer, a pipeline or an "
            "anchor here"
        )
    if new == found.text:
        return []
    if (
        not new
        or len(new) > MAX_NAME
        or not all(is_visible(char) for char in new)
        or new != new.strip()
    ):
        raise Refused(
            f"{quoted(new)} cannot be a name; write 1 to {MAX_NAME} visible characters, without "
            "blanks around them"
        )
    anchored = anchor_at(view.text, offset)
    if anchored is not None:
        edits = _anchor_edits(view.text, anchored[0], new)
    else:
        edits = _name_edits(
            view, connected(view.names, names_at(view.names, view.text, offset)), new
        )
    _check(view, edits, new)
    return edits


def _anchor_edits(text: str, anchor: Anchor, new: str) -> list[Edit]:
    if not _ANCHOR.match(new):
        raise Refused(
            f"{quoted(new)} cannot be an anchor; blanks, commas and brackets are not allowed in it"
        )
    if any(other.text == new for other in anchors_of(text)):
        raise Refused(f"there is already an anchor {quoted(f'&{new}')}")
    return [Edit(span, new) for span in anchor.spans]


def _name_edits(view: View, names: list[Name], new: str) -> list[Edit]:
    for name in names:
        if name._replace(text=new) in view.names:
            raise Refused(
                f"there is already {quoted(new)} in `{name.section}`; choose another name"
            )
        if name.section == ATTACHMENTS and new in UNUSED:
            raise Refused(f"{quoted(new)} stands for VK_ATTACHMENT_UNUSED; choose another name")
    texts = {name.text for name in names}
    places = occurrences(view.names, names)
    edited = {id(place.node) for place in places}
    edits = (_edit(view.text, place, texts, edited, new) for place in places)
    return list(dict.fromkeys(edit for edit in edits if edit is not None))


def _edit(text: str, place: Occurrence, texts: set[str], edited: set[int], new: str) -> Edit | None:
    """The edit of one place; None for an index, and for an alias of an anchored name that is
    renamed itself.
    """
    node = place.node
    if place.is_index or node.text not in texts:
        return None
    span = content(text, node)
    if node.anchor is not None:
        return None if id(node.anchor) in edited else Edit(span, quote_scalar(new, ""))
    return Edit(
        span,
        quote_scalar(
            new, "" if node.plain else text[span.start] if text[span.start] in "\"'" else '"'
        ),
    )


def _check(view: View, edits: list[Edit], new: str) -> None:
    """Raises Refused if the edits would break the document: another place may share the text of a
    name through an anchor.
    """
    text = apply(view.text, edits)
    before, after = parse(Source("", view.text), Limits()), parse(Source("", text), Limits())
    if before.problems or len(after.problems) > len(before.problems):
        raise Refused(
            "the document has an error; correct it first"
            if before.problems
            else f"{quoted(new)} cannot be written here"
        )
    for root, renamed in zip(before.documents, after.documents, strict=True):
        if _problems(view.text, root) < _problems(text, renamed):
            raise Refused(
                "an anchor shares this name with another structure; write the name there first"
            )
    if _shape(names_of(before.documents)) != _shape(names_of(after.documents)):
        raise Refused(f"{quoted(new)} would stand for something else; choose another name")


def _problems(text: str, root: Node) -> int:
    return len(readers.read(Source("", text), root).problems)


def _shape(names: Names) -> list[list[int]]:
    """Which places stand for the same, whatever the name: the ordinals of the places of each
    name.
    """
    ordinals: dict[int, int] = {}
    nodes = sorted(
        {place.node for places in names.values() for place in places}, key=lambda node: node.start
    )
    for node in nodes:
        ordinals.setdefault(node.start, len(ordinals))
    return sorted([ordinals[place.node.start] for place in places] for places in names.values())
