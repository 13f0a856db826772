"""The gate: skips what a device does not support according to its properties.

Drivers that are asked for more than they support may crash, or draw nothing and report success.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from msaa_lint.frame.vulkan.enums import VALUES

from . import parts
from .opening import TAKEN_UP
from .parts import COLOR, DEPTH, NONE, STENCIL, Image, Pass, Pipeline, Plan
from .shader_support import unsupported_in
from .texels import format_name

SINGLE_SAMPLED = "VK_EXT_multisampled_render_to_single_sampled"
MIXED = ("VK_AMD_mixed_attachment_samples", "VK_NV_framebuffer_mixed_samples")

BLEND_FEATURE, BLIT_SRC, BLIT_DST, LINEAR_FILTER = 0x100, 0x400, 0x800, 0x1000
"""VkFormatFeatureFlagBits: COLOR_ATTACHMENT_BLEND, BLIT_SRC, BLIT_DST, and
SAMPLED_IMAGE_FILTER_LINEAR.
"""

DYNAMIC = {
    parts.SAMPLES_DYNAMIC: "extendedDynamicState3RasterizationSamples",
    parts.MASK_DYNAMIC: "extendedDynamicState3SampleMask",
    parts.COVERAGE_DYNAMIC: "extendedDynamicState3AlphaToCoverageEnable",
}

OP_NONE = {1000400000: ("VK_EXT_load_store_op_none", "VK_KHR_load_store_op_none")}
"""VK_ATTACHMENT_LOAD_OP_NONE. STORE_OP_NONE is part of dynamic rendering too, so that every device
with Vulkan 1.3 has it.
"""
STORE_OP_NONE = 1000301000
STORING_NONE = (
    "VK_EXT_load_store_op_none",
    "VK_KHR_load_store_op_none",
    "VK_KHR_dynamic_rendering",
    "VK_QCOM_render_pass_store_ops",
)

MAX_MODE = 8
"""VK_RESOLVE_MODE_MAX_BIT, the greatest mode without extensions."""

FIRST_VERSION_FORMATS = 185
"""The device was queried about formats below this number."""

USAGES = (
    (parts.SAMPLED, "sampled", "SAMPLED"), (parts.STORAGE, "storage", "STORAGE"), (parts.TRANSIENT,
    "transient", "TRANSIENT_ATTACHMENT"),
    (parts.INPUT_ATTACHMENT, "input", "INPUT_ATTACHMENT"),
)  # fmt: skip


def gate(plan: Plan, device: Mapping[str, Any]) -> dict[int, str]:
    """The passes that a device does not support, by number, with the first reason for each.

    `device` is `opening.Session.device`. Unknown properties count as supported.
    """
    offered = DeviceSupport(device)
    refused = {}
    for number, frame_pass in enumerate(plan.passes):
        reason = (
            ""
            if frame_pass.refused
            else next((why for check in _CHECKS for why in check(plan, frame_pass, offered)), "")
        )
        if reason:
            refused[number] = reason
    return refused


class DeviceSupport:
    """The properties of a device."""

    def __init__(self, device: Mapping[str, Any]) -> None:
        self.device = device
        self.limits: Mapping[str, Any] = device.get("properties", {}).get("limits", {})
        self.names = frozenset(
            frame_pass.get("extensionName") for frame_pass in device.get("extensions", ())
        )
        number = int(device.get("properties", {}).get("apiVersion", 0))
        self.version = (number >> 22 & 0x7F, number >> 12 & 0x3FF)
        self.formats: Mapping[str, Mapping[str, int]] = device.get("formats", {})

    def feature(self, name: str) -> bool:
        """Whether a feature is supported according to any of its structures, or unknown."""
        values = [
            value[name]
            for key, value in self.device.items()
            if "eatures" in key and isinstance(value, Mapping) and name in value
        ]
        return any(values) if values else True

    def extension(self, name: str) -> bool:
        """Whether an extension is supported, or part of the device's version of Vulkan."""
        return name in self.names or self.version >= TAKEN_UP.get(name, (9, 9))

    def most(self, name: str) -> int:
        """A limit; a large number if unknown."""
        return int(self.limits.get(name, 1 << 30))

    @property
    def dynamic_rendering(self) -> bool:
        """Whether dynamic rendering is supported."""
        return self.extension("VK_KHR_dynamic_rendering") and self.feature("dynamicRendering")

    def resolves(self, name: str) -> int | None:
        """A member of VkPhysicalDeviceDepthStencilResolveProperties; None if unknown."""
        for structure in (
            "VkPhysicalDeviceVulkan12Properties",
            "VkPhysicalDeviceDepthStencilResolveProperties",
        ):
            if name in self.device.get(structure, {}):
                return int(self.device[structure][name])
        return None


def _way(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Requirements of the kind of pass."""
    if frame_pass.kind == parts.RENDERING and not offered.dynamic_rendering:
        yield "the device does not support dynamic rendering"
    if frame_pass.api == 2 and not offered.extension("VK_KHR_create_renderpass2"):
        yield "the device has no VK_KHR_create_renderpass2"
    multiview = any(s.view_mask for s in frame_pass.subpasses) or frame_pass.view_mask
    if multiview and not (offered.extension("VK_KHR_multiview") and offered.feature("multiview")):
        yield "the device does not support multiview"
    views = max(
        [
            frame_pass.view_mask.bit_length(),
            *(s.view_mask.bit_length() for s in frame_pass.subpasses),
        ]
    )
    max_views = offered.device.get("VkPhysicalDeviceVulkan11Properties", {}).get(
        "maxMultiviewViewCount"
    )
    if max_views is not None and views > int(max_views):
        yield f"it renders {views} views, and the device has maxMultiviewViewCount {max_views}"
    single_sampled = frame_pass.single_sampled or any(
        s.single_sampled for s in frame_pass.subpasses
    )
    if single_sampled and not (
        offered.extension(SINGLE_SAMPLED) and offered.feature("multisampledRenderToSingleSampled")
    ):
        yield f"the device has no {SINGLE_SAMPLED}"
    loads = (
        {a.load for a in frame_pass.attachments}
        | {a.stencil_load for a in frame_pass.attachments}
        | {r.load for r in frame_pass.rendered}
    )
    stores = (
        {a.store for a in frame_pass.attachments}
        | {a.stencil_store for a in frame_pass.attachments}
        | {r.store for r in frame_pass.rendered}
    )
    for operation, extensions in OP_NONE.items():
        if operation in loads and not any(map(offered.extension, extensions)):
            yield f"the device has no {extensions[0]}, which loadOp NONE needs"
    if STORE_OP_NONE in stores and not any(map(offered.extension, STORING_NONE)):
        yield f"the device has no {STORING_NONE[0]}, which storeOp NONE needs"


def _images(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    for number in frame_pass.images:
        yield from _image(plan.images[number], offered)


def _image(image: Image, offered: DeviceSupport) -> Iterator[str]:
    """Why an image cannot be created."""
    if image.tiling == MODIFIER_TILING:
        yield (
            f"{image.name} has the tiling DRM_FORMAT_MODIFIER_EXT, whose modifiers are not "
            "described"
        )
    side = {0: "maxImageDimension1D", 2: "maxImageDimension3D"}.get(
        image.type, "maxImageDimension2D"
    )
    if max(image.width, image.height, image.depth) > offered.most(side):
        yield (
            f"{image.name} is {image.width}x{image.height} texels, and the device has {side} "
            f"{offered.most(side)}"
        )
    if image.layers > offered.most("maxImageArrayLayers"):
        yield (
            f"{image.name} has {image.layers} layers, and the device has maxImageArrayLayers "
            f"{offered.most('maxImageArrayLayers')}"
        )
    if image.samples > 1 and (
        image.type != 1 or image.tiling == 1 or image.levels > 1 or image.flags & CUBE_COMPATIBLE
    ):
        yield (
            f"{image.name} has {image.samples} samples, which requires a 2D image with optimal "
            "tiling, one mip level and no cube faces"
        )
    name = format_name(image.format)
    support = offered.formats.get(str(image.format))
    if support is None:
        if offered.formats and image.format < FIRST_VERSION_FORMATS:
            yield f"the device does not support {name}, the format of {image.name}"
        return
    attachment_usage = image.usage & (parts.COLOR_ATTACHMENT | parts.DEPTH_ATTACHMENT)
    if not attachment_usage and image.samples == 1:
        return
    if "counts" not in support:
        yield f"the device cannot render to {name}, the format of {image.name}"
        return
    if image.type != 1 or image.tiling == 1:
        return
    counts_by_usage = [
        (support[key], f" with the usage {word}") for bit, key, word in USAGES if image.usage & bit
    ]
    for counts, usage in ((support["counts"], ""), *counts_by_usage):
        if not counts & image.samples:
            supported = _counts(counts)
            yield (
                f"{image.name} has {image.samples} samples, but the device supports only "
                f"{supported} for {name}{usage}"
                if supported
                else f"the device does not support {name}{usage}, the format of {image.name}"
            )


CUBE_COMPATIBLE = 0x10
"""VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT."""

MODIFIER_TILING = 1000158000
"""VK_IMAGE_TILING_DRM_FORMAT_MODIFIER_EXT."""


def _mixed(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Attachments of one subpass that differ in their sample counts."""
    for subpass, (colors, depths, single) in enumerate(_drawn_together(plan, frame_pass)):
        extensions = [name for name in MIXED if name in plan.extensions]
        allowed = len(set(colors)) < 2 and any(name in offered.names for name in extensions)
        distinct_counts = sorted({*colors, *depths} - ({1} if single else set()))
        if len(distinct_counts) > 1 and not allowed:
            counts = _list(distinct_counts)
            yield (
                f"its attachments differ in their sample counts ({counts}), which cannot be "
                "rendered together on this device"
            )
        pipeline_counts = [p.samples for p in frame_pass.pipelines if p.subpass == subpass]
        if (
            extensions
            and not allowed
            and not single
            and any(
                samples not in distinct_counts for samples in pipeline_counts if distinct_counts
            )
        ):
            yield f"the device has no {extensions[0]}"


def _drawn_together(plan: Plan, frame_pass: Pass) -> Iterator[tuple[list[int], list[int], bool]]:
    for subpass in frame_pass.subpasses:
        colors = [
            frame_pass.attachments[r.attachment].samples
            for r in subpass.colors
            if r.attachment != NONE
        ]
        depths = [
            frame_pass.attachments[r.attachment].samples
            for r in subpass.depth_stencil
            if r.attachment != NONE
        ]
        yield colors, depths, subpass.single_sampled > 0
    if frame_pass.kind == parts.RENDERING:
        counts = [
            (r.role, plan.images[r.image].samples) for r in frame_pass.rendered if r.image != NONE
        ]
        yield (
            [n for role, n in counts if role == "color"],
            [n for role, n in counts if role != "color"],
            frame_pass.single_sampled > 0,
        )


def _images_of_attachments(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Images whose sample count differs from that of their attachment, and framebuffers that are
    too large.
    """
    for framebuffer in frame_pass.framebuffers:
        for attachment, number in zip(frame_pass.attachments, framebuffer.images, strict=False):
            image = plan.images[number]
            if attachment.samples != image.samples:
                yield (
                    f"{image.name} has sample count {image.samples}, and its attachment has "
                    f"{attachment.samples}"
                )
        for value, name in (
            (framebuffer.width, "maxFramebufferWidth"),
            (framebuffer.height, "maxFramebufferHeight"),
        ):
            if value > offered.most(name):
                yield (
                    f"it renders to {framebuffer.width}x{framebuffer.height} pixels, and the "
                    f"device has {name} {offered.most(name)}"
                )
        if framebuffer.layers > offered.most("maxFramebufferLayers"):
            most = offered.most("maxFramebufferLayers")
            yield (
                f"it renders to {framebuffer.layers} layers, and the device has "
                f"maxFramebufferLayers {most}"
            )
    colors = max(
        [len(s.colors) for s in frame_pass.subpasses]
        + [sum(r.role == "color" for r in frame_pass.rendered)]
    )
    if colors > offered.most("maxColorAttachments"):
        yield (
            f"it has {colors} color attachments, and the device has maxColorAttachments "
            f"{offered.most('maxColorAttachments')}"
        )


def _resolves(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Resolves that crash drivers, and unsupported modes of depth and stencil."""
    if any(r.mode > MAX_MODE for r in frame_pass.rendered):
        yield "it resolves with the mode of an extension, which confirm does not enable"
    if not frame_pass.single_sampled and any(
        r.image != NONE and r.mode and r.resolve_image == NONE for r in frame_pass.rendered
    ):
        yield "it resolves without an image to resolve to"
    for subpass in frame_pass.subpasses:
        # Rendering with more samples than its attachments have resolves depth and stencil to
        # themselves.
        targets = subpass.depth_resolve or (subpass.depth_stencil if subpass.single_sampled else ())
        if not targets:
            continue
        if not subpass.depth_stencil:
            yield "it resolves depth or stencil in a subpass without a depth-stencil attachment"
            continue
        source_format, target = (
            frame_pass.attachments[r[0].attachment].format for r in (subpass.depth_stencil, targets)
        )
        aspects = _aspects(source_format) & _aspects(target)
        yield from _modes(subpass.depth_mode, subpass.stencil_mode, aspects, offered)
    modes = {r.role: r.mode for r in frame_pass.rendered if r.role != "color" and r.image != NONE}
    if any(modes.values()):
        aspects = (DEPTH if "depth" in modes else 0) | (STENCIL if "stencil" in modes else 0)
        yield from _modes(modes.get("depth", 0), modes.get("stencil", 0), aspects, offered)


def _modes(depth: int, stencil: int, aspects: int, offered: DeviceSupport) -> Iterator[str]:
    for aspect, mode, word in ((DEPTH, depth, "Depth"), (STENCIL, stencil, "Stencil")):
        supported = offered.resolves(f"supported{word}ResolveModes")
        if aspects & aspect and mode and supported is not None and not supported & mode:
            modes = _mode_names(supported)
            yield (
                f"the device does not resolve {word.lower()} with {mode_name(mode)} "
                f"(supported{word}ResolveModes: {modes})"
            )
    if aspects != DEPTH | STENCIL or depth == stencil:
        return
    limit = "independentResolve" if depth and stencil else "independentResolveNone"
    if offered.resolves(limit) == 0 and offered.resolves("independentResolve") == 0:
        yield (
            f"the device does not resolve depth with {mode_name(depth)} and stencil with "
            f"{mode_name(stencil)} ({limit} is false)"
        )


def _pipelines(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    number = next(n for n, one in enumerate(plan.passes) if one is frame_pass)
    set_counts = {
        i.value
        for step in plan.steps
        if step.number == number
        for i in step.inner
        if i.kind == "samples"
    }
    counts = offered.limits.get("framebufferColorSampleCounts")
    for samples in sorted(set_counts):
        if counts is not None and not int(counts) & samples:
            yield (
                f"the device does not rasterize with {samples} samples "
                f"(framebufferColorSampleCounts: {_counts(int(counts))})"
            )
    for pipeline in frame_pass.pipelines:
        for reason in _pipeline(plan, frame_pass, pipeline, offered):
            yield f"{pipeline.name}: {reason}"


def _pipeline(
    plan: Plan, frame_pass: Pass, pipeline: Pipeline, offered: DeviceSupport
) -> Iterator[str]:
    subpass = (
        frame_pass.subpasses[pipeline.subpass]
        if 0 <= pipeline.subpass < len(frame_pass.subpasses)
        else None
    )
    depth = (
        pipeline.depth_format
        or pipeline.stencil_format
        or (subpass is not None and subpass.depth_stencil)
    )
    if pipeline.subpass == NONE and not offered.dynamic_rendering:
        yield "the device does not support dynamic rendering"
    limits = ["framebufferDepthSampleCounts"] if depth else []
    # Integers have a limit of their own that drivers and the layer ignore; images are checked by
    # format.
    limits += (
        ["framebufferColorSampleCounts"]
        if any(kind not in ("UINT", "SINT", "") for kind in pipeline.numerics)
        else []
    )
    for limit in (
        limits if depth or any(pipeline.numerics) else ["framebufferNoAttachmentsSampleCounts"]
    ):
        counts = offered.limits.get(limit)
        if counts is not None and not int(counts) & pipeline.samples:
            yield (
                f"the device does not rasterize with {pipeline.samples} samples ({limit}: "
                f"{_counts(int(counts))})"
            )
    for needed, name in (
        (pipeline.sample_shading >= 0, "sampleRateShading"),
        (pipeline.alpha_to_one, "alphaToOne"),
        (pipeline.depth_clamp, "depthClamp"),
        (pipeline.polygon_mode in (1, 2), "fillModeNonSolid"),
        (len(set(pipeline.blends)) > 1, "independentBlend"),
    ):
        if needed and name not in plan.without and not offered.feature(name):
            yield f"the device has no {name}"
    for state, name in DYNAMIC.items():
        if state in pipeline.dynamic and not (
            "VK_EXT_extended_dynamic_state3" in offered.names and offered.feature(name)
        ):
            yield f"the device has no {name}"
    formats = pipeline.formats
    if subpass is not None:
        formats = tuple(
            frame_pass.attachments[r.attachment].format if r.attachment != NONE else 0
            for r in subpass.colors
        )
    for number, blend in zip(formats, pipeline.blends, strict=False):
        support = offered.formats.get(str(number))
        if blend.enable and support is not None and not support.get("features", 0) & BLEND_FEATURE:
            yield f"the device does not blend {format_name(number)}"


def _blits(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Blits of formats that the device does not blit, or not with their filter."""
    number = next(n for n, one in enumerate(plan.passes) if one is frame_pass)
    for step in (step for step in plan.steps if step.kind == "blit" and step.number == number):
        source_features = BLIT_SRC | (LINEAR_FILTER if step.filter else 0)
        for image, needed, word in (
            (step.source, source_features, "from"),
            (step.target, BLIT_DST, "to"),
        ):
            support = offered.formats.get(str(plan.images[image].format))
            if (
                support is not None
                and "features" in support
                and support["features"] & needed != needed
            ):
                filtered = " with a linear filter" if step.filter and needed != BLIT_DST else ""
                yield (
                    f"the device does not blit {word} "
                    f"{format_name(plan.images[image].format)}{filtered}"
                )


def _shaders(plan: Plan, frame_pass: Pass, offered: DeviceSupport) -> Iterator[str]:
    for pipeline in frame_pass.pipelines:
        reason = unsupported_in(plan, frame_pass, pipeline, offered.device)
        if reason:
            yield f"the shader of {pipeline.name} {reason}"


_Check = Callable[[Plan, Pass, DeviceSupport], Iterator[str]]
_CHECKS: tuple[_Check, ...] = (
    _way,
    _mixed,
    _images,
    _images_of_attachments,
    _resolves,
    _pipelines,
    _blits,
    _shaders,
)


def _aspects(number: int) -> int:
    from msaa_lint.frame.vulkan.formats import format_of

    format = format_of(format_name(number))
    if format is None:
        return DEPTH | STENCIL
    return sum(
        {"depth": DEPTH, "stencil": STENCIL, "color": COLOR}[frame_pass]
        for frame_pass in format.aspects
    )


def mode_name(number: int) -> str:
    """The short name of a VkResolveModeFlagBits."""
    return next(
        (name for name, value in VALUES["VkResolveModeFlagBits"].items() if value == number),
        str(number),
    )


def _mode_names(mask: int) -> str:
    return " | ".join(mode_name(1 << bit) for bit in range(31) if mask >> bit & 1) or "none"


def _counts(mask: int) -> str:
    return _list([1 << bit for bit in range(7) if mask >> bit & 1])


def _list(numbers: list[int]) -> str:
    text = [str(frame_pass) for frame_pass in numbers]
    return " and ".join([", ".join(text[:-1]), text[-1]]) if len(text) > 1 else "".join(text)
