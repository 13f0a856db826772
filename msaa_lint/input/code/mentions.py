"""Finds out whether source code mentions multisampling, by its words, when a folder is searched for inputs."""

from __future__ import annotations

import re

from msaa_lint.core.text.files import open_entry

from .languages import unread

MAX_BYTES = 1 << 20
"""The number of bytes of a file that are searched."""

_API = re.compile(
    r"AttachmentDescription|AttachmentInfo|ImageCreateInfo|RenderPassCreateInfo|MultisampleStateCreateInfo|ResolveImage|SampleCounts"
    r"|MTLRenderPass|MTLTexture|MTLRenderPipeline|[rR]asterSampleCount|TextureSampleCount|2DMS|subpassInputMS|gl_(?:Sample|NumSamples)"
)
"""Structures, functions, and types that the rules check, from Vulkan, vulkan.hpp, Metal, and GLSL."""

_MULTISAMPLING = re.compile(
    r"msaa|multi[-_ ]?sampl(?!e_?state|ing_?state)|sample_?counts?(?!(?:flagbits)?(?:::e1\b|_1_bit))|(?:num|raster)_?samples|resolve_?image"
    r"|2DMS|subpassInputMS|gl_(?:sample|numsamples)",
    re.IGNORECASE,
)
"""Words about multisampling, except for the state that every pipeline has and the one sample that every image states."""


_COUNT = re.compile(r"SAMPLE_COUNT_(?:2|4|8|16|32|64)_BIT|SampleCountFlagBits::e(?:2|4|8|16|32|64)\b")
"""A sample count above one."""


_STATED = re.compile(
    r"SAMPLE_COUNT_|SampleCountFlag|IMAGE_USAGE_|ImageUsageFlag|ATTACHMENT_(?:LOAD|STORE)_OP_|Attachment(?:Load|Store)Op|MTL(?:Load|Store)Action"
)
"""Counts, flags, and operations, which a program may state in one file and use in another."""


def mentions_api(text: str) -> bool:
    """Returns whether a text mentions an API that the rules check."""
    return _API.search(text) is not None


def may_have_findings(text: str) -> bool:
    """Returns whether a text states what rules check in a program, such as a usage that it passes to a function of another file."""
    return mentions_api(text) or _STATED.search(text) is not None


def mentions_multisampling(text: str) -> bool:
    """Returns whether a text mentions multisampling."""
    return _MULTISAMPLING.search(text) is not None or _COUNT.search(text) is not None


def speaks(text: str) -> bool:
    """Returns whether a text mentions both an API that the rules check and multisampling."""
    return _API.search(text) is not None and _MULTISAMPLING.search(text) is not None


def file_speaks(path: str) -> bool:
    """Returns whether the first MiB of a file does, and is in a language that is read. Raises OSError if it cannot be read."""
    with open_entry(path) as file:
        data = file.read(MAX_BYTES)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1"
    text = data.decode(encoding, "replace")
    return speaks(text) and unread(path, text) is None
