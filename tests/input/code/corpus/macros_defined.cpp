// An engine's backend in one file: its macros declare, initialize, name functions, and wrap calls.
#include <vulkan/vulkan.h>

#if defined(__cplusplus)
#define _RHI_STRUCT(TYPE, NAME) TYPE NAME = {}
#else
#define _RHI_STRUCT(TYPE, NAME) TYPE NAME = { 0 }
#endif

#if defined(_MSC_VER)
#define RHI_API __declspec(dllexport)
#define RHI_INLINE __forceinline
#else
#define RHI_API __attribute__((visibility("default")))
#define RHI_INLINE inline __attribute__((always_inline))
#endif

#ifndef RHI_COUNTOF
#define RHI_COUNTOF(array) (sizeof(array) / sizeof((array)[0]))
#endif

#define RHI_CAT_(a, b) a##b
#define RHI_CAT(a, b) RHI_CAT_(a, b)
#define RHI_FN(name) RHI_CAT(pfn_, name)
#define RHI_VERIFY(call)                                  \
    do {                                                  \
        VkResult result = (call);                         \
        if (result != VK_SUCCESS) {                       \
            report(__FILE__, __LINE__, #call, result);    \
            return false;                                 \
        }                                                 \
    } while (0)
#define RHI_LOG(format, ...) report(format, ##__VA_ARGS__)
#define RHI_EACH(i, count) for (uint32_t i = 0; i < (count); ++i)
#define SAMPLES_OF(n) RHI_CAT(RHI_CAT(VK_SAMPLE_COUNT_, n), _BIT)
#define COLOR_TARGET(kind, n, store)                       \
    {                                                      \
        .format = (kind),                                  \
        .samples = SAMPLES_OF(n),                          \
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,             \
        .storeOp = VK_ATTACHMENT_STORE_OP_##store,         \
        .finalLayout = VK_IMAGE_LAYOUT_GENERAL             \
    }
#define MULTISAMPLED_DEPTH(kind)                           \
    {                                                      \
        .format = (kind),                                  \
        .samples = SAMPLES_OF(4),                          \
        .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD, /* expect: MSAA202 */ \
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,       \
        .initialLayout = VK_IMAGE_LAYOUT_GENERAL,          \
        .finalLayout = VK_IMAGE_LAYOUT_GENERAL             \
    }

class RHI_API Backend final : public Base {
    RHI_INLINE VkDevice device() const { return m_device; }
    bool createPass(VkFormat format);
    bool createCleanPass(VkFormat format);
    VkDevice m_device;
    VkRenderPass m_pass, m_clean;
};

RHI_API bool Backend::createPass(VkFormat format) {
    VkAttachmentDescription attachments[] = {
        COLOR_TARGET(format, 4, STORE),  // expect: MSAA201
        COLOR_TARGET(format, 1, STORE),
        MULTISAMPLED_DEPTH(VK_FORMAT_D32_SFLOAT),
    };
    VkAttachmentReference refs[RHI_COUNTOF(attachments)];
    RHI_EACH(i, 3) {
        refs[i].attachment = i;
        refs[i].layout = VK_IMAGE_LAYOUT_GENERAL;
    }
    _RHI_STRUCT(VkSubpassDescription, subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &refs[0];
    subpass.pResolveAttachments = &refs[1];
    subpass.pDepthStencilAttachment = &refs[2];
    _RHI_STRUCT(VkRenderPassCreateInfo, info);
    info.attachmentCount = RHI_COUNTOF(attachments);
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    RHI_LOG("creating a pass");
    RHI_VERIFY(RHI_FN(vkCreateRenderPass)(device(), &info, nullptr, &m_pass));
    return true;
}

RHI_API bool Backend::createCleanPass(VkFormat format) {
    VkAttachmentDescription attachments[] = {COLOR_TARGET(format, 4, DONT_CARE), COLOR_TARGET(format, 1, STORE)};
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_GENERAL}, resolve = {1, VK_IMAGE_LAYOUT_GENERAL};
    _RHI_STRUCT(VkSubpassDescription, subpass);
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    _RHI_STRUCT(VkRenderPassCreateInfo, info);
    info.attachmentCount = RHI_COUNTOF(attachments);
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    RHI_VERIFY(RHI_FN(vkCreateRenderPass)(device(), &info, nullptr, &m_clean));
    return true;
}
