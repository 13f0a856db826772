// Commands that resolve where a pass cannot: a picture of somebody else, an atlas in parts, a screenshot on demand.
#include <vulkan/vulkan.h>

#include <functional>
#include <vector>

struct Region {
    VkOffset3D at;
    VkExtent3D size;
};

class Resolver {
public:
    explicit Resolver(VkDevice device) : device(device) {}

    // Source and target are the caller's: who drew them is not known.
    void resolve(VkCommandBuffer cmd, VkImage source, VkImage target, VkExtent3D size) const {
        VkImageResolve whole{};
        whole.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        whole.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        whole.extent = size;
        vkCmdResolveImage(cmd, source, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
    }

    void resolveParts(VkCommandBuffer cmd, VkImage atlas, VkImage target, const std::vector<Region>& parts) const {
        std::vector<VkImageResolve2> regions;
        for (const Region& part : parts) {
            VkImageResolve2 region{VK_STRUCTURE_TYPE_IMAGE_RESOLVE_2};
            region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
            region.srcOffset = part.at;
            region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
            region.dstOffset = part.at;
            region.extent = part.size;
            regions.push_back(region);
        }
        VkResolveImageInfo2 info{VK_STRUCTURE_TYPE_RESOLVE_IMAGE_INFO_2};
        info.srcImage = atlas;
        info.srcImageLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
        info.dstImage = target;
        info.dstImageLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        info.regionCount = static_cast<uint32_t>(regions.size());
        info.pRegions = regions.data();
        vkCmdResolveImage2(cmd, &info);
    }

    VkImage makeAtlas(uint32_t size) const {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.extent = {size, size, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_4_BIT;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        VkImage image{};
        vkCreateImage(device, &info, nullptr, &image);
        return image;
    }

private:
    VkDevice device;
};

class Screenshot {
public:
    std::function<void()> done;
    bool wanted = false;

    void afterFrame(VkCommandBuffer cmd, const Resolver& resolver, VkImage frame, VkImage copy, VkExtent2D size) {
        if (!wanted) return;
        resolver.resolve(cmd, frame, copy, {size.width, size.height, 1});
        wanted = false;
        if (done) done();
    }
};
