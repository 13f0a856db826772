"""What calls do: the file's own functions are gone through, and others make what their structures say."""

from __future__ import annotations

import re
from collections.abc import Sequence

from msaa_lint.core.text.span import Span

from .names import elements, structure
from .objects import COUNTS, VIEW, Objects
from .scope import MEMBER, MOST_CALLS, MOST_WAYS, Around
from .terms import BRACES, CALL, FIELD, INDEX, LAMBDA, NAME, Function, Parameter, Term
from .values import MOST, UNKNOWN, UNKNOWN_VALUE, Alternative, Cell, Closure, Ref, Struct, Symbol, Value, copies, one, pointee

_CAST = re.compile(
    r"(?:std::)?u?int(?:8|16|32|64|ptr)?_t$|(?:std::)?size_t$|(?:unsigned|int|float|bool)$|(?:Vk|vk::)\w+(?:FlagBits2?|Flags2?|Bool32)(?:KHR|EXT)?$"
)
"""Types whose name makes a value of theirs of another."""


_OWNED = re.compile(r"(?:std::)?make_(?:unique|shared)<([\w:]+)>$")

OTHERS = Cell()
"""What stands for an object of a class that is not the method's."""


class Calls(Objects):
    """What the calls of one file make. `made` is in the order in which it was met."""

    def call(self, term: Term, around: Around) -> Value:
        """What a call gives."""
        function, arguments, place = term[1], term[2], term[3]
        name, owner = _called(function)
        if function[0] == LAMBDA:
            return self.follow(function[1], function[2], around.within, around.scopes, term, around)
        if owner is None and function[0] == NAME:
            closure = self.closure(name, around)
            if closure is not None:
                return self.follow(closure.parameters, closure.body, around.within, closure.scopes, term, around)
        callee = self.own(name, len(arguments), function, around)
        me = self.object_of(callee, owner, around) if callee is not None and callee.within else None
        if callee is not None and me is not OTHERS and self.may_follow(callee, place, around):
            return self.of_own(callee, term, around, me)
        if owner is None:
            if function[0] == NAME and (instance := self.object_made(function[1], term, around)) is not None:
                return instance
            kind = structure(function[1]) if function[0] == NAME else ""
            if kind:
                return self.constructed(kind, arguments, place, around, function[1].startswith(("vk::", "VULKAN")))
            if name == "to_array" and len(arguments) == 1 and arguments[0][0] == BRACES:
                return self.listed(function[1].partition("<")[2].rstrip(">"), arguments[0][2], place, around)
            if name in ("make_array", "makeArray") and arguments:
                return self.listed("", [(None, item) for item in arguments], place, around)
            if function[0] == NAME and len(arguments) == 1 and _CAST.match(function[1]):
                return self.run.value(arguments[0], around)
            inner = elements(function[1]) if function[0] == NAME else None
            if inner is not None:
                return self.sized(inner, arguments, place, around)
        else:
            value = self.method(owner, name, arguments, place, around)
            if value is not None:
                return value
        if name == "memset" and len(arguments) == 3:
            return self.zeroed(arguments, around)
        if name in ("min", "max", "MIN", "MAX") and len(arguments) == 2:
            return self.least(name.lower(), arguments, place, around)
        if name in ("size", "ARRAY_SIZE", "countof", "array_size", "ARRAYSIZE", "arraysize") and len(arguments) == 1:
            return self.counted(one(self.run.value(arguments[0], around)), place)
        values = [self.run.value(argument, around) for argument in arguments]
        return self.unknown(term, name, owner, values, around)

    def closure(self, name: str, around: Around) -> Closure | None:
        for scope in reversed(around.scopes):
            if name in scope:
                value = one(scope[name].writes)
                return value if isinstance(value, Closure) else None
        return None

    def own(self, name: str, count: int, function: Term, around: Around) -> Function | None:
        """The one function of the file that such a call can mean: of several the one of the same class."""
        every = self.run.functions.get(name)
        if not every:
            return None
        overloads = [f for f in every if sum(p.default is None for p in f.parameters) <= count <= len(f.parameters)]
        if len(overloads) > 1 and not self.run.fragments:
            scope = str(function[1]).rpartition("::")[0] if function[0] == NAME else ""
            within = around.within
            if function[0] == FIELD and function[1][:2] != (NAME, "this"):
                return None
            if scope:
                overloads = [f for f in overloads if f"{f.within or f.space.rstrip(':')}".endswith(scope)]
            else:
                overloads = [f for f in overloads if f.within == within] or [
                    f for f in overloads if not f.within and f.space == around.space
                ]
        overloads = [f for f in overloads if not f.open]
        return overloads[-1] if len(overloads) == 1 or (overloads and self.run.fragments) else None

    def object_of(self, function: Function, owner: Term | None, around: Around) -> Cell | None:
        """The object whose method is called: None where that is not known, OTHERS where it is of another class."""
        if owner is None or owner[:2] == (NAME, "this"):
            return around.me if function.within == around.within else None
        cell = self.run.place(owner, around) if owner[0] != CALL else None
        if cell is None:
            return None
        kind = self.run.type_of(cell)
        short = function.within.rpartition("::")[2]
        if kind and kind != "auto" and short not in kind and self.run.class_of(kind, around.space) != function.within:
            return OTHERS
        known = cell.kind == MEMBER or isinstance(pointee(one(cell.read(around.guards))), Struct)
        return cell if known else None

    def object_made(self, kind: str, term: Term, around: Around) -> Value | None:
        """An object of a class of the file's, by its constructor; None where it is none, or there are several that fit."""
        inner = _OWNED.match(kind)
        class_name = self.run.class_of(inner[1] if inner is not None else kind, around.space)
        if class_name is None:
            return None
        count = len(term[2])
        constructors = [
            item
            for item in self.run.functions.get(class_name.rpartition("::")[2], ())
            if item.within == class_name and sum(p.default is None for p in item.parameters) <= count <= len(item.parameters)
        ]
        if len(constructors) != 1 or not self.may_follow(constructors[0], term[3], around):
            return None
        struct = Struct("", term[3], False)
        me = Cell(class_name, "", (Alternative(struct, term[3]),))
        self.of_own(constructors[0], term, around, me)
        return (Alternative(struct, term[3]),)

    def may_follow(self, function: Function, place: Span, around: Around) -> bool:
        """Whether a call is followed: not too deep, not in a circle, and not again and again by other ways."""
        if len(around.calls) >= MOST_CALLS or function.at in around.within_calls:
            return False
        self.followed[place] = self.followed.get(place, 0) + 1
        return self.followed[place] <= MOST_WAYS

    def of_own(self, function: Function, term: Term, around: Around, me: Cell | None = None) -> Value:
        before = len(self.met)
        value = self.follow(
            function.parameters, function.body, function.within or around.within, (), term, around, function.returns, function, me
        )
        counts = {a.value for a in value if type(a.value) is int}
        if (len(value) >= 3 and counts and counts <= {1, 2, 4, 8, 16, 32, 64}) or (COUNTS.search(function.name) and not counts):
            return (Alternative(Symbol(f"{function.name}()", function.name, True), term[-1]),)
        if self.run.fragments and len(self.met) == before:
            image = self.by_types(function, term, around)
            if image is not None:
                return image
        if not value and VIEW.search(function.name):
            return self.viewed([self.run.value(a, around) for a in term[2]], term, around) or UNKNOWN_VALUE
        return value

    def follow(
        self,
        parameters: Sequence[Parameter],
        body: Sequence[Term],
        within: str,
        scopes: Sequence[dict[str, Cell]],
        term: Term,
        around: Around,
        returns: str = "",
        function: Function | None = None,
        me: Cell | None = None,
    ) -> Value:
        """Goes through a function with the arguments of a call."""
        cells: dict[str, Cell] = {}
        for n, parameter in enumerate(parameters):
            if n < len(term[2]):
                cells[parameter.name] = self.bound(parameter, term[2][n], around)
            elif parameter.default is not None:
                value = self.run.value(parameter.default, around, parameter.type)
                cells[parameter.name] = Cell(parameter.type, parameter.name, value, f"default({parameter.name})")
        inner = Around(within, (*scopes, cells), around.guards, (*around.calls, term[3]))
        inner.space = around.space if function is None else function.space
        inner.within_calls = around.within_calls if function is None else (*around.within_calls, function.at)
        inner.loops = around.loops
        inner.returns = returns
        inner.turns = around.turns
        inner.me = me if function is not None else around.me
        self.run.block(body, inner)
        base = around.guards
        returned = [Alternative(a.value, a.at, a.guards - base) for a in inner.returned]
        if len(returned) > MOST or not returned or all(a.value is UNKNOWN for a in returned):
            return UNKNOWN_VALUE
        return tuple(returned)

    def bound(self, parameter: Parameter, term: Term, around: Around) -> Cell:
        """The cell of a parameter: the argument's own, where that is handed over by reference."""
        if parameter.by_reference and term[0] in (NAME, FIELD, INDEX):
            cell = self.run.place(term, around)
            if cell is not None and not isinstance(one(cell.writes), Ref):
                return cell
        value = self.run.value(term, around, parameter.type)
        parameter_cell = Cell(parameter.type, parameter.name, key=f"argument({parameter.name})")
        if parameter.by_reference:
            parameter_cell.writes = value
        else:
            parameter_cell.writes = copies(value)
        if not value:
            parameter_cell.writes = (Alternative(UNKNOWN, term[-1]),)
        return parameter_cell

    def least(self, name: str, arguments: Sequence[Term], place: Span, around: Around) -> Value:
        left, right = (one(self.run.value(a, around)) for a in arguments)
        if isinstance(left, (int, float)) and isinstance(right, (int, float)):
            return (Alternative(min(left, right) if name == "min" else max(left, right), place),)
        return UNKNOWN_VALUE


def _called(function: Term) -> tuple[str, Term | None]:
    """The name of a function, and the object that it is called on."""
    if function[0] == NAME:
        return str(function[1]).rpartition("::")[2].partition("<")[0], None
    if function[0] == FIELD:
        return str(function[2]), function[1]
    return "", None
