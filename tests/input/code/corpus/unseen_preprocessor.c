/* Two programs in one: what stands under one branch of the preprocessor never meets what stands under the other. Both are right. */
#include <vulkan/vulkan.h>

#if defined(ANDROID) || defined(WITH_MSAA)
#define SCENE_SAMPLES VK_SAMPLE_COUNT_4_BIT
#define SCENE_STORE VK_ATTACHMENT_STORE_OP_DONT_CARE
#define SCENE_USAGE (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT)
#define HAS_RESOLVE 1
#else
#define SCENE_SAMPLES VK_SAMPLE_COUNT_1_BIT
#define SCENE_STORE VK_ATTACHMENT_STORE_OP_STORE
#define SCENE_USAGE (VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT)
#define HAS_RESOLVE 0
#endif

#define ZERO(type, name) type name = {0}
#define REF(index) {(index), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}

VkResult create_scene_pass(VkDevice device, VkFormat format, VkRenderPass *pass) {
    const VkAttachmentDescription attachments[] = {
        {
            .format = format,
            .samples = SCENE_SAMPLES,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = SCENE_STORE,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
#if HAS_RESOLVE
        {
            .format = format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
        },
#endif
    };
    const VkAttachmentReference color = REF(0);
#if HAS_RESOLVE
    const VkAttachmentReference resolve = REF(1);
#endif
    ZERO(VkSubpassDescription, subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
#if HAS_RESOLVE
    subpass.pResolveAttachments = &resolve;
#endif
    ZERO(VkRenderPassCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 1 + HAS_RESOLVE;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    return vkCreateRenderPass(device, &info, NULL, pass);
}

#ifdef WITH_MSAA
static VkSampleCountFlagBits sample_count(void) { return VK_SAMPLE_COUNT_4_BIT; }
static VkAttachmentStoreOp depth_store(void) { return VK_ATTACHMENT_STORE_OP_DONT_CARE; }
static VkImageUsageFlags depth_usage(void) { return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT; }
#else
static VkSampleCountFlagBits sample_count(void) { return VK_SAMPLE_COUNT_1_BIT; }
static VkAttachmentStoreOp depth_store(void) { return VK_ATTACHMENT_STORE_OP_STORE; }
static VkImageUsageFlags depth_usage(void) { return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT; }
#endif

VkResult create_depth(VkDevice device, VkExtent3D extent, VkImage *image, VkAttachmentDescription *description) {
    ZERO(VkImageCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_D32_SFLOAT;
    info.extent = extent;
    info.arrayLayers = 1;
#ifdef WITH_MSAA
    info.mipLevels = 1;
#else
    info.mipLevels = 6;
#endif
    info.samples = sample_count();
    info.usage = depth_usage();
    *description = (VkAttachmentDescription){
        .format = VK_FORMAT_D32_SFLOAT,
        .samples = sample_count(),
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = depth_store(),
        .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
    };
    return vkCreateImage(device, &info, NULL, image);
}

VkResult create_color(VkDevice device, VkExtent3D extent, VkImage *image) {
    ZERO(VkImageCreateInfo, info);
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = extent;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = SCENE_SAMPLES;
    info.usage = SCENE_USAGE;
    return vkCreateImage(device, &info, NULL, image);
}
