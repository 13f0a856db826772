#include "surface.h"

// One function creates the color image with the count, and the shadow map with one sample.
namespace quarry {

class ColorSurface : public Surface {
public:
    void create(vk::Device device, const View* view) {
        allocate(device, vk::Format::eR16G16B16A16Sfloat, vk::Extent2D{1280, 720}, view->settings().samples());
    }
};

class ShadowSurface : public Surface {
public:
    void create(vk::PhysicalDevice adapter, vk::Device device) {
        allocate(device, pickDepthFormat(adapter), vk::Extent2D{2048, 2048}, vk::SampleCountFlagBits::e1);
    }
};

/// A layer has the format that its creator names; a format with stencil is only the default.
class Layer {
public:
    Layer(vk::Format format, vk::SampleCountFlagBits samples) : m_layerFormat(format), m_layerSamples(samples) {}

    vk::ImageCreateInfo describe() const {
        return vk::ImageCreateInfo().setFormat(m_layerFormat).setSamples(m_layerSamples);
    }

private:
    vk::Format m_layerFormat = vk::Format::eD24UnormS8Uint;
    vk::SampleCountFlagBits m_layerSamples;
};

vk::ImageCreateInfo glow(const View* view) {
    return Layer(vk::Format::eR8G8B8A8Unorm, view->settings().samples()).describe();
}

void Surface::allocate(vk::Device device, vk::Format format, vk::Extent2D extent, vk::SampleCountFlagBits samples) {
    m_format = format;
    auto info = vk::ImageCreateInfo()
                    .setImageType(vk::ImageType::e2D)
                    .setFormat(m_format)
                    .setExtent(vk::Extent3D{extent, 1})
                    .setMipLevels(1)
                    .setArrayLayers(1)
                    .setSamples(samples)
                    .setTiling(vk::ImageTiling::eOptimal)
                    .setUsage(usageOf(format));
    m_image = device.createImageUnique(info);
}

}  // namespace quarry
