// The count that both masks have is a bitwise and, not the smaller of them.
#include "shared.h"

renderer_t renderer;
VkSampleCountFlagBits renderer_samples;

void Device_ChooseSamples(const VkPhysicalDeviceProperties *properties, int wanted) {
    const VkSampleCountFlags most = MIN(properties->limits.framebufferColorSampleCounts,  // expect: MSAA852
                                        properties->limits.framebufferDepthSampleCounts);
    renderer.multisampled = wanted > 1;
    if (renderer.multisampled) {
        renderer_samples = wanted;
        while ((VkSampleCountFlags)renderer_samples > most)
            renderer_samples >>= 1;
    } else {
        renderer_samples = VK_SAMPLE_COUNT_1_BIT;
    }
}
