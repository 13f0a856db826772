/* A game in C: structures are declared, cleared, and counted by macros and helpers of a header that is not here. */
#include "q_shared.h"

static struct {
    VkDevice device;
    VkRenderPass main_pass, overlay_pass, clean_pass;
    VkImage msaa_color;
    VkSampleCountFlagBits sample_count;
} vkr;

void R_CreateMainPass (VkFormat format) {
    ZEROED_STRUCT_ARRAY (VkAttachmentDescription, attachments, 2);
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

    ZEROED_STRUCT (VkAttachmentReference, color_ref);
    color_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    ZEROED_STRUCT (VkAttachmentReference, resolve_ref);
    resolve_ref.attachment = 1;
    resolve_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    ZEROED_STRUCT (VkSubpassDescription, subpass);
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_ref;
    subpass.pResolveAttachments = &resolve_ref;

    ZEROED_STRUCT (VkRenderPassCreateInfo, create_info);
    create_info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    create_info.attachmentCount = countof (attachments);
    create_info.pAttachments = attachments;
    create_info.subpassCount = 1;
    create_info.pSubpasses = &subpass;
    R_CHECK (VK_CALL (vkCreateRenderPass) (vkr.device, &create_info, NULL, &vkr.main_pass));
}

void R_CreateOverlayPass (VkFormat format) {
    VkAttachmentDescription attachments[2];
    VkAttachmentReference color_ref, resolve_ref;
    VkSubpassDescription subpass;
    VkRenderPassCreateInfo desc;

    Com_Memset (attachments, 0, sizeof (attachments));
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

    Q_zero (color_ref);
    color_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    ZeroBytes (&resolve_ref, sizeof (resolve_ref));
    resolve_ref.attachment = 1;
    resolve_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    Mem_Set (&subpass, 0, sizeof subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_ref;
    subpass.pResolveAttachments = &resolve_ref;

    Com_Memset (&desc, 0, sizeof (desc));
    desc.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    desc.attachmentCount = sizeof (attachments) / sizeof (attachments[0]);
    desc.pAttachments = attachments;
    desc.subpassCount = 1;
    desc.pSubpasses = &subpass;
    VK_CHECK (qvkCreateRenderPass (vkr.device, &desc, NULL, &vkr.overlay_pass));
}

/* The same without a mistake. What a hash reads is not cleared. */
uint64_t R_CreateCleanPass (VkFormat format) {
    ZEROED_STRUCT_ARRAY (VkAttachmentDescription, attachments, 2);
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    ZEROED_STRUCT (VkAttachmentReference, color_ref);
    color_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    ZEROED_STRUCT (VkAttachmentReference, resolve_ref);
    resolve_ref.attachment = 1;
    resolve_ref.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    ZEROED_STRUCT (VkSubpassDescription, subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color_ref;
    subpass.pResolveAttachments = &resolve_ref;
    ZEROED_STRUCT (VkRenderPassCreateInfo, create_info);
    create_info.attachmentCount = NUM_ELEMENTS_SIZE (attachments);
    create_info.pAttachments = attachments;
    create_info.subpassCount = 1;
    create_info.pSubpasses = &subpass;
    R_CHECK (VK_CALL (vkCreateRenderPass) (vkr.device, &create_info, NULL, &vkr.clean_pass));
    return hash_bytes (&create_info, 0, sizeof (create_info));
}
