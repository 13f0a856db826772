// Lambdas that make structures, immediately called ones among them.
#include <vulkan/vulkan.h>

#include <array>
#include <functional>

VkRenderPass makePass(VkDevice device, VkFormat format) {
    const auto attachment = [format](VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store,
                                     VkImageLayout finalLayout) {
        VkAttachmentDescription d{};
        d.format = format;
        d.samples = samples;
        d.loadOp = load;
        d.storeOp = store;
        d.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        d.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        d.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        d.finalLayout = finalLayout;
        return d;
    };
    const auto depth = [] {
        VkAttachmentDescription d{};
        d.format = VK_FORMAT_D32_SFLOAT;
        d.samples = VK_SAMPLE_COUNT_4_BIT;
        d.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        d.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        d.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        return d;
    }();

    const std::array<VkAttachmentDescription, 3> attachments{
        attachment(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                   VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA201
                   VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
        attachment(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR),
        depth,
    };

    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depthReference{2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = [&] {
        VkSubpassDescription s{};
        s.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        s.colorAttachmentCount = 1;
        s.pColorAttachments = &color;
        s.pResolveAttachments = &resolve;
        s.pDepthStencilAttachment = &depthReference;
        return s;
    }();

    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

struct Job {
    std::function<VkImage(VkDevice, VkSampleCountFlagBits)> make;
};

// A lambda that somebody else calls: its parameter is not known here.
Job makeJob(VkExtent3D extent) {
    return {[extent](VkDevice device, VkSampleCountFlagBits samples) {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = VK_FORMAT_R8G8B8A8_UNORM;
        info.extent = extent;
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        VkImage image{};
        vkCreateImage(device, &info, nullptr, &image);
        return image;
    }};
}
