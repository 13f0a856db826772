/* Written long ago, or made from a capture by a tool: tags of structures, declarations first, numbers in place of names. */
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

struct VkAttachmentDescription g_attachments[3];
struct VkAttachmentReference g_color, g_depth, g_resolve;
static VkRenderPass g_pass;
static VkImage g_image, g_depth_image;

int init_pass(VkDevice dev)
{
    struct VkSubpassDescription sub;
    struct VkRenderPassCreateInfo rp;
    struct VkAttachmentDescription *a;
    VkResult err;

    a = &g_attachments[0];
    a->flags = 0;
    a->format = 37;
    a->samples = 4;
    a->loadOp = 1;
    a->storeOp = 0; /* expect: MSAA201 */
    a->stencilLoadOp = 2;
    a->stencilStoreOp = 1;
    a->initialLayout = 0;
    a->finalLayout = 2;

    a = &g_attachments[1];
    memset(a, 0, sizeof *a);
    a->format = 126;
    a->samples = 0x4;
    a->loadOp = 1;
    a->storeOp = 1;
    a->finalLayout = 3;

    a++;
    *a = g_attachments[0];
    a->samples = 1;
    a->loadOp = 2;
    a->finalLayout = 1000001002;

    g_color.attachment = 0;
    g_color.layout = 2;
    g_depth.attachment = 1;
    g_depth.layout = 3;
    g_resolve.attachment = 2;
    g_resolve.layout = 2;

    memset(&sub, 0, sizeof(sub));
    sub.pipelineBindPoint = 0;
    sub.colorAttachmentCount = 1;
    sub.pColorAttachments = &g_color;
    sub.pResolveAttachments = &g_resolve;
    sub.pDepthStencilAttachment = &g_depth;

    memset(&rp, 0, sizeof(rp));
    rp.sType = 38;
    rp.attachmentCount = 3;
    rp.pAttachments = g_attachments;
    rp.subpassCount = 1;
    rp.pSubpasses = &sub;
    err = vkCreateRenderPass(dev, &rp, NULL, &g_pass);
    return err == 0 ? 0 : -1;
}

int init_images(VkDevice dev, unsigned w, unsigned h)
{
    struct VkImageCreateInfo *ci = (struct VkImageCreateInfo *)calloc(1, sizeof(struct VkImageCreateInfo));
    VkResult err;

    if (!ci)
        return -1;
    ci->sType = 14;
    ci->imageType = 1;
    ci->format = 37;
    ci->extent.width = w;
    ci->extent.height = h;
    ci->extent.depth = 1;
    ci->mipLevels = 1;
    ci->arrayLayers = 1;
    ci->samples = 1 << 2;
    ci->usage = 0x10 | 0x40;
    err = vkCreateImage(dev, ci, NULL, &g_image);
    ci->format = 126;
    ci->usage = 0x20 | 0x40 | 0x4; /* expect: MSAA404 */
    err |= vkCreateImage(dev, ci, NULL, &g_depth_image);
    free(ci);
    return err;
}

int main(void)
{
    VkDevice dev = NULL;
    return init_pass(dev) || init_images(dev, 640, 480);
}
