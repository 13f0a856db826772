// A picture that is resolved to an image of its own and then only copied to the window's; and one that is resolved by a command for two readers.
#include <vulkan/vulkan.h>

struct Presenter {
    VkDevice device{};
    VkExtent2D size{};
    VkImage colorImage{}, resolvedImage{};
    VkImageView colorView{}, resolvedView{};
    VkSwapchainKHR swapchain{};
    VkImage windowImages[3]{};
    VkQueue queue{};

    void create() {
        VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                               .imageType = VK_IMAGE_TYPE_2D,
                               .format = VK_FORMAT_B8G8R8A8_UNORM,
                               .extent = {size.width, size.height, 1},
                               .mipLevels = 1,
                               .arrayLayers = 1,
                               .samples = VK_SAMPLE_COUNT_4_BIT,
                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT};
        vkCreateImage(device, &info, nullptr, &colorImage);
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        vkCreateImage(device, &info, nullptr, &resolvedImage);
        VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                   .image = colorImage,
                                   .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                   .format = VK_FORMAT_B8G8R8A8_UNORM,
                                   .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        vkCreateImageView(device, &view, nullptr, &colorView);
        view.image = resolvedImage;
        vkCreateImageView(device, &view, nullptr, &resolvedView);
        uint32_t count = 3;
        vkGetSwapchainImagesKHR(device, swapchain, &count, windowImages);
    }

    void frame(VkCommandBuffer cmd, uint32_t index) {
        VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                        .imageView = colorView,
                                        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                        .resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT,  // may: MSAA315#copied
                                        .resolveImageView = resolvedView,  // expect-later: MSAA315#copied
                                        .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
        VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = {{0, 0}, size},
                             .layerCount = 1,
                             .colorAttachmentCount = 1,
                             .pColorAttachments = &color};
        vkCmdBeginRendering(cmd, &info);
        vkCmdDraw(cmd, 300, 1, 0, 0);
        vkCmdEndRendering(cmd);

        VkImageCopy whole{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                          .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                          .extent = {size.width, size.height, 1}};
        vkCmdCopyImage(cmd, resolvedImage, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, windowImages[index], VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                       &whole);
    }

    void present(uint32_t index) {
        VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR, .swapchainCount = 1, .pSwapchains = &swapchain, .pImageIndices = &index};
        vkQueuePresentKHR(queue, &info);
    }
};
