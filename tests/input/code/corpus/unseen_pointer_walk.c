/* Pointers that are declared first and walk over an array later. Nothing is wrong with what they write. */
#include <string.h>
#include <vulkan/vulkan.h>

static VkRenderPass make_pass(VkDevice dev, const VkAttachmentDescription *att, uint32_t count, const VkAttachmentReference *refs)
{
    VkSubpassDescription sub;
    VkRenderPassCreateInfo rp;
    VkRenderPass pass;

    memset(&sub, 0, sizeof(sub));
    sub.colorAttachmentCount = 1;
    sub.pColorAttachments = &refs[0];
    sub.pResolveAttachments = &refs[1];
    sub.pDepthStencilAttachment = &refs[2];
    memset(&rp, 0, sizeof(rp));
    rp.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    rp.attachmentCount = count;
    rp.pAttachments = att;
    rp.subpassCount = 1;
    rp.pSubpasses = &sub;
    if (vkCreateRenderPass(dev, &rp, NULL, &pass) != VK_SUCCESS)
        return VK_NULL_HANDLE;
    return pass;
}

VkRenderPass walk(VkDevice dev, VkFormat format)
{
    VkAttachmentDescription att[3];
    VkAttachmentReference refs[3];
    VkAttachmentDescription *a;
    VkAttachmentReference *r, *end;

    memset(att, 0, sizeof(att));
    a = att;
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_4_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    a++;
    *a = *(a - 1);
    a->samples = VK_SAMPLE_COUNT_1_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    a->finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    a = &att[2];
    a->format = VK_FORMAT_D32_SFLOAT;
    a->samples = att[0].samples;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

    for (r = refs, end = refs + 3; r != end; r++) {
        r->attachment = (uint32_t)(r - refs);
        r->layout = r == refs + 2 ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    return make_pass(dev, att, 3, refs);
}

VkRenderPass by_pointers(VkDevice dev, VkFormat format)
{
    VkAttachmentDescription att[3];
    VkAttachmentReference refs[3] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                     {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                     {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL}};
    VkAttachmentDescription *color = NULL, *resolve = NULL, *depth = NULL, **each;
    VkAttachmentDescription **all[] = {&color, &resolve, &depth};
    int i;

    memset(att, 0, sizeof(att));
    for (i = 0; i < 3; i++)
        *all[i] = &att[i];
    each = all[0];
    (*each)->samples = VK_SAMPLE_COUNT_4_BIT;
    color->format = resolve->format = format;
    color->loadOp = depth->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color->storeOp = depth->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color->finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    resolve->samples = VK_SAMPLE_COUNT_1_BIT;
    resolve->loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    resolve->finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    depth->format = VK_FORMAT_D32_SFLOAT;
    depth->samples = VK_SAMPLE_COUNT_4_BIT;
    depth->finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    return make_pass(dev, att, 3, refs);
}

struct slots {
    VkAttachmentDescription *next;
    VkAttachmentDescription storage[3];
};

static VkAttachmentDescription *take(struct slots *slots)
{
    return slots->next++;
}

VkRenderPass by_allocator(VkDevice dev, VkFormat format)
{
    struct slots slots;
    VkAttachmentDescription *a;
    VkAttachmentReference refs[3] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                     {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                     {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED}};

    memset(&slots, 0, sizeof slots);
    slots.next = slots.storage;
    a = take(&slots);
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_4_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    a = take(&slots);
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_1_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    return make_pass(dev, slots.storage, 2, refs);
}

int simple(VkDevice dev, VkFormat format, VkRenderPass *pass)
{
    VkAttachmentDescription att[2];
    VkAttachmentDescription *a;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription sub = {0};
    VkRenderPassCreateInfo rp = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};

    memset(att, 0, sizeof(att));
    a = &att[0];
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_4_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a->storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    a = &att[1];
    a->format = format;
    a->samples = VK_SAMPLE_COUNT_1_BIT;
    a->loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a->finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    sub.colorAttachmentCount = 1;
    sub.pColorAttachments = &color;
    sub.pResolveAttachments = &resolve;
    rp.attachmentCount = 2;
    rp.pAttachments = att;
    rp.subpassCount = 1;
    rp.pSubpasses = &sub;
    return vkCreateRenderPass(dev, &rp, NULL, pass) == VK_SUCCESS;
}
