// Attachments as a renderer's own structure, with operations by default.
#pragma once

#include <cstdint>
#include <vector>
#include <vulkan/vulkan.h>

enum LoadOp { LOAD_OP_LOAD, LOAD_OP_CLEAR, LOAD_OP_DONT_CARE };
enum StoreOp { STORE_OP_STORE, STORE_OP_DONT_CARE };
enum class Role { Color, Depth, Resolve };

struct AttachmentConfig {
    Role role = Role::Color;
    VkFormat format = VK_FORMAT_UNDEFINED;
    uint16_t samples = 1;
    LoadOp loadOp = LOAD_OP_CLEAR;
    StoreOp storeOp = STORE_OP_STORE;  // expect: MSAA201#color

    AttachmentConfig() = default;
    AttachmentConfig(Role role_, VkFormat format_, uint16_t samples_) : role(role_), format(format_), samples(samples_) {}
};

namespace translate {
VkAttachmentLoadOp get(LoadOp op);
VkAttachmentStoreOp get(StoreOp op);
}  // namespace translate

VkRenderPass createRenderPass(VkDevice device, const std::vector<AttachmentConfig>& attachments);
