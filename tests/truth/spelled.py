"""A description as different texts: JSON, block and flow style, keys in another order, equal parts
as anchors and aliases.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from random import Random
from typing import Any

import yaml

IN_ORDER = {
    "attachments",
    "pipelines",
    "framebuffers",
    "images",
    "renderPasses",
    "textures",
    "renderPipelines",
}
"""The mappings whose entries have a number, or an order of their findings."""


def without_aliases(data: Any) -> Any:
    """The data with no part in two places."""
    return json.loads(json.dumps(data))


def shuffled(data: Any, random: Random, key: str = "") -> Any:
    """The data with the keys of each structure in another order."""
    if isinstance(data, list):
        return [shuffled(each, random) for each in data]
    if not isinstance(data, dict):
        return data
    names = list(data)
    if key not in IN_ORDER:
        random.shuffle(names)
    return {name: shuffled(data[name], random, name) for name in names}


def shared(data: Any) -> Any:
    """The data with each part that is equal to an earlier one in its place: a YAML dumper gives
    these anchors.

    Without commands: a rendering that an alias repeats is one mistake, as the renderings of a
    capture that are alike.
    """
    known: dict[str, Any] = {}

    def one(value: Any) -> Any:
        if isinstance(value, dict):
            value = {
                name: each if name == "commands" else one(each) for name, each in value.items()
            }
        elif isinstance(value, list):
            value = [one(each) for each in value]
        else:
            return value
        return known.setdefault(json.dumps(value), value) if value else value

    return one(data)


class _Dumper(yaml.SafeDumper):
    pass


def dumped(data: Any, **options: Any) -> str:
    text: str = yaml.dump(data, Dumper=_Dumper, sort_keys=False, width=10_000, **options)
    return text


STYLES: dict[str, Callable[[Any, Random], str]] = {
    "json": lambda data, _: json.dumps(data),
    "indented json": lambda data, _: json.dumps(data, indent=1),
    "block": lambda data, _: dumped(without_aliases(data), default_flow_style=False),
    "flow": lambda data, _: dumped(without_aliases(data), default_flow_style=True),
    "leaves in flow": lambda data, _: dumped(without_aliases(data), default_flow_style=None),
    "shuffled block": lambda data, random: dumped(shuffled(data, random), default_flow_style=False),
    "shuffled json": lambda data, random: json.dumps(shuffled(data, random)),
    "shuffled leaves in flow": lambda data, random: dumped(
        shuffled(data, random), default_flow_style=None
    ),
    "aliases in block": lambda data, _: dumped(shared(data), default_flow_style=False),
    "aliases in flow": lambda data, _: dumped(shared(data), default_flow_style=None),
    "shuffled aliases": lambda data, random: dumped(
        shared(shuffled(data, random)), default_flow_style=None
    ),
}
