// The highest count that the device offers, from a list of a file's own.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <vector>

class PhysicalDevice {
public:
    static const std::vector<VkSampleCountFlagBits> COUNTS;
    VkSampleCountFlagBits highestCount() const;

private:
    VkPhysicalDevice device = VK_NULL_HANDLE;
};

const std::vector<VkSampleCountFlagBits> PhysicalDevice::COUNTS = {VK_SAMPLE_COUNT_64_BIT, VK_SAMPLE_COUNT_32_BIT, VK_SAMPLE_COUNT_16_BIT,
                                                                   VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_2_BIT};

VkSampleCountFlagBits PhysicalDevice::highestCount() const {  // expect: MSAA851
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    auto counts = std::min(properties.limits.framebufferColorSampleCounts, properties.limits.framebufferDepthSampleCounts);  // expect: MSAA852
    for (const auto& count : COUNTS) {
        if (counts & count)
            return count;
    }
    return VK_SAMPLE_COUNT_1_BIT;
}
