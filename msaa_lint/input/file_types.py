"""File name endings of inputs. Nothing of a reader is imported for them."""

from typing import NamedTuple

from msaa_lint.core.extras import needs_extra

STDIN = "-"
"""The path of standard input."""

HEAD_BYTES = 64 << 10
"""The bytes at the beginning of a file from which its format is detected."""

INPUT, NEAR, BINARY, OTHER = "input", "near", "binary", "other"
"""What a file in a folder is: an input; a file with the structure of a description, but without
what only a frame has; a binary capture, which is only converted if it is named; any other file.
"""

DESCRIPTIONS = (".msaa.yaml", ".msaa.yml", ".msaa.json")
"""Inputs by their name."""

DATA = (".yaml", ".yml", ".json", ".jsonl", ".xml", ".foz")
"""Inputs if their content shows a frame; never source code."""

COMPRESSED = (".gz", ".xz", ".zst", ".bz2")
"""Endings of compressed files; only captures may be compressed."""

CAPTURES = (
    ".gfxr",
    ".rdc",
    *(data + ending for data in (".json", ".jsonl", ".xml", ".foz") for ending in COMPRESSED),
)
"""Inputs or, if binary, noted if their content is a capture."""

LANGUAGES: dict[str, tuple[str, ...]] = {
    "c": (".c", ".h"),
    "cpp": (
        ".cc", ".cpp", ".cxx", ".c++", ".hpp", ".hh", ".hxx", ".h++", ".inl", ".ipp", ".tpp",
        ".txx", ".tcc", ".ixx", ".cppm", ".cxxm",
        ".ccm", ".mpp", ".cu", ".cuh",
    ),
    "objc": (".m",),
    "objcpp": (".mm",),
    "swift": (".swift",),
    "rust": (".rs",),
    "glsl": (".glsl", ".vert", ".frag", ".comp", ".tesc", ".tese", ".geom", ".mesh", ".task"),
    "markdown": (".md", ".markdown", ".mdx"),
    "asciidoc": (".adoc", ".asciidoc", ".asc"),
    "rst": (".rst",),
}  # fmt: skip
"""The endings of source code by language, as `--input-format` names it."""

PAGES = ("markdown", "asciidoc", "rst")
"""The formats of pages, whose code blocks are read."""

SOURCES = tuple(
    ending for language, endings in LANGUAGES.items() if language not in PAGES for ending in endings
)
"""Source code: inputs of a folder if they mention multisampling. Pages are linted only if they are
named.
"""

PAGE_ENDINGS = tuple(ending for language in PAGES for ending in LANGUAGES[language])


class Compression(NamedTuple):
    """A format of compressed data: how it begins, its name, and the command that decompresses
    it.
    """

    magic: bytes
    name: str
    command: str


COMPRESSIONS = (
    Compression(b"\x1f\x8b", "gzip", "gzip -d"),
    Compression(b"\xfd7zXZ\0", "xz", "xz -d"),
    Compression(b"BZh", "bzip2", "bzip2 -d"),
    Compression(b"\x28\xb5\x2f\xfd", "zstd", "zstd -d"),
    # Frames of metadata have one of 16 numbers; pzstd writes one first.
    *(
        Compression(bytes((0x50 + number, 0x2A, 0x4D, 0x18)), "zstd", "zstd -d")
        for number in range(16)
    ),
)


def compression_of(head: bytes) -> Compression | None:
    """The format of compressed data, from its first bytes; None for anything else."""
    return next(
        (compression for compression in COMPRESSIONS if head.startswith(compression.magic)), None
    )


class BinaryCapture(NamedTuple):
    """A capture that its tool's converter reads: how it begins, what it is, the name of the format
    in `readers.CAPTURES`, the converter, where that is, and how to convert the capture with it.
    """

    magic: bytes
    name: str
    format: str
    program: str
    source: str
    command: str


BINARY_CAPTURES = (
    BinaryCapture(
        b"GFXR",
        "a binary gfxreconstruct capture",
        "gfxreconstruct",
        "gfxrecon-convert",
        "in Debian's package `gfxreconstruct` and in the Vulkan SDK",
        "`gfxrecon-convert --format jsonl FILE.gfxr`, or `gfxrecon-convert FILE.gfxr` for version "
        "0.9",
    ),
    BinaryCapture(
        b"RDOC",
        "a binary RenderDoc capture",
        "renderdoc",
        "renderdoccmd",
        "in Debian's package `renderdoc` and at renderdoc.org",
        "`renderdoccmd convert -f FILE.rdc -o FILE.xml -c xml`",
    ),
)


def binary_capture(head: bytes) -> BinaryCapture | None:
    """The kind of a binary capture, from its first bytes; None for any other file."""
    return next((kind for kind in BINARY_CAPTURES if head.startswith(kind.magic)), None)


def missing_extra() -> str:
    """The message that source code cannot be read without the extra `source`."""
    return needs_extra("reading source code", "source")
