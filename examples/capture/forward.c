/* A small forward renderer without a window, to capture: gears, their mirror image, and a glow, with four samples each, composited.

   It makes multisampling mistakes on purpose, each marked by a comment "Mistake N, rule, pass: ..."; `--fixed` renders the same picture
   without them, and `--mistake N` makes only that one. Each frame is one vkQueueSubmit. Requires Vulkan 1.3 and no extensions. */

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "device.h"
#include "shaders.h"

enum { WIDTH = 320, HEIGHT = 180, MISTAKES = 18, GEARS = 7 };
enum { SCENE_MS, SCENE_DEPTH, SCENE, MIRROR_MS, MIRROR_DEPTH_MS, MIRROR, MIRROR_DEPTH, GLOW_MS, GLOW_DEPTH, GLOW, PICTURE, IMAGES };
enum { OPAQUE_PASS, SCENE_PASS, MIRROR_PASS, COMPOSITE_PASS, PASSES };
enum { OPAQUE, GLASS, MIRRORED, GLOWING, COMPOSITE, PIPELINES };
enum { GEAR_VERTEX, GEAR_FRAGMENT, COMPOSITE_VERTEX, COMPOSITE_FRAGMENT, SHADERS };

/* Shorter names for Vulkan's. */
#define ONE VK_SAMPLE_COUNT_1_BIT
#define FOUR VK_SAMPLE_COUNT_4_BIT
#define CLEAR VK_ATTACHMENT_LOAD_OP_CLEAR
#define LOAD VK_ATTACHMENT_LOAD_OP_LOAD
#define FORGET VK_ATTACHMENT_LOAD_OP_DONT_CARE
#define STORE VK_ATTACHMENT_STORE_OP_STORE
#define DISCARD VK_ATTACHMENT_STORE_OP_DONT_CARE
#define UNDEFINED VK_IMAGE_LAYOUT_UNDEFINED
#define COLOR VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL
#define DEPTH VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
#define READ VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
#define FROM VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
#define TO VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL
#define OUTPUT VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT
#define SHADING VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT
#define TESTS (VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT)
#define TRANSFER VK_PIPELINE_STAGE_TRANSFER_BIT
#define COLOR_WRITE VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT
#define COLOR_USE (COLOR_WRITE | VK_ACCESS_COLOR_ATTACHMENT_READ_BIT)
#define DEPTH_WRITE VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT
#define DEPTH_USE (DEPTH_WRITE | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT)

typedef struct {
    const char *name;
    VkFormat format;
    VkSampleCountFlagBits samples;
    VkImageUsageFlags usage;
    uint32_t divisor; /* of the picture's size */
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
} Image;

/* The push constants of gear.vert. */
typedef struct {
    float color[4], middle[2], radius, angle, depth;
    int32_t teeth;
} Gear;

static bool made[MISTAKES + 1]; /* which mistakes to make */
static const char *picture;

static Image images[IMAGES];
static VkRenderPass passes[PASSES];
static VkFramebuffer framebuffers[PASSES];
static VkShaderModule shaders[SHADERS];
static VkSampler samplers[2];
static VkDescriptorSetLayout set_layout;
static VkDescriptorPool descriptors;
static VkDescriptorSet set;
static VkPipelineLayout gear_layout, composite_layout;
static VkPipeline pipelines[PIPELINES];

static VkExtent2D size_of(int image) {
    return (VkExtent2D){WIDTH / images[image].divisor, HEIGHT / images[image].divisor};
}

static VkImageAspectFlags aspects_of(int image) {
    if (!(images[image].usage & VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT))
        return VK_IMAGE_ASPECT_COLOR_BIT;
    return VK_IMAGE_ASPECT_DEPTH_BIT | (images[image].format == VK_FORMAT_D32_SFLOAT_S8_UINT ? VK_IMAGE_ASPECT_STENCIL_BIT : 0);
}

static void make_image(int number) {
    Image *image = &images[number];
    VkImageCreateInfo create = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, .imageType = VK_IMAGE_TYPE_2D, .format = image->format, .mipLevels = 1,
        .extent = {size_of(number).width, size_of(number).height, 1}, .arrayLayers = 1, .samples = image->samples, .usage = image->usage
    };
    CHECK(vkCreateImage(device, &create, NULL, &image->image));
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(device, image->image, &requirements);
    bool transient = image->usage & VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    image->memory = allocated(requirements, transient ? VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0);
    CHECK(vkBindImageMemory(device, image->image, image->memory, 0));
    VkImageViewCreateInfo view = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, .image = image->image, .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = image->format, .subresourceRange = {aspects_of(number), 0, 1, 0, 1}
    };
    CHECK(vkCreateImageView(device, &view, NULL, &image->view));
    NAMED(IMAGE, image->image, image->name);
    NAMED(IMAGE_VIEW, image->view, image->name);
}

static void make_images(void) {
    const VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, depth = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    const VkImageUsageFlags transient = VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, sampled = VK_IMAGE_USAGE_SAMPLED_BIT;
    const VkImageUsageFlags source = VK_IMAGE_USAGE_TRANSFER_SRC_BIT, target = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    const VkFormat rgba = VK_FORMAT_R8G8B8A8_UNORM, d32 = VK_FORMAT_D32_SFLOAT, d32s8 = VK_FORMAT_D32_SFLOAT_S8_UINT;

    /* Mistake 1, multisampled-image-not-transient, mirror: depth is used in one pass only, but its samples have memory. */
    VkImageUsageFlags once = made[1] ? 0 : transient;
    /* Mistake 5, multisampled-float-blending, scene: glass is blended into half floats, although nothing is brighter than 1. */
    VkFormat bright = made[5] ? VK_FORMAT_R16G16B16A16_SFLOAT : rgba;
    const Image wanted[IMAGES] = {
        [SCENE_MS] = {"scene color 4x", bright, FOUR, color | transient, 1, 0, 0, 0},
        [SCENE_DEPTH] = {"scene depth 4x", d32, FOUR, depth | transient, 1, 0, 0, 0},
        [SCENE] = {"scene color", bright, ONE, color | sampled, 1, 0, 0, 0},
        [MIRROR_MS] = {"mirror color 4x", rgba, FOUR, color | transient, 2, 0, 0, 0},
        [MIRROR_DEPTH_MS] = {"mirror depth-stencil 4x", d32s8, FOUR, depth | once, 2, 0, 0, 0},
        [MIRROR] = {"mirror color", rgba, ONE, color | sampled, 2, 0, 0, 0},
        [MIRROR_DEPTH] = {"mirror depth", d32, ONE, depth | sampled, 2, 0, 0, 0},
        [GLOW_MS] = {"glow color 4x", rgba, FOUR, color | (made[12] ? source : transient), 2, 0, 0, 0},
        [GLOW_DEPTH] = {"glow depth 4x", d32, FOUR, depth | transient, 2, 0, 0, 0},
        [GLOW] = {"glow color", rgba, ONE, color | sampled | (made[12] ? target : 0), 2, 0, 0, 0},
        [PICTURE] = {"picture", rgba, ONE, color | (picture ? source : 0), 1, 0, 0, 0},
    };
    memcpy(images, wanted, sizeof images);
    for (int i = 0; i < IMAGES; i++)
        make_image(i);
}

static void make_framebuffer(int pass, const char *name, uint32_t count, const int *attached) {
    VkImageView views[4];
    VkExtent2D size = size_of(attached[0]);
    for (uint32_t i = 0; i < count; i++)
        views[i] = images[attached[i]].view;
    VkFramebufferCreateInfo create = {
        VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, NULL, 0, passes[pass], count, views, size.width, size.height, 1
    };
    CHECK(vkCreateFramebuffer(device, &create, NULL, &framebuffers[pass]));
    NAMED(RENDER_PASS, passes[pass], name);
    NAMED(FRAMEBUFFER, framebuffers[pass], name);
}

/* The scene: a Vulkan 1.0 render pass that resolves color, or two, the second of which does. */
static void make_scene_pass(int pass, bool first) {
    const bool last = pass == SCENE_PASS;
    /* Mistake 2, multisampled-attachment-stored, scene: color is resolved in the pass, but its samples are stored as well. */
    VkAttachmentStoreOp color_store = made[2] || !last ? STORE : DISCARD;
    /* Mistake 3, multisampled-depth-stored, scene: nothing reads the stored depth. */
    VkAttachmentStoreOp depth_store = made[3] || !last ? STORE : DISCARD;
    VkAttachmentLoadOp load = first ? CLEAR : LOAD;
    VkAttachmentDescription attachments[] = {
        {0, images[SCENE_MS].format, FOUR, load, color_store, FORGET, DISCARD, first ? UNDEFINED : COLOR, COLOR},
        {0, images[SCENE_DEPTH].format, FOUR, load, depth_store, FORGET, DISCARD, first ? UNDEFINED : DEPTH, DEPTH},
        {0, images[SCENE].format, ONE, FORGET, STORE, FORGET, DISCARD, UNDEFINED, READ},
    };
    VkAttachmentReference color = {0, COLOR}, depth = {1, DEPTH}, resolve = {2, COLOR};
    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1, .pColorAttachments = &color, .pResolveAttachments = last ? &resolve : NULL,
        .pDepthStencilAttachment = &depth
    };
    /* Mistake 6, reused-attachment-unsynchronised, scene: the dependency waits for the previous frame's color, but not for its depth. */
    VkPipelineStageFlags before = made[6] && last ? OUTPUT | SHADING : OUTPUT | SHADING | TESTS;
    VkAccessFlags wrote = made[6] && last ? COLOR_WRITE : COLOR_WRITE | DEPTH_WRITE;
    VkSubpassDependency dependencies[] = {
        {VK_SUBPASS_EXTERNAL, 0, before, OUTPUT | TESTS, wrote, COLOR_USE | DEPTH_USE, 0},
        {0, VK_SUBPASS_EXTERNAL, OUTPUT, SHADING, COLOR_WRITE, VK_ACCESS_SHADER_READ_BIT, 0},
    };
    VkRenderPassCreateInfo create = {
        VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, NULL, 0, last ? 3 : 2, attachments, 1, &subpass, last ? 2 : 1, dependencies
    };
    CHECK(vkCreateRenderPass(device, &create, NULL, &passes[pass]));
    make_framebuffer(pass, last ? "scene" : "opaque", create.attachmentCount, (const int[]){SCENE_MS, SCENE_DEPTH, SCENE});
}

/* The mirror image: a Vulkan 1.2 render pass that resolves color and depth. */
static void make_mirror_pass(void) {
    const VkStructureType description = VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2, reference = VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2;
    /* Mistake 7, multisampled-attachment-stored, mirror: same as mistake 2, with vkCreateRenderPass2. */
    VkAttachmentStoreOp color_store = made[7] ? STORE : DISCARD;
    /* Mistake 8, multisampled-stencil-stored, mirror: depth is discarded, but its stencil is stored. */
    VkAttachmentStoreOp stencil_store = made[8] ? STORE : DISCARD;
    /* Mistake 9, depth-averaged, mirror: there is no surface halfway between two surfaces. */
    VkResolveModeFlagBits depth_mode = made[9] ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
    /* Mistake 10, resolve-target-loaded, mirror: the resolve target is cleared first. */
    VkAttachmentLoadOp target_load = made[10] ? CLEAR : FORGET;
    /* Mistake 11, clear-command-instead-of-load-op, mirror: a command clears what the pass could clear when it begins. */
    VkAttachmentLoadOp color_load = made[11] ? FORGET : CLEAR;
    VkAttachmentDescription2 attachments[] = {
        {description, NULL, 0, images[MIRROR_MS].format, FOUR, color_load, color_store, FORGET, DISCARD, UNDEFINED, COLOR},
        {description, NULL, 0, images[MIRROR_DEPTH_MS].format, FOUR, CLEAR, DISCARD, CLEAR, stencil_store, UNDEFINED, DEPTH},
        {description, NULL, 0, images[MIRROR].format, ONE, target_load, STORE, FORGET, DISCARD, UNDEFINED, READ},
        {description, NULL, 0, images[MIRROR_DEPTH].format, ONE, FORGET, STORE, FORGET, DISCARD, UNDEFINED, READ},
    };
    VkAttachmentReference2 color = {reference, NULL, 0, COLOR, VK_IMAGE_ASPECT_COLOR_BIT};
    VkAttachmentReference2 depth = {reference, NULL, 1, DEPTH, aspects_of(MIRROR_DEPTH_MS)};
    VkAttachmentReference2 resolve = {reference, NULL, 2, COLOR, VK_IMAGE_ASPECT_COLOR_BIT};
    VkAttachmentReference2 depth_target = {reference, NULL, 3, DEPTH, VK_IMAGE_ASPECT_DEPTH_BIT};
    VkSubpassDescriptionDepthStencilResolve depth_resolve = {
        VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE, NULL, depth_mode, VK_RESOLVE_MODE_NONE, &depth_target
    };
    VkSubpassDescription2 subpass = {
        .sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2, .pNext = &depth_resolve, .colorAttachmentCount = 1, .pColorAttachments = &color,
        .pResolveAttachments = &resolve, .pDepthStencilAttachment = &depth
    };
    /* A resolve, even of depth, writes in the color attachment output stage. */
    const VkStructureType dependency = VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2;
    const VkAccessFlags writes = COLOR_WRITE | DEPTH_WRITE, uses = COLOR_USE | DEPTH_USE;
    VkSubpassDependency2 dependencies[] = {
        {dependency, NULL, VK_SUBPASS_EXTERNAL, 0, OUTPUT | TESTS | SHADING, OUTPUT | TESTS, writes, uses, 0, 0},
        {dependency, NULL, 0, VK_SUBPASS_EXTERNAL, OUTPUT, SHADING, COLOR_WRITE, VK_ACCESS_SHADER_READ_BIT, 0, 0},
    };
    VkRenderPassCreateInfo2 create = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2, .attachmentCount = COUNT(attachments), .pAttachments = attachments,
        .subpassCount = 1, .pSubpasses = &subpass, .dependencyCount = COUNT(dependencies), .pDependencies = dependencies
    };
    CHECK(vkCreateRenderPass2(device, &create, NULL, &passes[MIRROR_PASS]));
    make_framebuffer(MIRROR_PASS, "mirror", 4, (const int[]){MIRROR_MS, MIRROR_DEPTH_MS, MIRROR, MIRROR_DEPTH});
}

/* The composite: one triangle that covers the picture, with one sample. */
static void make_composite_pass(void) {
    VkAttachmentDescription attachment = {0, images[PICTURE].format, ONE, FORGET, STORE, FORGET, DISCARD, UNDEFINED, COLOR};
    VkAttachmentReference color = {0, COLOR};
    VkSubpassDescription subpass = {.colorAttachmentCount = 1, .pColorAttachments = &color};
    VkSubpassDependency dependency = {VK_SUBPASS_EXTERNAL, 0, OUTPUT, OUTPUT, COLOR_WRITE, COLOR_USE, 0};
    VkRenderPassCreateInfo create = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, NULL, 0, 1, &attachment, 1, &subpass, 1, &dependency};
    CHECK(vkCreateRenderPass(device, &create, NULL, &passes[COMPOSITE_PASS]));
    make_framebuffer(COMPOSITE_PASS, "composite", 1, (const int[]){PICTURE});
}

/* The images that the composite samples, and the layouts of both kinds of pipelines. */
static void make_layouts(void) {
    const VkDescriptorType kind = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    const int sampled[] = {SCENE, MIRROR, MIRROR_DEPTH, GLOW};
    const VkSamplerAddressMode edge = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSamplerCreateInfo sampler = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO, .addressModeU = edge, .addressModeV = edge, .addressModeW = edge
    };
    CHECK(vkCreateSampler(device, &sampler, NULL, &samplers[0]));
    sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;
    CHECK(vkCreateSampler(device, &sampler, NULL, &samplers[1]));

    VkDescriptorSetLayoutBinding bindings[COUNT(sampled)];
    for (uint32_t i = 0; i < COUNT(sampled); i++)
        bindings[i] = (VkDescriptorSetLayoutBinding){i, kind, 1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    VkDescriptorSetLayoutCreateInfo layout = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO, NULL, 0, COUNT(bindings), bindings};
    CHECK(vkCreateDescriptorSetLayout(device, &layout, NULL, &set_layout));
    VkDescriptorPoolSize size = {kind, COUNT(sampled)};
    VkDescriptorPoolCreateInfo pool = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, NULL, 0, 1, 1, &size};
    CHECK(vkCreateDescriptorPool(device, &pool, NULL, &descriptors));
    VkDescriptorSetAllocateInfo allocate = {VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, NULL, descriptors, 1, &set_layout};
    CHECK(vkAllocateDescriptorSets(device, &allocate, &set));
    for (uint32_t i = 0; i < COUNT(sampled); i++) {
        VkSampler filter = samplers[aspects_of(sampled[i]) == VK_IMAGE_ASPECT_COLOR_BIT]; /* few devices filter depth */
        VkDescriptorImageInfo image = {filter, images[sampled[i]].view, READ};
        VkWriteDescriptorSet write = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, NULL, set, i, 0, 1, kind, &image, NULL, NULL};
        vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    }

    VkPipelineLayoutCreateInfo with_set = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, NULL, 0, 1, &set_layout, 0, NULL};
    CHECK(vkCreatePipelineLayout(device, &with_set, NULL, &composite_layout));
    VkPushConstantRange constants = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Gear)};
    VkPipelineLayoutCreateInfo with_constants = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, NULL, 0, 0, NULL, 1, &constants};
    CHECK(vkCreatePipelineLayout(device, &with_constants, NULL, &gear_layout));
}

static void make_shaders(void) {
    const VkShaderModuleCreateInfo creates[SHADERS] = {
        [GEAR_VERTEX] = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, sizeof gear_vert, gear_vert},
        [GEAR_FRAGMENT] = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, sizeof gear_frag, gear_frag},
        [COMPOSITE_VERTEX] = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, sizeof composite_vert, composite_vert},
        [COMPOSITE_FRAGMENT] = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, NULL, 0, sizeof composite_frag, composite_frag},
    };
    for (int i = 0; i < SHADERS; i++)
        CHECK(vkCreateShaderModule(device, &creates[i], NULL, &shaders[i]));
}

/* The differences between the pipelines, and storage for what their create infos point to. */
typedef struct {
    const char *name;
    int pass, target, depth; /* no pass: dynamic rendering; no depth: the composite */
    bool over, glowing, stencil;
    float sample_shading; /* 0: off */
    VkPipelineShaderStageCreateInfo stages[2];
    VkViewport viewport;
    VkRect2D scissor;
    VkPipelineViewportStateCreateInfo viewports;
    VkPipelineMultisampleStateCreateInfo multisample;
    VkPipelineDepthStencilStateCreateInfo depth_stencil;
    VkPipelineColorBlendAttachmentState blend;
    VkPipelineColorBlendStateCreateInfo blending;
    VkPipelineRenderingCreateInfo rendering;
} Look;

static VkGraphicsPipelineCreateInfo described(Look *look) {
    static const VkPipelineVertexInputStateCreateInfo no_vertices = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    static const VkPipelineInputAssemblyStateCreateInfo triangles = {
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO, NULL, 0, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_FALSE
    };
    static const VkPipelineRasterizationStateCreateInfo filled = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1
    };
    static const VkStencilOpState counted = {
        .passOp = VK_STENCIL_OP_INCREMENT_AND_CLAMP, .compareOp = VK_COMPARE_OP_ALWAYS, .writeMask = 0xFF
    };
    const bool gear = look->depth >= 0;
    const VkExtent2D size = size_of(look->target);
    const Image *target = &images[look->target];
    for (int i = 0; i < 2; i++)
        look->stages[i] = (VkPipelineShaderStageCreateInfo){
            VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, NULL, 0, i ? VK_SHADER_STAGE_FRAGMENT_BIT : VK_SHADER_STAGE_VERTEX_BIT,
            shaders[(gear ? GEAR_VERTEX : COMPOSITE_VERTEX) + i], "main", NULL
        };
    look->viewport = (VkViewport){0, 0, (float)size.width, (float)size.height, 0, 1};
    look->scissor.extent = size;
    look->viewports = (VkPipelineViewportStateCreateInfo){
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, NULL, 0, 1, &look->viewport, 1, &look->scissor
    };
    look->multisample = (VkPipelineMultisampleStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = target->samples,
        .sampleShadingEnable = look->sample_shading > 0, .minSampleShading = look->sample_shading
    };
    look->depth_stencil = (VkPipelineDepthStencilStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO, .depthTestEnable = VK_TRUE, .depthWriteEnable = !look->over,
        .depthCompareOp = VK_COMPARE_OP_LESS, .stencilTestEnable = look->stencil, .front = counted, .back = counted
    };
    look->blend = (VkPipelineColorBlendAttachmentState){
        .blendEnable = look->over || look->glowing, .srcColorBlendFactor = look->over ? VK_BLEND_FACTOR_SRC_ALPHA : VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor = look->over ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE, .colorWriteMask = 0xF
    };
    look->blending = (VkPipelineColorBlendStateCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1, .pAttachments = &look->blend
    };
    look->rendering = (VkPipelineRenderingCreateInfo){
        VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO, NULL, 0, 1, &target->format, gear ? images[look->depth].format : 0, 0
    };
    return (VkGraphicsPipelineCreateInfo){
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, .pNext = look->pass < 0 ? &look->rendering : NULL, .stageCount = 2,
        .pStages = look->stages, .pVertexInputState = &no_vertices, .pInputAssemblyState = &triangles, .pViewportState = &look->viewports,
        .pRasterizationState = &filled, .pMultisampleState = &look->multisample, .pDepthStencilState = gear ? &look->depth_stencil : NULL,
        .pColorBlendState = &look->blending, .layout = gear ? gear_layout : composite_layout,
        .renderPass = look->pass < 0 ? VK_NULL_HANDLE : passes[look->pass]
    };
}

static void make_pipelines(void) {
    /* Mistake 4, sample-shading-everywhere, scene: gears are shaded four times everywhere, not just at their edges. */
    float everywhere = made[4] ? 1.0f : 0.0f;
    /* Mistake 16, sample-shading-ineffective, glow: a quarter of four samples is one, which every pixel has anyway. */
    float ineffective = made[16] ? 0.25f : 0.0f;
    const int opaque = made[18] ? OPAQUE_PASS : SCENE_PASS;
    Look looks[PIPELINES] = {
        [OPAQUE] = {.name = "opaque", .pass = opaque, .target = SCENE_MS, .depth = SCENE_DEPTH, .sample_shading = everywhere},
        [GLASS] = {.name = "glass", .pass = SCENE_PASS, .target = SCENE_MS, .depth = SCENE_DEPTH, .over = true},
        [MIRRORED] = {.name = "mirrored", .pass = MIRROR_PASS, .target = MIRROR_MS, .depth = MIRROR_DEPTH_MS, .stencil = true},
        [GLOWING] = {.name = "glowing", .pass = -1, .target = GLOW_MS, .depth = GLOW_DEPTH, .glowing = true, .sample_shading = ineffective},
        [COMPOSITE] = {.name = "composite", .pass = COMPOSITE_PASS, .target = PICTURE, .depth = -1},
    };
    for (int i = 0; i < GLOWING; i++) {
        VkGraphicsPipelineCreateInfo create = described(&looks[i]);
        CHECK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &create, NULL, &pipelines[i]));
    }
    /* Validation layers up to 1.3.239 crash in a check for Arm GPUs, which assumes that all pipelines of a call have a render pass, and which
       stops at the first pipeline with one sample. So the pipeline without a render pass is created after such a one, in the same call. */
    VkGraphicsPipelineCreateInfo creates[] = {described(&looks[COMPOSITE]), described(&looks[GLOWING])};
    VkPipeline both[COUNT(creates)];
    CHECK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, COUNT(creates), creates, NULL, both));
    pipelines[COMPOSITE] = both[0];
    pipelines[GLOWING] = both[1];
    for (int i = 0; i < PIPELINES; i++)
        NAMED(PIPELINE, pipelines[i], looks[i].name);
}

/* Gear `number` at a frame. Neighbors turn in opposite directions. */
static Gear gear_at(int number, int frame) {
    float way = number % 2 ? -1.0f : 1.0f, side = (float)number / (GEARS - 1);
    return (Gear){
        {0.2f + 0.6f * side, 0.5f, 0.9f - 0.7f * side, 1}, {1.5f * side - 0.75f, 0.25f * way}, 0.42f,
        0.05f * way * (float)frame + 0.3f * side, 0.3f + 0.05f * (float)(number % 3), 9 + 2 * (number % 3)
    };
}

static void draw_gear(int pipeline, Gear gear) {
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[pipeline]);
    vkCmdPushConstants(buffer, gear_layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof gear, &gear);
    vkCmdDraw(buffer, 12 * (uint32_t)gear.teeth, 1, 0, 0);
}

static void draw_scene(int frame) {
    const VkClearValue clears[] = {{.color = {.float32 = {0.05f, 0.06f, 0.08f, 1}}}, {.depthStencil = {1, 0}}};
    const int first = made[18] ? OPAQUE_PASS : SCENE_PASS;
    VkRenderPassBeginInfo begin = {
        VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, NULL, passes[first], framebuffers[first], {{0, 0}, size_of(SCENE_MS)},
        COUNT(clears), clears
    };
    begin_labelled("scene");
    vkCmdBeginRenderPass(buffer, &begin, VK_SUBPASS_CONTENTS_INLINE);
    for (int i = 0; i < GEARS; i++)
        draw_gear(OPAQUE, gear_at(i, frame));
    /* Mistake 18, multisampled-attachment-loaded, scene: glass has its own pass, for which all samples are stored and loaded. */
    if (made[18]) {
        vkCmdEndRenderPass(buffer);
        begin = (VkRenderPassBeginInfo){
            VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, NULL, passes[SCENE_PASS], framebuffers[SCENE_PASS], begin.renderArea, 0, NULL
        };
        vkCmdBeginRenderPass(buffer, &begin, VK_SUBPASS_CONTENTS_INLINE);
    }
    draw_gear(GLASS, (Gear){{0.9f, 0.95f, 1, 0.35f}, {0.1f, 0.1f}, 0.6f, -0.02f * (float)frame, 0.2f, 5});
    vkCmdEndRenderPass(buffer);
    end_labelled();
}

static void draw_mirror(int frame) {
    const VkClearValue clears[] = {{.color = {.float32 = {0, 0, 0, 1}}}, {.depthStencil = {1, 0}}, {.color = {.float32 = {0}}}};
    const VkRect2D area = {{0, 0}, size_of(MIRROR_MS)};
    VkRenderPassBeginInfo begin = {
        VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, NULL, passes[MIRROR_PASS], framebuffers[MIRROR_PASS], area, made[10] ? 3 : 2, clears
    };
    VkSubpassBeginInfo inlined = {VK_STRUCTURE_TYPE_SUBPASS_BEGIN_INFO, NULL, VK_SUBPASS_CONTENTS_INLINE};
    VkSubpassEndInfo end = {VK_STRUCTURE_TYPE_SUBPASS_END_INFO, NULL};
    begin_labelled("mirror");
    vkCmdBeginRenderPass2(buffer, &begin, &inlined);
    if (made[11])
        vkCmdClearAttachments(
            buffer, 1, &(VkClearAttachment){VK_IMAGE_ASPECT_COLOR_BIT, 0, clears[0]}, 1, &(VkClearRect){area, 0, 1}
        );
    for (int i = 0; i < GEARS; i++) {
        Gear gear = gear_at(i, frame);
        gear.middle[1] = -gear.middle[1];
        gear.angle = -gear.angle;
        draw_gear(MIRRORED, gear);
    }
    vkCmdEndRenderPass2(buffer, &end);
    end_labelled();
}

typedef struct {
    VkPipelineStageFlags stages;
    VkAccessFlags access;
} Uses;

/* How an image is used in a layout; without one, any use by the previous frame. */
static Uses uses_in(VkImageLayout layout) {
    switch ((int)layout) {
    case UNDEFINED: return (Uses){OUTPUT | TESTS | SHADING | TRANSFER, COLOR_WRITE | DEPTH_WRITE};
    case COLOR: return (Uses){OUTPUT, COLOR_USE};
    case DEPTH: return (Uses){TESTS, DEPTH_USE};
    case FROM: return (Uses){TRANSFER, VK_ACCESS_TRANSFER_READ_BIT};
    case TO: return (Uses){TRANSFER, VK_ACCESS_TRANSFER_WRITE_BIT};
    default: return (Uses){SHADING, VK_ACCESS_SHADER_READ_BIT};
    }
}

static void barrier(int image, VkImageLayout from, VkImageLayout to) {
    const Uses before = uses_in(from), after = uses_in(to);
    VkImageMemoryBarrier barrier = {
        VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, NULL, before.access, after.access, from, to, VK_QUEUE_FAMILY_IGNORED,
        VK_QUEUE_FAMILY_IGNORED, images[image].image, {aspects_of(image), 0, 1, 0, 1}
    };
    vkCmdPipelineBarrier(buffer, before.stages, after.stages, 0, 0, NULL, 0, NULL, 1, &barrier);
}

/* Dynamic rendering of the glow of the gears from `first` up to, but not including, `end`. */
static void render_glow(int frame, int first, int end) {
    const bool last = end == GEARS, resolves = last && !made[12];
    /* Mistake 14, discarded-then-loaded, glow: the first of two renderings discards the depth that the second loads. */
    VkAttachmentStoreOp depth_store = made[14] ? DISCARD : STORE;
    /* Mistake 15, multisampled-depth-stored, glow: same as mistake 3, in dynamic rendering. */
    if (last)
        depth_store = made[15] ? STORE : DISCARD;
    VkRenderingAttachmentInfo color = {
        VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, NULL, images[GLOW_MS].view, COLOR, resolves ? VK_RESOLVE_MODE_AVERAGE_BIT : 0,
        resolves ? images[GLOW].view : VK_NULL_HANDLE, COLOR, first ? LOAD : CLEAR, resolves ? DISCARD : STORE, {{{0}}}
    };
    VkRenderingAttachmentInfo depth = {
        VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, NULL, images[GLOW_DEPTH].view, DEPTH, 0, VK_NULL_HANDLE, 0, first ? LOAD : CLEAR,
        depth_store, {.depthStencil = {1, 0}}
    };
    VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO, NULL, 0, {{0, 0}, size_of(GLOW_MS)}, 1, 0, 1, &color, &depth, NULL};
    vkCmdBeginRendering(buffer, &info);
    for (int i = first; i < end; i++) {
        Gear gear = gear_at(i, frame);
        for (int component = 0; component < 3; component++)
            gear.color[component] *= 0.2f;
        gear.radius *= 0.5f;
        draw_gear(GLOWING, gear);
    }
    vkCmdEndRendering(buffer);
}

static void draw_glow(int frame) {
    begin_labelled("glow");
    barrier(GLOW_MS, UNDEFINED, COLOR);
    barrier(GLOW_DEPTH, UNDEFINED, DEPTH);
    barrier(GLOW, UNDEFINED, made[12] ? TO : COLOR);
    /* Mistake 13, multisampled-attachment-loaded, glow: two renderings draw what one could, and samples are stored and loaded between them. */
    if (made[13] || made[14]) {
        render_glow(frame, 0, GEARS / 2);
        barrier(GLOW_MS, COLOR, COLOR);
        barrier(GLOW_DEPTH, DEPTH, DEPTH);
    }
    render_glow(frame, made[13] || made[14] ? GEARS / 2 : 0, GEARS);
    /* Mistake 12, resolve-outside-pass, glow: a command resolves from memory what the rendering could resolve itself. */
    if (made[12]) {
        const VkImageSubresourceLayers layer = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        VkImageResolve all = {layer, {0, 0, 0}, layer, {0, 0, 0}, {size_of(GLOW).width, size_of(GLOW).height, 1}};
        barrier(GLOW_MS, COLOR, FROM);
        vkCmdResolveImage(buffer, images[GLOW_MS].image, FROM, images[GLOW].image, TO, 1, &all);
    }
    barrier(GLOW, made[12] ? TO : COLOR, READ);
    end_labelled();
}

static void draw_composite(void) {
    const VkClearValue clear = {.color = {.float32 = {0, 0, 0, 1}}};
    /* Mistake 17, clear-value-without-clear, composite: a clear value in a pass that clears nothing. */
    uint32_t clears = made[17] ? 1 : 0;
    VkRenderPassBeginInfo begin = {
        VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, NULL, passes[COMPOSITE_PASS], framebuffers[COMPOSITE_PASS], {{0, 0}, size_of(PICTURE)},
        clears, &clear
    };
    begin_labelled("composite");
    vkCmdBeginRenderPass(buffer, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines[COMPOSITE]);
    vkCmdBindDescriptorSets(buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, composite_layout, 0, 1, &set, 0, NULL);
    vkCmdDraw(buffer, 3, 1, 0, 0);
    vkCmdEndRenderPass(buffer);
    end_labelled();
}

static void draw_frame(int frame) {
    begin_commands();
    draw_scene(frame);
    draw_mirror(frame);
    draw_glow(frame);
    draw_composite();
    submit_commands();
}

static void save_picture(void) {
    begin_commands();
    barrier(PICTURE, COLOR, FROM);
    submit_commands();
    write_image(picture, images[PICTURE].image, size_of(PICTURE));
}

static void close_frame(void) {
    for (int i = 0; i < PIPELINES; i++)
        vkDestroyPipeline(device, pipelines[i], NULL);
    for (int i = 0; i < SHADERS; i++)
        vkDestroyShaderModule(device, shaders[i], NULL);
    for (int i = 0; i < 2; i++)
        vkDestroySampler(device, samplers[i], NULL);
    for (int i = 0; i < PASSES; i++) {
        vkDestroyFramebuffer(device, framebuffers[i], NULL);
        vkDestroyRenderPass(device, passes[i], NULL);
    }
    for (int i = 0; i < IMAGES; i++) {
        vkDestroyImageView(device, images[i].view, NULL);
        vkDestroyImage(device, images[i].image, NULL);
        vkFreeMemory(device, images[i].memory, NULL);
    }
    vkDestroyPipelineLayout(device, gear_layout, NULL);
    vkDestroyPipelineLayout(device, composite_layout, NULL);
    vkDestroyDescriptorPool(device, descriptors, NULL);
    vkDestroyDescriptorSetLayout(device, set_layout, NULL);
    close_device();
}

/* The number of frames to draw; the other options are stored in `made` and `picture`. */
static int frames_of(int count, char **arguments) {
    int frames = 30;
    memset(made, true, sizeof made);
    for (int i = 1; i < count; i++) {
        const char *value = i + 1 < count ? arguments[i + 1] : "";
        int number = atoi(value);
        if (!strcmp(arguments[i], "--fixed")) {
            memset(made, false, sizeof made);
        } else if (!strcmp(arguments[i], "--mistake") && number >= 1 && number <= MISTAKES) {
            memset(made, false, sizeof made);
            made[number] = true;
            i++;
        } else if (!strcmp(arguments[i], "--frames") && number >= 1) {
            frames = number;
            i++;
        } else if (!strcmp(arguments[i], "--picture") && *value) {
            picture = value;
            i++;
        } else {
            fprintf(stderr, "forward [--frames N] [--fixed | --mistake 1..%d] [--picture FILE.ppm]\n", MISTAKES);
            exit(2);
        }
    }
    return frames;
}

int main(int count, char **arguments) {
    int frames = frames_of(count, arguments);
    open_device();
    begin_capture();
    make_images();
    if (made[18])
        make_scene_pass(OPAQUE_PASS, true);
    make_scene_pass(SCENE_PASS, !made[18]);
    make_mirror_pass();
    make_composite_pass();
    make_layouts();
    make_shaders();
    make_pipelines();
    for (int frame = 0; frame < frames; frame++)
        draw_frame(frame);
    end_capture();
    if (picture)
        save_picture();
    close_frame();
    return 0;
}
