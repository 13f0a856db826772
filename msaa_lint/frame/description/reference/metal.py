"""What the keys of a frame in Metal's terms mean."""

from .entries import Key, Structure

_TEXTURE = Key("Texture", "The name of the texture in `textures`.")
_RESOLVE = Key(
    "Resolve texture",
    "The name of the single-sampled texture that the samples are resolved to.",
    absent="none",
)
_LOAD = Key(
    "Load action",
    "What happens to the texture when the pass begins. `load` reads every sample from memory; "
    "`clear` and `dontCare` do not.",
)
_STORE = Key(
    "Store action",
    "What happens to the texture when the pass ends. `multisampleResolve` writes the resolved "
    "texture alone, "
    "`storeAndMultisampleResolve` the samples as well.",
)
_STAGE = Key(
    "Shader stage",
    "The stage of the shader that accesses the texture: vertex, fragment, compute or tile.",
    source="MTLRenderStages",
)
_COUNT = Key(
    "Sample count",
    "The samples of a pixel with which the pipeline rasterizes.",
    source="MTLRenderPipelineDescriptor.rasterSampleCount",
)
_BLENDING = Key(
    "Blending",
    "Whether the output is blended with the attachment.",
    source="MTLRenderPipelineColorAttachmentDescriptor.isBlendingEnabled",
)
_COVERAGE = Key(
    "Alpha to coverage",
    "Whether alpha decides how many samples of a pixel are covered.",
    source="MTLRenderPipelineDescriptor.isAlphaToCoverageEnabled",
)
_TO_ONE = Key(
    "Alpha to one",
    "Whether alpha is replaced by 1 after alpha to coverage.",
    source="MTLRenderPipelineDescriptor.isAlphaToOneEnabled",
)
_RASTER = Key(
    "Rasterization",
    "Whether primitives are rasterized.",
    source="MTLRenderPipelineDescriptor.isRasterizationEnabled",
)


def _attachment(structure: str) -> dict[str, Key]:
    """The keys that the three kinds of attachment of a pass have in common, with their source."""
    keys = {
        "texture": _TEXTURE,
        "resolveTexture": _RESOLVE,
        "loadAction": _LOAD,
        "storeAction": _STORE,
    }
    return {
        name: key._replace(source=f"MTLRenderPassAttachmentDescriptor.{name}")
        for name, key in keys.items()
    }


METAL_STRUCTURES = {
    "MetalTexture": Structure(
        "Metal texture",
        "MTLTextureDescriptor",
        "",
        {
            "pixelFormat": Key(
                "Pixel format",
                "The format of the texels: how many bytes a sample takes, and its aspects.",
            ),
            "width": Key("Width", "The width of mip level 0.", "texels"),
            "height": Key("Height", "The height of mip level 0.", "texels"),
            "textureType": Key(
                "Texture type",
                "The type of the texture; type2DMultisample for one with several samples per "
                "texel.",
            ),
            "sampleCount": Key(
                "Sample count",
                "The samples of a texel.",
                absent="1 for a drawable or a type that is not multisampled, else unknown",
            ),
            "usage": Key(
                "Usages",
                "All ways in which the texture may be used. An empty usage, or `unknown`, allows "
                "every use.",
                absent="unknown",
            ),
            "storageMode": Key(
                "Storage mode",
                "Where the texture is stored. A `memoryless` one exists only on the tile and takes "
                "no memory.",
            ),
            "mipmapLevelCount": Key(
                "Mip levels",
                "The number of levels of detail. A multisampled texture has one.",
                "levels",
            ),
            "arrayLength": Key("Array length", "The number of layers.", "layers"),
            "drawable": Key(
                "Drawable",
                "Whether the texture is that of a CAMetalLayer's drawable, with one sample per "
                "texel.",
                absent="false",
                source="CAMetalDrawable.texture",
            ),
            "encoding": Key(
                "Encoding",
                "What the values stand for: LINEAR light, GAMMA-encoded color, or DATA, which is "
                "not color. "
                "An average of samples is right for LINEAR values only.",
                source="",
            ),
        },
    ),
    "MetalColorAttachment": Structure(
        "Color attachment of a Metal pass",
        "MTLRenderPassColorAttachmentDescriptor",
        "",
        _attachment("Color"),
    ),
    "MetalDepthAttachment": Structure(
        "Depth attachment of a Metal pass",
        "MTLRenderPassDepthAttachmentDescriptor",
        "",
        {
            **_attachment("Depth"),
            "depthResolveFilter": Key(
                "Depth resolve filter",
                "How the depth samples of a pixel become one value.",
                absent="sample0",
            ),
        },
    ),
    "MetalStencilAttachment": Structure(
        "Stencil attachment of a Metal pass",
        "MTLRenderPassStencilAttachmentDescriptor",
        "",
        {
            **_attachment("Stencil"),
            "stencilResolveFilter": Key(
                "Stencil resolve filter",
                "How the stencil samples of a pixel become one value.",
                absent="sample0",
            ),
        },
    ),
    "MetalRenderPass": Structure(
        "Metal render pass",
        "MTLRenderPassDescriptor",
        "",
        {
            "colorAttachments": Key(
                "Color attachments",
                "The color attachments, as a list, or by index; null for an unused one.",
            ),
            "depthAttachment": Key(
                "Depth attachment", "The attachment of the depth test.", absent="none"
            ),
            "stencilAttachment": Key(
                "Stencil attachment", "The attachment of the stencil test.", absent="none"
            ),
        },
    ),
    "MetalPipelineColor": Structure(
        "Color attachment of a Metal pipeline",
        "MTLRenderPipelineColorAttachmentDescriptor",
        "",
        {
            "pixelFormat": Key("Pixel format", "The format of the color attachment."),
            "isBlendingEnabled": _BLENDING,
            "blendingEnabled": _BLENDING._replace(title="Blending, in Objective-C"),
        },
    ),
    "MetalRenderPipeline": Structure(
        "Metal render pipeline",
        "MTLRenderPipelineDescriptor",
        "",
        {
            "renderPass": Key(
                "Render pass", "The name in `renderPasses` of the pass that it draws in.", source=""
            ),
            "rasterSampleCount": _COUNT,
            "sampleCount": _COUNT._replace(title="Sample count, by its older name"),
            "colorAttachments": Key(
                "Color attachments",
                "The formats and the blending of color attachments, as a list, or by index.",
            ),
            "depthAttachmentPixelFormat": Key(
                "Depth format", "The format of the depth attachment."
            ),
            "stencilAttachmentPixelFormat": Key(
                "Stencil format", "The format of the stencil attachment."
            ),
            "isAlphaToCoverageEnabled": _COVERAGE,
            "alphaToCoverageEnabled": _COVERAGE._replace(title="Alpha to coverage, in Objective-C"),
            "isAlphaToOneEnabled": _TO_ONE,
            "alphaToOneEnabled": _TO_ONE._replace(title="Alpha to one, in Objective-C"),
            "isRasterizationEnabled": _RASTER,
            "rasterizationEnabled": _RASTER._replace(title="Rasterization, in Objective-C"),
        },
    ),
    "MetalRead": Structure(
        "Read a texture in a shader",
        "",
        "",
        {
            "texture": _TEXTURE,
            "stage": _STAGE,
            "samples": Key(
                "Samples read",
                "Of a multisampled texture: 1 if only one sample of a texel is read, ALL if every "
                "one is.",
                "samples per texel",
            ),
            "resolves": Key(
                "Combination of samples",
                "What the shader does with the samples of a texel: AVERAGE, MIN, MAX, or OTHER.",
            ),
        },
    ),
    "MetalWrite": Structure(
        "Write a texture in a shader", "", "", {"texture": _TEXTURE, "stage": _STAGE}
    ),
    "MetalCopy": Structure(
        "Copy a texture",
        "",
        "",
        {
            "source": Key(
                "Source texture",
                "The name in `textures` of the texture that is read.",
                source="MTLBlitCommandEncoder.copy(from:to:)",
            ),
            "destination": Key(
                "Destination texture",
                "The name in `textures` of the texture that is written.",
                source="MTLBlitCommandEncoder.copy(from:to:)",
            ),
        },
    ),
    "MetalCommand": Structure(
        "Metal command",
        "",
        "",
        {
            "renderPass": Key(
                "Encode a render pass",
                "The name in `renderPasses` of the pass, with all that it draws.",
                source="MTLCommandBuffer.makeRenderCommandEncoder(descriptor:)",
            ),
            "readTexture": Key(
                "Read a texture in a shader",
                "A shader reads the texture, so that its contents must have been stored.",
            ),
            "writeTexture": Key(
                "Write a texture in a shader", "A shader writes the texture, such as a kernel."
            ),
            "copy": Key(
                "Copy a texture",
                "A blit encoder copies the texture.",
                source="MTLBlitCommandEncoder.copy(from:to:)",
            ),
            "present": Key(
                "Present a drawable", "Shows a drawable.", source="MTLCommandBuffer.present(_:)"
            ),
        },
    ),
    "Metal": Structure(
        "Metal frame",
        "",
        "",
        {
            "family": Key(
                "GPU family",
                "The GPU family, such as apple7. Without a device, it stands for what all of its "
                "GPUs support.",
                source="MTLGPUFamily",
            ),
            "supportedSampleCounts": Key(
                "Supported sample counts",
                "All sample counts that the GPU supports.",
                absent="those of the family",
                source="MTLDevice.supportsTextureSampleCount(_:)",
            ),
            "textures": Key(
                "Textures", "The textures of the frame, by name.", source="MTLTextureDescriptor"
            ),
            "renderPasses": Key(
                "Render passes", "The render passes, by name.", source="MTLRenderPassDescriptor"
            ),
            "renderPipelines": Key(
                "Render pipelines",
                "The render pipelines, by name.",
                source="MTLRenderPipelineDescriptor",
            ),
            "commands": Key(
                "Commands",
                "What every frame encodes, in order.",
                absent="every pass once, in order",
                source="MTLCommandBuffer",
            ),
        },
    ),
}
