// The scene's samples are resolved in the pass, and stored as well; the image has several mip levels.
#include "builders.h"

class Scene {
public:
    void CreateTargets(VkDevice device);
    VkRenderPass CreatePass(VkDevice device);

private:
    std::unique_ptr<Image> color, target;
};

void Scene::CreateTargets(VkDevice device) {
    color = ImageBuilder()
                .Size(640, 480, 4)  // expect: MSAA106
                .Samples(VK_SAMPLE_COUNT_4_BIT)
                .Format(VK_FORMAT_R16G16B16A16_SFLOAT)
                .Usage(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT)
                .Create(device);
    target = ImageBuilder()
                 .Size(640, 480)
                 .Format(VK_FORMAT_R16G16B16A16_SFLOAT)
                 .Usage(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT)
                 .Create(device);
}

VkRenderPass Scene::CreatePass(VkDevice device) {
    return RenderPassBuilder()
        .AddAttachment(VK_FORMAT_R16G16B16A16_SFLOAT, VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                       VK_ATTACHMENT_STORE_OP_STORE)  // expect: MSAA201
        .AddResolve(VK_FORMAT_R16G16B16A16_SFLOAT, VK_ATTACHMENT_STORE_OP_STORE)
        .Create(device);
}
