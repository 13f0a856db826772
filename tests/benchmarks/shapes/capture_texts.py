"""Captures as no tool writes them: long lines, deep nesting, what readers repair, many entries that
share what they name.
"""

from __future__ import annotations

import gzip
import json
import lzma
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.input.readers.dialects_binary import MAGIC, entry

from .shape import Shape

HEADER = (
    b'{"header":{"source-path":"p.gfxr","gfxrecon-version":"1.0.3","vulkan-version":"1.3.250"}}\n'
)
XML = (
    b'<?xml version="1.0"?>\n<rdc>\n<header><driver id="8">Vulkan</driver></header>\n<chunks '
    b'version="21">\n%b</chunks>\n</rdc>\n'
)


def shape(
    name: str, file: str, content: Callable[[int], bytes], codes: tuple[int, ...] = (0, 1)
) -> Shape:
    """A shape of bytes."""

    def write(folder: Path, size: int) -> None:
        (folder / file).write_bytes(content(size))

    return Shape(f"capture: {name}", write, ("check", "--isolated", file), codes)


def line(value: bytes, member: bytes = b"pNext") -> bytes:
    """A capture of one line, with a value in a structure."""
    body = b'{"name":"vkCreateImage","args":{"pCreateInfo":{"%b":%b},"pImage":7}}' % (member, value)
    return HEADER + b'{"index":1,"function":%b}\n' % body


def staircase(count: int) -> bytes:
    """Calls as elements whose brackets stand at no place that repeats: each is indented in another
    way, and ends within a line.
    """
    elements = []
    for number in range(count):
        indent = f"{number:020b}".replace("0", " ").replace("1", "\t").encode()
        elements.append(
            indent
            + b'{\n"index":%d,"function":{"name":"vkDestroyImage","args":{"image":1}}}' % number
        )
    return b"[\n" + b",\n".join(elements) + b"]\n"


def chunk(name: bytes, body: bytes) -> bytes:
    return b'<chunk id="1" name="%b">%b</chunk>\n' % (name, body)


def database(count: int, kind: int, content: Callable[[int], bytes]) -> bytes:
    """A Fossilize database of entries of one kind."""
    return MAGIC + b"".join(entry(kind, number + 1, content(number)) for number in range(count))


def render_pass(number: int, **members: Any) -> bytes:
    attachment = {
        "format": 37,
        "samples": 4,
        "loadOp": 1,
        "storeOp": 0,
        "stencilLoadOp": 2,
        "stencilStoreOp": 1,
        "initialLayout": 0,
    }
    subpass = {"pipelineBindPoint": 0, "colorAttachments": [{"attachment": 0, "layout": 2}]}
    info = {
        "attachments": [{**attachment, "finalLayout": 2, "flags": number & 1}],
        "subpasses": [subpass],
        **members,
    }
    return json.dumps({"renderPasses": {f"{number + 1:016x}": info}}).encode()


def pipeline(number: int) -> bytes:
    """A pipeline with the fragment shader that all share."""
    stage = {"stage": 16, "module": f"{77:016x}", "name": "main"}
    state = {
        "rasterizationSamples": 4,
        "sampleShadingEnable": 1,
        "minSampleShading": number / (1 << 20),
    }
    info = {"renderPass": f"{1:016x}", "subpass": 0, "stages": [stage], "multisampleState": state}
    return json.dumps({"graphicsPipelines": {f"{number + 1:016x}": info}}).encode()


def shared_module(count: int) -> bytes:
    """Pipelines with one shader module, which is in the database as often."""
    module = json.dumps(
        {
            "shaderModules": {
                f"{77:016x}": {"varintOffset": 0, "varintSize": 5, "codeSize": 20, "flags": 0}
            }
        }
    ).encode()
    modules = b"".join(entry(4, 77, module + b"\0" + bytes(5)) for _ in range(count))
    return database(count, 6, pipeline) + modules + entry(5, 1, render_pass(0))


def bomb(count: int) -> bytes:
    """Entries that decompress to a thousand times their size."""
    stored = zlib.compress(b'{"renderPasses":{}}' + b" " * (1 << 20))
    return MAGIC + b"".join(
        f"{5:024x}{number:016x}".encode()
        + b"".join(each.to_bytes(4, "little") for each in (len(stored), 2, 0, (1 << 20) + 19))
        + stored
        for number in range(count)
    )


def chain(number: int) -> bytes:
    """A render pass whose subpass has a chain of a hundred structures."""
    structures = [
        {"sType": 1000199001, "depthResolveMode": 1, "stencilResolveMode": 1} for _ in range(100)
    ]
    return render_pass(number, pNext=structures)


SHAPES = (
    shape("a long string", "a.jsonl", lambda count: line(b'"%b"' % (b"a" * count))),
    shape(
        "a long array",
        "a.jsonl",
        lambda count: line(b"[" + b"1," * count + b"1]", b"pQueueFamilyIndices"),
    ),
    shape("deep nesting", "a.jsonl", lambda count: line(b"[" * count + b"]" * count), (0, 2)),
    shape("deep nesting without end", "a.jsonl", lambda count: line(b'{"a":' * count), (2,)),
    shape("a huge integer", "a.jsonl", lambda count: line(b"1" * (count + 1)), (0, 1, 2)),
    shape("stray backslashes", "a.jsonl", lambda count: line(b'"%b"' % (b"\\q" * count))),
    shape("numbers that are none", "a.jsonl", lambda count: line(b"[" + b"-nan," * count + b"1]")),
    shape(
        "empty lines",
        "a.jsonl",
        lambda count: HEADER + b" \n" * count + line(b"1").removeprefix(HEADER),
    ),
    shape(
        "members of gzip",
        "a.jsonl.gz",
        lambda count: gzip.compress(HEADER) + gzip.compress(b" \n") * count,
        (2,),
    ),
    shape(
        "members of xz without contents",
        "a.jsonl.xz",
        lambda count: lzma.compress(HEADER) + lzma.compress(b"") * count,
        (2,),
    ),
    shape(
        "many keys",
        "a.jsonl",
        lambda count: line(b"{" + b",".join(b'"k%d":1' % number for number in range(count)) + b"}"),
    ),
    shape("unusual indentation", "a.json", staircase),
    shape(
        "brackets in a string",
        "a.json",
        lambda count: b"[\n" + line(b'"%b"' % (b"{}[]" * count)).removeprefix(HEADER) + b"]\n",
    ),
    shape(
        "xml: chunks",
        "a.xml",
        lambda count: XML % (chunk(b"vkQueueSubmit", b'<array name="pSubmits" />') * count),
    ),
    shape(
        "xml: unknown chunks",
        "a.xml",
        lambda count: XML % (chunk(b"vkUnknown", b'<uint name="x">1</uint>') * count),
    ),
    shape(
        "xml: a long value",
        "a.xml",
        lambda count: (
            XML % chunk(b"vkCreateImage", b'<string name="x">%b</string>' % (b"a" * count))
        ),
    ),
    shape(
        "xml: many values",
        "a.xml",
        lambda count: (
            XML
            % chunk(b"vkCreateImage", b'<array name="x">%b</array>' % (b"<uint>1</uint>" * count))
        ),
    ),
    shape(
        "xml: a long attribute",
        "a.xml",
        lambda count: XML % chunk(b"v", b'<uint x="%b">1</uint>' % (b"a" * count)),
        (0, 1, 2),
    ),
    shape(
        "xml: many attributes",
        "a.xml",
        lambda count: (
            XML
            % chunk(
                b"vkCreateImage",
                b"<uint %b>1</uint>" % b" ".join(b'a%d="1"' % number for number in range(count)),
            )
        ),
        (0, 1, 2),
    ),
    shape(
        "xml: deep nesting",
        "a.xml",
        lambda count: XML % chunk(b"vkCreateImage", b"<struct>" * count),
        (0, 2),
    ),
    shape(
        "xml: references",
        "a.xml",
        lambda count: (
            XML % chunk(b"vkCreateImage", b'<string name="x">%b</string>' % (b"&#01;&amp;" * count))
        ),
    ),
    shape("fossilize: render passes", "a.foz", lambda count: database(count, 5, render_pass)),
    shape("fossilize: a shared module", "a.foz", shared_module),
    shape("fossilize: decompression", "a.foz", bomb, (0, 1, 2)),
    shape("fossilize: chains", "a.foz", lambda count: database(count, 5, chain)),
)
