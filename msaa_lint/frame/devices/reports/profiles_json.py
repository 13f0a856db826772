"""The JSON of Khronos' Vulkan Profiles: profiles of what a class of devices guarantees, and what
vulkaninfo exports of one device.

A profile lists blocks of capabilities, all of which hold; a list within the list is alternatives,
one of which holds: so what every alternative has is what is guaranteed. What a profile calls
optional is not.
"""

from __future__ import annotations

import itertools
import operator
from collections.abc import Callable, Iterator, Mapping
from functools import partial, reduce
from typing import Any, NamedTuple

from . import values
from .members import BOOLEANS, FLAGS, NUMBERS, Found, gathered, shown

EXPORTED = ("VP_VULKANINFO_", "VP_GPUINFO_")
MAX_PROFILES = 64
MAX_DEPTH = 8
"""Profiles that require profiles that require ..."""


class Block(NamedTuple):
    """What a block guarantees: masks, booleans and least numbers by member, features,
    extensions.
    """

    members: dict[str, int]
    features: frozenset[str] = frozenset()
    extensions: frozenset[str] = frozenset()
    notes: tuple[str, ...] = ()


def claims(root: Mapping[str, Any]) -> bool:
    """Whether a JSON object has profiles and capabilities."""
    return isinstance(root.get("capabilities"), dict) and isinstance(root.get("profiles"), dict)


def read(root: Mapping[str, Any]) -> list[Found]:
    """A device for each profile of a file."""
    return [
        _device(root, profile)
        if name.startswith(EXPORTED) or _names_a_device(root, profile)
        else _minimum(root, name, profile)
        for name, profile in itertools.islice(root["profiles"].items(), MAX_PROFILES)
        if isinstance(profile, dict)
    ]


def _names_a_device(root: Mapping[str, Any], profile: Mapping[str, Any]) -> bool:
    return any(
        "deviceName" in gathered(block.get("properties"))
        for block in _blocks(root, profile.get("capabilities"))
    )


def _blocks(root: Mapping[str, Any], listed: object) -> Iterator[Mapping[str, Any]]:
    """The capability blocks that a list names, alternatives too."""
    for name in listed if isinstance(listed, list) else ():
        inner = name if isinstance(name, list) else [name]
        for each in inner:
            block = root["capabilities"].get(each) if isinstance(each, str) else None
            if isinstance(block, dict):
                yield block


def _device(root: Mapping[str, Any], profile: Mapping[str, Any]) -> Found:
    blocks = list(_blocks(root, profile.get("capabilities")))
    members = gathered(*(block.get("properties") for block in blocks))
    features: dict[object, object] = {}
    for name, value in itertools.chain.from_iterable(map(_features, blocks)):
        features[name] = features.get(name) is True or value
    extensions = [
        block["extensions"] for block in blocks if isinstance(block.get("extensions"), dict)
    ]
    return Found(
        members,
        features if any("features" in block for block in blocks) else None,
        [name for listed in extensions for name in listed] if extensions else None,
        name="" if "deviceName" in members else values.text(profile.get("label")) or "",
        what="vulkaninfo --json",
        notes=("memory types are not in it: the text of `vulkaninfo` has them",),
    )


def _features(block: Mapping[str, Any]) -> Iterator[tuple[str, object]]:
    structures = block.get("features")
    for structure in structures.values() if isinstance(structures, dict) else ():
        yield from structure.items() if isinstance(structure, dict) else ()


def _minimum(root: Mapping[str, Any], name: str, profile: Mapping[str, Any]) -> Found:
    block = _required(root, profile, (name,))
    label = values.text(profile.get("label"))
    version = values.number(profile.get("version"))
    what = (
        f"Vulkan profile {name}"
        + (f" version {version}" if version is not None else "")
        + (f" ({label})" if label else "")
    )
    return Found(
        {member: [value] for member, value in block.members.items()},
        dict.fromkeys(block.features, True),
        sorted(block.extensions),
        name=name,
        api=profile.get("api-version"),
        minimum=True,
        what=what,
        notes=block.notes,
    )


def _required(root: Mapping[str, Any], profile: Mapping[str, Any], above: tuple[str, ...]) -> Block:
    """All that a profile guarantees, and what it requires of other profiles of the file."""
    parts = []
    required = profile.get("profiles")
    for name in required if isinstance(required, list) and len(above) < MAX_DEPTH else ():
        inner = root["profiles"].get(name) if isinstance(name, str) else None
        if isinstance(inner, dict) and name not in above:
            parts.append(_required(root, inner, (*above, name)))
        elif not isinstance(inner, dict):
            parts.append(
                Block(
                    {},
                    notes=(
                        f"the file has no profile {shown(name)}, which {above[-1][:80]} requires",
                    ),
                )
            )
    listed = profile.get("capabilities")
    for each in listed if isinstance(listed, list) else ():
        names = each if isinstance(each, list) else [each]
        blocks = [_block(root, name) for name in names]
        if blocks:
            parts.append(_any_of(blocks))
    return _all_of(parts)


def _block(root: Mapping[str, Any], name: object) -> Block:
    stated = root["capabilities"].get(name) if isinstance(name, str) else None
    if not isinstance(stated, dict):
        return Block({}, notes=(f"the file has no capabilities {shown(name)}",))
    members: dict[str, int] = {}
    notes = []
    for member, found in gathered(stated.get("properties")).items():
        read: int | None
        if member in FLAGS:
            read = values.mask(FLAGS[member], found[0])
        elif member in BOOLEANS:
            read = values.boolean(found[0])
        elif member in NUMBERS:
            read = values.number(found[0])
        else:
            continue
        if read is None:
            notes.append(f"{member}: {shown(found[0])}, passed over")
        elif read:
            # That a profile asks for no more than false or 0 says nothing of a device.
            members[member] = read
    extensions = stated.get("extensions")
    return Block(
        members,
        frozenset(
            member
            for member, value in _features(stated)
            if values.boolean(value) and values.is_feature(member)
        ),
        frozenset(filter(values.is_extension, extensions))
        if isinstance(extensions, dict)
        else frozenset(),
        tuple(notes),
    )


def _merged(
    blocks: list[Block],
    names: Callable[..., frozenset[str]],
    masks: Callable[[int, int], int],
    numbers: Callable[..., int],
) -> Block:
    """Blocks as one: `names` merges sets of names, `masks` and `numbers` the values of a member."""
    members = {
        member: reduce(
            masks if member in FLAGS else numbers,
            (block.members[member] for block in blocks if member in block.members),
        )
        for member in names(*(frozenset(block.members) for block in blocks))
    }
    return Block(
        members,
        names(*(block.features for block in blocks)),
        names(*(block.extensions for block in blocks)),
        tuple(note for block in blocks for note in block.notes),
    )


_all_of = partial(_merged, names=frozenset().union, masks=operator.or_, numbers=max)
_any_of = partial(_merged, names=frozenset.intersection, masks=operator.and_, numbers=min)
