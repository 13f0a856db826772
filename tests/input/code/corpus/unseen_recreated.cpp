// A window that is resized: everything is made again, by the same functions. Frames in flight have a command buffer each, and share the rest.
#include <vulkan/vulkan.h>

#include <array>
#include <memory>
#include <vector>

class Resizable {
public:
    void init() {
        createSwapchain();
        createColor();
        createDepth();
        createPass();
        createFramebuffers();
    }

    void resize(uint32_t width, uint32_t height) {
        extent = {width, height};
        vkDeviceWaitIdle(device);
        cleanup();
        createSwapchain();
        createColor();
        createDepth();
        createFramebuffers();
    }

    void setSamples(VkSampleCountFlagBits count) {
        samples = count;
        vkDestroyRenderPass(device, pass, nullptr);
        cleanup();
        createColor();
        createDepth();
        createPass();
        createFramebuffers();
    }

private:
    static constexpr int kFramesInFlight = 2;

    void createSwapchain() {
        VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
        info.minImageCount = 3;
        info.imageFormat = format;
        info.imageExtent = extent;
        info.imageArrayLayers = 1;
        info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        vkCreateSwapchainKHR(device, &info, nullptr, &swapchain);
        uint32_t count = 0;
        vkGetSwapchainImagesKHR(device, swapchain, &count, nullptr);
        images.resize(count);
        vkGetSwapchainImagesKHR(device, swapchain, &count, images.data());
        views.resize(count);
        for (size_t i = 0; i < images.size(); i++) views[i] = createView(images[i], format, VK_IMAGE_ASPECT_COLOR_BIT);
    }

    void createColor() {
        color = createImage(format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT);
        colorView = createView(color, format, VK_IMAGE_ASPECT_COLOR_BIT);
    }

    void createDepth() {
        depth = createImage(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT);
        depthView = createView(depth, VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT);
    }

    VkImage createImage(VkFormat imageFormat, VkImageUsageFlags usage) {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = imageFormat;
        info.extent = {extent.width, extent.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        VkImage image{};
        vkCreateImage(device, &info, nullptr, &image);
        return image;
    }

    VkImageView createView(VkImage image, VkFormat viewFormat, VkImageAspectFlags aspect) {
        VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        info.image = image;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = viewFormat;
        info.subresourceRange = {aspect, 0, 1, 0, 1};
        VkImageView view{};
        vkCreateImageView(device, &info, nullptr, &view);
        return view;
    }

    void createPass() {
        std::vector<VkAttachmentDescription> attachments;
        attachments.push_back({0, format, samples, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                               VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED,
                               VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL});
        attachments.push_back({0, VK_FORMAT_D32_SFLOAT, samples, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                               VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED,
                               VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL});
        // The resolve target goes first: the views of the framebuffer are in that order too.
        attachments.insert(attachments.begin(),
                           {0, format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE,
                            VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_IMAGE_LAYOUT_UNDEFINED,
                            VK_IMAGE_LAYOUT_PRESENT_SRC_KHR});
        const std::array<VkAttachmentReference, 3> references{{{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                                               {2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL},
                                                               {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}}};
        VkSubpassDescription subpass{};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &references[0];
        subpass.pDepthStencilAttachment = &references[1];
        subpass.pResolveAttachments = &references[2];
        VkSubpassDependency dependency{};
        dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
        dependency.srcStageMask = dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                            VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                            VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
        dependency.srcAccessMask = dependency.dstAccessMask =
            VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
        info.attachmentCount = static_cast<uint32_t>(attachments.size());
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        info.dependencyCount = 1;
        info.pDependencies = &dependency;
        vkCreateRenderPass(device, &info, nullptr, &pass);
    }

    void createFramebuffers() {
        framebuffers.resize(views.size());
        for (size_t i = 0; i < views.size(); i++) {
            const VkImageView attached[] = {views[i], colorView, depthView};
            VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
            info.renderPass = pass;
            info.attachmentCount = 3;
            info.pAttachments = attached;
            info.width = extent.width;
            info.height = extent.height;
            info.layers = 1;
            vkCreateFramebuffer(device, &info, nullptr, &framebuffers[i]);
        }
    }

    void cleanup() {
        for (VkFramebuffer framebuffer : framebuffers) vkDestroyFramebuffer(device, framebuffer, nullptr);
        vkDestroyImageView(device, colorView, nullptr);
        vkDestroyImageView(device, depthView, nullptr);
        vkDestroyImage(device, color, nullptr);
        vkDestroyImage(device, depth, nullptr);
    }

    VkDevice device{};
    VkSwapchainKHR swapchain{};
    VkFormat format = VK_FORMAT_B8G8R8A8_SRGB;
    VkExtent2D extent{800, 600};
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
    std::vector<VkImage> images;
    std::vector<VkImageView> views;
    std::vector<VkFramebuffer> framebuffers;
    std::array<VkCommandBuffer, kFramesInFlight> commands{};
    VkImage color{}, depth{};
    VkImageView colorView{}, depthView{};
    VkRenderPass pass{};
};

int main() { std::make_unique<Resizable>()->init(); }
