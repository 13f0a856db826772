"""What the objects of a capture are called in a description: as the application named them, else by their number."""

from __future__ import annotations

from collections.abc import Hashable

from .objects import Created, Framebuffer, Image, RenderPass


class Names:
    """Names, each used once among its kind. An object keeps its name in all documents of a capture."""

    def __init__(self) -> None:
        self._of: dict[Hashable, str] = {}
        self._taken: set[tuple[str, str]] = set()

    def of(self, kind: str, made: Created) -> str:
        """The name of a render pass or a pipeline."""
        return self._name(kind, (kind, made), made.label or f"{kind}_{made.number}")

    def image(self, image: Image) -> str:
        """The name of an image; of a swapchain's by its index in it."""
        plain = f"image_{image.number}"
        if image.swapchain is not None:
            plain = f"{image.swapchain.label or f'swapchain_{image.swapchain.number}'}_{image.number}"
        return self._name("image", ("image", image), image.label or plain)

    def framebuffer(self, framebuffer: Framebuffer, images: tuple[Image | None, ...], render_pass: RenderPass) -> str:
        """The name of a framebuffer with some images: one without images of its own is begun with several sets."""
        plain = framebuffer.label or f"framebuffer_{framebuffer.number}"
        return self._name("framebuffer", ("framebuffer", framebuffer, images, render_pass), plain)

    def _name(self, kind: str, key: Hashable, wanted: str) -> str:
        if key not in self._of:
            name, number = wanted, 1
            while (kind, name) in self._taken:
                number += 1
                name = f"{wanted}_{number}"
            self._taken.add((kind, name))
            self._of[key] = name
        return self._of[key]
