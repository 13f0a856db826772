// Dynamic rendering (Vulkan 1.3): images, one frame of commands, presentation. Colour is resolved and stored, depth is stored for nobody.
#include <vulkan/vulkan.h>

#include <vector>

struct Attachment {
    VkImage image{VK_NULL_HANDLE};
    VkDeviceMemory memory{VK_NULL_HANDLE};
    VkImageView view{VK_NULL_HANDLE};
};

class Renderer {
public:
    void createTargets();
    void record(VkCommandBuffer cmd, uint32_t index);
    void present(VkQueue queue, uint32_t index);

private:
    void createAttachment(Attachment& attachment, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect);

    const VkSampleCountFlagBits multiSampleCount = VK_SAMPLE_COUNT_4_BIT;
    VkDevice device{};
    VkExtent2D extent{};
    VkFormat colorFormat{VK_FORMAT_B8G8R8A8_SRGB};
    VkFormat depthFormat{VK_FORMAT_D32_SFLOAT};
    Attachment color, depth;
    VkPipeline pipeline{};
    VkPipelineLayout pipelineLayout{};
    VkSwapchainKHR swapchain{};
    std::vector<VkImage> swapchainImages;
    std::vector<VkImageView> swapchainViews;
};

void Renderer::createAttachment(Attachment& attachment, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    VkImageCreateInfo imageCI{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    imageCI.imageType = VK_IMAGE_TYPE_2D;
    imageCI.format = format;
    imageCI.extent = {extent.width, extent.height, 1};
    imageCI.mipLevels = 1;
    imageCI.arrayLayers = 1;
    imageCI.samples = multiSampleCount;
    imageCI.tiling = VK_IMAGE_TILING_OPTIMAL;
    imageCI.usage = usage;
    vkCreateImage(device, &imageCI, nullptr, &attachment.image);

    VkImageViewCreateInfo viewCI{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewCI.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewCI.image = attachment.image;
    viewCI.format = format;
    viewCI.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCreateImageView(device, &viewCI, nullptr, &attachment.view);
}

void Renderer::createTargets() {
    createAttachment(color, colorFormat, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                     VK_IMAGE_ASPECT_COLOR_BIT);
    createAttachment(depth, depthFormat,
                     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,  // expect: MSAA401
                     VK_IMAGE_ASPECT_DEPTH_BIT);
}

void Renderer::record(VkCommandBuffer cmd, uint32_t index) {
    VkRenderingAttachmentInfo colorAttachment{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    colorAttachment.imageView = color.view;
    colorAttachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colorAttachment.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    colorAttachment.resolveImageView = swapchainViews[index];
    colorAttachment.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    colorAttachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colorAttachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    colorAttachment.clearValue.color = {{0.1f, 0.1f, 0.1f, 1.0f}};

    VkRenderingAttachmentInfo depthAttachment{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depthAttachment.imageView = depth.view;
    depthAttachment.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depthAttachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depthAttachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA203
    depthAttachment.clearValue.depthStencil = {1.0f, 0};

    VkRenderingInfo renderingInfo{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO};
    renderingInfo.renderArea = {{0, 0}, extent};
    renderingInfo.layerCount = 1;
    renderingInfo.colorAttachmentCount = 1;
    renderingInfo.pColorAttachments = &colorAttachment;
    renderingInfo.pDepthAttachment = &depthAttachment;

    vkCmdBeginRendering(cmd, &renderingInfo);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdDraw(cmd, 36, 1, 0, 0);
    vkCmdEndRendering(cmd);

    VkImageMemoryBarrier toPresent{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    toPresent.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    toPresent.oldLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    toPresent.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    toPresent.image = swapchainImages[index];
    toPresent.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &toPresent);
}

void Renderer::present(VkQueue queue, uint32_t index) {
    VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
    info.swapchainCount = 1;
    info.pSwapchains = &swapchain;
    info.pImageIndices = &index;
    vkQueuePresentKHR(queue, &info);
}
