"""The objects of a capture that matter for multisampling."""

from __future__ import annotations

from collections.abc import Hashable, Iterator
from typing import Any

from msaa_lint.frame.vulkan.formats import format_of

from .call import Call, Place
from .structures import Tree

ATTACHMENT_USAGES = frozenset(("COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"))


class CapturedObject:
    """An object: the call that created it, its number within its kind (from 0), and its debug name (`label`), empty if it has none.

    `namer` is the type and the handle by which it was named. `tree` describes it. `frames` counts the frames that use it.
    """

    __slots__ = ("at", "by", "frames", "label", "namer", "number", "tree")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        self.by = call.name
        self.at: Place = call.at
        self.number = number
        self.tree = tree
        self.label = ""
        self.namer: tuple[str, int] | None = None
        self.frames = 0


class Image(CapturedObject):
    """An image, possibly of a swapchain. `aspect_states` holds the state of each aspect after its last use, `present` the submission that
    presents it."""

    __slots__ = ("aspect_states", "aspects", "attachable", "present", "shared", "swapchain")

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
        self.present: Any = None

    @property
    def samples(self) -> int:
        """The sample count; 1 if the capture does not state it."""
        return self.tree.get("samples") or 1


class Swapchain(CapturedObject):
    """A swapchain with its images, in order; its tree describes each of them."""

    __slots__ = ("handles", "images")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        self.images: list[Image] = []
        self.handles: list[int] = []


class RenderPass(CapturedObject):
    """A render pass. Render passes created with the same parameters are one object."""

    __slots__ = ()


class Framebuffer(CapturedObject):
    """A framebuffer: its size, and its images, None for an unknown one; `images` is None for an imageless framebuffer.

    `parts` are the first mip level and layer of each image, empty if all are 0.
    """

    __slots__ = ("images", "parts")

    def __init__(
        self, call: Call, number: int, tree: Tree, images: tuple[Image | None, ...] | None, parts: tuple[tuple[int, int], ...] = ()
    ) -> None:
        super().__init__(call, number, tree)
        self.images = images
        self.parts = parts


class Pipeline(CapturedObject):
    """A graphics pipeline. Pipelines created with the same parameters are one object."""

    __slots__ = ("dynamic_samples", "modules", "render_pass")

    def __init__(self, call: Call, number: int, tree: Tree, render_pass: RenderPass | None) -> None:
        super().__init__(call, number, tree)
        self.render_pass = render_pass
        self.modules: dict[str, bytes] = {}
        self.dynamic_samples = any(state.startswith("RASTERIZATION_SAMPLES") for state in tree.get("dynamicState", ()))


Use = tuple[Image, bool]
"""An image in a descriptor set, and whether shaders may also write it."""


class DescriptorSet:
    """The attachable images of a descriptor set, by binding and element.

    The contents of an `opaque` set are unknown. `uses` counts the slots of an image. `log` has what was put into the set in order, so that
    a reader finds what is new since it last read the set; when the log is shortened, `epoch` grows.
    """

    __slots__ = ("epoch", "images", "log", "opaque", "uses")

    def __init__(self) -> None:
        self.images: dict[tuple[int, int], Use] = {}
        self.uses: dict[Use, int] = {}
        self.log: list[Use] = []
        self.epoch = 0
        self.opaque = False

    def put(self, slot: tuple[int, int], image: Image, storage: bool) -> None:
        """Writes an image to a slot."""
        use = (image, storage)
        before = self.images.get(slot)
        if before == use:
            return
        if before is not None:
            self.remove(slot)
        self.images[slot] = use
        if use not in self.uses:
            if len(self.log) > 2 * len(self.uses) + 64:
                self.log = list(self.uses)
                self.epoch += 1
            self.log.append(use)
        self.uses[use] = self.uses.get(use, 0) + 1

    def remove(self, slot: tuple[int, int]) -> None:
        """Empties a slot."""
        use = self.images.pop(slot, None)
        if use is not None:
            self.uses[use] -= 1
            if not self.uses[use]:
                del self.uses[use]


def freeze(value: Any) -> Hashable:
    """Plain data as a hashable value; `command_writer.thaw` is the inverse."""
    if isinstance(value, dict):
        return tuple((key, freeze(item)) for key, item in value.items())
    if isinstance(value, (list, tuple)):
        return tuple(map(freeze, value))
    made: Hashable = value
    return made


def images_in(key: Any) -> Iterator[Image]:
    """The images in the key of a command."""
    if isinstance(key, Image):
        yield key
    elif isinstance(key, tuple):
        for item in key:
            yield from images_in(item)
