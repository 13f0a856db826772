// A game's shared header: structures are declared and cleared by macros, and the video settings are one global structure.
#ifndef SHARED_H
#define SHARED_H

#include <string.h>
#include <vulkan/vulkan.h>

#define CLEARED(type, name) \
    type name;              \
    memset(&name, 0, sizeof(type));
#define CLEARED_LIST(type, name, count) \
    type name[count];                   \
    memset(name, 0, sizeof(type) * count);
#define LENGTH_OF(list) (sizeof(list) / sizeof((list)[0]))

typedef struct {
    VkDevice device;
    VkPhysicalDevice physical;
    VkFormat color_format;
    VkFormat depth_format;
    VkSampleCountFlagBits sample_count;
} video_t;

extern video_t video;
extern int antialiasing;

void Vid_ChooseSamples(void);
void Vid_CreateDepth(void);
void Vid_CreateColor(void);
void Vid_CreateScenePass(void);

#endif
