"""Definitions and references of images, attachments, passes, framebuffers, pipelines, subpasses and
anchors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msaa_lint.core.text.span import Span

from .names import anchor_at, connected, names_at, occurrences, span_of

if TYPE_CHECKING:
    from .view import View


def definition(view: View, offset: int) -> list[Span]:
    """Where what is named at an offset is defined; nothing where no name is. An alias leads to its
    anchor.
    """
    anchored = anchor_at(view.text, offset)
    if anchored is not None:
        return [anchored[0].span]
    places = occurrences(view.names, names_at(view.names, view.text, offset))
    return list(dict.fromkeys(span_of(view.text, place) for place in places if place.is_definition))


def references(view: View, offset: int, with_definition: bool = True) -> list[Span]:
    """All places that name what is named at an offset, with or without its definition."""
    anchored = anchor_at(view.text, offset)
    if anchored is not None:
        anchor, _ = anchored
        return anchor.spans if with_definition else anchor.aliases
    names = view.names
    places = occurrences(names, connected(names, names_at(names, view.text, offset)))
    return list(
        dict.fromkeys(
            span_of(view.text, place)
            for place in places
            if with_definition or not place.is_definition
        )
    )
