// Vulkan behind classes of another library: images, targets and passes come from there, only a few of Vulkan's names are seen.
#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kit {

struct LoadStore {
    VkAttachmentLoadOp load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
    VkAttachmentStoreOp store_op = VK_ATTACHMENT_STORE_OP_STORE;
};

struct Attachment {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImageLayout initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

class Image {
public:
    Image(VkDevice device, VkExtent3D extent, VkFormat format, VkImageUsageFlags usage, int memory,
          VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);
    VkSampleCountFlagBits samples() const;
};

class RenderTarget {
public:
    explicit RenderTarget(std::vector<Image>&& images);
    const std::vector<Attachment>& attachments() const;
};

class Subpass {
public:
    virtual ~Subpass() = default;
    void set_output_attachments(std::vector<uint32_t> outputs);
    void set_color_resolve_attachments(std::vector<uint32_t> resolves);
    void set_depth_stencil_resolve_mode(VkResolveModeFlagBits mode);
    void set_sample_count(VkSampleCountFlagBits count);
};

class Pipeline {
public:
    void add_subpass(std::unique_ptr<Subpass>&& subpass);
    void set_load_store(const std::vector<LoadStore>& load_store);
    void draw(VkCommandBuffer cmd, RenderTarget& target);
};

struct MultisampleState {
    VkSampleCountFlagBits rasterization_samples{VK_SAMPLE_COUNT_1_BIT};
    VkBool32 sample_shading_enable{VK_FALSE};
    float min_sample_shading{0.0f};
};

}  // namespace kit

class MsaaSample {
public:
    std::unique_ptr<kit::RenderTarget> createTarget(VkDevice device, VkExtent3D extent) {
        std::vector<kit::Image> images;
        images.emplace_back(device, extent, VK_FORMAT_B8G8R8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 1);
        VkImageUsageFlags color_usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        if (resolve_in_pass) color_usage |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        else color_usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        images.emplace_back(device, extent, VK_FORMAT_B8G8R8A8_UNORM, color_usage, 1, samples);
        images.emplace_back(device, extent, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 1, samples);
        return std::make_unique<kit::RenderTarget>(std::move(images));
    }

    void usePass(kit::Pipeline& pipeline, std::unique_ptr<kit::Subpass>&& scene) {
        std::vector<kit::LoadStore> load_store(3);
        load_store[0].load_op = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        load_store[0].store_op = VK_ATTACHMENT_STORE_OP_STORE;
        load_store[1].load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
        load_store[1].store_op = resolve_in_pass ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
        load_store[2].load_op = VK_ATTACHMENT_LOAD_OP_CLEAR;
        load_store[2].store_op = VK_ATTACHMENT_STORE_OP_STORE;
        scene->set_output_attachments({1});
        if (resolve_in_pass) scene->set_color_resolve_attachments({0});
        scene->set_depth_stencil_resolve_mode(VK_RESOLVE_MODE_SAMPLE_ZERO_BIT);
        scene->set_sample_count(samples);
        pipeline.add_subpass(std::move(scene));
        pipeline.set_load_store(load_store);
    }

private:
    bool resolve_in_pass = true;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT;
    kit::MultisampleState multisample{VK_SAMPLE_COUNT_4_BIT, VK_TRUE, 0.2f};
};
