// Counts that a program chooses under the user's limit and the device's: whatever they are, they are above 1 where the pass resolves.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdint>

int log2pad(int value, int roundUp);
extern struct cvar_s { const char* string; float value; int integer; } *r_multisample, *r_fsaa;
extern uint32_t userLimit;

struct Device {
    VkDevice handle;
    VkPhysicalDevice physical;
    VkSampleCountFlags counts;
};
static Device device;
static VkFormat colorFormat = VK_FORMAT_R8G8B8A8_UNORM;

static VkRenderPass createPass(VkSampleCountFlagBits samples, VkAttachmentStoreOp storeOp) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = colorFormat;
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = storeOp;
    attachments[1].format = colorFormat;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device.handle, &info, nullptr, &pass);
    return pass;
}

// An image of a count that is halved until it fits: drawn and resolved elsewhere, kept by nobody.
VkImage createHalved() {
    int samples = std::max(log2pad(r_multisample->integer, 1), 2);
    while (samples > static_cast<int>(userLimit)) samples >>= 1;
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = colorFormat;
    info.extent = {1920, 1080, 1};
    info.mipLevels = 4;  // expect: MSAA106
    info.arrayLayers = 1;
    info.samples = static_cast<VkSampleCountFlagBits>(samples);
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImage image = VK_NULL_HANDLE;
    vkCreateImage(device.handle, &info, nullptr, &image);
    return image;
}

VkRenderPass createLeast() {
    const uint32_t samples = std::min(userLimit, static_cast<uint32_t>(device.counts));
    return createPass(static_cast<VkSampleCountFlagBits>(samples), VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

VkRenderPass createShifted(uint32_t exponent) {
    return createPass(VkSampleCountFlagBits(1u << exponent), VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

VkRenderPass createHighestBit() {
    uint32_t samples = 64;
    while (samples > 1 && !(device.counts & samples)) samples /= 2;
    return createPass((VkSampleCountFlagBits)samples, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

VkRenderPass createChain() {
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    const int wanted = r_fsaa->integer;
    if (wanted >= 16 && (device.counts & VK_SAMPLE_COUNT_16_BIT)) {
        samples = VK_SAMPLE_COUNT_16_BIT;
    } else if (wanted >= 8 && (device.counts & VK_SAMPLE_COUNT_8_BIT)) {
        samples = VK_SAMPLE_COUNT_8_BIT;
    } else if (wanted >= 4 && (device.counts & VK_SAMPLE_COUNT_4_BIT)) {
        samples = VK_SAMPLE_COUNT_4_BIT;
    } else if (wanted >= 2 && (device.counts & VK_SAMPLE_COUNT_2_BIT)) {
        samples = VK_SAMPLE_COUNT_2_BIT;
    }
    return createPass(samples, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

static VkSampleCountFlagBits getSampleCount(unsigned count) {
    switch (count) {
    case 2: return VK_SAMPLE_COUNT_2_BIT;
    case 4: return VK_SAMPLE_COUNT_4_BIT;
    case 8: return VK_SAMPLE_COUNT_8_BIT;
    default: return VK_SAMPLE_COUNT_1_BIT;
    }
}

VkRenderPass createMapped() {
    return createPass(getSampleCount(4), VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

VkRenderPass createPlain() {
    return createPass((VkSampleCountFlagBits)4, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

VkRenderPass createDiscarded() {
    return createPass(getSampleCount(4), VK_ATTACHMENT_STORE_OP_DONT_CARE);
}
