// The pass of the scene: its samples are resolved, and stored as well.
#include "slots.h"

namespace graphics {

RenderPass makeScenePass(vk::Device device, vk::Format format) {
    const auto slots = std::array<AttachmentSlot, 2>{
        AttachmentSlot{
            0,
            format,
            vk::ImageLayout::eColorAttachmentOptimal,
            vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore,  // expect: MSAA201
            vk::SampleCountFlagBits::e4,
        },
        AttachmentSlot{
            1,
            format,
            vk::ImageLayout::ePresentSrcKHR,
            vk::AttachmentLoadOp::eDontCare,
            vk::AttachmentStoreOp::eStore,
            vk::SampleCountFlagBits::e1,
        },
    };
    const auto subpasses = std::array<Subpass, 1>{Subpass{slots[0], slots[1]}};
    return RenderPass(device, slots, subpasses);
}

}  // namespace graphics
