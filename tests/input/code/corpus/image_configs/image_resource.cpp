#include "image_resource.h"

namespace viewer {

ImageResource::ImageResource(vk::Device device, const ImageConfig& config) : device_(device) {
    createImage(config);
    const vk::ImageViewCreateInfo info{
        .image = image_,
        .viewType = vk::ImageViewType::e2D,
        .format = config.format,
        .subresourceRange = {config.kind == ImageKind::Depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1},
    };
    view_ = device_.createImageView(info);
}

void ImageResource::createImage(const ImageConfig& config) {
    vk::ImageUsageFlags usage{};
    if (config.kind == ImageKind::Color) {
        usage = vk::ImageUsageFlagBits::eColorAttachment;
        if (config.count > vk::SampleCountFlagBits::e1) {
            usage |= vk::ImageUsageFlagBits::eTransientAttachment;
        }
    } else if (config.kind == ImageKind::Depth) {
        usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransientAttachment;
    } else {
        usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eSampled;
    }
    const vk::ImageCreateInfo info{
        .imageType = vk::ImageType::e2D,
        .format = config.format,
        .extent = {config.extent.width, config.extent.height, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = config.count,
        .tiling = vk::ImageTiling::eOptimal,
        .usage = usage,
    };
    image_ = device_.createImage(info);
}

}  // namespace viewer
