// Counts that a user limits, or that are only reported, are no choice of the maximum; and code under `#if 0` is not compiled.
#include <algorithm>
#include <cmath>
#include <vulkan/vulkan.h>

struct Traits {
    VkSampleCountFlags samples = VK_SAMPLE_COUNT_1_BIT;
};

VkSampleCountFlagBits ofMask(const VkPhysicalDeviceLimits& limits, const Traits& traits) {
    const VkSampleCountFlags color = limits.framebufferColorSampleCounts;
    const VkSampleCountFlags depth = limits.framebufferDepthSampleCounts;
    const VkSampleCountFlags satisfied = color & depth & traits.samples;
    if (satisfied == 0)
        return VK_SAMPLE_COUNT_1_BIT;
    return static_cast<VkSampleCountFlagBits>(1 << static_cast<uint32_t>(std::floor(std::log2(satisfied))));
}

VkSampleCountFlagBits ofRequest(const VkPhysicalDeviceLimits& limits, int requested) {
    const VkSampleCountFlags counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    if (counts & VK_SAMPLE_COUNT_16_BIT && requested >= 16)
        return VK_SAMPLE_COUNT_16_BIT;
    else if (counts & VK_SAMPLE_COUNT_8_BIT && requested >= 8)
        return VK_SAMPLE_COUNT_8_BIT;
    else if (counts & VK_SAMPLE_COUNT_4_BIT && requested >= 4)
        return VK_SAMPLE_COUNT_4_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}

VkSampleCountFlagBits ofLoop(const VkPhysicalDeviceLimits& limits, int requested) {
    const VkSampleCountFlags counts = limits.sampledImageColorSampleCounts & limits.sampledImageDepthSampleCounts;
    VkSampleCountFlags best = VK_SAMPLE_COUNT_1_BIT, bit = VK_SAMPLE_COUNT_1_BIT;
    for (int samples = 1; samples <= std::clamp(requested, 0, 64); samples <<= 1) {
        if (counts & bit)
            best = bit;
        bit <<= 1;
    }
    return static_cast<VkSampleCountFlagBits>(best);
}

#if 0
VkSampleCountFlagBits ofDevice(const VkPhysicalDeviceLimits& limits) {
    VkSampleCountFlags counts = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    if (counts & VK_SAMPLE_COUNT_64_BIT)
        return VK_SAMPLE_COUNT_64_BIT;
    if (counts & VK_SAMPLE_COUNT_32_BIT)
        return VK_SAMPLE_COUNT_32_BIT;
    if (counts & VK_SAMPLE_COUNT_16_BIT)
        return VK_SAMPLE_COUNT_16_BIT;
    if (counts & VK_SAMPLE_COUNT_8_BIT)
        return VK_SAMPLE_COUNT_8_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}
#endif
