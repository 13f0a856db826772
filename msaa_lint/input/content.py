"""What a data file is, by its content: which files of a folder are inputs, and which ones msaa-lint
wrote.
"""

from __future__ import annotations

import os
import re
from typing import Any

from msaa_lint.core.text.files import open_entry
from msaa_lint.core.text.node import Limits, Node
from msaa_lint.core.text.tree import beginning
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.models import Command, Description
from msaa_lint.frame.description.shapes import Shape

from .file_types import (
    BINARY,
    CAPTURES,
    HEAD_BYTES,
    INPUT,
    NEAR,
    OTHER,
    binary_capture,
    compression_of,
)
from .readers import capture_format
from .readers.vulkan_sc import STATES

MAX_BYTES = 1 << 20
"""The number of bytes of a file that are searched for a frame if its head begins like a
description.
"""

_LIMITS = Limits(nodes=200_000)

_FIRST = 512
"""The number of characters that nearly always show that a file is a Vulkan SC pipeline: the rest of
its head need not be parsed.
"""

_SECTIONS = tuple(
    name for name in Description.SHAPE if name not in ("frame", "device", "enabled", "scene")
)
"""The sections that state the frame itself. Other tools' files often have the other keys as
well.
"""

_NAMES = "|".join((*_SECTIONS, *STATES))
_STATE = re.compile(rf'\s*\{{\s*"(?:{"|".join(STATES)})"\s*:'.encode())
_KEY = re.compile(rf"""(?:^|[\s{{,"'])(?:{_NAMES})["']?\s*:""")
_JSON_KEY = re.compile(rf'(?<!\\)"(?:{_NAMES})"\s*:')
_LINE_KEY = re.compile(rf"""^( *)["']?(?:{_NAMES})["']?[ \t]*:""", re.MULTILINE)
_FIRST_LINE = re.compile(r"^( *)[^\s#%]", re.MULTILINE)
_FLOW = re.compile(r"^(?:---[ \t]+)?(?:[!&]\S*[ \t]+)*\{", re.MULTILINE)
_STRING = re.compile(r'"(?:[^"\\]|\\.)*+"', re.DOTALL)

_VULKAN = re.compile(
    rb'"vk[A-Z]|"gfxrecon-version"|>Vulkan</driver>|name="vk[A-Z]|\AFOSSILIZEDB|\A\x81'
)
"""What a capture of a Vulkan program has in its head. Captures of other APIs, and other tools' logs
of calls, have the same structure.
"""

_LEAVES = frozenset(
    {
        "enum",
        "flags",
        "bool",
        "samples",
        "shading",
        "int",
        "number",
        "text",
        "name",
        "word",
        "caseless",
        "subpass",
        "slot",
    }
)
_CAMEL_CASE = re.compile(r"[a-z][A-Z]")
_RASTER_SAMPLES = re.compile(r"(?:rasterizationSamples|rasterSampleCount)\Z", re.IGNORECASE)

_TARGET_API = re.compile(r"renderTargets\..*\.api\Z")

_JSON_START = (b"{", b"[")
_OWN_JSON = (
    (re.compile(rb'"schema"\s*:\s*"msaa-lint/baseline-v'), "an msaa-lint baseline"),
    (re.compile(rb'"schema"\s*:\s*"msaa-lint/study-record-v'), "a study record of msaa-lint"),
    (re.compile(rb'"schema"\s*:\s*"msaa-lint/'), "msaa-lint's own JSON output"),
    (re.compile(rb'"driver"\s*:\s*\{\s*"name"\s*:\s*"msaa-lint"'), "msaa-lint's own SARIF output"),
    (
        re.compile(rb'\A\{\s*"source"\s*:\s*\{\s*"name"\s*:\s*"msaa-lint"'),
        "msaa-lint's own reviewdog output",
    ),
    (re.compile(rb'"\$id"\s*:\s*"urn:msaa-lint:'), "a JSON Schema of msaa-lint"),
    (
        re.compile(rb'\A\[\s*\{(?=[^{}]*"check_name")(?=[^{}]*"fingerprint")'),
        "a GitLab code quality report",
    ),
)
_OWN_TEXT = (
    (
        re.compile(rb'\A(?:<\?xml[^>]*>\s*)?<testsuites name="msaa-lint"'),
        "msaa-lint's own JUnit output",
    ),
    (re.compile(rb"\A<!-- msaa-lint -->"), "msaa-lint's own Markdown output"),
)


def own_output(head: bytes, tail: bytes = b"") -> str | None:
    """What a file is that msaa-lint wrote and that is not an input, from its beginning and its end;
    None for any other file.
    """
    start = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    if start.startswith(_JSON_START):
        return next(
            (
                name
                for pattern, name in _OWN_JSON
                if pattern.search(start) or (tail and pattern.search(tail))
            ),
            None,
        )
    return (
        next((name for pattern, name in _OWN_TEXT if pattern.match(start)), None)
        if start.startswith(b"<")
        else None
    )


def is_own_output(path: str) -> bool:
    """Whether msaa-lint wrote a file that is not an input. Raises OSError if it cannot be read."""
    with open_entry(path) as file:
        head = file.read(HEAD_BYTES)
        # The baseline, whose keys are sorted, says what it is at its end.
        file.seek(max(file.seek(0, os.SEEK_END) - 256, 0))
        return own_output(head, file.read(256)) is not None


def kind_of(path: str) -> str:
    """Whether a data file that was found in a folder is an input: INPUT, NEAR, BINARY or OTHER.

    Only what a Vulkan or Metal frame alone has makes an input: a capture of Vulkan calls, a Vulkan
    SC pipeline, or a description most of which fits the format and that states, say, a VkFormat at
    its place. Raises OSError if the file cannot be read.
    """
    with open_entry(path) as file:
        data = file.read(HEAD_BYTES)
        if _STATE.match(data) and _begins_like_pipeline(data[:_FIRST].decode("utf-8", "replace")):
            return INPUT
        if binary_capture(data) is not None:
            return BINARY
        compression = compression_of(data)
        if compression is not None:
            from .compression import decompressed

            file.seek(0)
            data = decompressed(file, compression).head()
        if capture_format(data) is not None:
            return INPUT if _VULKAN.search(data) else OTHER
        if (
            path.lower().endswith((".xml", ".jsonl", ".foz", *CAPTURES))
            or own_output(data) is not None
        ):
            return OTHER
        kind = kind_of_text(data)
        if kind == NEAR and len(data) == HEAD_BYTES:
            kind = kind_of_text(data + file.read(MAX_BYTES - HEAD_BYTES))
        return kind


def kind_of_text(data: bytes) -> str:
    """Whether the text of a data file is a description, as `kind_of`."""
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    text = data.decode(encoding, "replace")
    if not _has_key(text):
        return OTHER
    if any(name in text[:_FIRST] for name in STATES) and _begins_like_pipeline(text[:_FIRST]):
        return INPUT
    kinds = {_kind_of_document(root) for root in beginning(text, _LIMITS) if root.kind == "mapping"}
    return next((kind for kind in (INPUT, NEAR) if kind in kinds), OTHER)


def _begins_like_pipeline(start: str) -> bool:
    """Whether the beginning of a text shows that it is a Vulkan SC pipeline."""
    roots = [
        root
        for root in beginning(start, _LIMITS)
        if root.kind == "mapping" and not root.value.keys().isdisjoint(STATES)
    ]
    return any(_kind_of_document(root) == INPUT for root in roots)


def _has_key(text: str) -> bool:
    """Whether a section may be a key of the root: parsing every text that mentions one deep inside
    would take ten times as long.
    """
    start = text.lstrip()
    if start.startswith("{") and start[1:].lstrip().startswith('"'):
        depth = at = 0
        for key in _JSON_KEY.finditer(text):
            outside = _STRING.sub("", text[at : key.start()])
            depth += (
                outside.count("{") + outside.count("[") - outside.count("}") - outside.count("]")
            )
            if depth <= 1:
                return True
            at = key.start()
        return False
    if _FLOW.search(text):
        return _KEY.search(text) is not None
    first = _FIRST_LINE.search(text)
    return first is not None and any(
        len(key[1]) <= len(first[1]) for key in _LINE_KEY.finditer(text)
    )


def _kind_of_document(root: Node) -> str:
    states = [root.value[name] for name in STATES if name in root.value]
    if states:
        parts = [
            part
            for state in states
            if state.kind == "mapping"
            for part in state.value.values()
            if part.kind == "mapping"
        ]
        types = [part.value["sType"].text for part in parts if "sType" in part.value]
        return INPUT if any(text.startswith("VK_STRUCTURE_TYPE_") for text in types) else NEAR
    fit = _Fit()
    for name in _SECTIONS:
        if name in root.value:
            fit.value(Description.SHAPE[name], root.value[name], name, name)
    fit.misfits += sum(name not in Description.SHAPE for name in root.value)
    if fit.evidence and fit.fits > fit.misfits:
        return INPUT
    return NEAR if fit.evidence or fit.fits else OTHER


class _Fit(Binder):
    """Counts what of a document fits the format of descriptions and what does not, and as
    `evidence`, values that only a frame has.
    """

    is_full = True  # Problems are counted, and nothing is suggested for them.

    def __init__(self) -> None:
        super().__init__()
        self.fits = self.misfits = self.evidence = 0

    def report(self, *problem: object, **_: object) -> None:
        self.misfits += 1

    def unknown_key(self, *key: object) -> None:
        self.misfits += 1

    def value(self, shape: Shape, node: Node, path: str, key: str, head: Any = None) -> Any:
        misfits = self.misfits
        value = super().value(shape, node, path, key, head)
        self.fits += shape[0] in _LEAVES and self.misfits == misfits
        return value

    def enumerant(self, enums: str, node: Node, path: str) -> str | None:
        name = super().enumerant(enums, node, path)
        self.evidence += name is not None
        return name

    def flags(self, enum: str, node: Node, path: str) -> tuple[str, ...] | None:
        flags = super().flags(enum, node, path)
        self.evidence += bool(flags)
        return flags

    def word(self, words: tuple[Any, ...], node: Node, path: str) -> Any:
        word = super().word(words, node, path)
        is_target_api = word is not None and _TARGET_API.match(path) is not None
        self.evidence += is_target_api or (
            isinstance(word, str) and _CAMEL_CASE.search(word) is not None
        )
        return word

    def samples(self, node: Node, path: str) -> int | None:
        count = super().samples(node, path)
        self.evidence += count is not None and (
            "SAMPLE_COUNT_" in node.text or _RASTER_SAMPLES.search(path) is not None
        )
        return count

    def command(self, node: Node, path: str, key: str, kind: type[Command]) -> Command | None:
        command = super().command(node, path, key, kind)
        self.fits += command is not None
        self.evidence += command is not None and _CAMEL_CASE.search(command.kind) is not None
        return command
