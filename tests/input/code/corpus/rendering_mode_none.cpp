// Dynamic rendering with a resolve view and no mode: nothing is resolved, and nothing says so. Depth goes on to a second rendering.
#include <vulkan/vulkan.h>

namespace {

VkRenderingAttachmentInfo attachmentInfo(VkImageView view, VkImageLayout layout, const VkClearValue* clear) {
    VkRenderingAttachmentInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    info.imageView = view;
    info.imageLayout = layout;
    info.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (clear) info.clearValue = *clear;
    return info;
}

}  // namespace

struct Targets {
    VkImage colorImage, depthImage, sceneImage;
    VkImageView color, depth, scene;
};

void create(VkDevice device, VkExtent2D size, Targets& targets) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;

    info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    vkCreateImage(device, &info, nullptr, &targets.colorImage);

    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    vkCreateImage(device, &info, nullptr, &targets.sceneImage);

    VkImageViewCreateInfo view{};
    view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    view.image = targets.colorImage;
    vkCreateImageView(device, &view, nullptr, &targets.color);
    view.image = targets.sceneImage;
    vkCreateImageView(device, &view, nullptr, &targets.scene);
}

void drawScene(VkCommandBuffer cmd, const Targets& targets, VkExtent2D size) {
    VkRenderingAttachmentInfo color{};
    color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    color.imageView = targets.color;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.resolveMode = VK_RESOLVE_MODE_NONE;  // expect: MSAA302
    color.resolveImageView = targets.scene;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;  // may: MSAA207

    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, size};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    vkCmdBeginRendering(cmd, &info);
    vkCmdDraw(cmd, 3000, 1, 0, 0);
    vkCmdEndRendering(cmd);
}

void drawDebug(VkCommandBuffer cmd, VkImageView lines, VkExtent2D size) {
    VkClearValue clear{};
    VkRenderingAttachmentInfo color = attachmentInfo(lines, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, &clear);
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, size};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    vkCmdBeginRendering(cmd, &info);
    vkCmdDraw(cmd, 2, 500, 0, 0);
    vkCmdEndRendering(cmd);
}
