// Macros that other files define: one declares and clears, one clears, one counts.
#include <vulkan/vulkan.h>

#include "engine_macros.h"

VkRenderPass createScenePass(VkDevice device) {
    ENGINE_STRUCT_LIST(VkAttachmentDescription, attachments, 2);
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;

    VkAttachmentReference colors[] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkAttachmentReference targets[] = {{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass;
    Engine_Zero(&subpass, 0, sizeof(subpass));
    subpass.colorAttachmentCount = ENGINE_COUNT(colors);
    subpass.pColorAttachments = colors;
    subpass.pResolveAttachments = targets;

    ENGINE_STRUCT(VkRenderPassCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = ENGINE_COUNT(attachments);
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, NULL, &pass);
    return pass;
}
