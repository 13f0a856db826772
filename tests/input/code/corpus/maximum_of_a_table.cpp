// The first count of a table, from the highest down, that the device has: its maximum. The smaller of two masks is no mask of both.
#include <algorithm>
#include <vector>
#include <vulkan/vulkan.h>

static const std::vector<VkSampleCountFlagBits> COUNTS = {
    VK_SAMPLE_COUNT_64_BIT, VK_SAMPLE_COUNT_32_BIT, VK_SAMPLE_COUNT_16_BIT,
    VK_SAMPLE_COUNT_8_BIT,  VK_SAMPLE_COUNT_4_BIT,  VK_SAMPLE_COUNT_2_BIT,
};

class PhysicalDevice {
public:
    explicit PhysicalDevice(VkPhysicalDevice device) : device(device) { samples = maxSamples(); }
    VkSampleCountFlagBits getSamples() const { return samples; }

private:
    VkSampleCountFlagBits maxSamples() const;

    VkPhysicalDevice device;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

VkSampleCountFlagBits PhysicalDevice::maxSamples() const {  // expect: MSAA851
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    auto counts = std::min(properties.limits.framebufferColorSampleCounts, properties.limits.framebufferDepthSampleCounts);  // expect: MSAA852
    for (const auto& count : COUNTS) {
        if (counts & count)
            return count;
    }
    return VK_SAMPLE_COUNT_1_BIT;
}
