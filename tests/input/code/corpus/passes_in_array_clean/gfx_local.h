/* What the files of the renderer share. */
#include <vulkan/vulkan.h>

enum pass_id { PASS_SCENE = 0, PASS_HUD = 1, PASS_MAX = 2 };

typedef struct {
    VkImage image;
    VkImageView view;
    VkDeviceMemory memory;
    VkFormat format;
    VkSampleCountFlagBits count;
} target_t;

typedef struct {
    VkRenderPass handle;
    VkAttachmentLoadOp colorLoad;
    VkSampleCountFlagBits count;
} pass_t;

typedef struct { float value; } setting_t;

extern VkDevice gfx_device;
extern VkExtent2D gfx_extent;
extern VkFormat gfx_format;
extern VkPhysicalDeviceLimits gfx_limits;
extern pass_t gfx_passes[PASS_MAX];

void target_color(VkSampleCountFlagBits count, target_t *target, VkImageUsageFlags more);
void target_depth(VkSampleCountFlagBits count, target_t *target);
void target_free(target_t *target);
void report(const char *text, ...);
