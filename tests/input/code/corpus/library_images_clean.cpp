// A sample on top of a library that resolves in its pass, and whose depth is transient: its allocator returns objects that hold an image, or fills a variable that is passed to it. The render
// passes are created again when the count changes, and the passes in use are members.
#include <vulkan/vulkan.h>

#include "toolkit/allocator.hpp"

struct Targets {
    toolkit::Image color;
    toolkit::Image depth;
    toolkit::Image resolved;
    VkImageView colorView = VK_NULL_HANDLE;
    VkImageView depthView = VK_NULL_HANDLE;
    VkImageView resolvedView = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
    int samples = 1;
};

class Sample {
public:
    void init(int samples);
    void resize(int samples);
    void draw(VkCommandBuffer cmd);
    void shutdown();

private:
    VkRenderPass createPass(VkSampleCountFlagBits samples);
    void createTargets(int samples);
    VkImageView createView(VkImage image, VkFormat format, VkImageAspectFlags aspect);

    VkDevice device_;
    VkExtent2D extent_;
    toolkit::Allocator allocator_;
    Targets targets_;
};

static VkSampleCountFlagBits sampleBits(int samples) {
    switch (samples) {
        case 2: return VK_SAMPLE_COUNT_2_BIT;
        case 4: return VK_SAMPLE_COUNT_4_BIT;
        case 8: return VK_SAMPLE_COUNT_8_BIT;
        default: return VK_SAMPLE_COUNT_1_BIT;
    }
}

VkRenderPass Sample::createPass(VkSampleCountFlagBits samples) {
    VkAttachmentDescription attachments[3] = {};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = samples;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[2].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[2].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference resolved = {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolved;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 3;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device_, &info, nullptr, &pass);
    return pass;
}

VkImageView Sample::createView(VkImage image, VkFormat format, VkImageAspectFlags aspect) {
    VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    VkImageView view;
    vkCreateImageView(device_, &info, nullptr, &view);
    return view;
}

void Sample::createTargets(int samples) {
    if (targets_.samples != samples) {
        vkDestroyRenderPass(device_, targets_.pass, nullptr);
        targets_.pass = createPass(sampleBits(samples));
    }
    targets_.samples = samples;

    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {extent_.width, extent_.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = sampleBits(samples);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    targets_.color = allocator_.createImage(info, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);

    VkImageCreateInfo depth = info;
    depth.format = VK_FORMAT_D32_SFLOAT;
    depth.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    TOOLKIT_CHECK(allocator_.createImage(targets_.depth, depth));

    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    targets_.resolved = allocator_.createImage(info, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);

    targets_.colorView = createView(targets_.color.image, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_ASPECT_COLOR_BIT);
    targets_.depthView = createView(targets_.depth.image, VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT);

    targets_.resolvedView = createView(targets_.resolved.image, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_ASPECT_COLOR_BIT);

    VkImageView views[] = {targets_.colorView, targets_.depthView, targets_.resolvedView};
    VkFramebufferCreateInfo framebuffer = {VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    framebuffer.renderPass = targets_.pass;
    framebuffer.attachmentCount = 3;
    framebuffer.pAttachments = views;
    framebuffer.width = extent_.width;
    framebuffer.height = extent_.height;
    framebuffer.layers = 1;
    vkCreateFramebuffer(device_, &framebuffer, nullptr, &targets_.framebuffer);
}

void Sample::init(int samples) {
    targets_.pass = createPass(sampleBits(samples));
    createTargets(samples);
}

void Sample::resize(int samples) { createTargets(samples); }

void Sample::draw(VkCommandBuffer cmd) {
    vkCmdEndRenderPass(cmd);
}

void Sample::shutdown() {
    vkDestroyImageView(device_, targets_.colorView, nullptr);
    vkDestroyRenderPass(device_, targets_.pass, nullptr);
    targets_.colorView = VK_NULL_HANDLE;
    targets_.pass = VK_NULL_HANDLE;
}
