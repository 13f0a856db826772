#include "depth_surface.h"

namespace quarry {

void DepthSurface::create(vk::PhysicalDevice adapter, vk::Device device, const View* view) {
    m_format = pickDepthFormat(adapter);
    const auto samples = view->settings().samples();
    allocate(device, m_format, vk::Extent2D{1280, 720}, samples);
}

}  // namespace quarry
