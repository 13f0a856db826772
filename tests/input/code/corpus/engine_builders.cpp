// Builders whose methods return the builder: the first pass stores what it resolves, the second does not.
#include <vulkan/vulkan.h>

#include <vector>

class PassBuilder {
public:
    PassBuilder& attachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
        VkAttachmentDescription description{};
        description.format = format;
        description.samples = samples;
        description.loadOp = load;
        description.storeOp = store;
        description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        m_attachments.push_back(description);
        return *this;
    }
    PassBuilder& color(uint32_t index);
    PassBuilder& resolve(uint32_t index);
    VkRenderPass build(VkDevice device) const;

private:
    std::vector<VkAttachmentDescription> m_attachments;
    VkAttachmentReference m_color{};
    VkAttachmentReference m_resolve{};
};

PassBuilder& PassBuilder::color(uint32_t index) {
    m_color.attachment = index;
    m_color.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return *this;
}

PassBuilder& PassBuilder::resolve(uint32_t index) {
    m_resolve.attachment = index;
    m_resolve.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return *this;
}

VkRenderPass PassBuilder::build(VkDevice device) const {
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &m_color;
    subpass.pResolveAttachments = &m_resolve;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(m_attachments.size());
    info.pAttachments = m_attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass scenePass(VkDevice device) {
    return PassBuilder()
        .attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                    VK_ATTACHMENT_STORE_OP_STORE)  // expect: MSAA201
        .attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)
        .color(0)
        .resolve(1)
        .build(device);
}

VkRenderPass overlayPass(VkDevice device) {
    PassBuilder builder;
    builder.attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE);
    builder.attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE);
    builder.color(0).resolve(1);
    return builder.build(device);
}
