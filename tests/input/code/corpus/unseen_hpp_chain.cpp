// vulkan.hpp of another taste: structure chains, render pass 2, auto everywhere, a namespace alias, aggregates without names.
#include <vulkan/vulkan.hpp>

#include <array>
#include <tuple>

namespace v = vk;
using Samples = vk::SampleCountFlagBits;

constexpr auto msaa = Samples::e4;

struct Pass2 {
    v::Device device;
    v::RenderPass handle;

    void create(v::Format color, v::Format depth) {
        const auto attachments = std::to_array<v::AttachmentDescription2>({
            {{}, color, msaa, v::AttachmentLoadOp::eClear, v::AttachmentStoreOp::eDontCare, v::AttachmentLoadOp::eDontCare,
             v::AttachmentStoreOp::eDontCare, v::ImageLayout::eUndefined, v::ImageLayout::eColorAttachmentOptimal},
            {{}, color, Samples::e1, v::AttachmentLoadOp::eLoad,  // expect: MSAA205
             v::AttachmentStoreOp::eStore, v::AttachmentLoadOp::eDontCare, v::AttachmentStoreOp::eDontCare,
             v::ImageLayout::eColorAttachmentOptimal, v::ImageLayout::eShaderReadOnlyOptimal},
            {{}, depth, msaa, v::AttachmentLoadOp::eClear, v::AttachmentStoreOp::eDontCare, v::AttachmentLoadOp::eDontCare,
             v::AttachmentStoreOp::eDontCare, v::ImageLayout::eUndefined, v::ImageLayout::eDepthStencilAttachmentOptimal},
            {{}, depth, Samples::e1, v::AttachmentLoadOp::eDontCare, v::AttachmentStoreOp::eStore, v::AttachmentLoadOp::eDontCare,
             v::AttachmentStoreOp::eDontCare, v::ImageLayout::eUndefined, v::ImageLayout::eDepthStencilReadOnlyOptimal},
        });
        const v::AttachmentReference2 colorRef{0, v::ImageLayout::eColorAttachmentOptimal, v::ImageAspectFlagBits::eColor};
        const v::AttachmentReference2 resolveRef{1, v::ImageLayout::eColorAttachmentOptimal, v::ImageAspectFlagBits::eColor};
        const v::AttachmentReference2 depthRef{2, v::ImageLayout::eDepthStencilAttachmentOptimal, v::ImageAspectFlagBits::eDepth};
        const v::AttachmentReference2 depthResolveRef{3, v::ImageLayout::eDepthStencilAttachmentOptimal, v::ImageAspectFlagBits::eDepth};
        v::StructureChain<v::SubpassDescription2, v::SubpassDescriptionDepthStencilResolve> subpass{
            v::SubpassDescription2{}
                .setPipelineBindPoint(v::PipelineBindPoint::eGraphics)
                .setColorAttachments(colorRef)
                .setResolveAttachments(resolveRef)
                .setPDepthStencilAttachment(&depthRef),
            v::SubpassDescriptionDepthStencilResolve{v::ResolveModeFlagBits::eAverage,  // expect: MSAA703
                                                     v::ResolveModeFlagBits::eNone, &depthResolveRef},
        };
        handle = device.createRenderPass2(v::RenderPassCreateInfo2{}.setAttachments(attachments).setSubpasses(subpass.get()));
    }
};

struct Images {
    v::Device device;
    v::Extent3D extent;

    auto operator()(v::Format format, v::ImageUsageFlags usage, Samples samples = Samples::e1) const {
        return device.createImage({{}, v::ImageType::e2D, format, extent, 1, 1, samples, v::ImageTiling::eOptimal, usage});
    }

    auto all() const {
        using enum v::ImageUsageFlagBits;
        return std::make_tuple((*this)(v::Format::eR8G8B8A8Unorm, eColorAttachment | eTransientAttachment, msaa),
                               (*this)(v::Format::eD32Sfloat, eDepthStencilAttachment | eTransientAttachment, msaa),
                               (*this)(v::Format::eR8G8B8A8Unorm, eColorAttachment | eSampled),
                               (*this)(v::Format::eR32Uint, eColorAttachment | eTransientAttachment,
                                       msaa));  // may: MSAA108
    }
};

auto sampleShading(float fraction) {
    return v::PipelineMultisampleStateCreateInfo{{}, msaa, true, fraction};  // may: MSAA502#fifth
}

auto pipelines(v::Device device, v::PipelineLayout layout, v::RenderPass pass) {
    const v::PipelineMultisampleStateCreateInfo coverage{{}, Samples::e1, false, 0.0f, nullptr, true};  // expect: MSAA505
    auto info = v::GraphicsPipelineCreateInfo{}.setPMultisampleState(&coverage).setLayout(layout).setRenderPass(pass);
    auto first = device.createGraphicsPipeline({}, info).value;
    const auto fifth = sampleShading(0.2f);  // expect: MSAA502#fifth
    info.setPMultisampleState(&fifth);
    return std::make_pair(first, device.createGraphicsPipeline({}, info).value);
}
