// The count begins as 1 in the class and is set by a method; the pass and the image are made by others.
#include <vulkan/vulkan.h>

#include <array>

class Renderer {
public:
    explicit Renderer(VkDevice device) : m_device(device) {}

    void setQuality(int quality) {
        m_samples = quality > 1 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_2_BIT;
    }

    bool init(VkExtent2D size);

private:
    bool initTargets(VkExtent2D size);
    bool initPass();
    bool initPipeline();

    VkDevice m_device;
    VkSampleCountFlagBits m_samples{VK_SAMPLE_COUNT_1_BIT};
    VkImage m_color{};
    VkImage m_depth{};
    VkRenderPass m_pass{};
    VkPipeline m_pipeline{};
    VkPipelineLayout m_layout{};
};

bool Renderer::init(VkExtent2D size) {
    setQuality(size.width > 1920 ? 1 : 2);
    return initTargets(size) && initPass() && initPipeline();
}

bool Renderer::initTargets(VkExtent2D size) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = m_samples;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    if (vkCreateImage(m_device, &info, nullptr, &m_color) != VK_SUCCESS) return false;
    info.format = VK_FORMAT_D32_SFLOAT;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    return vkCreateImage(m_device, &info, nullptr, &m_depth) == VK_SUCCESS;
}

bool Renderer::initPass() {
    std::array<VkAttachmentDescription, 3> attachments{};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = m_samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = m_samples;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[2] = attachments[0];
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[2].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    subpass.pDepthStencilAttachment = &depth;

    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    return vkCreateRenderPass(m_device, &info, nullptr, &m_pass) == VK_SUCCESS;
}

bool Renderer::initPipeline() {
    VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = m_samples;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pMultisampleState = &multisample;
    info.renderPass = m_pass;
    info.layout = m_layout;
    return vkCreateGraphicsPipelines(m_device, nullptr, 1, &info, nullptr, &m_pipeline) == VK_SUCCESS;
}
