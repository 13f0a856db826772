// A count that is fixed while something is looked into: what follows the return is dead.
#include <vulkan/vulkan.h>

#include <stdexcept>

class Renderer {
public:
    VkSampleCountFlagBits highestCount();

private:
    VkFormat depthFormat() { return supportedFormat({VK_FORMAT_D32_SFLOAT, VK_FORMAT_D24_UNORM_S8_UINT}); }
    VkFormat supportedFormat(std::initializer_list<VkFormat> candidates);
    VkImage createTarget(VkFormat format, VkSampleCountFlagBits samples);

    VkPhysicalDevice gpu = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
};

VkSampleCountFlagBits Renderer::highestCount() {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu, &properties);

    return VK_SAMPLE_COUNT_4_BIT;

    VkSampleCountFlags counts = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;
    if (counts & VK_SAMPLE_COUNT_64_BIT) return VK_SAMPLE_COUNT_64_BIT;
    if (counts & VK_SAMPLE_COUNT_16_BIT) return VK_SAMPLE_COUNT_16_BIT;
    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}

VkSampleCountFlagBits unsupportedYet(VkPhysicalDevice gpu) {
    throw std::runtime_error("multisampling is not supported yet");
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu, &properties);
    VkSampleCountFlags counts = properties.limits.framebufferColorSampleCounts;
    if (counts & VK_SAMPLE_COUNT_64_BIT) return VK_SAMPLE_COUNT_64_BIT;
    if (counts & VK_SAMPLE_COUNT_32_BIT) return VK_SAMPLE_COUNT_32_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}
