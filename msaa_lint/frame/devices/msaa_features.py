"""The features and extensions that concern multisampling, and what each is for."""

from __future__ import annotations

FEATURES = {
    "sampleRateShading": "shading once per sample (minSampleShading)",
    "alphaToOne": "alpha set to one after alpha to coverage",
    "shaderStorageImageMultisample": "multisampled storage images",
    "variableMultisampleRate": "pipelines with different sample counts in a subpass without "
    "attachments",
    "dynamicRendering": "vkCmdBeginRendering, with resolves of color, depth and stencil",
    "dynamicRenderingLocalRead": "reading attachments on the tile without subpasses",
    "multisampledRenderToSingleSampled": "samples on the tile alone, a single-sampled image in "
    "memory",
    "maintenance10": "resolve commands with a mode, also of depth and stencil",
    "customResolve": "resolves by an application's shader",
    "extendedDynamicState3RasterizationSamples": "a pipeline's sample count as dynamic state",
    "extendedDynamicState3SampleMask": "the sample mask as dynamic state",
    "extendedDynamicState3AlphaToCoverageEnable": "alpha to coverage as dynamic state",
    "extendedDynamicState3AlphaToOneEnable": "alpha to one as dynamic state",
    "extendedDynamicState3SampleLocationsEnable": "sample locations as dynamic state",
    "pipelineFragmentShadingRate": "shading less than once per pixel, by pipeline",
    "primitiveFragmentShadingRate": "shading less than once per pixel, by triangle",
    "attachmentFragmentShadingRate": "shading less than once per pixel, by an image",
    "supersampleFragmentShadingRates": "shading several times per pixel, by rate",
    "fragmentShaderSampleInterlock": "ordered access per sample",
    "tileProperties": "the driver reports tile sizes",
    "multisampleArrayImage": "multisampled images with several layers",
    "shaderSampleRateInterpolationFunctions": "interpolation at a sample in shaders",
}
"""Members of Vulkan's features structures."""

EXTENSIONS = {
    "VK_KHR_depth_stencil_resolve": "depth and stencil resolved in the pass (core in 1.2)",
    "VK_KHR_dynamic_rendering": "passes without render pass objects (core in 1.3)",
    "VK_KHR_dynamic_rendering_local_read": "reading attachments on the tile without subpasses "
    "(core in 1.4)",
    "VK_EXT_multisampled_render_to_single_sampled": "samples on the tile alone, a single-sampled "
    "image in memory",
    "VK_KHR_maintenance10": "resolve commands with a mode, also of depth and stencil",
    "VK_EXT_custom_resolve": "resolves by an application's shader",
    "VK_QCOM_render_pass_shader_resolve": "resolves by an application's shader",
    "VK_KHR_load_store_op_none": "load and store operations NONE",
    "VK_EXT_load_store_op_none": "load and store operations NONE",
    "VK_QCOM_render_pass_store_ops": "store operation NONE",
    "VK_EXT_sample_locations": "sample locations chosen by the application",
    "VK_AMD_mixed_attachment_samples": "fewer samples of color than of depth",
    "VK_NV_framebuffer_mixed_samples": "fewer samples of color than of depth",
    "VK_NV_coverage_reduction_mode": "reduction of coverage to fewer color samples",
    "VK_EXT_extended_dynamic_state3": "multisample state as dynamic state",
    "VK_KHR_fragment_shading_rate": "shading less than once per pixel",
    "VK_NV_fragment_shading_rate_enums": "shading several times per pixel, by rate",
    "VK_EXT_post_depth_coverage": "coverage after the depth test, in shaders",
    "VK_EXT_shader_tile_image": "reading samples on the tile, in shaders",
    "VK_QCOM_tile_properties": "the driver reports tile sizes",
    "VK_EXT_rasterization_order_attachment_access": "ordered reads of attachments on the tile",
    "VK_ARM_rasterization_order_attachment_access": "ordered reads of attachments on the tile",
}
"""Device extensions."""
