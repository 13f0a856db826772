"""Expands `renderTargets` to the Vulkan sections or the `metal` section that the engine creates
from them.
"""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.models import Description, Device
from msaa_lint.frame.devices import builtin
from msaa_lint.frame.devices.offer import lazily_allocated as has_lazily_allocated

from . import metal, vulkan
from .target import Target, Value, sections, tree

PASSTHROUGH_SECTIONS = ("frame", "device", "enabled", "scene", "sampleCountChoices")
"""Sections that are allowed beside `renderTargets` and are kept unchanged."""

METAL_MEMBERS = ("family", "supportedSampleCounts")
"""Members of `metal` that are allowed beside `renderTargets`; they describe the device."""


MAX_TARGETS = 256
"""Maximum number of render targets in a description; each expands to about 200 nodes."""


def check(binder: Binder, description: Description) -> None:
    """Reports render targets that the engine does not support, and sections that are not allowed
    beside `renderTargets`.
    """
    targets = description.renderTargets
    if len(targets) > MAX_TARGETS:
        record = list(targets.values())[MAX_TARGETS]
        binder.report(
            "MSAA903", f"at most {MAX_TARGETS} render targets are allowed", record.head, record.path
        )
    apis = {record.api for record in targets.values() if record.api is not None}
    for section in description.spelled:
        if section not in (*PASSTHROUGH_SECTIONS, "renderTargets") and not (
            section == "metal" and apis <= {"metal"}
        ):
            message = (
                f"`{section}` is not allowed beside `renderTargets`, which define the whole frame"
            )
            help = "run `msaa-lint convert` to expand the render targets, then edit the result"
            binder.report("MSAA903", message, description.spelled[section][0].span, section, help)
    if "metal" in description.spelled:
        for name, key in description.spelled["metal"][1].keys.items():
            if name not in METAL_MEMBERS:
                message = (
                    f"`metal.{name}` is not allowed beside `renderTargets`; only "
                    f"{' and '.join(METAL_MEMBERS)} are"
                )
                binder.report("MSAA903", message, key.span, f"metal.{name}")
    first = next((record for record in targets.values() if record.api is not None), None)
    for record in targets.values():
        if record.api is None and not record.states("api"):
            binder.report(
                "MSAA903",
                f"`{record.key}` must have an `api`: vulkan or metal",
                record.head,
                record.path,
            )
        elif first is not None and record.api not in (None, first.api):
            message = (
                f"all render targets must have the same `api`, but `{first.key}` has {first.api}"
            )
            binder.report("MSAA903", message, record.place("api"), f"{record.path}.api")
        if (
            record.api == "vulkan"
            and record.colorFormat is not None
            and record.colorFormat.startswith("kB10G10R10")
        ):
            message = (
                f"`{record.colorFormat}` requires Metal: the engine has no extended-range "
                "formats on Vulkan"
            )
            binder.report(
                "MSAA903", message, record.place("colorFormat"), f"{record.path}.colorFormat"
            )
        if record.depthFormat == "kS8UInt" and record.enableStencil is False:
            message = "`kS8UInt` has only stencil, but `enableStencil` is false"
            binder.report(
                "MSAA903", message, record.place("enableStencil"), f"{record.path}.enableStencil"
            )


def expand(description: Description) -> Node:
    """The expanded tree of a valid description. Each node has the place that determines it."""
    root = description.node
    key = description.spelled["renderTargets"][0].span
    targets = [
        Target(name, record, description.frame)
        for name, record in description.renderTargets.items()
    ]
    result: dict[str, object] = {**sections(root, PASSTHROUGH_SECTIONS)}
    if any(record.api == "metal" for record in description.renderTargets.values()):
        device_members = (
            sections(root.value["metal"], METAL_MEMBERS) if "metal" in root.value else {}
        )
        expanded_members = metal.section(targets, *_apple(description))
        result["metal"] = Value({**device_members, **expanded_members}, key)
    else:
        result |= {
            name: Value(entries, key)
            for name, entries in vulkan.description(targets, lazily_allocated(description)).items()
        }
    return tree(result, root.span)


def lazily_allocated(description: Description) -> bool | None:
    """Whether the device has a lazily allocated memory type, which the engine queries; None if the
    description does not say.
    """
    device = description.device
    if isinstance(device, Device):
        types = device.memoryTypes
        return None if types is None else any("LAZILY_ALLOCATED" in flags for flags in types)
    profile = builtin(device) if device is not None else None
    return has_lazily_allocated(profile) if profile is not None else None


def _apple(description: Description) -> tuple[bool | None, bool | None]:
    """Whether the GPU supports memoryless textures (MTLGPUFamily apple2 and later), and whether it
    is an Apple GPU; None if unknown.

    All built-in profiles of Apple GPUs are of later families.
    """
    family = description.metal.family if description.metal is not None else None
    if family is None:
        device = description.device
        profile = builtin(device) if isinstance(device, str) else None
        return (True, True) if profile is not None and profile.vendor == "apple" else (None, None)
    if family.startswith("apple"):
        return family != "apple1", True
    # A Mac with Apple silicon also belongs to a Mac family.
    return None, None
