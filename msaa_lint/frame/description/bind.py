"""Trees to records: every member by its shape, every mistake with its place and the nearest right
word.

The description format is strict: an unknown key is an error. Tools' dumps are read more leniently
(`dumps`).
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from msaa_lint.core.quote import quoted, shortened
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span

from .dumps import PNEXT, WITHIN, is_null, is_number, is_unread, member_name, structure_type
from .hints import (
    commands_hint,
    has_no_value,
    hidden_character,
    items_hint,
    key_below,
    key_hint,
    lacks_colon,
    mapping_hint,
    meant,
    question_or_names,
)
from .members import MAX_UINT32
from .models import AttachmentReference, Command, DepthStencilResolve
from .problems import found, head_of, structure_of
from .record import Record
from .scalars import ATTACHMENT_UNUSED, UNUSED, caseless
from .shapes import Shape
from .values import ValueBinder, is_word

UNREAD = "pNext"
"""The member that names the structures of a pNext chain that are not read."""


class Binder(ValueBinder):
    """Reads the records of one document. `problems` and `mentions` fill as it goes."""

    def record(
        self, kind: type[Record], node: Node, path: str, key: str, head: Span | None = None
    ) -> Any:
        """The record of that class that a mapping states."""
        record = self.structure(kind, node, path, key, head if head is not None else head_of(node))
        if self.dumped and node.kind == "mapping" and "pNext" in node.value:
            self.chain(record, node.value["pNext"])
        return record

    def structure(self, kind: type[Record], node: Node, path: str, key: str, head: Span) -> Any:
        """The record of a mapping, without what its pNext chain states."""
        record = kind(node, path, key, head)
        if node.kind != "mapping":
            self.wrong_structure(
                node, path, "a mapping", "" if self.dumped else mapping_hint(("record", kind), node)
            )
            return record
        self.members(record, node, path)
        if (
            isinstance(record, DepthStencilResolve)
            and record.attachment is not None
            and record.attachment.layout is None
        ):
            record.attachment.layout = record.layout
        return record

    def wrong_structure(self, node: Node, path: str, expected: str, hint: str = "") -> None:
        """Reports what is not a structure, or not of the right kind, by its whole path."""
        self.report(
            "MSAA903",
            f"{structure_of(path)} must be {expected}, found {found(node)}{hint}",
            head_of(node),
            path,
        )

    def members(self, record: Record, node: Node, path: str) -> None:
        """Gives a record the members that a mapping states."""
        kind, shapes, dumped = type(record), record.SHAPE, self.dumped
        for key_text, value in node.value.items():
            name = member_name(kind, key_text) if dumped else key_text
            if name is None:
                continue
            shape = shapes.get(name)
            key = node.keys[key_text]
            is_bare = not dumped and has_no_value(value)
            if shape is None:
                self.unknown_key(kind, key, value, path, any(map(shapes.__contains__, node.value)))
                if hidden_character(key_text):
                    # The keys below it are indented by such characters too.
                    break
            elif is_bare and key.start < key.end == value.start == value.end:
                self.report(
                    "MSAA901",
                    f"`:` is missing after the key {quoted(key_text)}",
                    key.span,
                    f"{path}.{name}".lstrip("."),
                )
                break
            elif is_bare and (below := key_below(shape, kind, node, key_text)) is not None:
                if not hidden_character(below.text):
                    self.unindented(key_text, below, path)
                    break
            elif not (dumped and is_null(value)):
                record.spelled[name] = (key, value)
                setattr(
                    record,
                    name,
                    self.value(
                        shape, value, f"{path}.{key_text}" if path else key_text, key_text, key.span
                    ),
                )

    def chain(self, record: Record, node: Node) -> None:
        """Gives a record the members that its pNext chain states, and the names of the structures
        that are not read.
        """
        path = f"{record.path}.pNext"
        unread: list[str] = []
        while node.kind == "mapping":
            stype = structure_type(node)
            name = PNEXT.get(stype)
            if WITHIN.get(stype) is type(record):
                self.members(record, node, path)
            elif name is not None and name in record.SHAPE and record.SHAPE[name][0] == "record":
                key = node.keys["sType"]
                record.spelled[name] = (key, node)
                setattr(
                    record, name, self.structure(record.SHAPE[name][1], node, path, name, key.span)
                )
            elif is_unread(stype, type(record)):
                unread.append(stype or "UNKNOWN")
            following = node.value.get("pNext")
            if following is None:
                break
            path += ".pNext"
            node = following
        if node.kind == "sequence":
            unread += [item.text or "UNKNOWN" for item in node.value]
        elif node.kind == "scalar" and not is_null(node):
            unread.append("UNKNOWN")
        if unread and UNREAD in record.SHAPE:
            setattr(record, UNREAD, tuple(unread))

    def unindented(self, above: str, key: Node, path: str) -> None:
        """Reports a key that lacks the indentation to be part of the value of the key above it."""
        message = (
            f"{quoted(key.text)} must be indented deeper than {quoted(above)}, which has no "
            "value without it"
        )
        self.report("MSAA903", message, key.span, f"{path}.{shortened(above)}".lstrip("."))

    def unknown_key(
        self, kind: type[Record], key: Node, value: Node, path: str, has_known: bool
    ) -> None:
        if not self.is_full:
            key_path = f"{path}.{shortened(key.text)}".lstrip(".")
            hint = key_hint(kind, key.text, value)
            message = f"unknown key {quoted(key.text)} in {path or 'the description'}{hint}"
            foreign = has_known and hint == question_or_names(None, list(kind.SHAPE), ": ")
            self.report("MSAA902", message, key.span, key_path, foreign=foreign)

    def value(self, shape: Shape, node: Node, path: str, key: str, head: Span | None = None) -> Any:
        """The value of a node by a shape."""
        kind = shape[0]
        if kind == "enum":
            return self.enumerant(shape[1], node, path)
        if kind == "flags":
            return self.flags(shape[1], node, path)
        if kind == "record":
            return self.record(shape[1], node, path, key, head)
        if kind == "list":
            return self.items(shape, node, path)
        if kind == "slot":
            return self.slot(node, path, key, head)
        if kind == "bool":
            return self.boolean(node, path)
        if kind == "samples":
            return self.samples(node, path)
        if kind == "shading":
            return self.shading(node, path)
        if kind == "int":
            return self.integer(shape[1], shape[2], node, path)
        if kind == "number":
            return self.number(shape[1], node, path)
        if kind == "share":
            return self.share(node, path)
        if kind == "text":
            return self.text(node, path)
        if kind == "name":
            return self.name(shape[1], node, path)
        if kind == "word":
            return self.word(shape[1], node, path)
        if kind == "caseless":
            return caseless(shape[1], node.value) or self.word(shape[1], node, path)
        if kind in ("map", "numbered"):
            return self.mapping(shape, node, path)
        if kind == "subpass":
            return self.subpass(node, path)
        if kind == "counted":
            return (
                self.items(shape, node, path)
                if node.kind == "sequence"
                else tuple(self.mapping(shape, node, path).values())
            )
        if kind == "null":
            return (
                None
                if node.kind == "scalar" and node.value is None
                else self.value(shape[1], node, path, key, head)
            )
        if kind == "either":
            return self.either(shape[1:], node, path, key, head)
        return self.command(node, path, key, shape[1])

    def items(self, shape: Shape, node: Node, path: str) -> tuple[Any, ...]:
        """The items of a list, of which there may be a maximum."""
        if node.kind != "sequence":
            self.wrong_structure(node, path, "a list", items_hint(node))
            return ()
        maximum = shape[2] if len(shape) > 2 else None
        if maximum is not None and len(node.value) > maximum:
            message = (
                f"{structure_of(path)} must have at most {maximum} items, found {len(node.value)}"
            )
            self.report("MSAA903", message, head_of(node.value[maximum]), f"{path}[{maximum}]")
        return tuple(
            self.value(shape[1], item, f"{path}[{n}]", str(n)) for n, item in enumerate(node.value)
        )

    def mapping(self, shape: Shape, node: Node, path: str) -> dict[str, Any]:
        """The entries of a mapping by name, or by number."""
        is_numbered = shape[0] == "numbered"
        if node.kind != "mapping":
            self.wrong_structure(
                node,
                path,
                f"a mapping by {'number' if is_numbered else 'name'}",
                mapping_hint(shape, node),
            )
            return {}
        highest = shape[2] if len(shape) > 2 else None
        for key in node.keys.values() if is_numbered else ():
            if not is_number(key.text) or (
                highest is not None
                and (int(key.text) > highest or len(key.text) > len(str(highest)))
            ):
                expected = "integers" if highest is None else f"integers from 0 to {highest}"
                self.report(
                    "MSAA903",
                    f"the keys of {structure_of(path)} must be {expected}, found {found(key)}",
                    key.span,
                    path,
                )
        for key in node.keys.values() if not self.dumped else ():
            if lacks_colon(key):
                name = key.text.split(" ")[0]
                self.report(
                    "MSAA901",
                    f"`:` is missing after the key {quoted(name)}; write {quoted(f'{name}:')}",
                    key.span,
                    path,
                )
                return {}
        item = shape[1]
        if item[0] == "record" and not self.dumped:
            names = list(node.value)
            for above, below in pairwise(names):
                # The members of an entry stand beside it.
                is_member = below in item[1].SHAPE and node.value[below].kind != "mapping"
                if is_member and has_no_value(node.value[above]):
                    self.unindented(above, node.keys[below], path)
                    return {}
        return {
            name: self.value(
                shape[1], value, f"{path}.{shortened(name)}", name, node.keys[name].span
            )
            for name, value in node.value.items()
        }

    def either(
        self, shapes: tuple[Shape, ...], node: Node, path: str, key: str, head: Span | None
    ) -> Any:
        """A value by the first shape that is of its kind."""
        for shape in shapes:
            if fits(shape, node):
                return self.value(shape, node, path, key, head)
        self.mismatch(node, path, " or ".join(_kind_of(shape) for shape in shapes))
        return None

    def slot(self, node: Node, path: str, key: str, head: Span | None) -> AttachmentReference:
        """An attachment of the same render pass: a name, an index, `{attachment, layout}`, or
        null.
        """
        if node.kind == "mapping":
            reference: AttachmentReference = self.record(AttachmentReference, node, path, key, head)
        else:
            reference = AttachmentReference(node, path, key, node.span)
            if (
                node.kind != "scalar"
                or isinstance(node.value, (bool, float))
                or (isinstance(node.value, int) and node.value < 0)
            ):
                self.mismatch(
                    node, path, "an attachment (a name, an index, {attachment, layout} or null)"
                )
            elif isinstance(node.value, int):
                reference.attachment = self.integer(0, MAX_UINT32, node, path)
            elif node.value is not None:
                reference.attachment = node.text
        if (
            self.dumped
            and isinstance(reference.attachment, str)
            and is_number(reference.attachment)
        ):
            reference.attachment = int(reference.attachment)
        if reference.attachment == ATTACHMENT_UNUSED or reference.attachment in UNUSED:
            reference.attachment = None
        return reference

    def command(self, node: Node, path: str, key: str, kind: type[Command]) -> Command | None:
        """A recorded command: a mapping with one key, or a bare word for a command without
        parameters.
        """
        name, parameters, span = "", None, head_of(node)
        if node.kind == "mapping" and len(node.value) == 1:
            name, parameters = next(iter(node.value.items()))
            span = node.keys[name].span
        elif node.kind == "scalar" and isinstance(node.value, str):
            name = node.value
        else:
            self.wrong_structure(node, path, "one command", commands_hint(node, kind))
            return None
        shape = kind.SHAPE.get(name)
        if shape is None:
            near = None if self.is_full else meant(name, kind.SHAPE)
            hint = "" if self.is_full else question_or_names(near, list(kind.SHAPE), ": ")
            self.report(
                "MSAA902", f"unknown command {quoted(name)}{hint}", span, path, foreign=near is None
            )
            return None
        command = kind(node, f"{path}.{name}", key, span)
        command.kind = name
        command.body = None
        if parameters is None or (parameters.kind == "scalar" and parameters.value is None):
            if shape[0] != "null":
                body = shape[1].SHAPE if shape[0] == "record" else ()
                hint = (
                    f"; write `{name}: {{{next(iter(body))}: ...}}`"
                    if body
                    else f"; write `{name}: ...`"
                )
                self.report(
                    "MSAA903", f"the command `{name}` needs parameters{hint}", span, command.path
                )
                return None
            return command
        command.body = self.value(shape, parameters, command.path, name, span)
        return command if command.body is not None else None


def fits(shape: Shape, node: Node) -> bool:
    """Whether a node is of the kind that a shape asks for, whatever its value."""
    kind = shape[0]
    if kind in ("record", "map", "numbered"):
        return node.kind == "mapping"
    if kind == "list":
        return node.kind == "sequence"
    if kind == "word":
        return is_word(node, shape[1])
    if kind == "name":
        return type(node.value) in (str, int)
    if kind == "int":
        return isinstance(node.value, int) and not isinstance(node.value, bool)
    if kind in ("number", "share"):
        return isinstance(node.value, (int, float)) and not isinstance(node.value, bool)
    if kind == "bool":
        return isinstance(node.value, bool)
    return node.kind == "scalar" and isinstance(node.value, str)


_KINDS = {
    "list": "a list",
    "int": "an integer",
    "number": "a number",
    "share": "a number",
    "bool": "true or false",
    "text": "a string",
}


def _kind_of(shape: Shape) -> str:
    """What a shape asks for, as a message has it."""
    if shape[0] == "name":
        return f"the name of an entry of `{shape[1]}`"
    return _KINDS.get(shape[0], "a mapping")
