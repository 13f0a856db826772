/* The macros are in a header of the game. */
#include "common.h"

static VkDevice device;
static VkRenderPass render_pass;

R_API void R_InitRenderPass(VkFormat format) {
    VkAttachmentDescription attachments[2];
    memset(attachments, 0, sizeof(attachments));
#if R_LEGACY_PATH
    ATTACHMENT(0, 8, STORE);
#else
    ATTACHMENT(0, 4, STORE); /* expect: MSAA201 */
#endif
    ATTACHMENT(1, 1, STORE);

    ZEROED_STRUCT(VkAttachmentReference, color);
    color.layout = VK_IMAGE_LAYOUT_GENERAL;
    ZEROED_STRUCT(VkAttachmentReference, resolve);
    resolve.attachment = 1;
    resolve.layout = VK_IMAGE_LAYOUT_GENERAL;
    ZEROED_STRUCT(VkSubpassDescription, subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    ZEROED_STRUCT(VkRenderPassCreateInfo, info);
    info.attachmentCount = NUM(attachments);
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, NULL, &render_pass);
}
