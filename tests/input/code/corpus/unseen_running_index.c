/* Attachments appended with a running index, as emulators do; views too. The depth is stored for nobody. */
#include <stdbool.h>
#include <vulkan/vulkan.h>

typedef struct {
    VkDevice device;
    VkExtent2D size;
    VkImage color, depth;
    VkImageView color_view, depth_view, output_view;
    VkRenderPass pass;
    VkFramebuffer framebuffer;
} Canvas;

static void create_images(Canvas *c) {
    VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = VK_FORMAT_R8G8B8A8_SRGB,
        .extent = {c->size.width, c->size.height, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_4_BIT,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
    };
    vkCreateImage(c->device, &info, NULL, &c->color);
    info.format = VK_FORMAT_D32_SFLOAT;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT; /* expect: MSAA401 */
    vkCreateImage(c->device, &info, NULL, &c->depth);

    VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = c->color,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = VK_FORMAT_R8G8B8A8_SRGB,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
    };
    vkCreateImageView(c->device, &view, NULL, &c->color_view);
    view.image = c->depth;
    view.format = VK_FORMAT_D32_SFLOAT;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    vkCreateImageView(c->device, &view, NULL, &c->depth_view);
}

static void create_pass(Canvas *c) {
    VkAttachmentDescription attachments[4];
    VkAttachmentReference color_ref, resolve_ref, depth_ref;
    uint32_t count = 0;

    color_ref = (VkAttachmentReference){count, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    attachments[count++] = (VkAttachmentDescription){
        .format = VK_FORMAT_R8G8B8A8_SRGB,
        .samples = VK_SAMPLE_COUNT_4_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    };
    resolve_ref = (VkAttachmentReference){count, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    attachments[count++] = (VkAttachmentDescription){
        .format = VK_FORMAT_R8G8B8A8_SRGB,
        .samples = VK_SAMPLE_COUNT_1_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
    };
    depth_ref.attachment = count;
    depth_ref.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[count++] = (VkAttachmentDescription){
        .format = VK_FORMAT_D32_SFLOAT,
        .samples = VK_SAMPLE_COUNT_4_BIT,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE, /* expect: MSAA203 */
        .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    };

    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = &color_ref,
        .pResolveAttachments = &resolve_ref,
        .pDepthStencilAttachment = &depth_ref,
    };
    VkRenderPassCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = count,
        .pAttachments = attachments,
        .subpassCount = 1,
        .pSubpasses = &subpass,
    };
    vkCreateRenderPass(c->device, &info, NULL, &c->pass);
}

static void create_framebuffer(Canvas *c) {
    VkImageView views[4];
    uint32_t count = 0;
    views[count++] = c->color_view;
    views[count++] = c->output_view;
    views[count++] = c->depth_view;
    VkFramebufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
        .renderPass = c->pass,
        .attachmentCount = count,
        .pAttachments = views,
        .width = c->size.width,
        .height = c->size.height,
        .layers = 1,
    };
    vkCreateFramebuffer(c->device, &info, NULL, &c->framebuffer);
}

bool canvas_start(Canvas *c) {
    create_images(c);
    create_pass(c);
    create_framebuffer(c);
    return c->framebuffer != VK_NULL_HANDLE;
}
