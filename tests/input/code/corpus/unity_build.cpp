// One file of a program that is built as a whole: another file defines the words around its functions, and two passes continue one another.
#include <vulkan/vulkan.h>

typedef unsigned int u32;

struct VulkanState {
    VkDevice device;
    VkFormat format;
    VkSampleCountFlagBits samples;
    VkRenderPass boxes;
    VkRenderPass letters;
};

internal VkAttachmentDescription
described(VkFormat format, VkSampleCountFlagBits samples)
{
    VkAttachmentDescription attachment = {};
    attachment.format = format;
    attachment.samples = samples;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    return attachment;
}

internal VkRenderPass
createPass(VkDevice device, VkAttachmentDescription color, VkFormat format)
{
    VkAttachmentDescription attachments[2] = {color, described(format, VK_SAMPLE_COUNT_1_BIT)};
    VkAttachmentReference colorReference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveReference = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &resolveReference;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, 0, &pass);
    return pass;
}

// The first of these passes stores what the second loads.
root_function VkRenderPass createLayer(VulkanState *state, VkAttachmentLoadOp load, VkImageLayout before)
{
    VkAttachmentDescription color = described(state->format, state->samples);
    color.loadOp = load;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.initialLayout = before;
    color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return createPass(state->device, color, state->format);
}

root_function void createPasses(VulkanState *state)
{
    state->samples = VK_SAMPLE_COUNT_4_BIT;
    state->boxes = createLayer(state, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_IMAGE_LAYOUT_UNDEFINED);
    state->letters = createLayer(state,
                                 VK_ATTACHMENT_LOAD_OP_LOAD,  // expect: MSAA202
                                 VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}
