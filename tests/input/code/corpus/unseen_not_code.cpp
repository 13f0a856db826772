// What looks like code and is not: comments, strings, raw strings, blocks that the preprocessor leaves out, text of tests. Nothing is wrong.
#include <vulkan/vulkan.h>

#include <cassert>
#include <string>

/*
    attachment.samples = VK_SAMPLE_COUNT_4_BIT;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;
    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_4_BIT;
*/

static const char* kShader = R"glsl(
    // VkSampleCountFlags counts = std::min(limits.framebufferColorSampleCounts, limits.framebufferDepthSampleCounts);
    uniform sampler2DMS image;
)glsl";

static const std::string kHelp =
    "attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE; attachment.samples = VK_SAMPLE_COUNT_4_BIT; /* not a comment";

#define EXPECT_EQ(a, b) assert((a) == (b))
#define TEST(suite, name) static void suite##_##name()

static VkAttachmentDescription describe() {
    VkAttachmentDescription attachment{};
    attachment.format = VK_FORMAT_R8G8B8A8_UNORM;
    attachment.samples = VK_SAMPLE_COUNT_4_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    // attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  before: far too slow on phones \
       attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
#if 0
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
#endif
#ifdef KEEP_SAMPLES_FOR_DEBUGGING_ONLY
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
#endif
    attachment.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return attachment;
}

VkRenderPass createPass(VkDevice device) {
    VkAttachmentDescription attachments[2] = {describe(), describe()};
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

TEST(Attachment, Describes) {
    VkAttachmentDescription attachment = describe();
    EXPECT_EQ(attachment.storeOp, VK_ATTACHMENT_STORE_OP_DONT_CARE);
    if (attachment.samples == VK_SAMPLE_COUNT_8_BIT) EXPECT_EQ(attachment.storeOp, VK_ATTACHMENT_STORE_OP_STORE);
    attachment = {};
    EXPECT_EQ(attachment.storeOp, VK_ATTACHMENT_STORE_OP_STORE);
}

const char* name(VkAttachmentStoreOp op) {
    switch (op) {
    case VK_ATTACHMENT_STORE_OP_STORE: return "store";
    case VK_ATTACHMENT_STORE_OP_DONT_CARE: return "don't care";
    default: return kHelp.empty() ? kShader : "?";
    }
}

int main() { Attachment_Describes(); }
