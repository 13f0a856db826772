"""The declared types of expressions."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Sequence

from .objects import ClassObjects
from .scope import Scope
from .terms import ADDRESS, BRACES, CALL, FIELD, INDEX, NAME, TARGET, Function, Term
from .types import element_type

OWNED = re.compile(
    r"(?:\w+::)*(?:make_unique|make_shared|MakeUnique|MakeShared|CreateRef|CreateScope|make_ref|New)<([\w:]+)>$"
)
"""Functions that construct an object of a type."""

OWNED_LIST = re.compile(
    r"(?:\w+::)*(?:make_unique|make_shared|MakeUnique|MakeShared)(?:_for_overwrite)?<([\w:]+)\[\]>$"
)
"""Functions that construct a list of a type."""

SAME = frozenset(
    {"get", "Get", "value", "lock", "operator->", "operator*", "release", "ptr", "raw", "c_ptr"}
)
"""Methods of a pointer that return what it points to."""

MAX_DEPTH = 8
"""The maximum number of members and calls of an expression whose type is determined."""


class StaticTypes(ClassObjects):
    """The declared types of expressions."""

    def class_of_term(self, term: Term, scope: Scope) -> str | None:
        """Returns the class of the object that an expression is or points to, by its declaration,
        or None.
        """
        if term[:2] == (NAME, "this"):
            return scope.class_name or None
        kind = self.type_of_term(term, scope, 0)
        return self.class_of(kind, scope.enclosing) if kind else None

    def type_of_term(self, term: Term, scope: Scope, depth: int = 0) -> str:
        """Returns the declared type of an expression without pointers and references, or an empty
        string.
        """
        if depth > MAX_DEPTH:
            return ""
        self.step(scope)
        tag = term[0]
        if tag == NAME:
            if term[1] == "this":
                return scope.class_name
            cell = self.variable(term[1], scope)
            return self.type_of(cell) if cell is not None else ""
        if tag == FIELD:
            owner = self.class_of(self.type_of_term(term[1], scope, depth + 1), scope.enclosing)
            member = self.classes.member(owner, term[2]) if owner is not None else None
            return str(member[1]) if member is not None else ""
        if tag == INDEX:
            kind = self.type_of_term(term[1], scope, depth + 1)
            return element_type(kind) or kind
        if tag in (ADDRESS, TARGET):
            return self.type_of_term(term[1], scope, depth + 1)
        if tag == CALL:
            return self.type_of_call(term, scope, depth)
        return str(term[1]) if tag == BRACES else ""

    def type_of_call(self, term: Term, scope: Scope, depth: int) -> str:
        function = term[1]
        if function[0] == NAME:
            if match := OWNED.match(function[1]):
                return match[1]
            if self.class_of(function[1], scope.enclosing) is not None:
                return str(function[1])
            qualifier, _, name = function[1].rpartition("::")
            owner = self.class_of(qualifier, scope.enclosing) if qualifier else scope.class_name
            return _common_type(self.methods(owner, name) if owner else []) or _common_type(
                self.free_functions(name, len(term[2]))
            )
        if function[0] != FIELD:
            return ""
        owner = self.class_of(self.type_of_term(function[1], scope, depth + 1), scope.enclosing)
        if owner is not None and (kind := _common_type(self.methods(owner, function[2]))):
            return kind
        return self.type_of_term(function[1], scope, depth + 1) if function[2] in SAME else ""

    def methods(self, class_name: str, name: str) -> list[Function]:
        """Returns the methods of a name of the nearest class of a hierarchy that defines any;
        otherwise those of derived classes.
        """
        for owner in self.classes.chain(class_name):
            if methods := self.classes.methods.get((owner, name)):
                return methods
        return [
            method
            for owner in self.classes.derived(class_name)
            for method in self.classes.methods.get((owner, name), ())
        ]

    @abstractmethod
    def free_functions(self, name: str, count: int) -> Sequence[Function]:
        """Returns the functions outside of classes that take a number of arguments."""


def _common_type(functions: Sequence[Function]) -> str:
    """Returns the type that all of several functions return, or an empty string."""
    kinds = {function.return_type for function in functions}
    kind = kinds.pop() if len(kinds) == 1 else ""
    return "" if kind == "auto" else kind


def made_list(function: str) -> str | None:
    """Returns the type of the elements of the list that a function constructs, or None."""
    match = OWNED_LIST.match(function)
    return match[1] if match is not None else None
