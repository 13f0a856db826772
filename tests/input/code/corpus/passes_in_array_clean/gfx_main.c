/* A game: its passes are in an array, indexed by an enumerator, and so are the structures that create them. */
#include "gfx_local.h"

VkDevice gfx_device;
VkExtent2D gfx_extent;
VkFormat gfx_format;
VkPhysicalDeviceLimits gfx_limits;
pass_t gfx_passes[PASS_MAX] = {
    {.handle = VK_NULL_HANDLE, .colorLoad = VK_ATTACHMENT_LOAD_OP_CLEAR, .count = VK_SAMPLE_COUNT_1_BIT},
    {.handle = VK_NULL_HANDLE, .colorLoad = VK_ATTACHMENT_LOAD_OP_LOAD, .count = VK_SAMPLE_COUNT_1_BIT},
};

static setting_t *gfx_clear, *gfx_samples;
static target_t sceneColor, sceneColorMs, sceneDepth, hudColor;
static VkFramebuffer framebuffers[PASS_MAX];
static const VkSampleCountFlagBits modes[] = {
    VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_2_BIT, VK_SAMPLE_COUNT_4_BIT, VK_SAMPLE_COUNT_8_BIT};

static VkSampleCountFlagBits count_of_setting(int setting)
{
    int mode = 0;

    while (setting > 1) {
        setting >>= 1;
        mode++;
    }
    return modes[mode];
}

static void create_passes(void)
{
    int i;
    const VkBool32 several = gfx_passes[PASS_SCENE].count != VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentDescription scene[] = {
        {.format = gfx_format, .samples = VK_SAMPLE_COUNT_1_BIT,
         .loadOp = several ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : gfx_passes[PASS_SCENE].colorLoad,
         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
         .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE, .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
         .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
        {.format = VK_FORMAT_D32_SFLOAT, .samples = gfx_passes[PASS_SCENE].count,
         .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
         .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE, .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
         .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
        {.format = gfx_format, .samples = gfx_passes[PASS_SCENE].count,
         .loadOp = several ? gfx_passes[PASS_SCENE].colorLoad : VK_ATTACHMENT_LOAD_OP_DONT_CARE,
         .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
         .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE, .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
         .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    };
    VkAttachmentReference sceneRefs[] = {
        {several ? 2 : 0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
        {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
    };
    VkSubpassDescription sceneSubpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1,
        .pColorAttachments = &sceneRefs[0],
        .pResolveAttachments = several ? &sceneRefs[2] : NULL,
        .pDepthStencilAttachment = &sceneRefs[1],
    };
    VkAttachmentDescription hud[] = {
        {.format = gfx_format, .samples = VK_SAMPLE_COUNT_1_BIT, .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
         .storeOp = VK_ATTACHMENT_STORE_OP_STORE, .initialLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
         .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
    };
    VkAttachmentReference hudRef = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription hudSubpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS, .colorAttachmentCount = 1, .pColorAttachments = &hudRef};
    VkRenderPassCreateInfo infos[] = {
        {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, .attachmentCount = several ? 3 : 2, .pAttachments = scene,
         .subpassCount = 1, .pSubpasses = &sceneSubpass},
        {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, .attachmentCount = 1, .pAttachments = hud,
         .subpassCount = 1, .pSubpasses = &hudSubpass},
    };

    for (i = 0; i < PASS_MAX; i++) {
        if (vkCreateRenderPass(gfx_device, &infos[i], NULL, &gfx_passes[i].handle) != VK_SUCCESS)
            report("pass %d", i);
    }
}

static void create_targets(void)
{
    target_depth(gfx_passes[PASS_SCENE].count, &sceneDepth);
    target_color(VK_SAMPLE_COUNT_1_BIT, &sceneColor, VK_IMAGE_USAGE_SAMPLED_BIT);
    target_color(VK_SAMPLE_COUNT_1_BIT, &hudColor, VK_IMAGE_USAGE_SAMPLED_BIT);
    if (gfx_passes[PASS_SCENE].count > 1)
        target_color(gfx_passes[PASS_SCENE].count, &sceneColorMs, VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT);
}

static void create_framebuffers(void)
{
    int i;
    VkImageView sceneViews[] = {sceneColor.view, sceneDepth.view, sceneColorMs.view};
    VkImageView hudViews[] = {sceneColor.view};
    VkFramebufferCreateInfo infos[] = {
        {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, .renderPass = gfx_passes[PASS_SCENE].handle,
         .attachmentCount = gfx_passes[PASS_SCENE].count != VK_SAMPLE_COUNT_1_BIT ? 3 : 2, .layers = 1},
        {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, .renderPass = gfx_passes[PASS_HUD].handle,
         .attachmentCount = 1, .layers = 1},
    };

    infos[PASS_SCENE].pAttachments = sceneViews;
    infos[PASS_HUD].pAttachments = hudViews;
    for (i = 0; i < PASS_MAX; i++)
        vkCreateFramebuffer(gfx_device, &infos[i], NULL, &framebuffers[i]);
}

void gfx_shutdown(void)
{
    int i;

    for (i = 0; i < PASS_MAX; i++) {
        vkDestroyRenderPass(gfx_device, gfx_passes[i].handle, NULL);
        gfx_passes[i].handle = VK_NULL_HANDLE;
    }
    target_free(&sceneColor);
    target_free(&sceneColorMs);
    target_free(&sceneDepth);
    target_free(&hudColor);
}

int gfx_init(void *window)
{
    int i;
    VkSampleCountFlagBits count;

#ifdef USE_TOOLKIT
    if (!toolkit_open(window))
#else
    if (!window_open(window, NULL))
#endif
    {
        report("no window");
        return 0;
    }
    for (i = 0; i < PASS_MAX; ++i)
        gfx_passes[i].colorLoad = gfx_clear->value ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    count = count_of_setting((int)gfx_samples->value);
    if (!(gfx_limits.framebufferColorSampleCounts & gfx_limits.framebufferDepthSampleCounts & count)) {
        report("%d samples are not supported", count);
        count = VK_SAMPLE_COUNT_1_BIT;
    }
    gfx_passes[PASS_SCENE].count = count;
    create_passes();
    create_targets();
    create_framebuffers();
    return 1;
}
