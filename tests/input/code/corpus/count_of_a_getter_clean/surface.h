#pragma once
#include "settings.h"

namespace quarry {

class View {
public:
    const PictureSettings& settings() const { return m_settings; }

private:
    PictureSettings m_settings;
};

class Surface {
protected:
    void allocate(vk::Device device, vk::Format format, vk::Extent2D extent, vk::SampleCountFlagBits samples);

    vk::Format m_format{vk::Format::eUndefined};
    vk::UniqueImage m_image;
};

}  // namespace quarry
