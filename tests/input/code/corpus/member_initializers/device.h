#pragma once

#include <vulkan/vulkan.h>

namespace app {

class Device {
public:
    explicit Device(VkPhysicalDevice physical, VkDevice device) : m_device(device) { vkGetPhysicalDeviceProperties(physical, &m_properties); }

    operator VkDevice() const { return m_device; }

    VkSampleCountFlagBits samples() const {  // expect: MSAA851
        auto counts = m_properties.limits.framebufferColorSampleCounts &
                      m_properties.limits.framebufferDepthSampleCounts;  // expect: MSAA854
        if (counts & VK_SAMPLE_COUNT_16_BIT)
            return VK_SAMPLE_COUNT_16_BIT;
        if (counts & VK_SAMPLE_COUNT_8_BIT)
            return VK_SAMPLE_COUNT_8_BIT;
        if (counts & VK_SAMPLE_COUNT_4_BIT)
            return VK_SAMPLE_COUNT_4_BIT;
        return VK_SAMPLE_COUNT_1_BIT;
    }

private:
    VkDevice m_device;
    VkPhysicalDeviceProperties m_properties{};
};

}
