// A pass is put together by a builder of the project, which is defined beside it.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <vector>

namespace engine {

class RenderPass {
public:
    class Builder {
    public:
        explicit Builder(VkDevice device) : device_{device} {}
        Builder& addAttachment(const VkAttachmentDescription& attachment);
        Builder& addSubpass(const VkSubpassDescription& subpass);
        Builder& addDependency(const VkSubpassDependency& dependency);
        std::unique_ptr<RenderPass> build();

    private:
        VkDevice device_;
        std::vector<VkAttachmentDescription> attachments_;
        std::vector<VkSubpassDescription> subpasses_;
        std::vector<VkSubpassDependency> dependencies_;
    };

    RenderPass(VkDevice device, const VkRenderPassCreateInfo& info);
    VkRenderPass handle() const { return pass_; }

private:
    VkDevice device_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
};

}  // namespace engine
