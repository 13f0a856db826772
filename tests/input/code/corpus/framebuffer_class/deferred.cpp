#include "framebuffer.hpp"

// The samples of the three color attachments are read by the shader of the next pass; those of the depth are read by nothing.
class Deferred {
public:
    void prepare(VkDevice device) {
        targets.device = device;
        base::AttachmentInfo info{};
        info.width = 2048;
        info.height = 2048;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        info.count = samples;

        info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
        targets.addAttachment(info);
        targets.addAttachment(info);
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        targets.addAttachment(info);

        info.format = VK_FORMAT_D32_SFLOAT;
        info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;  // expect: MSAA401
        targets.addAttachment(info);
        targets.createRenderPass();
    }

    VkDescriptorImageInfo albedo(VkSampler sampler) const {
        return {sampler, targets.attachments[2].view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }

private:
    const VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
    base::Framebuffer targets;
};
