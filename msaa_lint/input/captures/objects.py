"""The objects of a capture that matter for multisampling."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from msaa_lint.frame.vulkan.formats import format_of

from .call import Call, Place
from .structures import Tree

ATTACHMENT_USAGES = frozenset(("COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"))


class CapturedObject:
    """An object: the call that created it, its number within its kind (from 0), and its debug name (`label`), empty if it has none.

    `tree` describes it. `frames` counts the frames that use it.
    """

    __slots__ = ("at", "by", "frames", "label", "number", "tree")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        self.by = call.name
        self.at: Place = call.at
        self.number = number
        self.tree = tree
        self.label = ""
        self.frames = 0


class Image(CapturedObject):
    """An image, possibly of a swapchain. `aspect_states` holds the state of each aspect after its last use."""

    __slots__ = ("aspect_states", "aspects", "attachable", "shared", "swapchain")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        format = format_of(tree["format"]) if "format" in tree else None
        self.aspects = format.aspects if format is not None else ()
        self.swapchain: Swapchain | None = None
        self.shared = False
        """Whether another process or API may read its memory."""
        usage = tree.get("usage")
        self.attachable = usage is None or self.samples > 1 or not ATTACHMENT_USAGES.isdisjoint(usage)
        """Whether a pass may draw to it. Other textures, which are most images of a program, are not tracked."""
        self.aspect_states: dict[str, Any] = {}

    @property
    def samples(self) -> int:
        """The sample count; 1 if the capture does not state it."""
        return self.tree.get("samples") or 1


class Swapchain(CapturedObject):
    """A swapchain with its images, in order; its tree describes each of them."""

    __slots__ = ("images",)

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        self.images: list[Image] = []


class RenderPass(CapturedObject):
    """A render pass. Render passes created with the same parameters are one object."""

    __slots__ = ()


class Framebuffer(CapturedObject):
    """A framebuffer: its size, and its images, None for an unknown one; `images` is None for an imageless framebuffer."""

    __slots__ = ("images",)

    def __init__(self, call: Call, number: int, tree: Tree, images: tuple[Image | None, ...] | None) -> None:
        super().__init__(call, number, tree)
        self.images = images


class Pipeline(CapturedObject):
    """A graphics pipeline. Pipelines created with the same parameters are one object."""

    __slots__ = ("dynamic_samples", "modules", "render_pass")

    def __init__(self, call: Call, number: int, tree: Tree, render_pass: RenderPass | None) -> None:
        super().__init__(call, number, tree)
        self.render_pass = render_pass
        self.modules: dict[str, bytes] = {}
        self.dynamic_samples = any(state.startswith("RASTERIZATION_SAMPLES") for state in tree.get("dynamicState", ()))


class DescriptorSet:
    """The attachable images of a descriptor set, by binding and element, and whether shaders may also write them.

    The contents of an `opaque` set are unknown.
    """

    __slots__ = ("images", "opaque")

    def __init__(self) -> None:
        self.images: dict[tuple[int, int], tuple[Image, bool]] = {}
        self.opaque = False


def freeze(value: Any) -> Hashable:
    """Plain data as a hashable value; `command_writer.thaw` is the inverse."""
    if isinstance(value, dict):
        return tuple((key, freeze(item)) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return tuple(map(freeze, value))
    made: Hashable = value
    return made
