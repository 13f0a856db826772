// Usage put together bit by bit under conditions, as emulators and engines do: what an image ends up with depends on the caller.
#include <vulkan/vulkan.h>

#include <cassert>

enum TextureFlags : uint32_t {
    TEX_RENDER_TARGET = 1 << 0,
    TEX_DEPTH_STENCIL = 1 << 1,
    TEX_SAMPLED = 1 << 2,
    TEX_STORAGE = 1 << 3,
    TEX_TRANSIENT = 1 << 4,
    TEX_READBACK = 1 << 5,
};

struct Texture {
    VkImage image;
    VkFormat format;
    VkSampleCountFlagBits samples;
};

static VkSampleCountFlagBits sampleCount(int level) {
    switch (level) {
    case 2: return VK_SAMPLE_COUNT_2_BIT;
    case 4: return VK_SAMPLE_COUNT_4_BIT;
    case 8: return VK_SAMPLE_COUNT_8_BIT;
    default: return VK_SAMPLE_COUNT_1_BIT;
    }
}

bool createTexture(VkDevice device, Texture& texture, VkFormat format, uint32_t w, uint32_t h, uint32_t flags, int msaaLevel) {
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format;
    create.extent = {w, h, 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = sampleCount(msaaLevel);
    create.tiling = VK_IMAGE_TILING_OPTIMAL;
    create.usage = 0;
    if (flags & TEX_RENDER_TARGET) create.usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (flags & TEX_DEPTH_STENCIL) create.usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (flags & TEX_SAMPLED) create.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (flags & TEX_STORAGE) create.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    if (flags & TEX_READBACK) create.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (flags & TEX_TRANSIENT) {
        assert(!(flags & (TEX_SAMPLED | TEX_STORAGE | TEX_READBACK)));
        create.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    }
    texture.format = format;
    texture.samples = create.samples;
    return vkCreateImage(device, &create, nullptr, &texture.image) == VK_SUCCESS;
}

bool createFramebufferTextures(VkDevice device, uint32_t w, uint32_t h, int msaaLevel, bool copyable, Texture* out) {
    VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = VK_FORMAT_R8G8B8A8_UNORM;
    create.extent = {w, h, 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = VK_SAMPLE_COUNT_4_BIT;
    create.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (copyable) {
        create.usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    } else {
        create.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    }
    if (vkCreateImage(device, &create, nullptr, &out[0].image) != VK_SUCCESS) return false;

    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage &= ~VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    create.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    return vkCreateImage(device, &create, nullptr, &out[1].image) == VK_SUCCESS &&
           createTexture(device, out[2], VK_FORMAT_D24_UNORM_S8_UINT, w, h, TEX_DEPTH_STENCIL | TEX_TRANSIENT, msaaLevel);
}
