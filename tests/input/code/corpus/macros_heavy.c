/* Macros that open and close blocks, make functions and lists: a grammar finds no statement in half of it. */
#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan.h>

#define BEGIN_C_DECLS
#define END_C_DECLS
#define RHI_EXPORT
#define RHI_NONNULL(...)
#define UNUSED(x) ((void)(x))
#define foreach(i, n) for (uint32_t i = 0; i < (n); i++)
#define guarded(call) if ((call) != VK_SUCCESS) goto failed
#define STRUCT(type, name) type name = {0}; name.sType = RHI_TYPE_##type
#define RHI_TYPE_VkImageCreateInfo VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO
#define RHI_TYPE_VkRenderPassCreateInfo VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO
#define FORMATS(F) F(rgba8, VK_FORMAT_R8G8B8A8_UNORM, 4) F(rgba16f, VK_FORMAT_R16G16B16A16_SFLOAT, 8) F(d32, VK_FORMAT_D32_SFLOAT, 4)
#define DEFINE_GETTER(type, field) static inline type rhi_get_##field(const struct rhi *rhi) { return rhi->field; }
#define ATTACHMENT(f, s, load, store, last)                                                                  \
    {                                                                                                        \
        .format = (f), .samples = (s), .loadOp = VK_ATTACHMENT_LOAD_OP_##load,                                \
        .storeOp = VK_ATTACHMENT_STORE_OP_##store, .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,          \
        .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE, .finalLayout = VK_IMAGE_LAYOUT_##last,            \
    }

BEGIN_C_DECLS

enum rhi_format {
#define F(name, vk, bytes) RHI_##name,
    FORMATS(F)
#undef F
    RHI_FORMATS
};

static const VkFormat rhi_vk_formats[] = {
#define F(name, vk, bytes) [RHI_##name] = vk,
    FORMATS(F)
#undef F
};

struct rhi {
    VkDevice device;
    VkRenderPass pass;
    VkImage images[2];
    uint32_t samples;
};

DEFINE_GETTER(VkDevice, device)
DEFINE_GETTER(uint32_t, samples)

RHI_EXPORT RHI_NONNULL(1) VkResult rhi_make_pass(struct rhi *rhi) {
    const VkAttachmentDescription attachments[] = {
        ATTACHMENT(rhi_vk_formats[RHI_rgba8], VK_SAMPLE_COUNT_4_BIT, CLEAR, DONT_CARE, COLOR_ATTACHMENT_OPTIMAL),
        ATTACHMENT(rhi_vk_formats[RHI_rgba8], VK_SAMPLE_COUNT_1_BIT, DONT_CARE, STORE, PRESENT_SRC_KHR),
        ATTACHMENT(rhi_vk_formats[RHI_d32], VK_SAMPLE_COUNT_4_BIT, CLEAR, DONT_CARE, DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
    };
    const VkAttachmentReference refs[] = {
        {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
    };
    const VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = refs,
        .pResolveAttachments = refs + 1,
        .pDepthStencilAttachment = &refs[2],
    };
    STRUCT(VkRenderPassCreateInfo, info);
    info.attachmentCount = 3;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    guarded(vkCreateRenderPass(rhi_get_device(rhi), &info, NULL, &rhi->pass));
    return VK_SUCCESS;
failed:
    return VK_ERROR_INITIALIZATION_FAILED;
}

RHI_EXPORT VkResult rhi_make_images(struct rhi *rhi, uint32_t w, uint32_t h) {
    static const VkImageUsageFlags usages[] = {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT};
    static const enum rhi_format formats[] = {RHI_rgba8, RHI_d32};
    foreach (i, 2) {
        STRUCT(VkImageCreateInfo, info);
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = rhi_vk_formats[formats[i]];
        info.extent = (VkExtent3D){w, h, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = rhi_get_samples(rhi);
        info.usage = usages[i] | (rhi_get_samples(rhi) > 1 ? VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT : 0);
        guarded(vkCreateImage(rhi->device, &info, NULL, &rhi->images[i]));
    }
    return VK_SUCCESS;
failed:
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

END_C_DECLS
