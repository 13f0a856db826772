// Attachments are described in loops of unknown length; what is written to each of them is true of each.
#include <vector>
#include <vulkan/vulkan.h>

struct Attachment {
    VkFormat format;
    bool isDepth;
};

VkRenderPass createPass(VkDevice device, const std::vector<Attachment>& list, VkFormat window, VkRenderPass pass) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> colors, resolves;
    VkAttachmentReference depth = {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    for (const auto& entry : list) {
        VkAttachmentDescription description = {};
        description.format = entry.format;
        description.samples = VK_SAMPLE_COUNT_4_BIT;
        description.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect-later: MSAA202
        description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA201, MSAA203
        description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        const VkAttachmentReference reference = {uint32_t(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        if (entry.isDepth)
            depth = {reference.attachment, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        else
            colors.push_back(reference);
        attachments.push_back(description);
    }
    for (size_t i = 0; i < colors.size(); i++) {
        VkAttachmentDescription description = {};
        description.format = window;
        description.samples = VK_SAMPLE_COUNT_1_BIT;
        description.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        resolves.push_back({uint32_t(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        attachments.push_back(description);
    }
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = uint32_t(colors.size());
    subpass.pColorAttachments = colors.data();
    subpass.pResolveAttachments = resolves.data();
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = uint32_t(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    return pass;
}
