// Values that are written twice, by loops, by functions behind references, by algorithms: only the last word counts. Nothing is wrong.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <vector>

void tuneForTilers(std::vector<VkAttachmentDescription>& attachments);  // in another file: may change anything
void tuneOne(VkAttachmentDescription* attachment);

static void discard(VkAttachmentDescription& attachment) { attachment.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE; }

static std::array<VkAttachmentDescription, 3> base(VkFormat format) {
    std::array<VkAttachmentDescription, 3> a{};
    for (auto& each : a) {
        each.format = format;
        each.samples = VK_SAMPLE_COUNT_4_BIT;
        each.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        each.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        each.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    a[1].samples = VK_SAMPLE_COUNT_1_BIT;
    a[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a[2].format = VK_FORMAT_D32_SFLOAT;
    a[2].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    return a;
}

static VkRenderPass create(VkDevice device, const VkAttachmentDescription* attachments, uint32_t count) {
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth{2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = count;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass byLoop(VkDevice device, VkFormat format) {
    auto attachments = base(format);
    for (auto& attachment : attachments)
        if (attachment.samples != VK_SAMPLE_COUNT_1_BIT) attachment.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, attachments.data(), 3);
}

VkRenderPass byIndex(VkDevice device, VkFormat format) {
    auto attachments = base(format);
    for (size_t i = 0; i < attachments.size(); i += 2) attachments[i].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    return create(device, attachments.data(), 3);
}

VkRenderPass byReference(VkDevice device, VkFormat format) {
    auto attachments = base(format);
    discard(attachments[0]);
    discard(attachments[2]);
    return create(device, attachments.data(), 3);
}

VkRenderPass byStranger(VkDevice device, VkFormat format) {
    const auto initial = base(format);
    std::vector<VkAttachmentDescription> attachments(initial.begin(), initial.end());
    tuneForTilers(attachments);
    return create(device, attachments.data(), 3);
}

VkRenderPass byPointer(VkDevice device, VkFormat format) {
    auto attachments = base(format);
    tuneOne(&attachments[0]);
    tuneOne(attachments.data() + 2);
    return create(device, attachments.data(), 3);
}

VkRenderPass byAlgorithm(VkDevice device, VkFormat format) {
    auto attachments = base(format);
    std::for_each(attachments.begin(), attachments.end(), [](VkAttachmentDescription& each) {
        if (each.samples > VK_SAMPLE_COUNT_1_BIT) each.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    });
    return create(device, attachments.data(), 3);
}
