// Dynamic rendering by the extension's names, with views that come from elsewhere: what is stored here, another file may read.
#include <vulkan/vulkan.h>

#include <array>

extern PFN_vkCmdBeginRenderingKHR vkCmdBeginRenderingKHR_;
extern PFN_vkCmdEndRenderingKHR vkCmdEndRenderingKHR_;

struct GBuffer {
    VkImageView albedo, normal, depth;
    VkExtent2D size;
};

struct Resolved {
    VkImageView color, depth;
};

// The lighting pass, in another file, reads every sample of these.
void drawGBuffer(VkCommandBuffer cmd, const GBuffer& gbuffer) {
    std::array<VkRenderingAttachmentInfoKHR, 2> colors{};
    VkImageView views[] = {gbuffer.albedo, gbuffer.normal};
    for (size_t i = 0; i < colors.size(); i++) {
        colors[i].sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR;
        colors[i].imageView = views[i];
        colors[i].imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        colors[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        colors[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    }
    VkRenderingAttachmentInfoKHR depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR;
    depth.imageView = gbuffer.depth;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;

    VkRenderingInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO_KHR;
    info.renderArea.extent = gbuffer.size;
    info.layerCount = 1;
    info.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    info.pColorAttachments = colors.data();
    info.pDepthAttachment = &depth;
    vkCmdBeginRenderingKHR_(cmd, &info);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRenderingKHR_(cmd);
}

void drawForward(VkCommandBuffer cmd, VkImageView color, VkImageView depth, const Resolved& resolved, VkExtent2D size) {
    VkRenderingAttachmentInfoKHR colorInfo{};
    colorInfo.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR;
    colorInfo.imageView = color;
    colorInfo.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colorInfo.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT_KHR;
    colorInfo.resolveImageView = resolved.color;
    colorInfo.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colorInfo.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colorInfo.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkRenderingAttachmentInfoKHR depthInfo{};
    depthInfo.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR;
    depthInfo.imageView = depth;
    depthInfo.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depthInfo.resolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT_KHR;
    depthInfo.resolveImageView = resolved.depth;
    depthInfo.resolveImageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depthInfo.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depthInfo.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkRenderingInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO_KHR;
    info.renderArea = {{0, 0}, size};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &colorInfo;
    info.pDepthAttachment = &depthInfo;
    vkCmdBeginRenderingKHR_(cmd, &info);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRenderingKHR_(cmd);
}

// One sample: text over the picture.
void drawOverlay(VkCommandBuffer cmd, VkImageView target, VkExtent2D size) {
    VkRenderingAttachmentInfoKHR attachment{};
    attachment.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO_KHR;
    attachment.imageView = target;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO_KHR;
    info.renderArea = {{0, 0}, size};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &attachment;
    vkCmdBeginRenderingKHR_(cmd, &info);
    vkCmdDraw(cmd, 6, 100, 0, 0);
    vkCmdEndRenderingKHR_(cmd);
}
