// A backend sets every attachment of a fixed list to a default, and then some of them by flags of the caller.
#include <vulkan/vulkan.h>

constexpr uint32_t MAX_ATTACHMENTS = 8;
enum ClearFlags : uint16_t { CLEAR_COLOR = 1, CLEAR_DEPTH = 2, DISCARD_DEPTH = 4 };

struct Renderer {
    VkDevice device;
    VkRenderPass getPass(uint8_t count, const VkFormat* formats, const VkImageAspectFlags* aspects, VkSampleCountFlagBits samples,
                         uint16_t flags);
    void resolve(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer);
    void createTarget(uint32_t width, uint32_t height);

    VkImage image = VK_NULL_HANDLE, resolved = VK_NULL_HANDLE;
};

VkRenderPass Renderer::getPass(uint8_t count, const VkFormat* formats, const VkImageAspectFlags* aspects, VkSampleCountFlagBits samples,
                               uint16_t flags) {
    VkAttachmentDescription descriptions[MAX_ATTACHMENTS * 2];
    for (uint8_t ii = 0; ii < count; ++ii) {
        descriptions[ii].flags = 0;
        descriptions[ii].format = VK_FORMAT_UNDEFINED;
        descriptions[ii].samples = samples;
        descriptions[ii].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
        descriptions[ii].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        descriptions[ii].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        descriptions[ii].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        descriptions[ii].initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        descriptions[ii].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    VkAttachmentReference colors[MAX_ATTACHMENTS];
    VkAttachmentReference depth = {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    uint32_t numColors = 0;
    for (uint8_t ii = 0; ii < count; ++ii) {
        descriptions[ii].format = formats[ii];
        if (aspects[ii] & VK_IMAGE_ASPECT_COLOR_BIT) {
            colors[numColors].attachment = ii;
            colors[numColors].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            descriptions[ii].loadOp = 0 != (flags & CLEAR_COLOR) ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
            numColors++;
        } else {
            descriptions[ii].loadOp = 0 != (flags & CLEAR_DEPTH) ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
            descriptions[ii].storeOp = 0 != (flags & DISCARD_DEPTH) ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
            depth.attachment = ii;
        }
    }
    VkSubpassDescription subpass[1];
    subpass[0].flags = 0;
    subpass[0].pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass[0].inputAttachmentCount = 0;
    subpass[0].pInputAttachments = nullptr;
    subpass[0].colorAttachmentCount = numColors;
    subpass[0].pColorAttachments = colors;
    subpass[0].pResolveAttachments = nullptr;
    subpass[0].pDepthStencilAttachment = &depth;
    subpass[0].preserveAttachmentCount = 0;
    subpass[0].pPreserveAttachments = nullptr;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = count;
    info.pAttachments = descriptions;
    info.subpassCount = 1;
    info.pSubpasses = subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

void Renderer::createTarget(uint32_t width, uint32_t height) {
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.extent = {width, height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_4_BIT;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    vkCreateImage(device, &info, nullptr, &image);
    VkImageCreateInfo other = info;
    other.samples = VK_SAMPLE_COUNT_1_BIT;
    other.usage &= ~VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    other.usage |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    vkCreateImage(device, &other, nullptr, &resolved);
}

void Renderer::resolve(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer) {
    VkRenderPassBeginInfo begin = {VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    begin.renderPass = pass;
    begin.framebuffer = framebuffer;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdDraw(commands, 3, 1, 0, 0);
    vkCmdEndRenderPass(commands);
    VkImageResolve region = {};
    region.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.extent = {640, 480, 1};
    vkCmdResolveImage(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, resolved, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);  // may: MSAA301
}
