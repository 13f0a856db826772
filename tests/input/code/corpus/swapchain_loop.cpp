// A multisampled colour image for every image of the swapchain, in a loop; one would do. They are not transient either.
#include <vulkan/vulkan.h>

#include <vector>

struct SwapchainBuffer {
    VkImage image;
    VkImageView view;
    VkImage msaaImage;
    VkDeviceMemory msaaMemory;
    VkImageView msaaView;
    VkFramebuffer framebuffer;
};

class Swapchain {
public:
    void build(uint32_t width, uint32_t height);

private:
    void createPass();

    VkDevice device_ = VK_NULL_HANDLE;
    VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_B8G8R8A8_UNORM;
    VkRenderPass pass_ = VK_NULL_HANDLE;
    std::vector<SwapchainBuffer> buffers_;
};

void Swapchain::createPass() {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = format_;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[0].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = format_;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device_, &info, nullptr, &pass_);
}

void Swapchain::build(uint32_t width, uint32_t height) {
    createPass();
    uint32_t count = 0;
    vkGetSwapchainImagesKHR(device_, swapchain_, &count, nullptr);
    std::vector<VkImage> images(count);
    vkGetSwapchainImagesKHR(device_, swapchain_, &count, images.data());
    buffers_.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
        SwapchainBuffer& buffer = buffers_[i];
        buffer.image = images[i];
        VkImageCreateInfo image = {};
        image.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        image.imageType = VK_IMAGE_TYPE_2D;
        image.format = format_;
        image.extent = {width, height, 1};
        image.mipLevels = 1;
        image.arrayLayers = 1;
        image.samples = VK_SAMPLE_COUNT_4_BIT;
        image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;  // expect: MSAA401
        vkCreateImage(device_, &image, nullptr, &buffer.msaaImage);  // expect-later: MSAA406

        VkImageViewCreateInfo view = {};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format_;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        view.image = buffer.image;
        vkCreateImageView(device_, &view, nullptr, &buffer.view);
        view.image = buffer.msaaImage;
        vkCreateImageView(device_, &view, nullptr, &buffer.msaaView);

        VkImageView views[2] = {buffer.msaaView, buffer.view};
        VkFramebufferCreateInfo framebuffer = {};
        framebuffer.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        framebuffer.renderPass = pass_;
        framebuffer.attachmentCount = 2;
        framebuffer.pAttachments = views;
        framebuffer.width = width;
        framebuffer.height = height;
        framebuffer.layers = 1;
        vkCreateFramebuffer(device_, &framebuffer, nullptr, &buffer.framebuffer);
    }
}
