// Two classes with members and methods of the same names, shadowed variables, blocks: only one of all these passes stores in vain.
#include <vulkan/vulkan.h>

static const VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;

namespace flat {
static const VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;

class Renderer {
public:
    void createRenderPass();

private:
    VkDevice m_device{};
    VkSampleCountFlagBits m_samples = VK_SAMPLE_COUNT_1_BIT;
    VkRenderPass m_pass{};
};

void Renderer::createRenderPass() {
    VkAttachmentDescription attachment{};
    attachment.format = VK_FORMAT_B8G8R8A8_SRGB;
    attachment.samples = m_samples;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(m_device, &info, nullptr, &m_pass);
}

VkPipelineMultisampleStateCreateInfo state() {
    VkPipelineMultisampleStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    info.rasterizationSamples = samples;
    return info;
}
}  // namespace flat

namespace smooth {
class Renderer {
public:
    void createRenderPass();
    void createMask();

private:
    VkDevice m_device{};
    VkSampleCountFlagBits m_samples = VK_SAMPLE_COUNT_4_BIT;
    VkRenderPass m_pass{}, m_maskPass{};
};

void Renderer::createRenderPass() {
    VkAttachmentDescription attachment[2]{};
    attachment[0].format = VK_FORMAT_B8G8R8A8_SRGB;
    attachment[0].samples = m_samples;
    attachment[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachment[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment[1].format = VK_FORMAT_B8G8R8A8_SRGB;
    attachment[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachment[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference reference[2] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = reference;
    subpass.pResolveAttachments = reference + 1;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(m_device, &info, nullptr, &m_pass);
}

void Renderer::createMask() {
    const VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  // hides the global one
    VkAttachmentDescription attachment{};
    attachment.format = VK_FORMAT_R8_UNORM;
    attachment.samples = samples;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    {
        const VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_8_BIT;  // of another block, used for nothing of this pass
        (void)samples;
    }
    vkCreateRenderPass(m_device, &info, nullptr, &m_maskPass);
}
}  // namespace smooth

VkSampleCountFlagBits global() { return samples; }
