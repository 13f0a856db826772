"""Calls: functions of the program are executed; what other functions do is left to the library of the API."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Sequence
from itertools import islice

from msaa_lint.core.text.span import Span

from .conditions import canonical_text
from .guards import brief
from .library import Library
from .limits import Work
from .lists import ListMethods
from .overloads import Overloads, bound
from .scope import MAX_CALLS, MAX_CLOSURES, MAX_WAYS, MEMBER, Scope, Scopes
from .terms import BRACES, CALL, FIELD, INDEX, LAMBDA, NAME, Function, Parameter, Term, Unit, labeled
from .types import element_type
from .values import (
    MAX_ALTERNATIVES,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Cell,
    Closure,
    Ref,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
)

_CAST = re.compile(r"(?:std::)?u?int(?:8|16|32|64|ptr)?_t$|(?:std::)?size_t$|(?:unsigned|int|float|bool)$")
"""Types whose name, used as a function, converts a value."""


_OWNED = re.compile(r"(?:std::)?make_(?:unique|shared)<([\w:]+)>$")

OTHERS = Cell()
"""Stands for an object of a class other than the method's."""


class Calls(ListMethods):
    """Evaluates the calls of one file. `objects` is in creation order."""

    def __init__(self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work) -> None:
        super().__init__(unit, library, fragments, is_cpp, work)
        self.functions = Overloads(unit.functions)
        self.followed: set[Span] = set()
        """The functions that a call was followed to."""

    @abstractmethod
    def external_call(self, term: Term, name: str, owner: Term | None, values: Sequence[Value], scope: Scope) -> Value:
        """Returns the result of a function that the program does not define: the object that the structures among its arguments create."""

    @abstractmethod
    def result_of(self, function: Function, term: Term, value: Value, creates: bool, scope: Scope) -> Value:
        """Returns what the API knows of the result of a call that was executed; `creates` says whether that created anything."""

    def get(self, term: Term, scope: Scope) -> Value | None:
        """Returns the result of the getter that a name or member calls, or None."""
        name, owner = _callee(term)
        function = self.find_function(name, (), term, scope)
        if function is None or not function.getter:
            return None
        this_object = self.receiver(function, owner, scope)
        if this_object is OTHERS or not self.may_follow(function, term[-1], scope):
            return None
        return self.call_function(function, (CALL, term, (), term[-1]), scope, this_object)

    def call(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a call."""
        function, arguments, place = term[1], term[2], term[3]
        name, owner = _callee(function)
        if function[0] == LAMBDA:
            closure: Closure | None = Closure(function[1], function[2], scope.scopes)
        else:
            closure = self.closure(name, scope) if function[0] == NAME else None
        if closure is not None:
            if place in scope.active_functions or len(scope.calls) >= MAX_CLOSURES:
                return UNKNOWN_VALUE
            body = Function("", "", "", closure.parameters, closure.body, place, scope.namespace)
            return self.execute(body, term, scope, scope.this_object, closure.scopes)
        callee = self.find_function(name, arguments, function, scope)
        if callee is not None and owner is not None and not callee.class_name and not self.fragments:
            # The method of an object that the program does not define, with the name of a function.
            callee = None
        this_object = self.receiver(callee, owner, scope) if callee is not None and callee.class_name else None
        if callee is not None and this_object is not OTHERS and self.may_follow(callee, place, scope):
            before = len(self.current_objects)
            result = self.call_function(callee, term, scope, this_object)
            is_method = bool(callee.class_name) and owner is not None and owner[:2] != (NAME, "this")
            return self.result_of_unknown_object(result, callee, term, before) if is_method and this_object is None else result
        if owner is None:
            if function[0] == NAME and (instance := self.construct_class(function[1], term, scope)) is not None:
                return instance
            if function[0] == NAME and self.library.structure(function[1]):
                return self.construct(function[1], [(None, item) for item in arguments], place, scope)
            if name == "to_array" and len(arguments) == 1 and arguments[0][0] == BRACES:
                return self.list_value(function[1].partition("<")[2].rstrip(">"), arguments[0][2], place, scope)
            if name in ("make_array", "makeArray") and arguments:
                return self.list_value("", [(None, item) for item in arguments], place, scope)
            if function[0] == NAME and len(arguments) == 1 and (_CAST.match(function[1]) or self.library.is_cast(function[1])):
                return self.value(arguments[0], scope)
            inner = element_type(function[1]) if function[0] == NAME else None
            if inner is not None:
                return self.sized_list(inner, arguments, place, scope)
        else:
            value = self.method(owner, name, arguments, place, scope)
            if value is not None:
                return value
        if name == "memset" and len(arguments) == 3:
            return self.zero_memory(arguments, scope)
        if name in ("min", "max", "MIN", "MAX") and len(arguments) == 2:
            return self.extreme(name.lower(), arguments, place, scope)
        if name in ("size", "ARRAY_SIZE", "countof", "array_size", "ARRAYSIZE", "arraysize") and len(arguments) == 1:
            return self.count_value(self.sole(arguments[0], scope), place)
        values = [self.value(argument, scope) for argument in arguments]
        return self.external_call(term, name, owner, values, scope)

    def closure(self, name: str, scope: Scope) -> Closure | None:
        for variables in reversed(scope.scopes):
            if name in variables:
                value = sole_value(variables[name].writes)
                return value if isinstance(value, Closure) else None
        return None

    def find_function(self, name: str, arguments: Sequence[Term], function: Term, scope: Scope) -> Function | None:
        """Returns the only function of the file that a call can refer to; among several, the one in the same class."""
        count = len(arguments)
        self.work.spend(1 + len(self.functions.of_count(name, count).every) // 16)
        group = self.functions.of_count(name, count).of_labels([labeled(argument)[0] for argument in arguments])
        if self.fragments:
            return group.fixed[-1] if group.fixed else None
        if len(group.every) > 1:
            qualifier = str(function[1]).rpartition("::")[0] if function[0] == NAME else ""
            if function[0] == FIELD and function[1][:2] != (NAME, "this"):
                return None
            if qualifier:
                self.work.spend(1 + len(group.fixed) // 16)
                named = [f for f in group.fixed if _qualified_owner(f).endswith(qualifier)]
                return named[0] if len(named) == 1 else None
            group = self.functions.of_scope(name, count, scope.class_name, scope.namespace)
            group = group.of_labels([labeled(argument)[0] for argument in arguments])
        return group.sole()

    def receiver(self, function: Function, owner: Term | None, scope: Scope) -> Cell | None:
        """Returns the object that a method is called on; None if it is unknown, OTHERS if it is of another class."""
        if owner is None or owner[:2] == (NAME, "this"):
            return scope.this_object if function.class_name == scope.class_name else None
        cell = self.cell_of(owner, scope) if owner[0] != CALL else None
        if cell is None:
            return None
        kind = self.type_of(cell)
        short = function.class_name.rpartition("::")[2]
        if kind and kind != "auto" and short not in kind and self.class_of(kind, scope.namespace) != function.class_name:
            return OTHERS
        known = cell.kind == MEMBER or isinstance(pointee(sole_value(cell.read(scope.guards))), Struct)
        return cell if known else None

    def construct_class(self, kind: str, term: Term, scope: Scope) -> Value | None:
        """Returns an object of a class in the file, built by its constructor; None for other types and if several constructors match."""
        inner = _OWNED.match(kind)
        class_name = self.class_of(inner[1] if inner is not None else kind, scope.namespace)
        if class_name is None:
            return None
        count = len(term[2])
        constructors = self.functions.of_class(class_name.rpartition("::")[2], count, class_name).every
        if len(constructors) != 1 or not self.may_follow(constructors[0], term[3], scope):
            return None
        struct = Struct("", term[3], False)
        this_object = Cell(class_name, "", (Alternative(struct, term[3]),))
        self.call_function(constructors[0], term, scope, this_object)
        return (Alternative(struct, term[3]),)

    def may_follow(self, function: Function, place: Span, scope: Scope) -> bool:
        """Returns whether to execute a call: not if calls nest too deeply, recurse, or have been executed too often."""
        if len(scope.calls) >= MAX_CALLS or function.at in scope.active_functions:
            return False
        self.follow_counts[place] = self.follow_counts.get(place, 0) + 1
        return self.follow_counts[place] <= MAX_WAYS

    def call_function(self, function: Function, term: Term, scope: Scope, this_object: Cell | None = None) -> Value:
        before = len(self.current_objects)
        value = self.execute(function, term, scope, this_object)
        counts = {a.value for a in value if type(a.value) is int}
        if (len(value) >= 3 and counts and counts <= {1, 2, 4, 8, 16, 32, 64}) or (
            self.library.is_count_choice(function.name) and not counts
        ):
            return (Alternative(Symbol(f"{function.name}()", function.name, True), term[-1]),)
        return self.result_of(function, term, value, len(self.current_objects) > before, scope)

    def result_of_unknown_object(self, value: Value, function: Function, term: Term, before: int) -> Value:
        """Returns the result of a method of an object that is unknown: what is known of its class, but not an image or another API object
        that a member holds, since each object has its own. `before` is the number of API objects before the call."""
        created = list(islice(reversed(self.current_objects.values()), len(self.current_objects) - before))
        kind = function.return_type
        is_handle = self.library.is_type(kind) and not self.library.is_scalar(kind)
        own = Symbol(brief(canonical_text(term)), function.name)
        return tuple(
            a._replace(value=own)
            if (isinstance(a.value, ApiObject) and a.value not in created) or (isinstance(a.value, Symbol) and is_handle)
            else a
            for a in value
        )

    def execute(self, function: Function, term: Term, scope: Scope, this_object: Cell | None, scopes: Scopes = ()) -> Value:
        """Executes a function with the arguments of a call. `scopes` are the enclosing variables of a lambda."""
        cells: dict[str, Cell] = {}
        for parameter, argument in bound(function.parameters, term[2]):
            if argument is not None:
                cells[parameter.name] = self.bind_parameter(parameter, argument, scope)
            elif parameter.default is not None:
                value = self.value(parameter.default, scope, parameter.type)
                cells[parameter.name] = Cell(parameter.type, parameter.name, value, f"default({parameter.name})")
        inner = Scope(function.class_name or scope.class_name, function.namespace, (*scopes, cells), scope.guards, (*scope.calls, term[3]))
        inner.active_functions = (*scope.active_functions, function.at)
        self.followed.add(function.at)
        inner.unknown_loops = scope.unknown_loops
        inner.return_type = function.return_type
        inner.iterations = scope.iterations
        inner.this_object = this_object
        self.block(function.body, inner)
        base = scope.guards
        return_values = [Alternative(a.value, a.at, a.guards - base) for a in inner.return_values]
        if len(return_values) > MAX_ALTERNATIVES or not return_values or all(a.value is UNKNOWN for a in return_values):
            return UNKNOWN_VALUE
        return tuple(return_values)

    def bind_parameter(self, parameter: Parameter, term: Term, scope: Scope) -> Cell:
        """Returns the cell of a parameter; for an argument passed by reference, the argument's own cell."""
        if parameter.by_reference and term[0] in (NAME, FIELD, INDEX):
            cell = self.cell_of(term, scope)
            if cell is not None and not isinstance(sole_value(cell.writes), Ref):
                return cell
        value = self.value(term, scope, parameter.type)
        value = (
            value
            if any(not isinstance(a.value, Symbol) for a in value)
            else self.typed_value(parameter.type, parameter.name, term[-1]) or value
        )
        writes = value if parameter.by_reference else self.copies.alternatives(value)
        return Cell(parameter.type, parameter.name, writes or (Alternative(UNKNOWN, term[-1]),), f"argument({parameter.name})")

    def extreme(self, name: str, arguments: Sequence[Term], place: Span, scope: Scope) -> Value:
        values = [self.sole(argument, scope) for argument in arguments]
        known = [value for value in values if isinstance(value, (int, float))]
        if len(known) < len(values):
            # The lesser of a wish and a limit is chosen; the greater of an unknown number and one above 1 is above 1.
            if 1 in known and name == "max":
                return next((value for value in map(self.value, arguments, (scope, scope)) if sole_value(value) != 1), UNKNOWN_VALUE)
            chosen = 1 not in known and (name == "min" or bool(known))
            return (Alternative(Symbol(f"{name} at {place.start}", name, chosen), place),)
        return (Alternative(min(values) if name == "min" else max(values), place),)


def _qualified_owner(function: Function) -> str:
    """Returns the class of a function, or else its namespace, as a call of it may state it: without what tells files apart."""
    owner = function.class_name or function.namespace.removesuffix("::")
    return "::".join(part for part in owner.split("::") if part[:1] != "#") if "#" in owner else owner


def _callee(function: Term) -> tuple[str, Term | None]:
    """Returns the name of a function and the object that it is called on."""
    if function[0] == NAME:
        return str(function[1]).rpartition("::")[2].partition("<")[0], None
    if function[0] == FIELD:
        return str(function[2]), function[1]
    return "", None
