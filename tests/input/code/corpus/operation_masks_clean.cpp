// Operations come from masks of the caller, and what is transient is never stored or loaded. Nothing is wrong.
#include <algorithm>
#include <vector>
#include <vulkan/vulkan.h>

enum class Domain { Physical, Transient };

struct ImageCreateInfo {
    Domain domain = Domain::Physical;
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;

    static ImageCreateInfo transientTarget(VkFormat format, VkSampleCountFlagBits samples) {
        ImageCreateInfo info;
        info.domain = Domain::Transient;
        info.format = format;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
        info.samples = samples;
        return info;
    }
};

class Image {
public:
    explicit Image(const ImageCreateInfo& info) : info_(info) {}
    const ImageCreateInfo& info() const { return info_; }

private:
    ImageCreateInfo info_;
};

struct PassInfo {
    const Image* colors[8];
    unsigned count = 0;
    unsigned clears = 0, loads = 0, stores = 0;
    bool transientStore = false;
};

VkImage createImage(VkDevice device, const ImageCreateInfo& info) {
    VkImageCreateInfo create = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = info.format;
    create.extent = {640, 480, 1};
    create.mipLevels = 1;
    create.arrayLayers = 1;
    create.samples = info.samples;
    create.usage = info.usage;
    if (info.domain == Domain::Transient)
        create.usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    VkImage image;
    vkCreateImage(device, &create, nullptr, &image);
    return image;
}

VkRenderPass createPass(VkDevice device, const PassInfo& info) {
    VkAttachmentDescription attachments[8];
    VkAttachmentReference references[8];
    const auto loadOp = [&info](unsigned index) -> VkAttachmentLoadOp {
        if ((info.clears & (1u << index)) != 0)
            return VK_ATTACHMENT_LOAD_OP_CLEAR;
        return (info.loads & (1u << index)) != 0 ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    };
    const auto storeOp = [&info](unsigned index) -> VkAttachmentStoreOp {
        return (info.stores & (1u << index)) != 0 ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
    };
    for (unsigned i = 0; i < info.count; i++) {
        const auto& image = info.colors[i]->info();
        auto& attachment = attachments[i];
        attachment = {};
        attachment.format = image.format;
        attachment.samples = image.samples;
        attachment.loadOp = loadOp(i);
        attachment.storeOp = storeOp(i);
        attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        if (image.domain == Domain::Transient && !info.transientStore)
            attachment.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        references[i] = {i, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    }
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = info.count;
    subpass.pColorAttachments = references;
    VkRenderPassCreateInfo create = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    create.attachmentCount = info.count;
    create.pAttachments = attachments;
    create.subpassCount = 1;
    create.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &create, nullptr, &pass);
    return pass;
}
