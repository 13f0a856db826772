/* Only what the programs of this folder call of the Vulkan Memory Allocator, so that a compiler can check them. */
#ifndef VK_MEM_ALLOC_H
#define VK_MEM_ALLOC_H
#include <vulkan/vulkan.h>
#ifdef __cplusplus
extern "C" {
#endif
typedef struct VmaAllocator_T *VmaAllocator;
typedef struct VmaAllocation_T *VmaAllocation;
typedef struct VmaPool_T *VmaPool;
typedef enum VmaMemoryUsage {
    VMA_MEMORY_USAGE_UNKNOWN = 0,
    VMA_MEMORY_USAGE_GPU_ONLY = 1,
    VMA_MEMORY_USAGE_GPU_LAZILY_ALLOCATED = 6,
    VMA_MEMORY_USAGE_AUTO = 7,
    VMA_MEMORY_USAGE_AUTO_PREFER_DEVICE = 8
} VmaMemoryUsage;
typedef enum VmaAllocationCreateFlagBits { VMA_ALLOCATION_CREATE_DEDICATED_MEMORY_BIT = 1 } VmaAllocationCreateFlagBits;
typedef struct VmaAllocationCreateInfo {
    VkFlags flags;
    VmaMemoryUsage usage;
    VkMemoryPropertyFlags requiredFlags;
    VkMemoryPropertyFlags preferredFlags;
    uint32_t memoryTypeBits;
    VmaPool pool;
    void *pUserData;
    float priority;
} VmaAllocationCreateInfo;
typedef struct VmaAllocationInfo {
    uint32_t memoryType;
    VkDeviceMemory deviceMemory;
} VmaAllocationInfo;
VkResult vmaCreateImage(VmaAllocator allocator, const VkImageCreateInfo *info, const VmaAllocationCreateInfo *allocation, VkImage *image,
                        VmaAllocation *made, VmaAllocationInfo *about);
void vmaDestroyImage(VmaAllocator allocator, VkImage image, VmaAllocation allocation);
#ifdef __cplusplus
}
#endif
#endif
