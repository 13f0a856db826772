// Lists of attachments and views that multisampling makes longer, as frameworks build them.
#include <vulkan/vulkan.h>

#include <array>
#include <vector>

struct SwapchainDesc {
    VkFormat colorFormat;
    VkFormat depthFormat;
    VkSampleCountFlagBits samples;
};

class Framework {
public:
    void createPass(const SwapchainDesc& desc);
    void createFramebuffers(VkImageView color, VkImageView depth, const std::vector<VkImageView>& backbuffers);
    void createSecondPass(const SwapchainDesc& desc, bool hasStencil);

private:
    VkDevice device = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkRenderPass second = VK_NULL_HANDLE;
    std::vector<VkFramebuffer> framebuffers;
};

void Framework::createPass(const SwapchainDesc& desc) {
    const bool msaa = desc.samples != VK_SAMPLE_COUNT_1_BIT;
    std::vector<VkAttachmentDescription> attachments;

    VkAttachmentDescription color{};
    color.format = desc.colorFormat;
    color.samples = desc.samples;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    color.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    color.finalLayout = msaa ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    attachments.push_back(color);

    VkAttachmentDescription depth{};
    depth.format = desc.depthFormat;
    depth.samples = desc.samples;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments.push_back(depth);

    VkAttachmentReference colorRef{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depthRef{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveRef{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};

    if (msaa) {
        VkAttachmentDescription resolve{};
        resolve.format = desc.colorFormat;
        resolve.samples = VK_SAMPLE_COUNT_1_BIT;
        resolve.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA205
        resolve.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        resolve.initialLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        resolve.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        resolveRef = {uint32_t(attachments.size()), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        attachments.push_back(resolve);
    }

    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorRef;
    subpass.pDepthStencilAttachment = &depthRef;
    subpass.pResolveAttachments = msaa ? &resolveRef : nullptr;

    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
}

void Framework::createFramebuffers(VkImageView color, VkImageView depth, const std::vector<VkImageView>& backbuffers) {
    framebuffers.resize(backbuffers.size());
    for (size_t i = 0; i < backbuffers.size(); ++i) {
        std::vector<VkImageView> views = {color, depth, backbuffers[i]};
        VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
        info.renderPass = pass;
        info.attachmentCount = static_cast<uint32_t>(views.size());
        info.pAttachments = views.data();
        info.layers = 1;
        vkCreateFramebuffer(device, &info, nullptr, &framebuffers[i]);
    }
}

// Whether there is a stencil attachment depends on something else: the others are known all the same.
void Framework::createSecondPass(const SwapchainDesc& desc, bool hasStencil) {
    std::vector<VkAttachmentDescription> attachments(2);
    attachments[0].format = desc.colorFormat;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].format = desc.colorFormat;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (hasStencil) {
        VkAttachmentDescription stencil{};
        stencil.format = desc.depthFormat;
        stencil.samples = VK_SAMPLE_COUNT_4_BIT;
        stencil.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        stencil.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        stencil.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        stencil.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments.push_back(stencil);
    }
    std::array<VkAttachmentReference, 3> references = {{
        {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
    }};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &references[0];
    subpass.pResolveAttachments = &references[1];
    subpass.pDepthStencilAttachment = hasStencil ? &references[2] : nullptr;

    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = hasStencil ? 3 : 2;
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &second);
}
