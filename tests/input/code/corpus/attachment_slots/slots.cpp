#include "slots.h"

#include <algorithm>

namespace {

auto describeSubpass(const graphics::AttachmentSlot& color, const graphics::AttachmentSlot& resolve) -> vk::SubpassDescription {
    return vk::SubpassDescription{vk::SubpassDescriptionFlags{}, vk::PipelineBindPoint::eGraphics, 0u, nullptr, 1u, &color.reference,
                                  &resolve.reference, nullptr};
}

auto descriptions(std::span<const graphics::AttachmentSlot> slots) -> std::vector<vk::AttachmentDescription> {
    auto out = std::vector<vk::AttachmentDescription>{};
    out.reserve(slots.size());
    std::ranges::transform(slots, std::back_inserter(out), [](const auto& slot) { return slot.description; });
    return out;
}

}  // namespace

namespace graphics {

AttachmentSlot::AttachmentSlot(uint32_t index, vk::Format format, vk::ImageLayout finalLayout, vk::AttachmentLoadOp loadOp,
                               vk::AttachmentStoreOp storeOp, vk::SampleCountFlagBits samples)
    : description{vk::AttachmentDescription{vk::AttachmentDescriptionFlags{}, format, samples, loadOp, storeOp,
                                            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                            vk::ImageLayout::eUndefined, finalLayout}},
      reference{vk::AttachmentReference{index, vk::ImageLayout::eColorAttachmentOptimal}} {}

Subpass::Subpass(const AttachmentSlot& color, const AttachmentSlot& resolve) : description{describeSubpass(color, resolve)} {}

RenderPass::RenderPass(vk::Device device, std::span<const AttachmentSlot> slots, std::span<const Subpass> subpasses) {
    const auto attachments = descriptions(slots);
    auto described = std::vector<vk::SubpassDescription>{};
    for (const auto& subpass : subpasses)
        described.push_back(subpass.description);
    auto info = vk::RenderPassCreateInfo{};
    info.setAttachmentCount(static_cast<uint32_t>(attachments.size()));
    info.setPAttachments(attachments.data());
    info.setSubpassCount(static_cast<uint32_t>(described.size()));
    info.setPSubpasses(described.data());
    m_pass = device.createRenderPassUnique(info);
}

}  // namespace graphics
