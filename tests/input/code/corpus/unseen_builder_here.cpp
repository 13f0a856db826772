// A builder whose methods are in this file: what it builds in the end depends on all that was said to it. All that it builds is right.
#include <vulkan/vulkan.h>

#include <optional>
#include <utility>
#include <vector>

class AttachmentBuilder {
public:
    AttachmentBuilder& format(VkFormat value) { return d_.format = value, *this; }
    AttachmentBuilder& samples(unsigned count) { return d_.samples = static_cast<VkSampleCountFlagBits>(count), *this; }
    AttachmentBuilder& clear() { return d_.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR, *this; }
    AttachmentBuilder& keep(bool yes = true) {
        keep_ = yes;
        return *this;
    }
    AttachmentBuilder& layout(VkImageLayout last) {
        d_.finalLayout = last;
        return *this;
    }

    VkAttachmentDescription build() const {
        VkAttachmentDescription made = d_;
        made.storeOp = keep_.value_or(d_.samples == VK_SAMPLE_COUNT_1_BIT) ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        return made;
    }

private:
    VkAttachmentDescription d_{0,
                               VK_FORMAT_UNDEFINED,
                               VK_SAMPLE_COUNT_1_BIT,
                               VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                               VK_ATTACHMENT_STORE_OP_STORE,
                               VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                               VK_ATTACHMENT_STORE_OP_DONT_CARE,
                               VK_IMAGE_LAYOUT_UNDEFINED,
                               VK_IMAGE_LAYOUT_GENERAL};
    std::optional<bool> keep_;
};

class PassBuilder {
public:
    PassBuilder& color(VkAttachmentDescription description, std::optional<VkAttachmentDescription> resolve = {}) {
        colors_.push_back({add(description), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        resolves_.push_back({resolve ? add(*resolve) : VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        return *this;
    }

    PassBuilder& depth(VkAttachmentDescription description) {
        depth_ = VkAttachmentReference{add(description), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        return *this;
    }

    VkRenderPass build(VkDevice device) const {
        VkSubpassDescription subpass{};
        subpass.colorAttachmentCount = static_cast<uint32_t>(colors_.size());
        subpass.pColorAttachments = colors_.data();
        subpass.pResolveAttachments = resolves_.data();
        subpass.pDepthStencilAttachment = depth_ ? &*depth_ : nullptr;
        VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.attachmentCount = static_cast<uint32_t>(descriptions_.size());
        info.pAttachments = descriptions_.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        VkRenderPass pass{};
        vkCreateRenderPass(device, &info, nullptr, &pass);
        return pass;
    }

private:
    uint32_t add(VkAttachmentDescription description) {
        descriptions_.push_back(description);
        return static_cast<uint32_t>(descriptions_.size() - 1);
    }

    std::vector<VkAttachmentDescription> descriptions_;
    std::vector<VkAttachmentReference> colors_, resolves_;
    std::optional<VkAttachmentReference> depth_;
};

VkRenderPass makeScene(VkDevice device, VkFormat format) {
    return PassBuilder()
        .color(AttachmentBuilder().format(format).samples(4).clear().layout(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL).build(),
               AttachmentBuilder().format(format).layout(VK_IMAGE_LAYOUT_PRESENT_SRC_KHR).build())
        .depth(AttachmentBuilder().format(VK_FORMAT_D32_SFLOAT).samples(4).clear().keep(false).build())
        .build(device);
}

VkRenderPass makeMap(VkDevice device) {
    return PassBuilder().color(AttachmentBuilder().format(VK_FORMAT_R8_UNORM).clear().keep().build()).build(device);
}

std::pair<VkRenderPass, VkRenderPass> makeBoth(VkDevice device, VkFormat format, unsigned samples) {
    AttachmentBuilder color;
    color.format(format).samples(samples).clear();
    AttachmentBuilder once = color;
    once.samples(1);
    PassBuilder many, one;
    many.color(color.build(), samples > 1 ? std::optional(once.build()) : std::nullopt);
    one.color(once.build());
    return {many.build(device), one.build(device)};
}
