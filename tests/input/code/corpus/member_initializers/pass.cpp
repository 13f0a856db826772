// Samples of a transient image are stored, and the depth image is not transient.
#include <array>

#include "targets.h"

using namespace app;

VkRenderPass createPass(const Device& device) {
    VkAttachmentDescription color = {};
    color.format = VK_FORMAT_B8G8R8A8_SRGB;
    color.samples = device.samples();
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkAttachmentDescription depth = {};
    depth.format = VK_FORMAT_D32_SFLOAT_S8_UINT;
    depth.samples = device.samples();
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkAttachmentDescription window = {};
    window.format = VK_FORMAT_B8G8R8A8_SRGB;
    window.samples = VK_SAMPLE_COUNT_1_BIT;
    window.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    window.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    window.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    window.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkAttachmentReference colorReference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depthReference{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference windowReference{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &windowReference;
    subpass.pDepthStencilAttachment = &depthReference;

    std::array<VkAttachmentDescription, 3> attachments = {color, depth, window};
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkFramebuffer createFramebuffer(const Device& device, VkRenderPass pass, const ColorTarget& color, const DepthTarget& depth, VkImageView window) {
    std::array<VkImageView, 3> views = {color.view(), depth.view(), window};
    VkFramebufferCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = 640;
    info.height = 480;
    info.layers = 1;
    VkFramebuffer framebuffer;
    vkCreateFramebuffer(device, &info, nullptr, &framebuffer);
    return framebuffer;
}
