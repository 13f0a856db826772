// The world's pass resolves into an image that the next pass loads, but does not store it.
#include "ref.h"

VkDevice ref_device;
VkFormat ref_format;
refPass_t ref_passes[PASS_COUNT] = {
    {.pass = VK_NULL_HANDLE, .colorLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, .sampleCount = VK_SAMPLE_COUNT_1_BIT},
    {.pass = VK_NULL_HANDLE, .colorLoadOp = VK_ATTACHMENT_LOAD_OP_LOAD, .sampleCount = VK_SAMPLE_COUNT_1_BIT},
};

static refTexture_t worldColor = REF_TEXTURE_INIT;
static refTexture_t worldDepth = REF_TEXTURE_INIT;
static refTexture_t worldSamples = REF_TEXTURE_INIT;

static VkSampleCountFlagBits SampleCount(int mode) {
    static VkSampleCountFlagBits modes[] = {VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_2_BIT, VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_8_BIT};
    return modes[mode];
}

static void CreateBuffers(void) {
    Ref_CreateDepthBuffer(ref_passes[PASS_WORLD].sampleCount, &worldDepth);  // may: MSAA401#depth
    Ref_CreateColorBuffer(VK_SAMPLE_COUNT_1_BIT, &worldColor, VK_IMAGE_USAGE_SAMPLED_BIT);
    if (ref_passes[PASS_WORLD].sampleCount > 1)
        Ref_CreateColorBuffer(ref_passes[PASS_WORLD].sampleCount, &worldSamples, 0);  // may: MSAA401#color
}

static void CreatePasses(void) {
    VkBool32 multisampled = ref_passes[PASS_WORLD].sampleCount != VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentDescription world[] = {
        {
            .format = ref_format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = multisampled ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : ref_passes[PASS_WORLD].colorLoadOp,
            .storeOp = multisampled ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA206
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        },
        {
            .format = VK_FORMAT_D32_SFLOAT,
            .samples = ref_passes[PASS_WORLD].sampleCount,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        },
        {
            .format = ref_format,
            .samples = ref_passes[PASS_WORLD].sampleCount,
            .loadOp = multisampled ? ref_passes[PASS_WORLD].colorLoadOp : VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
    };
    VkAttachmentReference references[] = {
        {.attachment = multisampled ? 2 : 0, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {.attachment = 1, .layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
        {.attachment = 0, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    };
    VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1,
        .pColorAttachments = &references[0],
        .pResolveAttachments = multisampled ? &references[2] : NULL,
        .pDepthStencilAttachment = &references[1],
    };
    VkRenderPassCreateInfo infos[] = {
        {
            .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
            .attachmentCount = multisampled ? 3 : 2,
            .pAttachments = world,
            .subpassCount = 1,
            .pSubpasses = &subpass,
        },
    };
    vkCreateRenderPass(ref_device, &infos[PASS_WORLD], NULL, &ref_passes[PASS_WORLD].pass);
}

static void CreateFramebuffers(VkFramebuffer *framebuffer) {
    VkImageView views[] = {worldColor.view, worldDepth.view, worldSamples.view};
    VkFramebufferCreateInfo infos[] = {
        {
            .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
            .renderPass = ref_passes[PASS_WORLD].pass,
            .attachmentCount = (ref_passes[PASS_WORLD].sampleCount != VK_SAMPLE_COUNT_1_BIT) ? 3 : 2,
            .width = 640,
            .height = 480,
            .layers = 1,
        },
    };
    infos[PASS_WORLD].pAttachments = views;
    vkCreateFramebuffer(ref_device, &infos[PASS_WORLD], NULL, framebuffer);
}

void Ref_Init(int mode, VkSampleCountFlags supported, VkFramebuffer *framebuffer) {
    VkSampleCountFlagBits count = SampleCount(mode);
    if (!(supported & count))
        count = VK_SAMPLE_COUNT_1_BIT;
    ref_passes[PASS_WORLD].sampleCount = count;
    REF_CLEAR_TEXTURE(worldSamples);
    CreatePasses();
    CreateBuffers();
    CreateFramebuffers(framebuffer);
}
