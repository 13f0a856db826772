// Loops, switches, gotos, exceptions and flags that decide what a description ends up with. Every way through is right.
#include <vulkan/vulkan.h>

#include <stdexcept>
#include <string>
#include <vector>

enum class Quality { Low, Medium, High };

static VkSampleCountFlagBits samplesFor(Quality quality) {
    switch (quality) {
    case Quality::High:
    case Quality::Medium: return VK_SAMPLE_COUNT_4_BIT;
    case Quality::Low: break;
    }
    return VK_SAMPLE_COUNT_1_BIT;
}

VkAttachmentDescription bySwitch(VkFormat format, Quality quality) {
    VkAttachmentDescription d{};
    d.format = format;
    d.samples = samplesFor(quality);
    d.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    switch (quality) {
    case Quality::Low:
        d.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        d.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        break;
    case Quality::Medium:
        [[fallthrough]];
    case Quality::High:
        d.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        d.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    return d;
}

VkRenderPass create(VkDevice device, VkFormat format, Quality quality, bool linear) try {
    std::vector<VkAttachmentDescription> attachments{bySwitch(format, quality)};
    VkAttachmentReference references[2] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = references;

    const bool resolves = attachments[0].samples != VK_SAMPLE_COUNT_1_BIT;
    do {
        if (!resolves) break;
        attachments.push_back(attachments.front());
        attachments.back().samples = VK_SAMPLE_COUNT_1_BIT;
        attachments.back().loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments.back().storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachments.back().finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        subpass.pResolveAttachments = references + 1;
    } while (false);

    for (VkAttachmentDescription& attachment : attachments)
        if (linear) attachment.format = VK_FORMAT_R8G8B8A8_UNORM;

    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkResult result = VK_NOT_READY;
    int tries = 3;
again:
    result = vkCreateRenderPass(device, &info, nullptr, &pass);
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY && tries-- > 0) goto again;
    if (result != VK_SUCCESS) throw std::runtime_error("pass " + std::to_string(result));
    return pass;
} catch (const std::exception&) {
    return VK_NULL_HANDLE;
}

VkImage createImage(VkDevice device, VkExtent3D extent, Quality quality) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = extent;
    info.arrayLayers = 1;
    // Either many samples or many mip levels, never both.
    if (quality == Quality::Low) {
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.mipLevels = 5;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT;
    } else {
        info.samples = VK_SAMPLE_COUNT_4_BIT;
        info.mipLevels = 1;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    }
    VkImage image = VK_NULL_HANDLE;
    while (vkCreateImage(device, &info, nullptr, &image) == VK_ERROR_OUT_OF_DEVICE_MEMORY && info.mipLevels > 1) info.mipLevels--;
    return image;
}

VkPipelineMultisampleStateCreateInfo state(Quality quality, bool foliage) {
    VkPipelineMultisampleStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    info.rasterizationSamples = samplesFor(quality);
    if (foliage && info.rasterizationSamples > VK_SAMPLE_COUNT_1_BIT) info.alphaToCoverageEnable = VK_TRUE;
    if (quality == Quality::High) {
        info.sampleShadingEnable = VK_TRUE;
        info.minSampleShading = 0.5f;
    }
    return info;
}
