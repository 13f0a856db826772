// Operations come from tables that the caller's enumerators index, so they are the caller's. One pass is the library's own, and is wrong.
#include <string.h>
#include <vulkan/vulkan.h>

#include "gpu.h"

#define MAX_TARGETS 4

struct Gpu {
    VkDevice device;
    PFN_vkCreateRenderPass createRenderPass;
};

static const VkAttachmentLoadOp loadOps[] = {VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE};

static const VkAttachmentStoreOp storeOps[] = {
    [GPU_STORE_KEEP] = VK_ATTACHMENT_STORE_OP_STORE,
    [GPU_STORE_ANY] = VK_ATTACHMENT_STORE_OP_DONT_CARE,
    [GPU_STORE_RESOLVE] = VK_ATTACHMENT_STORE_OP_DONT_CARE,
    [GPU_STORE_RESOLVE_AND_KEEP] = VK_ATTACHMENT_STORE_OP_STORE,
};

static const VkSampleCountFlagBits sampleCounts[] = {
    VK_SAMPLE_COUNT_1_BIT,
    VK_SAMPLE_COUNT_2_BIT,
    VK_SAMPLE_COUNT_4_BIT,
    VK_SAMPLE_COUNT_8_BIT,
};

static VkRenderPass makePass(Gpu *gpu, const GpuTarget *targets, uint32_t count) {
    VkAttachmentDescription descriptions[2 * MAX_TARGETS];
    VkAttachmentReference colors[MAX_TARGETS], resolves[MAX_TARGETS];
    uint32_t described = 0, resolved = 0;
    memset(descriptions, 0, sizeof(descriptions));
    for (uint32_t i = 0; i < count; i += 1) {
        descriptions[described].format = (VkFormat)targets[i].format;
        descriptions[described].samples = sampleCounts[targets[i].samples];
        descriptions[described].loadOp = loadOps[targets[i].load];
        descriptions[described].storeOp = storeOps[targets[i].store];
        descriptions[described].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        descriptions[described].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        colors[i].attachment = described;
        colors[i].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        described += 1;
        if (targets[i].store == GPU_STORE_RESOLVE || targets[i].store == GPU_STORE_RESOLVE_AND_KEEP) {
            descriptions[described].format = (VkFormat)targets[i].format;
            descriptions[described].samples = VK_SAMPLE_COUNT_1_BIT;
            descriptions[described].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
            descriptions[described].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            resolves[i].attachment = described;
            resolves[i].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            described += 1;
            resolved += 1;
        } else {
            resolves[i].attachment = VK_ATTACHMENT_UNUSED;
        }
    }
    VkSubpassDescription subpass = {0};
    subpass.colorAttachmentCount = count;
    subpass.pColorAttachments = colors;
    if (resolved > 0)
        subpass.pResolveAttachments = resolves;
    VkRenderPassCreateInfo info = {0};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = described;
    info.pAttachments = descriptions;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    gpu->createRenderPass(gpu->device, &info, NULL, &pass);
    return pass;
}

void *GpuMakePass(Gpu *gpu, const GpuTarget *targets, uint32_t count) {
    return (void *)makePass(gpu, targets, count);
}

// Only for pipelines, which need a pass of the same formats and counts; never begun.
void *GpuMakeCompatiblePass(Gpu *gpu, uint32_t format, GpuSamples samples) {
    VkAttachmentDescription color = {0};
    color.format = (VkFormat)format;
    color.samples = sampleCounts[samples];
    color.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {.colorAttachmentCount = 1, .pColorAttachments = &reference};
    VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                   .attachmentCount = 1,
                                   .pAttachments = &color,
                                   .subpassCount = 1,
                                   .pSubpasses = &subpass};
    VkRenderPass pass = VK_NULL_HANDLE;
    gpu->createRenderPass(gpu->device, &info, NULL, &pass);
    return (void *)pass;
}

void *GpuMakeOverlayPass(Gpu *gpu, uint32_t format) {
    VkAttachmentDescription descriptions[2] = {0};
    descriptions[0].format = (VkFormat)format;
    descriptions[0].samples = sampleCounts[GPU_SAMPLES_4];
    descriptions[0].loadOp = loadOps[GPU_LOAD_CLEAR];
    descriptions[0].storeOp = storeOps[GPU_STORE_RESOLVE_AND_KEEP];  // expect: MSAA201
    descriptions[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    descriptions[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    descriptions[1].format = (VkFormat)format;
    descriptions[1].samples = sampleCounts[GPU_SAMPLES_1];
    descriptions[1].loadOp = loadOps[GPU_LOAD_ANY];
    descriptions[1].storeOp = storeOps[GPU_STORE_KEEP];
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {.colorAttachmentCount = 1, .pColorAttachments = &color, .pResolveAttachments = &target};
    VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                   .attachmentCount = 2,
                                   .pAttachments = descriptions,
                                   .subpassCount = 1,
                                   .pSubpasses = &subpass};
    VkRenderPass pass = VK_NULL_HANDLE;
    gpu->createRenderPass(gpu->device, &info, NULL, &pass);
    return (void *)pass;
}
