"""The frame in Metal's terms: the section `metal` of a description.

The members are those of Metal's descriptors in Swift, with the names of textures and passes in
place of objects. As everywhere in a description, an absent member is unknown and does not stand for
Metal's default; only an absent `resolveTexture` means that there is none.
"""

from __future__ import annotations

from typing import Annotated, Literal

from ..members import (
    MAX_METAL_COLORS,
    NO_ENTRIES,
    DepthResolveFilter,
    GPUFamily,
    LoadAction,
    MetalPassName,
    PixelFormat,
    Samples,
    Size,
    StencilResolveFilter,
    StorageMode,
    StoreAction,
    TextureName,
    TextureType,
    TextureUsage,
)
from ..record import Record
from ..shapes import Shape, shapes_of
from .commands import Command

MetalStage = Literal["vertex", "fragment", "compute", "tile"]


def _by_color(record: type[Record]) -> Shape:
    """Color attachments: a mapping by index, or a list; null for an unused one."""
    return (
        "either",
        ("numbered", ("null", ("record", record)), MAX_METAL_COLORS - 1),
        ("list", ("null", ("record", record)), MAX_METAL_COLORS),
    )


class MetalRecord(Record):
    """A structure of a frame in Metal's terms."""


class MetalTexture(MetalRecord):
    """MTLTextureDescriptor; `drawable` marks a texture of a CAMetalLayer, `encoding` says what the
    values encode.
    """

    pixelFormat: PixelFormat | None = None
    width: Size | None = None
    height: Size | None = None
    textureType: TextureType | None = None
    sampleCount: Samples | None = None
    usage: TextureUsage | None = None
    storageMode: StorageMode | None = None
    mipmapLevelCount: Size | None = None
    arrayLength: Size | None = None
    drawable: bool | None = None
    encoding: Literal["LINEAR", "GAMMA", "DATA"] | None = None


class MetalColorAttachment(MetalRecord):
    """MTLRenderPassColorAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None


class MetalDepthAttachment(MetalRecord):
    """MTLRenderPassDepthAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None
    depthResolveFilter: DepthResolveFilter | None = None


class MetalStencilAttachment(MetalRecord):
    """MTLRenderPassStencilAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None
    stencilResolveFilter: StencilResolveFilter | None = None


MetalPassColors = Annotated[
    dict[str, MetalColorAttachment | None] | tuple[MetalColorAttachment | None, ...],
    _by_color(MetalColorAttachment),
]


class MetalRenderPass(MetalRecord):
    """MTLRenderPassDescriptor; `colorAttachments` is a list, or a mapping by index; null is an
    unused attachment.
    """

    colorAttachments: MetalPassColors = ()
    depthAttachment: MetalDepthAttachment | None = None
    stencilAttachment: MetalStencilAttachment | None = None


class MetalPipelineColor(MetalRecord):
    """MTLRenderPipelineColorAttachmentDescriptor."""

    pixelFormat: PixelFormat | None = None
    isBlendingEnabled: bool | None = None
    blendingEnabled: bool | None = None


MetalPipelineColors = Annotated[
    dict[str, MetalPipelineColor | None] | tuple[MetalPipelineColor | None, ...],
    _by_color(MetalPipelineColor),
]


class MetalRenderPipeline(MetalRecord):
    """MTLRenderPipelineDescriptor; Objective-C's and deprecated names of a property are
    accepted.
    """

    renderPass: MetalPassName | None = None
    rasterSampleCount: Samples | None = None
    sampleCount: Samples | None = None
    colorAttachments: MetalPipelineColors = ()
    depthAttachmentPixelFormat: PixelFormat | None = None
    stencilAttachmentPixelFormat: PixelFormat | None = None
    isAlphaToCoverageEnabled: bool | None = None
    alphaToCoverageEnabled: bool | None = None
    isAlphaToOneEnabled: bool | None = None
    alphaToOneEnabled: bool | None = None
    isRasterizationEnabled: bool | None = None
    rasterizationEnabled: bool | None = None


class MetalRead(MetalRecord):
    """A shader reads the texture; for a multisampled one, the samples that it reads and how it
    combines them.
    """

    texture: TextureName | None = None
    stage: MetalStage | None = None
    samples: Literal[1, "ALL"] | None = None
    resolves: Literal["AVERAGE", "MIN", "MAX", "OTHER"] | None = None


class MetalWrite(MetalRecord):
    """A shader writes the texture."""

    texture: TextureName | None = None
    stage: MetalStage | None = None


class MetalCopy(MetalRecord):
    """A copy by a blit encoder."""

    source: TextureName | None = None
    destination: TextureName | None = None


class MetalCommand(Command, MetalRecord):
    """What a command buffer encodes: a whole render pass, a read or a write by a shader, a copy,
    the presentation of a drawable.
    """

    SHAPE = shapes_of(
        renderPass=MetalPassName,
        readTexture=MetalRead,
        writeTexture=MetalWrite,
        copy=MetalCopy,
        present=TextureName,
    )


class Metal(MetalRecord):
    """A frame in Metal's terms, and what the GPU supports: its family, and the counts for which
    supportsTextureSampleCount is true.
    """

    family: GPUFamily | None = None
    supportedSampleCounts: tuple[Samples, ...] | None = None
    textures: dict[str, MetalTexture] = NO_ENTRIES
    renderPasses: dict[str, MetalRenderPass] = NO_ENTRIES
    renderPipelines: dict[str, MetalRenderPipeline] = NO_ENTRIES
    commands: tuple[Annotated[MetalCommand, ("command", MetalCommand)], ...] | None = None
