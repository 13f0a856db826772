/* A device to draw on, and its commands. */

#ifndef DEVICE_H
#define DEVICE_H

#include <stdio.h>
#include <stdlib.h>

#include <vulkan/vulkan.h>

#define COUNT(array) ((uint32_t)(sizeof(array) / sizeof(array)[0]))
#define CHECK(call)                                                      \
    do {                                                                 \
        VkResult result_ = (call);                                       \
        if (result_ != VK_SUCCESS) {                                     \
            fprintf(stderr, "forward: %s gives %d\n", #call, result_);   \
            exit(1);                                                     \
        }                                                                \
    } while (0)

/* NAMED(IMAGE, image, "depth"): for whoever looks at a capture. */
#define NAMED(type, handle, name) named(VK_OBJECT_TYPE_##type, (uint64_t)(handle), name)

extern VkDevice device;
extern VkCommandBuffer buffer;

void open_device(void);
void close_device(void);
void named(VkObjectType type, uint64_t handle, const char *name);

/* Memory of a type that has what is needed, and what is wanted besides where there is one. */
VkDeviceMemory allocated(VkMemoryRequirements requirements, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags needed);

/* The command buffer, from its beginning to the end of its work. */
void begin_commands(void);
void submit_commands(void);
void begin_labelled(const char *name);
void end_labelled(void);

/* What is between them is a frame to RenderDoc, where that runs the program. It begins before there are images: at their contents, which
   RenderDoc 1.24 would read back first, lavapipe crashes now and then. */
void begin_capture(void);
void end_capture(void);

/* Writes an image of four bytes to a pixel, in the layout to be copied from, as a portable pixmap. */
void write_image(const char *path, VkImage image, VkExtent2D size);

#endif
