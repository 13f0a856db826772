// What the preprocessor leaves out, and what never runs: mistakes there are none. One lies where the code is live.
#include <vulkan/vulkan.h>

#define USE_OLD_PATH 0
#define TIER 2
#undef HAS_RESOLVE_QUIRK

struct Context {
    VkDevice device;
    VkPhysicalDevice gpu;
    VkRenderPass pass;
    VkSampleCountFlagBits samples;
};

#if 0
VkSampleCountFlagBits highest(const VkPhysicalDeviceLimits& limits) {
    VkSampleCountFlags counts = limits.framebufferColorSampleCounts;
    if (counts & VK_SAMPLE_COUNT_64_BIT) { return VK_SAMPLE_COUNT_64_BIT; }
    if (counts & VK_SAMPLE_COUNT_16_BIT) { return VK_SAMPLE_COUNT_16_BIT; }
    return VK_SAMPLE_COUNT_1_BIT;
}
#endif

static void describe(VkAttachmentDescription* attachments, VkFormat format) {
    attachments[0].format = attachments[1].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].finalLayout = attachments[1].finalLayout = VK_IMAGE_LAYOUT_GENERAL;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
}

static void create(Context& c, VkAttachmentDescription* attachments) {
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_GENERAL}, resolve{1, VK_IMAGE_LAYOUT_GENERAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(c.device, &info, nullptr, &c.pass);
}

void settled(Context& c, VkFormat format) {
    VkAttachmentDescription attachments[2] = {};
    describe(attachments, format);
#if USE_OLD_PATH || defined(HAS_RESOLVE_QUIRK)
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
#elif TIER >= 2
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
#else
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
#endif
    if (false) {
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    }
    create(c, attachments);
}

void mistaken(Context& c, VkFormat format) {
    VkAttachmentDescription attachments[2] = {};
    describe(attachments, format);
#if !USE_OLD_PATH
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
#else
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
#endif
#if 0
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
#elif !defined(NOT_KNOWN_HERE) && 1
#endif
    create(c, attachments);
}
