// The same classes, where the samples of the depth need no memory: nothing to report.
#include <vulkan/vulkan.hpp>

#include <array>

class BaseImage {
public:
    virtual ~BaseImage() = default;
    vk::ImageView view() const { return m_view; }

protected:
    virtual vk::ImageUsageFlags usage() const = 0;
    virtual vk::ImageAspectFlags aspect() const { return vk::ImageAspectFlagBits::eColor; }

    void allocate(vk::Device device, vk::Format format, vk::SampleCountFlagBits samples) {
        const auto info = vk::ImageCreateInfo()
                              .setImageType(vk::ImageType::e2D)
                              .setFormat(format)
                              .setExtent({1280, 720, 1})
                              .setMipLevels(1)
                              .setArrayLayers(1)
                              .setSamples(samples)
                              .setTiling(vk::ImageTiling::eOptimal)
                              .setUsage(usage());
        m_image = device.createImage(info);
        m_view = device.createImageView(
            vk::ImageViewCreateInfo().setImage(m_image).setFormat(format).setSubresourceRange({aspect(), 0, 1, 0, 1}));
    }

    vk::Image m_image;
    vk::ImageView m_view;
};

class DepthImage final : public BaseImage {
public:
    void create(vk::Device device) { allocate(device, vk::Format::eD32Sfloat, vk::SampleCountFlagBits::e4); }

protected:
    vk::ImageUsageFlags usage() const override { return vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransientAttachment; }
    vk::ImageAspectFlags aspect() const override { return vk::ImageAspectFlagBits::eDepth; }
};

class SampledImage final : public BaseImage {
public:
    void create(vk::Device device) { allocate(device, vk::Format::eR8G8B8A8Unorm, vk::SampleCountFlagBits::e4); }

protected:
    vk::ImageUsageFlags usage() const override {
        return vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled;
    }
};

class Scene {
public:
    void prepare(vk::Device device) {
        m_depth.create(device);
        m_color.create(device);
        std::array<vk::AttachmentDescription, 2> attachments;
        attachments[0]
            .setFormat(vk::Format::eR8G8B8A8Unorm)
            .setSamples(vk::SampleCountFlagBits::e4)
            .setLoadOp(vk::AttachmentLoadOp::eClear)
            .setStoreOp(vk::AttachmentStoreOp::eStore)
            .setFinalLayout(vk::ImageLayout::eShaderReadOnlyOptimal);
        attachments[1]
            .setFormat(vk::Format::eD32Sfloat)
            .setSamples(vk::SampleCountFlagBits::e4)
            .setLoadOp(vk::AttachmentLoadOp::eClear)
            .setStoreOp(vk::AttachmentStoreOp::eDontCare)
            .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
            .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare)
            .setFinalLayout(vk::ImageLayout::eDepthStencilAttachmentOptimal);
        const vk::AttachmentReference color(0, vk::ImageLayout::eColorAttachmentOptimal);
        const vk::AttachmentReference depth(1, vk::ImageLayout::eDepthStencilAttachmentOptimal);
        const auto subpass = vk::SubpassDescription().setColorAttachments(color).setPDepthStencilAttachment(&depth);
        m_pass = device.createRenderPass(vk::RenderPassCreateInfo().setAttachments(attachments).setSubpasses(subpass));
        const std::array views = {m_color.view(), m_depth.view()};
        m_framebuffer = device.createFramebuffer(
            vk::FramebufferCreateInfo().setRenderPass(m_pass).setAttachments(views).setWidth(1280).setHeight(720).setLayers(1));
    }

    vk::DescriptorImageInfo color(vk::Sampler sampler) const {
        return {sampler, m_color.view(), vk::ImageLayout::eShaderReadOnlyOptimal};
    }

private:
    DepthImage m_depth;
    SampledImage m_color;
    vk::RenderPass m_pass;
    vk::Framebuffer m_framebuffer;
};
