// The forward pass keeps the defaults, so samples that are resolved, and depth, are stored.
#include "config.h"

VkRenderPass createForwardPass(VkDevice device) {
    std::vector<AttachmentConfig> attachments;
    attachments.resize(2);
    attachments[0] = AttachmentConfig(Role::Color, VK_FORMAT_R8G8B8A8_UNORM, 4);  // may: MSAA201#color
    attachments[1] = AttachmentConfig(Role::Resolve, VK_FORMAT_R8G8B8A8_UNORM, 1);
    AttachmentConfig depth = AttachmentConfig(Role::Depth, VK_FORMAT_D32_SFLOAT, 4);  // may: MSAA203#depth
    attachments.push_back(depth);
    return createRenderPass(device, attachments);
}
