/* A renderer that reports the highest count that a device offers, and renders with the count of its settings. */
#include <vulkan/vulkan.h>

typedef struct {
    unsigned max_samples;
} capabilities_t;

extern VkPhysicalDeviceProperties properties;
extern VkDevice device;
extern VkSampleCountFlagBits settings_samples;

capabilities_t renderer_capabilities(void)
{
    capabilities_t capabilities;
    VkSampleCountFlags counts = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;
    if (counts & VK_SAMPLE_COUNT_64_BIT) { capabilities.max_samples = 64; }
    else if (counts & VK_SAMPLE_COUNT_32_BIT) { capabilities.max_samples = 32; }
    else if (counts & VK_SAMPLE_COUNT_16_BIT) { capabilities.max_samples = 16; }
    else if (counts & VK_SAMPLE_COUNT_8_BIT) { capabilities.max_samples = 8; }
    else if (counts & VK_SAMPLE_COUNT_4_BIT) { capabilities.max_samples = 4; }
    else if (counts & VK_SAMPLE_COUNT_2_BIT) { capabilities.max_samples = 2; }
    else { capabilities.max_samples = 1; }
    return capabilities;
}

VkImage renderer_target(VkExtent3D extent)
{
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                              .imageType = VK_IMAGE_TYPE_2D,
                              .format = VK_FORMAT_R8G8B8A8_UNORM,
                              .extent = extent,
                              .mipLevels = 1,
                              .arrayLayers = 1,
                              .samples = settings_samples,
                              .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT};
    VkImage image;
    vkCreateImage(device, &info, NULL, &image);
    return image;
}
