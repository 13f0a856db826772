"""Tracks images with their memory and views, and swapchains with their presents."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable, Iterable, Sized
from itertools import count

from msaa_lint.frame.description.models import Image as ImageRecord

from . import values
from .call import Call
from .command_buffers import CommandCache, Parts
from .devices import Devices
from .frames import Frames
from .layouts import ImageLayouts
from .objects import AlikeImages, Image, Swapchain, freeze
from .structures import to_tree
from .submissions import Submission

MAX_HANDLES = 2_000_000
"""Maximum number of objects of a kind that exist at a time. One call can allocate many, at a few
bytes of text for each.
"""

TOO_MANY_OBJECTS = (
    f"more than {MAX_HANDLES:,} objects of a kind exist at a time; further ones are not followed"
)

MAX_DISTINCT = 4096
"""Maximum number of distinct images that are described even if no frame uses them."""


EXTERNAL_MEMORY = (
    "EXTERNAL_MEMORY_IMAGE_CREATE_INFO",
    "EXTERNAL_MEMORY_IMAGE_CREATE_INFO_NV",
    "NATIVE_BUFFER_ANDROID",
)
"""Structures chained to the VkImageCreateInfo of an image whose memory may be external."""


class Images(Devices):
    """The images of a capture by image handle and by view handle."""

    def __init__(self) -> None:
        super().__init__()
        self.images: dict[int, Image] = {}
        self.layouts = ImageLayouts()
        self.views: dict[int, Image] = {}
        self.parts: dict[int, tuple[int, int]] = {}
        """The first mip level and layer of views that do not start at 0."""
        self.swapchains: dict[int, Swapchain] = {}
        self.memory: dict[int, int] = {}
        """The memory type index of each allocation."""
        self.multisampled: dict[Hashable, AlikeImages] = {}
        """Multisampled images by the parameters that they are created with."""
        self.numbers: defaultdict[object, count[int]] = defaultdict(count)
        """The numbers of the next objects, by kind."""
        self.frames = Frames()
        self.commands = CommandCache()

    def has_room(self, objects: Sized, call: Call) -> bool:
        """Whether another object of a kind is followed; otherwise that is reported."""
        if len(objects) < MAX_HANDLES:
            return True
        self.frames.limits.setdefault(TOO_MANY_OBJECTS, call.at)
        return False

    def on_CreateImage(self, call: Call) -> None:
        info = values.record(call.args.get("pCreateInfo"))
        handle = values.handle(call.args.get("pImage"))
        tree = to_tree(ImageRecord, info)
        image = Image(call, next(self.numbers[Image]), tree)
        self.frames.repetitions.created = image.number + 1
        self._add(handle, image)
        if image.samples > 1 and len(self.multisampled) < MAX_DISTINCT:
            image.alike = self.multisampled.setdefault(freeze(tree), AlikeImages(image))
            image.alike.add(image)
        image.may_be_read = any(values.chained(info, kind) is not None for kind in EXTERNAL_MEMORY)

    def _add(self, handle: int, image: Image) -> None:
        self._forget(handle)
        self.images[handle] = image
        self.layouts.add(image)

    def _forget(self, handle: int) -> None:
        image = self.images.pop(handle, None)
        if image is not None:
            self.layouts.forget(image)
            if image.alike is not None:
                image.alike.remove(image)

    def on_DestroyImage(self, call: Call) -> None:
        self._forget(values.handle(call.args.get("image")))

    def on_CreateImageView(self, call: Call) -> None:
        info = values.record(call.args.get("pCreateInfo"))
        image = self.images.get(values.handle(info.get("image")))
        if image is not None:
            handle = values.handle(call.args.get("pView"))
            self.views[handle] = image
            part = values.record(info.get("subresourceRange"))
            start = (
                values.integer(part.get("baseMipLevel")) or 0,
                values.integer(part.get("baseArrayLayer")) or 0,
            )
            if any(start):
                self.parts[handle] = start
            else:
                self.parts.pop(handle, None)

    def on_DestroyImageView(self, call: Call) -> None:
        handle = values.handle(call.args.get("imageView"))
        self.views.pop(handle, None)
        self.parts.pop(handle, None)

    def parts_of(self, views: Iterable[object]) -> Parts:
        """The first mip level and layer of each view; empty if all are 0."""
        parts = (
            tuple(self.parts.get(values.handle(view), (0, 0)) for view in views)
            if self.parts
            else ()
        )
        return parts if any(map(any, parts)) else ()

    def view(self, value: object) -> Image | None:
        """The image of a view."""
        return self.views.get(values.handle(value))

    # Memory.

    def on_AllocateMemory(self, call: Call) -> None:
        info = values.record(call.args.get("pAllocateInfo"))
        index = values.integer(info.get("memoryTypeIndex"))
        if index is not None:
            self.memory[values.handle(call.args.get("pMemory"))] = index

    def on_BindImageMemory(self, call: Call) -> None:
        for info in map(values.record, values.items(call.args.get("pBindInfos")) or [call.args]):
            image = self.images.get(values.handle(info.get("image")))
            index = self.memory.get(values.handle(info.get("memory")))
            flags = self.memory_flags(index) if image is not None and index is not None else None
            if image is not None and flags is not None:
                image.tree["memory"] = flags

    on_BindImageMemory2 = on_BindImageMemory

    # Swapchains.

    def on_CreateSwapchain(self, call: Call) -> None:
        info = values.record(call.args.get("pCreateInfo"))
        extent = values.record(info.get("imageExtent"))
        structure = {
            "format": info.get("imageFormat"),
            "samples": 1,
            "usage": info.get("imageUsage"),
            "extent": {**extent, "depth": 1} if extent else None,
            "mipLevels": 1,
            "arrayLayers": info.get("imageArrayLayers"),
            "imageType": "2D",
            "sharingMode": info.get("imageSharingMode"),
        }
        tree = to_tree(ImageRecord, structure)
        handle = values.handle(call.args.get("pSwapchain"))
        self.swapchains[handle] = Swapchain(
            call, next(self.numbers[Swapchain]), {**tree, "presentable": True}
        )
        self.frames.presents = True

    def on_DestroySwapchain(self, call: Call) -> None:
        swapchain = self.swapchains.pop(values.handle(call.args.get("swapchain")), None)
        for handle, image in (
            zip(swapchain.handles, swapchain.images, strict=True) if swapchain is not None else ()
        ):
            if self.images.get(handle) is image:
                self._forget(handle)

    def on_GetSwapchainImages(self, call: Call) -> None:
        swapchain = self.swapchains.get(values.handle(call.args.get("swapchain")))
        if swapchain is not None:
            self.add_swapchain_images(
                swapchain, values.items(call.args.get("pSwapchainImages")), call
            )

    def add_swapchain_images(
        self, swapchain: Swapchain, handles: list[object], call: Call, shared: bool = False
    ) -> None:
        """Adds the images of a swapchain that are not known yet."""
        for item in handles[:64]:
            handle = values.handle(item)
            existing = self.images.get(handle)
            if existing is not None and existing.swapchain is swapchain:
                continue
            image = Image(call, len(swapchain.images), dict(swapchain.tree))
            image.by, image.at = swapchain.by, swapchain.at
            image.swapchain = swapchain
            image.may_be_read = shared
            swapchain.images.append(image)
            swapchain.handles.append(handle)
            self._add(handle, image)

    def on_QueuePresent(self, call: Call) -> None:
        info = values.record(call.args.get("pPresentInfo"))
        indices = values.items(info.get("pImageIndices"))
        for swapchain_handle, index in zip(
            values.items(info.get("pSwapchains")), indices, strict=False
        ):
            swapchain = self.swapchains.get(values.handle(swapchain_handle))
            number = values.integer(index)
            if swapchain is not None and number is not None and 0 <= number < len(swapchain.images):
                self.frames.add(self._present(swapchain.images[number], call), call.at)
        self.frames.end_of_present()

    def _present(self, image: Image, call: Call) -> Submission:
        """The present of an image, one object for all of its presents."""
        if image.present is None:
            image.present = Submission([self.commands.command("present", image, call)])
        present: Submission = image.present
        return present

    def on_FrameBoundaryANDROID(self, call: Call) -> None:
        self.frames.mark("frame")
