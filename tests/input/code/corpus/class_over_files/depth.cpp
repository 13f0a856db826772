#include "renderer.h"

void Renderer::createDepth() {
    const VkFormat format = findDepthFormat();
    createImage(extent.width, extent.height, samples, format,
                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,  // expect: MSAA401
                VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, depthImage, depthMemory);
    depthView = createView(depthImage, format, VK_IMAGE_ASPECT_DEPTH_BIT);
    for (VkImageView view : swapChainViews) {
        const VkImageView attachments[] = {colorView, depthView, view};
        VkFramebufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        info.renderPass = renderPass;
        info.attachmentCount = 3;
        info.pAttachments = attachments;
        info.width = extent.width;
        info.height = extent.height;
        info.layers = 1;
        VkFramebuffer framebuffer = VK_NULL_HANDLE;
        vkCreateFramebuffer(device, &info, nullptr, &framebuffer);
        framebuffers.push_back(framebuffer);
    }
}
