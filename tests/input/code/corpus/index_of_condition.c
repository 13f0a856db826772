/* A game: which attachment is which depends on whether the pass resolves, and which pass a framebuffer is for on a setting. */
#include <string.h>
#include <vulkan/vulkan.h>

enum { PASS_PLAIN, PASS_LAYERED, PASS_COUNT };
enum { CLEAR_NONE, CLEAR_STENCIL, CLEAR_COUNT };

#define ZEROED(T, x) T x; memset(&x, 0, sizeof(x))
#define ZEROED_ARRAY(T, x, n) T x[n]; memset(x, 0, sizeof(x))

typedef struct {
    VkDevice device;
    VkSampleCountFlagBits count;
    VkFormat color_format;
    VkRenderPass passes[PASS_COUNT][CLEAR_COUNT];
} globals_t;

globals_t globals;
static VkImage color, color_ms, depth, layers;
static VkImageView color_view, color_ms_view, depth_view, layers_view;
static VkFramebuffer framebuffer;

extern int layered_setting;

static int uses_layers(void) { return layered_setting != 0; }

static void create_passes(void)
{
    const int resolve = globals.count != VK_SAMPLE_COUNT_1_BIT;
    for (int variant = 0; variant < PASS_COUNT; ++variant) {
        for (int clear = 0; clear < CLEAR_COUNT; ++clear) {
            const int layered = variant == PASS_LAYERED;
            const uint32_t scene = resolve ? 2 : 0;
            const uint32_t layer = resolve ? 3 : 2;
            ZEROED_ARRAY(VkAttachmentDescription, list, 4);
            list[0].samples = VK_SAMPLE_COUNT_1_BIT;
            list[0].format = globals.color_format;
            list[0].loadOp = resolve ? VK_ATTACHMENT_LOAD_OP_DONT_CARE : VK_ATTACHMENT_LOAD_OP_CLEAR;
            list[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            list[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            list[1].samples = globals.count;
            list[1].format = VK_FORMAT_D32_SFLOAT;
            list[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            list[1].storeOp = layered ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;  /* expect: MSAA203 */
            list[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
            if (resolve) {
                list[scene].samples = globals.count;
                list[scene].format = globals.color_format;
                list[scene].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
                list[scene].storeOp = layered ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;  /* expect: MSAA201 */
                list[scene].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            }
            if (layered) {
                list[layer].samples = globals.count;
                list[layer].format = VK_FORMAT_R16G16B16A16_SFLOAT;
                list[layer].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
                list[layer].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
                list[layer].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            }

            VkAttachmentReference scene_ref = {scene, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
            VkAttachmentReference layer_ref = {layer, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
            VkAttachmentReference read_ref = {layer, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
            VkAttachmentReference depth_ref = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
            VkAttachmentReference resolve_ref = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
            ZEROED_ARRAY(VkSubpassDescription, subpasses, 2);
            subpasses[0].colorAttachmentCount = 1;
            subpasses[0].pColorAttachments = layered ? &layer_ref : &scene_ref;
            subpasses[0].pDepthStencilAttachment = &depth_ref;
            if (resolve && !layered)
                subpasses[0].pResolveAttachments = &resolve_ref;
            if (layered) {
                subpasses[1].colorAttachmentCount = 1;
                subpasses[1].pColorAttachments = &scene_ref;
                subpasses[1].pDepthStencilAttachment = &depth_ref;
                subpasses[1].inputAttachmentCount = 1;
                subpasses[1].pInputAttachments = &read_ref;
                if (resolve)
                    subpasses[1].pResolveAttachments = &resolve_ref;
            }

            ZEROED(VkRenderPassCreateInfo, info);
            info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
            info.attachmentCount = layered ? (resolve ? 4 : 3) : (resolve ? 3 : 2);
            info.pAttachments = list;
            info.subpassCount = layered ? 2 : 1;
            info.pSubpasses = subpasses;
            vkCreateRenderPass(globals.device, &info, NULL, &globals.passes[variant][clear]);
        }
    }
}

static void create_target(VkFormat format, VkSampleCountFlagBits count, VkImageUsageFlags usage, VkImageAspectFlags aspect,
                          VkImage *image, VkImageView *view)
{
    ZEROED(VkImageCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = count;
    info.usage = usage;
    vkCreateImage(globals.device, &info, NULL, image);

    ZEROED(VkImageViewCreateInfo, view_info);
    view_info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    view_info.image = *image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = format;
    view_info.subresourceRange.aspectMask = aspect;
    view_info.subresourceRange.levelCount = 1;
    view_info.subresourceRange.layerCount = 1;
    vkCreateImageView(globals.device, &view_info, NULL, view);
}

static void create_targets(void)
{
    create_target(globals.color_format, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                  VK_IMAGE_ASPECT_COLOR_BIT, &color, &color_view);
    create_target(VK_FORMAT_D32_SFLOAT, globals.count, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,  /* expect: MSAA401 */
                  VK_IMAGE_ASPECT_DEPTH_BIT, &depth, &depth_view);
    if (globals.count != VK_SAMPLE_COUNT_1_BIT)
        create_target(globals.color_format, globals.count, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,  /* expect: MSAA401 */
                      VK_IMAGE_ASPECT_COLOR_BIT, &color_ms, &color_ms_view);
    create_target(VK_FORMAT_R16G16B16A16_SFLOAT, globals.count,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                  VK_IMAGE_ASPECT_COLOR_BIT, &layers, &layers_view);
}

static void create_framebuffer(void)
{
    const int resolve = globals.count != VK_SAMPLE_COUNT_1_BIT;
    const int layered = uses_layers();
    VkImageView views[4] = {color_view, depth_view, color_ms_view, layers_view};
    if (!resolve)
        views[2] = layers_view;

    ZEROED(VkFramebufferCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = globals.passes[layered ? PASS_LAYERED : PASS_PLAIN][CLEAR_STENCIL];
    info.attachmentCount = layered ? (resolve ? 4 : 3) : (resolve ? 3 : 2);
    info.pAttachments = views;
    info.layers = 1;
    vkCreateFramebuffer(globals.device, &info, NULL, &framebuffer);
}

void video_start(VkSampleCountFlagBits count)
{
    globals.count = count;
    create_targets();
    create_passes();
    create_framebuffer();
}
