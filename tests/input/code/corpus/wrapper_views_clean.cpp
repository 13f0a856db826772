// One class wraps all images: that of the samples, that of the resolve, and that of the depth are different objects of it.
#include <vulkan/vulkan.h>

#include <memory>

class Texture {
public:
    Texture(VkDevice device, VkFormat format, VkSampleCountFlagBits count, VkImageUsageFlags usage) : device_(device) {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {640, 480, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = count;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.usage = usage;
        vkCreateImage(device_, &info, nullptr, &image_);
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image_;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        vkCreateImageView(device_, &view, nullptr, &view_);
    }
    VkImageView view() const { return view_; }
    VkImage image() const { return image_; }

private:
    VkDevice device_;
    VkImage image_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
};

struct Targets {
    std::unique_ptr<Texture> color;
    std::unique_ptr<Texture> depth;
    std::unique_ptr<Texture> resolved;
};

void begin(VkCommandBuffer commands, const Targets& targets, VkExtent2D extent) {
    VkRenderingAttachmentInfo color{};
    color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    color.imageView = targets.color->view();
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.resolved->view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = targets.depth->view();
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea.extent = extent;
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &color;
    info.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &info);
}

// The pictures that a user takes are resolved from one texture into another, both of the class.
void capture(VkCommandBuffer commands, const Texture& source, const Texture& target, VkExtent2D extent) {
    VkImageResolve region{};
    region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.extent = {extent.width, extent.height, 1};
    vkCmdResolveImage(commands, source.image(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                      &region);
}
