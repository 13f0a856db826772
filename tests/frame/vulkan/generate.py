"""Writes `enums.py` and `formats_table.py` from the Vulkan registry, as PyPI's `vulkan-object` (a
development dependency) carries it.

    python -m tests.frame.vulkan.generate [--check]

`--check` writes nothing and exits with 1 where a file is stale.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from tests.paths import ROOT

HERE = str(ROOT / "msaa_lint" / "frame" / "vulkan")
COMMAND = "python -m tests.frame.vulkan.generate"

ENUMS = (
    "VkAttachmentLoadOp",
    "VkAttachmentStoreOp",
    "VkBlendFactor",
    "VkBlendOp",
    "VkCompareOp",
    "VkDynamicState",
    "VkFormat",
    "VkImageLayout",
    "VkImageTiling",
    "VkImageType",
    "VkPipelineBindPoint",
    "VkPolygonMode",
    "VkPrimitiveTopology",
    "VkSharingMode",
    "VkStencilOp",
    "VkVertexInputRate",
)

FLAG_BITS = (
    "VkAttachmentDescriptionFlagBits",
    "VkColorComponentFlagBits",
    "VkDependencyFlagBits",
    "VkFramebufferCreateFlagBits",
    "VkImageAspectFlagBits",
    "VkImageCreateFlagBits",
    "VkImageUsageFlagBits",
    "VkMemoryPropertyFlagBits",
    "VkRenderPassCreateFlagBits",
    "VkRenderingFlagBits",
    "VkResolveModeFlagBits",
    "VkSampleCountFlagBits",
    "VkShaderStageFlagBits",
    "VkSubpassDescriptionFlagBits",
)

MERGED = {
    "VkAccessFlagBits2": "VkAccessFlagBits",
    "VkPipelineStageFlagBits2": "VkPipelineStageFlagBits",
}
"""Bits of the second synchronization version, and the first version's: equal names have equal
values, so one table serves both.
"""

SHORTER = {"VkSubpassDescriptionFlagBits": {"CUSTOM_RESOLVE": "CUSTOM_RESOLVE_EXT"}}
"""Spellings that the description format has beside the registry's."""

ARM_FLOAT_BLEND = (
    "B10G11R11_UFLOAT_PACK32",
    "R16_SFLOAT",
    "R16G16_SFLOAT",
    "R16G16B16_SFLOAT",
    "R16G16B16A16_SFLOAT",
    "R32_SFLOAT",
    "R32G32_SFLOAT",
    "R32G32B32_SFLOAT",
    "R32G32B32A32_SFLOAT",
)


def prefix_of(enum: str) -> str:
    """What the full names of an enum begin with: `VK_IMAGE_LAYOUT_` for VkImageLayout,
    `VK_ACCESS_2_` for VkAccessFlagBits2.
    """
    stem = enum.removeprefix("Vk")
    second = stem.endswith("FlagBits2")
    stem = stem.removesuffix("2").removesuffix("FlagBits")
    words = "".join(f"_{c}" if c.isupper() else c for c in stem).upper()
    return f"VK{words}_" + ("2_" if second else "")


def short_name(enum: str, name: str, bits: bool) -> str:
    """The name without the type's prefix and `_BIT`: `CUSTOM_RESOLVE_EXT` of
    VK_SUBPASS_DESCRIPTION_CUSTOM_RESOLVE_BIT_EXT.
    """
    prefix = prefix_of(enum)
    if not name.startswith(prefix):
        raise ValueError(f"{name} does not begin with {prefix}")
    name = name.removeprefix(prefix)
    return "_".join(word for word in name.split("_") if word != "BIT") if bits else name


class Table:
    """One enum: canonical names with their values, other names with the canonical one, and the
    bits' names that have no `_BIT`.
    """

    def __init__(self) -> None:
        self.values: dict[str, int] = {}
        self.aliases: dict[str, str] = {}
        self.bitless: set[str] = set()

    def add(self, enum: str, fields: Iterable[Any], bits: bool) -> None:
        """Adds the registry's fields. Where a value has a name already, every name of this field is
        another name of that.
        """
        for field in fields:
            short = [short_name(enum, name, bits) for name in (field.name, *field.aliases)]
            with_bit = {
                s
                for s, name in zip(short, (field.name, *field.aliases), strict=True)
                if "_BIT" in name
            }
            self.bitless.update(name for name in short if bits and name not in with_bit)
            known = {value: name for name, value in self.values.items()}.get(field.value)
            if known is None:
                known = short[0]
                self.values[known] = field.value
            self.aliases.update((name, known) for name in short if name != known)


def tables(registry: Any) -> dict[str, Table]:
    """Every enum that is written, by its name."""
    found: dict[str, Table] = {}
    for enum in ENUMS:
        found[enum] = Table()
        found[enum].add(enum, registry.enums[enum].fields, bits=False)
    for enum in FLAG_BITS:
        found[enum] = Table()
        found[enum].add(enum, registry.bitmasks[enum].flags, bits=True)
    for second, first in MERGED.items():
        found[second] = Table()
        # The first version's names come first: TRANSFER, which both have, and not ALL_TRANSFER,
        # which one has.
        for enum in (first, second):
            found[second].add(enum, registry.bitmasks[enum].flags, bits=True)
    for enum, names in SHORTER.items():
        found[enum].aliases.update(names)
    return dict(sorted(found.items()))


def literal(name: str, items: Mapping[str, Any]) -> str:
    """A dict display with as many items on a line as go."""
    shown = [
        f'"{key}": "{value}"' if isinstance(value, str) else f'"{key}": {value}'
        for key, value in items.items()
    ]
    return f'    "{name}": {{\n' + packed(shown, "        ") + "    },\n"


def packed(items: Iterable[str], indent: str) -> str:
    """The items of a display, as many on a line as go."""
    lines = [""]
    for item in items:
        if len(indent) + len(lines[-1]) + len(item) + 2 > 100:
            lines.append("")
        lines[-1] += f" {item}," if lines[-1] else f"{item},"
    return "".join(f"{indent}{line}\n" for line in lines)


def header(registry: Any, doc: str) -> str:
    """The head of a generated module."""
    return (
        f'"""{doc}\n\nGenerated from the Vulkan registry, version '
        f'{registry.headerVersionComplete}, by `{COMMAND}`: do not edit.\n"""\n\n'
    )


def enums_source(registry: Any) -> str:
    """The text of enums.py."""
    found = tables(registry)
    prefixes = {enum: prefix_of(MERGED.get(enum, enum)) for enum in found}
    out = [header(registry, "The enumerants that a description can hold."), "# fmt: off\n"]
    out.append(
        "PREFIXES: dict[str, str] = {\n"
        + "".join(f'    "{enum}": "{p}",\n' for enum, p in prefixes.items())
        + "}\n"
    )
    out.append(
        '"""What the full names of an enum begin with; those of the second synchronization version '
        'have `2_` after it."""\n\n'
    )
    out.append(
        "VALUES: dict[str, dict[str, int]] = {\n"
        + "".join(literal(enum, t.values) for enum, t in found.items())
        + "}\n"
    )
    out.append('"""The canonical short names, with their values in the registry\'s order."""\n\n')
    out.append(
        "ALIASES: dict[str, dict[str, str]] = {\n"
        + "".join(
            literal(enum, dict(sorted(t.aliases.items()))) for enum, t in found.items() if t.aliases
        )
        + "}\n"
    )
    out.append('"""Other short names of the same values, with the canonical one."""\n\n')
    bitless = {enum: t.bitless for enum, t in found.items() if t.bitless}
    out.append("BITLESS: dict[str, frozenset[str]] = {\n")
    for enum, names in bitless.items():
        shown = ", ".join(f'"{name}"' for name in sorted(names))
        out.append(f'    "{enum}": frozenset(({shown},)),\n')
    out.append('}\n"""Names of flag bits that have no `_BIT`: of no bit, or of several."""\n\n')
    out.append("ENUMS: dict[str, dict[str, str]] = {\n")
    out.append(
        "    enum: {**dict(zip(values, values, strict=True)), **ALIASES.get(enum, {})} for enum, "
        "values in VALUES.items()\n}\n"
    )
    out.append('"""Every short spelling of an enum, with the canonical one."""\n')
    return "".join(out)


def row(form: Any) -> str:
    """A format in one string: bytes, block extent, numeric type, components with their bits, scheme
    of compression or chroma.
    """
    size, extent = form.blockSize, [int(n) for n in form.blockExtent] or [1, 1, 1]
    if form.planes:
        # The registry counts one texel of each plane; a block here is the texels that share a
        # chroma sample.
        extent = [
            max(p.widthDivisor for p in form.planes),
            max(p.heightDivisor for p in form.planes),
            1,
        ]
        plane_bytes = [_plane_bytes(form, plane.index) for plane in form.planes]
        size = sum(
            b * (extent[0] // p.widthDivisor) * (extent[1] // p.heightDivisor)
            for b, p in zip(plane_bytes, form.planes, strict=True)
        )
    parts = []
    depth_stencil = any(c.type in "DS" for c in form.components)
    for c in form.components:
        bits = c.bits if c.bits.isdigit() else "0"
        parts.append(f"{c.type}{bits}" + (f":{c.numericFormat}" if depth_stencil else ""))
    kinds = {c.numericFormat for c in form.components}
    if not depth_stencil and len(kinds) != 1:
        # An alpha channel of an sRGB format is linear, and the registry says UNORM for it.
        kinds -= {"UNORM"}
    numeric = "-" if depth_stencil else kinds.pop()
    if kinds and not depth_stencil:
        raise ValueError(f"{form.name} has several numeric types")
    scheme = form.compressed or (f"YCBCR{form.chroma}" if form.chroma else "-")
    return (
        f"{size} {'x'.join(map(str, extent))} {numeric} {','.join(parts)} "
        f"{scheme.replace(' ', '_')}"
    )


def _plane_bytes(form: Any, plane: int) -> int:
    # 10- and 12-bit components of a plane are padded to 16 bits each (`10X6`).
    bits = [int(c.bits) for c in form.components if c.planeIndex == plane]
    return sum(1 if b <= 8 else 2 for b in bits)


def formats_source(registry: Any) -> str:
    """The text of formats_table.py."""
    rows = {name.removeprefix("VK_FORMAT_"): row(form) for name, form in registry.formats.items()}
    order = tables(registry)["VkFormat"].values
    rows = {name: rows[name] for name in order if name in rows}
    out = [header(registry, "What the formats hold, a line each."), "# fmt: off\n"]
    out.append(
        "ROWS: dict[str, str] = {\n"
        + "".join(f'    "{name}": "{text}",\n' for name, text in rows.items())
        + "}\n"
    )
    out.append(
        '"""Bytes of a block, its extent, numeric type, components with their bits, compression or '
        'chroma subsampling."""\n\n'
    )
    blends = packed((f'"{name}"' for name in ARM_FLOAT_BLEND), "    ")
    out.append(f"ARM_FLOAT_BLEND: frozenset[str] = frozenset((\n{blends}))\n")
    out.append(
        '"""Float formats that Mali GPUs do not blend at full rate when multisampled (Khronos '
        'best-practices layer, Arm)."""\n'
    )
    return "".join(out)


def stale(sources: Mapping[str, str]) -> list[str]:
    """The paths whose files are not what they should be."""
    found = []
    for path, text in sources.items():
        try:
            with open(path, encoding="utf-8") as file:
                fresh = file.read() == text
        except OSError:
            fresh = False
        if not fresh:
            found.append(path)
    return found


def sources() -> dict[str, str]:
    """The texts of both modules by their paths. ImportError where vulkan-object is not
    installed.
    """
    from vulkan_object import get_vulkan_object

    registry = get_vulkan_object()
    makers: dict[str, Callable[[Any], str]] = {
        "enums.py": enums_source,
        "formats_table.py": formats_source,
    }
    return {os.path.join(HERE, name): make(registry) for name, make in makers.items()}


def main(arguments: list[str]) -> int:
    """Writes the files, or with `--check` says which are stale: the exit status."""
    made = sources()
    old = stale(made)
    if "--check" in arguments:
        for path in old:
            print(f"{path} is stale: run `{COMMAND}`", file=sys.stderr)
        return 1 if old else 0
    for path in old:
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(made[path])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
