// An engine whose render pass is a singleton that converts to the handle; the framebuffers of another class use it.
#include <vulkan/vulkan.hpp>

class ScenePass {
public:
    static ScenePass* instance();
    void init(vk::Device device, vk::Format format, vk::SampleCountFlagBits samples);
    operator vk::RenderPass() const { return pass_; }

private:
    ScenePass() = default;
    static ScenePass* instance_;
    vk::RenderPass pass_;
};

ScenePass* ScenePass::instance_ = nullptr;

ScenePass* ScenePass::instance() {
    if (instance_ == nullptr) {
        instance_ = new ScenePass();
    }
    return instance_;
}

void ScenePass::init(vk::Device device, vk::Format format, vk::SampleCountFlagBits samples) {
    const vk::AttachmentDescription color(vk::AttachmentDescriptionFlags(), format, samples, vk::AttachmentLoadOp::eClear,
                                          vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,  // expect: MSAA201
                                          vk::AttachmentStoreOp::eDontCare, vk::ImageLayout::eUndefined,
                                          vk::ImageLayout::eColorAttachmentOptimal);
    const vk::AttachmentDescription resolved(vk::AttachmentDescriptionFlags(), format, vk::SampleCountFlagBits::e1,
                                             vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore,
                                             vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                             vk::ImageLayout::eUndefined, vk::ImageLayout::ePresentSrcKHR);
    vk::AttachmentReference colorReference(0, vk::ImageLayout::eColorAttachmentOptimal);
    vk::AttachmentReference resolvedReference(1, vk::ImageLayout::eColorAttachmentOptimal);
    vk::SubpassDescription subpass(vk::SubpassDescriptionFlags(), vk::PipelineBindPoint::eGraphics, 0, nullptr, 1, &colorReference,
                                   &resolvedReference);
    const vk::AttachmentDescription attachments[] = {color, resolved};
    vk::RenderPassCreateInfo info(vk::RenderPassCreateFlags(), 2, attachments, 1, &subpass);
    pass_ = device.createRenderPass(info);
}

class Framebuffer {
public:
    Framebuffer(vk::Device device, vk::Extent2D extent, vk::Format format, vk::ImageView window, vk::SampleCountFlagBits samples) {
        const vk::ImageCreateInfo image(vk::ImageCreateFlags(), vk::ImageType::e2D, format, vk::Extent3D(extent.width, extent.height, 1), 1,
                                        1, samples, vk::ImageTiling::eOptimal, vk::ImageUsageFlagBits::eColorAttachment);  // expect: MSAA401
        image_ = device.createImage(image);
        view_ = device.createImageView(vk::ImageViewCreateInfo({}, image_, vk::ImageViewType::e2D, format, {},
                                                               {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}));
        const vk::ImageView attachments[] = {view_, window};
        vk::FramebufferCreateInfo info(vk::FramebufferCreateFlags(), *ScenePass::instance(), 2, attachments, extent.width, extent.height, 1);
        framebuffer_ = device.createFramebuffer(info);
    }

private:
    vk::Image image_;
    vk::ImageView view_;
    vk::Framebuffer framebuffer_;
};

class Renderer {
public:
    void start(vk::Extent2D extent, vk::Format format, vk::ImageView window) {
        ScenePass::instance()->init(device_, format, vk::SampleCountFlagBits::e4);
        framebuffer_ = new Framebuffer(device_, extent, format, window, vk::SampleCountFlagBits::e4);
    }

private:
    vk::Device device_;
    Framebuffer* framebuffer_ = nullptr;
};
