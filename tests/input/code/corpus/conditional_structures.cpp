// Whole structures that depend on a setting with a name of the engine: what resolves is the multisampled way.
#include <vulkan/vulkan.hpp>

class SceneRenderer {
public:
    void draw(vk::CommandBuffer commands);
    void drawShadows(vk::CommandBuffer commands);
    void enable(bool enabled) { smooth = enabled; }

private:
    vk::ImageView colorView, depthView, targetView, shadowView;
    bool smooth = true;
};

void SceneRenderer::draw(vk::CommandBuffer commands) {
    vk::RenderingAttachmentInfo color;
    if (smooth) {
        color = {
            .imageView = colorView,
            .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .resolveMode = vk::ResolveModeFlagBits::eAverage,
            .resolveImageView = targetView,
            .resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eStore,  // expect: MSAA201
        };
    } else {
        color = {
            .imageView = targetView,
            .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eStore,
        };
    }
    vk::RenderingInfo info = {.layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color};
    commands.beginRendering(info);
}

// One sample in both ways.
void SceneRenderer::drawShadows(vk::CommandBuffer commands) {
    vk::RenderingAttachmentInfo depth;
    if (smooth) {
        depth = {.imageView = shadowView, .loadOp = vk::AttachmentLoadOp::eClear, .storeOp = vk::AttachmentStoreOp::eStore};
    } else {
        depth = {.imageView = depthView, .loadOp = vk::AttachmentLoadOp::eLoad, .storeOp = vk::AttachmentStoreOp::eStore};
    }
    vk::RenderingInfo info = {.layerCount = 1, .pDepthAttachment = &depth};
    commands.beginRendering(info);
}
