#include "resources.hpp"

namespace vendor {

static VkSampleCountFlagBits sampleBits(int samples) {
    switch (samples) {
        case 2:
            return VK_SAMPLE_COUNT_2_BIT;
        case 4:
            return VK_SAMPLE_COUNT_4_BIT;
        default:
            return VK_SAMPLE_COUNT_1_BIT;
    }
}

Image Allocator::createImage(const VkImageCreateInfo& info, VkMemoryPropertyFlags) {
    Image result;
    vkCreateImage(device_, &info, nullptr, &result.image);
    return result;
}

void Resources::initFramebuffer(int width, int height, int samples) {
    framebuffer_.width = width;
    framebuffer_.height = height;
    framebuffer_.samples = samples;
    const VkSampleCountFlagBits count = sampleBits(framebuffer_.samples);

    VkImageCreateInfo color = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    color.imageType = VK_IMAGE_TYPE_2D;
    color.format = VK_FORMAT_R8G8B8A8_UNORM;
    color.extent = {uint32_t(width), uint32_t(height), 1};
    color.mipLevels = 1;
    color.arrayLayers = 1;
    color.samples = count;
    color.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    framebuffer_.color = allocator_.createImage(color, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);

    VkImageCreateInfo depth = color;
    depth.format = VK_FORMAT_D32_SFLOAT;
    depth.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    framebuffer_.depth = allocator_.createImage(depth, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);

    if (samples > 1) {
        VkImageCreateInfo resolved = color;
        resolved.samples = VK_SAMPLE_COUNT_1_BIT;
        resolved.usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        framebuffer_.resolved = allocator_.createImage(resolved, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    }

    VkImageViewCreateInfo view = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    view.format = color.format;
    view.image = framebuffer_.color.image;
    vkCreateImageView(device_, &view, nullptr, &framebuffer_.viewColor);
    view.format = depth.format;
    view.image = framebuffer_.depth.image;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCreateImageView(device_, &view, nullptr, &framebuffer_.viewDepth);
}

void Resources::draw(VkCommandBuffer cmd) {
    VkRenderingAttachmentInfo color = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    color.imageView = framebuffer_.viewColor;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = framebuffer_.viewDepth;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.renderArea.extent = {uint32_t(framebuffer_.width), uint32_t(framebuffer_.height)};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(cmd, &info);
    vkCmdEndRendering(cmd);
}

void Resources::blit(VkCommandBuffer cmd) {
    if (framebuffer_.samples > 1) {
        VkImageResolve region = {};
        region.extent = {uint32_t(framebuffer_.width), uint32_t(framebuffer_.height), 1};
        region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        vkCmdResolveImage(cmd, framebuffer_.color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,  // expect: MSAA301#resolve
                          framebuffer_.resolved.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);  // expect: MSAA301#resolve
    }
}

}  // namespace vendor
