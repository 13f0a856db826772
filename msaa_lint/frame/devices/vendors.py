"""GPU vendors by their PCI or Khronos id."""

from __future__ import annotations

VENDORS = {
    0x1002: "amd",
    0x1010: "img",
    0x106B: "apple",
    0x10DE: "nvidia",
    0x13B5: "arm",
    0x144D: "samsung",
    0x14E4: "broadcom",
    0x19E5: "huawei",
    0x5143: "qualcomm",
    0x8086: "intel",
    0x10005: "mesa",
}
"""VkPhysicalDeviceProperties::vendorID, and the name that a description has for the vendor."""

TILERS = ("apple", "arm", "broadcom", "huawei", "img", "qualcomm", "samsung")
"""Vendors of mobile GPUs, whose devices the shares count as tile-based, Samsung's four of 191 among
them.
"""


_NOT_TILERS = ("amd", "nvidia", "intel", "samsung")
"""Samsung's Xclipse is AMD's RDNA, and none of its four reports at gpuinfo.org has lazily allocated
memory: it counts as AMD's other GPUs. Neither vendor states that it renders at once, which is
therefore likely, not certain.
"""


def is_tiler(vendor: str | None) -> bool | None:
    """Whether a vendor's GPUs are tile-based; unknown for Mesa's own, which vary."""
    if vendor in _NOT_TILERS:
        return False
    return True if vendor in TILERS else None


_ONE_PLANE = ("arm", "img", "qualcomm")
"""Vendors whose GPUs keep D24_UNORM_S8_UINT in one plane, by Mesa's drivers: `panvk_plane_index`,
`pvr_format_table`, `tu6_plane_count`. D32_SFLOAT_S8_UINT has two planes there.
"""


def packs_depth_stencil(vendor: str | None) -> bool:
    """Whether a vendor's GPUs are known to move depth and stencil of D24_UNORM_S8_UINT together."""
    return vendor in _ONE_PLANE


def vendor_of(vendor_id: int) -> str | None:
    """The vendor's name in a description; None where it has none."""
    return VENDORS.get(vendor_id)
