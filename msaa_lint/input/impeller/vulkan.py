"""The images, render passes and commands that the engine creates for render targets on Vulkan.

From its `allocator_vk.cc` (usages and memory), `render_target.cc` (the textures),
`render_pass_builder_vk.cc` (operations, layouts and dependencies), `surface_vk.cc`,
`swapchain_transients_vk.cc` and `khr_swapchain_impl_vk.cc` (the swapchain), `pipeline_vk.cc`.
"""

from __future__ import annotations

from typing import Any

from . import words
from .target import Target, Value

Members = dict[str, Any]

COLOR_USAGE = ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT")
"""Framebuffer fetch may read every color target as an input attachment."""

TRANSFERS = ("TRANSFER_SRC", "TRANSFER_DST")
"""Added to images that are not transient, because they may be blitted."""


def description(targets: list[Target], lazy: bool | None) -> Members:
    """The sections of a description. `lazy` says whether the device has lazily allocated memory;
    None if unknown.
    """
    sections: Members = {
        "images": {},
        "renderPasses": {},
        "framebuffers": {},
        "pipelines": {},
        "commands": [],
    }
    for target in targets:
        sections["images"] |= _images(target, lazy)
        sections["renderPasses"][target.name] = Value(_render_pass(target), target.at)
        framebuffer = _framebuffer(target)
        if framebuffer is not None:
            sections["framebuffers"][target.name] = Value(framebuffer, target.at)
        sections["pipelines"][target.name] = Value(_pipeline(target), target.at)
        sections["commands"] += _commands(target, framebuffer is not None)
    return {section: entries for section, entries in sections.items() if entries}


def _images(target: Target, lazy: bool | None) -> Members:
    color, at = target.color, target.at
    images: Members = {}
    single = color.resolve_storage if target.multisampled else color.storage
    if target.multisampled:
        usage = _usage(COLOR_USAGE, color.storage, lazy)
        images[f"{target.name}_color_ms"] = _image(
            target, target.color_format, target.samples, usage, _memory(color.storage, lazy), None
        )
    if target.onscreen:
        swapchain = Value(COLOR_USAGE, at)
        images[f"{target.name}_color"] = _image(
            target, target.color_format, Value(1, at), swapchain, None, True
        )
    else:
        usage = _usage((*COLOR_USAGE, "SAMPLED"), single, lazy)
        images[f"{target.name}_color"] = _image(
            target, target.color_format, Value(1, at), usage, _memory(single, lazy), False
        )
    if target.has_depth_stencil:
        mode = target.depth_stencil.storage
        usage = _usage(("DEPTH_STENCIL_ATTACHMENT",), mode, lazy)
        images[f"{target.name}_depth_stencil"] = _image(
            target, target.depth_format, target.samples, usage, _memory(mode, lazy), None
        )
    return images


def _image(
    target: Target,
    format: Value,
    samples: Value,
    usage: Value,
    memory: Value | None,
    presentable: bool | None,
) -> Value:
    extent = (
        {"width": target.width, "height": target.height, "depth": 1}
        if target.width and target.height
        else None
    )
    members = {
        "format": format.mapped(words.VULKAN_FORMATS),
        "samples": samples,
        "usage": usage,
        "memory": memory,
        "presentable": presentable,
        "extent": extent,
        "imageType": "2D",
        "tiling": "OPTIMAL",
        "mipLevels": 1,
        "arrayLayers": 1,
        "sharingMode": "EXCLUSIVE",
    }
    return Value(members, target.at)


def _usage(usage: tuple[str, ...], mode: Value, lazy: bool | None) -> Value:
    """`ToVKImageUsageFlags`: TRANSIENT_ATTACHMENT only if the device has lazily allocated
    memory.
    """
    if mode.value != "kDeviceTransient":
        return Value((*usage, *TRANSFERS), mode.at)
    if lazy is None:
        return Value(None, mode.at)
    return Value((*usage, "TRANSIENT_ATTACHMENT") if lazy else usage, mode.at)


def _memory(mode: Value, lazy: bool | None) -> Value | None:
    """`ToVKTextureMemoryPropertyFlags`. They are preferred flags, so the memory of a host-visible
    image is unknown.
    """
    if mode.value == "kHostVisible" or (mode.value == "kDeviceTransient" and lazy is None):
        return None
    transient = mode.value == "kDeviceTransient" and lazy
    return Value(("DEVICE_LOCAL", "LAZILY_ALLOCATED") if transient else ("DEVICE_LOCAL",), mode.at)


def _render_pass(target: Target) -> Members:
    color = "color_ms" if target.multisampled else "color"
    attachments = {color: _color_attachment(target)}
    # The engine also lists color as an input attachment for framebuffer fetch, but it is unknown
    # which pipelines use it.
    subpass: Members = {"colorAttachments": [_slot(color)]}
    if target.resolves:
        resolve = "color" if target.multisampled else "resolve"
        attachments[resolve] = _resolve_attachment(target)
        subpass["resolveAttachments"] = Value([_slot(resolve)], target.color.store.at)
    if target.has_depth_stencil:
        attachments["depth_stencil"] = _depth_stencil_attachment(target)
        subpass["depthStencilAttachment"] = "depth_stencil"
    return {
        "attachments": attachments,
        "subpasses": [subpass],
        "dependencies": _dependencies(target.has_depth_stencil),
    }


def _slot(name: str) -> Members:
    """A reference to a color attachment, in GENERAL so that framebuffer fetch can read it."""
    return {"attachment": name, "layout": "GENERAL"}


def _final_layout(onscreen: bool, samples: int) -> str:
    """`ComputeFinalLayout`."""
    return "GENERAL" if onscreen or samples > 1 else "SHADER_READ_ONLY_OPTIMAL"


def _color_attachment(target: Target) -> Value:
    name = "color_ms" if target.multisampled else "color"
    config, samples = target.color, target.samples.value
    # What comes from the swapchain is in the layout that it was given there.
    before = _final_layout(target.onscreen, samples) if samples > 1 or not target.onscreen else None
    members = {
        "image": f"{target.name}_{name}",
        "loadOp": config.load.mapped(words.VULKAN_LOADS),
        "storeOp": config.store.mapped(words.VULKAN_STORES),
        "initialLayout": before if config.load.value == "kLoad" else "UNDEFINED",
        "finalLayout": _final_layout(target.onscreen, samples),
    }
    return Value(members, target.at)


def _resolve_attachment(target: Target) -> Value:
    """The color's own with one sample, stored: the engine begins it with the color's load
    operation.
    """
    config = target.color
    members: Members = {"image": f"{target.name}_color"} if target.multisampled else {}
    if not target.multisampled:
        members = {"format": target.color_format.mapped(words.VULKAN_FORMATS), "samples": 1}
    members |= {
        "loadOp": config.load.mapped(words.VULKAN_LOADS),
        "storeOp": Value("STORE", config.store.at),
        "initialLayout": _final_layout(target.onscreen, target.samples.value)
        if config.load.value == "kLoad"
        else "UNDEFINED",
        "finalLayout": _final_layout(target.onscreen, 1),
    }
    return Value(members, target.at)


def _depth_stencil_attachment(target: Target) -> Value:
    """Depth and stencil share their operations; a stencil-only format has no depth operations."""
    config = target.depth_stencil
    load = config.load.mapped(words.VULKAN_LOADS)
    store = config.store.mapped(words.VULKAN_STORES)
    members = {
        "image": f"{target.name}_depth_stencil",
        "loadOp": load if target.has_depth else "DONT_CARE",
        "storeOp": store if target.has_depth else "DONT_CARE",
        "stencilLoadOp": load,
        "stencilStoreOp": store,
        "initialLayout": "UNDEFINED",
        "finalLayout": "DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
    }
    return Value(members, target.at)


def _dependencies(depth: bool) -> list[Members]:
    """The dependencies on earlier uses of the attachments, and of later samplers on the result."""
    tests = ["EARLY_FRAGMENT_TESTS", "LATE_FRAGMENT_TESTS"] if depth else []
    write = ["DEPTH_STENCIL_ATTACHMENT_WRITE"] if depth else []
    return [
        {
            "srcSubpass": "EXTERNAL",
            "dstSubpass": 0,
            "srcStageMask": ["COLOR_ATTACHMENT_OUTPUT", "FRAGMENT_SHADER", *tests],
            "srcAccessMask": ["SHADER_READ", "COLOR_ATTACHMENT_WRITE", *write],
            "dstStageMask": ["COLOR_ATTACHMENT_OUTPUT", *tests[:1]],
            "dstAccessMask": [
                "COLOR_ATTACHMENT_WRITE",
                *write,
                *(["DEPTH_STENCIL_ATTACHMENT_READ"] if depth else []),
            ],
        },
        {
            "srcSubpass": 0,
            "dstSubpass": "EXTERNAL",
            "srcStageMask": ["COLOR_ATTACHMENT_OUTPUT", *tests[1:]],
            "srcAccessMask": ["COLOR_ATTACHMENT_WRITE", *write],
            "dstStageMask": ["FRAGMENT_SHADER"],
            "dstAccessMask": ["SHADER_READ"],
        },
    ]


def _framebuffer(target: Target) -> Members | None:
    """The framebuffer; None if the pass resolves to a texture that does not exist."""
    if target.resolves and not target.multisampled:
        return None
    names = ["color_ms"] if target.multisampled else ["color"]
    names += ["color"] if target.resolves else []
    names += ["depth_stencil"] if target.has_depth_stencil else []
    return {
        "renderPass": target.name,
        "attachments": [f"{target.name}_{name}" for name in names],
        "width": target.width,
        "height": target.height,
        "layers": 1,
    }


def _pipeline(target: Target) -> Members:
    state = {
        "rasterizationSamples": target.samples,
        "sampleShadingEnable": False,
        "alphaToCoverageEnable": False,
        "alphaToOneEnable": False,
    }
    return {"renderPass": target.name, "subpass": 0, "multisampleState": state}


def _commands(target: Target, framebuffer: bool) -> list[Value]:
    begin: Members = {
        "renderPass": target.name,
        "framebuffer": target.name if framebuffer else None,
    }
    if target.width and target.height:
        begin["renderArea"] = {"x": 0, "y": 0, "width": target.width, "height": target.height}
    commands: list[Any] = [
        {"beginRenderPass": begin},
        {"draw": {"pipeline": target.name}},
        "endRenderPass",
    ]
    image = f"{target.name}_color"
    if target.onscreen:
        barrier = {
            "srcStageMask": ["COLOR_ATTACHMENT_OUTPUT"],
            "srcAccessMask": ["COLOR_ATTACHMENT_WRITE"],
            "dstStageMask": ["BOTTOM_OF_PIPE"],
            "images": [{"image": image, "oldLayout": "GENERAL", "newLayout": "PRESENT_SRC_KHR"}],
        }
        commands += [{"pipelineBarrier": barrier}, {"present": {"image": image}}]
    else:
        # An offscreen texture is assumed to be sampled in this frame.
        commands.append({"readImage": {"image": image, "stage": "FRAGMENT"}})
    return [Value(command, target.at) for command in commands]
