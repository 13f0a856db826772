// Samples that somebody reads: a second pass that goes on, an input attachment, a shader that fetches every sample.
#include <vulkan/vulkan.h>

#include <array>

constexpr VkSampleCountFlagBits kSamples = VK_SAMPLE_COUNT_4_BIT;

struct Images {
    VkImage color, depth, gbuffer;
    VkImageView colorView, depthView, gbufferView, windowView;
};

static VkImage image(VkDevice device, VkExtent2D size, VkFormat format, VkImageUsageFlags usage) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = kSamples;
    info.usage = usage;
    VkImage made{};
    vkCreateImage(device, &info, nullptr, &made);
    return made;
}

void createImages(VkDevice device, VkExtent2D size, Images& images) {
    images.color = image(device, size, VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
    images.depth = image(device, size, VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    images.gbuffer = image(device, size, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT);
}

// Depth is stored for the pass after this one, which loads it: that the load costs is said there, and only there.
VkRenderPass createPrepass(VkDevice device) {
    VkAttachmentDescription depth{};
    depth.format = VK_FORMAT_D32_SFLOAT;
    depth.samples = kSamples;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &depth;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

// The colour that this stores is sampled by a shader that weighs the samples itself.
VkRenderPass createScenePass(VkDevice device) {
    std::array<VkAttachmentDescription, 2> attachments{};
    attachments[0].format = VK_FORMAT_R16G16B16A16_SFLOAT;
    attachments[0].samples = kSamples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    attachments[1].format = VK_FORMAT_D32_SFLOAT;
    attachments[1].samples = kSamples;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA202
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[1].initialLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference depth{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pDepthStencilAttachment = &depth;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

// Not stored and not resolved, but read as an input attachment by the second subpass.
VkRenderPass createDeferredPass(VkDevice device, VkFormat window) {
    std::array<VkAttachmentDescription, 2> attachments{};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = kSamples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    attachments[1].format = window;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference written{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference read{0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkAttachmentReference output{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    std::array<VkSubpassDescription, 2> subpasses{};
    subpasses[0].colorAttachmentCount = 1;
    subpasses[0].pColorAttachments = &written;
    subpasses[1].inputAttachmentCount = 1;
    subpasses[1].pInputAttachments = &read;
    subpasses[1].colorAttachmentCount = 1;
    subpasses[1].pColorAttachments = &output;
    VkSubpassDependency between{};
    between.srcSubpass = 0;
    between.dstSubpass = 1;
    between.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    between.dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
    between.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    between.dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT;
    between.dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments.data();
    info.subpassCount = 2;
    info.pSubpasses = subpasses.data();
    info.dependencyCount = 1;
    info.pDependencies = &between;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

static VkFramebuffer framebuffer(VkDevice device, VkRenderPass pass, VkExtent2D size, const VkImageView* views, uint32_t count) {
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = pass;
    info.attachmentCount = count;
    info.pAttachments = views;
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    VkFramebuffer made{};
    vkCreateFramebuffer(device, &info, nullptr, &made);
    return made;
}

void createFramebuffers(VkDevice device, VkExtent2D size, const Images& images, VkFramebuffer out[3]) {
    out[0] = framebuffer(device, createPrepass(device), size, &images.depthView, 1);
    const VkImageView scene[] = {images.colorView, images.depthView};
    out[1] = framebuffer(device, createScenePass(device), size, scene, 2);
    const VkImageView deferred[] = {images.gbufferView, images.windowView};
    out[2] = framebuffer(device, createDeferredPass(device, VK_FORMAT_B8G8R8A8_UNORM), size, deferred, 2);
}
