// Structures in memory of new, in std::array and std::to_array, through spans and by a ternary of whole structures.
#include <array>
#include <memory>
#include <span>
#include <vulkan/vulkan.h>

static VkAttachmentDescription describe(VkSampleCountFlagBits samples, VkAttachmentStoreOp store) {
    return {0, VK_FORMAT_R8G8B8A8_UNORM, samples, VK_ATTACHMENT_LOAD_OP_DONT_CARE, store, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
}

VkRenderPass ofNew(VkDevice device, VkRenderPass pass) {
    const uint32_t count = 2;
    auto* attachments = new VkAttachmentDescription[count]();
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &target;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = count;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    delete[] attachments;
    return pass;
}

VkRenderPass ofPointer(VkDevice device, VkRenderPass pass) {
    auto attachments = std::make_unique<VkAttachmentDescription[]>(2);
    attachments[0] = describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
    attachments[1] = describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE);
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &target;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
    info.pAttachments = attachments.get();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    return pass;
}

static VkRenderPass create(VkDevice device, std::span<const VkAttachmentDescription> attachments) {
    VkRenderPass pass;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &target;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = uint32_t(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    return pass;
}

VkRenderPass ofLists(VkDevice device) {
    const auto attachments = std::to_array<VkAttachmentDescription>({
        describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
        describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE),
    });
    return create(device, attachments);
}

VkRenderPass ofChoice(VkDevice device, bool multisampled, VkRenderPass pass) {
    const VkAttachmentDescription one = describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE);
    const VkAttachmentDescription several = describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
    std::array<VkAttachmentDescription, 2> attachments = {multisampled ? several : one, one};
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = multisampled ? &target : nullptr;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = multisampled ? 2u : 1u;
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    return pass;
}
