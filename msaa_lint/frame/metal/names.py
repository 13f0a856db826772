"""Metal's enumerants in Swift's spelling; `.store`, `MTLStoreAction.store` and Objective-C's
`MTLStoreActionStore` are the same.

From Apple's documentation of MTLPixelFormat, MTLTextureType, MTLTextureUsage, MTLStorageMode,
MTLLoadAction, MTLStoreAction, MTLMultisampleDepthResolveFilter, MTLMultisampleStencilResolveFilter
and MTLGPUFamily.
"""

from __future__ import annotations

import re
from functools import lru_cache

from msaa_lint.core.suggestions import nearest

from .formats import PIXEL_FORMATS

_FAMILIES = {
    "apple": range(1, 11),
    "mac": range(1, 3),
    "macCatalyst": range(1, 3),
    "common": range(1, 4),
    "metal": range(3, 5),
}

ENUMS: dict[str, tuple[str, ...]] = {
    "MTLPixelFormat": tuple(PIXEL_FORMATS),
    "MTLTextureType": (
        "type1D",
        "type1DArray",
        "type2D",
        "type2DArray",
        "type2DMultisample",
        "typeCube",
        "typeCubeArray",
        "type3D",
        "type2DMultisampleArray",
        "typeTextureBuffer",
    ),
    "MTLTextureUsage": (
        "unknown",
        "shaderRead",
        "shaderWrite",
        "renderTarget",
        "pixelFormatView",
        "shaderAtomic",
    ),
    "MTLStorageMode": ("shared", "managed", "private", "memoryless"),
    "MTLLoadAction": ("dontCare", "load", "clear"),
    "MTLStoreAction": (
        "dontCare",
        "store",
        "multisampleResolve",
        "storeAndMultisampleResolve",
        "unknown",
        "customSampleDepthStore",
    ),
    "MTLMultisampleDepthResolveFilter": ("sample0", "min", "max"),
    "MTLMultisampleStencilResolveFilter": ("sample0", "depthResolvedSample"),
    "MTLGPUFamily": tuple(
        f"{family}{number}" for family, numbers in _FAMILIES.items() for number in numbers
    ),
}
"""The enumerants of each enum. In an option set, those without bits (`unknown`) come first."""

MULTISAMPLE_TYPES = frozenset({"type2DMultisample", "type2DMultisampleArray"})
"""The texture types with more than one sample per texel; all others have one."""

MULTISAMPLE_RESOLVES = frozenset({"multisampleResolve", "storeAndMultisampleResolve"})
"""The store actions that resolve. The first leaves the samples undefined."""

KEEPING = frozenset({"store", "storeAndMultisampleResolve", "customSampleDepthStore"})
"""The store actions that keep the samples."""

_CHANNELS = re.compile(r"(?:[rgbaex]+\d+)+|(?:gbgr|bgrg|rgba?)(?=\d|$)")
_UPPER = {
    "srgb": "sRGB",
    "xr": "XR",
    "stencil8": "Stencil8",
    "ldr": "LDR",
    "hdr": "HDR",
    "rgba": "RGBA",
    "rgb": "RGB",
}


def parse(enum: str, text: str) -> str | None:
    """The Swift name of an enumerant in any of its spellings; None if `enum` does not have it.
    Names are case-sensitive.
    """
    return _spellings(enum).get(text)


def parse_options(enum: str, text: str) -> list[str]:
    """The Swift names in `A | B`, each once, in their order. Raises ValueError with the unknown
    part as its text.
    """
    found: dict[str, None] = {}
    for part in text.split("|"):
        name = parse(enum, part.strip())
        if name is None:
            raise ValueError(part.strip())
        found[name] = None
    return list(found)


def nearest_to(enum: str, text: str) -> str | None:
    """The Swift name that was most likely meant by a word that `enum` does not have; None if none
    is near.
    """
    word = text.removeprefix(enum).lstrip(".")
    # Vulkan's names are too different to be found as typos.
    return _OTHERS.get((enum, word.lower())) or nearest(word, ENUMS[enum])


_OTHERS = {
    ("MTLStoreAction", "dont_care"): "dontCare",
    ("MTLStoreAction", "resolve"): "multisampleResolve",
    ("MTLStoreAction", "storeandresolve"): "storeAndMultisampleResolve",
    ("MTLMultisampleDepthResolveFilter", "sample_zero"): "sample0",
    ("MTLMultisampleStencilResolveFilter", "sample_zero"): "sample0",
    ("MTLTextureUsage", "sampled"): "shaderRead",
    ("MTLTextureUsage", "color_attachment"): "renderTarget",
    ("MTLTextureUsage", "depth_stencil_attachment"): "renderTarget",
    ("MTLTextureType", "2d"): "type2D",
    ("MTLTextureType", "2dmultisample"): "type2DMultisample",
}


def spelled(enum: str, name: str, like: str) -> str:
    """An enumerant spelled like another one: with a leading `.`, with the type's name, as in
    Objective-C, or bare.
    """
    if like.startswith("."):
        return f".{name}"
    match = re.match(r"MTL[A-Za-z]+\.", like)
    if match is not None:
        return f"{enum}.{name}"
    return objective_c(enum, name) if like.startswith("MTL") else name


def objective_c(enum: str, name: str) -> str:
    """The Objective-C name of an enumerant: `MTLPixelFormatBGRA8Unorm_sRGB` for
    `bgra8Unorm_srgb`.
    """
    if enum == "MTLTextureType":
        return f"{enum}{name.removeprefix('type')}"
    if enum != "MTLPixelFormat":
        return f"{enum}{name[0].upper()}{name[1:]}"
    first, *others = name.split("_")
    channels = _CHANNELS.match(first)
    if channels is not None:
        first = first[: channels.end()].upper() + first[channels.end() :]
    elif first in ("pvrtc", "eac", "etc2", "astc") or re.fullmatch(r"bc\dH?", first):
        first = first.upper()
    else:
        first = first[0].upper() + first[1:]
    return enum + "_".join([first, *(_UPPER.get(part) or _block_part(part) for part in others)])


def _block_part(part: str) -> str:
    """A part of a compressed format's name: `RGBAUnorm` for `rgbaUnorm`, `2BPP` for `2bpp`, `4x4`
    unchanged.
    """
    match = re.match(r"rgba|rgb|rg|r(?=\d|[A-Z])", part)
    if match is not None:
        return part[: match.end()].upper() + part[match.end() :].replace("a1", "A1")
    return part.upper() if part.endswith("bpp") else part


@lru_cache(maxsize=16)
def _spellings(enum: str) -> dict[str, str]:
    return {
        text: name
        for name in ENUMS[enum]
        for text in (name, f".{name}", f"{enum}.{name}", objective_c(enum, name))
    }


def spellings(enum: str) -> list[str]:
    """Every spelling of every enumerant of an enum."""
    return list(_spellings(enum))
