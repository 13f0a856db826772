// The chain that looks for a count has a copied line in it: the same bit is tested three times.
#include <vulkan/vulkan.hpp>

#include <vector>

namespace app {

class Device {
public:
    Device(vk::Instance instance) {
        for (const auto& candidate : instance.enumeratePhysicalDevices()) {
            if (isDeviceSuitable(candidate)) {
                m_physicalDevice = candidate;
                m_msaaSamples = getMaxUsableSampleCount();
                break;
            }
        }
    }

    vk::SampleCountFlagBits samples() const { return m_msaaSamples; }

private:
    bool isDeviceSuitable(vk::PhysicalDevice device) const { return device.getFeatures().samplerAnisotropy; }

    vk::SampleCountFlagBits getMaxUsableSampleCount() {  // expect: MSAA851
        const auto properties = m_physicalDevice.getProperties();
        vk::SampleCountFlags counts = (
            properties.limits.framebufferColorSampleCounts &
            properties.limits.framebufferDepthSampleCounts
        );

        if(counts & vk::SampleCountFlagBits::e64) return vk::SampleCountFlagBits::e64;
        if(counts & vk::SampleCountFlagBits::e32) return vk::SampleCountFlagBits::e32;
        if(counts & vk::SampleCountFlagBits::e16) return vk::SampleCountFlagBits::e16;
        if(counts & vk::SampleCountFlagBits::e8) return vk::SampleCountFlagBits::e8;
        if(counts & vk::SampleCountFlagBits::e8) return vk::SampleCountFlagBits::e4;  // expect: MSAA853#again
        if(counts & vk::SampleCountFlagBits::e8) return vk::SampleCountFlagBits::e2;  // may: MSAA853#again
        return vk::SampleCountFlagBits::e1;
    }

    vk::PhysicalDevice m_physicalDevice;
    vk::SampleCountFlagBits m_msaaSamples = vk::SampleCountFlagBits::e1;
};

}  // namespace app

// The same mistake with a table of counts, an else-if chain and the C interface.
VkSampleCountFlagBits chooseByChain(const VkPhysicalDeviceLimits& limits, bool hdr) {
    VkSampleCountFlags supported = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    if (hdr) supported &= limits.sampledImageColorSampleCounts;
    if (supported & VK_SAMPLE_COUNT_4_BIT) {
        return VK_SAMPLE_COUNT_4_BIT;
    } else if ((supported & VK_SAMPLE_COUNT_4_BIT) != 0) {  // expect: MSAA853
        return VK_SAMPLE_COUNT_2_BIT;
    } else {
        return VK_SAMPLE_COUNT_1_BIT;
    }
}
