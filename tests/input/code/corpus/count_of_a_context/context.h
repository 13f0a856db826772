#pragma once
#include <vulkan/vulkan.h>

typedef struct gfx_context {
    VkPhysicalDevice adapter;
    VkDevice device;
    VkFormat color_format;
    VkFormat depth_format;
    VkSampleCountFlagBits msaa;
} gfx_context;

extern gfx_context gfx;

void gfx_pick_samples(void);
void gfx_pick_formats(void);
void gfx_make_image(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImage *image);
