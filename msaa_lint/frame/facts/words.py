"""What a fact is, and the words of the facts whose texts are not those of a Vulkan enum."""

from __future__ import annotations

from typing import NamedTuple

from msaa_lint.frame.description.models.frame import VENDORS


class Fact(NamedTuple):
    """A fact that rules may ask.

    `type` is BOOL, INT, DOUBLE, STRING, LIST (of text) or INTS; `enum` is the Vulkan enum, or the
    key of `WORDS`, that its texts come from.
    """

    name: str
    type: str
    doc: str
    enum: str = ""


WORDS: dict[str, tuple[str, ...]] = {
    "aspect": ("color", "depth", "stencil"),
    "pass kind": ("renderPass", "rendering"),
    "load operation": ("LOAD", "CLEAR", "DONT_CARE", "NONE", "RESUMED"),
    "store operation": ("STORE", "DONT_CARE", "NONE", "SUSPENDED"),
    "begun": ("YES", "NO", "NOT_STATED"),
    "resolve kind": ("subpass", "rendering", "command"),
    "other use": (
        "NOTHING", "RESOLVE_TARGET", "COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT",
        "INPUT_ATTACHMENT", "PRESERVED_ATTACHMENT",
    ),
    "copy command": ("copyImage", "blitImage", "copyImageToBuffer", "copyBufferToImage"),
    "encoding": ("LINEAR", "GAMMA", "DATA"),
    "scene color": ("LDR", "HDR"),
    "tone mapping": ("AFTER_RESOLVE", "IN_PASS", "NONE"),
    "depth direction": ("STANDARD", "REVERSED"),
    "wants": ("ANY", "NEAREST", "FARTHEST"),
    "fetched": ("ONE", "ALL", "NOT_STATED", "OTHER"),
    "samples read": ("ONE", "ALL", "OTHER"),
    "resolves": ("AVERAGE", "MIN", "MAX", "OTHER"),
    "api": ("VULKAN", "METAL"),
    "storage mode": ("shared", "managed", "private", "memoryless"),
    "texture type": (
        "type1D", "type1DArray", "type2D", "type2DArray", "type2DMultisample", "typeCube",
        "typeCubeArray", "type3D",
        "type2DMultisampleArray", "typeTextureBuffer",
    ),
    "texture usage": ("shaderRead", "shaderWrite", "renderTarget", "pixelFormatView",
    "shaderAtomic"),
    "load action": ("dontCare", "load", "clear"),
    "store action": ("dontCare", "store", "multisampleResolve", "storeAndMultisampleResolve",
    "unknown", "customSampleDepthStore"),
    "resolve filter": ("sample0", "min", "max", "depthResolvedSample"),
    "family": (
        *(f"apple{number}" for number in range(1, 11)), "mac1", "mac2", "macCatalyst1",
        "macCatalyst2", "common1", "common2", "common3",
        "metal3", "metal4",
    ),
    "fits": ("SAME", "DIFFERENT", "NOT_STATED"),
    "combined": ("AND", "OR", "MIN", "MAX", "LOGICAL_AND", "LOGICAL_OR", "NONE"),
    "chosen": ("MAXIMUM", "ATMOST"),
    "study": ("NONE", "JUSTIFIES", "DECLINES", "STALE", "UNUSABLE"),
    "numeric": ("UNORM", "SNORM", "USCALED", "SSCALED", "UINT", "SINT", "UFLOAT", "SFLOAT", "SRGB",
    "SFIXED5", "BOOL"),
    "vendor": VENDORS,
}  # fmt: skip
"""The texts of such facts by `Fact.enum`."""
