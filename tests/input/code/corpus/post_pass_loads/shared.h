// Functions and options that the renderer shares with the rest of a game.
#ifndef SHARED_H
#define SHARED_H

#include <stddef.h>
#include <vulkan/vulkan.h>

#define CLEAR_TARGETS

#ifndef MIN
#define MIN(a, b) ((a) < (b) ? (a) : (b))
#endif

void Mem_Set(void *memory, int value, size_t size);

typedef struct {
    VkDevice device;
    VkFormat color_format;
    VkImage scene_image;
    VkRenderPass scene, post;
    VkBool32 multisampled;
} renderer_t;

extern renderer_t renderer;
extern VkSampleCountFlagBits renderer_samples;

#endif
