// An engine's cache of passes: a key of bits decides everything, constants have names of their own. Nothing can be said.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <unordered_map>
#include <utility>

namespace backend {

enum class TargetFlags : uint32_t { NONE = 0, COLOR0 = 1, COLOR1 = 2, DEPTH = 16, ALL = 31 };
constexpr TargetFlags operator&(TargetFlags a, TargetFlags b) { return TargetFlags(uint32_t(a) & uint32_t(b)); }
constexpr bool any(TargetFlags flags) { return uint32_t(flags) != 0; }

struct PassKey {
    VkFormat colorFormat[4] = {};
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;
    TargetFlags clear = TargetFlags::NONE;
    TargetFlags discardStart = TargetFlags::NONE;
    TargetFlags discardEnd = TargetFlags::NONE;
    uint8_t samples = 4;
    uint8_t needsResolveMask = 0;
    uint8_t usesLazilyAllocatedMemory = 0;
};

static constexpr VkAttachmentLoadOp kClear = VK_ATTACHMENT_LOAD_OP_CLEAR;
static constexpr VkAttachmentLoadOp kDontCare = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
static constexpr VkAttachmentLoadOp kKeep = VK_ATTACHMENT_LOAD_OP_LOAD;
static constexpr VkAttachmentStoreOp kDisableStore = VK_ATTACHMENT_STORE_OP_DONT_CARE;
static constexpr VkAttachmentStoreOp kEnableStore = VK_ATTACHMENT_STORE_OP_STORE;

class PassCache {
public:
    explicit PassCache(VkDevice device) : mDevice(device) {}
    VkRenderPass get(const PassKey& key) noexcept;

private:
    VkDevice mDevice;
    std::unordered_map<uint64_t, VkRenderPass> mPasses;
};

VkRenderPass PassCache::get(const PassKey& key) noexcept {
    VkAttachmentReference colorRefs[4] = {};
    VkAttachmentReference resolveRefs[4] = {};
    VkAttachmentReference depthRef = {};
    const bool hasDepth = key.depthFormat != VK_FORMAT_UNDEFINED;
    VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                 .pColorAttachments = colorRefs,
                                 .pResolveAttachments = resolveRefs,
                                 .pDepthStencilAttachment = hasDepth ? &depthRef : nullptr};
    VkAttachmentDescription attachments[9] = {};
    VkRenderPassCreateInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, .pAttachments = attachments, .subpassCount = 1, .pSubpasses = &subpass};

    int index = 0;
    for (int i = 0; i < 4; i++) {
        if (key.colorFormat[i] == VK_FORMAT_UNDEFINED) continue;
        const TargetFlags flag = TargetFlags(uint32_t(TargetFlags::COLOR0) << i);
        const bool clear = any(key.clear & flag);
        const bool discard = any(key.discardStart & flag);
        const bool lazy = key.usesLazilyAllocatedMemory & (1 << i);
        colorRefs[subpass.colorAttachmentCount].layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        colorRefs[subpass.colorAttachmentCount].attachment = uint32_t(index);
        subpass.colorAttachmentCount++;
        attachments[index++] = {
            .format = key.colorFormat[i],
            .samples = VkSampleCountFlagBits(key.samples),
            .loadOp = clear ? kClear : (discard ? kDontCare : kKeep),
            .storeOp = (key.samples == 1 && !any(key.discardEnd & flag)) || !lazy ? kEnableStore : kDisableStore,
            .stencilLoadOp = kDontCare,
            .stencilStoreOp = kDisableStore,
            .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        };
    }
    for (uint32_t i = 0; i < 4; i++) {
        resolveRefs[i].attachment = VK_ATTACHMENT_UNUSED;
        if (!(key.needsResolveMask & (1 << i))) continue;
        resolveRefs[i] = {uint32_t(index), VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        attachments[index++] = {
            .format = key.colorFormat[i],
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = kDontCare,
            .storeOp = kEnableStore,
            .stencilLoadOp = kDontCare,
            .stencilStoreOp = kDisableStore,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        };
    }
    if (hasDepth) {
        depthRef = {uint32_t(index), VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
        attachments[index++] = {
            .format = key.depthFormat,
            .samples = VkSampleCountFlagBits(key.samples),
            .loadOp = any(key.clear & TargetFlags::DEPTH) ? kClear : kKeep,
            .storeOp = any(key.discardEnd & TargetFlags::DEPTH) ? kDisableStore : kEnableStore,
            .stencilLoadOp = kDontCare,
            .stencilStoreOp = kDisableStore,
            .initialLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        };
    }
    info.attachmentCount = uint32_t(index);
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(mDevice, &info, nullptr, &pass);
    mPasses.emplace(mPasses.size(), pass);
    return pass;
}

}  // namespace backend
