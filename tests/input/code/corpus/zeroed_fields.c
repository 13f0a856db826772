/* C99: structures set to zero by memset, then field by field. What is not written is 0: LOAD, STORE. */
#include <string.h>
#include <vulkan/vulkan.h>

static VkDevice device;
static VkImage color_ms, depth_ms;
static VkImageView color_view, depth_view, window_view;
static VkRenderPass pass;
static VkFramebuffer framebuffer;

static void make_images(uint32_t width, uint32_t height) {
    VkImageCreateInfo info;
    memset(&info, 0, sizeof info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent.width = width;
    info.extent.height = height;
    info.extent.depth = 1;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    vkCreateImage(device, &info, NULL, &color_ms);

    info.format = VK_FORMAT_D16_UNORM;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    vkCreateImage(device, &info, NULL, &depth_ms);
}

static void make_views(void) {
    VkImageViewCreateInfo view;
    memset(&view, 0, sizeof(view));
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.subresourceRange.levelCount = 1;
    view.subresourceRange.layerCount = 1;

    view.image = color_ms;
    view.format = VK_FORMAT_R8G8B8A8_UNORM;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    vkCreateImageView(device, &view, NULL, &color_view);

    view.image = depth_ms;
    view.format = VK_FORMAT_D16_UNORM;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCreateImageView(device, &view, NULL, &depth_view);
}

static void make_pass(void) {
    VkAttachmentDescription att[3];  /* may: MSAA201#color */
    VkAttachmentReference color, depth, resolve;
    VkSubpassDescription sub;
    VkRenderPassCreateInfo info;

    memset(att, 0, sizeof(att));  /* may: MSAA201#color */
    att[0].format = VK_FORMAT_R8G8B8A8_UNORM;  /* may: MSAA201#color */
    att[0].samples = VK_SAMPLE_COUNT_4_BIT;  /* expect: MSAA201#color */
    att[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    att[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    att[1].format = VK_FORMAT_D16_UNORM;
    att[1].samples = VK_SAMPLE_COUNT_4_BIT;
    att[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    att[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    att[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

    att[2].format = VK_FORMAT_R8G8B8A8_UNORM;
    att[2].samples = VK_SAMPLE_COUNT_1_BIT;
    att[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    att[2].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

    color.attachment = 0;
    color.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    depth.attachment = 1;
    depth.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    resolve.attachment = 2;
    resolve.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    memset(&sub, 0, sizeof(sub));
    sub.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    sub.colorAttachmentCount = 1;
    sub.pColorAttachments = &color;
    sub.pResolveAttachments = &resolve;
    sub.pDepthStencilAttachment = &depth;

    memset(&info, 0, sizeof(info));
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 3;
    info.pAttachments = att;
    info.subpassCount = 1;
    info.pSubpasses = &sub;
    vkCreateRenderPass(device, &info, NULL, &pass);
}

static void make_framebuffer(uint32_t width, uint32_t height) {
    VkImageView views[3];
    VkFramebufferCreateInfo info;
    views[0] = color_view;
    views[1] = depth_view;
    views[2] = window_view;
    memset(&info, 0, sizeof(info));
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = 3;
    info.pAttachments = views;
    info.width = width;
    info.height = height;
    info.layers = 1;
    vkCreateFramebuffer(device, &info, NULL, &framebuffer);
}

int main(void) {
    make_images(800, 600);
    make_views();
    make_pass();
    make_framebuffer(800, 600);
    return 0;
}
