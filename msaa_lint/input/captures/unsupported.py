"""Captures in a form that is not read, told by their beginning, with what a person runs to have one that is."""

from __future__ import annotations

import re

_TEXT = re.compile(rb"\s*(?:Thread \d+, Frame \d+|vk[A-Z]\w{1,80}\([\w, ]{0,500}\) returns )")
_WORDS = (b'"vkFunc"', b'"apiCalls"', b'"gfxrecon-version"', b"<rdc>")
_COMPRESSED = ((b"\x1f\x8b", "gzip -d"), (b"\x28\xb5\x2f\xfd", "zstd -d"), (b"\xfd7zXZ\0", "xz -d"), (b"\x04\x22\x4d\x18", "lz4 -d"))


def hint(head: bytes) -> str | None:
    """What the beginning of a file is, and how to convert that; None where it is nothing known."""
    if head.startswith(b"GFXR"):
        return (
            "a binary capture of gfxreconstruct: convert it with `gfxrecon-convert --format jsonl FILE.gfxr`, "
            "or by version 0.9 with `gfxrecon-convert FILE.gfxr`"
        )
    if head.startswith(b"RDOC"):
        return "a binary capture of RenderDoc: convert it with `renderdoccmd convert -f FILE.rdc -o FILE.xml -c xml`"
    beginning = head[:4096].lower()
    if beginning.lstrip().startswith(b"<!doctype html") and b"<title>vulkan api dump" in beginning:
        return _dump("HTML")
    if _TEXT.match(head[:4096]):
        return _dump("text")
    for magic, command in _COMPRESSED:
        if head.startswith(magic):
            return f"a compressed file: decompress it with `{command} FILE`"
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) and any(word in head.replace(b"\0", b"") for word in _WORDS):
        return "text in UTF-16, as PowerShell's `>` writes it: let the tool write the file itself (`--output FILE`), or convert it to UTF-8"
    return None


def _dump(form: str) -> str:
    return f"{form} of api_dump: run the program again with VK_APIDUMP_OUTPUT_FORMAT=json in its environment"
