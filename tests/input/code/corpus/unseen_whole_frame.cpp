// A whole frame by render passes: shadows, a multisampled scene, effects, a menu over it all; shaders read through descriptor sets. All right.
#include <vulkan/vulkan.h>

#include <array>
#include <vector>

struct Attachment {
    VkImage image{};
    VkImageView view{};
    VkFormat format{};
};

class Frame {
public:
    void create(VkDevice device, VkExtent2D size, const std::vector<VkImageView>& window);
    void record(VkCommandBuffer cmd, uint32_t index);

private:
    Attachment attachment(VkFormat format, VkExtent2D size, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImageAspectFlags aspect);
    VkRenderPass pass(const std::vector<VkAttachmentDescription>& attachments, const VkSubpassDescription& subpass,
                      const std::vector<VkSubpassDependency>& dependencies);
    VkFramebuffer framebuffer(VkRenderPass pass, VkExtent2D size, const std::vector<VkImageView>& views);
    void shadows();
    void scene();
    void effects();
    void menu();
    void begin(VkCommandBuffer cmd, VkRenderPass pass, VkFramebuffer framebuffer, VkExtent2D size, uint32_t clears);

    VkDevice device{};
    VkExtent2D extent{};
    static constexpr VkExtent2D shadowExtent{2048, 2048};
    std::vector<VkImageView> window;
    Attachment shadow, colorSamples, depthSamples, color;
    VkRenderPass shadowPass{}, scenePass{}, effectsPass{}, menuPass{};
    VkFramebuffer shadowBuffer{}, sceneBuffer{};
    std::vector<VkFramebuffer> effectsBuffers, menuBuffers;
    VkPipeline shadowPipeline{}, scenePipeline{}, effectsPipeline{}, menuPipeline{};
    VkPipelineLayout layout{};
    VkDescriptorSet shadowSet{}, colorSet{};
};

Attachment Frame::attachment(VkFormat format, VkExtent2D size, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                             VkImageAspectFlags aspect) {
    Attachment made;
    made.format = format;
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size.width, size.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = samples;
    info.usage = usage;
    vkCreateImage(device, &info, nullptr, &made.image);
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = made.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCreateImageView(device, &view, nullptr, &made.view);
    return made;
}

VkRenderPass Frame::pass(const std::vector<VkAttachmentDescription>& attachments, const VkSubpassDescription& subpass,
                         const std::vector<VkSubpassDependency>& dependencies) {
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = static_cast<uint32_t>(dependencies.size());
    info.pDependencies = dependencies.data();
    VkRenderPass made{};
    vkCreateRenderPass(device, &info, nullptr, &made);
    return made;
}

VkFramebuffer Frame::framebuffer(VkRenderPass renderPass, VkExtent2D size, const std::vector<VkImageView>& views) {
    VkFramebufferCreateInfo info{VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    info.renderPass = renderPass;
    info.attachmentCount = static_cast<uint32_t>(views.size());
    info.pAttachments = views.data();
    info.width = size.width;
    info.height = size.height;
    info.layers = 1;
    VkFramebuffer made{};
    vkCreateFramebuffer(device, &info, nullptr, &made);
    return made;
}

void Frame::shadows() {
    VkAttachmentDescription depth{};
    depth.format = shadow.format;
    depth.samples = VK_SAMPLE_COUNT_1_BIT;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &reference;
    shadowPass = pass({depth}, subpass, {});
    shadowBuffer = framebuffer(shadowPass, shadowExtent, {shadow.view});
}

void Frame::scene() {
    std::vector<VkAttachmentDescription> attachments(3);
    for (auto& each : attachments) {
        each.samples = VK_SAMPLE_COUNT_4_BIT;
        each.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        each.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        each.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        each.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    attachments[0].format = colorSamples.format;
    attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachments[1].format = depthSamples.format;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    attachments[2].format = color.format;
    attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[2].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference drawn{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference tested{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolved{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &drawn;
    subpass.pResolveAttachments = &resolved;
    subpass.pDepthStencilAttachment = &tested;
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
    before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT;
    before.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    before.dstAccessMask = before.srcAccessMask;
    scenePass = pass(attachments, subpass, {before});
    sceneBuffer = framebuffer(scenePass, extent, {colorSamples.view, depthSamples.view, color.view});
}

void Frame::effects() {
    VkAttachmentDescription output{};
    output.format = VK_FORMAT_B8G8R8A8_UNORM;
    output.samples = VK_SAMPLE_COUNT_1_BIT;
    output.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    output.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    output.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    effectsPass = pass({output}, subpass, {});
    for (VkImageView view : window) effectsBuffers.push_back(framebuffer(effectsPass, extent, {view}));
}

void Frame::menu() {
    VkAttachmentDescription output{};
    output.format = VK_FORMAT_B8G8R8A8_UNORM;
    output.samples = VK_SAMPLE_COUNT_1_BIT;
    output.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    output.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    output.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    output.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &reference;
    menuPass = pass({output}, subpass, {});
    for (VkImageView view : window) menuBuffers.push_back(framebuffer(menuPass, extent, {view}));
}

void Frame::create(VkDevice logical, VkExtent2D size, const std::vector<VkImageView>& views) {
    device = logical;
    extent = size;
    window = views;
    shadow = attachment(VK_FORMAT_D16_UNORM, shadowExtent, VK_SAMPLE_COUNT_1_BIT,
                        VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
    colorSamples = attachment(VK_FORMAT_R16G16B16A16_SFLOAT, size, VK_SAMPLE_COUNT_4_BIT,
                              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    depthSamples = attachment(VK_FORMAT_D32_SFLOAT, size, VK_SAMPLE_COUNT_4_BIT,
                              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                              VK_IMAGE_ASPECT_DEPTH_BIT);
    color = attachment(VK_FORMAT_R16G16B16A16_SFLOAT, size, VK_SAMPLE_COUNT_1_BIT,
                       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    shadows();
    scene();
    effects();
    menu();
}

void Frame::begin(VkCommandBuffer cmd, VkRenderPass renderPass, VkFramebuffer buffer, VkExtent2D size, uint32_t clears) {
    std::array<VkClearValue, 2> values{};
    VkRenderPassBeginInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO};
    info.renderPass = renderPass;
    info.framebuffer = buffer;
    info.renderArea = {{0, 0}, size};
    info.clearValueCount = clears;
    info.pClearValues = values.data();
    vkCmdBeginRenderPass(cmd, &info, VK_SUBPASS_CONTENTS_INLINE);
}

void Frame::record(VkCommandBuffer cmd, uint32_t index) {
    begin(cmd, shadowPass, shadowBuffer, shadowExtent, 1);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, shadowPipeline);
    vkCmdDrawIndexed(cmd, 30000, 1, 0, 0, 0);
    vkCmdEndRenderPass(cmd);

    begin(cmd, scenePass, sceneBuffer, extent, 2);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, scenePipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &shadowSet, 0, nullptr);
    vkCmdDrawIndexed(cmd, 30000, 1, 0, 0, 0);
    vkCmdEndRenderPass(cmd);

    begin(cmd, effectsPass, effectsBuffers[index], extent, 0);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, effectsPipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &colorSet, 0, nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRenderPass(cmd);

    begin(cmd, menuPass, menuBuffers[index], extent, 0);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, menuPipeline);
    vkCmdDraw(cmd, 600, 1, 0, 0);
    vkCmdEndRenderPass(cmd);
}
