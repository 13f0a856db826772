"""The frame in Metal's words: the section `metal` of a description.

The names are those of Metal's descriptors as Swift has them, with the names of textures and passes in place of objects. An absent property
is unknown, and not Metal's default, as in the rest of a description; an absent `resolveTexture` is none.
"""

from __future__ import annotations

import warnings
from typing import Annotated, Any, Literal

from annotated_types import MaxLen
from pydantic import ConfigDict, model_validator

from .fields import MAX_COLOR_ATTACHMENTS, Bool, ColorIndex, Enumerant, FlagBits, MetalPassName, Samples, Size, TextureName, Word
from .struct import Struct

PixelFormat = Annotated[str, Enumerant("MTLPixelFormat")]
LoadAction = Annotated[str, Enumerant("MTLLoadAction")]
StoreAction = Annotated[str, Enumerant("MTLStoreAction")]
MetalStage = Literal["vertex", "fragment", "compute", "tile"]


class MetalTexture(Struct):
    """MTLTextureDescriptor; `drawable` is a texture of a CAMetalLayer, `encoding` what the values mean."""

    pixelFormat: PixelFormat | None = None
    width: Size | None = None
    height: Size | None = None
    textureType: Annotated[str, Enumerant("MTLTextureType")] | None = None
    sampleCount: Samples | None = None
    usage: Annotated[tuple[str, ...], FlagBits("MTLTextureUsage")] | None = None
    storageMode: Annotated[str, Enumerant("MTLStorageMode")] | None = None
    mipmapLevelCount: Size | None = None
    arrayLength: Size | None = None
    drawable: Bool | None = None
    encoding: Literal["LINEAR", "GAMMA", "DATA"] | None = None


class MetalColorAttachment(Struct):
    """MTLRenderPassColorAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None


class MetalDepthAttachment(Struct):
    """MTLRenderPassDepthAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None
    depthResolveFilter: Annotated[str, Enumerant("MTLMultisampleDepthResolveFilter")] | None = None


class MetalStencilAttachment(Struct):
    """MTLRenderPassStencilAttachmentDescriptor."""

    texture: TextureName | None = None
    resolveTexture: TextureName | None = None
    loadAction: LoadAction | None = None
    storeAction: StoreAction | None = None
    stencilResolveFilter: Annotated[str, Enumerant("MTLMultisampleStencilResolveFilter")] | None = None


class MetalRenderPass(Struct):
    """MTLRenderPassDescriptor; the colour attachments are a list, or a mapping by index, null for one that is not used."""

    colorAttachments: (
        dict[ColorIndex, MetalColorAttachment | None] | Annotated[tuple[MetalColorAttachment | None, ...], MaxLen(MAX_COLOR_ATTACHMENTS)]
    ) = ()
    depthAttachment: MetalDepthAttachment | None = None
    stencilAttachment: MetalStencilAttachment | None = None


class MetalPipelineColor(Struct):
    """MTLRenderPipelineColorAttachmentDescriptor."""

    pixelFormat: PixelFormat | None = None
    isBlendingEnabled: Bool | None = None
    blendingEnabled: Bool | None = None


class MetalRenderPipeline(Struct):
    """MTLRenderPipelineDescriptor; names that Objective-C has otherwise, or that are deprecated, stand for the same property."""

    renderPass: MetalPassName | None = None
    rasterSampleCount: Samples | None = None
    sampleCount: Samples | None = None
    colorAttachments: (
        dict[ColorIndex, MetalPipelineColor | None] | Annotated[tuple[MetalPipelineColor | None, ...], MaxLen(MAX_COLOR_ATTACHMENTS)]
    ) = ()
    depthAttachmentPixelFormat: PixelFormat | None = None
    stencilAttachmentPixelFormat: PixelFormat | None = None
    isAlphaToCoverageEnabled: Bool | None = None
    alphaToCoverageEnabled: Bool | None = None
    isAlphaToOneEnabled: Bool | None = None
    alphaToOneEnabled: Bool | None = None
    isRasterizationEnabled: Bool | None = None
    rasterizationEnabled: Bool | None = None


class MetalRead(Struct):
    """A shader reads the texture; of a multisampled one which samples it reads, and what it does with them."""

    texture: TextureName | None = None
    stage: MetalStage | None = None
    samples: Annotated[Literal[1, "ALL"], Word] | None = None
    resolves: Literal["AVERAGE", "MIN", "MAX", "OTHER"] | None = None


class MetalWrite(Struct):
    """A shader writes the texture."""

    texture: TextureName | None = None
    stage: MetalStage | None = None


class MetalCopy(Struct):
    """A blit encoder's copy from one texture to another."""

    source: TextureName | None = None
    destination: TextureName | None = None


with warnings.catch_warnings():
    # `copy` is a method of every model, and the name of Metal's command.
    warnings.simplefilter("ignore", UserWarning)

    class MetalCommand(Struct):
        """What a command buffer encodes: a whole render pass, what its shaders read or write, a copy, a drawable that is presented."""

        model_config = ConfigDict(json_schema_extra={"minProperties": 1, "maxProperties": 1})

        @model_validator(mode="before")
        @classmethod
        def _is_one(cls, given: Any) -> Any:
            if isinstance(given, dict) and len(given) != 1:
                raise ValueError("one command is due here")
            return given

        renderPass: MetalPassName | None = None
        readTexture: MetalRead | None = None
        writeTexture: MetalWrite | None = None
        copy: MetalCopy | None = None  # type: ignore[assignment]
        present: TextureName | None = None


class Metal(Struct):
    """A frame in Metal's words, and what the GPU offers: its family, and what supportsTextureSampleCount says."""

    family: Annotated[str, Enumerant("MTLGPUFamily")] | None = None
    supportedSampleCounts: tuple[Samples, ...] | None = None
    textures: dict[str, MetalTexture] = {}
    renderPasses: dict[str, MetalRenderPass] = {}
    renderPipelines: dict[str, MetalRenderPipeline] = {}
    commands: tuple[MetalCommand, ...] | None = None
