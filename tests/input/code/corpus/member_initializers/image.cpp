#include "image.h"

using namespace app;

Image::Image(const Device& device, uint32_t width, uint32_t height, VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits samples)
    : m_device(device), m_info({.width = width, .height = height, .format = format, .usage = usage, .samples = samples}), m_image(create()) {}

VkImage Image::create() const {
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.extent = {m_info.width, m_info.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.format = m_info.format;
    info.usage = m_info.usage;
    info.samples = m_info.samples;
    VkImage image;
    vkCreateImage(m_device, &info, nullptr, &image);
    return image;
}

ImageView::ImageView(const Device& device, const Image& image, VkImageAspectFlags aspect) {
    VkImageViewCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = image.format();
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCreateImageView(device, &info, nullptr, &m_view);
}
