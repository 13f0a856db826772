#include "context.h"

void gfx_pick_formats(void) {
    VkFormatProperties properties;
    gfx.color_format = VK_FORMAT_B8G8R8A8_UNORM;
    vkGetPhysicalDeviceFormatProperties(gfx.adapter, VK_FORMAT_D24_UNORM_S8_UINT, &properties);
    if (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
        gfx.depth_format = VK_FORMAT_D24_UNORM_S8_UINT;
    else
        gfx.depth_format = VK_FORMAT_D32_SFLOAT_S8_UINT;
}
