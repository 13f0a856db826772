#include "context.h"

static VkImage color, shadow;

/* The depth format is that of the shadow map, which has one sample. */
void gfx_make_targets(VkImageUsageFlags color_usage, VkImageUsageFlags depth_usage) {
    gfx_make_image(gfx.color_format, gfx.msaa, color_usage, &color);
    gfx_make_image(gfx.depth_format, VK_SAMPLE_COUNT_1_BIT, depth_usage, &shadow);
}

void gfx_make_image(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImage *image) {
    VkImageCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.samples = samples;
    info.usage = usage;
    vkCreateImage(gfx.device, &info, 0, image);
}
