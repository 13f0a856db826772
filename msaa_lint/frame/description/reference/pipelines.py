"""What the keys of pipelines mean."""

from .entries import Key, Structure

PIPELINE_STRUCTURES = {
    "MultisampleState": Structure(
        "Multisample state",
        "VkPipelineMultisampleStateCreateInfo",
        "primsrast-multisampling",
        {
            "rasterizationSamples": Key(
                "Sample count",
                "The samples of a pixel with which the pipeline rasterizes. It must match the "
                "attachments of its subpass.",
            ),
            "sampleShadingEnable": Key(
                "Sample shading",
                "Whether the fragment shader runs several times for a pixel, which costs as many "
                "times the shading.",
                section="primsrast-sampleshading",
            ),
            "minSampleShading": Key(
                "Minimum share of samples shaded",
                "With `sampleShadingEnable`, the share of the samples of a pixel that are shaded "
                "at least. 1.0 shades every sample.",
                "fraction from 0 to 1",
                section="primsrast-sampleshading",
            ),
            "sampleMask": Key(
                "Sample mask",
                "The samples that may be written, a bit for each, in words of 32 bits.",
                "bit mask of samples",
                "all samples",
                section="fragops-samplemask",
            ),
            "alphaToCoverageEnable": Key(
                "Alpha to coverage",
                "Whether the alpha of color output 0 decides how many samples of a pixel are "
                "covered.",
                section="fragops-covg",
            ),
            "alphaToOneEnable": Key(
                "Alpha to one",
                "Whether alpha is replaced by 1 after alpha to coverage.",
                section="fragops-covg",
            ),
        },
    ),
    "ColorBlendAttachment": Structure(
        "Blending of a color attachment",
        "VkPipelineColorBlendAttachmentState",
        "framebuffer-blending",
        {
            "blendEnable": Key(
                "Blending",
                "Whether the output is blended with the samples of the attachment. Without it, the "
                "output replaces them.",
            ),
            "colorWriteMask": Key(
                "Color write mask",
                "The components that are written.",
                absent="unknown",
                section="framebuffer-color-write-mask",
            ),
            "srcColorBlendFactor": Key(
                "Source color factor",
                "What the color of the output is multiplied with.",
                section="framebuffer-blendfactors",
            ),
            "dstColorBlendFactor": Key(
                "Destination color factor",
                "What the color of the attachment is multiplied with.",
                section="framebuffer-blendfactors",
            ),
            "colorBlendOp": Key(
                "Color operation",
                "How the two products of color are combined.",
                section="framebuffer-blendoperations",
            ),
            "srcAlphaBlendFactor": Key(
                "Source alpha factor",
                "What the alpha of the output is multiplied with.",
                section="framebuffer-blendfactors",
            ),
            "dstAlphaBlendFactor": Key(
                "Destination alpha factor",
                "What the alpha of the attachment is multiplied with.",
                section="framebuffer-blendfactors",
            ),
            "alphaBlendOp": Key(
                "Alpha operation",
                "How the two products of alpha are combined.",
                section="framebuffer-blendoperations",
            ),
        },
    ),
    "ColorBlendState": Structure(
        "Color blend state",
        "VkPipelineColorBlendStateCreateInfo",
        "framebuffer-blending",
        {
            "logicOpEnable": Key(
                "Logical operations",
                "Whether the output is combined with the attachment bit by bit instead of by "
                "blending.",
                section="framebuffer-logicop",
            ),
            "attachments": Key(
                "Color attachments", "The blending of each color attachment, in order."
            ),
        },
    ),
    "DepthStencilState": Structure(
        "Depth-stencil state",
        "VkPipelineDepthStencilStateCreateInfo",
        "fragops-ds-state",
        {
            "depthTestEnable": Key(
                "Depth test",
                "Whether samples are compared with the depth attachment.",
                section="fragops-depth",
            ),
            "depthWriteEnable": Key(
                "Depth writes",
                "Whether samples that pass the depth test write their depth.",
                section="fragops-depth-write",
            ),
            "depthCompareOp": Key(
                "Depth comparison",
                "The comparison that a sample must pass. GREATER suits reversed depth.",
                section="fragops-depth",
            ),
            "depthBoundsTestEnable": Key(
                "Depth bounds test",
                "Whether samples whose stored depth is out of bounds are discarded.",
                section="fragops-dbt",
            ),
            "stencilTestEnable": Key(
                "Stencil test",
                "Whether samples are compared with the stencil attachment.",
                section="fragops-stencil",
            ),
        },
    ),
    "VertexBinding": Structure(
        "Vertex binding",
        "VkVertexInputBindingDescription",
        "fxvertex-input",
        {
            "binding": Key("Binding", "The number of the binding.", "index from 0"),
            "stride": Key(
                "Stride", "The distance between consecutive elements of the buffer.", "bytes"
            ),
            "inputRate": Key(
                "Input rate", "Whether the element advances with each vertex or each instance."
            ),
        },
    ),
    "VertexAttribute": Structure(
        "Vertex attribute",
        "VkVertexInputAttributeDescription",
        "fxvertex-input",
        {
            "location": Key("Location", "The location of the shader's input.", "index from 0"),
            "binding": Key(
                "Binding", "The binding that the attribute is read from.", "index from 0"
            ),
            "format": Key("Format", "The format of the attribute.", section="formats-definition"),
            "offset": Key(
                "Offset", "The offset of the attribute from the start of an element.", "bytes"
            ),
        },
    ),
    "VertexInputState": Structure(
        "Vertex input state",
        "VkPipelineVertexInputStateCreateInfo",
        "fxvertex-input",
        {
            "vertexBindingDescriptions": Key(
                "Vertex bindings", "The buffers that vertices are read from."
            ),
            "vertexAttributeDescriptions": Key("Vertex attributes", "The attributes of a vertex."),
        },
    ),
    "InputAssemblyState": Structure(
        "Input assembly state",
        "VkPipelineInputAssemblyStateCreateInfo",
        "drawing-primitive-topologies",
        {
            "topology": Key(
                "Primitive topology", "What vertices are assembled to, such as a list of triangles."
            )
        },
    ),
    "RasterizationState": Structure(
        "Rasterization state",
        "VkPipelineRasterizationStateCreateInfo",
        "primsrast",
        {
            "rasterizerDiscardEnable": Key(
                "Rasterizer discard",
                "Whether primitives are discarded before rasterization, so that no samples are "
                "drawn.",
                section="primsrast-discard",
            ),
            "polygonMode": Key(
                "Polygon mode",
                "Whether polygons are filled or drawn as lines or points.",
                section="primsrast-polygonmode",
            ),
            "depthClampEnable": Key(
                "Depth clamping",
                "Whether depth is clamped to its range instead of clipping primitives.",
                section="vertexpostproc-clipping",
            ),
            "depthBiasEnable": Key(
                "Depth bias",
                "Whether depth is biased, as for shadow maps.",
                section="primsrast-depthbias-enable",
            ),
        },
    ),
    "ShaderStage": Structure(
        "Shader stage",
        "VkPipelineShaderStageCreateInfo",
        "pipelines-graphics",
        {
            "stage": Key("Stage", "The stage of the shader, such as FRAGMENT."),
            "module": Key(
                "SPIR-V file",
                "The path of the SPIR-V module, relative to the description.",
                source="VkPipelineShaderStageCreateInfo::module",
            ),
            "name": Key("Entry point", "The name of the entry point in the module."),
            "specialization": Key(
                "Specialization constants",
                "The values of specialization constants, by constant ID.",
                "the unit of the shader's constant",
                "the values in the module",
                "VkPipelineShaderStageCreateInfo::pSpecializationInfo",
                "pipelines-specialization-constants",
            ),
        },
    ),
    "PipelineRendering": Structure(
        "Formats for dynamic rendering",
        "VkPipelineRenderingCreateInfo",
        "pipelines-graphics",
        {
            "viewMask": Key(
                "View mask",
                "The views that the pipeline renders to, a bit for each; 0 without multiview.",
                "bit mask of views",
            ),
            "colorAttachmentFormats": Key(
                "Color formats",
                "The formats of the color attachments, in order; null for an unused one.",
            ),
            "depthAttachmentFormat": Key("Depth format", "The format of the depth attachment."),
            "stencilAttachmentFormat": Key(
                "Stencil format", "The format of the stencil attachment."
            ),
        },
    ),
    "Pipeline": Structure(
        "Graphics pipeline",
        "VkGraphicsPipelineCreateInfo",
        "pipelines-graphics",
        {
            "renderPass": Key(
                "Render pass",
                "The name in `renderPasses` of the render pass that it draws in; `rendering` in "
                "its place for dynamic rendering.",
            ),
            "subpass": Key(
                "Subpass", "The subpass of `renderPass` that it draws in.", "index from 0"
            ),
            "rendering": Key(
                "Dynamic rendering",
                "The formats of the attachments, for a pipeline that draws without a render pass "
                "object.",
                absent="the pipeline belongs to `renderPass`",
                source="VkPipelineRenderingCreateInfo",
            ),
            "multisampleState": Key(
                "Multisample state",
                "The sample count, sample shading, and coverage.",
                section="primsrast-multisampling",
            ),
            "colorBlendState": Key(
                "Color blend state",
                "How output is combined with the color attachments.",
                section="framebuffer-blending",
            ),
            "depthStencilState": Key(
                "Depth-stencil state", "The depth and stencil tests.", section="fragops-ds-state"
            ),
            "vertexInputState": Key(
                "Vertex input state", "How vertices are read.", section="fxvertex-input"
            ),
            "inputAssemblyState": Key(
                "Input assembly state",
                "How vertices are assembled to primitives.",
                section="drawing-primitive-topologies",
            ),
            "rasterizationState": Key(
                "Rasterization state", "How primitives are rasterized.", section="primsrast"
            ),
            "dynamicState": Key(
                "Dynamic states",
                "The states that commands set instead of the pipeline, such as "
                "RASTERIZATION_SAMPLES_EXT.",
                source="VkGraphicsPipelineCreateInfo::pDynamicState",
                section="pipelines-dynamic-state",
            ),
            "stages": Key(
                "Shader stages",
                "The shaders. From SPIR-V files it is known what they do with samples.",
            ),
        },
    ),
}
