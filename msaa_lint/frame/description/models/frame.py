"""A whole description, the device that it is for, and what it states beside Vulkan's structures."""

from __future__ import annotations

from typing import Annotated, Literal

from ..members import (
    NO_ENTRIES,
    Format,
    MemoryProperties,
    PositiveNumber,
    ResolveModes,
    Samples,
    ShadingCost,
    Share,
    Size,
)
from ..record import Record
from .commands import RecordedCommand
from .metal import Metal
from .vulkan import Framebuffer, Image, Pipeline, RenderPass

VENDORS = (
    "arm",
    "img",
    "amd",
    "nvidia",
    "qualcomm",
    "apple",
    "intel",
    "broadcom",
    "samsung",
    "mesa",
    "khronos",
    "huawei",
)
Vendor = Annotated[str, ("caseless", VENDORS)]


class SampleCounts(Record):
    """The sample counts that a device supports: framebufferColorSampleCounts and its siblings."""

    color: tuple[Samples, ...] | None = None
    depth: tuple[Samples, ...] | None = None
    stencil: tuple[Samples, ...] | None = None
    integer: tuple[Samples, ...] | None = None


class Device(Record):
    """What a device supports; an absent member is unknown.

    The frame of a `captured` one was captured on it: `--profile` replaces it.
    """

    captured: bool | None = None
    name: str | None = None
    vendor: Vendor | None = None
    tiler: bool | None = None
    sampleCounts: SampleCounts | None = None
    memoryTypes: tuple[MemoryProperties, ...] | None = None
    depthResolveModes: ResolveModes | None = None
    stencilResolveModes: ResolveModes | None = None
    independentResolve: bool | None = None
    independentResolveNone: bool | None = None
    features: tuple[str, ...] | None = None
    extensions: tuple[str, ...] | None = None
    apiVersion: str | None = None
    maxEfficientSamples: Samples | None = None
    tile: dict[str, float | str] | None = None
    compression: dict[str, float] | None = None
    milliwattsPerGBps: PositiveNumber | None = None


class Enabled(Record):
    """What the application enables: VkApplicationInfo::apiVersion, VkDeviceCreateInfo's extensions
    and features.
    """

    apiVersion: str | None = None
    extensions: tuple[str, ...] | None = None
    features: tuple[str, ...] | None = None


ImpellerStorage = Literal["kHostVisible", "kDevicePrivate", "kDeviceTransient"]
ImpellerLoad = Literal["kDontCare", "kLoad", "kClear"]
ImpellerStore = Literal["kDontCare", "kStore", "kMultisampleResolve", "kStoreAndMultisampleResolve"]
ImpellerColorFormat = Literal[
    "kA8UNormInt",
    "kR8UNormInt",
    "kR8G8UNormInt",
    "kR8G8B8A8UNormInt",
    "kR8G8B8A8UNormIntSRGB",
    "kB8G8R8A8UNormInt",
    "kB8G8R8A8UNormIntSRGB",
    "kR32G32B32A32Float",
    "kR16G16B16A16Float",
    "kB10G10R10XR",
    "kB10G10R10XRSRGB",
    "kB10G10R10A10XR",
]
ImpellerDepthFormat = Literal["kS8UInt", "kD24UnormS8Uint", "kD32FloatS8UInt"]
ImpellerSampleCount = Literal[
    1,
    2,
    4,
    8,
    16,
    "kCount1",
    "kCount2",
    "kCount4",
    "kCount8",
    "kCount16",
    "k1",
    "k2",
    "k4",
    "k8",
    "k16",
]


class AttachmentConfig(Record):
    """Impeller's RenderTarget::AttachmentConfig."""

    storageMode: ImpellerStorage | None = None
    loadAction: ImpellerLoad | None = None
    storeAction: ImpellerStore | None = None
    clearColor: tuple[float, ...] | None = None


class AttachmentConfigMSAA(Record):
    """Impeller's RenderTarget::AttachmentConfigMSAA. With one sample per pixel,
    `resolveStorageMode` is unused.
    """

    storageMode: ImpellerStorage | None = None
    resolveStorageMode: ImpellerStorage | None = None
    loadAction: ImpellerLoad | None = None
    storeAction: ImpellerStore | None = None
    clearColor: tuple[float, ...] | None = None


class RenderTarget(Record):
    """Impeller's RenderTarget; it expands to what the engine creates from it."""

    api: Literal["vulkan", "metal"] | None = None
    onscreen: bool | None = None
    width: Size | None = None
    height: Size | None = None
    colorFormat: ImpellerColorFormat | None = None
    depthFormat: ImpellerDepthFormat | None = None
    sampleCount: ImpellerSampleCount | None = None
    enableStencil: bool | None = None
    colorAttachmentConfig: AttachmentConfigMSAA | None = None
    stencilAttachmentConfig: AttachmentConfig | None = None


class FrameSize(Record):
    """The frame size in pixels (by default that of the framebuffers) and the frame rate in frames
    per second, for cost estimates.

    `share` is the fraction of a program's frames that are like this one, if the documents of a file
    are the kinds of frame of one program.
    """

    width: Size | None = None
    height: Size | None = None
    fps: PositiveNumber | None = None
    share: Share | None = None


class Scene(Record):
    """What the picture needs; `study` simulates nothing else."""

    edges: bool | None = None
    depth: Literal["STANDARD", "REVERSED"] | None = None
    color: Literal["LDR", "HDR"] | None = None
    peak: PositiveNumber | None = None
    depthResolveWants: Literal["ANY", "NEAREST", "FARTHEST"] | None = None
    toneMapping: Literal["AFTER_RESOLVE", "IN_PASS", "NONE"] | None = None
    alphaTest: bool | None = None
    textureDetail: bool | None = None
    overdraw: PositiveNumber | None = None
    triangleSize: PositiveNumber | None = None
    shading: ShadingCost | None = None


SampleCountLimit = Literal[
    "framebufferColorSampleCounts",
    "framebufferDepthSampleCounts",
    "framebufferStencilSampleCounts",
    "framebufferNoAttachmentsSampleCounts",
    "framebufferIntegerColorSampleCounts",
    "sampledImageColorSampleCounts",
    "sampledImageIntegerSampleCounts",
    "sampledImageDepthSampleCounts",
    "sampledImageStencilSampleCounts",
    "storageImageSampleCounts",
]


class SampleCountTest(Record):
    """A test of the bit of one count in a mask, and the count that the branch selects."""

    tests: Samples | None = None
    gives: Samples | None = None


class SampleCountChoice(Record):
    """How a program selects its sample count: from which masks of VkPhysicalDeviceLimits, how
    combined, and which bit it takes.
    """

    limits: tuple[SampleCountLimit, ...] | None = None
    combined: Literal["AND", "OR", "MIN", "MAX", "LOGICAL_AND", "LOGICAL_OR", "NONE"] | None = None
    chosen: Literal["MAXIMUM", "ATMOST"] | None = None
    atMost: Samples | None = None
    tests: tuple[SampleCountTest, ...] = ()
    formats: tuple[Format, ...] | None = None


class Description(Record):
    """A frame, or part of one. Every member is optional."""

    frame: FrameSize | None = None
    device: Device | str | None = None
    enabled: Enabled | None = None
    images: dict[str, Image] = NO_ENTRIES
    renderPasses: dict[str, RenderPass] = NO_ENTRIES
    framebuffers: dict[str, Framebuffer] = NO_ENTRIES
    pipelines: dict[str, Pipeline] = NO_ENTRIES
    commands: tuple[RecordedCommand, ...] | None = None
    scene: Scene | None = None
    metal: Metal | None = None
    sampleCountChoices: dict[str, SampleCountChoice] = NO_ENTRIES
    renderTargets: dict[str, RenderTarget] = NO_ENTRIES
