// A class behind a pointer to its parts: counts by casts and shifts, file-wide constant descriptions, depth of another count than colour.
#include <vulkan/vulkan.h>

#include <memory>
#include <vector>

constexpr uint32_t kLog2Samples = 2;
constexpr auto kSamples = static_cast<VkSampleCountFlagBits>(1u << kLog2Samples);

static const VkAttachmentDescription kAttachments[] = {
    {
        0,
        VK_FORMAT_R8G8B8A8_UNORM,
        kSamples,
        VK_ATTACHMENT_LOAD_OP_CLEAR,
        VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA201
        VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        VK_ATTACHMENT_STORE_OP_DONT_CARE,
        VK_IMAGE_LAYOUT_UNDEFINED,
        VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
    },
    {
        0,
        VK_FORMAT_R8G8B8A8_UNORM,
        VK_SAMPLE_COUNT_1_BIT,
        VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        VK_ATTACHMENT_STORE_OP_STORE,
        VK_ATTACHMENT_LOAD_OP_DONT_CARE,
        VK_ATTACHMENT_STORE_OP_DONT_CARE,
        VK_IMAGE_LAYOUT_UNDEFINED,
        VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
    },
};
static const VkAttachmentReference kColor = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
static const VkAttachmentReference kResolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};

class Painter {
public:
    explicit Painter(VkDevice device);
    ~Painter();
    void createMainPass();
    void createGlowPass();
    void createPipelines(VkPipelineLayout layout);

private:
    struct Parts;
    std::unique_ptr<Parts> m;
};

struct Painter::Parts {
    VkDevice device{};
    VkRenderPass main{}, glow{};
    VkPipeline leaves{}, sky{};
    VkSampleCountFlagBits samples = kSamples;
};

Painter::Painter(VkDevice device) : m(std::make_unique<Parts>()) { m->device = device; }
Painter::~Painter() = default;

void Painter::createMainPass() {
    VkSubpassDescription subpass = {};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &kColor;
    subpass.pResolveAttachments = &kResolve;
    const VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO, nullptr, 0, 2, kAttachments, 1, &subpass, 0, nullptr};
    vkCreateRenderPass(m->device, &info, nullptr, &m->main);
}

// Colour with four samples, depth with one: no device without an extension takes that.
void Painter::createGlowPass() {
    std::vector<VkAttachmentDescription> attachments(3);
    attachments.at(0).format = VK_FORMAT_R16G16B16A16_SFLOAT;
    attachments.at(0).samples = m->samples;  // may: MSAA103#mixed
    attachments.at(0).loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments.at(0).storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments.at(0).finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments.at(1).format = VK_FORMAT_D32_SFLOAT;
    attachments.at(1).samples = (VkSampleCountFlagBits)1;  // expect: MSAA103#mixed
    attachments.at(1).loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments.at(1).storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments.at(1).finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments.at(2).format = VK_FORMAT_R16G16B16A16_SFLOAT;
    attachments.at(2).samples = VK_SAMPLE_COUNT_1_BIT;
    attachments.at(2).loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments.at(2).storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments.at(2).finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference depth = {1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};  // may: MSAA103#mixed
    VkAttachmentReference resolve = {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &kColor;
    subpass.pResolveAttachments = &resolve;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = uint32_t(attachments.size());
    info.pAttachments = &attachments[0];
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(m->device, &info, nullptr, &m->glow);
}

void Painter::createPipelines(VkPipelineLayout layout) {
    VkPipelineMultisampleStateCreateInfo multisample = {VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = this->m->samples;
    multisample.alphaToCoverageEnable = VK_TRUE;  // may: MSAA507#blended
    VkPipelineColorBlendAttachmentState blend = {};
    blend.blendEnable = VK_TRUE;  // expect: MSAA507#blended
    blend.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    blend.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.colorWriteMask = 0xf;
    VkPipelineColorBlendStateCreateInfo blending = {VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blending.attachmentCount = 1;
    blending.pAttachments = &blend;
    VkGraphicsPipelineCreateInfo info = {VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pMultisampleState = &multisample;
    info.pColorBlendState = &blending;
    info.renderPass = m->main;
    info.layout = layout;
    vkCreateGraphicsPipelines(m->device, VK_NULL_HANDLE, 1, &info, nullptr, &m->leaves);

    VkPipelineMultisampleStateCreateInfo single = multisample;
    single.alphaToCoverageEnable = VK_FALSE;
    single.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;  // expect: MSAA104
    info.pMultisampleState = &single;
    vkCreateGraphicsPipelines(m->device, VK_NULL_HANDLE, 1, &info, nullptr, &m->sky);
}
