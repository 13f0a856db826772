// Chooses the sample count that the player asks for, as far as the format supports it.
#include "shared.h"

video_t video;
int antialiasing;

void Vid_ChooseSamples(void) {
    VkImageFormatProperties properties;
    vkGetPhysicalDeviceImageFormatProperties(video.physical, video.color_format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0, &properties);
    video.sample_count = VK_SAMPLE_COUNT_1_BIT;
    if (antialiasing >= 8 && (properties.sampleCounts & VK_SAMPLE_COUNT_8_BIT))
        video.sample_count = VK_SAMPLE_COUNT_8_BIT;
    else if (antialiasing >= 4 && (properties.sampleCounts & VK_SAMPLE_COUNT_4_BIT))
        video.sample_count = VK_SAMPLE_COUNT_4_BIT;
    else if (antialiasing >= 2 && (properties.sampleCounts & VK_SAMPLE_COUNT_2_BIT))
        video.sample_count = VK_SAMPLE_COUNT_2_BIT;
}
