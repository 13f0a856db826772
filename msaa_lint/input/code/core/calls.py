"""Calls: functions of the program are executed; what other functions do is left to the library of
the API.
"""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Hashable, Mapping, Sequence
from itertools import islice
from typing import Any

from msaa_lint.core.text.span import Span

from .classes import pointed
from .executions import callable_key
from .library import Library
from .limits import Work
from .overloads import bound
from .resolution import Resolution
from .scope import MAX_CALLS, MAX_CLOSURES, MAX_WAYS, MEMBER, Scope, Scopes
from .static_types import OWNED, made_list
from .terms import (
    BRACES,
    CALL,
    FIELD,
    INDEX,
    LAMBDA,
    NAME,
    UNPARSED,
    Function,
    Parameter,
    Term,
    Unit,
    short_name,
)
from .types import element_type
from .values import (
    MAX_ALTERNATIVES,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Array,
    Cell,
    Closure,
    Flags,
    Ref,
    Routine,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
)

_CAST = re.compile(
    r"(?:std::)?u?int(?:8|16|32|64|ptr)?_t$|(?:std::)?size_t$|(?:unsigned|int|float|bool)$"
)
"""Types whose name, used as a function, converts a value."""


COPIES = frozenset({"memcpy", "memmove", "copy", "copy_n"})

MAX_EQUAL_STEPS = 10_000
"""The steps after which, in each execution of a program, a call without arguments is not followed
again for the same object: it would do the same.
"""

MAX_REPEATED_STEPS = 50_000
"""The steps after which a call is followed at most MAX_WAYS times, unless the function creates
something.
"""

MAX_CREATING_STEPS = 400_000
"""The steps after which that holds for every call. A helper that creates something creates
something else at each call.
"""


class Calls(Resolution):
    """Evaluates the calls of a program. `objects` is in creation order."""

    def __init__(
        self, unit: Unit, library: Library, fragments: bool, is_cpp: bool, work: Work
    ) -> None:
        super().__init__(unit, library, fragments, is_cpp, work)
        self.followed: set[Span] = set()
        """The functions that a call was followed to."""
        self.reserve = 0
        """The steps that are left for what is certainly executed, at least."""
        self.results: dict[Span, tuple[Hashable, Value]] = {}
        """The arguments and the result of the last execution of each call."""
        self.creating: set[Span] = set()
        """The functions that create objects of the API or declare its structures."""

    def begin(self) -> None:
        super().begin()
        self.results.clear()
        self.reserve = self.work.left - MAX_REPEATED_STEPS
        self.creating_reserve = self.work.left - MAX_CREATING_STEPS
        self.equal_reserve = self.work.left - MAX_EQUAL_STEPS

    @abstractmethod
    def external_call(
        self, term: Term, name: str, owner: Term | None, values: Sequence[Value], scope: Scope
    ) -> Value:
        """Returns the result of a function that the program does not define: the object that the
        structures among its arguments create.
        """

    @abstractmethod
    def algorithm(self, name: str, arguments: Sequence[Term], place: Span, scope: Scope) -> bool:
        """Executes an algorithm on a list. Returns False if it is not one, or if it has other
        arguments.
        """

    @abstractmethod
    def result_of(
        self, function: Function, term: Term, value: Value, creates: bool, scope: Scope
    ) -> Value:
        """Returns what the API knows of the result of a call that was executed; `creates` says
        whether that created anything.
        """

    def get(self, term: Term, scope: Scope) -> Value | None:
        """Returns the result of the getter that a name or member calls, or None."""
        name, owner = _callee(term)
        receiver = self.received(owner, scope) if owner is not None else None
        function = self.find_function(name, (), term, receiver, scope)
        if function is None or not function.getter or function.open:
            return None
        if not self.may_follow(function, term[-1], scope):
            return None
        return self.call_function(
            function, (CALL, term, (), term[-1]), scope, self.this_of(function, receiver, scope)
        )

    def call(self, term: Term, scope: Scope) -> Value:
        """Returns the value of a call."""
        function, arguments, place = term[1], term[2], term[3]
        name, owner = _callee(function)
        if function[0] == LAMBDA:
            closure: Closure | Routine | None = Closure(
                function[1], function[2], scope.scopes, scope.this_object
            )
        else:
            closure = self.local_callable(name, scope) if function[0] == NAME else None
        if isinstance(closure, Closure):
            return self.call_closure(closure, term, scope)
        receiver = self.received(owner, scope) if owner is not None else None
        callee = (
            closure.function
            if closure is not None
            else self.find_function(name, arguments, function, receiver, scope)
        )
        if callee is None and self.is_callable(name):
            called = sole_value(self.read(function, scope))
            if isinstance(called, Closure):
                return self.call_closure(called, term, scope)
            callee = called.function if isinstance(called, Routine) else None
        if callee is not None:
            this_object = self.this_of(callee, receiver, scope)
            if not arguments and not scope.iterations and self.work.left <= self.equal_reserve:
                repeated = self.repeated_result(callee, term, scope, this_object)
                if repeated is not None:
                    return repeated
            if self.may_follow(callee, place, scope):
                before = len(self.current_objects)
                result = self.call_function(callee, term, scope, this_object)
                is_method = (
                    bool(callee.class_name) and owner is not None and owner[:2] != (NAME, "this")
                )
                if is_method and (this_object is None or self.is_pointed(this_object, scope)):
                    result = self.result_of_unknown_object(result, callee, term, before, scope)
                if place in self.results:
                    self.results[place] = self.results[place][0], result
                return result
            repeated = self.repeated_result(callee, term, scope, this_object)
            if repeated is not None:
                return repeated
        if owner is None:
            if (of_tuple := self.tuple_call(function, arguments, place, scope)) is not None:
                return of_tuple
            if (
                function[0] == NAME
                and (instance := self.construct_class(function[1], term, scope)) is not None
            ):
                return instance
            if function[0] == NAME and self.library.structure(function[1]):
                return self.construct(
                    function[1], [(None, item) for item in arguments], place, scope
                )
            if name == "to_array" and len(arguments) == 1 and arguments[0][0] == BRACES:
                return self.list_value(
                    function[1].partition("<")[2][:-1], arguments[0][2], place, scope
                )
            if name in ("make_array", "makeArray") and arguments:
                return self.list_value("", [(None, item) for item in arguments], place, scope)
            if (
                function[0] == NAME
                and len(arguments) == 1
                and (_CAST.match(function[1]) or self.library.is_cast(function[1]))
            ):
                return self.value(arguments[0], scope)
            inner = (
                made_list(function[1]) or element_type(function[1]) if function[0] == NAME else None
            )
            if inner is not None:
                return self.sized_list(inner, arguments, place, scope)
        else:
            value = (
                self.method(receiver, name, arguments, place, scope)
                if receiver is not None
                else None
            )
            if value is not None:
                return value
        if self.algorithm(name, arguments, place, scope):
            return UNKNOWN_VALUE
        if name in COPIES and len(arguments) == 3:
            self.copy_memory(
                *(
                    (arguments[0], arguments[1])
                    if name.startswith("mem")
                    else (arguments[2], arguments[0])
                ),
                scope,
            )
            return UNKNOWN_VALUE
        if name == "memset" and len(arguments) == 3:
            return self.zero_memory(arguments, scope)
        if name in ("min", "max", "MIN", "MAX") and len(arguments) == 2:
            return self.extreme(name.lower(), arguments, place, scope)
        if (
            name in ("size", "ARRAY_SIZE", "countof", "array_size", "ARRAYSIZE", "arraysize")
            and len(arguments) == 1
        ):
            return self.count_value(self.sole(arguments[0], scope), place)
        values = [self.value(argument, scope) for argument in arguments]
        for value in values:
            if isinstance(sole_value(value), Closure):
                self.call_back(sole_value(value), place, scope)
        return self.external_call(term, name, owner, values, scope)

    def is_callable(self, name: str) -> bool:
        """Returns whether functions are assigned to variables or members of a name."""
        self.consulted.add(callable_key(name))
        return name in self.callable_names

    def local_callable(self, name: str, scope: Scope) -> Closure | Routine | None:
        for variables in reversed(scope.scopes):
            if name in variables:
                value = pointee(sole_value(variables[name].writes))
                return value if isinstance(value, (Closure, Routine)) else None
        return None

    def call_closure(self, closure: Closure, term: Term, scope: Scope) -> Value:
        place = closure.body[0][-1] if closure.body else term[-1]
        if place in scope.active_functions or len(scope.calls) >= MAX_CLOSURES:
            return UNKNOWN_VALUE
        class_name, namespace = (
            closure.class_name or scope.class_name,
            closure.namespace or scope.namespace,
        )
        body = Function("", class_name, "", closure.parameters, closure.body, place, namespace)
        return self.execute(body, term, scope, closure.this_object, closure.scopes)

    def call_back(self, closure: Closure, place: Span, scope: Scope) -> None:
        """Executes a lambda that an unknown function takes, with unknown arguments."""
        scope.unknown_loops += 1
        self.call_closure(
            closure,
            (
                CALL,
                (NAME, "", place),
                tuple((UNPARSED, "", place) for _ in closure.parameters),
                place,
            ),
            scope,
        )
        scope.unknown_loops -= 1

    def construct_class(self, kind: str, term: Term, scope: Scope) -> Value | None:
        """Returns an object of a class of the program, built by its constructor; None for other
        types and if several constructors match.
        """
        owned = OWNED.match(kind)
        class_name = (
            self.class_of(owned[1] if owned is not None else kind, scope.enclosing)
            if pointed(kind) == kind
            else None
        )
        if class_name is None:
            return None
        struct = self.new_object(class_name, term[3])
        short = class_name.rpartition("::")[2]
        every = self.classes.methods.get((class_name, short), [])
        constructor = self.matching(self.taking(every, term[2]), term[2], scope)
        if constructor is None:
            return None if every or term[2] else (Alternative(struct, term[3]),)
        if not self.may_follow(constructor, term[3], scope):
            return None
        self.call_function(
            constructor, term, scope, Cell(class_name, "", (Alternative(struct, term[3]),))
        )
        return (Alternative(struct, term[3]),)

    def construct_base(self, name: str, term: Term, scope: Scope) -> None:
        class_name = self.class_of(name, scope.enclosing) or ""
        every = self.classes.methods.get((class_name, class_name.rpartition("::")[2]), [])
        constructor = self.matching(self.taking(every, term[2]), term[2], scope)
        if constructor is not None and self.may_follow(constructor, term[3], scope):
            self.call_function(constructor, term, scope, scope.this_object)

    def may_follow(self, function: Function, place: Span, scope: Scope) -> bool:
        """Returns whether to execute a call: not if calls nest too deeply or recurse, nor often if
        much of the work is done.
        """
        if len(scope.calls) >= MAX_CALLS or function.at in scope.active_functions:
            return False
        self.follow_counts[place] = self.follow_counts.get(place, 0) + 1
        reserve = self.creating_reserve if function.at in self.creating else self.reserve
        return self.follow_counts[place] <= MAX_WAYS or self.work.left > reserve

    def repeated_result(
        self, function: Function, term: Term, scope: Scope, this_object: Cell | None
    ) -> Value | None:
        """Returns the result that a call had with the same arguments, or None. Executed again, it
        would do the same.
        """
        if function.at in scope.active_functions or (known := self.results.get(term[-1])) is None:
            return None
        cells = self.bind(function, term, scope)
        return known[1] if self.arguments_of(function, cells, this_object) == known[0] else None

    def arguments_of(
        self, function: Function, cells: Mapping[str, Cell], this_object: Cell | None
    ) -> Hashable:
        """Returns what two calls with the same arguments have in common. Lists, structures, and
        lambdas may have changed.
        """
        arguments: list[Hashable] = [
            this_object.key
            if this_object is not None and this_object.kind == MEMBER
            else this_object
        ]
        for parameter in function.parameters:
            cell = cells.get(parameter.name)
            if cell is None or (parameter.by_reference and not parameter.fixed):
                arguments.append(cell.key if cell is not None and cell.kind == MEMBER else cell)
            else:
                arguments.append(tuple(map(_identity, (item.value for item in cell.writes))))
        return tuple(arguments)

    def call_function(
        self, function: Function, term: Term, scope: Scope, this_object: Cell | None = None
    ) -> Value:
        before, declared = len(self.current_objects), len(self.declared_structs)
        value = self.execute(function, term, scope, this_object)
        if len(self.current_objects) > before or len(self.declared_structs) > declared:
            self.creating.add(function.at)
        counts = {a.value for a in value if type(a.value) is int}
        if (len(value) >= 3 and counts and counts <= {1, 2, 4, 8, 16, 32, 64}) or (
            self.library.is_count_choice(function.name) and not counts
        ):
            return (Alternative(Symbol(f"{function.name}()", function.name, True), term[-1]),)
        if len(term[2]) == 1 and value:
            value = self.converted(function, term[2][0], value, scope)
        return self.result_of(function, term, value, len(self.current_objects) > before, scope)

    def converted(self, function: Function, argument: Term, value: Value, scope: Scope) -> Value:
        """Returns the result of a function that converts a constant to one of the API. What it is,
        the place of the argument says.
        """
        if (
            argument[0] not in (NAME, FIELD, INDEX)
            or not all(isinstance(a.value, str) for a in value)
            or not function.body
        ):
            return value
        source = self.value(argument, scope)
        if len(source) != len(value) or any(not isinstance(a.value, (int, str)) for a in source):
            return value
        start, end = function.body[0][-1].start, function.body[-1][-1].end
        of_function = all(start <= a.at.start < end for a in value)
        return (
            tuple(a._replace(at=b.at) for a, b in zip(value, source, strict=True))
            if of_function
            else value
        )

    def result_of_unknown_object(
        self, value: Value, function: Function, term: Term, before: int, scope: Scope
    ) -> Value:
        """Returns the result of a method of an object that is unknown: what is known of its class,
        but not an image or another API object that a member holds, since each object has its own.
        `before` is the number of API objects before the call.
        """
        created = list(
            islice(reversed(self.current_objects.values()), len(self.current_objects) - before)
        )
        kind = function.return_type
        is_handle = self.library.is_type(kind) and not self.library.is_scalar(kind)
        own = Symbol(self.key_of_call(term, scope), function.name)
        return tuple(
            a._replace(value=own)
            if (isinstance(a.value, ApiObject) and a.value not in created)
            or (isinstance(a.value, Symbol) and is_handle)
            else a
            for a in value
        )

    def execute(
        self,
        function: Function,
        term: Term,
        scope: Scope,
        this_object: Cell | None,
        scopes: Scopes = (),
    ) -> Value:
        """Executes a function with the arguments of a call. `scopes` are the enclosing variables of
        a lambda.
        """
        cells = self.bind(function, term, scope)
        if function.name:
            self.results[term[3]] = self.arguments_of(function, cells, this_object), UNKNOWN_VALUE
        inner = Scope(
            function.class_name or scope.class_name,
            function.namespace,
            (*scopes, cells),
            scope.guards,
            (*scope.calls, term[3]),
        )
        inner.active_functions = (*scope.active_functions, function.at)
        self.followed.add(function.at)
        inner.unknown_loops = scope.unknown_loops
        inner.return_type, inner.by_reference = function.return_type, function.by_reference
        inner.iterations = scope.iterations
        inner.this_object = this_object
        if function.class_name and function.name != function.class_name.rpartition("::")[2]:
            inner.object_class = self.object_class(function.class_name, term, this_object, scope)
        if function.body:
            inner.extent = Span(function.body[0][-1].start, function.body[-1][-1].end)
        reading, self.reading = self.reading, False
        self.block(function.body, inner)
        self.reading = reading
        base = scope.guards
        return_values = [Alternative(a.value, a.at, a.guards - base) for a in inner.return_values]
        if (
            len(return_values) > MAX_ALTERNATIVES
            or not return_values
            or all(a.value is UNKNOWN for a in return_values)
        ):
            return UNKNOWN_VALUE
        return tuple(return_values)

    def object_class(
        self, class_name: str, term: Term, this_object: Cell | None, scope: Scope
    ) -> str:
        """Returns the class of the object that a method of a class is called on: that class, or one
        known to derive from it.
        """
        known = pointee(sole_value(this_object.writes)) if this_object is not None else None
        owner = _callee(term[1])[1]
        own = (
            known.type
            if isinstance(known, Struct)
            else scope.object_class
            if owner is None or owner[:2] == (NAME, "this")
            else ""
        )
        return (
            own
            if own and own != class_name and class_name in self.classes.chain(own)
            else class_name
        )

    def bind(self, function: Function, term: Term, scope: Scope) -> dict[str, Cell]:
        """Returns the parameters of a function with the arguments of a call."""
        cells: dict[str, Cell] = {}
        for parameter, argument in bound(function.parameters, term[2]):
            if argument is not None:
                cells[parameter.name] = self.bind_parameter(parameter, argument, scope)
            elif parameter.default is not None:
                value = self.value(parameter.default, scope, parameter.type)
                cells[parameter.name] = Cell(
                    parameter.type, parameter.name, value, f"default({parameter.name})"
                )
        return cells

    def bind_parameter(self, parameter: Parameter, term: Term, scope: Scope) -> Cell:
        """Returns the cell of a parameter; for an argument passed by reference, the argument's own
        cell.
        """
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
        return Cell(
            parameter.type,
            parameter.name,
            writes or (Alternative(UNKNOWN, term[-1]),),
            f"argument({parameter.name})",
        )

    def extreme(self, name: str, arguments: Sequence[Term], place: Span, scope: Scope) -> Value:
        values = [self.sole(argument, scope) for argument in arguments]
        known = [value for value in values if isinstance(value, (int, float))]
        if len(known) < len(values):
            # The lesser of a wish and a limit is chosen; the greater of an unknown number and one
            # above 1 is above 1.
            if 1 in known and name == "max":
                return next(
                    (
                        value
                        for value in map(self.value, arguments, (scope, scope))
                        if sole_value(value) != 1
                    ),
                    UNKNOWN_VALUE,
                )
            chosen = 1 not in known and (name == "min" or bool(known))
            return (Alternative(Symbol(f"{name} at {place.start}", name, chosen), place),)
        return (Alternative(min(values) if name == "min" else max(values), place),)


def _identity(value: Any) -> Hashable:
    """Returns what two equal arguments have in common; every list and structure differs."""
    if isinstance(value, Symbol):
        return value.key
    if isinstance(value, Ref):
        return value.cell if not isinstance(pointee(value), (Array, Struct, Closure)) else object()
    if isinstance(value, Flags):
        return tuple(bit for bit, _ in value.bits)
    return object() if isinstance(value, (Array, Struct, Closure)) else value


def _callee(function: Term) -> tuple[str, Term | None]:
    """Returns the name of a function and the object that it is called on."""
    if function[0] == NAME:
        return short_name(function[1]), None
    if function[0] == FIELD:
        return str(function[2]), function[1]
    return "", None
