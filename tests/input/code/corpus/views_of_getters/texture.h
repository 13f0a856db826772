// A texture of a rendering engine, whose views other classes only see through getters.
#pragma once

#include <vulkan/vulkan.h>

namespace engine {

class Texture {
public:
    VkImageView view() const { return view_; }
    VkImageView resolved() const;
    uint32_t samples() const { return samples_; }

private:
    VkImageView view_ = VK_NULL_HANDLE;
    uint32_t samples_ = 1;
};

}  // namespace engine
