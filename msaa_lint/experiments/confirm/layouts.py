"""The current layouts of the images of a frame, and the barriers that confirm adds between its
steps.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .build import FrameObjects
from .parts import (
    COLOR,
    COLOR_LAYOUT,
    DEPTH,
    DEPTH_LAYOUT,
    DEPTH_READ_LAYOUT,
    GENERAL,
    PRESENT_LAYOUT,
    READ_LAYOUT,
    SOURCE_LAYOUT,
    STENCIL,
    TARGET_LAYOUT,
    UNDEFINED,
)

TRANSFER, COLOR_OUTPUT, TESTS, SHADERS = 0x1000, 0x400, 0x300, 0x880
EVERYTHING = TRANSFER | COLOR_OUTPUT | TESTS | SHADERS
MEMORY = 0x18000
"""VkPipelineStageFlagBits; VkAccessFlagBits' memory reads and writes."""

USES = {
    COLOR_LAYOUT: (COLOR_OUTPUT, 0x180),
    DEPTH_LAYOUT: (TESTS, 0x600),
    DEPTH_READ_LAYOUT: (TESTS | SHADERS, 0x220),
    READ_LAYOUT: (SHADERS, 0x20),
    SOURCE_LAYOUT: (TRANSFER, 0x800),
    TARGET_LAYOUT: (TRANSFER, 0x1000),
    UNDEFINED: (0x1, 0),
    PRESENT_LAYOUT: (0x2000, 0),
}
"""The stages and accesses that use an image, by layout; all of them for other layouts."""

READING = (DEPTH_READ_LAYOUT, READ_LAYOUT)

LayoutRequest = tuple[int, int, int | None]
"""An image, the required layout, and that of stencil if it differs."""


class Layouts:
    """The layout of every aspect of every image."""

    def __init__(self, built: FrameObjects) -> None:
        self.built = built
        self.vk = built.vk
        self.known: dict[tuple[int, int], int] = {}

    def now(self, image: int, aspect: int) -> int:
        """The layout of an aspect."""
        return self.known.get((image, aspect), UNDEFINED)

    def left(self, image: int, layout: int, stencil: int | None = None) -> None:
        """Notes the layout in which a pass or a barrier of the frame leaves an image."""
        for aspect in self._aspects(image):
            self.known[image, aspect] = (
                stencil if stencil is not None and aspect == STENCIL else layout
            )

    def into(self, buffer: Any, requests: Sequence[LayoutRequest]) -> None:
        """Records the barriers that transition images to the requested layouts. UNDEFINED requests
        nothing.
        """
        through_general: list[LayoutRequest] = [
            (image, GENERAL, None)
            for image, layout, _ in requests
            if self._blank(image) and layout in READING
        ]
        if through_general:
            self._barrier(buffer, through_general)
        self._barrier(buffer, requests)

    def fence(self, buffer: Any) -> None:
        """Records a full barrier between everything before and everything after."""
        barrier = self.vk.VkMemoryBarrier(srcAccessMask=MEMORY, dstAccessMask=MEMORY)
        self.vk.vkCmdPipelineBarrier(
            buffer, EVERYTHING, EVERYTHING, 0, 1, [barrier], 0, None, 0, None
        )

    def _blank(self, image: int) -> bool:
        return all(self.now(image, aspect) == UNDEFINED for aspect in self._aspects(image))

    def _aspects(self, image: int) -> list[int]:
        return [
            aspect
            for aspect in (COLOR, DEPTH, STENCIL)
            if self.built.plan.images[image].aspects & aspect
        ]

    def _barrier(self, buffer: Any, requests: Sequence[LayoutRequest]) -> None:
        vk = self.vk
        barriers, before, after = [], 0, 0
        for image, layout, stencil in requests:
            moves: dict[tuple[int, int], int] = {}
            for aspect in self._aspects(image):
                new_layout = stencil if stencil is not None and aspect == STENCIL else layout
                old = self.now(image, aspect)
                if new_layout not in (UNDEFINED, old):
                    moves[old, new_layout] = moves.get((old, new_layout), 0) | aspect
                    self.known[image, aspect] = new_layout
            for (old, new), aspects in moves.items():
                old_stages, old_access = USES.get(old, (EVERYTHING, MEMORY))
                new_stages, new_access = USES.get(new, (EVERYTHING, MEMORY))
                before, after = before | old_stages, after | new_stages
                barriers.append(
                    vk.VkImageMemoryBarrier(
                        srcAccessMask=old_access, dstAccessMask=new_access, oldLayout=old,
                        newLayout=new,
                        srcQueueFamilyIndex=0xFFFFFFFF, dstQueueFamilyIndex=0xFFFFFFFF,
                        image=self.built.image(image),
                        subresourceRange=vk.VkImageSubresourceRange(aspectMask=aspects,
                        levelCount=0xFFFFFFFF, layerCount=0xFFFFFFFF),
                    )
                )  # fmt: skip
        if barriers:
            vk.vkCmdPipelineBarrier(
                buffer,
                before or EVERYTHING,
                after or EVERYTHING,
                0,
                0,
                None,
                0,
                None,
                len(barriers),
                barriers,
            )
