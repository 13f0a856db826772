"""The protocol's answers to what an editor asks at a position of a document."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types

from msaa_lint.core.text.span import Span

from . import completion as completions
from . import hover as hovers
from . import inlay_hints as hints
from . import navigation
from . import rename as renames
from . import symbols as outline
from .folding import folds, selection
from .links import links
from .setting_words import setting_text
from .shape_words import enumerant_documentation, key_documentation

if TYPE_CHECKING:
    from .analysis import Analysis

TRIGGERS = [" ", ":", "[", "{", ",", '"', "|", "-", "."]
"""What an editor asks for completions after, besides letters."""

_ITEM_KINDS = {
    completions.KEY: types.CompletionItemKind.Property,
    completions.VALUE: types.CompletionItemKind.Value,
    completions.ENUMERANT: types.CompletionItemKind.EnumMember,
    completions.REFERENCE: types.CompletionItemKind.Reference,
}

_SYMBOL_KINDS = {
    "document": types.SymbolKind.Module,
    "images": types.SymbolKind.Object,
    "metal.textures": types.SymbolKind.Object,
    "renderPasses": types.SymbolKind.Class,
    "metal.renderPasses": types.SymbolKind.Class,
    "framebuffers": types.SymbolKind.Struct,
    "pipelines": types.SymbolKind.Function,
    "metal.renderPipelines": types.SymbolKind.Function,
    "attachments": types.SymbolKind.Field,
    "colorAttachments": types.SymbolKind.Field,
    "depthAttachment": types.SymbolKind.Field,
    "stencilAttachment": types.SymbolKind.Field,
    "subpasses": types.SymbolKind.Method,
    "command": types.SymbolKind.Event,
}


def hover(analysis: Analysis, position: types.Position) -> types.Hover | None:
    """What there is to say about a position."""
    answer = hovers.hover(analysis.view, analysis.offset(position))
    if answer is None:
        return None
    return types.Hover(
        types.MarkupContent(types.MarkupKind.Markdown, answer.markdown), analysis.range(answer.span)
    )


def completion(
    analysis: Analysis, position: types.Position, snippets: bool
) -> types.CompletionList:
    """What may stand at a position; `snippets` says that the editor takes snippets."""
    items = completions.complete(analysis.view, analysis.offset(position), snippets)
    ranges: dict[Span, types.Range] = {}
    for item in items:
        span = Span(item.start, item.end)
        if span not in ranges:
            ranges[span] = analysis.range(span)
    return types.CompletionList(
        False,
        [
            _item(analysis, item, ranges[Span(item.start, item.end)], n)
            for n, item in enumerate(items)
        ],
    )


def _item(
    analysis: Analysis, item: completions.Completion, place: types.Range, number: int
) -> types.CompletionItem:
    quote = analysis.view.text[item.start : item.start + 1]
    text = (
        key_documentation(*item.member)
        if item.member is not None
        else enumerant_documentation(*item.enumerant or ("", ""))
    )
    if not text and item.kind == completions.KEY and analysis.view.kind == "configuration":
        text = setting_text(item.label)
    return types.CompletionItem(
        item.label,
        kind=_ITEM_KINDS[item.kind],
        detail=item.detail or None,
        documentation=types.MarkupContent(types.MarkupKind.Markdown, text) if text else None,
        sort_text=f"{number:04}",
        # The place that is replaced begins with the quote, and is compared with this.
        filter_text=quote + item.label if quote in ("'", '"') else None,
        insert_text_format=types.InsertTextFormat.Snippet
        if item.snippet
        else types.InsertTextFormat.PlainText,
        insert_text_mode=types.InsertTextMode.AsIs,
        text_edit=types.TextEdit(place, item.text),
    )


def definition(analysis: Analysis, position: types.Position) -> list[types.Location]:
    """Where what is named at a position is defined."""
    spans = navigation.definition(analysis.view, analysis.offset(position))
    return [types.Location(analysis.uri, analysis.range(span)) for span in spans]


def references(
    analysis: Analysis, position: types.Position, with_definition: bool
) -> list[types.Location]:
    """Where what is named at a position is named."""
    spans = navigation.references(analysis.view, analysis.offset(position), with_definition)
    return [types.Location(analysis.uri, analysis.range(span)) for span in spans]


def highlights(analysis: Analysis, position: types.Position) -> list[types.DocumentHighlight]:
    """The places in the document that name what is named at a position."""
    offset = analysis.offset(position)
    definitions = set(navigation.definition(analysis.view, offset))
    kinds = {True: types.DocumentHighlightKind.Write, False: types.DocumentHighlightKind.Read}
    spans = navigation.references(analysis.view, offset)
    return [
        types.DocumentHighlight(analysis.range(span), kinds[span in definitions]) for span in spans
    ]


def prepare_rename(
    analysis: Analysis, position: types.Position
) -> types.PrepareRenamePlaceholder | None:
    """The name at a position; None if there is none that can be renamed."""
    found = renames.prepare(analysis.view, analysis.offset(position))
    return (
        types.PrepareRenamePlaceholder(analysis.range(found.span), found.text)
        if found is not None
        else None
    )


def rename(analysis: Analysis, position: types.Position, name: str) -> types.WorkspaceEdit:
    """The edits that give what is named at a position another name. Raises rename.Refused."""
    edits = renames.rename(analysis.view, analysis.offset(position), name)
    return types.WorkspaceEdit(
        changes={
            analysis.uri: [types.TextEdit(analysis.range(edit.span), edit.text) for edit in edits]
        }
    )


def symbols(analysis: Analysis) -> list[types.DocumentSymbol]:
    """The outline of a description."""
    return [_symbol(analysis, symbol) for symbol in outline.symbols(analysis.view)]


def _symbol(analysis: Analysis, symbol: outline.Symbol) -> types.DocumentSymbol:
    kind = (
        types.SymbolKind.Namespace
        if symbol.name == symbol.section
        else _SYMBOL_KINDS.get(symbol.section, types.SymbolKind.Namespace)
    )
    return types.DocumentSymbol(
        symbol.name,
        kind,
        analysis.range(symbol.span),
        analysis.range(symbol.head),
        symbol.detail or None,
        children=[_symbol(analysis, part) for part in symbol.children],
    )


def inlay_hints(analysis: Analysis, place: types.Range) -> list[types.InlayHint]:
    """The hints in a range."""
    return [
        types.InlayHint(
            analysis.position(hint.at), hint.text, padding_left=True, tooltip=hint.tooltip
        )
        for hint in hints.hints(analysis.view, analysis.span(place))
    ]


def folding_ranges(analysis: Analysis) -> list[types.FoldingRange]:
    """What can be folded."""
    return [
        types.FoldingRange(
            fold.first, fold.last, kind=types.FoldingRangeKind.Comment if fold.is_comment else None
        )
        for fold in folds(analysis.view)
    ]


def document_links(analysis: Analysis) -> list[types.DocumentLink]:
    """The links of a document."""
    return [
        types.DocumentLink(analysis.range(link.span), link.target) for link in links(analysis.view)
    ]


def selection_range(analysis: Analysis, position: types.Position) -> types.SelectionRange:
    """What contains a position, from inside outward."""
    around: types.SelectionRange | None = None
    for span in reversed(selection(analysis.view, analysis.offset(position))):
        around = types.SelectionRange(analysis.range(span), around)
    return around or types.SelectionRange(types.Range(position, position))
