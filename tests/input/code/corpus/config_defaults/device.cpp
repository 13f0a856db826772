#include "config.h"

#include <stdexcept>

namespace translate {

VkAttachmentLoadOp get(LoadOp op) {
    switch (op) {
    case LOAD_OP_LOAD:
        return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LOAD_OP_CLEAR:
        return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LOAD_OP_DONT_CARE:
        return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    default:
        throw std::runtime_error("no such operation");
    }
}

VkAttachmentStoreOp get(StoreOp op) {
    switch (op) {
    case STORE_OP_STORE:
        return VK_ATTACHMENT_STORE_OP_STORE;
    case STORE_OP_DONT_CARE:
        return VK_ATTACHMENT_STORE_OP_DONT_CARE;
    default:
        throw std::runtime_error("no such operation");
    }
}

}  // namespace translate

VkRenderPass createRenderPass(VkDevice device, const std::vector<AttachmentConfig>& attachments) {
    std::vector<VkAttachmentDescription> descriptions(attachments.size());
    std::vector<VkAttachmentReference> colors, resolves;
    VkAttachmentReference depth{};
    bool hasDepth = false, hasResolve = false;
    for (size_t i = 0; i < attachments.size(); i++) {
        descriptions[i].format = attachments[i].format;
        descriptions[i].samples = static_cast<VkSampleCountFlagBits>(attachments[i].samples);
        descriptions[i].loadOp = translate::get(attachments[i].loadOp);
        descriptions[i].storeOp = translate::get(attachments[i].storeOp);
        descriptions[i].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        descriptions[i].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        switch (attachments[i].role) {
        case Role::Color:
            colors.push_back({uint32_t(i), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
            break;
        case Role::Depth:
            hasDepth = true;
            depth = {uint32_t(i), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
            break;
        case Role::Resolve:
            hasResolve = true;
            resolves.push_back({uint32_t(i), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
            break;
        }
    }
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = uint32_t(colors.size());
    subpass.pColorAttachments = colors.data();
    if (hasDepth)
        subpass.pDepthStencilAttachment = &depth;
    if (hasResolve)
        subpass.pResolveAttachments = resolves.data();
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = uint32_t(descriptions.size());
    info.pAttachments = descriptions.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
