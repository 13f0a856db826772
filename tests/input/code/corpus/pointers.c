/* Functions that fill structures through pointers, arrays on the heap, an index that runs. */
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

typedef struct renderer {
    VkDevice device;
    VkFormat format;
    VkRenderPass pass;
    VkImage color;
    VkImage depth;
} renderer_t;

static void fill_attachment(VkAttachmentDescription *p, VkFormat format, VkSampleCountFlagBits samples) {
    p->flags = 0;
    p->format = format;
    p->samples = samples;
    p->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    p->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    p->stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    p->stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    p->initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    p->finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
}

static int create_pass(renderer_t *r) {
    VkAttachmentDescription *attachments = calloc(3, sizeof(*attachments));
    VkAttachmentReference refs[3];
    uint32_t n = 0;
    if (!attachments) return -1;

    fill_attachment(&attachments[n], r->format, VK_SAMPLE_COUNT_4_BIT);
    refs[n].attachment = n;
    refs[n].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    n++;

    fill_attachment(attachments + n, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT);
    attachments[n].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    refs[n].attachment = n;
    refs[n].layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    n++;

    fill_attachment(&attachments[n], r->format, VK_SAMPLE_COUNT_1_BIT);
    attachments[n].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[n].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[n].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    refs[n].attachment = n;
    refs[n].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    n++;

    VkSubpassDescription subpass = {0};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &refs[0];
    subpass.pDepthStencilAttachment = &refs[1];
    subpass.pResolveAttachments = &refs[2];
    VkRenderPassCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = n;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkResult result = vkCreateRenderPass(r->device, &info, NULL, &r->pass);
    free(attachments);
    return result == VK_SUCCESS ? 0 : -1;
}

static void fill_image(VkImageCreateInfo *info, VkFormat format, uint32_t w, uint32_t h) {
    memset(info, 0, sizeof(VkImageCreateInfo));
    info->sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info->imageType = VK_IMAGE_TYPE_2D;
    info->format = format;
    info->extent.width = w;
    info->extent.height = h;
    info->extent.depth = 1;
    info->mipLevels = 1;
    info->arrayLayers = 1;
    info->samples = VK_SAMPLE_COUNT_1_BIT;
}

static int create_images(renderer_t *r, uint32_t w, uint32_t h) {
    VkImageCreateInfo info, *p = &info;
    fill_image(p, r->format, w, h);
    p->samples = VK_SAMPLE_COUNT_4_BIT;
    p->usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT; /* expect: MSAA404 */
    if (vkCreateImage(r->device, p, NULL, &r->color) != VK_SUCCESS) return -1;

    fill_image(p, VK_FORMAT_D32_SFLOAT, w, h);
    p->samples = VK_SAMPLE_COUNT_4_BIT; /* may: MSAA106#mips */
    p->mipLevels = 2; /* expect: MSAA106#mips */
    p->usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    return vkCreateImage(r->device, p, NULL, &r->depth) == VK_SUCCESS ? 0 : -1;
}

int renderer_start(renderer_t *r, uint32_t w, uint32_t h) { return create_images(r, w, h) || create_pass(r); }
