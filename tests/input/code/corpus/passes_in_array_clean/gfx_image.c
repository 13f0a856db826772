/* Render targets: the count and the format are kept in the target, then an image is created for it. */
#include "gfx_local.h"

static VkResult target_create(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect, target_t *target)
{
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {gfx_extent.width, gfx_extent.height, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = target->count,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = usage,
    };
    VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {.aspectMask = aspect, .levelCount = 1, .layerCount = 1},
    };
    VkResult result = vkCreateImage(gfx_device, &info, NULL, &target->image);
    if (result != VK_SUCCESS)
        return result;
    view.image = target->image;
    return vkCreateImageView(gfx_device, &view, NULL, &target->view);
}

void target_color(VkSampleCountFlagBits count, target_t *target, VkImageUsageFlags more)
{
    target->format = gfx_format;
    target->count = count;
    target_create(target->format, more | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT, target);
}

void target_depth(VkSampleCountFlagBits count, target_t *target)
{
    target->format = VK_FORMAT_D32_SFLOAT;
    target->count = count;
    target_create(target->format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                  VK_IMAGE_ASPECT_DEPTH_BIT, target);
}

void target_free(target_t *target)
{
    if (target->image != VK_NULL_HANDLE) {
        vkDestroyImageView(gfx_device, target->view, NULL);
        vkDestroyImage(gfx_device, target->image, NULL);
        target->image = VK_NULL_HANDLE;
        target->view = VK_NULL_HANDLE;
    }
}
