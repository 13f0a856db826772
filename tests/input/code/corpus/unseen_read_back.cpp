// Without a window: resolved in the pass, copied to a buffer and to a texture of another program; a pass that is suspended and resumed. All right.
#include <vulkan/vulkan.h>

#include <vector>

struct Headless {
    VkDevice device;
    VkExtent2D size;
    VkImage samples, picture, shared;
    VkImageView samplesView, pictureView;
    VkBuffer buffer;

    void createImages() {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_4_BIT;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        vkCreateImage(device, &info, nullptr, &samples);
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        vkCreateImage(device, &info, nullptr, &picture);
        createView(samples, samplesView);
        createView(picture, pictureView);
    }

    void createView(VkImage image, VkImageView& view) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = image;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCreateImageView(device, &info, nullptr, &view);
    }

    VkRenderingAttachmentInfo attachment(VkAttachmentLoadOp load) const {
        VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        info.imageView = samplesView;
        info.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        info.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        info.resolveImageView = pictureView;
        info.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        info.loadOp = load;
        info.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        return info;
    }

    void half(VkCommandBuffer cmd, VkRenderingFlags flags, uint32_t first) {
        const VkRenderingAttachmentInfo color = attachment(VK_ATTACHMENT_LOAD_OP_CLEAR);
        VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
        info.flags = flags;
        info.renderArea = {{0, 0}, size};
        info.layerCount = 1;
        info.colorAttachmentCount = 1;
        info.pColorAttachments = &color;
        vkCmdBeginRendering(cmd, &info);
        vkCmdDraw(cmd, 3000, 1, first, 0);
        vkCmdEndRendering(cmd);
    }

    void frame(VkCommandBuffer first, VkCommandBuffer second) {
        half(first, VK_RENDERING_SUSPENDING_BIT, 0);
        half(second, VK_RENDERING_RESUMING_BIT, 3000);

        VkBufferImageCopy whole{};
        whole.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        whole.imageExtent = {size.width, size.height, 1};
        vkCmdCopyImageToBuffer(second, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1, &whole);

        VkImageBlit smaller{};
        smaller.srcSubresource = smaller.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        smaller.srcOffsets[1] = {int32_t(size.width), int32_t(size.height), 1};
        smaller.dstOffsets[1] = {int32_t(size.width / 2), int32_t(size.height / 2), 1};
        vkCmdBlitImage(second, picture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, shared, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &smaller,
                       VK_FILTER_LINEAR);
    }
};
