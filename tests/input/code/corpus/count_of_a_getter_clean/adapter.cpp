#include <array>

#include "settings.h"

namespace quarry {

vk::SampleCountFlagBits bestSamples(vk::PhysicalDevice adapter) {  // may: MSAA851
    const auto limits = adapter.getProperties().limits;
    const auto both = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts;
    for (auto count : {vk::SampleCountFlagBits::e8, vk::SampleCountFlagBits::e4, vk::SampleCountFlagBits::e2}) {
        if (both & count) {
            return count;
        }
    }
    return vk::SampleCountFlagBits::e1;
}

vk::Format pickDepthFormat(vk::PhysicalDevice adapter) {
    constexpr std::array wanted{vk::Format::eD32SfloatS8Uint, vk::Format::eD24UnormS8Uint};
    for (const auto format : wanted) {
        const auto features = adapter.getFormatProperties(format).optimalTilingFeatures;
        if (features & vk::FormatFeatureFlagBits::eDepthStencilAttachment) {
            return format;
        }
    }
    return vk::Format::eUndefined;
}

}  // namespace quarry
