// One write holds whatever else is asked before it; more conditional ones follow than alternatives are kept.
#include <vulkan/vulkan.h>

struct Options {
    bool bloom, fog, water, glass, hair, skin, cloth, smoke, fire, rain, snow, dust, light, shade;
};

VkRenderPass createPass(VkDevice device, const Options& options, VkRenderPass pass) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (options.bloom) attachments[0].format = VK_FORMAT_R16G16B16A16_SFLOAT;
    if (options.fog) attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    if (options.water) attachments[0].format = VK_FORMAT_R8G8B8A8_SRGB;
    if (options.glass) attachments[0].format = VK_FORMAT_B8G8R8A8_UNORM;
    if (options.hair) attachments[0].format = VK_FORMAT_B8G8R8A8_SRGB;
    if (options.skin) attachments[0].format = VK_FORMAT_A2B10G10R10_UNORM_PACK32;
    if (options.cloth) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    if (options.smoke) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (options.fire) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    if (options.rain) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (options.snow) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    if (options.dust) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (options.light) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_NONE;
    if (options.shade) attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &target;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);

    return pass;
}
