// Passes and pipelines of which other code decides a part: what is known of the rest is said, and nothing that the unknown part could refute.
#include <vulkan/vulkan.h>

#include <vector>

VkAttachmentDescription describeShadowMap(int cascade);
std::vector<VkAttachmentReference> inputsOf(int subpass);
const VkSubpassDescription& describeLighting(int quality);
const VkPipelineDynamicStateCreateInfo* dynamicStates();

class Graph {
public:
    void createScene();
    void createWithInputs(int index);
    void createTwoSubpasses(int quality);
    void createPipeline(VkPipelineLayout layout);
    void createUnknownResolve(const VkAttachmentReference* resolves);

private:
    VkDevice device = VK_NULL_HANDLE;
    VkRenderPass scene = VK_NULL_HANDLE, inputs = VK_NULL_HANDLE, two = VK_NULL_HANDLE, custom = VK_NULL_HANDLE;
    VkPipeline foliage = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_B8G8R8A8_UNORM;
};

// Nothing is known of the third attachment.
void Graph::createScene() {
    std::vector<VkAttachmentDescription> attachments(3);
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[2] = describeShadowMap(0);
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth{2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 3;
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &scene);
}

// The subpass may read any attachment: a color that is discarded without a resolve may be read, and one that seems unused may be used.
void Graph::createWithInputs(int index) {
    std::vector<VkAttachmentReference> read = inputsOf(index);
    VkAttachmentDescription attachments[4] = {};
    for (VkAttachmentDescription& attachment : attachments) {
        attachment.format = format;
        attachment.samples = VK_SAMPLE_COUNT_4_BIT;
        attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachment.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[3].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachments[3].initialLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference colors[2] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkAttachmentReference resolves[2] = {{VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED}, {2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass{};
    subpass.inputAttachmentCount = static_cast<uint32_t>(read.size());
    subpass.pInputAttachments = read.data();
    subpass.colorAttachmentCount = 2;
    subpass.pColorAttachments = colors;
    subpass.pResolveAttachments = resolves;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 4;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &inputs);
}

// The second subpass comes from elsewhere.
void Graph::createTwoSubpasses(int quality) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpasses[2] = {};
    subpasses[0].colorAttachmentCount = 1;
    subpasses[0].pColorAttachments = &color;
    subpasses[0].pResolveAttachments = &resolve;
    subpasses[1] = describeLighting(quality);
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 2;
    info.pSubpasses = subpasses;
    vkCreateRenderPass(device, &info, nullptr, &two);
}

// Which states are dynamic is decided elsewhere; the program sets no sample count dynamically.
void Graph::createPipeline(VkPipelineLayout layout) {
    VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    multisample.alphaToCoverageEnable = VK_TRUE;  // expect: MSAA505
    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
    info.pMultisampleState = &multisample;
    info.pDynamicState = dynamicStates();
    info.layout = layout;
    info.renderPass = scene;
    vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &foliage);
}

// Whether the color is resolved is not known, so that nothing is said of its store operation.
void Graph::createUnknownResolve(const VkAttachmentReference* resolves) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = format;
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].format = format;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = resolves;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &custom);
}

// Whether there is a depth attachment is the caller's choice; the color is stored in vain with it and without.
VkRenderPass createMirror(VkDevice device, bool withDepth, VkFormat depthFormat) {
    std::vector<VkAttachmentDescription> attachments;
    if (withDepth) {
        VkAttachmentDescription depth{};
        depth.format = depthFormat;
        depth.samples = VK_SAMPLE_COUNT_4_BIT;
        depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments.push_back(depth);
    }
    const uint32_t colorIndex = static_cast<uint32_t>(attachments.size());
    VkAttachmentDescription color{};
    color.format = VK_FORMAT_R8G8B8A8_UNORM;
    color.samples = VK_SAMPLE_COUNT_4_BIT;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
    attachments.push_back(color);
    VkAttachmentDescription resolved = color;
    resolved.samples = VK_SAMPLE_COUNT_1_BIT;
    resolved.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments.push_back(resolved);
    VkAttachmentReference depthReference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference colorReference{colorIndex, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveReference{colorIndex + 1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &resolveReference;
    if (withDepth) subpass.pDepthStencilAttachment = &depthReference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
