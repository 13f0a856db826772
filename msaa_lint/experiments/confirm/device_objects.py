"""Vulkan objects that live as long as what was built from a plan."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .opening import OpenDevice


class DeviceObjects:
    """Objects created on an open device. `close` destroys all of them, the last one first."""

    def __init__(self, opened: OpenDevice) -> None:
        self.opened = opened
        self.vk = opened.vk
        self._created: list[tuple[Callable[..., None], Any]] = []

    def own(self, destroy: Callable[..., None], handle: Any) -> Any:
        """Registers a handle to be destroyed with the others, and returns it."""
        self._created.append((destroy, handle))
        return handle

    def close(self) -> None:
        """Destroys everything, the last one first."""
        while self._created:
            destroy, handle = self._created.pop()
            destroy(self.opened.handle, handle, None)
