// Targets whose usage allows reads. The program samples one of them and copies another; the others are resolved and stored for nobody.
#include <vulkan/vulkan.h>

#include <vector>

struct Target {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
};

class Viewer {
public:
    void create();
    void bindTextures(VkDescriptorSet set, VkImageView texture);
    void screenshot(VkCommandBuffer cmd, VkImage to);
    void uploadMips(VkCommandBuffer cmd, VkImage texture);
    void drawScene(VkCommandBuffer cmd);
    void drawReflections(VkCommandBuffer cmd);
    void drawPortal(VkCommandBuffer cmd);

private:
    Target createTarget(VkImageUsageFlags usage, VkSampleCountFlagBits samples);
    void draw(VkCommandBuffer cmd, const Target& target, const Target& resolve, VkAttachmentStoreOp storeOp);

    VkDevice device = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    Target scene, sceneResolved, reflections, reflectionsResolved, portal, portalResolved;
};

Target Viewer::createTarget(VkImageUsageFlags usage, VkSampleCountFlagBits samples) {
    Target target;
    VkImageCreateInfo imageInfo{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    imageInfo.imageType = VK_IMAGE_TYPE_2D;
    imageInfo.format = VK_FORMAT_R8G8B8A8_UNORM;
    imageInfo.extent = {1280, 720, 1};
    imageInfo.mipLevels = 1;
    imageInfo.arrayLayers = 1;
    imageInfo.samples = samples;
    imageInfo.usage = usage;
    vkCreateImage(device, &imageInfo, nullptr, &target.image);
    VkImageViewCreateInfo viewInfo{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    viewInfo.image = target.image;
    viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
    viewInfo.format = VK_FORMAT_R8G8B8A8_UNORM;
    vkCreateImageView(device, &viewInfo, nullptr, &target.view);
    return target;
}

void Viewer::create() {
    const VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    scene = createTarget(color | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_4_BIT);
    sceneResolved = createTarget(color | VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_1_BIT);
    reflections = createTarget(color | VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_4_BIT);
    reflectionsResolved = createTarget(color | VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_1_BIT);
    portal = createTarget(color | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_SAMPLE_COUNT_4_BIT);
    portalResolved = createTarget(color | VK_IMAGE_USAGE_SAMPLED_BIT, VK_SAMPLE_COUNT_1_BIT);
}

void Viewer::bindTextures(VkDescriptorSet set, VkImageView texture) {
    std::vector<VkDescriptorImageInfo> images(3);
    images[0].sampler = sampler;
    images[0].imageView = reflections.view;
    images[0].imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    images[1] = {sampler, sceneResolved.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    images[2] = {sampler, texture, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = set;
    write.descriptorCount = 3;
    write.pImageInfo = images.data();
    vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
}

void Viewer::screenshot(VkCommandBuffer cmd, VkImage to) {
    VkImageCopy region{};
    vkCmdCopyImage(cmd, portal.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

void Viewer::uploadMips(VkCommandBuffer cmd, VkImage texture) {
    VkImageBlit region{};
    vkCmdBlitImage(cmd, texture, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, texture, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

void Viewer::draw(VkCommandBuffer cmd, const Target& target, const Target& resolve, VkAttachmentStoreOp storeOp) {
    VkRenderingAttachmentInfo attachment{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    attachment.imageView = target.view;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    attachment.resolveImageView = resolve.view;
    attachment.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = storeOp;
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.layerCount = 1;
    info.colorAttachmentCount = 1;
    info.pColorAttachments = &attachment;
    vkCmdBeginRendering(cmd, &info);
    vkCmdEndRendering(cmd);
}

void Viewer::drawScene(VkCommandBuffer cmd) {
    draw(cmd, scene, sceneResolved, VK_ATTACHMENT_STORE_OP_STORE);  // expect: MSAA201
}

void Viewer::drawReflections(VkCommandBuffer cmd) {
    draw(cmd, reflections, reflectionsResolved, VK_ATTACHMENT_STORE_OP_STORE);
}

void Viewer::drawPortal(VkCommandBuffer cmd) {
    draw(cmd, portal, portalResolved, VK_ATTACHMENT_STORE_OP_STORE);
}
