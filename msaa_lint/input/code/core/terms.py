"""Terms: the syntax trees of C and C++ reduced to about two dozen kinds of nodes.

A term is a tuple of its kind, its parts, and its location. Expressions:

    (NAME, text, at)                      a name as written, with its qualifiers:
                                          `vk::Format::eUndefined`, `samples`
    (LITERAL, value, at)                  a number, a boolean, or None for a null pointer
    (FIELD, object, name, at)             `object.name` or `object->name`; the location is that of
                                          the name
    (INDEX, object, index, at)
    (ADDRESS, of, at), (TARGET, of, at)   `&of` and `*of`
    (UNARY, operator, of, at)
    (BINARY, operator, left, right, at)
    (ASSIGN, operator, target, value, at)
    (CHOICE, condition, then, otherwise, at)
    (CALL, function, arguments, at)       also constructors and functional casts
    (BRACES, type or "", items, at)       items are (path of members or None, expression); the type
                                          is the one before the braces
    (LAMBDA, parameters, body, at)
    (SOME, text, way, expression, at)     an item in braces that exists only if a preprocessor
                                          condition has the value `way`
    (LABEL, name, expression, at)         a labeled argument of a call
    (UNPARSED, text, at)

Statements:

    (DECLARE, type, name, value or None, reference, fixed, at)
                                          `fixed`: const, or the value of a macro or enumerator
    (DO, expression, at), (RETURN, expression or None, at)
    (LEAVE, at), (BREAK, at)              the function; the loop or the switch
    (IF, condition, then, otherwise, at)
    (SWITCH, value, cases, at)            cases are (labels, statements); the label None is the
                                          default
    (LOOP, declared, over or None, body, at)
                                          `over` is the range of a range-based loop
    (SOME, text, then, otherwise, at)     a preprocessor block
    (BLOCK, statements, at)
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span

Term = tuple[Any, ...]

(
    NAME,
    LITERAL,
    FIELD,
    INDEX,
    ADDRESS,
    TARGET,
    UNARY,
    BINARY,
    ASSIGN,
    CHOICE,
    CALL,
    BRACES,
    LAMBDA,
    UNPARSED,
    LABEL,
) = range(15)
DECLARE, DO, RETURN, LEAVE, IF, LOOP, SOME, BLOCK, SWITCH, BREAK = range(20, 30)

TUPLE = "()"
"""The type before the braces of a tuple, whose items have their labels or numbers."""


class Parameter(NamedTuple):
    """A parameter: its type without `const`, `&`, and `*`; its name, if any; its default as a
    term.
    """

    type: str
    name: str
    by_reference: bool
    default: Term | None
    fixed: bool = False
    """Whether it points or refers to const."""
    label: str = ""
    """What a call writes before the argument, in languages that label arguments."""


class Function(NamedTuple):
    """A function definition: `class_name` is the class that it belongs to, `return_type` its return
    type; both may be empty.
    """

    name: str
    class_name: str
    return_type: str
    parameters: tuple[Parameter, ...]
    body: tuple[Term, ...]
    at: Span
    namespace: str = ""
    """The enclosing namespace, with a trailing `::`."""
    open: bool = False
    """Whether a derived class may override it."""
    getter: bool = False
    """Whether reading a member of its name calls it."""
    by_reference: bool = False
    """Whether it returns a reference."""
    only_called: bool = False
    """Whether it says nothing on its own, only where the program calls it."""


class Unit(NamedTuple):
    """The contents of a file, or of the files of a program: functions in order, the members of each
    class, global declarations, the parameters of declared functions by name, the names of functions
    that others call, and virtual methods with their class.
    """

    functions: Sequence[Function]
    members: Mapping[str, Sequence[Term]]
    outside: Sequence[Term]
    prototypes: Mapping[str, tuple[Parameter, ...]]
    called: Set[str]
    virtual: Set[str] = frozenset()
    bases: Mapping[str, Sequence[str]] = {}
    """The classes that each class derives from."""
    visible: Set[str] = frozenset()
    """Members that other files can read and change, as `Class::member`, in languages that state
    it.
    """
    extended: Set[str] = frozenset()
    """Classes of which several files may declare members, in languages with extensions."""
    aliases: Mapping[str, str] = {}
    """What other names of types and namespaces stand for."""


def at(term: Term) -> Span:
    """Returns the location of a term."""
    place: Span = term[-1]
    return place


def labeled(argument: Term) -> tuple[str, Term]:
    """Returns the label of an argument, or an empty string, and its expression."""
    return (argument[1], argument[2]) if argument[0] == LABEL else ("", argument)


def short_name(name: str) -> str:
    """Returns a name without its qualifiers and template arguments: `f` for
    `std::f<vk::Format>`.
    """
    if not name.endswith(">"):
        return name.rpartition("::")[2]
    depth = 0
    for n in range(len(name) - 1, 0, -1):
        depth += (name[n] == ">") - (name[n] == "<")
        if depth == 0:
            return name[:n].rpartition("::")[2]
    return name


def called_names(body: tuple[Term, ...]) -> set[str]:
    """Returns the names of the functions and methods that statements call, without qualifiers."""
    names: set[str] = set()
    stack: list[Any] = list(body)
    while stack:
        term = stack.pop()
        if isinstance(term, tuple) and not isinstance(term, Span):
            stack.extend(term)
            if len(term) == 4 and term[0] == CALL and term[1][0] in (NAME, FIELD):
                names.add(short_name(str(term[1][2 if term[1][0] == FIELD else 1])))
    return names
