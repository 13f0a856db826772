// An engine whose images, passes, and framebuffers are objects that others hold by pointer.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <vector>

class Texture {
public:
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    Texture(VkDevice& device, VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits count, VkImageAspectFlags aspect);
};

class Target {
public:
    Texture* texture;
    Target(VkDevice& device, VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits count, VkImageAspectFlags aspect);
};

class Pass {
public:
    VkRenderPass handle = VK_NULL_HANDLE;
    Pass(VkDevice& device);
};

class ScenePass : public Pass {
public:
    ScenePass(VkDevice& device, VkSampleCountFlagBits count);
};

class Canvas {
public:
    VkFramebuffer handle = VK_NULL_HANDLE;
    Canvas(VkDevice& device, VkRenderPass& pass, uint32_t count, VkImageView* views);
};
