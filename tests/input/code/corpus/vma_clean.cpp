// The memory allocator with preferred flags and a helper of one's own; right in every call.
#include <vulkan/vulkan.h>

#include <functional>
#include <utility>
#include <vector>

#include "vk_mem_alloc.h"

struct DeletionQueue {
    std::vector<std::function<void()>> deletors;
    void push(std::function<void()>&& function) { deletors.push_back(std::move(function)); }
};

struct ImageDescription {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent3D extent{1, 1, 1};
    VkImageUsageFlags usage = 0;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool transient = false;
};

class Allocator {
public:
    explicit Allocator(VmaAllocator vma) : vma(vma) {}

    std::pair<VkImage, VmaAllocation> make(const ImageDescription& d) {
        VkImageCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = d.format;
        info.extent = d.extent;
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = d.samples;
        info.usage = d.usage;
        VmaAllocationCreateInfo allocation = {};
        allocation.usage = VMA_MEMORY_USAGE_AUTO;
        if (d.transient) {
            info.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
            allocation.preferredFlags = VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
        }
        std::pair<VkImage, VmaAllocation> made{};
        vmaCreateImage(vma, &info, &allocation, &made.first, &made.second, nullptr);
        queue.push([vma = vma, made] { vmaDestroyImage(vma, made.first, made.second); });
        return made;
    }

private:
    VmaAllocator vma;
    DeletionQueue queue;
};

struct SceneImages {
    std::pair<VkImage, VmaAllocation> color, depth, resolved, shadows;
};

SceneImages makeScene(Allocator& allocator, VkExtent2D size) {
    const VkExtent3D extent{size.width, size.height, 1};
    SceneImages images;
    images.color = allocator.make({VK_FORMAT_R8G8B8A8_SRGB, extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT, true});
    images.depth = allocator.make({.format = VK_FORMAT_D32_SFLOAT,
                                   .extent = extent,
                                   .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                   .samples = VK_SAMPLE_COUNT_4_BIT,
                                   .transient = true});
    images.resolved = allocator.make({VK_FORMAT_R8G8B8A8_SRGB, extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    ImageDescription shadows;
    shadows.format = VK_FORMAT_D16_UNORM;
    shadows.extent = {1024, 1024, 1};
    shadows.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    images.shadows = allocator.make(shadows);
    return images;
}
