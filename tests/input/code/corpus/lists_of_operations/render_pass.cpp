#include "render_pass.h"

namespace cookbook {

Texture::Texture(VkDevice device, VkFormat format, VkImageUsageFlags usage, VkExtent3D extent, VkSampleCountFlagBits count)
    : format_{format}, count_{count} {
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format_,
        .extent = extent,
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = count_,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = usage,
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
    };
    vkCreateImage(device, &info, nullptr, &image_);
}

bool Texture::isDepth() const {
    return format_ == VK_FORMAT_D32_SFLOAT || format_ == VK_FORMAT_D16_UNORM;
}

RenderPass::RenderPass(VkDevice device, const std::vector<std::shared_ptr<Texture>>& attachments,
                       const std::vector<std::shared_ptr<Texture>>& resolved, const std::vector<VkAttachmentLoadOp>& loads,
                       const std::vector<VkAttachmentStoreOp>& stores, const std::vector<VkImageLayout>& layouts) {
    std::vector<VkAttachmentDescription> descriptions;
    std::vector<VkAttachmentReference> colors;
    std::vector<VkAttachmentReference> resolves;
    VkAttachmentReference depth{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
    for (uint32_t index = 0; index < attachments.size(); ++index) {
        descriptions.emplace_back(VkAttachmentDescription{
            .format = attachments[index]->format(),
            .samples = attachments[index]->count(),
            .loadOp = loads[index],
            .storeOp = stores[index],
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = layouts[index],
        });
        if (attachments[index]->isDepth()) {
            depth = {index, layouts[index]};
        } else {
            colors.push_back({index, layouts[index]});
        }
    }
    for (uint32_t index = 0; index < resolved.size(); ++index) {
        const uint32_t place = static_cast<uint32_t>(attachments.size()) + index;
        descriptions.emplace_back(VkAttachmentDescription{
            .format = resolved[index]->format(),
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = loads[place],
            .storeOp = stores[place],
            .finalLayout = layouts[place],
        });
        resolves.push_back({place, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
    }
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = static_cast<uint32_t>(colors.size()),
        .pColorAttachments = colors.data(),
        .pResolveAttachments = resolves.data(),
        .pDepthStencilAttachment = &depth,
    };
    const VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = static_cast<uint32_t>(descriptions.size()),
        .pAttachments = descriptions.data(),
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    vkCreateRenderPass(device, &info, nullptr, &pass_);
}

}  // namespace cookbook
