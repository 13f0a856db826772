// Masks of sample counts combined as if they were numbers, or truths.
#include <vulkan/vulkan.h>

#include <algorithm>

struct Gpu {
    VkPhysicalDevice handle;
    VkPhysicalDeviceProperties properties;

    VkSampleCountFlagBits maxSamplesByMinimum() const {  // expect: MSAA851
        VkSampleCountFlags counts =  // may: MSAA852#minimum
            std::min(properties.limits.framebufferColorSampleCounts, properties.limits.framebufferDepthSampleCounts);  // expect: MSAA852#minimum
        if (counts & VK_SAMPLE_COUNT_64_BIT) return VK_SAMPLE_COUNT_64_BIT;
        if (counts & VK_SAMPLE_COUNT_32_BIT) return VK_SAMPLE_COUNT_32_BIT;
        if (counts & VK_SAMPLE_COUNT_16_BIT) return VK_SAMPLE_COUNT_16_BIT;
        if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;
        if (counts & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;
        if (counts & VK_SAMPLE_COUNT_2_BIT) return VK_SAMPLE_COUNT_2_BIT;
        return VK_SAMPLE_COUNT_1_BIT;
    }

    VkSampleCountFlagBits samplesByTruth() const {
        const VkPhysicalDeviceLimits& limits = properties.limits;
        const VkSampleCountFlags counts = limits.framebufferColorSampleCounts && limits.framebufferDepthSampleCounts;  // expect: MSAA852
        if (counts & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;
        if (counts & VK_SAMPLE_COUNT_2_BIT) return VK_SAMPLE_COUNT_2_BIT;
        return VK_SAMPLE_COUNT_1_BIT;
    }

    VkSampleCountFlagBits samplesByEither() const {
        VkSampleCountFlags either = properties.limits.framebufferColorSampleCounts | properties.limits.framebufferDepthSampleCounts;  // expect: MSAA852
        for (VkSampleCountFlagBits bit : {VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_2_BIT})
            if (either & bit) return bit;
        return VK_SAMPLE_COUNT_1_BIT;
    }

    // Right: the bits in common, and each aspect asked for itself.
    bool supports(VkSampleCountFlagBits count) const {
        return (properties.limits.framebufferColorSampleCounts & count) && (properties.limits.framebufferDepthSampleCounts & count);
    }

    // Right: the lesser of two counts, each found in a mask of its own.
    VkSampleCountFlagBits lesser(VkSampleCountFlagBits color, VkSampleCountFlagBits depth) const { return std::min(color, depth); }

    // Right: either of the masks has anything at all.
    bool anyMultisampling() const {
        const auto& limits = properties.limits;
        return limits.framebufferColorSampleCounts > VK_SAMPLE_COUNT_1_BIT || limits.framebufferNoAttachmentsSampleCounts > 1;
    }
};
