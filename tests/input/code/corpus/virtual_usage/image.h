// Images of an engine: the base class creates them, and what they are for is said by virtual functions.
#pragma once

#include <vulkan/vulkan.hpp>

class Settings {
public:
    vk::SampleCountFlagBits sampleCount() const;
    bool multisamplingSupported() const;
    Settings& setSampleCount(vk::SampleCountFlagBits count);

private:
    vk::SampleCountFlagBits _count{vk::SampleCountFlagBits::e1};
};

class Image {
public:
    virtual ~Image() = default;
    vk::ImageView view() const { return _view; }

protected:
    void createImage(vk::Device device, vk::Format format, vk::SampleCountFlagBits samples);
    virtual vk::ImageUsageFlags usage() const = 0;
    virtual vk::ImageAspectFlags aspects() const = 0;

    vk::Image _image;
    vk::ImageView _view;
};

class MultisampledImage final : public Image {
public:
    void create(vk::Device device, const Settings& settings);

protected:
    vk::ImageUsageFlags usage() const override;
    vk::ImageAspectFlags aspects() const override;
};

class DepthImage final : public Image {
public:
    void create(vk::Device device, const Settings& settings);

protected:
    vk::ImageUsageFlags usage() const override;
    vk::ImageAspectFlags aspects() const override;
};
