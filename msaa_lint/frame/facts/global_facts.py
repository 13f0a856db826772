"""What holds for the whole frame: its size, the device, what the application enables, the scene."""

from __future__ import annotations

from msaa_lint.frame.description.models import Description, Device
from msaa_lint.frame.devices import DeviceProfile, builtin
from msaa_lint.frame.devices.vendors import is_tiler

from .compression import is_valhall_or_later
from .facts import Facts

AMD_MIXED_SAMPLES = "VK_AMD_mixed_attachment_samples"
NV_MIXED_SAMPLES = "VK_NV_framebuffer_mixed_samples"
MIXED_SAMPLES = frozenset({AMD_MIXED_SAMPLES, NV_MIXED_SAMPLES})
SINGLE_SAMPLED = "VK_EXT_multisampled_render_to_single_sampled"

FEATURES = {
    "enabled.sample_rate_shading": "sampleRateShading",
    "enabled.maintenance10": "maintenance10",
    "enabled.alpha_to_one": "alphaToOne",
    "enabled.storage_image_multisample": "shaderStorageImageMultisample",
    "enabled.render_to_single_sampled": "multisampledRenderToSingleSampled",
}
"""By fact: the features that the application enables; unknown where it states none."""

DEFAULT_EFFICIENT_SAMPLES = 4
"""What Arm's and Imagination's guides advise as the most without a measurement, and the validation
layer's constant for both.
"""


def profile(description: Description, default: DeviceProfile | None = None) -> DeviceProfile | None:
    """The device that a description describes, or the built-in one that it names, else the given
    one: that of the report that it names.
    """
    stated = description.device
    if isinstance(stated, Device):
        return described(stated)
    if stated is None:
        return of_family(description) or default
    return builtin(stated) or default


def of_family(description: Description) -> DeviceProfile | None:
    """What the GPU family that a frame in Metal's words states has in common; None where it states
    none of Apple's.
    """
    metal = description.metal
    if metal is None or metal.family is None:
        return None
    from msaa_lint.frame.metal.families import profile as profile_of

    return profile_of(metal.family, metal.supportedSampleCounts)


def described(device: Device) -> DeviceProfile:
    """A device mapping as a profile. What its `tile` or `compression` misstates is a problem of the
    description, and unknown here.
    """
    counts = device.sampleCounts
    tile, compression, most = None, None, None
    if device.tile is not None or device.compression is not None:
        from msaa_lint.frame.devices.tile_models import (
            Misstated,
            stated_compression,
            stated_most,
            stated_tile,
        )

        stated = stated_tile(device.tile), stated_compression(device.compression)
        tile = None if isinstance(stated[0], Misstated) else stated[0]
        compression = None if isinstance(stated[1], Misstated) else stated[1]
        most = None if compression is None else stated_most(device.compression)
    return DeviceProfile(
        name=device.name or "the described device",
        vendor=device.vendor,
        tiler=device.tiler if device.tiler is not None else is_tiler(device.vendor),
        color_samples=counts.color if counts is not None else None,
        depth_samples=counts.depth if counts is not None else None,
        stencil_samples=counts.stencil if counts is not None else None,
        integer_samples=counts.integer if counts is not None else None,
        memory_types=device.memoryTypes,
        depth_resolve_modes=device.depthResolveModes,
        stencil_resolve_modes=device.stencilResolveModes,
        independent_resolve=device.independentResolve,
        independent_resolve_none=device.independentResolveNone,
        features=device.features,
        extensions=device.extensions,
        api_version=device.apiVersion,
        max_efficient_samples=device.maxEfficientSamples,
        tile=tile,
        compression=compression,
        compression_most=most,
        milliwatts_per_gbps=device.milliwattsPerGBps,
    )


def global_facts(description: Description, device: DeviceProfile | None) -> Facts:
    """The facts that every subject shares."""
    facts = Facts()
    size = description.frame
    if size is not None:
        facts.put("frame.width", size.width, size.place("width"))
        facts.put("frame.height", size.height, size.place("height"))
        facts.put("frame.fps", float(size.fps) if size.fps is not None else None, size.place("fps"))
    facts.put("frame.has_commands", description.commands is not None)
    metal = description.metal
    facts.put("frame.api", "VULKAN" if metal is None else "METAL")
    if metal is not None:
        facts.put("device.metal_family", metal.family, metal.place("family"))
    _device(facts, device)
    _enabled(facts, description, device)
    scene = description.scene
    if scene is not None:
        facts.put("scene.color", scene.color, scene.place("color"))
        facts.put(
            "scene.peak", float(scene.peak) if scene.peak is not None else None, scene.place("peak")
        )
        facts.put("scene.tone_mapping", scene.toneMapping, scene.place("toneMapping"))
        facts.put("scene.depth", scene.depth, scene.place("depth"))
        facts.put(
            "scene.depth_resolve_wants", scene.depthResolveWants, scene.place("depthResolveWants")
        )
    return facts


def _device(facts: Facts, device: DeviceProfile | None) -> None:
    facts.put("device.known", device is not None and not device.minimum)
    facts.put("device.minimum", device is not None and device.minimum)
    efficient = device.max_efficient_samples if device is not None else None
    facts.put(
        "device.max_efficient_samples",
        efficient if efficient is not None else DEFAULT_EFFICIENT_SAMPLES,
    )
    facts.put("device.accelerates_float_blending", is_valhall_or_later(device) is True)
    facts.put("device.immediate_mode", device is not None and device.tiler is False)
    if device is None:
        facts.put("device.lazy_memory_known", False)
        return
    facts.put("device.name", device.name)
    facts.put("device.vendor", device.vendor)
    facts.put("device.tiler", device.tiler)
    lazy = (
        any("LAZILY_ALLOCATED" in flags for flags in device.memory_types)
        if device.memory_types is not None
        else None
    )
    if device.minimum and lazy is False:
        lazy = None
    facts.put("device.lazy_memory", lazy)
    facts.put("device.lazy_memory_known", lazy is not None)
    facts.put("device.sample_rate_shading", offers(device, device.features, "sampleRateShading"))


def offers(device: DeviceProfile, listed: tuple[str, ...] | None, name: str) -> bool | None:
    """Whether a device's list has a name; unknown where it is not stated, and where a class of
    devices does not promise it.
    """
    if listed is None:
        return None
    return True if name in listed else (None if device.minimum else False)


def _enabled(facts: Facts, description: Description, device: DeviceProfile | None) -> None:
    enabled = description.enabled
    extensions = enabled.extensions if enabled is not None else None
    features = enabled.features if enabled is not None else None
    if enabled is not None and features is not None:
        for fact, feature in FEATURES.items():
            facts.put(fact, feature in features, enabled.place("features"))
    elif (
        enabled is not None and extensions is not None and "VK_KHR_maintenance10" not in extensions
    ):
        facts.put("enabled.maintenance10", False, enabled.place("extensions"))
    offered = device.extensions if device is not None and extensions is None else None
    facts.put("enabled.mixed_samples", not MIXED_SAMPLES.isdisjoint(extensions or ()))
    facts.put("device.mixed_samples", not MIXED_SAMPLES.isdisjoint(offered or ()))
    facts.put("enabled.single_sampled_render", single_sampled_enabled(description))
    facts.put("device.single_sampled_render", single_sampled_offered(description, device))
    version = enabled.apiVersion if enabled is not None else None
    if extensions is None and version is None and device is not None:
        extensions, version = device.extensions, device.api_version
        if device.minimum:
            extensions = (
                extensions
                if extensions is not None and "VK_KHR_depth_stencil_resolve" in extensions
                else None
            )
    facts.put("enabled.depth_stencil_resolve", _depth_stencil_resolve(extensions, version))


def single_sampled_enabled(description: Description) -> bool:
    """Whether the application enables the feature of
    VK_EXT_multisampled_render_to_single_sampled.
    """
    enabled = description.enabled
    return enabled is not None and "multisampledRenderToSingleSampled" in (enabled.features or ())


def single_sampled_offered(description: Description, device: DeviceProfile | None) -> bool:
    """Whether the device offers VK_EXT_multisampled_render_to_single_sampled and the description
    does not state what is enabled.
    """
    enabled = description.enabled
    stated = enabled is not None and (
        enabled.features is not None or enabled.extensions is not None
    )
    return not stated and device is not None and SINGLE_SAMPLED in (device.extensions or ())


def _depth_stencil_resolve(extensions: tuple[str, ...] | None, version: str | None) -> bool | None:
    """Core in Vulkan 1.2, an extension before; unknown unless both are stated, or either says
    yes.
    """
    number = _version(version)
    if number is not None and number >= (1, 2):
        return True
    if extensions is not None and "VK_KHR_depth_stencil_resolve" in extensions:
        return True
    return False if number is not None and extensions is not None else None


def _version(text: str | None) -> tuple[int, int] | None:
    parts = (text or "").split(".")
    if len(parts) < 2 or not all(
        part.isascii() and part.isdigit() and len(part) < 6 for part in parts[:2]
    ):
        return None
    return int(parts[0]), int(parts[1])
