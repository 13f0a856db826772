// Builders of a wrapper library: each call sets a member and returns the builder.
#pragma once

#include <memory>
#include <vulkan/vulkan.h>

class Image {
public:
    Image(VkDevice device, VkImage image, int width, int height) : device(device), image(image), width(width), height(height) {}

    VkDevice device;
    VkImage image;
    int width, height;
};

class ImageBuilder {
public:
    ImageBuilder();
    ImageBuilder& Size(int width, int height, int levels = 1);
    ImageBuilder& Samples(VkSampleCountFlagBits samples);
    ImageBuilder& Format(VkFormat format);
    ImageBuilder& Usage(VkImageUsageFlags usage);
    std::unique_ptr<Image> Create(VkDevice device);

private:
    VkImageCreateInfo info = {};
};

class RenderPassBuilder {
public:
    RenderPassBuilder& AddAttachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store);
    RenderPassBuilder& AddResolve(VkFormat format, VkAttachmentStoreOp store);
    VkRenderPass Create(VkDevice device);

private:
    VkAttachmentDescription attachments[4] = {};
    VkAttachmentReference color = {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    uint32_t count = 0;
};
