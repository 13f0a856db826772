"""Metal's names in source code: `MTLStoreAction.store` and `.store` in Swift, `MTLStoreActionStore`
in Objective-C, `MTL::StoreActionStore` in metal-cpp.
"""

from __future__ import annotations

import re

from msaa_lint.frame.metal.names import ENUMS, parse

KINDS = {
    "MTLTextureDescriptor": "texture",
    "MTLRenderPassDescriptor": "pass",
    "MTL4RenderPassDescriptor": "pass",
    "MTLRenderPipelineDescriptor": "pipeline",
    "MTL4RenderPipelineDescriptor": "pipeline",
    "MTLRenderPassAttachmentDescriptor": "attachment",
    "MTLRenderPassColorAttachmentDescriptor": "attachment",
    "MTLRenderPassDepthAttachmentDescriptor": "attachment",
    "MTLRenderPassStencilAttachmentDescriptor": "attachment",
    "MTLRenderPipelineColorAttachmentDescriptor": "attachment",
    "MTKView": "view",
    "CAMetalLayer": "layer",
    "CAMetalDrawable": "drawable",
    "MTLDrawable": "drawable",
    "MTLCommandBuffer": "commands",
}
"""The kind of object that each of Metal's types is."""

SHARED = frozenset({"view", "layer", "drawable"})
"""Kinds of which a program has a single object, with several names."""

DESCRIPTOR_METHODS = {
    "texture2DDescriptor": "",
    "texture2DDescriptorWithPixelFormat": "",
    "textureCubeDescriptor": "typeCube",
    "textureCubeDescriptorWithPixelFormat": "typeCube",
    "textureBufferDescriptor": "typeTextureBuffer",
    "textureBufferDescriptorWithPixelFormat": "typeTextureBuffer",
}
"""Class methods that create a texture descriptor, and the texture type that each sets."""

CREATES = (
    (re.compile(r"(?:make|new)Texture(?:WithDescriptor)?$"), "texture"),
    (
        re.compile(r"(?:makeR|makeParallelR|r|parallelR)enderCommandEncoder(?:WithDescriptor)?$"),
        "pass",
    ),
    (re.compile(r"(?:make|new)RenderPipelineState(?:WithDescriptor)?$"), "pipeline"),
)
"""Methods that create an object, and the kind of their descriptor."""

PLAIN_OBJECTS = {
    "makeBlitCommandEncoder": "blit",
    "blitCommandEncoder": "blit",
    "makeComputeCommandEncoder": "compute",
    "computeCommandEncoder": "compute",
    "makeCommandBuffer": "commands",
    "makeCommandBufferWithUnretainedReferences": "commands",
    "commandBuffer": "commands",
    "commandBufferWithUnretainedReferences": "commands",
}
"""Methods that create an object without a descriptor, and its kind."""

READS = {
    "setFragmentTexture": "fragment",
    "setVertexTexture": "vertex",
    "setTileTexture": "tile",
}
"""Methods of encoders that bind a texture, and the stage that reads it."""

STORES = {
    "setColorStoreAction": "color",
    "setDepthStoreAction": "depthAttachment",
    "setStencilStoreAction": "stencilAttachment",
}
"""Methods of encoders that state the store action of an attachment."""

MEMBERS = frozenset({
    "pixelFormat", "width", "height", "depth", "mipmapLevelCount", "arrayLength", "textureType",
    "sampleCount", "usage", "storageMode",
    "resourceOptions", "texture", "resolveTexture", "loadAction", "storeAction",
    "depthResolveFilter", "stencilResolveFilter",
    "rasterSampleCount", "depthAttachmentPixelFormat", "stencilAttachmentPixelFormat",
    "isRasterizationEnabled", "colorAttachments",
    "depthAttachment", "stencilAttachment", "colorPixelFormat", "depthStencilPixelFormat",
    "currentRenderPassDescriptor",
    "currentMTL4RenderPassDescriptor", "currentDrawable", "multisampleColorTexture",
    "depthStencilTexture", "layer",
})  # fmt: skip
"""Members of Metal's objects, which Objective-C and metal-cpp read by a call."""

PASS_SOURCES = frozenset({"currentRenderPassDescriptor", "currentMTL4RenderPassDescriptor"})
ATTACHMENTS = frozenset({"depthAttachment", "stencilAttachment"})

_SPELLED = {"MTLResourceStorageMode": "storageMode"}
_ENUMS = tuple(sorted(ENUMS, key=len, reverse=True))
_TYPE = re.compile(r"(?:(?:any|some|inout)(?=[A-Z]))?((?:(?:MTL4?|CA|MTK|NS)::)?[A-Za-z_]\w*)")
_INNER = re.compile(r"(?:id|NS::SharedPtr|__kindof)<(.+)>")
_BOOLEANS = {"YES": True, "NO": False}


def type_name(type_text: str) -> str:
    """Returns the name of a type without qualifiers, as in Objective-C: `MTLTexture` for
    `id<MTLTexture>` and `MTL::Texture*`.
    """
    inner = _INNER.match(type_text)
    match = _TYPE.match(inner[1] if inner is not None else type_text.strip())
    return match[1].replace("::", "", 1) if match is not None else ""


def kind_of(type_text: str) -> str:
    """Returns the kind of object that a type is, or an empty string."""
    return KINDS.get(type_name(type_text), "")


def constant(name: str) -> str | bool | None:
    """Returns the value of a constant: an enumerant in Swift's spelling, or a boolean; None for
    other names.
    """
    if name[:1] == ".":
        return name[1:]
    if name in _BOOLEANS:
        return _BOOLEANS[name]
    if not name.startswith("MTL"):
        return None
    prefix, dot, word = name.partition(".")
    if dot:
        return word
    spelled = name.replace("MTL::", "MTL", 1)
    for enum in _ENUMS:
        if spelled.startswith(enum):
            return parse(enum, spelled)
    prefix = next((prefix for prefix in _SPELLED if spelled.startswith(prefix)), "")
    return _SPELLED[prefix] + spelled.removeprefix(prefix) if prefix else None


def member(name: str) -> str:
    """Returns a member's name as descriptions spell it. Objective-C and metal-cpp have no `is`
    before booleans.
    """
    return (
        f"is{name[0].upper()}{name[1:]}"
        if name in ("alphaToCoverageEnabled", "alphaToOneEnabled", "blendingEnabled")
        else name
    )


def setter_member(method: str) -> str | None:
    """Returns the member that a setter sets, or None."""
    if len(method) < 4 or not method.startswith("set") or not method[3].isupper():
        return None
    return member(method[3].lower() + method[4:])
