// An engine's module: macros of headers that are not here stand before, in, and after its declarations.
module;
#include <vulkan/vulkan.hpp>
export module engine.render;

import std;

ENGINE_BEGIN_NAMESPACE(render)

export class ENGINE_API Renderer final : public RefCounted<Renderer> {
    GENERATED_BODY()
    OBJECT_TYPE
public:
    ENGINE_API explicit Renderer(vk::Device device) noexcept;
    static VKAPI_ATTR vk::Bool32 VKAPI_CALL onMessage(vk::DebugUtilsMessageSeverityFlagBitsEXT severity, void* data) { return VK_FALSE; }
    DECLARE_DELEGATE(Renderer, resized)
    ENGINE_NODISCARD vk::RenderPass createPass(vk::Format format) const ENGINE_NOEXCEPT {
        const vk::AttachmentDescription color(vk::AttachmentDescriptionFlags(), format, vk::SampleCountFlagBits::e4,
                                              vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,  // expect: MSAA201
                                              vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                              vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral);
        const vk::AttachmentDescription resolve(vk::AttachmentDescriptionFlags(), format, vk::SampleCountFlagBits::e1,
                                                vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore,
                                                vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
                                                vk::ImageLayout::eUndefined, vk::ImageLayout::eGeneral);
        const std::array<vk::AttachmentDescription, 2> attachments{color, resolve};
        vk::AttachmentReference colorReference(0, vk::ImageLayout::eGeneral), resolveReference(1, vk::ImageLayout::eGeneral);
        vk::SubpassDescription subpass;
        subpass.setColorAttachmentCount(1).setPColorAttachments(&colorReference).setPResolveAttachments(&resolveReference);
        return m_device.createRenderPass(vk::RenderPassCreateInfo({}, attachments, subpass));
    }

private:
    vk::Device m_device;
};

// The same without a mistake.
ENGINE_API vk::RenderPass ENGINE_CALL createCleanPass(vk::Device device, vk::Format format) ENGINE_REQUIRES(device) {
    const vk::AttachmentDescription color(vk::AttachmentDescriptionFlags(), format, vk::SampleCountFlagBits::e4,
                                          vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eDontCare,
                                          vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare, vk::ImageLayout::eUndefined,
                                          vk::ImageLayout::eGeneral);
    const vk::AttachmentDescription resolve(vk::AttachmentDescriptionFlags(), format, vk::SampleCountFlagBits::e1,
                                            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eStore,
                                            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare, vk::ImageLayout::eUndefined,
                                            vk::ImageLayout::eGeneral);
    const std::array<vk::AttachmentDescription, 2> attachments{color, resolve};
    vk::AttachmentReference colorReference(0, vk::ImageLayout::eGeneral), resolveReference(1, vk::ImageLayout::eGeneral);
    vk::SubpassDescription subpass;
    subpass.setColorAttachmentCount(1).setPColorAttachments(&colorReference).setPResolveAttachments(&resolveReference);
    return device.createRenderPass(vk::RenderPassCreateInfo({}, attachments, subpass));
}

ENGINE_END_NAMESPACE
