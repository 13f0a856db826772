// Two passes of the same structures: the second loads the samples that the first stored, and the resolve target as well.
#include "shared.h"

static void createImage(VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImage *image) {
    VkImageCreateInfo info;
    if (samples > VK_SAMPLE_COUNT_1_BIT && !(usage & VK_IMAGE_USAGE_SAMPLED_BIT))
        usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.pNext = NULL;
    info.flags = 0;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = renderer.color_format;
    info.extent.width = 640;
    info.extent.height = 480;
    info.extent.depth = 1;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = samples;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    vkCreateImage(renderer.device, &info, NULL, image);
}

void Passes_Create(void) {
    VkAttachmentDescription attachments[2];
    VkAttachmentReference color, target;
    VkSubpassDescription subpass;
    VkRenderPassCreateInfo info;

    if (renderer.multisampled)
        createImage(renderer_samples, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, &renderer.scene_image);

    attachments[0].flags = 0;
    attachments[0].format = renderer.color_format;
    attachments[0].samples = VK_SAMPLE_COUNT_1_BIT;
#ifdef CLEAR_TARGETS
    attachments[0].loadOp = renderer.multisampled ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : VK_ATTACHMENT_LOAD_OP_CLEAR;
#else
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
#endif
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].initialLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

    color.attachment = 0;
    color.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    Mem_Set(&subpass, 0, sizeof(subpass));
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;

    Mem_Set(&info, 0, sizeof(info));
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;

    if (renderer.multisampled) {
        attachments[1].flags = 0;
        attachments[1].format = renderer.color_format;
        attachments[1].samples = renderer_samples;
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA201, MSAA403
        attachments[1].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[1].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[1].initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachments[1].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        info.attachmentCount = 2;
        color.attachment = 1;
        target.attachment = 0;
        target.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        subpass.pResolveAttachments = &target;
    }
    vkCreateRenderPass(renderer.device, &info, NULL, &renderer.scene);

    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA205
    if (renderer.multisampled) {
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA202  // may: MSAA403
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    vkCreateRenderPass(renderer.device, &info, NULL, &renderer.post);
}
