// A rendering interface over several programming interfaces: structures of its own that are named like Vulkan's.
#include <cstdint>
#include <memory>
#include <vector>

namespace rhi {

enum class SampleCount : uint32_t { e1 = 1, e2 = 2, e4 = 4, e8 = 8 };
enum class LoadOp { Load, Clear, DontCare };
enum class StoreOp { Store, DontCare, Resolve };
enum class Usage : uint32_t { ColorAttachment = 1, DepthStencilAttachment = 2, Sampled = 4, TransferSrc = 8 };
constexpr Usage operator|(Usage a, Usage b) { return Usage(uint32_t(a) | uint32_t(b)); }

// Not VkAttachmentDescription, though it looks like one: `storeOp` here is a wish that the back end may overrule.
struct AttachmentDescription {
    int format = 0;
    SampleCount samples = SampleCount::e1;
    LoadOp loadOp = LoadOp::Clear;
    StoreOp storeOp = StoreOp::Store;
};

struct ImageCreateInfo {
    int format = 0;
    uint32_t width = 1, height = 1;
    SampleCount samples = SampleCount::e1;
    Usage usage = Usage::Sampled;
    bool memoryless = false;
};

struct SubpassDescription {
    std::vector<uint32_t> colorAttachments, resolveAttachments;
    int depthStencilAttachment = -1;
};

struct RenderPassCreateInfo {
    std::vector<AttachmentDescription> attachments;
    std::vector<SubpassDescription> subpasses;
};

class Device {
public:
    virtual ~Device() = default;
    virtual uint64_t createImage(const ImageCreateInfo& info) = 0;
    virtual uint64_t createRenderPass(const RenderPassCreateInfo& info) = 0;
};

}  // namespace rhi

struct Scene {
    uint64_t color, depth, pass;
};

Scene create(rhi::Device& device, uint32_t width, uint32_t height) {
    Scene scene;
    rhi::ImageCreateInfo info;
    info.format = 37;
    info.width = width;
    info.height = height;
    info.samples = rhi::SampleCount::e4;
    info.usage = rhi::Usage::ColorAttachment;
    scene.color = device.createImage(info);
    info.format = 126;
    info.usage = rhi::Usage::DepthStencilAttachment;
    scene.depth = device.createImage(info);

    rhi::RenderPassCreateInfo pass;
    rhi::AttachmentDescription color;
    color.format = 37;
    color.samples = rhi::SampleCount::e4;
    color.storeOp = rhi::StoreOp::Store;
    rhi::AttachmentDescription resolve = color;
    resolve.samples = rhi::SampleCount::e1;
    rhi::AttachmentDescription depth{126, rhi::SampleCount::e4, rhi::LoadOp::Clear, rhi::StoreOp::Store};
    pass.attachments = {color, resolve, depth};
    pass.subpasses.push_back({{0}, {1}, 2});
    scene.pass = device.createRenderPass(pass);
    return scene;
}
