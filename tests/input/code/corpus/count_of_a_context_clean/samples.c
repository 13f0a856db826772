#include "context.h"

gfx_context gfx;

static VkSampleCountFlagBits best_samples(const VkPhysicalDeviceLimits *limits) {  /* may: MSAA851 */
    VkSampleCountFlags counts = limits->framebufferColorSampleCounts &
                                limits->framebufferDepthSampleCounts;
    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;
    if (counts & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;
    if (counts & VK_SAMPLE_COUNT_2_BIT) return VK_SAMPLE_COUNT_2_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}

void gfx_pick_samples(void) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gfx.adapter, &properties);
    gfx.msaa = best_samples(&properties.limits);
}
