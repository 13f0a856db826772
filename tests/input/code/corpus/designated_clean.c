// C11, designated initialisers and compound literals. Everything about it is as it should be.
#include <stdbool.h>
#include <stdio.h>
#include <vulkan/vulkan.h>

#define COLOR_FORMAT VK_FORMAT_B8G8R8A8_UNORM
#define DEPTH_FORMAT VK_FORMAT_D24_UNORM_S8_UINT

struct target {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
};

struct app {
    VkDevice device;
    VkExtent2D size;
    struct target color, depth;
    VkRenderPass pass;
    VkPipeline pipeline;
};

uint32_t memory_type(uint32_t bits, VkMemoryPropertyFlags wanted);

static bool target_init(struct app *app, struct target *target, VkFormat format, VkImageUsageFlags usage) {
    VkResult result = vkCreateImage(
        app->device,
        &(VkImageCreateInfo){
            .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = format,
            .extent = {app->size.width, app->size.height, 1},
            .mipLevels = 1,
            .arrayLayers = 1,
            .samples = VK_SAMPLE_COUNT_4_BIT,
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = usage | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
        },
        NULL, &target->image);
    if (result != VK_SUCCESS) return false;

    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(app->device, target->image, &needs);
    vkAllocateMemory(app->device,
                     &(VkMemoryAllocateInfo){
                         .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                         .allocationSize = needs.size,
                         .memoryTypeIndex = memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT),
                     },
                     NULL, &target->memory);
    return vkBindImageMemory(app->device, target->image, target->memory, 0) == VK_SUCCESS;
}

static bool pass_init(struct app *app) {
    const VkAttachmentDescription attachments[] = {
        {
            .format = COLOR_FORMAT,
            .samples = VK_SAMPLE_COUNT_4_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
        {
            .format = DEPTH_FORMAT,
            .samples = VK_SAMPLE_COUNT_4_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        },
        {
            .format = COLOR_FORMAT,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        },
    };
    const VkSubpassDescription subpass = {
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1,
        .pColorAttachments = &(VkAttachmentReference){0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        .pResolveAttachments = &(VkAttachmentReference){2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        .pDepthStencilAttachment = &(VkAttachmentReference){1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
    };
    const VkSubpassDependency entry = {
        .srcSubpass = VK_SUBPASS_EXTERNAL,
        .dstSubpass = 0,
        .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT,
        .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    };
    return vkCreateRenderPass(app->device,
                              &(VkRenderPassCreateInfo){
                                  .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                  .attachmentCount = sizeof(attachments) / sizeof(attachments[0]),
                                  .pAttachments = attachments,
                                  .subpassCount = 1,
                                  .pSubpasses = &subpass,
                                  .dependencyCount = 1,
                                  .pDependencies = &entry,
                              },
                              NULL, &app->pass) == VK_SUCCESS;
}

static bool pipeline_init(struct app *app, VkPipelineLayout layout) {
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pMultisampleState =
            &(VkPipelineMultisampleStateCreateInfo){
                .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT,
            },
        .layout = layout,
        .renderPass = app->pass,
    };
    return vkCreateGraphicsPipelines(app->device, NULL, 1, &info, NULL, &app->pipeline) == VK_SUCCESS;
}

int app_start(struct app *app, VkPipelineLayout layout) {
    if (!target_init(app, &app->color, COLOR_FORMAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) ||
        !target_init(app, &app->depth, DEPTH_FORMAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) || !pass_init(app) ||
        !pipeline_init(app, layout)) {
        fprintf(stderr, "no targets\n");
        return 1;
    }
    return 0;
}
