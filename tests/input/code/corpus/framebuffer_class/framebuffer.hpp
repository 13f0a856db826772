// A framebuffer of a library of samples: attachments are added one after another, and the pass stores what shaders sample.
#pragma once

#include <vulkan/vulkan.h>

#include <vector>

namespace base {

struct Attachment {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkAttachmentDescription description{};

    bool isDepth() const { return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM; }
};

struct AttachmentInfo {
    uint32_t width, height;
    VkFormat format;
    VkImageUsageFlags usage;
    VkSampleCountFlagBits count = VK_SAMPLE_COUNT_1_BIT;
};

struct Framebuffer {
    VkDevice device = VK_NULL_HANDLE;
    VkRenderPass renderPass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    uint32_t width = 0, height = 0;
    std::vector<Attachment> attachments;

    uint32_t addAttachment(const AttachmentInfo& info) {
        Attachment attachment;
        attachment.format = info.format;

        VkImageCreateInfo image{};
        image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        image.imageType = VK_IMAGE_TYPE_2D;
        image.format = info.format;
        image.extent = {info.width, info.height, 1};
        image.mipLevels = 1;
        image.arrayLayers = 1;
        image.samples = info.count;
        image.tiling = VK_IMAGE_TILING_OPTIMAL;
        image.usage = info.usage;
        vkCreateImage(device, &image, nullptr, &attachment.image);

        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = attachment.image;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = info.format;
        vkCreateImageView(device, &view, nullptr, &attachment.view);

        attachment.description = {};
        attachment.description.samples = info.count;
        attachment.description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachment.description.storeOp =
            (info.usage & VK_IMAGE_USAGE_SAMPLED_BIT) ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachment.description.format = info.format;
        attachment.description.finalLayout =
            attachment.isDepth() ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        attachments.push_back(attachment);
        return static_cast<uint32_t>(attachments.size() - 1);
    }

    void createRenderPass() {
        std::vector<VkAttachmentDescription> descriptions;
        for (auto& attachment : attachments) {
            descriptions.push_back(attachment.description);
        }
        std::vector<VkAttachmentReference> colors;
        VkAttachmentReference depth{};
        bool hasDepth = false;
        uint32_t index = 0;
        for (auto& attachment : attachments) {
            if (attachment.isDepth()) {
                depth = {index, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
                hasDepth = true;
            } else {
                colors.push_back({index, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
            }
            index++;
        }
        VkSubpassDescription subpass{};
        subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpass.pColorAttachments = colors.data();
        subpass.colorAttachmentCount = static_cast<uint32_t>(colors.size());
        if (hasDepth) {
            subpass.pDepthStencilAttachment = &depth;
        }
        VkRenderPassCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
        info.pAttachments = descriptions.data();
        info.attachmentCount = static_cast<uint32_t>(descriptions.size());
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        vkCreateRenderPass(device, &info, nullptr, &renderPass);

        std::vector<VkImageView> views;
        for (const auto& attachment : attachments) {
            views.push_back(attachment.view);
        }
        VkFramebufferCreateInfo frame{};
        frame.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        frame.renderPass = renderPass;
        frame.pAttachments = views.data();
        frame.attachmentCount = static_cast<uint32_t>(views.size());
        frame.width = width;
        frame.height = height;
        frame.layers = 1;
        vkCreateFramebuffer(device, &frame, nullptr, &framebuffer);
    }
};

}  // namespace base
