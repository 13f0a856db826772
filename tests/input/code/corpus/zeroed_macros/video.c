// The images and the render pass of the scene. The pass resolves, and stores its samples as well; neither image is transient.
#include "shared.h"

static VkImage depth_image, color_image;
static VkRenderPass scene_pass;

void Vid_CreateDepth(void) {
    CLEARED(VkImageCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = video.depth_format;
    info.extent.width = 1280;
    info.extent.height = 720;
    info.extent.depth = 1;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = video.sample_count;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;  // may: MSAA401
    vkCreateImage(video.device, &info, NULL, &depth_image);
}

void Vid_CreateColor(void) {
    CLEARED(VkImageCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = video.color_format;
    info.extent.width = 1280;
    info.extent.height = 720;
    info.extent.depth = 1;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = video.sample_count;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;  // may: MSAA401
    vkCreateImage(video.device, &info, NULL, &color_image);
}

void Vid_CreateScenePass(void) {
    const int resolve = video.sample_count != VK_SAMPLE_COUNT_1_BIT;
    const uint32_t scene = resolve ? 2 : 0;

    CLEARED_LIST(VkAttachmentDescription, attachments, 3);
    attachments[0].format = video.color_format;
    attachments[0].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[0].loadOp = resolve ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = video.sample_count;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA203
    attachments[1].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    if (resolve) {
        attachments[scene].format = video.color_format;
        attachments[scene].samples = video.sample_count;
        attachments[scene].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[scene].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
        attachments[scene].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[scene].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }

    VkAttachmentReference colors[] = {{.attachment = scene, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkAttachmentReference depth = {.attachment = 1, .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {.attachment = 0, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    CLEARED_LIST(VkSubpassDescription, subpasses, 1);
    subpasses[0].colorAttachmentCount = LENGTH_OF(colors);
    subpasses[0].pColorAttachments = colors;
    subpasses[0].pDepthStencilAttachment = &depth;
    if (resolve)
        subpasses[0].pResolveAttachments = &target;

    CLEARED(VkRenderPassCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = resolve ? 3 : 2;
    info.pAttachments = attachments;
    info.subpassCount = LENGTH_OF(subpasses);
    info.pSubpasses = subpasses;
    vkCreateRenderPass(video.device, &info, NULL, &scene_pass);
}
