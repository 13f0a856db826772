#pragma once

#include <vulkan/vulkan.h>

namespace engine {

class Device {
public:
    VkDevice handle() const { return device_; }
    VkSampleCountFlagBits samples() const { return samples_; }

private:
    VkDevice device_ = VK_NULL_HANDLE;
    VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_4_BIT;
};

class Image {
public:
    Image(Device& device, uint32_t width, uint32_t height, VkSampleCountFlagBits count, VkFormat format, VkImageUsageFlags usage)
        : device_{device} {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.extent = {width, height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.format = format;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.usage = usage;
        info.samples = count;
        vkCreateImage(device_.handle(), &info, nullptr, &image_);

        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image_;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        vkCreateImageView(device_.handle(), &view, nullptr, &view_);
    }
    VkImage handle() const { return image_; }
    VkImageView view() const { return view_; }

private:
    Device& device_;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
};

}  // namespace engine
