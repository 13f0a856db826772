"""Joins the definitions of the files of a program to those of one unit.

A definition that several files contain alike counts once. Of definitions that differ, a file uses
its own, or the only one among the files that it includes; for the others, the name is unknown. To
keep them apart, the names that such a file defines are in a namespace of its own, `#7::`, inside
the namespace that they are declared in, which is where the interpreter looks first.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence, Set
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.terms import DECLARE, Function, Parameter, Term, Unit

MAX_REACH = 400
"""The maximum number of files that a file is searched through for one that it includes and that
defines a name.
"""


class File(NamedTuple):
    """A file of a program: its definitions, whether it is a source rather than a header, and the
    numbers of the files that it includes itself.
    """

    unit: Unit
    is_source: bool
    includes: Sequence[int]


def merged(files: Sequence[File]) -> Unit:
    """Returns the definitions of the files of a program, in order."""
    if len(files) == 1:
        return files[0].unit
    conflicts = _Conflicts(files)
    units = [conflicts.separated(number) for number in range(len(files))]
    virtual = frozenset(name for unit in units for name in unit.virtual)
    prototypes: dict[str, tuple[Parameter, ...]] = {}
    members: dict[str, Sequence[Term]] = {}
    for unit in units:
        for name, parameters in unit.prototypes.items():
            prototypes.setdefault(name, parameters)
        for name, terms in unit.members.items():
            members[name] = (
                (*members.get(name, ()), *terms)
                if name in unit.extended
                else members.get(name, terms)
            )
    functions: dict[Hashable, Function] = {}
    classes: dict[str, list[str]] = {}
    for name in members:
        classes.setdefault(name.rpartition("::")[2], []).append(name)
    for unit in units:
        for function in unit.functions:
            function = _qualified(function, members, classes)
            functions.setdefault(
                (*_signature(function), shape(function.body)),
                _completed(function, prototypes, virtual),
            )
    outside = _globals(term for unit in units for term in unit.outside)
    called = frozenset(name for unit in units for name in unit.called)
    bases: dict[str, tuple[str, ...]] = {}
    for unit in units:
        for name, names in unit.bases.items():
            bases[name] = (*bases.get(name, ()), *names)
    visible = frozenset(name for unit in units for name in unit.visible)
    extended = frozenset(name for unit in units for name in unit.extended)
    aliases: dict[str, str] = {}
    for name, stands in ((name, stands) for unit in units for name, stands in unit.aliases.items()):
        # A name that stands for different things says nothing.
        aliases[name] = stands if aliases.get(name, stands) == stands else name
    return Unit(
        list(functions.values()),
        members,
        outside,
        prototypes,
        called,
        virtual,
        bases,
        visible,
        extended,
        aliases,
    )


def _qualified(
    function: Function, members: Mapping[str, object], classes: Mapping[str, Sequence[str]]
) -> Function:
    """Returns a method with the full name of its class, which `using namespace` lets a file
    shorten. `classes` has the classes by their last names.
    """
    name = function.class_name
    if not name or name in members:
        return function
    named = [
        full for full in classes.get(name.rpartition("::")[2], ()) if full.endswith(f"::{name}")
    ]
    if len(named) != 1:
        return function
    return function._replace(
        class_name=named[0], namespace=f"{named[0].removesuffix(name)}{function.namespace}"
    )


def _signature(function: Function) -> tuple[Hashable, ...]:
    return (
        function.namespace,
        function.class_name,
        function.name,
        tuple(parameter.type for parameter in function.parameters),
    )


def _completed(
    function: Function, prototypes: Mapping[str, tuple[Parameter, ...]], virtual: Set[str]
) -> Function:
    """Returns a function with what its declaration in another file adds: default arguments, and
    whether a class may override it.
    """
    declared = prototypes.get(function.name, ())
    parameters = function.parameters
    if len(declared) == len(parameters) and all(
        a.type == b.type for a, b in zip(declared, parameters, strict=True)
    ):
        parameters = tuple(
            item._replace(default=item.default or entry.default)
            for item, entry in zip(parameters, declared, strict=True)
        )
    is_open = function.open or f"{function.class_name}::{function.name}" in virtual
    return function._replace(parameters=parameters, open=is_open)


def _globals(terms: Iterable[Term]) -> list[Term]:
    """Returns declarations outside of functions without those that only declare what another one
    defines.
    """
    terms = list(terms)
    defined = {term[2] for term in terms if term[0] == DECLARE and term[3] is not None}
    return [
        term
        for term in terms
        if term[0] != DECLARE or term[3] is not None or term[2] not in defined
    ]


def shape(part: Any) -> Hashable:
    """Returns a term without locations."""
    if isinstance(part, Span):
        return None
    return tuple(map(shape, part)) if isinstance(part, tuple) else part


Name = tuple[Hashable, ...]
"""What a file defines: the kind, and the qualified name."""

CLASS, FUNCTION, GLOBAL = "class", "function", "global"


def _definitions(file: File) -> Iterator[tuple[Name, Any]]:
    """Yields the names that a file defines, and what they stand for."""
    for name, terms in file.unit.members.items():
        if name not in file.unit.extended:
            yield (CLASS, name), tuple(terms)
    for function in file.unit.functions:
        yield (FUNCTION, *_signature(function)), function.body
    for term in file.unit.outside:
        if term[0] == DECLARE and (term[3] is not None or file.is_source):
            yield (GLOBAL, term[2]), term[1:4]


def _is_variable(name: Name, contents: Iterable[Any]) -> bool:
    """Returns whether a name is a variable without a value, which each file has for itself."""
    return name[0] == GLOBAL and any(value is None for _, _, value in contents)


class _Conflicts:
    """The names of a program with definitions that differ between files."""

    def __init__(self, files: Sequence[File]) -> None:
        self.files = files
        definitions: dict[Name, dict[int, Any]] = {}
        for number, file in enumerate(files):
            for name, content in _definitions(file):
                definitions.setdefault(name, {}).setdefault(number, content)
        self.names: dict[int, set[Name]] = {}
        """The names that each file defines otherwise than another one."""
        for name, contents in definitions.items():
            if len(contents) > 1 and (
                _is_variable(name, contents.values()) or len(set(map(shape, contents.values()))) > 1
            ):
                for number in contents:
                    self.names.setdefault(number, set()).add(name)

    def separated(self, number: int) -> Unit:
        """Returns the definitions of a file, with names of its own for those that differ from
        definitions of other files.
        """
        unit = self.files[number].unit
        owners = self.owners(number) if self.names else {}
        if not owners:
            return unit

        def renamed(kind: str, name: str) -> str:
            owner = owners.get((kind, name))
            if owner is None:
                return name
            namespace, colons, last = name.rpartition("::")
            return f"{namespace}{colons}{_tag(owner)}{last}"

        tag = _tag(number if number in self.names else min(owners.values()))
        classes = {
            name: renamed(CLASS, name)
            for name in {*unit.members, *(function.class_name for function in unit.functions)}
        }
        functions = [
            function._replace(
                namespace=function.namespace + tag, class_name=classes[function.class_name]
            )
            for function in unit.functions
        ]
        outside = [
            (*term[:2], renamed(GLOBAL, term[2]), *term[3:]) if term[0] == DECLARE else term
            for term in unit.outside
        ]
        members = {classes[name]: terms for name, terms in unit.members.items()}
        methods = (name.rpartition("::") for name in unit.virtual)
        virtual = frozenset(
            f"{renamed(CLASS, class_name)}::{method}" for class_name, _, method in methods
        )
        bases = {renamed(CLASS, name): names for name, names in unit.bases.items()}
        return unit._replace(
            functions=functions, outside=outside, members=members, virtual=virtual, bases=bases
        )

    def owners(self, number: int) -> dict[Name, int]:
        """Returns the file whose definition of a name a file uses: itself, or the only one among
        the files that it includes.
        """
        owners = dict.fromkeys(self.names.get(number, ()), number)
        found: dict[Name, list[int]] = {}
        for other in self.reach(number):
            for name in self.names.get(other, ()):
                found.setdefault(name, []).append(other)
        for name, others in found.items():
            if name not in owners and len(others) == 1:
                owners[name] = others[0]
        return owners

    def reach(self, number: int) -> Iterator[int]:
        """Yields the files that a file includes, and that they include, the nearest first."""
        seen = {number}
        waiting = [number]
        for at in waiting:
            for other in self.files[at].includes:
                if other not in seen and len(waiting) < MAX_REACH:
                    seen.add(other)
                    waiting.append(other)
                    yield other


def _tag(number: int) -> str:
    return f"#{number}::"
