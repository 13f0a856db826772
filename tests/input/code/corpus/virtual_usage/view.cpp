// With several samples, the window is the resolve target, and it is not stored.
#include <vector>

#include "image.h"

class View {
public:
    void create(vk::Device device);
    void createPass(vk::Device device);
    void createFramebuffer(vk::Device device, vk::ImageView window);

private:
    Settings _settings;
    MultisampledImage _color;
    DepthImage _depth;
    vk::RenderPass _pass;
    vk::Framebuffer _framebuffer;
};

void View::create(vk::Device device) {
    _color.create(device, _settings);
    _depth.create(device, _settings);
}

void View::createPass(vk::Device device) {
    const auto samples = _settings.sampleCount();
    const bool multisampled = _settings.multisamplingSupported();
    std::vector<vk::AttachmentDescription> descriptions;
    std::vector<vk::AttachmentReference> references, resolves;
    descriptions.emplace_back()
        .setFormat(vk::Format::eB8G8R8A8Srgb)
        .setSamples(samples)
        .setLoadOp(vk::AttachmentLoadOp::eClear)
        .setStoreOp(multisampled ? vk::AttachmentStoreOp::eDontCare : vk::AttachmentStoreOp::eStore)
        .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
        .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare);
    references.push_back(vk::AttachmentReference(0, vk::ImageLayout::eColorAttachmentOptimal));
    descriptions.emplace_back()
        .setFormat(vk::Format::eD32Sfloat)
        .setSamples(samples)
        .setLoadOp(vk::AttachmentLoadOp::eClear)
        .setStoreOp(vk::AttachmentStoreOp::eDontCare)
        .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
        .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare);
    references.push_back(vk::AttachmentReference(1, vk::ImageLayout::eDepthStencilAttachmentOptimal));
    if (multisampled) {
        descriptions.emplace_back()
            .setFormat(vk::Format::eB8G8R8A8Srgb)
            .setSamples(vk::SampleCountFlagBits::e1)
            .setLoadOp(vk::AttachmentLoadOp::eDontCare)
            .setStoreOp(vk::AttachmentStoreOp::eDontCare)  // expect: MSAA206
            .setStencilLoadOp(vk::AttachmentLoadOp::eDontCare)
            .setStencilStoreOp(vk::AttachmentStoreOp::eDontCare);
        resolves.push_back(vk::AttachmentReference(2, vk::ImageLayout::eColorAttachmentOptimal));
    }
    const auto subpass = vk::SubpassDescription()
                             .setPipelineBindPoint(vk::PipelineBindPoint::eGraphics)
                             .setColorAttachments({1, &references[0]})
                             .setPDepthStencilAttachment(&references[1])
                             .setPResolveAttachments(resolves.data());
    _pass = device.createRenderPass(vk::RenderPassCreateInfo().setAttachments(descriptions).setSubpasses({1, &subpass}));
}

void View::createFramebuffer(vk::Device device, vk::ImageView window) {
    std::vector<vk::ImageView> views;
    if (_settings.sampleCount() != vk::SampleCountFlagBits::e1) {
        views.push_back(_color.view());
        views.push_back(_depth.view());
        views.push_back(window);
    } else {
        views.push_back(window);
        views.push_back(_depth.view());
    }
    _framebuffer = device.createFramebuffer(vk::FramebufferCreateInfo().setRenderPass(_pass).setAttachments(views).setWidth(640).setHeight(480).setLayers(1));
}
