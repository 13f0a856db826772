"""Completion in a description: keys, enumerants, names and other values, at a cursor in a text that
may be incomplete.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.scalars import SAMPLE_COUNTS, SHADING_LEVELS
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.input.shader_modules import GLSL

from .completion_texts import map_keys, rule_names, word_items
from .enumerants import Style, enumerants
from .file_paths import paths
from .names import ATTACHMENTS, SUBPASSES, Names, names_of
from .places import Place, alternatives, content, place_at
from .recovery import MARK, Marked, Word, lead, marked, word_at

if TYPE_CHECKING:
    from .view import View

SHADERS = (".spv", *GLSL)
"""File name extensions of shader modules."""

KEY, VALUE, ENUMERANT, REFERENCE = "key", "value", "enumerant", "reference"


class Completion(NamedTuple):
    """One thing that may stand at the cursor.

    `text` replaces the text from `start` to `end`; `$0` in it is where the cursor goes, if
    `snippet`. `kind` is KEY, VALUE (a number or a boolean), ENUMERANT (a word) or REFERENCE,
    `detail` a few words, `member` the structure and member, or `enumerant` the enum and name, whose
    documentation it has.
    """

    label: str
    text: str
    start: int
    end: int
    kind: str
    detail: str = ""
    snippet: bool = False
    member: tuple[type[Record], str] | None = None
    enumerant: tuple[str, str] | None = None


def complete(view: View, offset: int, snippets: bool = False) -> list[Completion]:
    """What may stand at the cursor, in the order of the format. With `snippets`, keys of structures
    place the cursor in them.
    """
    in_text = rule_names(view, offset)
    if in_text is not None:
        start, end, words = in_text
        return [
            Completion(label, text, start, end, KEY if text.endswith(" = ") else ENUMERANT, detail)
            for label, text, detail in words
        ]
    if view.kind != "description":
        return []
    word = word_at(view.text, offset)
    if not _is_free(view.text, word):
        return []
    found = marked(view.text, word, view.limits)
    at = place_at(found.roots, found.at) if found is not None else None
    if found is None or at is None:
        return []
    return list(_Completer(view, word, found, at[0], snippets).items(at[1]))


def _is_free(text: str, word: Word) -> bool:
    """Whether nothing but punctuation is beside a word in its line: a value cannot stand next to
    another one.
    """
    line_start, line_end = text.rfind("\n", 0, word.start) + 1, text.find("\n", word.end)
    before = text[line_start : word.start].rstrip()
    after = text[word.end : line_end if line_end >= 0 else len(text)].strip()
    if text[word.start - 1 : word.start] in ("&", "*", "!", "#") or before.endswith("---"):
        return False
    return before[-1:] in ("", *"[{,:|-?") and after[:1] in ("", *",]}:#|")


class _Completer:
    """The completions at one cursor. `place` is the value, or the member with the key, that the
    mark stands for.
    """

    def __init__(
        self, view: View, word: Word, marked: Marked, place: Place, snippets: bool
    ) -> None:
        self.text = text = view.text
        self.folder = view.folder
        self.word = word
        self.marked = marked
        self.place = place
        self.snippets = snippets
        self.line_start = text.rfind("\n", 0, word.start) + 1
        self.begins_line = not text[self.line_start : word.start].strip(" -\t")
        self.is_json = text.lstrip("\ufeff \t\r\n")[:1] in ("{", "[") and '"' in text
        self.is_flow = any(
            self._opens(each.node) for each in place.ancestors if each.node.kind != "scalar"
        )

    def _opens(self, node: Node) -> bool:
        return self.marked.text[content(self.marked.text, node).start : node.end][:1] in ("{", "[")

    def items(self, in_key: bool) -> Iterator[Completion]:
        """The completions, `in_key` where the mark was read as a key."""
        place, parent = self.place, self.place.parent
        if in_key and parent is not None:
            if place.key is None or place.key.text != MARK:
                return
            shapes = [parent.shape] if len(parent.node.value) > 1 else alternatives(parent.stated)
            yield from self._keys_of(shapes, parent)
            if len(parent.node.value) == 1 and not self._colon_follows:
                yield from self._values_of(shapes, parent)
        elif not in_key and place.node.kind == "scalar" and MARK in place.node.text:
            shapes = alternatives(place.stated)
            if place.node.text != MARK:
                shapes = [shape for shape in shapes if shape[0] == "flags" and self._joins]
            elif self.begins_line:
                yield from self._keys_of(shapes, place)
            yield from self._values_of(shapes, place)

    @property
    def _colon_follows(self) -> bool:
        return self.text[self.word.end :].lstrip(" ").startswith(":")

    @property
    def _joins(self) -> bool:
        """Whether the mark follows `|` in flags that are one text."""
        before, _, after = self.place.node.text.partition(MARK)
        return before.rstrip().endswith("|") and not after.strip(" |")

    def _item(self, label: str, kind: str, detail: str = "", text: str | None = None) -> Completion:
        """A value, in the quotes that are there or that the text needs."""
        text = label if text is None else text
        quote = self.word.quote or ('"' if self.is_json and kind != VALUE else "")
        quoted = f"{quote}{text}{quote}" if quote and not text.startswith(quote) else text
        return Completion(
            label, lead(self.text, self.word) + quoted, self.word.start, self.word.end, kind, detail
        )

    # Keys.

    def _keys_of(self, shapes: Sequence[Shape], parent: Place) -> Iterator[Completion]:
        for shape in shapes:
            if shape[0] in ("record", "command"):
                kind: type[Record] = shape[1]
                present = (
                    set(parent.node.value) - {MARK} if parent.node.kind == "mapping" else set()
                )
                if issubclass(kind, Command) and present:
                    continue
                yield from (
                    self._key(name, kind, inner)
                    for name, inner in kind.SHAPE.items()
                    if name not in present
                )
            elif shape[0] == "map":
                yield from self._missing_names(parent)
                present = set(parent.node.value) if parent.node.kind == "mapping" else set()
                yield from (self._entry(key) for key in map_keys(parent) if key not in present)

    def _key(self, name: str, kind: type[Record], shape: Shape) -> Completion:
        is_item = self._is_flow_item
        bare = issubclass(kind, Command) and shape[0] == "null" and (is_item or not self.is_flow)
        snippet = self.snippets and not bare and not self._colon_follows
        text = self._quoted_key(name)
        if not bare and not self._colon_follows:
            text += ":" + self._after_colon(alternatives(shape)[0], "" if is_item else self._comma)
            text = f"{{{text}}}{self._comma}" if is_item else text
        detail = "command" if issubclass(kind, Command) else ""
        return Completion(
            name, text, self.word.start, self.word.end, KEY, detail, snippet, (kind, name)
        )

    def _entry(self, key: str) -> Completion:
        """A key of a mapping that is no structure."""
        text = self._quoted_key(key) + ("" if self._colon_follows else ": ")
        return Completion(key, text, self.word.start, self.word.end, KEY)

    def _quoted_key(self, name: str) -> str:
        quote = self.word.quote or ('"' if self.is_json and self.is_flow else "")
        return f"{quote}{name}{quote}"

    def _after_colon(self, shape: Shape, comma: str) -> str:
        """What follows a key: the beginning of its value, if the client takes snippets."""
        kind = shape[0]
        is_list = kind in ("list", "flags")
        is_structure = kind in ("record", "map", "numbered", "command") or (
            kind == "list" and shape[1][0] in ("record", "command")
        )
        tail = comma if self.is_flow else ""
        if not self.snippets:
            return " "
        if is_structure and not self.is_flow:
            column = self.word.start - self.line_start
            line_break = "\r\n" if "\r\n" in self.text else "\n"
            return f"{line_break}{' ' * (column + 2)}{'- ' if is_list else ''}$0"
        return f" [$0]{tail}" if is_list else f" {{$0}}{tail}" if is_structure else f" $0{tail}"

    @property
    def _comma(self) -> str:
        """A comma where another entry follows without one, and the text could only be read with
        it.
        """
        read = self.marked.text[self.marked.at + len(MARK) :].lstrip(": ")
        return (
            ","
            if read.startswith(",") and not self.text[self.word.end :].lstrip(": ").startswith(",")
            else ""
        )

    @property
    def _is_flow_item(self) -> bool:
        """Whether the mark is an item of a list in brackets, and not in a mapping in braces."""
        place, parent = self.place, self.place.parent
        if not self.is_flow or parent is None:
            return False
        return (
            parent.node.start == self.marked.at
            if place.key is not None
            else parent.node.kind == "sequence"
        )

    def _missing_names(self, parent: Place) -> Iterator[Completion]:
        """Names that structures use and a section does not define."""
        section = ".".join(parent.path)
        for name, places in self.names.items():
            if (
                name.section == section
                and not any(place.is_definition for place in places)
                and MARK not in name.text
            ):
                text = self._quoted_key(name.text) + ("" if self._colon_follows else ": ")
                yield Completion(
                    name.text, text, self.word.start, self.word.end, REFERENCE, "used, not defined"
                )

    # Values.

    def _values_of(self, shapes: Sequence[Shape], place: Place) -> Iterator[Completion]:
        for shape in shapes:
            yield from self._values(shape, place)

    def _values(self, shape: Shape, place: Place) -> Iterable[Completion]:
        kind = shape[0]
        if kind in ("enum", "flags"):
            return self._enumerants(shape, place)
        if kind == "bool":
            return [self._item(word, VALUE) for word in ("true", "false")]
        if kind == "samples":
            return [self._item(style, VALUE) for style in self._style.samples(SAMPLE_COUNTS)]
        if kind in ("word", "caseless"):
            return [
                self._item(str(word), VALUE if isinstance(word, int) else ENUMERANT)
                for word in shape[1]
            ]
        if kind == "shading":
            return [self._item(word, ENUMERANT) for word in SHADING_LEVELS]
        if kind == "name":
            return self._named(shape[1], "")
        if kind == "slot":
            return [
                *self._named(ATTACHMENTS, self._pass_of(place)),
                self._item("null", VALUE, "VK_ATTACHMENT_UNUSED"),
            ]
        if kind == "subpass":
            return [
                self._item("EXTERNAL", ENUMERANT, "VK_SUBPASS_EXTERNAL"),
                *self._named(SUBPASSES, self._pass_of(place), VALUE),
            ]
        if kind == "command" and self.begins_line and not self.is_flow:
            return []
        if kind == "command":
            return [
                self._item(name, ENUMERANT, "command")
                for name, inner in shape[1].SHAPE.items()
                if inner[0] == "null"
            ]
        member = next((each.path[-1] for each in place.ancestors if each.record is not None), "")
        if (
            kind == "text"
            and (member == "module" or (member == "device" and "/" in self.word.prefix))
            and self.folder is not None
        ):
            return [
                self._item(path, ENUMERANT)
                for path in paths(self.folder, SHADERS if member == "module" else (".json",))
            ]
        return [
            self._item(label, ENUMERANT, detail)
            for label, detail in word_items(kind, member, place)
        ] or self._subpasses(member, place)

    def _enumerants(self, shape: Shape, place: Place) -> Iterator[Completion]:
        siblings = (
            place.parent.node.value
            if place.parent is not None and place.parent.shape[0] == "flags"
            else ()
        )
        present = (
            {node.text for node in siblings if node.kind == "scalar"}
            if isinstance(siblings, list)
            else set()
        )
        alone = shape[0] == "flags" and place.node.text == MARK and not self.word.quote
        for name, text in enumerants(shape[1], self._style, place):
            if text not in present:
                quoted = f'"{text}"' if alone and self.is_json else text
                item = self._item(
                    text, ENUMERANT, name if name != text else "", f"[{quoted}]" if alone else None
                )
                yield item._replace(enumerant=(shape[1], name))

    def _subpasses(self, member: str, place: Place) -> list[Completion]:
        """The subpasses of the render pass that a pipeline is for."""
        pipeline = (
            place.parent.node
            if place.parent is not None and place.parent.node.kind == "mapping"
            else None
        )
        owner = (
            pipeline.value.get("renderPass")
            if pipeline is not None and member == "subpass"
            else None
        )
        return list(self._named(SUBPASSES, owner.text, VALUE)) if owner is not None else []

    def _named(self, section: str, owner: str, kind: str = REFERENCE) -> Iterator[Completion]:
        """The entries of a section, or of the attachments or subpasses of a render pass."""
        found = (
            name.text
            for name, places in self.names.items()
            if name.section == section
            and name.scope[1] == owner
            and any(place.is_definition for place in places)
        )
        for text in dict.fromkeys(found):
            if MARK in text:
                continue
            if section in (ATTACHMENTS, SUBPASSES) and text.isdecimal():
                yield Completion(
                    text,
                    lead(self.text, self.word) + text,
                    self.word.start,
                    self.word.end,
                    VALUE,
                    section,
                )
            else:
                yield self._item(text, kind, section, self._name_text(text))

    def _name_text(self, text: str) -> str:
        from msaa_lint.linter.fixes.value_writer import quote_scalar

        return quote_scalar(text, self.word.quote or ('"' if self.is_json else ""))

    @staticmethod
    def _pass_of(place: Place) -> str:
        return next(
            (
                each.path[1]
                for each in place.ancestors
                if len(each.path) == 2 and each.path[0] == "renderPasses"
            ),
            "",
        )

    @cached_property
    def names(self) -> Names:
        return names_of(self.marked.roots)

    @cached_property
    def _style(self) -> Style:
        return Style(self.text, self.marked.roots)
