#include "view.hpp"

View::View(VkDevice device) {
    this->device = device;
    const VkSampleCountFlagBits count = VK_SAMPLE_COUNT_4_BIT;
    pass = new ScenePass(device, count);
    color = new Target(device, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, count, VK_IMAGE_ASPECT_COLOR_BIT);
    depth = new Target(device, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, count, VK_IMAGE_ASPECT_DEPTH_BIT);
    picked = new Target(
        device, VK_FORMAT_R32_UINT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, count, VK_IMAGE_ASPECT_COLOR_BIT);

    canvases.resize(surfaces.size());
    for (size_t i = 0; i < canvases.size(); i++) {
        std::array<VkImageView, 3> views = {color->texture->view, depth->texture->view, surfaces[i]};
        canvases[i] = new Canvas(device, pass->handle, static_cast<uint32_t>(views.size()), views.data());
    }
}

VkDescriptorImageInfo View::pick(VkSampler sampler) {
    return {sampler, picked->texture->view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
}
