// C11 at its densest: whole passes in one expression, arrays of compound literals, dynamic rendering with stencil.
#include <vulkan/vulkan.h>

#define FMT VK_FORMAT_R8G8B8A8_UNORM
#define COUNT(...) (sizeof((int[]){__VA_ARGS__}) / sizeof(int))

struct ctx {
    VkDevice dev;
    VkExtent2D size;
    VkRenderPass pass;
    VkImage msaa, zs;
    VkImageView msaa_view, zs_view, out_view;
};

VkResult ctx_pass(struct ctx *ctx) {
    return vkCreateRenderPass(ctx->dev, &(VkRenderPassCreateInfo){
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .attachmentCount = 2,
        .pAttachments = (VkAttachmentDescription[]){
            {
                .format = FMT,
                .samples = VK_SAMPLE_COUNT_4_BIT,
                .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,  // expect: MSAA210#load
                .storeOp = VK_ATTACHMENT_STORE_OP_STORE,  // may: MSAA201
                .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,  // may: MSAA210#load
                .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            },
            {
                .format = VK_FORMAT_R8G8B8A8_SRGB,  // expect: MSAA306#format
                .samples = VK_SAMPLE_COUNT_1_BIT,
                .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
            },
        },
        .subpassCount = 1,
        .pSubpasses = &(VkSubpassDescription){
            .colorAttachmentCount = 1,
            .pColorAttachments = &(VkAttachmentReference){0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
            .pResolveAttachments = (VkAttachmentReference[]){{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}},  // may: MSAA306#format
        },
    }, NULL, &ctx->pass);
}

void ctx_images(struct ctx *ctx) {
    const VkExtent3D extent = {ctx->size.width, ctx->size.height, 1};
    vkCreateImage(ctx->dev, &(VkImageCreateInfo){VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, NULL, 0, VK_IMAGE_TYPE_2D, FMT, extent, 1, 1,
                                                VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_TILING_OPTIMAL,
                                                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT},
                  NULL, &ctx->msaa);
    vkCreateImage(ctx->dev, &(VkImageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = VK_FORMAT_D32_SFLOAT_S8_UINT,
        .extent = extent,
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_4_BIT,
        .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
    }, NULL, &ctx->zs);
    VkImageView *views[] = {&ctx->msaa_view, &ctx->zs_view};
    const VkImage images[] = {ctx->msaa, ctx->zs};
    const VkFormat formats[] = {FMT, VK_FORMAT_D32_SFLOAT_S8_UINT};
    const VkImageAspectFlags aspects[] = {VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT};
    for (unsigned i = 0; i < COUNT(0, 1); i++)
        vkCreateImageView(ctx->dev, &(VkImageViewCreateInfo){
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = images[i],
            .viewType = VK_IMAGE_VIEW_TYPE_2D,
            .format = formats[i],
            .subresourceRange = {aspects[i], 0, 1, 0, 1},
        }, NULL, views[i]);
}

void ctx_draw(struct ctx *ctx, VkCommandBuffer cmd) {
    vkCmdBeginRendering(cmd, &(VkRenderingInfo){
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = {{0, 0}, ctx->size},
        .layerCount = 1,
        .colorAttachmentCount = 1,
        .pColorAttachments = (VkRenderingAttachmentInfo[]){{
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = ctx->msaa_view,
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT,
            .resolveImageView = ctx->out_view,
            .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        }},
        .pDepthAttachment = &(VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = ctx->zs_view,
            .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
        },
        .pStencilAttachment = &(VkRenderingAttachmentInfo){
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = ctx->zs_view,
            .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,  // may: MSAA204, MSAA403
        },
    });
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);
}
