#include "image.h"

vk::SampleCountFlagBits Settings::sampleCount() const {
    return _count;
}

bool Settings::multisamplingSupported() const {
    return _count != vk::SampleCountFlagBits::e1;
}

Settings& Settings::setSampleCount(vk::SampleCountFlagBits count) {
    _count = count;
    return *this;
}

void Image::createImage(vk::Device device, vk::Format format, vk::SampleCountFlagBits samples) {
    const auto info = vk::ImageCreateInfo()
                          .setImageType(vk::ImageType::e2D)
                          .setFormat(format)
                          .setExtent({640, 480, 1})
                          .setMipLevels(1)
                          .setArrayLayers(1)
                          .setSamples(samples)
                          .setUsage(usage());
    _image = device.createImage(info);
    _view = device.createImageView(vk::ImageViewCreateInfo()
                                       .setImage(_image)
                                       .setViewType(vk::ImageViewType::e2D)
                                       .setFormat(format)
                                       .setSubresourceRange({aspects(), 0, 1, 0, 1}));
}

void MultisampledImage::create(vk::Device device, const Settings& settings) {
    createImage(device, vk::Format::eB8G8R8A8Srgb, settings.sampleCount());
}

vk::ImageUsageFlags MultisampledImage::usage() const {
    return vk::ImageUsageFlagBits::eTransientAttachment | vk::ImageUsageFlagBits::eColorAttachment;
}

vk::ImageAspectFlags MultisampledImage::aspects() const {
    return vk::ImageAspectFlagBits::eColor;
}

void DepthImage::create(vk::Device device, const Settings& settings) {
    createImage(device, vk::Format::eD32Sfloat, settings.sampleCount());
}

vk::ImageUsageFlags DepthImage::usage() const {
    return vk::ImageUsageFlagBits::eDepthStencilAttachment;  // expect: MSAA401
}

vk::ImageAspectFlags DepthImage::aspects() const {
    return vk::ImageAspectFlagBits::eDepth;
}
