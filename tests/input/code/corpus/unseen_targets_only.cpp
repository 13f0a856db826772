// The file of a program in which targets are made; the passes that draw to them, load them or keep their samples are in others. Nothing can be said.
#include <vulkan/vulkan.h>

#include <map>
#include <string>

class Targets {
public:
    explicit Targets(VkDevice device) : device(device) {}

    void create(VkExtent2D size) {
        add("gbuffer.albedo", VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, size, VK_SAMPLE_COUNT_4_BIT);
        add("accumulation", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, size, VK_SAMPLE_COUNT_4_BIT);
        add("depth", VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, size, VK_SAMPLE_COUNT_4_BIT);
        add("resolved", VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, size);
    }

    VkImage find(const std::string& name) const {
        const auto found = images.find(name);
        return found == images.end() ? VK_NULL_HANDLE : found->second;
    }

private:
    void add(const std::string& name, VkFormat format, VkImageUsageFlags usage, VkExtent2D size,
             VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT) {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        vkCreateImage(device, &info, nullptr, &images[name]);
    }

    VkDevice device;
    std::map<std::string, VkImage> images;
};

// A depth buffer that a prepass of another file fills and the passes of two others load.
VkImage createSharedDepth(VkDevice device, VkExtent2D size, VkSampleCountFlagBits samples) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_D32_SFLOAT;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = samples;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    VkImage image{};
    vkCreateImage(device, &info, nullptr, &image);
    return image;
}
