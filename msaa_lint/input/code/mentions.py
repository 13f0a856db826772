"""Whether source code has to do with multisampling, told by its words: what a folder is searched for."""

from __future__ import annotations

import re

MOST = 1 << 20
"""So much of a file is looked at, in bytes."""

_API = re.compile(
    r"AttachmentDescription|AttachmentInfo|ImageCreateInfo|RenderPassCreateInfo|MultisampleStateCreateInfo|ResolveImage|SampleCounts"
    r"|MTLRenderPass|MTLTexture|MTLRenderPipeline|[rR]asterSampleCount|TextureSampleCount|2DMS|subpassInputMS|gl_(?:Sample|NumSamples)"
)
"""Structures, functions and types whose states the rules judge: Vulkan's, vulkan.hpp's, Metal's, GLSL's."""

_MULTISAMPLING = re.compile(
    r"msaa|multi[-_ ]?sampl(?!e_?state|ing_?state)|sample_?counts?(?!(?:flagbits)?(?:::e1\b|_1_bit))|(?:num|raster)_?samples|resolve_?image"
    r"|2DMS|subpassInputMS|gl_(?:sample|numsamples)",
    re.IGNORECASE,
)
"""Multisampling as such: not the state that every pipeline has, nor the one sample that every image states."""


def speaks(text: str) -> bool:
    """Whether a text names what the rules judge, and multisampling."""
    return _API.search(text) is not None and _MULTISAMPLING.search(text) is not None


def file_speaks(path: str) -> bool:
    """Whether the first MiB of a file does. OSError where it cannot be read."""
    with open(path, "rb") as file:
        data = file.read(MOST)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1"
    return speaks(data.decode(encoding, "replace"))
