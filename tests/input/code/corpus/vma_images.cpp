// Images by the memory allocator. One of them is bound to lazily allocated memory and may not be; the others are right.
#include <vulkan/vulkan.h>

#include <initializer_list>

#include "vk_mem_alloc.h"

struct AllocatedImage {
    VkImage image = VK_NULL_HANDLE;
    VmaAllocation allocation = nullptr;
    VkFormat format{};
    VkExtent3D extent{};
};

class Targets {
public:
    Targets(VmaAllocator allocator, VkExtent2D extent) : _allocator(allocator), _extent{extent.width, extent.height, 1} {}
    void create();
    void destroy();

private:
    AllocatedImage _color, _depth, _velocity, _resolved;
    VmaAllocator _allocator;
    VkExtent3D _extent;
};

void Targets::create() {
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.extent = _extent;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;

    VmaAllocationCreateInfo lazy = {};
    lazy.usage = VMA_MEMORY_USAGE_GPU_LAZILY_ALLOCATED;  // may: MSAA405#velocity

    VmaAllocationCreateInfo local = {};
    local.usage = VMA_MEMORY_USAGE_AUTO;
    local.requiredFlags = VkMemoryPropertyFlags(VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    local.flags = VMA_ALLOCATION_CREATE_DEDICATED_MEMORY_BIT;

    info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    vmaCreateImage(_allocator, &info, &lazy, &_color.image, &_color.allocation, nullptr);

    info.format = VK_FORMAT_D32_SFLOAT;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    vmaCreateImage(_allocator, &info, &lazy, &_depth.image, &_depth.allocation, nullptr);

    info.format = VK_FORMAT_R16G16_SFLOAT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;  // expect: MSAA405#velocity  // may: MSAA401
    vmaCreateImage(_allocator, &info, &lazy, &_velocity.image, &_velocity.allocation, nullptr);  // may: MSAA405#velocity

    info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    vmaCreateImage(_allocator, &info, &local, &_resolved.image, &_resolved.allocation, nullptr);
}

void Targets::destroy() {
    for (AllocatedImage* each : {&_color, &_depth, &_velocity, &_resolved}) {
        vmaDestroyImage(_allocator, each->image, each->allocation);
        *each = {};
    }
}
