// One VkImageCreateInfo for three images, changed between the calls; each image is what the structure was when it was made.
#include <vulkan/vulkan.h>

#include <array>

struct Multisample {
    VkImage color, depth, resolve;
    VkImageView colorView, depthView, resolveView;
};

class MultisampleTargets {
public:
    Multisample target{};
    VkDevice device{};
    VkFormat swapFormat = VK_FORMAT_R8G8B8A8_UNORM;
    VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;
    static constexpr VkSampleCountFlagBits sampleCount = VK_SAMPLE_COUNT_8_BIT;  // may: MSAA101#count
    uint32_t width = 1280, height = 720;

    void setup() {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = swapFormat;
        info.extent.width = width;
        info.extent.height = height;
        info.extent.depth = 1;
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.samples = sampleCount;  // expect: MSAA101#count
        info.usage = VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        vkCreateImage(device, &info, nullptr, &target.color);

        info.format = depthFormat;
        info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;  // expect: MSAA401
        vkCreateImage(device, &info, nullptr, &target.depth);

        info.format = swapFormat;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        vkCreateImage(device, &info, nullptr, &target.resolve);

        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = swapFormat;
        view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
        view.subresourceRange.levelCount = 1;
        view.subresourceRange.layerCount = 1;
        view.image = target.color;
        vkCreateImageView(device, &view, nullptr, &target.colorView);
        view.image = target.resolve;
        vkCreateImageView(device, &view, nullptr, &target.resolveView);
        view.image = target.depth;
        view.format = depthFormat;
        view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
        vkCreateImageView(device, &view, nullptr, &target.depthView);
    }

    VkRenderPass pass() {
        std::array<VkAttachmentDescription, 3> attachments = {};
        attachments[0].format = swapFormat;
        attachments[0].samples = sampleCount;  // may: MSAA101#count
        attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachments[1].format = swapFormat;
        attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachments[1].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        attachments[2].format = depthFormat;
        attachments[2].samples = sampleCount;  // may: MSAA101#count
        attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[2].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkAttachmentReference depth = {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass = {};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        subpass.pResolveAttachments = &resolve;
        subpass.pDepthStencilAttachment = &depth;
        VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.attachmentCount = 3;
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        VkRenderPass made;
        vkCreateRenderPass(device, &info, nullptr, &made);
        return made;
    }

    VkFramebuffer framebuffer(VkRenderPass renderPass) {
        VkImageView views[3];
        views[0] = target.colorView;
        views[1] = target.resolveView;
        views[2] = target.depthView;
        VkFramebufferCreateInfo info = {VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
        info.renderPass = renderPass;
        info.attachmentCount = 3;
        info.pAttachments = views;
        info.width = width;
        info.height = height;
        info.layers = 1;
        VkFramebuffer made;
        vkCreateFramebuffer(device, &info, nullptr, &made);
        return made;
    }
};
