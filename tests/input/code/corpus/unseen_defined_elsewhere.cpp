// One of several files of a program: members begin with values here that methods of another file change. What they are is not known.
#include <vulkan/vulkan.h>

#include <array>

class Renderer {
public:
    Renderer();
    virtual ~Renderer();
    void loadSettings(const char* path);  // in another file, and so is the constructor
    void pickDevice();

    bool keepSamples = true;

protected:
    void createTargets(VkExtent2D size);
    void createPass();
    void createPipeline(VkPipelineLayout layout);

    VkDevice device{};
    VkFormat format = VK_FORMAT_B8G8R8A8_SRGB;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    VkAttachmentStoreOp colorStore = VK_ATTACHMENT_STORE_OP_STORE;
    VkImageUsageFlags extraUsage = 0;
    VkImage color{}, depth{};
    VkRenderPass pass{};
    VkPipeline pipeline{};
};

extern VkSampleCountFlagBits g_samples;
VkSampleCountFlagBits g_depthSamples = VK_SAMPLE_COUNT_1_BIT;  // not static: anyone may set it
void configure();

void Renderer::createTargets(VkExtent2D size) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = samples;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | extraUsage;
    vkCreateImage(device, &info, nullptr, &color);
    info.format = VK_FORMAT_D32_SFLOAT;
    info.samples = g_depthSamples;
    info.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | extraUsage;
    vkCreateImage(device, &info, nullptr, &depth);
}

void Renderer::createPass() {
    configure();
    std::array<VkAttachmentDescription, 3> attachments{};
    attachments[0].format = format;
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = colorStore;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = g_depthSamples;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[2].format = format;
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[2].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
}

void Renderer::createPipeline(VkPipelineLayout layout) {
    VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = g_samples;
    multisample.alphaToCoverageEnable = VK_TRUE;
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pMultisampleState = &multisample;
    info.renderPass = pass;
    info.layout = layout;
    vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);

    multisample.rasterizationSamples = samples;
    multisample.sampleShadingEnable = VK_TRUE;
    multisample.minSampleShading = 0.2f;
    vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline);
}

// The methods of this class stand in its header, and this is its header: all of it is here, but its members are anybody's.
struct Options {
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    bool alphaToCoverage = false;

    VkPipelineMultisampleStateCreateInfo state() const {
        VkPipelineMultisampleStateCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
        info.rasterizationSamples = samples;
        info.alphaToCoverageEnable = alphaToCoverage || samples == VK_SAMPLE_COUNT_1_BIT ? VK_FALSE : VK_TRUE;
        return info;
    }
};
