// A render graph: resources and passes are declared, the operations are derived later from who reads what.
#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace graph {

struct AttachmentInfo {
    VkFormat format = VK_FORMAT_UNDEFINED;
    float scale = 1.0f;
    unsigned samples = 1;
    bool persistent = true;
    VkImageUsageFlags extraUsage = 0;
};

struct Resource {
    std::string name;
    AttachmentInfo info;
    std::vector<unsigned> writers, readers;
};

class Pass {
public:
    Resource& addColorOutput(const std::string& name, const AttachmentInfo& info, const std::string& input = "");
    Resource& addResolveOutput(const std::string& name, const AttachmentInfo& info);
    Resource& setDepthStencilOutput(const std::string& name, const AttachmentInfo& info);
    Resource& addTextureInput(const std::string& name);
    void setExecute(std::function<void(VkCommandBuffer)> function) { execute = std::move(function); }

private:
    std::function<void(VkCommandBuffer)> execute;
};

class Graph {
public:
    Pass& addPass(const std::string& name);
    void setBackbuffer(const std::string& name);
    void bake();

private:
    std::vector<Resource> resources;
    std::unordered_map<std::string, size_t> byName;
    VkDevice device{};

    void bakePhysicalPass(const std::vector<size_t>& used);
};

// Operations from the readers that the graph has found: nothing of it is fixed in the source.
void Graph::bakePhysicalPass(const std::vector<size_t>& used) {
    std::vector<VkAttachmentDescription2> descriptions;
    for (size_t index : used) {
        const Resource& resource = resources[index];
        VkAttachmentDescription2 description = {VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2};
        description.format = resource.info.format;
        description.samples = static_cast<VkSampleCountFlagBits>(resource.info.samples);
        description.loadOp = resource.writers.size() > 1 ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
        description.storeOp = resource.readers.empty() ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
        description.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        description.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        description.initialLayout = VK_IMAGE_LAYOUT_GENERAL;
        description.finalLayout = VK_IMAGE_LAYOUT_GENERAL;
        descriptions.push_back(description);
    }
    VkRenderPassCreateInfo2 info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2};
    info.attachmentCount = static_cast<uint32_t>(descriptions.size());
    info.pAttachments = descriptions.data();
    VkRenderPass pass;
    vkCreateRenderPass2(device, &info, nullptr, &pass);
}

}  // namespace graph

void describeFrame(graph::Graph& graph, unsigned samples) {
    graph::AttachmentInfo color, depth, backbuffer;
    color.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    color.samples = 4;
    depth.format = VK_FORMAT_D32_SFLOAT;
    depth.samples = samples;
    depth.persistent = false;
    backbuffer.format = VK_FORMAT_B8G8R8A8_SRGB;

    auto& scene = graph.addPass("scene");
    scene.addColorOutput("color-ms", color);
    scene.addResolveOutput("color", backbuffer);
    scene.setDepthStencilOutput("depth-ms", depth);
    scene.setExecute([](VkCommandBuffer cmd) { vkCmdDraw(cmd, 3, 1, 0, 0); });

    auto& post = graph.addPass("post");
    post.addTextureInput("color");
    post.addColorOutput("backbuffer", backbuffer);
    graph.setBackbuffer("backbuffer");
    graph.bake();
}
