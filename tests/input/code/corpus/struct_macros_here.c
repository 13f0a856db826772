// A single-file library: its macro declares and clears a structure, and its surfaces are made by one function.
#include <string.h>
#include <vulkan/vulkan.h>

#if defined(__cplusplus)
#define _APP_STRUCT(TYPE, NAME) TYPE NAME = {}
#else
#define _APP_STRUCT(TYPE, NAME) TYPE NAME = {0}
#endif
#define _APP_CLEAR(TYPE, NAME) memset(&(NAME), 0, sizeof(TYPE))

typedef struct {
    VkImage img;
    VkImageView view;
} _app_surface_t;

static struct {
    int sample_count;
    VkDevice dev;
    VkFormat format;
    _app_surface_t msaa, depth;
} _app;

static void _app_create_surface(_app_surface_t* surf, VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                                VkImageAspectFlags aspect) {
    _APP_STRUCT(VkImageCreateInfo, img_info);
    img_info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    img_info.imageType = VK_IMAGE_TYPE_2D;
    img_info.format = format;
    img_info.extent.width = 640;
    img_info.extent.height = 480;
    img_info.extent.depth = 1;
    img_info.mipLevels = 1;
    img_info.arrayLayers = 1;
    img_info.samples = samples;
    img_info.usage = usage;
    vkCreateImage(_app.dev, &img_info, 0, &surf->img);
    _APP_STRUCT(VkImageViewCreateInfo, view_info);
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = surf->img;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = format;
    view_info.subresourceRange.aspectMask = aspect;
    view_info.subresourceRange.levelCount = 1;
    view_info.subresourceRange.layerCount = 1;
    vkCreateImageView(_app.dev, &view_info, 0, &surf->view);
}

void _app_create_surfaces(void) {
    _app_create_surface(&_app.depth, VK_FORMAT_D32_SFLOAT, (VkSampleCountFlagBits)_app.sample_count,
                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);  // may: MSAA401
    if (_app.sample_count > 1) {
        _app_create_surface(&_app.msaa, _app.format, (VkSampleCountFlagBits)_app.sample_count,
                            VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    }
}

void _app_draw(VkCommandBuffer cmd, VkImageView window) {
    _APP_STRUCT(VkRenderingAttachmentInfo, color);
    color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    color.imageView = _app.msaa.view;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = window;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201  // may: MSAA403
    VkRenderingInfo info;
    _APP_CLEAR(VkRenderingInfo, info);
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    vkCmdBeginRendering(cmd, &info);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);
}
