// Functions that return a VkAttachmentDescription, one calling the other; stencil is forgotten and so loaded and stored.
#include <vulkan/vulkan.h>

#include <array>

namespace attachments {

VkAttachmentDescription color(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentStoreOp store) {
    return VkAttachmentDescription{
        .format = format,
        .samples = samples,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = store,
        .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
        .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    };
}

VkAttachmentDescription multisampledColor(VkFormat format) {
    return color(format, VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_DONT_CARE);
}

VkAttachmentDescription window(VkFormat format) {
    VkAttachmentDescription description = color(format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE);
    description.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    description.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    return description;
}

VkAttachmentDescription depthStencil() {
    VkAttachmentDescription description{};  // may: MSAA204#stencil
    description.format = VK_FORMAT_D24_UNORM_S8_UINT;  // may: MSAA204#stencil
    description.samples = VK_SAMPLE_COUNT_4_BIT;  // expect: MSAA204#stencil
    description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    description.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    description.initialLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    description.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    return description;
}

}  // namespace attachments

class ScenePass final {
public:
    explicit ScenePass(VkDevice device, VkFormat format) : device_{device} {
        const std::array all{attachments::multisampledColor(format), attachments::window(format), attachments::depthStencil()};
        const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const VkAttachmentReference depth{2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                           .colorAttachmentCount = 1,
                                           .pColorAttachments = &color,
                                           .pResolveAttachments = &resolve,
                                           .pDepthStencilAttachment = &depth};
        const VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                          .attachmentCount = static_cast<uint32_t>(all.size()),
                                          .pAttachments = all.data(),
                                          .subpassCount = 1,
                                          .pSubpasses = &subpass};
        vkCreateRenderPass(device_, &info, nullptr, &pass_);
    }
    ~ScenePass() { vkDestroyRenderPass(device_, pass_, nullptr); }
    ScenePass(const ScenePass&) = delete;
    ScenePass& operator=(const ScenePass&) = delete;
    [[nodiscard]] VkRenderPass get() const noexcept { return pass_; }

private:
    VkDevice device_;
    VkRenderPass pass_{};
};
