"""Tells languages apart that share an ending, and names those that are not read."""

import re

MODULES = {
    **dict.fromkeys(("c", "cpp"), "c.description_trees"),
    **dict.fromkeys(("objc", "objcpp"), "objc.description_trees"),
    "swift": "swift.description_trees",
    "rust": "rust.description_trees",
    "glsl": "glsl.description_trees",
}
"""The module of `input.code` that reads each language."""

GRAMMARS = {
    "c": "tree_sitter_c",
    # Objective-C is rewritten as C++.
    **dict.fromkeys(("cpp", "objc", "objcpp"), "tree_sitter_cpp"),
    "swift": "tree_sitter_swift",
    "rust": "tree_sitter_rust",
    "glsl": "tree_sitter_glsl",
}
"""The package of each language's grammar."""

UNREAD = {
    ".go": "Go",
    ".zig": "Zig",
    ".cs": "C#",
    ".java": "Java",
    ".kt": "Kotlin",
    ".py": "Python",
    ".js": "JavaScript",
    ".ts": "TypeScript",
    ".hlsl": "HLSL",
    ".slang": "Slang",
    ".wgsl": "WGSL",
    ".metal": "Metal's shading language",
}
"""Extensions of languages that are used for graphics but are not supported."""

_CPP = re.compile(
    r"::|\b(?:class|namespace|template|constexpr|nullptr|public|private)\b|^[ \t]*using[ \t]",
    re.MULTILINE,
)
"""Matches C++ that a C header does not contain."""

_OBJC = re.compile(
    r"^[ \t]*(?:#[ "
    r"\t]*import\b|@(?:interface|implementation|protocol|class|import|end|property|autoreleasepool)\b)",
    re.MULTILINE,
)

_OBJC_WORD = re.compile(r"@(?:class|public|private)\b")
"""Words of Objective-C that are words of C++ without the `@`."""

_NOT_OBJC = (
    ("Mathematica", re.compile(r"\A\s*\(\*|^\s*(?:BeginPackage|Needs|Get)\[", re.MULTILINE)),
    ("Mercury", re.compile(r"^:-\s*(?:module|interface)\b", re.MULTILINE)),
    (
        "MATLAB",
        re.compile(
            r"\A\s*%|^[ \t]*(?:function\b|classdef\b|end(?:function|if|for)?[ \t]*;?[ "
            r"\t]*(?:%.*)?$|clc\b|close all\b)",
            re.MULTILINE,
        ),
    ),
)
"""The other languages with the ending `.m`, and what only they contain."""


def language_of_header(head: str) -> str:
    """Returns the language of a file with the ending `.h` by the start of its text."""
    if _OBJC.search(head) is None:
        return "cpp" if _CPP.search(head) is not None else "c"
    return "objcpp" if _CPP.search(_OBJC_WORD.sub("", head)) is not None else "objc"


def unread(name: str, head: str) -> str | None:
    """Returns the unsupported language of a file by its extension and, where several share it, the
    start of its text, or None.
    """
    base, dot, ending = name.rpartition("/")[2].rpartition(".")
    if not (base and dot):
        return None
    if ending.lower() != "m":
        return UNREAD.get(f".{ending.lower()}")
    return (
        None
        if _OBJC.search(head)
        else next((language for language, pattern in _NOT_OBJC if pattern.search(head)), None)
    )
