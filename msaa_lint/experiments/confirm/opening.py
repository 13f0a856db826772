"""A device opened for plans: the instance with the validation layer and its messages, and logical
devices with what plans need.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from . import binding
from .binding import chain, extensions, layers, load, procedure
from .devices import describe
from .instance import Device, Instance, Message, no_driver
from .parts import Plan
from .scene import VERTEX_BYTES, vertices
from .shader_features import ENABLED
from .shaders.spirv import read
from .vulkan_errors import Unusable, VulkanError

Emit = Callable[[dict[str, Any]], None]

VALIDATION = "VK_LAYER_KHRONOS_validation"
BEST_PRACTICES = "VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT"
VENDOR_CHECKS = "VALIDATION_CHECK_ENABLE_VENDOR_SPECIFIC_"
ENABLES = "VK_LAYER_ENABLES"
"""The checks of vendors can only be enabled by the environment; the separator on Linux is a
colon.
"""

EXTENSIONS = (
    "VK_KHR_swapchain", "VK_EXT_extended_dynamic_state3", "VK_EXT_load_store_op_none",
    "VK_KHR_load_store_op_none",
    "VK_KHR_create_renderpass2", "VK_KHR_depth_stencil_resolve", "VK_KHR_multiview",
    "VK_KHR_maintenance2", "VK_KHR_dynamic_rendering",
    "VK_KHR_synchronization2", "VK_KHR_separate_depth_stencil_layouts",
    "VK_EXT_rasterization_order_attachment_access",
    "VK_GOOGLE_decorate_string", "VK_GOOGLE_hlsl_functionality1", "VK_GOOGLE_user_type",
    "VK_KHR_shader_non_semantic_info",
)  # fmt: skip
"""Enabled if offered; extensions that were promoted only below the version of Vulkan that includes
them.
"""

TAKEN_UP = {
    "VK_KHR_create_renderpass2": (1, 2), "VK_KHR_depth_stencil_resolve": (1, 2),
    "VK_KHR_multiview": (1, 1),
    "VK_KHR_maintenance2": (1, 1), "VK_KHR_dynamic_rendering": (1, 3),
    "VK_KHR_synchronization2": (1, 3),
    "VK_KHR_separate_depth_stencil_layouts": (1, 2), "VK_KHR_shader_non_semantic_info": (1, 3),
}  # fmt: skip

NOT_ENABLED = ("robustBufferAccess",)
"""Features of VkPhysicalDeviceFeatures that are not enabled although offered: they cost time, and
no pipeline needs them.
"""

STAGES, ACCESSES = 0x7F0001FFFF, 0x70001FFFF
"""The bits of VkPipelineStageFlags2 and VkAccessFlags2 of Vulkan's core; the others need
extensions.
"""

FEATURE_STAGES = {"geometryShader": 0x40, "tessellationShader": 0x30}
"""The stages of VkPipelineStageFlags2 that need a feature."""

FORMAT_USAGES = {"attachment": 0, "sampled": 0x4, "storage": 0x8, "input": 0x80, "transient": 0x40}
"""Usages, in addition to attachment, for which the sample counts of formats are queried."""

VERTEX_BUFFER, VISIBLE, DEVICE_MEMORY = 0x80, 0x6, 0x7
"""VK_BUFFER_USAGE_VERTEX_BUFFER_BIT; host-visible and coherent memory, also of the device, of
VkMemoryPropertyFlagBits.
"""

MAX_FORMAT = 185
"""The formats of Vulkan 1.0 are numbered from 1 to this."""


class Session:
    """An instance and one of its physical devices; one per process. `emit` receives the messages of
    the layer.

    `name` is a part of the device's name (None: the first CPU device, otherwise the first device);
    `validation` enables the validation layer if it is installed; `vendors` are those whose checks
    it makes. Unusable if there is no such device.
    """

    def __init__(
        self,
        name: str | None = None,
        validation: bool = True,
        vendors: Iterable[str] = ("arm", "img"),
    ) -> None:
        self.vk = load()
        self.vendors = tuple(vendors)
        self.at: int | None = None
        self.image: str | None = None
        self.emit: Emit | None = None
        self._waiting: list[Message] = []
        self._deaf = False
        self._devices: dict[tuple[Any, ...], OpenDevice] = {}
        there = layers() if validation else {}
        self.layer: dict[str, Any] | None = None
        if VALIDATION in there:
            version = ".".join(map(str, there[VALIDATION]))
            self.layer = {"name": VALIDATION, "version": version, "vendors": list(self.vendors)}
        with self.unheard():
            self.instance = self._instance()
            try:
                self.physical = self._chosen(name)
                self.device: dict[str, Any] = {
                    **describe(self.physical),
                    "formats": formats(self.physical),
                }
            except BaseException:
                self.instance.__exit__(None, None, None)
                raise
        self.names = frozenset(each["extensionName"] for each in self.device["extensions"])
        self.version = min(
            binding.version_of(self.device["properties"]["apiVersion"])[:2], self.instance.version
        )

    def _instance(self) -> Instance:
        wanted = [name for name in ("VK_KHR_surface",) if name in extensions()]
        following = []
        if self.layer is not None:
            # Best practices are enabled by a structure; the environment may enable more.
            checks = [BEST_PRACTICES, *(VENDOR_CHECKS + vendor.upper() for vendor in self.vendors)]
            stated = os.environ.get(ENABLES, "")
            os.environ[ENABLES] = ":".join(
                dict.fromkeys([*filter(None, stated.split(":")), *checks])
            )
            if "VK_EXT_validation_features" in extensions(VALIDATION):
                wanted.append("VK_EXT_validation_features")
                following.append(self.vk.VkValidationFeaturesEXT(pEnabledValidationFeatures=[2]))
        made = Instance(
            (VALIDATION,) if self.layer is not None else (), wanted, self._said, following=following
        )
        return made.__enter__()

    def _said(self, message: Message) -> None:
        if self._deaf:
            return
        if self.emit is None:
            self._waiting.append(message)
        else:
            about = {"pass": self.at, "image": self.image}
            self.emit(
                {
                    "event": "message",
                    **about,
                    "id": message.id,
                    "severity": message.severity,
                    "text": message.text[:4000],
                }
            )

    def telling(self, emit: Emit) -> None:
        """Sends the messages of the layer to `emit`, including those it sent earlier."""
        self.emit = emit
        waiting, self._waiting = self._waiting, []
        for message in waiting:
            self._said(message)

    @contextmanager
    def unheard(self) -> Iterator[None]:
        """A block whose messages are ignored. What it creates is shared by all plans, and the
        messages are about none of them: as those of the first one, they would depend on the order
        of plans.
        """
        self._deaf, before = True, self._deaf
        try:
            yield
        finally:
            self._deaf = before

    @contextmanager
    def refused(self) -> Iterator[bool]:
        """A block whose commands the layer checks and, where it reports an error, does not pass to
        the driver. False if the layer is not heard: nothing may be called then.
        """
        self.instance.refuses = True
        try:
            yield self.layer is not None and not self._deaf
        finally:
            self.instance.refuses = False

    @contextmanager
    def about(self, image: str) -> Iterator[None]:
        """A block in which messages are about an image."""
        self.image, before = image, self.image
        try:
            yield
        finally:
            self.image = before

    def _chosen(self, name: str | None) -> Any:
        found = self.instance.physical_devices()
        properties = [self.vk.vkGetPhysicalDeviceProperties(each) for each in found]
        if name is None:
            cpu = self.vk.VK_PHYSICAL_DEVICE_TYPE_CPU
            return next(
                (
                    each
                    for each, its in zip(found, properties, strict=True)
                    if its.deviceType == cpu
                ),
                found[0],
            )
        names = [binding.text(its.deviceName) for its in properties]
        for device, its in zip(found, names, strict=True):
            if name.casefold() in its.casefold():
                return device
        raise Unusable(
            f"there is no device named {name}; the devices are {', '.join(names)}"
            if names
            else no_driver()
        )

    def opened(self, plan: Plan) -> OpenDevice:
        """A logical device with what a plan needs, shared by plans with the same needs."""
        key = (tuple(name for name in plan.extensions if name in self.names), plan.without)
        if key not in self._devices:
            with self.unheard():
                self._devices[key] = OpenDevice(self, *key)
        return self._devices[key]

    def close(self) -> None:
        """Destroys everything."""
        for each in self._devices.values():
            each.close()
        self._devices.clear()
        self.instance.__exit__(None, None, None)


class OpenDevice:
    """A logical device and the objects that live as long as it: shader modules, layouts."""

    def __init__(
        self, session: Session, special: tuple[str, ...], without: tuple[str, ...]
    ) -> None:
        self.vk = vk = session.vk
        self.session = session
        wanted = [
            name
            for name in EXTENSIONS
            if name in session.names and session.version < TAKEN_UP.get(name, (9, 9))
        ]
        if "VK_KHR_surface" not in extensions() and "VK_KHR_swapchain" in wanted:
            wanted.remove("VK_KHR_swapchain")
        if "VK_EXT_load_store_op_none" in wanted and "VK_KHR_load_store_op_none" in wanted:
            # The same extension under two names; old layers do not know the second one.
            wanted.remove("VK_KHR_load_store_op_none")
        self.extensions = frozenset((*wanted, *special))
        self.device = Device(
            session.physical, sorted(self.extensions), self._features(special, without)
        )
        self.device.__enter__()
        self.handle = self.device.handle
        self.queue = self.device.queue
        self.memory = vk.vkGetPhysicalDeviceMemoryProperties(session.physical)
        self.modules: dict[Any, Any] = {}
        self.resources: DeviceObjects | None = None
        """What the descriptors of shaders refer to (shader_resources.py)."""
        self.meshes: DeviceObjects | None = None
        """The vertex buffers of meshes (mesh_buffers.py)."""
        self._layouts: dict[str, Any] = {}
        self._functions: dict[str, Callable[..., Any]] = {}
        self._vertices: tuple[Any, Any] | None = None

    def _features(self, special: tuple[str, ...], without: tuple[str, ...]) -> Any:
        vk, offered = self.vk, self.session.device
        own = {
            name: 1
            for name, there in offered["features"].items()
            if there and name not in (*NOT_ENABLED, *without)
        }
        following = []
        for structure, names in {
            "VkPhysicalDeviceVulkan11Features": ENABLED["VkPhysicalDeviceVulkan11Features"],
            "VkPhysicalDeviceVulkan12Features": {
                *ENABLED["VkPhysicalDeviceVulkan12Features"],
                "separateDepthStencilLayouts",
                "imagelessFramebuffer",
            },
            "VkPhysicalDeviceVulkan13Features": {
                *ENABLED["VkPhysicalDeviceVulkan13Features"],
                "dynamicRendering",
                "synchronization2",
            },
            "VkPhysicalDeviceExtendedDynamicState3FeaturesEXT": (
                "extendedDynamicState3RasterizationSamples",
                "extendedDynamicState3SampleMask",
                "extendedDynamicState3AlphaToCoverageEnable",
            ),
            "VkPhysicalDeviceMultisampledRenderToSingleSampledFeaturesEXT": (
                "multisampledRenderToSingleSampled",
            ),
        }.items():
            if (
                structure.endswith("SampledFeaturesEXT")
                and "VK_EXT_multisampled_render_to_single_sampled" not in special
            ):
                continue
            found = {name: 1 for name in names if offered.get(structure, {}).get(name)}
            if found:
                following.append(getattr(vk, structure)(**found))
        core = vk.VkPhysicalDeviceFeatures(**own)
        if self.session.version < (1, 1):
            return core
        if self.session.version < (1, 3) and "VK_KHR_dynamic_rendering" in self.extensions:
            following.append(vk.VkPhysicalDeviceDynamicRenderingFeatures(dynamicRendering=1))
        return chain(vk.VkPhysicalDeviceFeatures2(features=core), *following)

    def masks(self, stages: int, accesses: int) -> tuple[int, int]:
        """Stages and accesses of a barrier without those that the device lacks, in which no work
        can be waited for.
        """
        features = self.session.device["features"]
        lacking = sum(bits for name, bits in FEATURE_STAGES.items() if not features.get(name))
        return stages & STAGES & ~lacking, accesses & ACCESSES

    def call(self, name: str) -> Callable[..., Any]:
        """A function of the device, core or of an extension. VulkanError if it has neither."""
        if name not in self._functions:
            core = self.session.version >= SINCE.get(name, (1, 0)) and not name.endswith("EXT")
            found = getattr(self.vk, name, None) if core and binding.has(name) else None
            if found is None:
                found = procedure(
                    self.handle, name if name.endswith("EXT") else f"{name}KHR", device=True
                )
            self._functions[name] = found
        return self._functions[name]

    def module(self, shader: str, outputs: tuple[str, ...] | None = None) -> Any:
        """The module of a built-in shader; for a fragment shader, with only the kinds of outputs in
        `outputs`.
        """
        key = (shader, outputs)
        if key not in self.modules:
            with self.session.unheard():
                self.modules[key] = self.compiled(read(shader, outputs))
        return self.modules[key]

    def compiled(self, code: bytes) -> Any:
        """A module of SPIR-V."""
        return self.vk.vkCreateShaderModule(
            self.handle, self.vk.VkShaderModuleCreateInfo(codeSize=len(code), pCode=code), None
        )

    def layout(self, kind: str) -> tuple[Any, Any]:
        """The pipeline layout of `scene`, `shaded`, `read` or `samples`, and its descriptor set
        layout, if any.
        """
        if kind not in self._layouts:
            with self.session.unheard():
                self._layouts[kind] = self._new_layout(kind)
        found: tuple[Any, Any] = self._layouts[kind]
        return found

    def _new_layout(self, kind: str) -> tuple[Any, Any]:
        vk = self.vk
        stage = {"scene": 1, "shaded": 16, "read": 16, "samples": 32}[kind]
        bindings = []
        if kind != "scene":
            bindings.append(
                vk.VkDescriptorSetLayoutBinding(
                    binding=0, descriptorType=1, descriptorCount=1, stageFlags=stage
                )
            )
        if kind == "samples":
            bindings.append(
                vk.VkDescriptorSetLayoutBinding(
                    binding=1, descriptorType=7, descriptorCount=1, stageFlags=stage
                )
            )
        sets = []
        if bindings:
            sets.append(
                vk.vkCreateDescriptorSetLayout(
                    self.handle, vk.VkDescriptorSetLayoutCreateInfo(pBindings=bindings), None
                )
            )
        pushed = (
            [vk.VkPushConstantRange(stageFlags=1 if kind == "shaded" else stage, offset=0, size=16)]
            if kind != "samples"
            else []
        )
        if kind == "shaded":
            pushed.append(vk.VkPushConstantRange(stageFlags=stage, offset=16, size=16))
        create = vk.VkPipelineLayoutCreateInfo(pSetLayouts=sets, pPushConstantRanges=pushed)
        return vk.vkCreatePipelineLayout(self.handle, create, None), sets[0] if sets else None

    def vertices(self) -> tuple[Any, int]:
        """A buffer with the scene's vertices, and their number."""
        if self._vertices is None:
            with self.session.unheard():
                self._vertices = self.buffer(vertices())
        return self._vertices[0], len(vertices()) // VERTEX_BYTES

    def buffer(
        self, data: bytes, usage: int = VERTEX_BUFFER, properties: int = VISIBLE
    ) -> tuple[Any, Any]:
        """A buffer with data, and its memory, with the VkMemoryPropertyFlagBits `properties` if
        there is such memory. The caller must destroy them.
        """
        vk = self.vk
        buffer = vk.vkCreateBuffer(
            self.handle, vk.VkBufferCreateInfo(size=len(data), usage=usage), None
        )
        needs = vk.vkGetBufferMemoryRequirements(self.handle, buffer)
        kind = self.memory_type(needs.memoryTypeBits, properties, VISIBLE)
        memory = vk.vkAllocateMemory(
            self.handle,
            vk.VkMemoryAllocateInfo(allocationSize=needs.size, memoryTypeIndex=kind),
            None,
        )
        vk.vkBindBufferMemory(self.handle, buffer, memory, 0)
        vk.vkMapMemory(self.handle, memory, 0, len(data), 0)[:] = data
        vk.vkUnmapMemory(self.handle, memory)
        return buffer, memory

    def memory_type(self, bits: int, *wishes: int) -> int:
        """The first memory type in `bits` with the properties of the first mask that any type
        satisfies.
        """
        memory = self.memory
        for wish in (*wishes, 0):
            for number in range(memory.memoryTypeCount):
                if bits >> number & 1 and memory.memoryTypes[number].propertyFlags & wish == wish:
                    return number
        raise VulkanError(-2, "vkAllocateMemory")

    def close(self) -> None:
        vk = self.vk
        for objects in (self.resources, self.meshes):
            if objects is not None:
                objects.close()
        for module in self.modules.values():
            vk.vkDestroyShaderModule(self.handle, module, None)
        for layout, own in self._layouts.values():
            vk.vkDestroyPipelineLayout(self.handle, layout, None)
            if own is not None:
                vk.vkDestroyDescriptorSetLayout(self.handle, own, None)
        if self._vertices is not None:
            vk.vkDestroyBuffer(self.handle, self._vertices[0], None)
            vk.vkFreeMemory(self.handle, self._vertices[1], None)
        self.device.__exit__(None, None, None)


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


SINCE = {
    "vkCreateRenderPass2": (1, 2), "vkCmdBeginRenderPass2": (1, 2), "vkCmdNextSubpass2": (1, 2),
    "vkCmdEndRenderPass2": (1, 2),
    "vkCmdBeginRendering": (1, 3), "vkCmdEndRendering": (1, 3), "vkCmdPipelineBarrier2": (1, 3),
}  # fmt: skip


def formats(physical: Any) -> dict[str, dict[str, int]]:
    """The supported formats by the VkFormat's number: `features` and `linear` are the
    VkFormatFeatureFlags of both tilings, `counts` the sample counts of attachments; `sampled`,
    `storage`, `input` and `transient` are those with the additional usage (0: unsupported).
    """
    vk = load()
    found = {}
    for number in range(1, MAX_FORMAT):
        features = vk.vkGetPhysicalDeviceFormatProperties(physical, number)
        own = {
            "features": features.optimalTilingFeatures,
            "linear": features.linearTilingFeatures,
            "buffer": features.bufferFeatures,
        }
        attachment = 0x10 if own["features"] & 0x80 else 0x20 if own["features"] & 0x200 else 0
        if attachment:
            for name, usage in FORMAT_USAGES.items():
                own["counts" if name == "attachment" else name] = _counts(
                    physical, number, attachment | usage
                )
        if attachment or own["features"]:
            found[str(number)] = own
    return found


def _counts(physical: Any, number: int, usage: int) -> int:
    try:
        counts: int = (
            load()
            .vkGetPhysicalDeviceImageFormatProperties(physical, number, 1, 0, usage, 0)
            .sampleCounts
        )
        return counts
    except VulkanError:
        return 0
