"""Finds out whether source code mentions multisampling, by its words, when a folder is searched for
inputs.
"""

from __future__ import annotations

import re

from msaa_lint.core.text.files import open_entry

from .languages import unread

MAX_BYTES = 1 << 20
"""The number of bytes of a file that are searched."""

Words = tuple[tuple[str, str], ...]
"""Words, and the patterns of those that only count in some contexts: to search a text for a word
takes far less time than for a pattern.
"""

_API: Words = (
    ("AttachmentDescription", ""), ("AttachmentInfo", ""), ("ImageCreateInfo", ""),
    ("RenderPassCreateInfo", ""),
    ("MultisampleStateCreateInfo", ""), ("ResolveImage", ""), ("SampleCounts", ""),
    ("MTLRenderPass", ""), ("MTLTexture", ""),
    ("MTLRenderPipeline", ""), ("asterSampleCount", ""), ("TextureSampleCount", ""), ("2DMS", ""),
    ("subpassInputMS", ""),
    ("gl_Sample", ""), ("gl_NumSamples", ""), ("renderpass!", ""), ("sample_counts", ""),
)  # fmt: skip
"""Structures, functions, and types that the rules check, from Vulkan, vulkan.hpp, vulkano, Metal,
and GLSL.
"""

_MULTISAMPLING: Words = (
    ("msaa", ""), ("multi", "multi[-_ ]?sampl(?!e_?state|ing_?state)"), ("2dms", ""),
    ("subpassinputms", ""), ("gl_sample", ""),
    ("gl_numsamples", ""), ("sample", r"sample_?counts?(?!(?:flagbits)?(?:::e1\b|_1_bit))"),
    ("samples", "num_?samples"),
    ("samples", "raster_?samples"), ("resolve", "resolve_?image"),
)  # fmt: skip
"""Words about multisampling, in lower case, except for the state that every pipeline has and the
one sample that every image states.
"""

_COUNT: Words = (
    ("SAMPLE_COUNT_", "SAMPLE_COUNT_(?:2|4|8|16|32|64)_BIT"),
    ("SampleCountFlagBits", r"SampleCountFlagBits::e(?:2|4|8|16|32|64)\b"), ("SampleCount::Sample",
    r"SampleCount::Sample[2-8]"),
)  # fmt: skip
"""A sample count above one."""

_STATED: Words = (
    ("SAMPLE_COUNT_", ""), ("SampleCountFlag", ""), ("SampleCount::", ""),
    ("IMAGE_USAGE_", ""), ("ImageUsageFlag", ""), ("ATTACHMENT_LOAD_OP_", ""),
    ("ATTACHMENT_STORE_OP_", ""), ("AttachmentLoadOp", ""), ("AttachmentStoreOp", ""),
    ("MTLLoadAction", ""), ("MTLStoreAction", ""),
)  # fmt: skip
"""Counts, flags, and operations, which a program may state in one file and use in another."""

_RELATED: Words = (
    ("VK_", ""), ("MTL", ""), ("sampl", ""), ("Sampl", ""), ("SAMPL", ""), ("msaa", ""), ("Msaa",
    ""), ("MSAA", ""), ("multis", ""),
    ("multiS", ""), ("Multis", ""), ("MultiS", ""), ("MULTIS", ""), ("vk::", r"\bvk::"), ("Vk",
    r"\bVk[A-Z]"),
)  # fmt: skip
"""What a file has that can matter to another one that uses multisampling."""

_API_FILE = re.compile(
    r"vulkan(?:_core|_beta|_structs|_raii|_handles|_enums|_funcs|_hash|_to_string|_shared|_video|_format_traits|_static_assertions"
    r"|_extension_inspection|_hpp_macros)?\.(?:h|hpp|cppm)|vk_(?:platform|layer|icd|mem_alloc|enum_string_helper)\.h|volk\.[ch]"
)
"""The names of files of Vulkan itself and of its allocator, whose definitions are known."""


def has(text: str, words: Words) -> bool:
    """Returns whether a text has one of some words."""
    return any(
        word in text and (not pattern or re.search(pattern, text) is not None)
        for word, pattern in words
    )


def is_related(text: str) -> bool:
    """Returns whether a file can matter to others that use multisampling."""
    return has(text, _RELATED)


def mentions_api(text: str) -> bool:
    """Returns whether a text mentions an API that the rules check."""
    return has(text, _API)


def may_have_findings(text: str) -> bool:
    """Returns whether a text states what rules check in a program, such as a usage that it passes
    to a function of another file.
    """
    return mentions_api(text) or has(text, _STATED)


def mentions_multisampling(text: str) -> bool:
    """Returns whether a text mentions multisampling."""
    return has(text.lower(), _MULTISAMPLING) or has(text, _COUNT)


def speaks(text: str) -> bool:
    """Returns whether a text mentions both an API that the rules check and multisampling."""
    return mentions_api(text) and has(text.lower(), _MULTISAMPLING)


def is_api(path: str) -> bool:
    """Returns whether a file is one of Vulkan itself or of its allocator, by its name."""
    return _API_FILE.fullmatch(path.rpartition("/")[2]) is not None


def file_speaks(path: str) -> bool:
    """Returns whether the first MiB of a file does, and is in a language that is read. Raises
    OSError if it cannot be read.
    """
    if is_api(path):
        return False
    with open_entry(path) as file:
        data = file.read(MAX_BYTES)
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "latin-1"
    text = data.decode(encoding, "replace")
    return speaks(text) and unread(path, text) is None
