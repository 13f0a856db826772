// Lists whose length depends on the setting, as `new T[n]` and as a vector.
#include <vulkan/vulkan.h>

#include <vector>

extern bool smoothing;
extern int wantedSamples;

bool isSmooth() { return smoothing; }

VkSampleCountFlagBits sampleCount(VkPhysicalDevice gpu) {
    if (!smoothing) return VK_SAMPLE_COUNT_1_BIT;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(gpu, &properties);
    VkSampleCountFlags counts = properties.limits.framebufferColorSampleCounts;
    if (wantedSamples >= 8 && counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;
    if (wantedSamples >= 4 && counts & VK_SAMPLE_COUNT_4_BIT) return VK_SAMPLE_COUNT_4_BIT;
    return VK_SAMPLE_COUNT_2_BIT;
}

VkAttachmentDescription described(VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
    VkAttachmentDescription attachment = {};
    attachment.format = VK_FORMAT_B8G8R8A8_SRGB;
    attachment.samples = samples;
    attachment.loadOp = load;
    attachment.storeOp = store;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    return attachment;
}

VkRenderPass createMainPass(VkDevice device, VkPhysicalDevice gpu) {
    VkAttachmentDescription* attachments = new VkAttachmentDescription[isSmooth() ? 2 : 1];
    VkAttachmentReference* references = new VkAttachmentReference[isSmooth() ? 2 : 1];

    attachments[0].flags = 0;
    attachments[0].format = VK_FORMAT_B8G8R8A8_SRGB;
    attachments[0].samples = sampleCount(gpu);
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    if (isSmooth()) {
        attachments[1] = described(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE);
    }
    references[0].attachment = 0;
    references[0].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &references[0];
    if (isSmooth()) {
        references[1].attachment = 1;
        references[1].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        subpass.pResolveAttachments = &references[1];
    }

    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = isSmooth() ? 2 : 1;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    delete[] attachments;
    delete[] references;
    return pass;
}

// The samples are kept only where there is no resolve.
VkRenderPass createOverlayPass(VkDevice device, VkPhysicalDevice gpu) {
    std::vector<VkAttachmentDescription> attachments(isSmooth() ? 2 : 1);
    attachments[0] = described(sampleCount(gpu), VK_ATTACHMENT_LOAD_OP_CLEAR,
                               isSmooth() ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE);
    const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    if (isSmooth()) {
        attachments[1] = described(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE);
        subpass.pResolveAttachments = &resolve;
    }
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
