"""The gate: what a device does not support is known from what it says of itself, before a driver is asked to do it.

Drivers are not asked what they have said they cannot do: some crash, some draw nothing and say that all is well.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from msaa_lint.frame.vulkan.enums import VALUES

from . import parts
from .opening import TAKEN_UP
from .parts import COLOR, DEPTH, NONE, STENCIL, Image, Pass, Pipeline, Plan
from .texels import format_name

SINGLE_SAMPLED = "VK_EXT_multisampled_render_to_single_sampled"
MIXED = ("VK_AMD_mixed_attachment_samples", "VK_NV_framebuffer_mixed_samples")
DYNAMIC_STATE_3 = "VkPhysicalDeviceExtendedDynamicState3FeaturesEXT"

BLEND_FEATURE = 0x100
"""VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT."""

DYNAMIC = {
    parts.SAMPLES_DYNAMIC: "extendedDynamicState3RasterizationSamples",
    parts.MASK_DYNAMIC: "extendedDynamicState3SampleMask",
    parts.COVERAGE_DYNAMIC: "extendedDynamicState3AlphaToCoverageEnable",
}

OP_NONE = {1000400000: ("VK_EXT_load_store_op_none", "VK_KHR_load_store_op_none")}
"""VK_ATTACHMENT_LOAD_OP_NONE. STORE_OP_NONE is part of dynamic rendering too, so that no device of Vulkan 1.3 lacks it."""
STORE_OP_NONE = 1000301000
STORING_NONE = ("VK_EXT_load_store_op_none", "VK_KHR_load_store_op_none", "VK_KHR_dynamic_rendering", "VK_QCOM_render_pass_store_ops")

FIRST_VERSION_FORMATS = 185
"""Formats below this number are those that the device was asked about."""

USAGES = (
    (parts.SAMPLED, "sampled", "SAMPLED"), (parts.STORAGE, "storage", "STORAGE"), (parts.TRANSIENT, "transient", "TRANSIENT_ATTACHMENT"),
    (parts.INPUT_ATTACHMENT, "input", "INPUT_ATTACHMENT"),
)  # fmt: skip


def gate(plan: Plan, device: Mapping[str, Any]) -> dict[int, str]:
    """The passes that a device does not support, by their number, and the first reason of each in words.

    `device` is what `opening.Session.device` holds. What the device does not say is not held against a pass.
    """
    offered = DeviceSupport(device)
    found = {}
    for number, each in enumerate(plan.passes):
        reason = "" if each.refused else next(_reasons(plan, each, offered), "")
        if reason:
            found[number] = reason
    return found


class DeviceSupport:
    """What a device says of itself."""

    def __init__(self, device: Mapping[str, Any]) -> None:
        self.device = device
        self.limits: Mapping[str, Any] = device.get("properties", {}).get("limits", {})
        self.names = frozenset(each.get("extensionName") for each in device.get("extensions", ()))
        number = int(device.get("properties", {}).get("apiVersion", 0))
        self.version = (number >> 22 & 0x7F, number >> 12 & 0x3FF)
        self.formats: Mapping[str, Mapping[str, int]] = device.get("formats", {})

    def feature(self, name: str) -> bool:
        """Whether a feature of any of its structures is offered; an unknown one is."""
        stated = [value[name] for key, value in self.device.items() if "eatures" in key and isinstance(value, Mapping) and name in value]
        return any(stated) if stated else True

    def extension(self, name: str) -> bool:
        """Whether an extension is offered, or part of its version of Vulkan."""
        return name in self.names or self.version >= TAKEN_UP.get(name, (9, 9))

    def most(self, name: str) -> int:
        """A limit; a large number where it is not stated."""
        return int(self.limits.get(name, 1 << 30))

    @property
    def dynamic_rendering(self) -> bool:
        """Whether there are passes and pipelines without render passes."""
        return self.extension("VK_KHR_dynamic_rendering") and self.feature("dynamicRendering")

    def resolves(self, name: str) -> int | None:
        """A member of VkPhysicalDeviceDepthStencilResolveProperties; None where nothing is said."""
        for structure in ("VkPhysicalDeviceVulkan12Properties", "VkPhysicalDeviceDepthStencilResolveProperties"):
            if name in self.device.get(structure, {}):
                return int(self.device[structure][name])
        return None


def _reasons(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    for check in _CHECKS:
        yield from check(plan, each, offered)


def _way(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    """What its kind of pass needs."""
    if each.kind == parts.RENDERING and not offered.dynamic_rendering:
        yield "the device has no dynamic rendering"
    if each.api == 2 and not offered.extension("VK_KHR_create_renderpass2"):
        yield "the device has no VK_KHR_create_renderpass2"
    viewed = any(s.view_mask for s in each.subpasses) or each.view_mask
    if viewed and not (offered.extension("VK_KHR_multiview") and offered.feature("multiview")):
        yield "the device has no multiview"
    views = max([each.view_mask.bit_length(), *(s.view_mask.bit_length() for s in each.subpasses)])
    most = offered.device.get("VkPhysicalDeviceVulkan11Properties", {}).get("maxMultiviewViewCount")
    if most is not None and views > int(most):
        yield f"it renders {views} views, and the device has maxMultiviewViewCount {most}"
    single = each.single_sampled or any(s.single_sampled for s in each.subpasses)
    if single and not (offered.extension(SINGLE_SAMPLED) and offered.feature("multisampledRenderToSingleSampled")):
        yield f"the device has no {SINGLE_SAMPLED}"
    loads = {a.load for a in each.attachments} | {a.stencil_load for a in each.attachments} | {r.load for r in each.rendered}
    stores = {a.store for a in each.attachments} | {a.stencil_store for a in each.attachments} | {r.store for r in each.rendered}
    for operation, extensions in OP_NONE.items():
        if operation in loads and not any(map(offered.extension, extensions)):
            yield f"the device has no {extensions[0]}, which loadOp NONE needs"
    if STORE_OP_NONE in stores and not any(map(offered.extension, STORING_NONE)):
        yield f"the device has no {STORING_NONE[0]}, which storeOp NONE needs"


def _images(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    for number in each.images:
        yield from _image(plan.images[number], offered)


def _image(image: Image, offered: DeviceSupport) -> Iterator[str]:
    """Why an image cannot be had."""
    if image.tiling == MODIFIER_TILING:
        yield f"{image.name} has the tiling DRM_FORMAT_MODIFIER_EXT, whose modifiers are not described"
    side = {0: "maxImageDimension1D", 2: "maxImageDimension3D"}.get(image.type, "maxImageDimension2D")
    if max(image.width, image.height, image.depth) > offered.most(side):
        yield f"{image.name} is {image.width}x{image.height} texels, and the device has {side} {offered.most(side)}"
    if image.layers > offered.most("maxImageArrayLayers"):
        yield f"{image.name} has {image.layers} layers, and the device has maxImageArrayLayers {offered.most('maxImageArrayLayers')}"
    if image.samples > 1 and (image.type != 1 or image.tiling == 1 or image.levels > 1 or image.flags & CUBE_COMPATIBLE):
        yield f"{image.name} has {image.samples} samples, which an image that is not 2D, is linear, a cube or has levels cannot have"
    name = format_name(image.format)
    agreement = offered.formats.get(str(image.format))
    if agreement is None:
        if offered.formats and image.format < FIRST_VERSION_FORMATS:
            yield f"the device has no images of {name}, as {image.name} is one"
        return
    attached = image.usage & (parts.COLOR_ATTACHMENT | parts.DEPTH_ATTACHMENT)
    if not attached and image.samples == 1:
        return
    if "counts" not in agreement:
        yield f"the device does not render to {name}, as {image.name} is one"
        return
    if image.type != 1 or image.tiling == 1:
        return
    with_usage = [(agreement[key], f" with the usage {word}") for bit, key, word in USAGES if image.usage & bit]
    for counts, usage in ((agreement["counts"], ""), *with_usage):
        if not counts & image.samples:
            has = _counts(counts)
            yield (
                f"the device does not have {image.samples} samples of {name}{usage} ({has}), as {image.name} has"
                if has
                else (f"the device does not have {name}{usage}, as {image.name} is one")
            )


CUBE_COMPATIBLE = 0x10
"""VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT."""

MODIFIER_TILING = 1000158000
"""VK_IMAGE_TILING_DRM_FORMAT_MODIFIER_EXT."""


def _mixed(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Attachments that are drawn to together and differ in their counts."""
    for subpass, (colors, depths, single) in enumerate(_drawn_together(plan, each)):
        wanted = [name for name in MIXED if name in plan.extensions]
        allowed = len(set(colors)) < 2 and any(name in offered.names for name in wanted)
        drawn = sorted({*colors, *depths} - ({1} if single else set()))
        if len(drawn) > 1 and not allowed:
            yield f"its attachments differ in their sample counts ({_list(drawn)}), which the device cannot draw to together"
        own = [p.samples for p in each.pipelines if p.subpass == subpass]
        if wanted and not allowed and not single and any(samples not in drawn for samples in own if drawn):
            yield f"the device has no {wanted[0]}"


def _drawn_together(plan: Plan, each: Pass) -> Iterator[tuple[list[int], list[int], bool]]:
    for subpass in each.subpasses:
        colors = [each.attachments[r.attachment].samples for r in subpass.colors if r.attachment != NONE]
        depths = [each.attachments[r.attachment].samples for r in subpass.depth_stencil if r.attachment != NONE]
        yield colors, depths, subpass.single_sampled > 0
    if each.kind == parts.RENDERING:
        counts = [(r.role, plan.images[r.image].samples) for r in each.rendered if r.image != NONE]
        yield [n for role, n in counts if role == "color"], [n for role, n in counts if role != "color"], each.single_sampled > 0


def _images_of_attachments(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Images and attachments that are not of one count, and framebuffers that are too large."""
    for framebuffer in each.framebuffers:
        for attachment, number in zip(each.attachments, framebuffer.images, strict=False):
            image = plan.images[number]
            if attachment.samples != image.samples:
                yield f"{image.name} has sample count {image.samples}, and its attachment has {attachment.samples}"
        for value, name in ((framebuffer.width, "maxFramebufferWidth"), (framebuffer.height, "maxFramebufferHeight")):
            if value > offered.most(name):
                yield f"it renders to {framebuffer.width}x{framebuffer.height} pixels, and the device has {name} {offered.most(name)}"
        if framebuffer.layers > offered.most("maxFramebufferLayers"):
            most = offered.most("maxFramebufferLayers")
            yield f"it renders to {framebuffer.layers} layers, and the device has maxFramebufferLayers {most}"
    colors = max([len(s.colors) for s in each.subpasses] + [sum(r.role == "color" for r in each.rendered)])
    if colors > offered.most("maxColorAttachments"):
        yield f"it has {colors} color attachments, and the device has maxColorAttachments {offered.most('maxColorAttachments')}"


def _resolves(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    """Resolves that drivers crash on, and modes of depth and stencil."""
    if not each.single_sampled and any(r.image != NONE and r.mode and r.resolve_image == NONE for r in each.rendered):
        yield "it resolves, and names no image to resolve to"
    for subpass in each.subpasses:
        if not subpass.depth_resolve:
            continue
        if not subpass.depth_stencil:
            yield "it resolves depth or stencil in a subpass that has no such attachment"
            continue
        own, target = (each.attachments[r[0].attachment].format for r in (subpass.depth_stencil, subpass.depth_resolve))
        aspects = _aspects(own) & _aspects(target)
        yield from _modes(subpass.depth_mode, subpass.stencil_mode, aspects, offered)
    modes = {r.role: r.mode for r in each.rendered if r.role != "color" and r.image != NONE}
    if any(modes.values()):
        aspects = (DEPTH if "depth" in modes else 0) | (STENCIL if "stencil" in modes else 0)
        yield from _modes(modes.get("depth", 0), modes.get("stencil", 0), aspects, offered)


def _modes(depth: int, stencil: int, aspects: int, offered: DeviceSupport) -> Iterator[str]:
    for aspect, mode, word in ((DEPTH, depth, "Depth"), (STENCIL, stencil, "Stencil")):
        supported = offered.resolves(f"supported{word}ResolveModes")
        if aspects & aspect and mode and supported is not None and not supported & mode:
            yield f"the device does not resolve {word.lower()} by {mode_name(mode)} (supported{word}ResolveModes: {_mode_names(supported)})"
    if aspects != DEPTH | STENCIL or depth == stencil:
        return
    limit = "independentResolve" if depth and stencil else "independentResolveNone"
    if offered.resolves(limit) == 0 and offered.resolves("independentResolve") == 0:
        yield f"the device does not resolve depth by {mode_name(depth)} and stencil by {mode_name(stencil)} ({limit} is false)"


def _pipelines(plan: Plan, each: Pass, offered: DeviceSupport) -> Iterator[str]:
    number = next(n for n, one in enumerate(plan.passes) if one is each)
    set_counts = {i.value for step in plan.steps if step.number == number for i in step.inner if i.kind == "samples"}
    counts = offered.limits.get("framebufferColorSampleCounts")
    for samples in sorted(set_counts):
        if counts is not None and not int(counts) & samples:
            yield f"the device does not rasterize with {samples} samples (framebufferColorSampleCounts: {_counts(int(counts))})"
    for pipeline in each.pipelines:
        for reason in _pipeline(plan, each, pipeline, offered):
            yield f"{pipeline.name}: {reason}"


def _pipeline(plan: Plan, each: Pass, pipeline: Pipeline, offered: DeviceSupport) -> Iterator[str]:
    subpass = each.subpasses[pipeline.subpass] if 0 <= pipeline.subpass < len(each.subpasses) else None
    depth = pipeline.depth_format or pipeline.stencil_format or (subpass is not None and subpass.depth_stencil)
    if pipeline.subpass == NONE and not offered.dynamic_rendering:
        yield "the device has no dynamic rendering"
    limits = ["framebufferDepthSampleCounts"] if depth else []
    # Integers have a limit of their own that drivers and the layer do not keep to; images are asked about by format.
    limits += ["framebufferColorSampleCounts"] if any(kind not in ("UINT", "SINT", "") for kind in pipeline.numerics) else []
    for limit in limits if depth or any(pipeline.numerics) else ["framebufferNoAttachmentsSampleCounts"]:
        counts = offered.limits.get(limit)
        if counts is not None and not int(counts) & pipeline.samples:
            yield f"the device does not rasterize with {pipeline.samples} samples ({limit}: {_counts(int(counts))})"
    for wanted, name in (
        (pipeline.sample_shading >= 0, "sampleRateShading"),
        (pipeline.alpha_to_one, "alphaToOne"),
        (pipeline.depth_clamp, "depthClamp"),
        (pipeline.polygon_mode in (1, 2), "fillModeNonSolid"),
        (len(set(pipeline.blends)) > 1, "independentBlend"),
    ):
        if wanted and name not in plan.without and not offered.feature(name):
            yield f"the device has no {name}"
    for state, name in DYNAMIC.items():
        if state in pipeline.dynamic and not ("VK_EXT_extended_dynamic_state3" in offered.names and offered.feature(name)):
            yield f"the device has no {name}"
    formats = pipeline.formats
    if subpass is not None:
        formats = tuple(each.attachments[r.attachment].format if r.attachment != NONE else 0 for r in subpass.colors)
    for number, blend in zip(formats, pipeline.blends, strict=False):
        agreement = offered.formats.get(str(number))
        if blend.enable and agreement is not None and not agreement.get("features", 0) & BLEND_FEATURE:
            yield f"the device does not blend {format_name(number)}"


_Check = Callable[[Plan, Pass, DeviceSupport], Iterator[str]]
_CHECKS: tuple[_Check, ...] = (_way, _mixed, _images, _images_of_attachments, _resolves, _pipelines)


def _aspects(number: int) -> int:
    from msaa_lint.frame.vulkan.formats import format_of

    found = format_of(format_name(number))
    if found is None:
        return DEPTH | STENCIL
    return sum({"depth": DEPTH, "stencil": STENCIL, "color": COLOR}[each] for each in found.aspects)


def mode_name(number: int) -> str:
    """A VkResolveModeFlagBits by its short name."""
    return next((name for name, value in VALUES["VkResolveModeFlagBits"].items() if value == number), str(number))


def _mode_names(mask: int) -> str:
    return " | ".join(mode_name(1 << bit) for bit in range(31) if mask >> bit & 1) or "none"


def _counts(mask: int) -> str:
    return _list([1 << bit for bit in range(7) if mask >> bit & 1])


def _list(numbers: list[int]) -> str:
    text = [str(each) for each in numbers]
    return " and ".join([", ".join(text[:-1]), text[-1]]) if len(text) > 1 else "".join(text)
