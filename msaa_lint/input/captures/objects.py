"""The objects of a capture that matter for multisampling."""

from collections.abc import Hashable, Iterator, Mapping
from typing import Any, NamedTuple

from msaa_lint.frame.vulkan.formats import format_of

from .call import Call, Place
from .structures import Tree

MAX_ROTATION = 16
"""Maximum number of multisampled images that take turns from frame to frame: more than any
swapchain has.
"""

ATTACHMENT_USAGES = frozenset(("COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"))


class CapturedObject:
    """An object: the call that created it, its number within its kind (from 0), and its debug name
    (`label`), empty if it has none.

    `namer` is the type and the handle by which it was named. `tree` describes it. `frames` counts
    the frames that use it.
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


ImageKind = tuple[bool, bool]
"""Of an image in a descriptor: whether shaders may write it, and whether it is multisampled."""


class Image(CapturedObject):
    """An image, possibly of a swapchain. `aspect_states` holds the state of each aspect after its
    last use, `present` the submission that presents it.
    """

    __slots__ = (
        "alike",
        "aspect_states",
        "aspects",
        "attachable",
        "kinds",
        "layouts",
        "may_be_read",
        "present",
        "swapchain",
    )

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        format = format_of(tree["format"]) if "format" in tree else None
        self.aspects = format.aspects if format is not None else ()
        self.swapchain: Swapchain | None = None
        usage = tree.get("usage")
        self.attachable = (
            usage is None or self.samples > 1 or not ATTACHMENT_USAGES.isdisjoint(usage)
        )
        """Whether a pass may draw to it. Other textures, which are most images of a program, are
        not tracked.
        """
        self.aspect_states: dict[str, Any] = {}
        self.present: Any = None
        self.may_be_read = False
        """Whether a shader may read it through a descriptor whose contents the capture omits, or
        another process or API its memory.
        """
        by_usage = (("SAMPLED", False), ("STORAGE", True)) if self.attachable else ()
        self.kinds: tuple[ImageKind, ...] = tuple(
            (written, self.samples > 1)
            for name, written in by_usage
            if usage is None or name in usage
        )
        """What it can be in such a descriptor, and `layouts`: those in which it is now. Empty if
        that is no longer followed.
        """
        self.layouts: frozenset[str] = frozenset()
        self.alike: AlikeImages | None = None
        """The images that are created alike, if it is multisampled."""

    @property
    def samples(self) -> int:
        """The sample count; 1 if the capture does not state it."""
        return self.tree.get("samples") or 1

    @property
    def description(self) -> Tree:
        """Its tree, and whether something that is not described may read it."""
        return {**self.tree, "mayBeRead": True} if self.may_be_read else self.tree

    @property
    def is_single_level(self) -> bool:
        """Whether it has one mip level and one layer, so that one pass can write all of it."""
        depth = self.tree.get("extent", {}).get("depth", 1)
        return all(
            count == 1
            for count in (self.tree.get("mipLevels", 1), self.tree.get("arrayLayers", 1), depth)
        )


class AlikeImages:
    """Multisampled images that are created with the same parameters: the first of them, and
    `together` the most that exist at a time.

    That is empty if more exist than can take turns.
    """

    __slots__ = ("_existing", "_is_crowded", "first", "together")

    def __init__(self, first: Image) -> None:
        self.first = first
        self.together: tuple[Image, ...] = ()
        self._existing: dict[Image, None] = {}
        self._is_crowded = False

    def add(self, image: Image) -> None:
        """Adds an image that exists from now on."""
        self._existing[image] = None
        self._is_crowded = self._is_crowded or len(self._existing) > MAX_ROTATION
        if self._is_crowded:
            self._existing.clear()
            self.together = ()
        elif len(self._existing) > len(self.together):
            self.together = tuple(self._existing)

    def remove(self, image: Image) -> None:
        """Removes an image that no longer exists."""
        self._existing.pop(image, None)


class Swapchain(CapturedObject):
    """A swapchain with its images, in order; its tree describes each of them."""

    __slots__ = ("handles", "images")

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        self.images: list[Image] = []
        self.handles: list[int] = []


class RenderPass(CapturedObject):
    """A render pass. Render passes created with the same parameters are one object. `layouts` are
    those of its attachments.
    """

    __slots__ = ("layouts",)

    def __init__(self, call: Call, number: int, tree: Tree) -> None:
        super().__init__(call, number, tree)
        self.layouts: Any = None


class Framebuffer(CapturedObject):
    """A framebuffer: its size, and its images, None for an unknown one; `images` is None for an
    imageless framebuffer.

    `parts` are the first mip level and layer of each image, empty if all are 0.
    """

    __slots__ = ("images", "parts")

    def __init__(
        self,
        call: Call,
        number: int,
        tree: Tree,
        images: tuple[Image | None, ...] | None,
        parts: tuple[tuple[int, int], ...] = (),
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
        self.dynamic_samples = any(
            state.startswith("RASTERIZATION_SAMPLES") for state in tree.get("dynamicState", ())
        )


Use = tuple[Image, bool]
"""An image in a descriptor set, and whether shaders may also write it."""


class ReadableBindings:
    """The bindings of a set that a pipeline can read as images, each with the kinds of image."""

    __slots__ = ("kinds", "of_all")

    def __init__(self, kinds: dict[int, tuple[ImageKind, ...]]) -> None:
        self.kinds = kinds
        self.of_all = tuple(dict.fromkeys(kind for each in kinds.values() for kind in each))
        """The kinds of image of all bindings."""

    def accept(self, bindings: Mapping[int, int], kind: ImageKind) -> bool:
        """Whether the pipeline can read an image of a kind through one of some bindings."""
        few, many = sorted((bindings, self.kinds), key=len)
        return any(binding in many and kind in self.kinds[binding] for binding in few)


SetBindings = tuple[ReadableBindings | None, ...]
"""What a pipeline can read, by set; None for a set whose layout is unknown."""


class UnknownDescriptors(NamedTuple):
    """Descriptors of a binding whose images the capture omits: how many, whether shaders may write
    them, and their layouts as far as they are stated (as `layouts.readable` tells them apart; None
    for any).
    """

    size: int
    storage: tuple[bool, ...]
    layouts: frozenset[str] | None


class DescriptorSet:
    """The attachable images of a descriptor set, by binding and element, and what is unknown of it.

    The contents of an `opaque` set are unknown. `uses` counts the slots of an image by binding.
    `log` has what was put into the set in order, so that a reader finds what is new since it last
    read the set; when the log is shortened, `epoch` grows.
    """

    __slots__ = ("epoch", "images", "layout", "log", "opaque", "unknown", "updates", "uses")

    def __init__(self, layout: Any = None) -> None:
        self.layout = layout
        """The SetLayout; None if it is unknown."""
        self.images: dict[tuple[int, int], Use] = {}
        self.uses: dict[Use, dict[int, int]] = {}
        self.log: list[Use] = []
        self.epoch = 0
        self.opaque = False
        self.unknown: dict[int, UnknownDescriptors] = {}
        self.updates = 0
        """The number of changes of what is unknown."""

    def put(self, slot: tuple[int, int], image: Image, storage: bool) -> None:
        """Writes an image to a slot."""
        use = (image, storage)
        before = self.images.get(slot)
        if before == use:
            return
        if before is not None:
            self.remove(slot)
        self.images[slot] = use
        bindings = self.uses.get(use, {})
        if slot[0] not in bindings:
            if len(self.log) > 2 * len(self.uses) + 64:
                self.log = list(self.uses)
                self.epoch += 1
            self.log.append(use)
        bindings[slot[0]] = bindings.get(slot[0], 0) + 1
        self.uses[use] = bindings

    def remove(self, slot: tuple[int, int]) -> None:
        """Empties a slot."""
        use = self.images.pop(slot, None)
        if use is not None:
            bindings = self.uses[use]
            bindings[slot[0]] -= 1
            if not bindings[slot[0]]:
                del bindings[slot[0]]
            if not bindings:
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
