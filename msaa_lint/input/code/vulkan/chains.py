"""The structure chains of vulkan.hpp: `vk::StructureChain<vk::RenderPassCreateInfo2, ...>`, whose
structures point to the next one.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.interpreter import Interpreter
from msaa_lint.input.code.core.scope import Scope
from msaa_lint.input.code.core.terms import BRACES, NAME, Term
from msaa_lint.input.code.core.values import Alternative, Cell, Ref, Struct, Value, sole_value

_CHAIN = re.compile(r"(?:\w+::)*StructureChain(?:<([\w:,]*)>)?\Z")

TYPE = "vk::StructureChain"
"""The type of a chain."""


class StructureChains(Interpreter):
    """Executes what a program does with structure chains."""

    def construct_class(self, kind: str, term: Term, scope: Scope) -> Value | None:
        chain = _CHAIN.match(kind)
        return (
            self.chain(chain[1], term[2], term[-1], scope)
            if chain is not None
            else super().construct_class(kind, term, scope)
        )

    def braced_value(self, term: Term, scope: Scope, kind: str) -> Value:
        chain = _CHAIN.match(term[1] or kind)
        items = [item for _, item in term[2]]
        return (
            self.chain(chain[1], items, term[-1], scope)
            if chain is not None
            else super().braced_value(term, scope, kind)
        )

    def chain(self, types: str | None, items: Sequence[Term], place: Span, scope: Scope) -> Value:
        """Returns a chain of structures. Without types, they have those of their initial values."""
        chain = Struct("", place)
        chain.type = TYPE
        kinds = types.split(",") if types else ["" for _ in items]
        last: Struct | None = None
        for n, kind in enumerate(kinds):
            term = items[n] if n < len(items) else (BRACES, kind, (), place)
            value = self.copies.alternatives(self.value(term, scope, kind))
            struct = sole_value(value)
            if not isinstance(struct, Struct):
                struct = Struct(self.library.structure(kind), place)
                value = (Alternative(struct, place),)
            cell = chain.fields[self.library.structure(kind) or struct.kind] = Cell(
                kind, writes=value
            )
            if last is not None:
                last.cell("next").writes = (Alternative(Ref(cell), place),)
            last = struct
        return (Alternative(chain, place),)

    def object_method(
        self,
        owner: Term,
        value: Any,
        name: str,
        arguments: Sequence[Term],
        place: Span,
        scope: Scope,
    ) -> Value | None:
        if not isinstance(value, Struct) or value.type != TYPE:
            return super().object_method(owner, value, name, arguments, place, scope)
        if name != "get" or not value.fields:
            return None
        kind = (
            self.library.structure(arguments[0][1]) if arguments and arguments[0][0] == NAME else ""
        )
        cell = value.fields.get(kind) if arguments else next(iter(value.fields.values()))
        return (Alternative(Ref(cell, True), place),) if cell is not None else None
