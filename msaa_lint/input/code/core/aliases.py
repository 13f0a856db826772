"""Other names of the types and namespaces of a program: `using Attachments = std::vector<...>`,
`namespace api = engine::api`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from .terms import DECLARE, Term, Unit

MAX_LINKS = 4
"""The maximum number of aliases of aliases."""


def resolved(name: str, aliases: Mapping[str, str]) -> str:
    """Returns what the name of a type or namespace stands for; other names as they are. Elements of
    lists and arrays are not looked up.
    """
    for _ in range(MAX_LINKS):
        bare = name.rstrip("*&")
        target = aliases.get(bare.rpartition("::")[2]) if "<" not in bare else None
        if target is None or target == bare:
            break
        name = target + name[len(bare) :]
    return name


def without_aliases(unit: Unit) -> Unit:
    """Returns the definitions of a program with the types of members, globals, parameters, and
    results in place of their aliases.
    """
    if not unit.aliases:
        return unit

    def declared(terms: Sequence[Term]) -> list[Term]:
        return [
            (DECLARE, resolved(term[1], unit.aliases), *term[2:]) if term[0] == DECLARE else term
            for term in terms
        ]

    functions = [
        function._replace(
            parameters=tuple(
                item._replace(type=resolved(item.type, unit.aliases))
                for item in function.parameters
            ),
            return_type=resolved(function.return_type, unit.aliases),
        )
        for function in unit.functions
    ]
    members = {name: declared(terms) for name, terms in unit.members.items()}
    return unit._replace(functions=functions, members=members, outside=declared(unit.outside))
