#pragma once

#include "device.h"

namespace app {

struct ImageInfo {
    uint32_t width, height;
    VkFormat format;
    VkImageUsageFlags usage;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
};

class Image {
public:
    Image(const Device& device, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage,
          VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);

    operator VkImage() const { return m_image; }
    VkFormat format() const { return m_info.format; }

private:
    VkImage create() const;

    const Device& m_device;
    const ImageInfo m_info;
    VkImage m_image;
};

class ImageView {
public:
    ImageView(const Device& device, const Image& image, VkImageAspectFlags aspect);
    operator VkImageView() const { return m_view; }

private:
    VkImageView m_view = VK_NULL_HANDLE;
};

}
