// Words of an engine become operations of Vulkan by a switch, and conditions are spelled in several ways.
#include <vulkan/vulkan.h>

enum class Store { Keep, Discard, Any };

static VkAttachmentStoreOp storeOp(Store store) {
    VkAttachmentStoreOp result;
    switch (store) {
        case Store::Keep:
            result = VK_ATTACHMENT_STORE_OP_STORE;
            break;
        case Store::Discard:
        case Store::Any:
            result = VK_ATTACHMENT_STORE_OP_DONT_CARE;
            break;
        default:
            result = VK_ATTACHMENT_STORE_OP_STORE;
            break;
    }
    return result;
}

static VkRenderPass createPass(VkDevice device, bool multisampled, bool bright, Store store) {
    VkAttachmentDescription attachments[2] = {};
    const bool several = multisampled && !bright;
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = several ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    if (!multisampled || bright)
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    else
        attachments[0].storeOp = storeOp(store);
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1] = attachments[0];
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = several ? &resolve : nullptr;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass overlay(VkDevice device, bool multisampled, bool bright) {
    return createPass(device, multisampled, bright, Store::Any);
}
