// Images of three kinds are made from a configuration that is copied and changed; the kind chooses the usage.
#pragma once

#define VULKAN_HPP_NO_CONSTRUCTORS
#include <vulkan/vulkan.hpp>

namespace viewer {

enum class ImageKind { Color, Depth, Resolve };

struct ImageConfig {
    ImageKind kind;
    vk::Extent2D extent;
    vk::Format format;
    vk::SampleCountFlagBits count;
};

class ImageResource {
public:
    ImageResource(vk::Device device, const ImageConfig& config);
    vk::ImageView view() const { return view_; }

private:
    void createImage(const ImageConfig& config);

    vk::Device device_;
    vk::Image image_;
    vk::ImageView view_;
};

}  // namespace viewer
