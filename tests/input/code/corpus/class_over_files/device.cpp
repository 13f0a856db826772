#include "renderer.h"

void Renderer::start() {
    pickDevice();
    createSwapChain();
    createRenderPass();
    createTargets();
    createDepth();
}

void Renderer::pickDevice() {
    samples = usableSampleCount();
}

VkSampleCountFlagBits Renderer::usableSampleCount() const {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu, &properties);
    const VkSampleCountFlags counts =
        properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;  // expect: MSAA854
    return (counts & VK_SAMPLE_COUNT_4_BIT) ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
}

VkFormat Renderer::findDepthFormat() const {
    const VkFormat candidates[] = {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT};
    for (VkFormat format : candidates) {
        VkFormatProperties properties;
        vkGetPhysicalDeviceFormatProperties(gpu, format, &properties);
        if (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) return format;
    }
    return candidates[0];
}
