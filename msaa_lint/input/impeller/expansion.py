"""A description with `renderTargets` as one without: what the engine builds of them, in Vulkan's words or in a `metal` section."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.models import Description, Device
from msaa_lint.frame.devices import builtin

from . import metal, vulkan
from .target import Target, sections
from .value_tree import Value, tree

PASSTHROUGH_SECTIONS = ("frame", "device", "enabled", "scene", "sampleCountChoices")
"""Sections that stand beside `renderTargets`, and go on as they are."""

METAL_MEMBERS = ("family", "supportedSampleCounts")
"""What a `metal` section may state beside `renderTargets`: the device."""


MAX_TARGETS = 256
"""Targets of a description: each becomes some two hundred nodes."""


def check(binder: Binder, description: Description) -> None:
    """What the engine cannot be asked for, and what cannot stand beside `renderTargets`, as problems."""
    targets = description.renderTargets
    if len(targets) > MAX_TARGETS:
        record = list(targets.values())[MAX_TARGETS]
        binder.report("MSAA903", f"there are at most {MAX_TARGETS} render targets", record.head, record.path)
    apis = {record.api for record in targets.values() if record.api is not None}
    for section in description.spelled:
        if section not in (*PASSTHROUGH_SECTIONS, "renderTargets") and not (section == "metal" and apis <= {"metal"}):
            message = f"`{section}` cannot stand beside `renderTargets`, which give the whole frame"
            help = "`msaa-lint convert` writes what they give, to be added to"
            binder.report("MSAA903", message, description.spelled[section][0].span, section, help)
    if "metal" in description.spelled:
        for name, key in description.spelled["metal"][1].keys.items():
            if name not in METAL_MEMBERS:
                message = f"beside `renderTargets`, `metal` may state {' and '.join(METAL_MEMBERS)} alone"
                binder.report("MSAA903", message, key.span, f"metal.{name}")
    first = next((record for record in targets.values() if record.api is not None), None)
    for record in targets.values():
        if record.api is None and not record.states("api"):
            binder.report("MSAA903", f"`{record.key}` is due with its `api`: vulkan or metal", record.head, record.path)
        elif first is not None and record.api not in (None, first.api):
            message = f"`{first.key}` is {first.api}'s: the targets of a frame have one api"
            binder.report("MSAA903", message, record.place("api"), f"{record.path}.api")
        if record.api == "vulkan" and record.colorFormat is not None and record.colorFormat.startswith("kB10G10R10"):
            message = f"`{record.colorFormat}` is Metal's alone: the engine has no extended range on Vulkan"
            binder.report("MSAA903", message, record.place("colorFormat"), f"{record.path}.colorFormat")
        if record.depthFormat == "kS8UInt" and record.enableStencil is False:
            message = "`kS8UInt` is stencil alone, and `enableStencil` is false"
            binder.report("MSAA903", message, record.place("enableStencil"), f"{record.path}.enableStencil")


def expand(description: Description) -> Node:
    """The tree of the description that the render targets of a sound one give. Its nodes stand where their reasons do."""
    root = description.node
    key = description.spelled["renderTargets"][0].span
    targets = [Target(name, record, description.frame) for name, record in description.renderTargets.items()]
    made: dict[str, object] = {**sections(root, PASSTHROUGH_SECTIONS)}
    if any(record.api == "metal" for record in description.renderTargets.values()):
        stated = sections(root.value["metal"], METAL_MEMBERS) if "metal" in root.value else {}
        own = metal.section(targets, *_apple(description))
        made["metal"] = Value({**stated, **own}, key)
    else:
        made |= {name: Value(entries, key) for name, entries in vulkan.description(targets, lazily_allocated(description)).items()}
    return tree(made, root.span)


def lazily_allocated(description: Description) -> bool | None:
    """Whether the device has a lazily allocated memory type, which is what the engine asks; None where the description does not say."""
    device = description.device
    types: tuple[tuple[str, ...], ...] | None = None
    if isinstance(device, Device):
        types = device.memoryTypes
    elif device is not None:
        profile = builtin(device)
        if profile is not None and (not profile.minimum or _lazy(profile.memory_types or ())):
            types = profile.memory_types
    return None if types is None else _lazy(types)


def _lazy(types: tuple[tuple[str, ...], ...]) -> bool:
    return any("LAZILY_ALLOCATED" in flags for flags in types)


def _apple(description: Description) -> tuple[bool | None, bool | None]:
    """Whether the GPU has memoryless textures (MTLGPUFamily apple2 and later), and whether it is Apple's; None where that is not said.

    The profiles of Apple's GPUs are all of later families.
    """
    family = description.metal.family if description.metal is not None else None
    if family is None:
        device = description.device
        profile = builtin(device) if isinstance(device, str) else None
        return (True, True) if profile is not None and profile.vendor == "apple" else (None, None)
    if family.startswith("apple"):
        return family != "apple1", True
    # A Mac of Apple's silicon is of a family of Macs as well.
    return None, None
