"""Reads GLSL shaders that fetch samples as descriptions: the images, a pipeline with the shader,
and the reads of a frame.

How the shader uses the samples is determined from its SPIR-V (see `shader`). All that is known of
the images is that they are read; on a page that also shows code that creates them, their sample
count may be known.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.spirv.reflect import Multisampled, Reflected, reflect
from msaa_lint.frame.spirv.words import SpirvError
from msaa_lint.input.code.parsing import Code, Read, Unread

from .shader import Shader, shader
from .text import ShaderLimitExceeded, UnsupportedShader, blank

RELEVANT = re.compile(r"\b[iu]?(?:sampler2DMS|texture2DMS|image2DMS|subpassInputMS)")

NOT_COLOR = re.compile(
    r"depth|stencil|normal|position|velocity|motion|shadow|(?:^|_)ids?(?:_|$)", re.IGNORECASE
)
"""Names of images whose samples must not be averaged, or whose average is not a color resolve."""

MAX_SHADERS = 50
"""The maximum number of shaders read on a page."""

_APART = re.compile(r"(?:[ \t\r]*\n){3,}")
_MAIN = re.compile(r"\bvoid\s+main\s*\(")
_VERSION = re.compile(r"^\s*#\s*version\b", re.MULTILINE)


def trees(code: Code) -> list[Read]:
    """Returns a tree for each shader that reads multisampled images. Raises `Missing` if the
    grammar is not installed.
    """
    if RELEVANT.search(code.text) is None:
        return []
    readings: list[Read] = []
    unread: list[Unread] = []
    for start, end in _shaders(code):
        if len(readings) == MAX_SHADERS:
            unread.append(
                Unread(
                    f"only the first {MAX_SHADERS} shaders of a page are checked",
                    Span(start, start),
                )
            )
            break
        text = blank(code.text[:start]) + code.text[start:end]
        try:
            lowered = shader(text, code.fragments)
            reflected = reflect(lowered.code)
        except ShaderLimitExceeded as error:
            unread.append(Unread(f"{error}; the shader is not checked", Span(start, start)))
            continue
        except (UnsupportedShader, SpirvError):
            continue
        number = f"-{len(readings) + 1}" if readings else ""
        name = f"{lowered.entry[:40]}{number}.{'comp' if lowered.stage == 'COMPUTE' else 'frag'}"
        tree = _tree(lowered, reflected, name)
        if tree is not None:
            text = code.text[start:end].rstrip() + "\n"
            text = text[len(text) - len(text.lstrip()) :]
            readings.append(
                Read(tree, (), {name: text.encode()} if lowered.stage == "FRAGMENT" else {})
            )
    return [*readings, Read(mapping([], Span(0, 0)), unread=tuple(unread))] if unread else readings


def _shaders(code: Code) -> Iterator[tuple[int, int]]:
    """Yields the range of each shader. A file is one shader; on a page, `#version`, `main`, and the
    gaps between blocks separate them.
    """
    if not code.fragments:
        yield 0, len(code.text)
        return
    text = code.text
    start = at = 0
    for match in [*_APART.finditer(text), None]:
        end = match.start() if match is not None else len(text)
        block = text[at:end]
        if _VERSION.search(block) is not None and text[start:at].strip():
            if RELEVANT.search(text, start, at):
                yield start, at
            start = at
        if _MAIN.search(block) is not None or match is None:
            if RELEVANT.search(text, start, end):
                yield start, end
            start = end
        at = match.end() if match is not None else end


def _tree(lowered: Shader, reflected: Reflected, module: str) -> Node | None:
    """Returns a shader as a frame: the images, their reads, and the draw that performs them."""
    named = [
        (name, image)
        for name, image in _images(lowered, reflected)
        if NOT_COLOR.search(name) is None
    ]
    if not named or len(named) != len(reflected.images) or not lowered.fetches:
        return None
    places = {name: _fetched(lowered, name) for name, _ in named}
    at = next(iter(places.values()))
    images = [
        (name, Span(*lowered.images.get(name, at)), mapping([], places[name])) for name, _ in named
    ]
    reads = []
    for name, image in named:
        place = places[name]
        members = [
            ("image", place, scalar(name, place)),
            ("stage", place, scalar(lowered.stage, place)),
        ]
        if lowered.stage == "COMPUTE" and image.resolves is not None:
            members += [
                ("samples", place, scalar("ALL", place)),
                ("resolves", place, scalar(image.resolves, place)),
            ]
        reads.append(mapping([("readImage", place, mapping(members, place))], place))
    sections = [("images", at, mapping(images, at))]
    if lowered.stage == "FRAGMENT":
        count = next((image.total for _, image in named), None)
        count_at = (
            Span(*lowered.constants[count])
            if count is not None and count in lowered.constants
            else at
        )
        stage = [
            ("stage", at, scalar("FRAGMENT", at)),
            ("module", at, scalar(module, at)),
            ("specialization", count_at, mapping([], count_at)),
        ]
        stages = sequence([mapping(stage, at)], at)
        pipeline = mapping([(lowered.entry, at, mapping([("stages", at, stages)], at))], at)
        sections.append(("pipelines", at, pipeline))
        draw = mapping([("pipeline", at, scalar(lowered.entry, at))], at)
        reads.append(mapping([("draw", at, draw)], at))
    sections.append(("commands", at, sequence(reads, at)))
    return mapping(sections, Span(0, 0))


def _images(lowered: Shader, reflected: Reflected) -> list[tuple[str, Multisampled]]:
    """Returns the fetched images by name; an empty list if they cannot be identified or are input
    attachments.
    """
    if any(
        image.image.input_attachment is not None or image.image.element is not None
        for image in reflected.images
    ):
        return []
    if len(reflected.images) == 1 and len(lowered.images) == 1:
        return [(next(iter(lowered.images)), reflected.images[0])]
    by_place = {(item, binding): name for name, (item, binding) in lowered.bindings.items()}
    named_images = [
        (by_place.get((image.image.descriptor_set or 0, image.image.binding), ""), image)
        for image in reflected.images
    ]
    return (
        named_images
        if all(name for name, _ in named_images)
        and len({name for name, _ in named_images}) == len(named_images)
        else []
    )


def _fetched(lowered: Shader, name: str) -> Span:
    """Returns where an image is first fetched: by its own name, otherwise by any name."""
    match = next((fetch for fetch in lowered.fetches if fetch.image == name), lowered.fetches[0])
    return Span(match.start, match.end)


# Shaders next to other code


def with_page_counts(by_code: list[tuple[Code, list[Read]]]) -> list[tuple[Code, list[Read]]]:
    """Sets the sample count of images in a page's shaders to the only multisampled count that its
    other code uses.

    If that code sets specialization constants, the values in the shaders may not apply, and nothing
    is changed.
    """
    others = [(code, entry) for code, item in by_code if code.language != "glsl" for entry in item]
    counts: dict[int, Span] = {}
    for _, reading in others:
        counts = {**_counts(reading.tree), **counts}
    if len(counts) != 1 or 0 in counts or any("Specialization" in code.text for code, _ in others):
        return by_code
    ((count, at),) = counts.items()
    return [
        (
            code,
            [item._replace(tree=_with_count(item.tree, count, at)) for item in entry]
            if code.language == "glsl"
            else entry,
        )
        for code, entry in by_code
    ]


def _counts(tree: Node) -> dict[int, Span]:
    """Returns the sample counts above 1 of a tree's images, attachments, and pipelines, and their
    locations; 0 stands for an unknown count.
    """
    counts: dict[int, Span] = {}
    stack = [
        tree.value[name]
        for name in ("images", "renderPasses", "pipelines")
        if tree.kind == "mapping" and name in tree.value
    ]
    while stack:
        node = stack.pop()
        for key, value in node.value.items() if node.kind == "mapping" else ():
            if key in ("samples", "rasterizationSamples") and value.kind == "scalar":
                from msaa_lint.frame.description.scalars import sample_count

                count = sample_count(value.value)
                if count is None:
                    counts.setdefault(0, value.span)
                elif count > 1:
                    counts.setdefault(count, value.span)
            else:
                stack.append(value)
        if node.kind == "sequence":
            stack += node.value
    return counts


def _with_count(tree: Node, count: int, at: Span) -> Node:
    """Returns a shader's tree whose images have a sample count."""
    images = tree.value["images"]
    counted = [
        (name, images.keys[name].span, mapping([("samples", at, scalar(count, at))], at))
        for name in images.value
    ]
    sections = [
        (key, tree.keys[key].span, value) for key, value in tree.value.items() if key != "images"
    ]
    return mapping([("images", images.span, mapping(counted, images.span)), *sections], tree.span)
