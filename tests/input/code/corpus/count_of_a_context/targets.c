#include "context.h"

static VkImage color, depth;

void gfx_make_targets(VkImageUsageFlags color_usage, VkImageUsageFlags depth_usage) {
    gfx_make_image(gfx.color_format, gfx.msaa, color_usage, &color);
    gfx_make_image(gfx.depth_format, gfx.msaa, depth_usage, &depth);
}
