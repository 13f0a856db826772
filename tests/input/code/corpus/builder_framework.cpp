// A library of one's own over Vulkan: passes are put together by a builder, which is defined elsewhere. Nothing can be known here.
#include <vulkan/vulkan.h>

#include <memory>
#include <string>
#include <string_view>

namespace engine {

enum class Load { Clear, Keep, Discard };
enum class Store { Keep, Discard, Resolve, ResolveAndKeep };

struct Handle {
    uint32_t index = ~0u;
};

class Pass {
public:
    void execute(VkCommandBuffer cmd);
};

class PassBuilder {
public:
    explicit PassBuilder(std::string_view name);
    PassBuilder& samples(int count);
    PassBuilder& color(std::string_view name, VkFormat format, Load load = Load::Clear, Store store = Store::Keep);
    PassBuilder& depth(std::string_view name, VkFormat format, Load load = Load::Clear, Store store = Store::Discard);
    PassBuilder& resolve(std::string_view from, std::string_view to);
    PassBuilder& setSampleCount(VkSampleCountFlagBits count);
    PassBuilder& storeOp(VkAttachmentStoreOp op);
    std::unique_ptr<Pass> build();
};

class TextureBuilder {
public:
    TextureBuilder& format(VkFormat format);
    TextureBuilder& samples(VkSampleCountFlagBits count);
    TextureBuilder& usage(VkImageUsageFlags usage);
    TextureBuilder& memoryless(bool on);
    Handle build(std::string_view name);
};

class PipelineBuilder {
public:
    PipelineBuilder& setMultisampling(VkSampleCountFlagBits samples);
    PipelineBuilder& setMultisamplingNone();
    PipelineBuilder& enableAlphaToCoverage();
    PipelineBuilder& sampleShading(float least);
    VkPipeline build(VkDevice device);
};

}  // namespace engine

using engine::Load;
using engine::Store;

std::unique_ptr<engine::Pass> makeForward() {
    return engine::PassBuilder("forward")
        .samples(4)
        .color("color", VK_FORMAT_R8G8B8A8_UNORM, Load::Clear, Store::Keep)
        .depth("depth", VK_FORMAT_D32_SFLOAT, Load::Clear, Store::Keep)
        .resolve("color", "backbuffer")
        .build();
}

std::unique_ptr<engine::Pass> makeWater() {
    engine::PassBuilder builder{"water"};
    builder.setSampleCount(VK_SAMPLE_COUNT_8_BIT).storeOp(VK_ATTACHMENT_STORE_OP_STORE);
    builder.color("reflection", VK_FORMAT_R16G16B16A16_SFLOAT);
    return builder.build();
}

void makeTextures() {
    engine::TextureBuilder()
        .format(VK_FORMAT_R8G8B8A8_UNORM)
        .samples(VK_SAMPLE_COUNT_4_BIT)
        .usage(VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)
        .build("color");
    engine::TextureBuilder()
        .format(VK_FORMAT_D32_SFLOAT)
        .samples(VK_SAMPLE_COUNT_4_BIT)
        .usage(VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT)
        .memoryless(true)
        .build("depth");
}

VkPipeline makeFoliage(VkDevice device) {
    return engine::PipelineBuilder().setMultisamplingNone().enableAlphaToCoverage().sampleShading(0.2f).build(device);
}
