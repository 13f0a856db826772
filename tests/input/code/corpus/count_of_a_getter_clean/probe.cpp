#include "settings.h"

// A member of the same name in another class has another count.
namespace quarry {

struct ProbeTarget {
    vk::SampleCountFlagBits m_samples{vk::SampleCountFlagBits::e1};
    vk::SampleCountFlagBits samples() const { return m_samples; }
};

void createProbe(vk::Device device, const ProbeTarget& probe) {
    vk::ImageCreateInfo info;
    info.format = vk::Format::eD24UnormS8Uint;
    info.samples = probe.samples();
    info.usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled;
    device.createImage(info);
}

vk::ImageCreateInfo listed(bool depth, vk::SampleCountFlagBits samples) {
    vk::ImageCreateInfo info;
    info.format = depth ? vk::Format::eD32SfloatS8Uint : vk::Format::eB8G8R8A8Unorm;
    info.samples = samples;
    return info;
}

void createList(vk::Device device, const PictureSettings& settings) {
    device.createImage(listed(false, settings.samples()));
}

}  // namespace quarry
