#include "image_resource.h"

#include <vector>

namespace viewer {

class PhysicalDevice {
public:
    vk::SampleCountFlagBits samples() const { return samples_; }

private:
    vk::SampleCountFlagBits samples_ = vk::SampleCountFlagBits::e4;
};

class RenderTarget {
public:
    RenderTarget(vk::Device device, const PhysicalDevice& gpu, vk::Extent2D extent, uint32_t frames) : extent_(extent) {
        const ImageConfig config{.kind = ImageKind::Color, .extent = extent, .format = vk::Format::eR8G8B8A8Unorm, .count = gpu.samples()};

        auto depthConfig = config;
        depthConfig.kind = ImageKind::Depth;
        depthConfig.format = vk::Format::eD32Sfloat;

        auto resolveConfig = config;
        resolveConfig.kind = ImageKind::Resolve;
        resolveConfig.count = vk::SampleCountFlagBits::e1;

        for (uint32_t frame = 0; frame < frames; ++frame) {
            color_.emplace_back(device, config);
            depth_.emplace_back(device, depthConfig);
            resolved_.emplace_back(device, resolveConfig);
        }
    }

    void begin(vk::CommandBuffer commands, uint32_t frame) const {
        vk::RenderingAttachmentInfo color{
            .imageView = color_.at(frame).view(),
            .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .resolveMode = vk::ResolveModeFlagBits::eAverage,
            .resolveImageView = resolved_.at(frame).view(),
            .resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eStore,  // expect: MSAA201
        };
        vk::RenderingAttachmentInfo depth{
            .imageView = depth_.at(frame).view(),
            .imageLayout = vk::ImageLayout::eDepthStencilAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eDontCare,
        };
        const vk::RenderingInfo info{
            .renderArea = {{0, 0}, extent_},
            .layerCount = 1,
            .colorAttachmentCount = 1,
            .pColorAttachments = &color,
            .pDepthAttachment = &depth,
        };
        commands.beginRendering(info);
    }

private:
    vk::Extent2D extent_;
    std::vector<ImageResource> color_;
    std::vector<ImageResource> depth_;
    std::vector<ImageResource> resolved_;
};

}  // namespace viewer
