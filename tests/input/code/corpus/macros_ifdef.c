/* Counts and operations from macros, parts chosen by the preprocessor. */
#include <vulkan/vulkan.h>

#ifndef MSAA_SAMPLES
#define MSAA_SAMPLES 4
#endif

#define CONCAT_(a, b, c) a##b##c
#define CONCAT(a, b, c) CONCAT_(a, b, c)
#define SAMPLE_BIT CONCAT(VK_SAMPLE_COUNT_, MSAA_SAMPLES, _BIT)
#define SCENE_SAMPLES VK_SAMPLE_COUNT_4_BIT
#define KEEP VK_ATTACHMENT_STORE_OP_STORE
#define DROP VK_ATTACHMENT_STORE_OP_DONT_CARE
#define VK_CHECK(x) do { VkResult r_ = (x); if (r_) return r_; } while (0)
#define ARRAY_SIZE(a) (sizeof(a) / sizeof((a)[0]))

#if defined(__ANDROID__) || defined(__APPLE__)
#define DEPTH_STORE DROP
#else
#define DEPTH_STORE DROP
#endif

VkResult scene_pass(VkDevice device, VkFormat format, VkRenderPass *pass) {
    VkAttachmentDescription attachments[] = {
        {
            .format = format,
            .samples = SCENE_SAMPLES,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = KEEP, /* expect: MSAA201 */
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
        {
            .format = format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = KEEP,
            .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        },
        {
            .format = VK_FORMAT_D32_SFLOAT,
            .samples = SCENE_SAMPLES,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = DEPTH_STORE,
            .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        },
    };
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth = {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
        .pResolveAttachments = &resolve,
        .pDepthStencilAttachment = &depth,
    };
    VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = ARRAY_SIZE(attachments),
        .pAttachments = attachments,
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    VK_CHECK(vkCreateRenderPass(device, &info, NULL, pass));
    return VK_SUCCESS;
}

VkResult mirror_pass(VkDevice device, VkFormat format, VkRenderPass *pass) {
    VkAttachmentDescription attachments[] = {
        {
            .format = format,
#if MSAA_SAMPLES > 1
            .samples = SAMPLE_BIT,
            .storeOp = DROP,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
#else
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .storeOp = KEEP,
            .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
#endif
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        },
#if MSAA_SAMPLES > 1
        {
            .format = format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = KEEP,
            .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        },
#endif
    };
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
#if MSAA_SAMPLES > 1
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
#endif
    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
#if MSAA_SAMPLES > 1
        .pResolveAttachments = &resolve,
#endif
    };
    VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = ARRAY_SIZE(attachments),
        .pAttachments = attachments,
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    VK_CHECK(vkCreateRenderPass(device, &info, NULL, pass));
    return VK_SUCCESS;
}
