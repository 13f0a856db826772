"""The objects of a capture that multisampling has to do with, as they were created."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from .call import Call, Place
from .structures import Tree

ATTACHMENT_USAGES = frozenset(("COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"))


class Created:
    """An object: the call that made it, its number among its kind (from 0), the name that the application gave it, or empty.

    `frames` counts the frames that it is in use in.
    """

    __slots__ = ("at", "by", "frames", "label", "number")

    def __init__(self, call: Call, number: int) -> None:
        self.by = call.name
        self.at: Place = call.at
        self.number = number
        self.label = ""
        self.frames = 0


class Image(Created):
    """An image, or one of a swapchain's. `tree` is a description's; `left` what the last use of each aspect left behind."""

    __slots__ = ("aspects", "attachable", "left", "shared", "swapchain", "tree")

    def __init__(self, call: Call, number: int, tree: Tree, aspects: tuple[str, ...]) -> None:
        super().__init__(call, number)
        self.tree = tree
        self.aspects = aspects
        self.swapchain: Swapchain | None = None
        self.shared = False
        """Whether its memory may be shared with another process or another API, which may read it."""
        usage = tree.get("usage")
        self.attachable = usage is None or self.samples > 1 or not ATTACHMENT_USAGES.isdisjoint(usage)
        """Whether a pass may draw to it: textures, which are most of a program's images, need no following."""
        self.left: dict[str, Any] = {}

    @property
    def samples(self) -> int:
        """Its sample count; 1 where the capture does not state it."""
        return self.tree.get("samples") or 1


class Swapchain(Created):
    """A swapchain: its images by their index."""

    __slots__ = ("images", "tree")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number)
        self.tree = tree
        self.images: list[Image] = []


class RenderPass(Created):
    """A render pass; those that were created alike are one."""

    __slots__ = ("tree",)

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number)
        self.tree = tree


class Framebuffer(Created):
    """A framebuffer with its images, None where one is not known; `images` is None where the begin names them (imageless)."""

    __slots__ = ("height", "images", "layers", "render_pass", "width")

    def __init__(self, call: Call, number: int, render_pass: RenderPass | None, images: tuple[Image | None, ...] | None) -> None:
        super().__init__(call, number)
        self.render_pass = render_pass
        self.images = images
        self.width: int | None = None
        self.height: int | None = None
        self.layers: int | None = None


class Pipeline(Created):
    """A graphics pipeline; those that were created alike are one."""

    __slots__ = ("dynamic_samples", "modules", "render_pass", "tree")

    def __init__(self, call: Call, number: int, tree: Tree, render_pass: RenderPass | None) -> None:
        super().__init__(call, number)
        self.tree = tree
        self.render_pass = render_pass
        self.modules: dict[str, bytes] = {}
        self.dynamic_samples = any(state.startswith("RASTERIZATION_SAMPLES") for state in tree.get("dynamicState", ()))


class DescriptorSet:
    """The images of interest that a descriptor set shows to shaders, by binding and element, and whether shaders may write them too.

    One that is `opaque` holds what the capture does not tell.
    """

    __slots__ = ("images", "opaque")

    def __init__(self) -> None:
        self.images: dict[tuple[int, int], tuple[Image, bool]] = {}
        self.opaque = False


def frozen(value: Any) -> Hashable:
    """Plain data as something that can be a key."""
    if isinstance(value, dict):
        return tuple((key, frozen(item)) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return tuple(map(frozen, value))
    made: Hashable = value
    return made
