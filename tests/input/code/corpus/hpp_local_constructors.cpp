// vulkan.hpp before designated initializers: constants made by constructors whose first argument is a call, so that each could be the
// declaration of a function; masks compared by size; an interface pass that loads what the scene's pass resolved.
#include <vulkan/vulkan.hpp>

#include <array>

namespace studio::render {

class Context {
public:
    static Context* instance();
    vk::Device* device() { return &device_; }

    vk::SampleCountFlagBits highestUsableCount() const {  // expect: MSAA851
        const vk::PhysicalDeviceProperties properties = gpu_.getProperties();
        vk::SampleCountFlags counts;
        if (static_cast<uint32_t>(properties.limits.framebufferColorSampleCounts) <  // expect: MSAA852
            static_cast<uint32_t>(properties.limits.framebufferDepthSampleCounts)) {
            counts = properties.limits.framebufferColorSampleCounts;
        } else {
            counts = properties.limits.framebufferDepthSampleCounts;
        }
        if (counts & vk::SampleCountFlagBits::e64) return vk::SampleCountFlagBits::e64;
        if (counts & vk::SampleCountFlagBits::e32) return vk::SampleCountFlagBits::e32;
        if (counts & vk::SampleCountFlagBits::e16) return vk::SampleCountFlagBits::e16;
        if (counts & vk::SampleCountFlagBits::e8) return vk::SampleCountFlagBits::e8;
        if (counts & vk::SampleCountFlagBits::e4) return vk::SampleCountFlagBits::e4;
        if (counts & vk::SampleCountFlagBits::e2) return vk::SampleCountFlagBits::e2;
        return vk::SampleCountFlagBits::e1;
    }

private:
    vk::Device device_;
    vk::PhysicalDevice gpu_;
};

vk::Format depthFormat();

class ScenePass {
public:
    void create(const vk::Format& surfaceFormat, const vk::SampleCountFlagBits samples) {
        const vk::AttachmentDescription color(
            vk::AttachmentDescriptionFlags(),
            surfaceFormat,
            samples,
            vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore,  // expect: MSAA201
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined,
            vk::ImageLayout::eColorAttachmentOptimal);
        const vk::AttachmentDescription depth(
            vk::AttachmentDescriptionFlags(),
            vk::Format::eD32Sfloat,
            samples,
            vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eDontCare,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined,
            vk::ImageLayout::eDepthStencilAttachmentOptimal);
        const vk::AttachmentDescription resolve(
            vk::AttachmentDescriptionFlags(),
            surfaceFormat,
            vk::SampleCountFlagBits::e1,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eStore,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined,
            vk::ImageLayout::ePresentSrcKHR);
        vk::AttachmentReference colorReference(0, vk::ImageLayout::eColorAttachmentOptimal);
        vk::AttachmentReference depthReference(1, vk::ImageLayout::eDepthStencilAttachmentOptimal);
        vk::AttachmentReference resolveReference(2, vk::ImageLayout::eColorAttachmentOptimal);
        vk::SubpassDescription subpass(
            vk::SubpassDescriptionFlags(), vk::PipelineBindPoint::eGraphics, 0, nullptr, 1, &colorReference, &resolveReference, &depthReference);
        std::array<vk::AttachmentDescription, 3> attachments = {color, depth, resolve};
        vk::RenderPassCreateInfo info(
            vk::RenderPassCreateFlags(), static_cast<uint32_t>(attachments.size()), attachments.data(), 1, &subpass, 0, nullptr);
        const vk::Result result = Context::instance()->device()->createRenderPass(&info, nullptr, &pass_);
        static_cast<void>(result);
    }

private:
    vk::RenderPass pass_;
};

class DepthBuffer {
public:
    DepthBuffer(const vk::Extent2D* extent, const vk::SampleCountFlagBits samples);

private:
    vk::Image image_;
};

// The declaration of a function, with types as its parameters, is none of a variable.
vk::AttachmentDescription describe(vk::AttachmentDescriptionFlags, vk::Format, vk::SampleCountFlagBits samples);

}  // namespace studio::render
