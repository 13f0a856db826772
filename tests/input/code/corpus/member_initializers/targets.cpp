#include "targets.h"

using namespace app;

ColorTarget::ColorTarget(const Device& device, uint32_t width, uint32_t height)
    : m_image(device, width, height, VK_FORMAT_B8G8R8A8_SRGB,
              VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, device.samples()),
      m_view(device, m_image, VK_IMAGE_ASPECT_COLOR_BIT) {}

DepthTarget::DepthTarget(const Device& device, uint32_t width, uint32_t height)
    : m_image(device, width, height, VK_FORMAT_D32_SFLOAT_S8_UINT,
              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,  // expect: MSAA401
              device.samples()),
      m_view(device, m_image, VK_IMAGE_ASPECT_DEPTH_BIT) {}
