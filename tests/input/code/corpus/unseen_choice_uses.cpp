// The greatest count is asked for and then capped; masks are tested for other reasons than to choose. Nothing is wrong.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdio>
#include <vector>

class Gpu {
public:
    explicit Gpu(VkPhysicalDevice handle) { vkGetPhysicalDeviceProperties(handle, &properties); }

    // For the menu of settings: every count that there is, not the one that is taken.
    std::vector<int> offered() const {
        std::vector<int> counts;
        const VkSampleCountFlags mask = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;
        if (mask & VK_SAMPLE_COUNT_64_BIT) counts.push_back(64);
        if (mask & VK_SAMPLE_COUNT_32_BIT) counts.push_back(32);
        if (mask & VK_SAMPLE_COUNT_16_BIT) counts.push_back(16);
        if (mask & VK_SAMPLE_COUNT_8_BIT) counts.push_back(8);
        if (mask & VK_SAMPLE_COUNT_4_BIT) counts.push_back(4);
        if (mask & VK_SAMPLE_COUNT_2_BIT) counts.push_back(2);
        return counts;
    }

    // A device without either is broken; nothing is chosen here.
    bool sane() const { return properties.limits.framebufferColorSampleCounts && properties.limits.framebufferDepthSampleCounts; }

    void print() const {
        const auto& limits = properties.limits;
        std::printf("colour %x depth %x both %x either %x\n", limits.framebufferColorSampleCounts, limits.framebufferDepthSampleCounts,
                    limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts,
                    limits.framebufferColorSampleCounts | limits.framebufferDepthSampleCounts);
    }

    // Each mask by itself, then the lesser of two counts.
    VkSampleCountFlagBits byAspect() const {
        VkSampleCountFlagBits color = VK_SAMPLE_COUNT_1_BIT, depth = VK_SAMPLE_COUNT_1_BIT;
        if (properties.limits.framebufferColorSampleCounts & VK_SAMPLE_COUNT_2_BIT) color = VK_SAMPLE_COUNT_2_BIT;
        if (properties.limits.framebufferColorSampleCounts & VK_SAMPLE_COUNT_4_BIT) color = VK_SAMPLE_COUNT_4_BIT;
        if (properties.limits.framebufferDepthSampleCounts & VK_SAMPLE_COUNT_2_BIT) depth = VK_SAMPLE_COUNT_2_BIT;
        if (properties.limits.framebufferDepthSampleCounts & VK_SAMPLE_COUNT_4_BIT) depth = VK_SAMPLE_COUNT_4_BIT;
        return std::min(color, depth);
    }

    VkSampleCountFlagBits samples(int wanted) const {
        const VkSampleCountFlags mask = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts &
                                        properties.limits.framebufferStencilSampleCounts;
        if (wanted >= 8 && (mask & VK_SAMPLE_COUNT_8_BIT)) return VK_SAMPLE_COUNT_8_BIT;
        if (wanted >= 4 && (mask & VK_SAMPLE_COUNT_4_BIT)) return VK_SAMPLE_COUNT_4_BIT;
        if (wanted >= 2 && (mask & VK_SAMPLE_COUNT_2_BIT)) return VK_SAMPLE_COUNT_2_BIT;
        return VK_SAMPLE_COUNT_1_BIT;
    }

private:
    VkPhysicalDeviceProperties properties;
};

static VkSampleCountFlagBits greatest(VkSampleCountFlags mask) {
    for (uint32_t bit = VK_SAMPLE_COUNT_64_BIT; bit > VK_SAMPLE_COUNT_1_BIT; bit >>= 1)
        if (mask & bit) return static_cast<VkSampleCountFlagBits>(bit);
    return VK_SAMPLE_COUNT_1_BIT;
}

VkSampleCountFlagBits capped(const VkPhysicalDeviceLimits& limits) {
    const VkSampleCountFlags mask = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    return std::min(greatest(mask), VK_SAMPLE_COUNT_4_BIT);
}

struct Settings {
    VkSampleCountFlagBits msaa = VK_SAMPLE_COUNT_4_BIT;
};

void clampSettings(Settings& settings, const VkPhysicalDeviceLimits& limits) {
    const VkSampleCountFlags mask = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    if (!(mask & settings.msaa)) settings.msaa = greatest(mask & (settings.msaa - 1));
}
