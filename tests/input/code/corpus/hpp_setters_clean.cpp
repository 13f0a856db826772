// vulkan.hpp with chained setters and `using namespace`; nothing wrong with it.
#include <vulkan/vulkan.hpp>

#include <vector>

using namespace vk;

namespace viewer {

constexpr auto kSamples = SampleCountFlagBits::e4;

UniqueImage makeTransient(Device device, Extent2D extent, Format format, ImageUsageFlags attachmentUsage) {
    auto info = ImageCreateInfo()
                    .setImageType(ImageType::e2D)
                    .setFormat(format)
                    .setExtent({extent.width, extent.height, 1})
                    .setMipLevels(1)
                    .setArrayLayers(1)
                    .setSamples(kSamples)
                    .setTiling(ImageTiling::eOptimal)
                    .setUsage(attachmentUsage | ImageUsageFlagBits::eTransientAttachment);
    return device.createImageUnique(info);
}

UniqueRenderPass makePass(Device device, Format color, Format depth) {
    const std::vector<AttachmentDescription> attachments = {
        AttachmentDescription()
            .setFormat(color)
            .setSamples(kSamples)
            .setLoadOp(AttachmentLoadOp::eClear)
            .setStoreOp(AttachmentStoreOp::eDontCare)
            .setInitialLayout(ImageLayout::eUndefined)
            .setFinalLayout(ImageLayout::eColorAttachmentOptimal),
        AttachmentDescription()
            .setFormat(depth)
            .setSamples(kSamples)
            .setLoadOp(AttachmentLoadOp::eClear)
            .setStoreOp(AttachmentStoreOp::eDontCare)
            .setStencilLoadOp(AttachmentLoadOp::eDontCare)
            .setStencilStoreOp(AttachmentStoreOp::eDontCare)
            .setInitialLayout(ImageLayout::eUndefined)
            .setFinalLayout(ImageLayout::eDepthStencilAttachmentOptimal),
        AttachmentDescription()
            .setFormat(color)
            .setSamples(SampleCountFlagBits::e1)
            .setLoadOp(AttachmentLoadOp::eDontCare)
            .setStoreOp(AttachmentStoreOp::eStore)
            .setInitialLayout(ImageLayout::eUndefined)
            .setFinalLayout(ImageLayout::ePresentSrcKHR),
    };
    AttachmentReference colorReference{0, ImageLayout::eColorAttachmentOptimal};
    AttachmentReference depthReference{1, ImageLayout::eDepthStencilAttachmentOptimal};
    AttachmentReference resolveReference{2, ImageLayout::eColorAttachmentOptimal};
    auto subpass = SubpassDescription()
                       .setPipelineBindPoint(PipelineBindPoint::eGraphics)
                       .setColorAttachments(colorReference)
                       .setResolveAttachments(resolveReference)
                       .setPDepthStencilAttachment(&depthReference);
    auto info = RenderPassCreateInfo().setAttachments(attachments).setSubpasses(subpass);
    return device.createRenderPassUnique(info);
}

UniquePipeline makePipeline(Device device, RenderPass pass, PipelineLayout layout, bool foliage) {
    auto multisample = PipelineMultisampleStateCreateInfo().setRasterizationSamples(kSamples).setAlphaToCoverageEnable(foliage);
    auto info = GraphicsPipelineCreateInfo().setRenderPass(pass).setLayout(layout).setPMultisampleState(&multisample);
    return device.createGraphicsPipelineUnique({}, info).value;
}

struct Targets {
    UniqueImage color, depth;
    UniqueRenderPass pass;
};

Targets make(Device device, Extent2D extent) {
    Targets targets;
    targets.color = makeTransient(device, extent, Format::eB8G8R8A8Srgb, ImageUsageFlagBits::eColorAttachment);
    targets.depth = makeTransient(device, extent, Format::eD24UnormS8Uint, ImageUsageFlagBits::eDepthStencilAttachment);
    targets.pass = makePass(device, Format::eB8G8R8A8Srgb, Format::eD24UnormS8Uint);
    return targets;
}

}  // namespace viewer
