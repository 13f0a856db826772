// vk::raii without constructors of structures: designated initialisers, dynamic rendering, one frame.
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

class Application {
public:
    void run() {
        msaaSamples = getMaxUsableSampleCount();
        createColorResources();
        createDepthResources();
    }
    void recordCommandBuffer(uint32_t imageIndex);

private:
    vk::raii::PhysicalDevice physicalDevice = nullptr;
    vk::raii::Device device = nullptr;
    vk::SampleCountFlagBits msaaSamples = vk::SampleCountFlagBits::e1;
    vk::Format swapChainImageFormat = vk::Format::eB8G8R8A8Srgb;
    vk::Extent2D swapChainExtent{};
    std::vector<vk::raii::ImageView> swapChainImageViews;
    vk::raii::Image colorImage = nullptr;
    vk::raii::DeviceMemory colorImageMemory = nullptr;
    vk::raii::ImageView colorImageView = nullptr;
    vk::raii::Image depthImage = nullptr;
    vk::raii::DeviceMemory depthImageMemory = nullptr;
    vk::raii::ImageView depthImageView = nullptr;
    vk::raii::CommandBuffer commandBuffer = nullptr;

    vk::SampleCountFlagBits getMaxUsableSampleCount() {  // expect: MSAA851
        vk::PhysicalDeviceProperties properties = physicalDevice.getProperties();
        vk::SampleCountFlags counts = properties.limits.framebufferColorSampleCounts & properties.limits.framebufferDepthSampleCounts;
        if (counts & vk::SampleCountFlagBits::e64) { return vk::SampleCountFlagBits::e64; }
        if (counts & vk::SampleCountFlagBits::e32) { return vk::SampleCountFlagBits::e32; }
        if (counts & vk::SampleCountFlagBits::e16) { return vk::SampleCountFlagBits::e16; }
        if (counts & vk::SampleCountFlagBits::e8) { return vk::SampleCountFlagBits::e8; }
        if (counts & vk::SampleCountFlagBits::e4) { return vk::SampleCountFlagBits::e4; }
        if (counts & vk::SampleCountFlagBits::e2) { return vk::SampleCountFlagBits::e2; }
        return vk::SampleCountFlagBits::e1;
    }

    void createColorResources() {
        createImage(swapChainExtent.width, swapChainExtent.height, 1, msaaSamples, swapChainImageFormat, vk::ImageTiling::eOptimal,
                    vk::ImageUsageFlagBits::eTransientAttachment | vk::ImageUsageFlagBits::eColorAttachment,
                    vk::MemoryPropertyFlagBits::eDeviceLocal, colorImage, colorImageMemory);
        colorImageView = createImageView(colorImage, swapChainImageFormat, vk::ImageAspectFlagBits::eColor);
    }

    void createDepthResources() {
        createImage(swapChainExtent.width, swapChainExtent.height, 1, msaaSamples, vk::Format::eD32Sfloat, vk::ImageTiling::eOptimal,
                    vk::ImageUsageFlagBits::eDepthStencilAttachment,  // expect: MSAA401
                    vk::MemoryPropertyFlagBits::eDeviceLocal, depthImage, depthImageMemory);
        depthImageView = createImageView(depthImage, vk::Format::eD32Sfloat, vk::ImageAspectFlagBits::eDepth);
    }

    void createImage(uint32_t width, uint32_t height, uint32_t mipLevels, vk::SampleCountFlagBits numSamples, vk::Format format,
                     vk::ImageTiling tiling, vk::ImageUsageFlags usage, vk::MemoryPropertyFlags properties, vk::raii::Image& image,
                     vk::raii::DeviceMemory& imageMemory) {
        vk::ImageCreateInfo imageInfo{.imageType = vk::ImageType::e2D,
                                      .format = format,
                                      .extent = {width, height, 1},
                                      .mipLevels = mipLevels,
                                      .arrayLayers = 1,
                                      .samples = numSamples,
                                      .tiling = tiling,
                                      .usage = usage,
                                      .sharingMode = vk::SharingMode::eExclusive,
                                      .initialLayout = vk::ImageLayout::eUndefined};
        image = vk::raii::Image(device, imageInfo);
        vk::MemoryRequirements requirements = image.getMemoryRequirements();
        vk::MemoryAllocateInfo allocInfo{.allocationSize = requirements.size,
                                         .memoryTypeIndex = findMemoryType(requirements.memoryTypeBits, properties)};
        imageMemory = vk::raii::DeviceMemory(device, allocInfo);
        image.bindMemory(*imageMemory, 0);
    }

    vk::raii::ImageView createImageView(const vk::raii::Image& image, vk::Format format, vk::ImageAspectFlags aspect) {
        vk::ImageViewCreateInfo viewInfo{.image = *image,
                                         .viewType = vk::ImageViewType::e2D,
                                         .format = format,
                                         .subresourceRange = {aspect, 0, 1, 0, 1}};
        return vk::raii::ImageView(device, viewInfo);
    }

    uint32_t findMemoryType(uint32_t typeFilter, vk::MemoryPropertyFlags properties) {
        vk::PhysicalDeviceMemoryProperties memory = physicalDevice.getMemoryProperties();
        for (uint32_t i = 0; i < memory.memoryTypeCount; i++)
            if ((typeFilter & (1u << i)) && (memory.memoryTypes[i].propertyFlags & properties) == properties) return i;
        throw std::runtime_error("memory");
    }
};

void Application::recordCommandBuffer(uint32_t imageIndex) {
    vk::ClearValue clearColor = vk::ClearColorValue(std::array<float, 4>{0.0f, 0.0f, 0.0f, 1.0f});
    vk::ClearValue clearDepth = vk::ClearDepthStencilValue{1.0f, 0};
    vk::RenderingAttachmentInfo colorAttachment = {.imageView = *colorImageView,
                                                   .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                                   .resolveMode = vk::ResolveModeFlagBits::eAverage,
                                                   .resolveImageView = *swapChainImageViews[imageIndex],
                                                   .resolveImageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                                   .loadOp = vk::AttachmentLoadOp::eClear,
                                                   .storeOp = vk::AttachmentStoreOp::eStore,  // expect: MSAA201
                                                   .clearValue = clearColor};
    vk::RenderingAttachmentInfo depthAttachment = {.imageView = *depthImageView,
                                                   .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                   .loadOp = vk::AttachmentLoadOp::eClear,
                                                   .storeOp = vk::AttachmentStoreOp::eDontCare,
                                                   .clearValue = clearDepth};
    vk::RenderingInfo renderingInfo = {.renderArea = {.offset = {0, 0}, .extent = swapChainExtent},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &colorAttachment,
                                       .pDepthAttachment = &depthAttachment};
    commandBuffer.beginRendering(renderingInfo);
    commandBuffer.draw(3, 1, 0, 0);
    commandBuffer.endRendering();
}
