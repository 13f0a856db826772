// An application whose window is created again by a draw, eight calls deep. Its depth image is not transient.
#include <array>
#include <vulkan/vulkan.h>

class Application {
public:
    void run() {
        initialize();
        mainLoop();
    }

private:
    void initialize() { createWindow(); }
    void mainLoop() {
        while (running)
            step();
    }
    void step() { update(); }
    void update() { drawFrame(); }
    void drawFrame() {
        if (resized)
            recreate();
    }
    void recreate() { recreateTargets(); }
    void recreateTargets() { createTargets(); }
    void createWindow() { createPass(); }
    void createTargets() { createDepthResources(); }
    void createDepthResources();
    void createImage(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImage& image);
    VkImageView createView(VkImage image, VkFormat format, VkImageAspectFlags aspect);
    void createPass();
    void createFramebuffer(VkImageView color, VkImageView window);

    bool running = true, resized = false;
    VkDevice device = VK_NULL_HANDLE;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
    VkImage depthImage = VK_NULL_HANDLE;
    VkImageView depthView = VK_NULL_HANDLE;
    VkRenderPass pass = VK_NULL_HANDLE;
    VkFramebuffer framebuffer = VK_NULL_HANDLE;
};

void Application::createImage(VkFormat format, VkSampleCountFlagBits count, VkImageUsageFlags usage, VkImage& image) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.extent = {640, 480, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.format = format;
    info.usage = usage;
    info.samples = count;
    vkCreateImage(device, &info, nullptr, &image);
}

VkImageView Application::createView(VkImage image, VkFormat format, VkImageAspectFlags aspect) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    VkImageView view;
    vkCreateImageView(device, &info, nullptr, &view);
    return view;
}

void Application::createDepthResources() {
    createImage(VK_FORMAT_D32_SFLOAT, samples, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, depthImage);  // expect: MSAA401
    depthView = createView(depthImage, VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT);
}

void Application::createPass() {
    std::array<VkAttachmentDescription, 3> attachments{};
    attachments[0].format = VK_FORMAT_B8G8R8A8_SRGB;
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = samples;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[2].format = VK_FORMAT_B8G8R8A8_SRGB;
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference window{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &window;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = uint32_t(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
}

void Application::createFramebuffer(VkImageView color, VkImageView window) {
    std::array<VkImageView, 3> views = {color, depthView, window};
    VkFramebufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
    info.renderPass = pass;
    info.attachmentCount = uint32_t(views.size());
    info.pAttachments = views.data();
    info.width = 640;
    info.height = 480;
    info.layers = 1;
    vkCreateFramebuffer(device, &info, nullptr, &framebuffer);
}

int main() {
    Application application;
    application.run();
}
