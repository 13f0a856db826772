"""Names of objects in a description: their debug name, otherwise their kind and number."""

from __future__ import annotations

from collections.abc import Hashable

from .objects import CapturedObject, Framebuffer, Image, RenderPass


class Names:
    """Assigns names that are unique within a kind. An object has the same name in all documents of a capture."""

    def __init__(self) -> None:
        self._of: dict[Hashable, str] = {}
        self._taken: set[tuple[str, str]] = set()

    def of(self, kind: str, created: CapturedObject) -> str:
        """The name of a render pass or a pipeline."""
        return self._name(kind, (kind, created), created.label or f"{kind}_{created.number}")

    def image(self, image: Image) -> str:
        """The name of an image; swapchain images are numbered within their swapchain."""
        plain = f"image_{image.number}"
        if image.swapchain is not None:
            plain = f"{image.swapchain.label or f'swapchain_{image.swapchain.number}'}_{image.number}"
        return self._name("image", ("image", image), image.label or plain)

    def framebuffer(self, framebuffer: Framebuffer, images: tuple[Image | None, ...], render_pass: RenderPass) -> str:
        """The name of a framebuffer with these images; an imageless framebuffer can have several sets."""
        plain = framebuffer.label or f"framebuffer_{framebuffer.number}"
        return self._name("framebuffer", ("framebuffer", framebuffer, images, render_pass), plain)

    def _name(self, kind: str, key: Hashable, base: str) -> str:
        if key not in self._of:
            name, number = base, 1
            while (kind, name) in self._taken:
                number += 1
                name = f"{base}_{number}"
            self._taken.add((kind, name))
            self._of[key] = name
        return self._of[key]
