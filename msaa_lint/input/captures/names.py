"""Names of a capture's objects in its description: those that the application gave, otherwise what
they are and the call that made them.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable
from typing import Any

from msaa_lint.frame.vulkan.formats import format_of

from .command_buffers import RenderPassBegin
from .frame_kinds import FrameKind
from .labels import FrameLabels
from .objects import CapturedObject, Framebuffer, Image, Pipeline, RenderPass

_CHANNELS = re.compile(
    r"((?:[RGBAEDSX]\d+)+)_(UNORM|SNORM|UINT|SINT|SFLOAT|UFLOAT|SRGB)(?:_(S8)_UINT)?(?:_PACK\d+)?"
)
_SUFFIXES = {
    "UNORM": "",
    "SFLOAT": "F",
    "UFLOAT": "F",
    "UINT": "UI",
    "SINT": "I",
    "SNORM": "_SNORM",
    "SRGB": "_SRGB",
}


class Names:
    """Assigns names that are unique within a kind. An object has the same name in all documents of
    a capture.
    """

    def __init__(self, kinds: Iterable[FrameKind] = (), labels: FrameLabels | None = None) -> None:
        self._of: dict[Hashable, str] = {}
        self._taken: dict[tuple[str, str], int] = {}
        """The names, each with the number of the last name that starts with it."""
        self._labels: dict[RenderPass, dict[str, None]] = {}
        """The debug labels under which render passes are begun."""
        self._sizes: dict[RenderPass, str] = {}
        for kind in kinds:
            paths = (
                kind.labels
                if labels is not None and len(kind.labels) == len(kind.passes)
                else [()] * len(kind.passes)
            )
            for begin, path in zip((command.key for command in kind.passes), paths, strict=True):
                if isinstance(begin, RenderPassBegin):
                    self._labels.setdefault(begin.render_pass, {})[
                        labels.name(path) if labels is not None else ""
                    ] = None
                    if begin.framebuffer is not None:
                        self._sizes.setdefault(begin.render_pass, _size(begin.framebuffer.tree))

    def render_pass(self, render_pass: RenderPass) -> str:
        """The name of a render pass: if commands always begin it within the same debug labels,
        these.
        """
        labels = self._labels.get(render_pass, {})
        label = next(iter(labels)) if len(labels) == 1 else ""
        counts = [
            each.get("samples") or 1
            for each in render_pass.tree.get("attachments", ())
            if isinstance(each, dict)
        ]
        words = ("pass", self._sizes.get(render_pass, ""), _samples(max(counts, default=1)))
        return self._name(
            "render_pass", render_pass, render_pass.label or label or _described(words, render_pass)
        )

    def pipeline(self, pipeline: Pipeline) -> str:
        """The name of a pipeline."""
        words = ("pipeline", _samples(pipeline_samples(pipeline)))
        return self._name("pipeline", pipeline, pipeline.label or _described(words, pipeline))

    def image(self, image: Image) -> str:
        """The name of an image; swapchain images are numbered within their swapchain."""
        tree, swapchain = image.tree, image.swapchain
        words = [
            "-".join(image.aspects) or "image",
            _size(tree.get("extent") or {}),
            _short_format(tree.get("format")),
        ]
        layers = tree.get("arrayLayers") or 1
        if layers > 1:
            words.append(f"{layers} layers")
        words.append(_samples(image.samples))
        if swapchain is not None:
            words[0] = f"swapchain image {image.number}"
        own = (
            f"{swapchain.label}_{image.number}" if swapchain is not None and swapchain.label else ""
        )
        return self._name("image", image, image.label or own or _described(words, image))

    def framebuffer(
        self, framebuffer: Framebuffer, images: tuple[Image | None, ...], render_pass: RenderPass
    ) -> str:
        """The name of a framebuffer with these images; an imageless framebuffer can have several
        sets.
        """
        name = framebuffer.label or _described(
            ("framebuffer", _size(framebuffer.tree)), framebuffer
        )
        return self._name("framebuffer", (framebuffer, images, render_pass), name)

    def _name(self, kind: str, key: Hashable, base: str) -> str:
        if (kind, key) not in self._of:
            name, number = base, self._taken.get((kind, base), 1)
            while (kind, name) in self._taken:
                number += 1
                name = f"{base}_{number}"
            self._taken[kind, base] = number
            self._taken.setdefault((kind, name), 1)
            self._of[kind, key] = name
        return self._of[kind, key]


def pipeline_samples(pipeline: Pipeline) -> int:
    """The sample count of a pipeline; 1 if it does not state it."""
    state = pipeline.tree.get("multisampleState")
    return (state.get("rasterizationSamples") if isinstance(state, dict) else None) or 1


def _described(words: Iterable[str], created: CapturedObject) -> str:
    """`color 1280x720 RGBA16F 4x #86`: what an object is, and the call that created it; without
    calls, its number.
    """
    call = created.at.call
    return " ".join((*filter(None, words), f"#{created.number if call is None else call}"))


def _size(extent: dict[str, Any]) -> str:
    sides = [extent.get("width"), extent.get("height")]
    depth = extent.get("depth") or 1
    return (
        "x".join(map(str, (*sides, *((depth,) if depth > 1 else ())))) if None not in sides else ""
    )


def _samples(samples: int) -> str:
    return f"{samples}x" if samples > 1 else ""


def _short_format(format: object) -> str:
    """`RGBA16F` for R16G16B16A16_SFLOAT, `D24S8` for D24_UNORM_S8_UINT; other formats by their
    names.
    """
    known = format_of(format) if isinstance(format, str) else None
    found = _CHANNELS.fullmatch(known.name.removeprefix("X8_")) if known is not None else None
    if found is None:
        return known.name if known is not None else ""
    channels, numeric, stencil = found.groups()
    sizes = set(re.findall(r"\d+", channels))
    if len(sizes) == 1:
        channels = re.sub(r"\d+", "", channels) + sizes.pop()
    suffix = "" if channels == "S8" else _SUFFIXES[numeric]
    return f"{channels}{suffix}{stencil or ''}"
