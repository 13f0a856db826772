#include "render_pass.h"

constexpr VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;

int main() {
    VkDevice device = VK_NULL_HANDLE;
    const VkExtent3D extent = {1280, 720, 1};
    auto color = std::make_shared<cookbook::Texture>(device, VK_FORMAT_B8G8R8A8_UNORM,
                                                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,  // expect-later: MSAA401
                                                     extent, samples);
    auto depth = std::make_shared<cookbook::Texture>(device, VK_FORMAT_D32_SFLOAT,
                                                     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                                                     extent, samples);
    auto surface = std::make_shared<cookbook::Texture>(device, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, extent,
                                                       VK_SAMPLE_COUNT_1_BIT);
    cookbook::RenderPass pass(device, {color, depth}, {surface},
                              {VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE},
                              {VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA201
                               VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE},
                              {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                               VK_IMAGE_LAYOUT_PRESENT_SRC_KHR});
    return 0;
}
