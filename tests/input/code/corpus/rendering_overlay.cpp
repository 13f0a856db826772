// The overlay continues the scene's samples, which another file draws, and resolves where its caller wants that.
#include <vulkan/vulkan.h>

struct Target {
    VkImageView color() const;
    VkImageView resolved() const;
    VkExtent2D extent() const;
};

class Overlay {
public:
    void begin(const Target& target, bool resolve) const {
        const VkRenderingAttachmentInfo color{
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = target.color(),
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .resolveMode = resolve ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_NONE,
            .resolveImageView = resolve ? target.resolved() : VK_NULL_HANDLE,
            .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,  // expect: MSAA202
            .storeOp = resolve ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE,
        };
        VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO, .layerCount = 1, .colorAttachmentCount = 1};
        info.renderArea.extent = target.extent();
        info.pColorAttachments = &color;
        vkCmdBeginRendering(commands_, &info);
    }

private:
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};
