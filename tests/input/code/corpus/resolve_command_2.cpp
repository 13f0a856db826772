// Samples that are resolved by a command of version 2: the count is a variable, which the resolve says is above 1.
#include <vulkan/vulkan.h>

VkSampleCountFlagBits antialiasing();

class Resolver {
public:
    void create();
    void draw(VkCommandBuffer cmd, VkImage target);

private:
    VkDevice device = VK_NULL_HANDLE;
    VkImage color = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

void Resolver::create() {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {640, 480, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = antialiasing();
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    vkCreateImage(device, &info, nullptr, &color);
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = color;
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = VK_FORMAT_R8G8B8A8_UNORM;
    vkCreateImageView(device, &viewInfo, nullptr, &view);
}

void Resolver::draw(VkCommandBuffer cmd, VkImage target) {
    VkRenderingAttachmentInfoKHR attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR};
    attachment.imageView = view;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfoKHR info{VK_STRUCTURE_TYPE_RENDERING_INFO_KHR};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &attachment;
    vkCmdBeginRenderingKHR(cmd, &info);
    vkCmdEndRenderingKHR(cmd);

    VkImageResolve2 region{VK_STRUCTURE_TYPE_IMAGE_RESOLVE_2};
    VkResolveImageInfo2 resolve{VK_STRUCTURE_TYPE_RESOLVE_IMAGE_INFO_2};
    resolve.srcImage = color;
    resolve.srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    resolve.dstImage = target;
    resolve.dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    resolve.regionCount = 1;
    resolve.pRegions = &region;
    vkCmdResolveImage2(cmd, &resolve);  // expect: MSAA301
}
