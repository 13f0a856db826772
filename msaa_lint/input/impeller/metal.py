"""The textures and render passes that the engine creates for render targets on Metal.

From its `allocator_mtl.mm` (storage modes), `render_target.cc` (the textures), `render_pass_mtl.mm`
(attachments), `surface_mtl.mm` and `swapchain_transients_mtl.mm` (the drawable).
"""

from __future__ import annotations

from typing import Any

from . import words
from .target import Config, Target, Value

Members = dict[str, Any]


def section(targets: list[Target], memoryless: bool | None, apple: bool | None) -> Members:
    """The members of a `metal` section.

    `memoryless` says whether the device supports memoryless textures (family apple2 and later),
    `apple` whether it is an Apple GPU; None if unknown.
    """
    members: Members = {"textures": {}, "renderPasses": {}, "renderPipelines": {}}
    for target in targets:
        members["textures"] |= _textures(target, memoryless, apple)
        members["renderPasses"][target.name] = Value(_render_pass(target), target.at)
        members["renderPipelines"][target.name] = Value(_pipeline(target), target.at)
    if targets and all(target.onscreen for target in targets):
        # It is unknown who samples an offscreen target. Without commands, its usage counts as a
        # read.
        members["commands"] = [
            Value(command, target.at)
            for target in targets
            for command in ({"renderPass": target.name}, {"present": f"{target.name}_color"})
        ]
    return {member: entries for member, entries in members.items() if entries}


def _textures(target: Target, memoryless: bool | None, apple: bool | None) -> Members:
    def texture(format: Value, usage: list[str], samples: Value | None, mode: Value) -> Value:
        members = {
            "pixelFormat": format.mapped(words.METAL_FORMATS),
            "width": target.width,
            "height": target.height,
            "textureType": "type2DMultisample"
            if samples is not None and samples.value > 1
            else "type2D",
            "sampleCount": samples,
            "usage": usage,
            "storageMode": _storage(mode, memoryless, apple),
        }
        return Value(members, target.at)

    color = target.color
    textures: Members = {}
    single = color.resolve_storage if target.multisampled else color.storage
    if target.multisampled:
        textures[f"{target.name}_color_ms"] = texture(
            target.color_format, ["renderTarget"], target.samples, color.storage
        )
    if target.onscreen:
        textures[f"{target.name}_color"] = Value(
            {"pixelFormat": target.color_format.mapped(words.METAL_FORMATS), "drawable": True},
            target.at,
        )
    else:
        textures[f"{target.name}_color"] = texture(
            target.color_format, ["renderTarget", "shaderRead"], None, single
        )
    if target.has_depth_stencil:
        storage = target.depth_stencil.storage
        textures[f"{target.name}_depth_stencil"] = texture(
            target.depth_format, ["renderTarget"], target.samples, storage
        )
    return textures


def _storage(mode: Value, memoryless: bool | None, apple: bool | None) -> Value:
    """`ToMTLStorageMode`: host-visible is shared with unified memory, otherwise managed."""
    if mode.value == "kDevicePrivate":
        return Value("private", mode.at)
    if mode.value == "kHostVisible":
        return Value("shared" if apple else None, mode.at)
    return Value(None if memoryless is None else "memoryless" if memoryless else "private", mode.at)


def _render_pass(target: Target) -> Members:
    color = target.color
    attachment: Members = {
        "texture": f"{target.name}_color_ms" if target.multisampled else f"{target.name}_color",
        # The engine sets a resolve texture for every multisampled target, whatever its store
        # action.
        "resolveTexture": Value(f"{target.name}_color", color.store.at)
        if target.multisampled
        else None,
        **_actions(color),
    }
    descriptor: Members = {"colorAttachments": [attachment]}
    if target.has_depth_stencil:
        aspect = {"texture": f"{target.name}_depth_stencil", **_actions(target.depth_stencil)}
        if target.has_depth:
            descriptor["depthAttachment"] = aspect
        if target.has_stencil:
            descriptor["stencilAttachment"] = aspect
    return descriptor


def _actions(config: Config) -> Members:
    return {
        "loadAction": config.load.mapped(words.METAL_ACTIONS),
        "storeAction": config.store.mapped(words.METAL_ACTIONS),
    }


def _pipeline(target: Target) -> Members:
    depth_stencil = target.depth_format.mapped(words.METAL_FORMATS)
    return {
        "renderPass": target.name,
        "rasterSampleCount": target.samples,
        "colorAttachments": [{"pixelFormat": target.color_format.mapped(words.METAL_FORMATS)}],
        "depthAttachmentPixelFormat": depth_stencil
        if target.has_depth_stencil and target.has_depth
        else None,
        "stencilAttachmentPixelFormat": depth_stencil
        if target.has_depth_stencil and target.has_stencil
        else None,
    }
