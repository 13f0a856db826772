"""Vulkan instances and logical devices as context managers.

A process can have only one debug messenger at a time: the package `vulkan` has a single callback
for all of them.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from types import TracebackType
from typing import Any, NamedTuple

from .binding import (
    chain,
    extensions,
    instance_version,
    layers,
    load,
    packed,
    physical_name,
    procedure,
    text,
)
from .vulkan_errors import Unusable, VulkanError

DRIVER = (
    "the Vulkan loader finds no driver: install one; on Debian run `apt install "
    "mesa-vulkan-drivers`, which needs no GPU"
)
LAYER = "the layer {} is not installed{}"
PACKAGES = {
    "VK_LAYER_KHRONOS_validation": "vulkan-validationlayers",
    "VK_LAYER_LUNARG_gfxreconstruct": "gfxreconstruct",
}
"""The Debian packages of layers."""


class Message(NamedTuple):
    """A message of a layer, the loader or a driver. `severity` is error, warning, info or verbose;
    `id` is the name of the message id.
    """

    severity: str
    id: str
    text: str
    number: int


Sink = Callable[[Message], None]

_SEVERITIES = {0x1000: "error", 0x100: "warning", 0x10: "info", 0x1: "verbose"}
_listening = False


class Instance:
    """A Vulkan instance: `with Instance() as instance:`. It is destroyed at the end, with its
    messenger.

    `layers` and `extensions` are enabled; `on_message` receives messages of the `severities`;
    `following` are structures for pNext, such as VkValidationFeaturesEXT; `api` is the highest
    version to request. An exception in `on_message` cannot pass through the C code and is stored in
    `sink_error`. Unusable if a layer or every driver is missing.
    """

    def __init__(
        self,
        layers: Sequence[str] = (),
        extensions: Iterable[str] = (),
        on_message: Sink | None = None,
        severities: Sequence[str] = ("error", "warning"),
        following: Sequence[Any] = (),
        api: tuple[int, int] = (1, 3),
    ) -> None:
        self.vk = load()
        self.layers = tuple(layers)
        self.version = min(api, instance_version()[:2])
        self.sink_error: BaseException | None = None
        self.refuses = False
        """Whether the layer keeps commands that it reports an error about from the driver."""
        self._sink = on_message
        self._severities = sum(bit for bit, name in _SEVERITIES.items() if name in severities)
        self._extensions = dict.fromkeys(extensions)
        self._following = list(following)
        self._messenger: Any = None
        self.handle: Any = None

    def __enter__(self) -> Instance:
        global _listening
        vk = self.vk
        self._look_for_layers()
        flags = 0
        if "VK_KHR_portability_enumeration" in extensions():
            # The loader hides MoltenVK without it.
            self._extensions["VK_KHR_portability_enumeration"] = None
            flags = 1
        if self._sink is not None:
            if _listening:
                raise RuntimeError(
                    "there is already a debug messenger, and the package has a single callback"
                )
            self._extensions["VK_EXT_debug_utils"] = None
            self._following.append(self._messenger_info())
        application = vk.VkApplicationInfo(
            pApplicationName="msaa-lint", apiVersion=packed(0, *self.version, 0)
        )
        create = vk.VkInstanceCreateInfo(
            flags=flags,
            pApplicationInfo=application,
            ppEnabledLayerNames=self.layers,
            ppEnabledExtensionNames=list(self._extensions),
        )
        _listening = self._sink is not None
        try:
            self.handle = vk.vkCreateInstance(chain(create, *self._following), None)
            if self._sink is not None:
                make = procedure(self.handle, "vkCreateDebugUtilsMessengerEXT")
                self._messenger = make(self.handle, self._messenger_info(), None)
        except VulkanError as error:
            self._close()
            if error.result == -9:
                raise Unusable(no_driver()) from None
            raise
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._close()

    def _close(self) -> None:
        global _listening
        if self.handle is not None:
            if self._messenger is not None:
                procedure(self.handle, "vkDestroyDebugUtilsMessengerEXT")(
                    self.handle, self._messenger, None
                )
            self.vk.vkDestroyInstance(self.handle, None)
        self.handle = self._messenger = None
        if self._sink is not None:
            _listening = False

    def _look_for_layers(self) -> None:
        there = layers() if self.layers else {}
        for name in self.layers:
            if name not in there:
                package = (
                    f"; on Debian run `apt install {PACKAGES[name]}`" if name in PACKAGES else ""
                )
                raise Unusable(LAYER.format(name, package))

    def _messenger_info(self) -> Any:
        vk = self.vk
        return vk.VkDebugUtilsMessengerCreateInfoEXT(
            messageSeverity=self._severities,
            messageType=7,
            pfnUserCallback=self._told,
            pUserData=None,
        )

    def _told(self, severity: int, kinds: int, data: Any, user: Any) -> int:
        try:
            assert self._sink is not None
            agreement = Message(
                _SEVERITIES.get(severity, "error"),
                text(data.pMessageIdName),
                text(data.pMessage),
                data.messageIdNumber,
            )
            self._sink(agreement)
        except BaseException as error:
            self.sink_error = self.sink_error or error
        return int(self.refuses and _SEVERITIES.get(severity) == "error")

    def physical_devices(self) -> list[Any]:
        """The handles of the physical devices. Unusable if there is none."""
        try:
            found = list(self.vk.vkEnumeratePhysicalDevices(self.handle))
        except VulkanError as error:
            if error.result != -3:
                raise
            found = []
        if not found:
            raise Unusable(no_driver())
        return found


def no_driver() -> str:
    """The message that there is no driver, with the setting that may be the cause."""
    for name in (
        "VK_DRIVER_FILES",
        "VK_ICD_FILENAMES",
        "VK_LOADER_DRIVERS_SELECT",
        "VK_LOADER_DRIVERS_DISABLE",
    ):
        if os.environ.get(name):
            return f"{DRIVER} ({name} is set: {os.environ[name][:200]})"
    return DRIVER


class Device:
    """A logical device with one queue of the first family that supports all of `queue`
    (VkQueueFlagBits, graphics by default).

    `with Device(physical) as device:`; at the end it becomes idle and is destroyed. `features` is a
    VkPhysicalDeviceFeatures2 with chained structures, or a VkPhysicalDeviceFeatures. Unusable if no
    family supports them.
    """

    def __init__(
        self, physical: Any, extensions: Iterable[str] = (), features: Any = None, queue: int = 1
    ) -> None:
        self.vk = load()
        self.physical = physical
        families = list(self.vk.vkGetPhysicalDeviceQueueFamilyProperties(physical))
        self.family = next(
            (n for n, each in enumerate(families) if each.queueFlags & queue == queue), -1
        )
        if self.family < 0:
            raise Unusable(f"{physical_name(physical)} has no queue that can draw")
        self.timestamp_bits: int = families[self.family].timestampValidBits
        self._extensions = list(extensions)
        self._features = features
        self.handle: Any = None
        self.queue: Any = None

    def __enter__(self) -> Device:
        vk = self.vk
        queue = vk.VkDeviceQueueCreateInfo(queueFamilyIndex=self.family, pQueuePriorities=[1.0])
        old = (
            self._features is not None
            and vk.ffi.typeof(self._features).cname == "VkPhysicalDeviceFeatures"
        )
        create = vk.VkDeviceCreateInfo(
            pNext=None if old else self._features,
            pQueueCreateInfos=[queue],
            ppEnabledExtensionNames=self._extensions,
            pEnabledFeatures=self._features if old else None,
        )
        self.handle = vk.vkCreateDevice(self.physical, create, None)
        self.queue = vk.vkGetDeviceQueue(self.handle, self.family, 0)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self.handle is not None:
            # A lost device can still be destroyed.
            with suppress(VulkanError):
                self.vk.vkDeviceWaitIdle(self.handle)
            self.vk.vkDestroyDevice(self.handle, None)
            self.handle = None

    def procedure(self, name: str) -> Callable[..., Any]:
        """A function of the device, core or of an enabled extension."""
        return procedure(self.handle, name, device=True)
