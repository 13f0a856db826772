// One function for every image, with defaulted parameters and an overload; all of its calls are as they should be.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <utility>

namespace gfx {

struct Context {
    VkPhysicalDevice gpu;
    VkDevice device;
};

uint32_t memoryType(const Context& context, uint32_t bits, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags fallback);

std::pair<VkImage, VkDeviceMemory> createImage(const Context& context, VkExtent2D size, VkFormat format, VkImageUsageFlags usage,
                                               VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT, uint32_t mips = 1,
                                               VkMemoryPropertyFlags memory = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) {
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = mips;
    info.arrayLayers = 1;
    info.samples = samples;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    std::pair<VkImage, VkDeviceMemory> made{};
    vkCreateImage(context.device, &info, nullptr, &made.first);

    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(context.device, made.first, &needs);
    VkMemoryAllocateInfo allocation = {};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = needs.size;
    allocation.memoryTypeIndex = memoryType(context, needs.memoryTypeBits, memory, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    vkAllocateMemory(context.device, &allocation, nullptr, &made.second);
    vkBindImageMemory(context.device, made.first, made.second, 0);
    return made;
}

// The overload for cubes: never multisampled.
std::pair<VkImage, VkDeviceMemory> createImage(const Context& context, uint32_t edge, VkFormat format, uint32_t mips) {
    VkImageCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.flags = VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {edge, edge, 1};
    info.mipLevels = mips;
    info.arrayLayers = 6;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    std::pair<VkImage, VkDeviceMemory> made{};
    vkCreateImage(context.device, &info, nullptr, &made.first);
    return made;
}

struct Frame {
    std::pair<VkImage, VkDeviceMemory> color, depth, shadow, sky, albedo, scene;
};

Frame createFrame(const Context& context, VkExtent2D size) {
    Frame frame;
    frame.color = createImage(context, size, VK_FORMAT_R8G8B8A8_UNORM,
                              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT, 1,
                              VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT);
    frame.depth = createImage(context, size, VK_FORMAT_D32_SFLOAT,
                              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT,
                              1, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT);
    frame.shadow = createImage(context, {2048, 2048}, VK_FORMAT_D16_UNORM,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    frame.scene = createImage(context, size, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    frame.sky = createImage(context, 512, VK_FORMAT_R16G16B16A16_SFLOAT, 10);
    frame.albedo = createImage(context, {1024, 1024}, VK_FORMAT_R8G8B8A8_SRGB,
                               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_SAMPLE_COUNT_1_BIT, 11);
    return frame;
}

}  // namespace gfx
