#pragma once
#include <vulkan/vulkan.hpp>

namespace quarry {

/// What the user can change about the picture.
class PictureSettings {
public:
    void setUp(vk::PhysicalDevice adapter);
    PictureSettings& setSamples(vk::SampleCountFlagBits samples);
    vk::SampleCountFlagBits samples() const;

private:
    vk::SampleCountFlagBits m_samples{vk::SampleCountFlagBits::e1};
};

vk::SampleCountFlagBits bestSamples(vk::PhysicalDevice adapter);
vk::Format pickDepthFormat(vk::PhysicalDevice adapter);

}  // namespace quarry
