#ifndef REF_H
#define REF_H

#include <vulkan/vulkan.h>

typedef enum { PASS_WORLD, PASS_UI, PASS_COUNT } passType_t;

typedef struct {
    VkRenderPass pass;
    VkAttachmentLoadOp colorLoadOp;
    VkSampleCountFlagBits sampleCount;
} refPass_t;

typedef struct {
    VkImage image;
    VkImageView view;
    VkFormat format;
    VkSampleCountFlagBits sampleCount;
    uint32_t mipLevels;
} refTexture_t;

#define REF_TEXTURE_INIT                      \
    {                                         \
        .image = VK_NULL_HANDLE,              \
        .view = VK_NULL_HANDLE,               \
        .format = VK_FORMAT_R8G8B8A8_UNORM,   \
        .sampleCount = VK_SAMPLE_COUNT_1_BIT, \
        .mipLevels = 1,                       \
    }
#define REF_CLEAR_TEXTURE(t)                      \
    {                                             \
        (t).image = VK_NULL_HANDLE;               \
        (t).sampleCount = VK_SAMPLE_COUNT_1_BIT;  \
        (t).mipLevels = 1;                        \
    }

extern VkDevice ref_device;
extern VkFormat ref_format;
extern refPass_t ref_passes[PASS_COUNT];

void Ref_CreateColorBuffer(VkSampleCountFlagBits sampleCount, refTexture_t *texture, int extraFlags);
void Ref_CreateDepthBuffer(VkSampleCountFlagBits sampleCount, refTexture_t *texture);

#endif
