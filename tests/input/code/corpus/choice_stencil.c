/* The count is asked for colour and depth, and the image has a stencil besides. */
#include <stdint.h>
#include <vulkan/vulkan.h>

struct gpu {
    VkPhysicalDevice physical;
    VkDevice device;
    VkPhysicalDeviceProperties props;
    VkSampleCountFlagBits samples;
    VkFormat depth_format;
};

static VkSampleCountFlagBits pick_samples(const struct gpu *gpu) {
    const VkSampleCountFlags mask = gpu->props.limits.framebufferColorSampleCounts
                                  & gpu->props.limits.framebufferDepthSampleCounts; /* expect: MSAA854 */
    if (mask & VK_SAMPLE_COUNT_4_BIT)
        return VK_SAMPLE_COUNT_4_BIT;
    if (mask & VK_SAMPLE_COUNT_2_BIT)
        return VK_SAMPLE_COUNT_2_BIT;
    return VK_SAMPLE_COUNT_1_BIT;
}

static VkFormat pick_depth_format(const struct gpu *gpu) {
    static const VkFormat candidates[] = {VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT};
    for (unsigned i = 0; i < sizeof candidates / sizeof candidates[0]; i++) {
        VkFormatProperties props;
        vkGetPhysicalDeviceFormatProperties(gpu->physical, candidates[i], &props);
        if (props.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
            return candidates[i];
    }
    return VK_FORMAT_UNDEFINED;
}

int gpu_init(struct gpu *gpu) {
    vkGetPhysicalDeviceProperties(gpu->physical, &gpu->props);
    gpu->samples = pick_samples(gpu);
    gpu->depth_format = pick_depth_format(gpu);
    return gpu->depth_format != VK_FORMAT_UNDEFINED;
}

VkImage make_depth(struct gpu *gpu, uint32_t width, uint32_t height) {
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = VK_FORMAT_D24_UNORM_S8_UINT,
        .extent = {width, height, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
    };
    VkImage image = VK_NULL_HANDLE;
    info.samples = gpu->samples;
    info.format = gpu->depth_format;
    vkCreateImage(gpu->device, &info, NULL, &image);
    return image;
}
