#include "builders.h"

ImageBuilder::ImageBuilder() {
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.extent.depth = 1;
    info.arrayLayers = 1;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
}

ImageBuilder& ImageBuilder::Size(int width, int height, int levels) {
    info.extent.width = width;
    info.extent.height = height;
    info.mipLevels = levels;
    return *this;
}

ImageBuilder& ImageBuilder::Samples(VkSampleCountFlagBits samples) {
    info.samples = samples;
    return *this;
}

ImageBuilder& ImageBuilder::Format(VkFormat format) {
    info.format = format;
    return *this;
}

ImageBuilder& ImageBuilder::Usage(VkImageUsageFlags usage) {
    info.usage = usage;
    return *this;
}

std::unique_ptr<Image> ImageBuilder::Create(VkDevice device) {
    VkImage image;
    vkCreateImage(device, &info, nullptr, &image);
    return std::make_unique<Image>(device, image, info.extent.width, info.extent.height);
}

RenderPassBuilder& RenderPassBuilder::AddAttachment(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load,
                                                    VkAttachmentStoreOp store) {
    VkAttachmentDescription& attachment = attachments[count];
    attachment.format = format;
    attachment.samples = samples;
    attachment.loadOp = load;
    attachment.storeOp = store;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.attachment = count++;
    return *this;
}

RenderPassBuilder& RenderPassBuilder::AddResolve(VkFormat format, VkAttachmentStoreOp store) {
    VkAttachmentDescription& attachment = attachments[count];
    attachment.format = format;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.storeOp = store;
    attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    resolve.attachment = count++;
    return *this;
}

VkRenderPass RenderPassBuilder::Create(VkDevice device) {
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = count;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
