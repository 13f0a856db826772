#pragma once
#include "surface.h"

namespace quarry {

class DepthSurface : public Surface {
public:
    void create(vk::PhysicalDevice adapter, vk::Device device, const View* view);
};

}  // namespace quarry
