// A sample of a vendor: objects of an allocator, a structure of all that belongs to the framebuffer, a user's number of samples.
#pragma once

#include <vulkan/vulkan.h>

namespace vendor {

struct Image {
    VkImage image = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

class Allocator {
public:
    explicit Allocator(VkDevice device) : device_(device) {}
    Image createImage(const VkImageCreateInfo& info, VkMemoryPropertyFlags properties);
    void destroy(Image& image);

private:
    VkDevice device_;
};

class Resources {
public:
    void initFramebuffer(int width, int height, int samples);
    void draw(VkCommandBuffer cmd);
    void blit(VkCommandBuffer cmd);

private:
    struct Framebuffer {
        int width = 0;
        int height = 0;
        int samples = 1;
        Image color;
        Image resolved;
        Image depth;
        VkImageView viewColor = VK_NULL_HANDLE;
        VkImageView viewDepth = VK_NULL_HANDLE;
    };

    VkDevice device_ = VK_NULL_HANDLE;
    Allocator allocator_{VK_NULL_HANDLE};
    Framebuffer framebuffer_;
};

}  // namespace vendor
