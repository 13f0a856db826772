#include "render_pass.hpp"

namespace engine {

RenderPass::Builder& RenderPass::Builder::addAttachment(const VkAttachmentDescription& attachment) {
    attachments_.push_back(attachment);
    return *this;
}

RenderPass::Builder& RenderPass::Builder::addSubpass(const VkSubpassDescription& subpass) {
    subpasses_.push_back(subpass);
    return *this;
}

RenderPass::Builder& RenderPass::Builder::addDependency(const VkSubpassDependency& dependency) {
    dependencies_.push_back(dependency);
    return *this;
}

std::unique_ptr<RenderPass> RenderPass::Builder::build() {
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = static_cast<uint32_t>(attachments_.size());
    info.pAttachments = attachments_.data();
    info.subpassCount = static_cast<uint32_t>(subpasses_.size());
    info.pSubpasses = subpasses_.data();
    info.dependencyCount = static_cast<uint32_t>(dependencies_.size());
    info.pDependencies = dependencies_.data();
    return std::make_unique<RenderPass>(device_, info);
}

RenderPass::RenderPass(VkDevice device, const VkRenderPassCreateInfo& info) : device_{device} {
    vkCreateRenderPass(device_, &info, nullptr, &pass_);
}

}  // namespace engine
