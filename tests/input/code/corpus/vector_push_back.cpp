// Attachments collected in a std::vector: push_back of temporaries, emplace_back, and the index taken from size().
#include <vulkan/vulkan.h>

#include <vector>

class ForwardPass {
public:
    ForwardPass(VkDevice device, VkFormat colorFormat) : m_device(device), m_colorFormat(colorFormat) { build(); }
    ~ForwardPass() { vkDestroyRenderPass(m_device, m_pass, nullptr); }

private:
    void build();

    VkDevice m_device;
    VkFormat m_colorFormat;
    VkRenderPass m_pass = VK_NULL_HANDLE;
};

void ForwardPass::build() {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> colors, resolves;

    VkAttachmentDescription description = {};
    description.format = m_colorFormat;
    description.samples = VK_SAMPLE_COUNT_4_BIT;
    description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments.push_back(description);
    colors.push_back({0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});

    description.samples = VK_SAMPLE_COUNT_1_BIT;
    description.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    description.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    attachments.push_back(description);
    resolves.push_back({1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});

    VkAttachmentDescription& depth = attachments.emplace_back();
    depth.format = VK_FORMAT_D32_SFLOAT;
    depth.samples = VK_SAMPLE_COUNT_4_BIT;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference depthReference = {static_cast<uint32_t>(attachments.size() - 1),
                                                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};

    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<uint32_t>(colors.size());
    subpass.pColorAttachments = colors.data();
    subpass.pResolveAttachments = resolves.data();
    subpass.pDepthStencilAttachment = &depthReference;

    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(m_device, &info, nullptr, &m_pass);
}

VkRenderPass makeUnresolvedPass(VkDevice device) {
    // Nothing resolves, nothing stores: what this draws is lost.
    std::vector<VkAttachmentDescription> list;
    list.push_back(VkAttachmentDescription{
        0,
        VK_FORMAT_R8G8B8A8_UNORM,
        VK_SAMPLE_COUNT_4_BIT,
        VK_ATTACHMENT_LOAD_OP_CLEAR,
        VK_ATTACHMENT_STORE_OP_DONT_CARE,  // expect: MSAA207
        VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        VK_ATTACHMENT_STORE_OP_DONT_CARE,
        VK_IMAGE_LAYOUT_UNDEFINED,
        VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    });
    std::vector<VkAttachmentReference> colors{{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = colors.data();
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = (uint32_t)list.size();
    info.pAttachments = list.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
