// The path for one sample ends before the path for many begins: what is stored there is not multisampled. Nothing is wrong.
#include <vulkan/vulkan.h>

class Targets {
public:
    Targets(VkDevice device, VkFormat format, VkSampleCountFlagBits samples) : device(device), format(format), samples(samples) {}

    VkRenderPass createPass() {
        VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass{};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        VkRenderPass pass{};

        if (samples == VK_SAMPLE_COUNT_1_BIT) {
            VkAttachmentDescription only{};
            only.format = format;
            only.samples = samples;
            only.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            only.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            only.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
            info.attachmentCount = 1;
            info.pAttachments = &only;
            vkCreateRenderPass(device, &info, nullptr, &pass);
            return pass;
        }

        VkAttachmentDescription both[2]{};
        both[0].format = both[1].format = format;
        both[0].samples = samples;
        both[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        both[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        both[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        both[1].samples = VK_SAMPLE_COUNT_1_BIT;
        both[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        both[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        both[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        subpass.pResolveAttachments = &resolve;
        info.attachmentCount = 2;
        info.pAttachments = both;
        vkCreateRenderPass(device, &info, nullptr, &pass);
        return pass;
    }

    VkImage createColor(VkExtent2D size) {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = samples;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        if (samples == VK_SAMPLE_COUNT_1_BIT)
            info.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
        else
            info.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        VkImage image{};
        vkCreateImage(device, &info, nullptr, &image);
        return image;
    }

private:
    VkDevice device;
    VkFormat format;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
};

// A switch in which each case makes a pass of its own.
VkAttachmentStoreOp storeFor(VkSampleCountFlagBits samples, bool readback) {
    switch (samples) {
    case VK_SAMPLE_COUNT_1_BIT: return VK_ATTACHMENT_STORE_OP_STORE;
    default: return readback ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
}

VkAttachmentDescription describe(VkFormat format, VkSampleCountFlagBits samples, bool readback) {
    return {0,
            format,
            samples,
            VK_ATTACHMENT_LOAD_OP_CLEAR,
            storeFor(samples, readback),
            VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            VK_ATTACHMENT_STORE_OP_DONT_CARE,
            VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
}
