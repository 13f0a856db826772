// Descriptions copied from one another and changed: the copy keeps what was not changed.
#include <vulkan/vulkan.h>

#include <vector>

static VkAttachmentDescription baseColor(VkFormat format) {
    VkAttachmentDescription d = {};
    d.format = format;
    d.samples = VK_SAMPLE_COUNT_1_BIT;
    d.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    d.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    d.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    d.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    d.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    return d;
}

VkRenderPass copyThenChange(VkDevice device, VkFormat format) {
    VkAttachmentDescription window = baseColor(format);
    window.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;

    VkAttachmentDescription color = {};
    color.format = format;
    color.samples = VK_SAMPLE_COUNT_1_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA201#copied
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    VkAttachmentDescription multisampled = color;  // may: MSAA201#copied
    multisampled.samples = VK_SAMPLE_COUNT_4_BIT;  // expect: MSAA201#copied

    VkAttachmentDescription list[2];
    list[0] = multisampled;
    list[1] = window;
    VkAttachmentReference colorReference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveReference = colorReference;
    resolveReference.attachment = 1;
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &resolveReference;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = list;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

// The other way round: the multisampled one is right, the copy becomes the resolve target.
VkRenderPass multisampledFirst(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list(2);
    VkAttachmentDescription& color = list[0];
    color = baseColor(format);
    color.samples = VK_SAMPLE_COUNT_4_BIT;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    list[1] = color;
    list[1].samples = VK_SAMPLE_COUNT_1_BIT;
    list[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    list[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    list[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference colorReference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveReference = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &resolveReference;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(list.size());
    info.pAttachments = list.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

// Not multisampled at all: STORE is as it has to be.
VkRenderPass plain(VkDevice device, VkFormat format) {
    VkAttachmentDescription only = baseColor(format);
    VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &only;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
