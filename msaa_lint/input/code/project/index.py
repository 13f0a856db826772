"""What the words of a source file say about the other files of its project: what it includes, what it declares, whether it is a program.

Files are searched by words, without being parsed, so that the files of a large project take little time.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from msaa_lint.input.code import mentions

MAX_BYTES = 4 << 20
"""The number of bytes of a file that are searched, which is the maximum length of a source file."""

HEADERS = (".h", ".hpp", ".hh", ".hxx", ".h++", ".inl", ".ipp", ".tpp", ".inc")
"""The endings of files that sources include."""

SOURCES = (".cpp", ".c", ".cc", ".cxx", ".mm", ".m")
"""The endings of files that define what headers declare."""

_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*(?:include|import)[ \t]*[<"]([^>"\r\n]{1,400})[>"]', re.MULTILINE)

_MAIN = re.compile(
    rb"^[ \t]*(?:extern[ \t]+\"C\"[ \t]+)?(?:(?:int|auto|sapp_desc|SDL_AppResult)\s+(?:[A-Z_a-z]\w*[ \t]+){0,2}"
    rb"(?:_?main_?|w?WinMain|_tmain|wmain|SDL_main|SDL_AppInit|sokol_main)|void\s+android_main)[ \t]*\((?![^()]{0,400}\)[ \t]*;)"
    rb"|^[A-Z][A-Z0-9_]*_MAIN[A-Z_]*[ \t]*\(",
    re.MULTILINE,
)
"""Where a program starts, also by the macro of a framework."""

_CLASS = re.compile(
    rb"\b(?:class|struct|@interface|@implementation)[ \t]+(?:[A-Z_0-9]+[ \t]+)?([A-Za-z_]\w*)(?=[ \t]*(?:final\b|:|\{|\r?$))", re.MULTILINE
)
_FUNCTION = re.compile(rb"^[A-Za-z_][\w \t*&:<>,]{0,200}?[ \t*&]([A-Za-z_]\w*)(?:::~?\w+)?[ \t]*\(", re.MULTILINE)
"""A function that is declared or defined at the left margin; of a method, its class."""

_API = re.compile(
    r"vulkan(?:_core|_beta|_structs|_raii|_handles|_enums|_funcs|_hash|_to_string|_shared|_video|_format_traits|_static_assertions"
    r"|_extension_inspection|_hpp_macros)?\.(?:h|hpp|cppm)|vk_(?:platform|layer|icd|mem_alloc|enum_string_helper)\.h|volk\.[ch]"
)
"""The names of files of Vulkan itself and of its allocator, whose definitions are known."""

_RELATED = re.compile(rb"VK_|\bVk[A-Z]|\bvk::|MTL|[sS]ampl|SAMPL|[mM]saa|MSAA|[mM]ulti[sS]|MULTIS")
"""What a file has that can matter to another one that uses multisampling."""


class Words(NamedTuple):
    """The words of a file. `names` are the classes and functions that it declares or defines; `is_related` says whether it can matter to
    files that use multisampling, `has_api` and `has_multisampling` what it mentions itself."""

    includes: tuple[str, ...]
    names: frozenset[str]
    has_main: bool
    is_related: bool
    has_api: bool
    has_multisampling: bool


def words(name: str, data: bytes) -> Words:
    """Returns the words of a file, in time linear in its length."""
    data = data[:MAX_BYTES]
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        data = data.decode("utf-16", "replace").encode()
    includes = dict.fromkeys(name.decode("utf-8", "replace").replace("\\", "/") for name in _INCLUDE.findall(data))
    names = {name.decode() for pattern in (_CLASS, _FUNCTION) for name in pattern.findall(data)}
    related = _API.fullmatch(name.rpartition("/")[2]) is None and _RELATED.search(data) is not None
    text = data[: mentions.MAX_BYTES].decode("latin-1") if related else ""
    return Words(
        tuple(includes),
        frozenset(names),
        _MAIN.search(data) is not None,
        related,
        related and mentions.mentions_api(text),
        related and mentions.mentions_multisampling(text),
    )


def is_header(name: str) -> bool:
    """Returns whether a file is one that sources include, by its name."""
    return name.lower().endswith(HEADERS)
