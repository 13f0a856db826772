// Values that hang together: where there are many samples nothing is stored, where there is one it is. No combination of the two is wrong.
#include <vulkan/vulkan.h>

#include <array>
#include <utility>
#include <vector>

struct Mode {
    const char* name;
    VkSampleCountFlagBits samples;
    VkAttachmentStoreOp store;
    VkImageUsageFlags usage;
};

static const Mode kModes[] = {
    {"off", VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT},
    {"4x", VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_DONT_CARE,
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT},
};

class Renderer {
public:
    explicit Renderer(VkDevice device) : device_(device) {}
    virtual ~Renderer() = default;

    void setMsaa(bool on) {
        if (on) {
            samples_ = VK_SAMPLE_COUNT_4_BIT;
            store_ = VK_ATTACHMENT_STORE_OP_DONT_CARE;
            usage_ = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        } else {
            samples_ = VK_SAMPLE_COUNT_1_BIT;
            store_ = VK_ATTACHMENT_STORE_OP_STORE;
            usage_ = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        }
    }

    VkImage image(VkExtent2D size) const { return image(size, samples_, usage_); }
    VkImage image(VkExtent2D size, const Mode& mode) const { return image(size, mode.samples, mode.usage); }

    VkRenderPass pass(VkFormat format) const { return pass(format, samples_, store_); }
    VkRenderPass pass(VkFormat format, int mode) const { return pass(format, kModes[mode].samples, kModes[mode].store); }
    VkRenderPass pass(VkFormat format, std::pair<VkSampleCountFlagBits, VkAttachmentStoreOp> both) const {
        const auto [samples, store] = both;
        return pass(format, samples, store);
    }

    // A pass that goes on and one that begins: what is loaded has a layout, what is cleared has none.
    VkRenderPass overlay(VkFormat format, bool clear) const {
        VkAttachmentDescription color{};
        color.format = format;
        color.samples = VK_SAMPLE_COUNT_1_BIT;
        color.loadOp = clear ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        color.initialLayout = clear ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        if (!clear) {
            color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
            color.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        }
        return create({color}, false);
    }

protected:
    virtual VkSampleCountFlagBits defaultSamples() const { return VK_SAMPLE_COUNT_4_BIT; }

    VkRenderPass pass(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentStoreOp store) const {
        VkAttachmentDescription color{};
        color.format = format;
        color.samples = samples;
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        color.storeOp = store;
        color.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        if (samples == VK_SAMPLE_COUNT_1_BIT) return create({color}, false);
        VkAttachmentDescription resolve = color;
        resolve.samples = VK_SAMPLE_COUNT_1_BIT;
        resolve.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        resolve.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        return create({color, resolve}, true);
    }

    VkRenderPass create(const std::vector<VkAttachmentDescription>& attachments, bool resolves) const {
        const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        const VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass{};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        if (resolves) subpass.pResolveAttachments = &resolve;
        VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.attachmentCount = static_cast<uint32_t>(attachments.size());
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        VkRenderPass made{};
        vkCreateRenderPass(device_, &info, nullptr, &made);
        return made;
    }

    VkImage image(VkExtent2D size, VkSampleCountFlagBits samples, VkImageUsageFlags usage) const {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        VkImage made{};
        vkCreateImage(device_, &info, nullptr, &made);
        return made;
    }

    VkDevice device_;
    VkSampleCountFlagBits samples_ = VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentStoreOp store_ = VK_ATTACHMENT_STORE_OP_STORE;
    VkImageUsageFlags usage_ = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
};

class FlatRenderer : public Renderer {
public:
    using Renderer::Renderer;
    VkRenderPass plain(VkFormat format) const {
        VkAttachmentDescription color{};
        color.format = format;
        color.samples = defaultSamples();
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        return create({color}, false);
    }

protected:
    VkSampleCountFlagBits defaultSamples() const override { return VK_SAMPLE_COUNT_1_BIT; }
};
