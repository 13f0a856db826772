// One class, whose functions are spread over files by topic.
#pragma once

#include <vulkan/vulkan.h>

#include <vector>

class Renderer {
public:
    void start();
    void drawFrame();

private:
    void pickDevice();
    void createSwapChain();
    void createRenderPass();
    void createTargets();
    void createDepth();
    VkFormat findDepthFormat() const;
    VkSampleCountFlagBits usableSampleCount() const;
    void createImage(uint32_t width, uint32_t height, VkSampleCountFlagBits count, VkFormat format, VkImageUsageFlags usage,
                     VkMemoryPropertyFlags properties, VkImage& image, VkDeviceMemory& memory);
    VkImageView createView(VkImage image, VkFormat format, VkImageAspectFlags aspects);
    uint32_t memoryType(uint32_t bits, VkMemoryPropertyFlags properties) const;

    VkDevice device = VK_NULL_HANDLE;
    VkPhysicalDevice gpu = VK_NULL_HANDLE;
    VkFormat surfaceFormat = VK_FORMAT_B8G8R8A8_SRGB;
    VkExtent2D extent{};
    std::vector<VkImageView> swapChainViews;
    std::vector<VkFramebuffer> framebuffers;
    VkRenderPass renderPass = VK_NULL_HANDLE;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImage colorImage = VK_NULL_HANDLE;
    VkDeviceMemory colorMemory = VK_NULL_HANDLE;
    VkImageView colorView = VK_NULL_HANDLE;
    VkImage depthImage = VK_NULL_HANDLE;
    VkDeviceMemory depthMemory = VK_NULL_HANDLE;
    VkImageView depthView = VK_NULL_HANDLE;
};
