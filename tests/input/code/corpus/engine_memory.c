// Structures of the program in memory that is allocated, handed on by pointer, and copied. The second pass is right.
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

typedef struct {
    uint32_t count;
    VkAttachmentDescription *descriptions;
} pass_t;

static VkDevice device;

static void describe(pass_t *pass, VkAttachmentStoreOp store) {
    pass->count = 2;
    pass->descriptions = calloc(pass->count, sizeof(VkAttachmentDescription));
    pass->descriptions[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    pass->descriptions[0].samples = VK_SAMPLE_COUNT_4_BIT;
    pass->descriptions[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    pass->descriptions[0].storeOp = store;
    pass->descriptions[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    pass->descriptions[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    memcpy(&pass->descriptions[1], &pass->descriptions[0], sizeof(VkAttachmentDescription));
    pass->descriptions[1].samples = VK_SAMPLE_COUNT_1_BIT;
    pass->descriptions[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    pass->descriptions[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
}

static VkRenderPass create(const pass_t *pass) {
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {0};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = pass->count;
    info.pAttachments = pass->descriptions;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass result = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, NULL, &result);
    return result;
}

VkRenderPass scene(void) {
    pass_t pass;
    describe(&pass, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
    return create(&pass);
}

VkRenderPass overlay(void) {
    pass_t pass;
    describe(&pass, VK_ATTACHMENT_STORE_OP_DONT_CARE);
    return create(&pass);
}
