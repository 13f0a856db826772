#include "framebuffer.hpp"

// Another sample of the library, with one sample per pixel: nothing to report.
class ShadowMap {
public:
    void prepare(VkDevice device) {
        map.device = device;
        base::AttachmentInfo info{};
        info.width = 1024;
        info.height = 1024;
        info.format = VK_FORMAT_D16_UNORM;
        info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        map.addAttachment(info);
        map.createRenderPass();
    }

private:
    base::Framebuffer map;
};
