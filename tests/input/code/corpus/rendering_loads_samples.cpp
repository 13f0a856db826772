// A renderer whose overlay loads the samples that the scene's rendering keeps for it: the scene is right to store them.
#include <vulkan/vulkan.h>

class Target {
public:
    VkImageView view() const;
    VkImageView resolved() const;
};

class CommandList {
public:
    void beginScene(const Target& target);
    void beginOverlay(VkImageView view, VkImageView resolveView);

private:
    VkCommandBuffer m_cmd = VK_NULL_HANDLE;
};

void CommandList::beginScene(const Target& target) {
    VkRenderingAttachmentInfo attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    attachment.imageView = target.view();
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    attachment.resolveImageView = target.resolved();
    attachment.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &attachment;
    vkCmdBeginRendering(m_cmd, &info);
}

void CommandList::beginOverlay(VkImageView view, VkImageView resolveView) {
    VkRenderingAttachmentInfoKHR attachment = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR,
        .imageView = view,
        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .resolveMode = resolveView ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_NONE,
        .resolveImageView = resolveView,
        .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,  // expect: MSAA202
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
    };
    VkRenderingInfoKHR info = {VK_STRUCTURE_TYPE_RENDERING_INFO_KHR};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &attachment;
    vkCmdBeginRenderingKHR(m_cmd, &info);
}
