// A single class from the window to the frame, as tutorials grow: a callback with the platform's macros between its type and its name,
// and images that are recreated six calls below main.
#define VULKAN_HPP_NO_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

#include <iostream>
#include <stdexcept>
#include <vector>

#define WINDOW_WIDTH 1280

class Application {
public:
    void run() {
        initVulkan();
        mainLoop();
    }

private:
    void initVulkan() {
        samples = usableCount();
        createColorResources();
        createDepthResources();
    }

    void mainLoop() {
        while (open()) drawFrame();
    }

    void drawFrame() {
        if (resized) recreateSwapChain();
        recordCommands(0);
    }

    void recreateSwapChain() { recreateTargets(); }

    void recreateTargets() { recreateDepth(); }

    void recreateDepth() { createDepthResources(); }

    void createColorResources() {
        createImage(extent.width, extent.height, samples, surfaceFormat,
                    vk::ImageUsageFlagBits::eTransientAttachment | vk::ImageUsageFlagBits::eColorAttachment,
                    vk::MemoryPropertyFlagBits::eDeviceLocal, colorImage, colorMemory);
        colorView = createView(*colorImage, surfaceFormat, vk::ImageAspectFlagBits::eColor);
    }

    void createDepthResources() {
        createImage(extent.width, extent.height, samples, vk::Format::eD32Sfloat,
                    vk::ImageUsageFlagBits::eDepthStencilAttachment,  // expect: MSAA401
                    vk::MemoryPropertyFlagBits::eDeviceLocal, depthImage, depthMemory);
        depthView = createView(*depthImage, vk::Format::eD32Sfloat, vk::ImageAspectFlagBits::eDepth);
    }

    vk::raii::ImageView createView(vk::Image image, vk::Format format, vk::ImageAspectFlags aspect) {
        vk::ImageViewCreateInfo info{.image = image, .viewType = vk::ImageViewType::e2D, .format = format, .subresourceRange = {aspect, 0, 1, 0, 1}};
        return vk::raii::ImageView(device, info);
    }

    void createImage(uint32_t width, uint32_t height, vk::SampleCountFlagBits count, vk::Format format, vk::ImageUsageFlags usage,
                     vk::MemoryPropertyFlags properties, vk::raii::Image& image, vk::raii::DeviceMemory& memory) {
        vk::ImageCreateInfo info{
            .imageType = vk::ImageType::e2D,
            .format = format,
            .extent = {width, height, 1},
            .mipLevels = 1,
            .arrayLayers = 1,
            .samples = count,
            .tiling = vk::ImageTiling::eOptimal,
            .usage = usage,
        };
        image = vk::raii::Image(device, info);
        vk::MemoryRequirements needs = image.getMemoryRequirements();
        vk::MemoryAllocateInfo allocation{.allocationSize = needs.size, .memoryTypeIndex = memoryType(needs.memoryTypeBits, properties)};
        memory = vk::raii::DeviceMemory(device, allocation);
        image.bindMemory(*memory, 0);
    }

    vk::SampleCountFlagBits usableCount() {
        vk::PhysicalDeviceProperties properties = gpu.getProperties();
        vk::SampleCountFlags counts = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;
        return counts & vk::SampleCountFlagBits::e4 ? vk::SampleCountFlagBits::e4 : vk::SampleCountFlagBits::e1;
    }

    void recordCommands(uint32_t index) {
        vk::RenderingAttachmentInfo color{
            .imageView = *colorView,
            .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .resolveMode = vk::ResolveModeFlagBits::eAverage,
            .resolveImageView = *swapChainViews[index],
            .resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eStore,  // expect: MSAA201
        };
        vk::RenderingAttachmentInfo depth{
            .imageView = *depthView,
            .imageLayout = vk::ImageLayout::eDepthStencilAttachmentOptimal,
            .loadOp = vk::AttachmentLoadOp::eClear,
            .storeOp = vk::AttachmentStoreOp::eDontCare,
        };
        vk::RenderingInfo info{.renderArea = {{0, 0}, extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &color, .pDepthAttachment = &depth};
        commands.beginRendering(info);
        commands.endRendering();
    }

    static VKAPI_ATTR vk::Bool32 VKAPI_CALL report(vk::DebugUtilsMessageSeverityFlagBitsEXT severity, vk::DebugUtilsMessageTypeFlagsEXT type,
                                                   const vk::DebugUtilsMessengerCallbackDataEXT* data, void*) {
        if (severity == vk::DebugUtilsMessageSeverityFlagBitsEXT::eError) {
            std::cerr << "layer: " << vk::to_string(type) << " " << data->pMessage << std::endl;
        }
        return VK_FALSE;
    }

    static bool open();
    uint32_t memoryType(uint32_t bits, vk::MemoryPropertyFlags properties);

    vk::raii::PhysicalDevice gpu = nullptr;
    vk::raii::Device device = nullptr;
    vk::raii::CommandBuffer commands = nullptr;
    vk::raii::Image colorImage = nullptr;
    vk::raii::DeviceMemory colorMemory = nullptr;
    vk::raii::ImageView colorView = nullptr;
    vk::raii::Image depthImage = nullptr;
    vk::raii::DeviceMemory depthMemory = nullptr;
    vk::raii::ImageView depthView = nullptr;
    std::vector<vk::raii::ImageView> swapChainViews;
    vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
    vk::Extent2D extent{WINDOW_WIDTH, 720};
    vk::Format surfaceFormat = vk::Format::eB8G8R8A8Srgb;
    bool resized = false;
};

int main() {
    Application application;
    application.run();
}
