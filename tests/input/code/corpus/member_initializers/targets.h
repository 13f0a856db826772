#pragma once

#include "image.h"

namespace app {

class ColorTarget {
public:
    ColorTarget(const Device& device, uint32_t width, uint32_t height);
    VkImageView view() const { return m_view; }

private:
    Image m_image;
    ImageView m_view;
};

class DepthTarget {
public:
    DepthTarget(const Device& device, uint32_t width, uint32_t height);
    VkImageView view() const { return m_view; }

private:
    Image m_image;
    ImageView m_view;
};

}
