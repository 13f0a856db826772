#include "settings.h"

namespace quarry {

void PictureSettings::setUp(vk::PhysicalDevice adapter) {
    setSamples(bestSamples(adapter));
}

PictureSettings& PictureSettings::setSamples(vk::SampleCountFlagBits samples) {
    m_samples = samples;
    return *this;
}

vk::SampleCountFlagBits PictureSettings::samples() const {
    return m_samples;
}

}  // namespace quarry
