#pragma once

#include <vulkan/vulkan.h>

class SwapChain {
public:
    static SwapChain* Get();
    int Samples() const { return samples_; }
    void SetSamples(int samples) { samples_ = samples; }
    VkFormat Format() const { return format_; }

private:
    int samples_ = 1;
    VkFormat format_ = VK_FORMAT_B8G8R8A8_SRGB;
};
