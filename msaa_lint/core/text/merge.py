"""Merge keys: `<<: *base` and `<<: [*one, *two]`."""

from __future__ import annotations

from msaa_lint.core.quote import quoted

from .node import Node, Stop


def merge(node: Node) -> None:
    """Replaces `<<` in a mapping with the members of its bases. Earlier bases override later ones,
    the mapping's own members override both.

    Nodes are shared, and were counted against the limits where the bases are named.
    """
    key, merged = node.keys["<<"], node.value["<<"]
    if not key.plain:
        return
    bases = merged.value if merged.kind == "sequence" else [merged]
    for base in bases:
        if base.kind != "mapping":
            message = (
                "`<<` must be a mapping or a list of mappings, found "
                f"{quoted(base.text) if base.kind == 'scalar' else 'a list'}"
            )
            raise Stop(
                "MSAA903",
                f"{message}; write `*name` with the name of an anchor",
                base.start,
                max(base.end, base.start + 1),
            )
    values: dict[str, Node] = {}
    keys: dict[str, Node] = {}
    for name, value in node.value.items():
        if name != "<<":
            values.setdefault(name, value)
            keys.setdefault(name, node.keys[name])
            continue
        for base in bases:
            for inherited in base.value:
                stated = node if inherited in node.value and inherited != "<<" else base
                values.setdefault(inherited, stated.value[inherited])
                keys.setdefault(inherited, stated.keys[inherited])
    node.value, node.keys = values, keys
