"""Maps Impeller's enumerants to Vulkan's and Metal's.

From the engine's `formats_vk.h`, `formats_mtl.h` and `formats_mtl.mm` (impeller/renderer/backend,
flutter/flutter).
"""

from __future__ import annotations

VULKAN_FORMATS = {
    "kR8UNormInt": "R8_UNORM",
    "kR8G8UNormInt": "R8G8_UNORM",
    "kR8G8B8A8UNormInt": "R8G8B8A8_UNORM",
    "kR8G8B8A8UNormIntSRGB": "R8G8B8A8_SRGB",
    "kB8G8R8A8UNormInt": "B8G8R8A8_UNORM",
    "kB8G8R8A8UNormIntSRGB": "B8G8R8A8_SRGB",
    "kR32G32B32A32Float": "R32G32B32A32_SFLOAT",
    "kR16G16B16A16Float": "R16G16B16A16_SFLOAT",
    "kS8UInt": "S8_UINT",
    "kD24UnormS8Uint": "D24_UNORM_S8_UINT",
    "kD32FloatS8UInt": "D32_SFLOAT_S8_UINT",
}
"""`ToVKImageFormat`. Extended-range formats exist only on Metal, and `kA8UNormInt` has mapped to
different formats over time.
"""

METAL_FORMATS = {
    "kA8UNormInt": "a8Unorm",
    "kR8UNormInt": "r8Unorm",
    "kR8G8UNormInt": "rg8Unorm",
    "kR8G8B8A8UNormInt": "rgba8Unorm",
    "kR8G8B8A8UNormIntSRGB": "rgba8Unorm_srgb",
    "kB8G8R8A8UNormInt": "bgra8Unorm",
    "kB8G8R8A8UNormIntSRGB": "bgra8Unorm_srgb",
    "kR32G32B32A32Float": "rgba32Float",
    "kR16G16B16A16Float": "rgba16Float",
    "kB10G10R10XR": "bgr10_xr",
    "kB10G10R10XRSRGB": "bgr10_xr_srgb",
    "kB10G10R10A10XR": "bgra10_xr",
    "kS8UInt": "stencil8",
    "kD24UnormS8Uint": "depth24Unorm_stencil8",
    "kD32FloatS8UInt": "depth32Float_stencil8",
}
"""`ToMTLPixelFormat`, with Swift names."""

DEFAULT_COLOR = {"vulkan": "kR8G8B8A8UNormInt", "metal": "kB8G8R8A8UNormInt"}
"""`Capabilities::GetDefaultColorFormat`; on Vulkan a surface may request another."""

DEFAULT_DEPTH_STENCIL = {"vulkan": None, "metal": "kD32FloatS8UInt"}
"""`Capabilities::GetDefaultDepthStencilFormat`: on Vulkan the device's choice of `kD24UnormS8Uint`
and `kD32FloatS8UInt`.
"""

VULKAN_LOADS = {"kDontCare": "DONT_CARE", "kLoad": "LOAD", "kClear": "CLEAR"}

VULKAN_STORES = {
    "kDontCare": "DONT_CARE",
    "kStore": "STORE",
    "kMultisampleResolve": "DONT_CARE",
    "kStoreAndMultisampleResolve": "STORE",
}
"""`ToVKAttachmentStoreOp` for the multisampled texture. Both resolving actions store the resolve
texture.
"""

METAL_ACTIONS = {
    "kDontCare": "dontCare",
    "kLoad": "load",
    "kClear": "clear",
    "kStore": "store",
    "kMultisampleResolve": "multisampleResolve",
    "kStoreAndMultisampleResolve": "storeAndMultisampleResolve",
}

RESOLVES = ("kMultisampleResolve", "kStoreAndMultisampleResolve")
"""`StoreActionPerformsResolve`."""


def sample_count(word: int | str) -> int:
    """The sample count for a number, an Impeller enumerant (`kCount4`) or a short name (`k4`)."""
    return word if isinstance(word, int) else int(word.removeprefix("kCount").removeprefix("k"))
