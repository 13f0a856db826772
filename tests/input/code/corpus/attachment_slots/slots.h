// An attachment and its reference, made by a constructor with all operations as arguments.
#pragma once

#include <array>
#include <span>
#include <vector>
#include <vulkan/vulkan.hpp>

namespace graphics {

struct AttachmentSlot {
    AttachmentSlot(uint32_t index, vk::Format format, vk::ImageLayout finalLayout, vk::AttachmentLoadOp loadOp,
                   vk::AttachmentStoreOp storeOp, vk::SampleCountFlagBits samples);

    vk::AttachmentDescription description;
    vk::AttachmentReference reference;
};

struct Subpass {
    Subpass(const AttachmentSlot& color, const AttachmentSlot& resolve);

    vk::SubpassDescription description;
};

class RenderPass {
public:
    RenderPass(vk::Device device, std::span<const AttachmentSlot> slots, std::span<const Subpass> subpasses);

private:
    vk::UniqueRenderPass m_pass;
};

}  // namespace graphics
