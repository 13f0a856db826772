#include "ref.h"

static VkResult CreateImage(VkFormat format, VkImageUsageFlags usage, refTexture_t *texture) {
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .extent.width = 640,
        .extent.height = 480,
        .extent.depth = 1,
        .mipLevels = texture->mipLevels,
        .arrayLayers = 1,
        .format = format,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = usage,
        .samples = texture->sampleCount,
    };
    return vkCreateImage(ref_device, &info, NULL, &texture->image);
}

static VkResult CreateView(VkImage *image, VkImageAspectFlags aspect, VkImageView *view, VkFormat format) {
    VkImageViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = *image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange.aspectMask = aspect,
        .subresourceRange.levelCount = 1,
        .subresourceRange.layerCount = 1,
    };
    return vkCreateImageView(ref_device, &info, NULL, view);
}

void Ref_CreateColorBuffer(VkSampleCountFlagBits sampleCount, refTexture_t *texture, int extraFlags) {
    texture->format = ref_format;
    texture->sampleCount = sampleCount;
    CreateImage(texture->format, extraFlags | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, texture);  // expect: MSAA401#color
    CreateView(&texture->image, VK_IMAGE_ASPECT_COLOR_BIT, &texture->view, texture->format);
}

void Ref_CreateDepthBuffer(VkSampleCountFlagBits sampleCount, refTexture_t *texture) {
    texture->format = VK_FORMAT_D32_SFLOAT;
    texture->sampleCount = sampleCount;
    CreateImage(texture->format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, texture);  // expect: MSAA401#depth
    CreateView(&texture->image, VK_IMAGE_ASPECT_DEPTH_BIT, &texture->view, texture->format);
}
