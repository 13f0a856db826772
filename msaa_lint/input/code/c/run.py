"""C and C++ functions gone through from top to bottom, as far as they fill in structures of Vulkan's.

Every function that none of the file calls is a beginning; a call of the file's own functions is followed with its arguments. Conditions
are not decided, but kept with what was written under them. What members hold is the union of what all functions write to them: the file is
gone through again with what the first time found. A value that is not known stays so.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span

from .calls import Calls
from .conditions import clash, opposite
from .escapes import mark_escaped
from .evaluate import Values
from .places import an_element
from .scope import MOST_PASSES, MOST_TURNS, Around, Stop
from .terms import BINARY, BLOCK, DECLARE, DO, FIELD, IF, INDEX, LEAVE, LOOP, NAME, RETURN, SOME, UNARY, Function, Term, Unit, at
from .values import ALWAYS, MOST, UNKNOWN, Alternative, Array, Cell, Closure, Guards, Ref, Struct, Symbol, Value, VulkanObject, one, pointee


class Run(Values):
    """One file while it is gone through."""

    def __init__(self, unit: Unit, fragments: bool, plus: bool = True) -> None:
        super().__init__(unit, fragments, plus)
        self.program = Calls(self)
        self.calls = self.program

    def through(self) -> None:
        """Goes through the file until what members hold is the same as before."""
        roots = self.roots()
        try:
            for _ in range(MOST_PASSES):
                self.program.begin()
                writes_by_key: dict[str, dict[tuple[Any, ...], Alternative]] = {}
                for function in roots:
                    self.overlay, self.initial = {}, {}
                    self.root(function)
                    for key, cell in self.overlay.items():
                        before = {id(write) for write in self.initial.get(key, ())}
                        for write in cell.writes:
                            if id(write) in before:
                                continue
                            if write.value is UNKNOWN:
                                write = Alternative(Symbol(key, key.rpartition("::")[2]), write.at, write.guards)
                            writes_by_key.setdefault(key, {}).setdefault(_mark(write), write)
                if self.fragments:
                    self.program.pieces(self.overlay)
                last, self.summary = self.summary, {key: _joined(key, list(writes.values())) for key, writes in writes_by_key.items()}
                if _marks(last) == _marks(self.summary):
                    break
        except (Stop, RecursionError):
            return

    def roots(self) -> list[Function]:
        # A constructor runs where the object is made: as a member, it has no call of its own.
        types = {term[1] for terms in self.members.values() for term in terms.values()}
        constructors = {f.name for f in self.unit.functions if f.within.rpartition("::")[2] == f.name and f.parameters and f.name in types}
        roots = [f for f in self.unit.functions if f.name not in self.unit.called and f.name not in constructors]
        return [*roots, Function("", "", "", (), self.unit.outside, Span(0, 0))] if self.fragments else roots

    def root(self, function: Function) -> None:
        around = Around(function.within, ({},), ALWAYS, ())
        around.space = function.space
        for parameter in function.parameters:
            cell = Cell(parameter.type, parameter.name, (), f"{function.name}({parameter.name})")
            if parameter.name:
                around.scopes[-1][parameter.name] = cell
        self.block(function.body, around)
        for returned in around.returned:
            mark_escaped(returned.value)
        self.program.ended(around)

    def block(self, statements: Sequence[Term], around: Around) -> None:
        for statement in statements:
            if around.gone:
                return
            self.statement(statement, around)

    def within_block(self, statements: Sequence[Term], around: Around, guards: Guards, scoped: bool = True) -> bool:
        """Goes through a block under conditions, with variables of its own; whether it leaves what is around it."""
        outer, scopes = around.guards, around.scopes
        around.guards = outer | guards
        around.scopes = (*scopes, {}) if scoped else scopes
        self.block(statements, around)
        around.guards, around.scopes = outer, scopes
        left, around.gone = around.gone, False
        return left

    def statement(self, term: Term, around: Around) -> None:
        self.step()
        kind = term[0]
        if kind == DECLARE:
            self.declare(term, around)
        elif kind == DO:
            self.value(term[1], around)
        elif kind == RETURN:
            if term[1] is not None:
                value = self.value(term[1], around, around.returns)
                base = around.guards
                around.returned += [Alternative(a.value, a.at, a.guards | base) for a in value] or [Alternative(UNKNOWN, term[-1], base)]
            around.gone = True
        elif kind == LEAVE:
            around.gone = True
        elif kind == IF:
            self.test(self.condition(term[1], around), term, around)
        elif kind == SOME:
            self.test(self.preprocessed(term[1]), term, around)
        elif kind == LOOP:
            self.loop(term, around)
        elif kind == BLOCK:
            around.gone = self.within_block(term[1], around, ALWAYS)

    def test(self, condition: bool | Guards, term: Term, around: Around) -> None:
        then, otherwise = term[2], term[3]
        # What the preprocessor leaves stands where it stood.
        scoped = term[0] == IF
        if isinstance(condition, bool):
            around.gone = self.within_block(then if condition else otherwise, around, ALWAYS, scoped)
            return
        known = dict(around.guards)
        if any(known.get(text) is (not way) for text, way in condition):
            around.gone = self.within_block(otherwise, around, ALWAYS, scoped)
            return
        if all(known.get(text) is way for text, way in condition):
            around.gone = self.within_block(then, around, ALWAYS, scoped)
            return
        against = opposite(condition)
        left = self.within_block(then, around, condition, scoped)
        leaves = self.within_block(otherwise, around, against, scoped) if otherwise else False
        if left and leaves:
            around.gone = True
        elif left:
            around.guards |= against
        elif leaves:
            around.guards |= condition

    def loop(self, term: Term, around: Around) -> None:
        declared, over, body = term[1], term[2], term[3]
        scopes = around.scopes
        around.scopes = (*scopes, {})
        if over is not None:
            items = self.elements(over, around)
            if items is not None and declared and len(items) <= MOST_TURNS:
                before = around.turns
                for turn, item in enumerate(items):
                    around.scopes[-1][declared[0][2]] = item
                    around.turns = (*before, turn)
                    self.within_block(body, around, ALWAYS)
                around.scopes, around.turns = scopes, before
                return
        turns = self.turns(declared, body, around) if over is None else None
        for statement in declared:
            self.declare(statement, around)
        if turns is not None:
            cell = around.scopes[-1][declared[0][2]]
            before = around.turns
            for turn in range(*turns):
                cell.writes = (Alternative(turn, at(declared[0])),)
                around.turns = (*before, turn)
                self.within_block(body, around, ALWAYS)
            around.turns = before
        else:
            for statement in declared:
                around.scopes[-1][statement[2]] = Cell(statement[1], statement[2])
            around.loops += 1
            self.within_block(body, around, ALWAYS)
            around.loops -= 1
        around.scopes = scopes

    def turns(self, declared: Sequence[Term], body: Sequence[Term], around: Around) -> tuple[int, int] | None:
        """From where to where a counter goes, where that is known and short."""
        if len(declared) != 1 or declared[0][3] is None or not body or body[0][0] != DO:
            return None
        test, name = body[0][1], declared[0][2]
        update: Term = body[-1][1] if body[-1][0] == DO else body[-1]
        if update[0] != UNARY or update[1] not in ("++", "post++") or update[2][:2] != (NAME, name):
            return None
        if test[0] != BINARY or test[1] not in ("<", "!=", "<=") or test[2][:2] != (NAME, name):
            return None
        first, last = one(self.value(declared[0][3], around)), one(self.value(test[3], around))
        if type(first) is not int or type(last) is not int:
            return None
        last += test[1] == "<="
        return (first, last) if 0 <= last - first <= MOST_TURNS else None

    def elements(self, over: Term, around: Around) -> list[Cell] | None:
        """The elements of a list that is known whole."""
        value = pointee(one(self.value(over, around)))
        return value.items if isinstance(value, Array) and value.whole else None

    def declare(self, term: Term, around: Around) -> None:
        _, kind, name, initializer, indirect, _, place = term
        if self.fragments and len(around.scopes) == 1 and not around.calls and f"::{name}" in self.summary:
            # A page's other pieces give it a value.
            around.scopes[-1][name] = self.path(f"::{name}")
            return
        if indirect and initializer is not None:
            named = initializer[0] in (NAME, FIELD, INDEX) or an_element(initializer)
            cell = self.place(initializer, around) if named and not kind.endswith("*") else None
            if cell is not None and not isinstance(one(cell.read(around.guards)), Ref):
                around.scopes[-1][name] = cell
                return
        cell = self.declared_elsewhere(name, kind, around) or Cell(kind, name)
        around.scopes[-1][name] = cell
        if initializer is None:
            value = self.bare(kind, name, place, indirect, around)
        else:
            value = self.value(initializer, around, kind)
            value = tuple(Alternative(self.taken(a.value, kind, name), a.at, a.guards) for a in value)
        cell.write(value, place, around.guards)
        self.calls.called_by(value, name, around)
        self.program.born += [(a.value, around.guards) for a in value if isinstance(a.value, Struct) and a.value.kind]

    @staticmethod
    def declared_elsewhere(name: str, kind: str, around: Around) -> Cell | None:
        """A variable that the preprocessor has declared in the other branch of an #if."""
        before = around.scopes[-1].get(name)
        if before is None or before.kind.partition("[")[0] != kind.partition("[")[0] or not around.guards or not before.writes:
            return None
        return before if all(clash(write.guards, around.guards) for write in before.writes) else None


def _mark(write: Alternative) -> tuple[Any, ...]:
    value = write.value
    if isinstance(value, VulkanObject):
        return (value.signature(), write.guards)
    return (id(value) if isinstance(value, (Struct, Array, Closure)) else repr(value), write.at, write.guards)


def _joined(key: str, writes: list[Alternative]) -> Value:
    """What all functions write to a member: that it is null until then, and again in the end, is no news."""
    objects = [write for write in writes if isinstance(write.value, (VulkanObject, Struct, Array))]
    joined = tuple(objects or writes)
    return joined if len(joined) <= MOST else (Alternative(Symbol(key, key.rpartition("::")[2]), joined[0].at),)


def _marks(summary: dict[str, Value]) -> dict[str, list[tuple[Any, ...]]]:
    return {
        key: [(type(w.value).__name__, w.value if isinstance(w.value, (int, str, float, Symbol)) else None, w.at) for w in writes]
        for key, writes in summary.items()
    }
