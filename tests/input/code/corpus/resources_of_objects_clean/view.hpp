#pragma once

#include "target.hpp"

// Of the targets, the first two need no memory of their own; a shader reads the last.
class View {
public:
    ScenePass* pass;
    Target* color;
    Target* depth;
    Target* picked;
    std::vector<Canvas*> canvases;
    std::vector<VkImageView> surfaces;
    VkDevice device;
    explicit View(VkDevice device);
    VkDescriptorImageInfo pick(VkSampler sampler);
};

// Something that has a view: where it creates it is not shown.
struct Window {
    View* view;
};
