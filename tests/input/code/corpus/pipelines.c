/* Pipelines alone: sample shading, alpha to coverage, a sample mask. The features that are enabled are in this file too. */
#include <string.h>
#include <vulkan/vulkan.h>

static const VkSampleMask half_mask = 0x3;

VkDevice make_device(VkPhysicalDevice gpu, uint32_t family) {
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = family,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    VkPhysicalDeviceFeatures features = {
        .samplerAnisotropy = VK_TRUE,
        .sampleRateShading = VK_TRUE,
    };
    VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .pEnabledFeatures = &features,
    };
    VkDevice device = VK_NULL_HANDLE;
    vkCreateDevice(gpu, &info, NULL, &device);
    return device;
}

static VkPipeline make(VkDevice device, VkRenderPass pass, VkPipelineLayout layout, const VkPipelineMultisampleStateCreateInfo *multisample,
                       VkBool32 blend) {
    VkPipelineColorBlendAttachmentState attachment = {.blendEnable = blend, .colorWriteMask = 0xf};
    VkPipelineColorBlendStateCreateInfo blending = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &attachment,
    };
    VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pMultisampleState = multisample,
        .pColorBlendState = &blending,
        .layout = layout,
        .renderPass = pass,
    };
    VkPipeline pipeline = VK_NULL_HANDLE;
    vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline);
    return pipeline;
}

void make_pipelines(VkDevice device, VkRenderPass pass, VkRenderPass shadow_pass, VkPipelineLayout layout, VkPipeline out[6]) {
    VkPipelineMultisampleStateCreateInfo opaque = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT,
        .sampleShadingEnable = VK_TRUE,  /* expect: MSAA502#fifth */
        .minSampleShading = 0.2f,  /* may: MSAA502#fifth */
    };
    out[0] = make(device, pass, layout, &opaque, VK_FALSE);

    VkPipelineMultisampleStateCreateInfo foliage;
    memset(&foliage, 0, sizeof foliage);
    foliage.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    foliage.rasterizationSamples = VK_SAMPLE_COUNT_4_BIT;
    foliage.alphaToCoverageEnable = VK_TRUE;
    out[1] = make(device, pass, layout, &foliage, VK_FALSE);

    VkPipelineMultisampleStateCreateInfo shadow = {VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    shadow.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    shadow.alphaToCoverageEnable = VK_TRUE;  /* expect: MSAA505 */
    out[2] = make(device, shadow_pass, layout, &shadow, VK_FALSE);

    VkPipelineMultisampleStateCreateInfo glass = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT,
        .pSampleMask = &half_mask,  /* expect: MSAA508 */
    };
    out[3] = make(device, pass, layout, &glass, VK_TRUE);

    VkPipelineMultisampleStateCreateInfo noise = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT,
        .sampleShadingEnable = VK_TRUE,  /* may: MSAA501#every */
        .minSampleShading = 1.0f,  /* may: MSAA501#every */
    };
    out[4] = make(device, pass, layout, &noise, VK_FALSE);

    VkPipelineMultisampleStateCreateInfo wrong = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT,
        .sampleShadingEnable = VK_TRUE,  /* may: MSAA501 */
        .minSampleShading = 4.0f,  /* expect: MSAA510 */
    };
    out[5] = make(device, pass, layout, &wrong, VK_FALSE);
}
