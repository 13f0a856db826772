// Formats from lists of candidates, a count from the device, images by a class of their own that is constructed with everything.
#include <vulkan/vulkan.h>

#include <initializer_list>
#include <stdexcept>
#include <vector>

class Gpu {
public:
    VkFormat firstSupported(const std::vector<VkFormat>& candidates, VkImageTiling tiling, VkFormatFeatureFlags features) const {
        for (VkFormat format : candidates) {
            VkFormatProperties props;
            vkGetPhysicalDeviceFormatProperties(physical, format, &props);
            if (tiling == VK_IMAGE_TILING_LINEAR && (props.linearTilingFeatures & features) == features) return format;
            if (tiling == VK_IMAGE_TILING_OPTIMAL && (props.optimalTilingFeatures & features) == features) return format;
        }
        throw std::runtime_error("no format");
    }
    VkFormat depthFormat() const {
        return firstSupported({VK_FORMAT_D32_SFLOAT, VK_FORMAT_D32_SFLOAT_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT}, VK_IMAGE_TILING_OPTIMAL,
                              VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT);
    }
    VkSampleCountFlagBits maxSamples() const {  // expect: MSAA851
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(physical, &properties);
        auto counts = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;  // may: MSAA854
        for (auto bit : {VK_SAMPLE_COUNT_64_BIT, VK_SAMPLE_COUNT_32_BIT, VK_SAMPLE_COUNT_16_BIT, VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_4_BIT,
                         VK_SAMPLE_COUNT_2_BIT})
            if (counts & bit) return bit;
        return VK_SAMPLE_COUNT_1_BIT;
    }
    VkPhysicalDevice physical{};
    VkDevice device{};
};

class Image {
public:
    Image(const Gpu& gpu, VkExtent2D size, VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect,
          VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT)
        : gpu(gpu) {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        vkCreateImage(gpu.device, &info, nullptr, &image);
        VkImageViewCreateInfo viewInfo{};
        viewInfo.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        viewInfo.image = image;
        viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
        viewInfo.format = format;
        viewInfo.subresourceRange = {aspect, 0, 1, 0, 1};
        vkCreateImageView(gpu.device, &viewInfo, nullptr, &view);
    }
    Image(const Image&) = delete;
    ~Image() {
        vkDestroyImageView(gpu.device, view, nullptr);
        vkDestroyImage(gpu.device, image, nullptr);
    }

    VkImage image{};
    VkImageView view{};

private:
    const Gpu& gpu;
};

class Scene {
public:
    Scene(const Gpu& gpu, VkExtent2D size, VkFormat format)
        : gpu(gpu),
          samples(gpu.maxSamples()),
          color(gpu, size, format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT,
                samples),
          depth(gpu, size, gpu.depthFormat(),
                VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,  // expect: MSAA401
                VK_IMAGE_ASPECT_DEPTH_BIT, samples) {
        createPass(format);
    }

    VkFramebuffer framebuffer(VkExtent2D size, VkImageView window) const {
        const VkImageView views[] = {color.view, depth.view, window};
        VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
        info.renderPass = pass;
        info.attachmentCount = 3;
        info.pAttachments = views;
        info.width = size.width;
        info.height = size.height;
        info.layers = 1;
        VkFramebuffer made{};
        vkCreateFramebuffer(gpu.device, &info, nullptr, &made);
        return made;
    }

private:
    void createPass(VkFormat format) {
        const VkAttachmentDescription attachments[] = {
            {.format = format,
             .samples = samples,
             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
             .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
             .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
            {.format = gpu.depthFormat(),
             .samples = samples,
             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA203
             .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
             .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
             .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
            {.format = format,
             .samples = VK_SAMPLE_COUNT_1_BIT,
             .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
             .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR},
        };
        const VkAttachmentReference references[] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                                    {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
                                                    {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
        VkSubpassDescription subpass{};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &references[0];
        subpass.pDepthStencilAttachment = &references[1];
        subpass.pResolveAttachments = &references[2];
        VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.attachmentCount = 3;
        info.pAttachments = attachments;
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        vkCreateRenderPass(gpu.device, &info, nullptr, &pass);
    }

    const Gpu& gpu;
    VkSampleCountFlagBits samples;
    Image color, depth;
    VkRenderPass pass{};
};
