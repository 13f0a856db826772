#include <array>

#include "device.hpp"
#include "render_pass.hpp"

namespace engine {

class SwapChainRenderer {
public:
    SwapChainRenderer(Device& device, VkFormat format, uint32_t width, uint32_t height, VkImageView window)
        : device_{device}, width_{width}, height_{height} {
        createImages(format);
        createRenderPass(format);
        createFramebuffer(window);
    }

private:
    void createImages(VkFormat format) {
        color_ = std::make_shared<Image>(device_, width_, height_, device_.samples(), format,
                                         VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
        depth_ = std::make_shared<Image>(device_, width_, height_, device_.samples(), VK_FORMAT_D32_SFLOAT,
                                         VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);  // expect: MSAA401
    }

    void createRenderPass(VkFormat format) {
        auto samples = device_.samples();

        VkAttachmentDescription color{};
        color.format = format;
        color.samples = samples;
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201  // may: MSAA403
        color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

        VkAttachmentDescription depth{};
        depth.format = VK_FORMAT_D32_SFLOAT;
        depth.samples = samples;
        depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

        VkAttachmentDescription resolve{};
        resolve.format = format;
        resolve.samples = VK_SAMPLE_COUNT_1_BIT;
        resolve.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        resolve.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        resolve.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

        VkAttachmentReference colorReference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkAttachmentReference depthReference{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        VkAttachmentReference resolveReference{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass{};
        subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &colorReference;
        subpass.pDepthStencilAttachment = &depthReference;
        subpass.pResolveAttachments = &resolveReference;

        VkSubpassDependency dependency{};
        dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
        dependency.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
        dependency.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT;
        dependency.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;

        pass_ = RenderPass::Builder(device_.handle())
                    .addAttachment(color)
                    .addAttachment(depth)
                    .addAttachment(resolve)
                    .addSubpass(subpass)
                    .addDependency(dependency)
                    .build();
    }

    void createFramebuffer(VkImageView window) {
        const std::array<VkImageView, 3> views = {color_->view(), depth_->view(), window};
        VkFramebufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        info.renderPass = pass_->handle();
        info.attachmentCount = static_cast<uint32_t>(views.size());
        info.pAttachments = views.data();
        info.width = width_;
        info.height = height_;
        info.layers = 1;
        vkCreateFramebuffer(device_.handle(), &info, nullptr, &framebuffer_);
    }

    Device& device_;
    uint32_t width_;
    uint32_t height_;
    std::shared_ptr<Image> color_;
    std::shared_ptr<Image> depth_;
    std::unique_ptr<RenderPass> pass_;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
};

}  // namespace engine
