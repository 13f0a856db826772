// A game whose render passes depend on the settings of other objects: a function, a state, a console variable. With multisampling on, two of
// its pictures are lost: they are drawn with several samples, which are neither resolved nor stored.
#include <vulkan/vulkan.h>

bool VK_UseMSAA();
VkSampleCountFlagBits VK_SampleCount();

struct cvar_t {
    const char* name;
    float value;
};
extern cvar_t* r_antialiasing;

enum AntiAliasing { AA_OFF, AA_2X, AA_4X };
struct Settings {
    AntiAliasing antiAliasing;
};
extern Settings settings;

struct RendererState {
    VkDevice device;
    VkFormat format;
    VkSampleCountFlagBits samples;
};
extern RendererState vk_state;

void CreateWorldPass(VkRenderPass* pass) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = vk_state.format;
    attachments[0].samples = VK_UseMSAA() ? vk_state.samples : VK_SAMPLE_COUNT_1_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_UseMSAA() ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA207
    attachments[0].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = VK_UseMSAA() ? vk_state.samples : VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;

    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(vk_state.device, &info, nullptr, pass);
}

void CreateSkyPass(VkRenderPass* pass) {
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    if (settings.antiAliasing != AA_OFF) {
        samples = VK_SampleCount();
    }
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = vk_state.format;
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].format = vk_state.format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;

    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    if (settings.antiAliasing != AA_OFF)
        subpass.pResolveAttachments = &resolve;

    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = settings.antiAliasing != AA_OFF ? 2 : 1;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(vk_state.device, &info, nullptr, pass);
}

void CreateMenuPass(VkRenderPass* pass) {
    const bool multisampled = r_antialiasing->value > 0.0f;
    VkAttachmentDescription attachment = {};
    attachment.format = vk_state.format;
    attachment.samples = multisampled ? vk_state.samples : VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = multisampled ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA207

    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;

    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(vk_state.device, &info, nullptr, pass);
}
