// Two passes draw to the same samples: the first stores them, the second loads, stores, and resolves them.
#include "swapchain.h"

#include <vector>

class RenderPass {
public:
    void CreateScene(VkDevice device);
    void CreateGui(VkDevice device);

private:
    void Add(VkFormat format, VkAttachmentLoadOp load, VkAttachmentStoreOp store);
    void Create(VkDevice device, const VkAttachmentReference* resolve);

    std::vector<VkAttachmentDescription> attachments_;
    std::vector<VkSubpassDescription> subpasses_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
};

void RenderPass::Add(VkFormat format, VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
    VkAttachmentDescription& attachment = attachments_.emplace_back();
    attachment.format = format;
    attachment.samples = static_cast<VkSampleCountFlagBits>(SwapChain::Get()->Samples());
    attachment.loadOp = load;
    attachment.storeOp = store;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

void RenderPass::Create(VkDevice device, const VkAttachmentReference* resolve) {
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription& subpass = subpasses_.emplace_back();
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = resolve;

    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments_.size());
    info.pAttachments = attachments_.data();
    info.subpassCount = static_cast<uint32_t>(subpasses_.size());
    info.pSubpasses = subpasses_.data();
    vkCreateRenderPass(device, &info, nullptr, &pass_);
}

void RenderPass::CreateScene(VkDevice device) {
    attachments_.clear();
    subpasses_.clear();
    Add(SwapChain::Get()->Format(), VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE);
    Create(device, nullptr);
}

void RenderPass::CreateGui(VkDevice device) {
    const bool multisampled = SwapChain::Get()->Samples() != VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentDescription color{};
    color.format = SwapChain::Get()->Format();
    color.samples = static_cast<VkSampleCountFlagBits>(SwapChain::Get()->Samples());
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA202
    color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA201
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    VkAttachmentDescription resolve{};
    resolve.format = SwapChain::Get()->Format();
    resolve.samples = VK_SAMPLE_COUNT_1_BIT;
    resolve.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    resolve.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    resolve.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    resolve.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;

    attachments_ = {color};
    subpasses_.clear();
    VkAttachmentReference reference{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    if (multisampled)
        attachments_.emplace_back(resolve);
    Create(device, multisampled ? &reference : nullptr);
}
