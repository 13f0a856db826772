"""Detects captures in unsupported forms from their first bytes, and says how to convert them."""

from __future__ import annotations

import re

_TEXT = re.compile(rb"\s*(?:Thread \d+, Frame \d+|vk[A-Z]\w{1,80}\([\w, ]{0,500}\) returns )")
_WORDS = (b'"vkFunc"', b'"apiCalls"', b'"gfxrecon-version"', b"<rdc>")
_COMPRESSED = ((b"\x1f\x8b", "gzip -d"), (b"\x28\xb5\x2f\xfd", "zstd -d"), (b"\xfd7zXZ\0", "xz -d"), (b"\x04\x22\x4d\x18", "lz4 -d"))


def hint(head: bytes) -> str | None:
    """The form of a file and how to convert it; None if it is not a known form."""
    if head.startswith(b"GFXR"):
        return (
            "a binary gfxreconstruct capture: convert it with `gfxrecon-convert --format jsonl FILE.gfxr`, "
            "or `gfxrecon-convert FILE.gfxr` for version 0.9"
        )
    if head.startswith(b"RDOC"):
        return "a binary RenderDoc capture: convert it with `renderdoccmd convert -f FILE.rdc -o FILE.xml -c xml`"
    beginning = head[:4096].lower()
    if beginning.lstrip().startswith(b"<!doctype html") and b"<title>vulkan api dump" in beginning:
        return _dump("HTML")
    if _TEXT.match(head[:4096]):
        return _dump("text")
    for magic, command in _COMPRESSED:
        if head.startswith(magic):
            return f"a compressed file: decompress it with `{command} FILE`"
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) and any(word in head.replace(b"\0", b"") for word in _WORDS):
        return "UTF-16 text, as written by PowerShell's `>`: let the tool write the file itself (`--output FILE`), or convert it to UTF-8"
    return None


def _dump(form: str) -> str:
    return f"api_dump output in {form} format: run the program again with VK_APIDUMP_OUTPUT_FORMAT=json in its environment"
