// Sample counts chosen with care: a cap, a list of preferences, a setting of the user's, every aspect asked.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cmath>

struct Settings {
    unsigned antialiasing = 4;
};

VkSampleCountFlags commonCounts(VkPhysicalDevice gpu) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu, &properties);
    return properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts &
           properties.limits.framebufferStencilSampleCounts;
}

// Four where it is offered, and it is offered everywhere.
VkSampleCountFlagBits atMostFour(VkPhysicalDevice gpu) {
    const VkSampleCountFlags counts = commonCounts(gpu);
    if (counts & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;
    if (counts & VK_SAMPLE_COUNT_2_BIT) return VK_SAMPLE_COUNT_2_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}

// What the user asked for, or the next lesser count that there is.
VkSampleCountFlagBits fromSettings(VkPhysicalDevice gpu, const Settings& settings) {
    const VkSampleCountFlags counts = commonCounts(gpu);
    for (unsigned wanted = settings.antialiasing; wanted > 1; wanted /= 2)
        if (counts & wanted) return static_cast<VkSampleCountFlagBits>(wanted);
    return VK_SAMPLE_COUNT_1_BIT;
}

VkSampleCountFlagBits byPreference(VkPhysicalDevice gpu) {
    static constexpr std::array<VkSampleCountFlagBits, 3> preferred{VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_2_BIT, VK_SAMPLE_COUNT_1_BIT};
    const VkSampleCountFlags counts = commonCounts(gpu);
    return *std::find_if(preferred.begin(), preferred.end(), [counts](VkSampleCountFlagBits bit) { return (counts & bit) != 0; });
}

bool isSupported(const VkPhysicalDeviceLimits& limits, VkSampleCountFlagBits count) {
    return (limits.framebufferColorSampleCounts & count) && (limits.framebufferDepthSampleCounts & count) &&
           (limits.framebufferStencilSampleCounts & count);
}

int clampQuality(int asked, int offered) { return std::min(asked, offered); }

// A name for a menu: the same bits in another chain, which chooses nothing.
const char* label(VkSampleCountFlags counts) {
    if (counts & VK_SAMPLE_COUNT_64_BIT) return "64x";
    if (counts & VK_SAMPLE_COUNT_32_BIT) return "32x";
    if (counts & VK_SAMPLE_COUNT_16_BIT) return "16x";
    if (counts & VK_SAMPLE_COUNT_8_BIT) return "8x";
    if (counts & VK_SAMPLE_COUNT_4_BIT) return "4x";
    return "off";
}

VkSampleCountFlagBits toFlag(int samples) {
    switch (samples) {
    case 64: return VK_SAMPLE_COUNT_64_BIT;
    case 32: return VK_SAMPLE_COUNT_32_BIT;
    case 16: return VK_SAMPLE_COUNT_16_BIT;
    case 8: return VK_SAMPLE_COUNT_8_BIT;
    case 4: return VK_SAMPLE_COUNT_4_BIT;
    case 2: return VK_SAMPLE_COUNT_2_BIT;
    default: return VK_SAMPLE_COUNT_1_BIT;
    }
}
