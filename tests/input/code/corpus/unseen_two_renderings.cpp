// A frame of several renderings whose shaders read, through descriptors, what was drawn before: the samples, the resolved picture, the depth.
#include <vulkan/vulkan.h>

#include <array>

struct Target {
    VkImage image{};
    VkImageView view{};
};

class Frame {
public:
    void create(VkDevice device, VkExtent2D size);
    void record(VkCommandBuffer cmd, VkImageView window, VkImage windowImage);

private:
    Target make(VkDevice device, VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImageAspectFlags aspect);
    void toShader(VkCommandBuffer cmd, VkImage image, VkImageAspectFlags aspect);

    VkExtent2D size_{};
    Target samples_, depthSamples_, depth_, scene_;
    VkPipeline scenePipeline_{}, weighPipeline_{}, occlusionPipeline_{};
    VkPipelineLayout layout_{};
    VkDescriptorSet weighSet_{}, occlusionSet_{};
};

Target Frame::make(VkDevice device, VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {size_.width, size_.height, 1};
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = samples;
    info.usage = usage;
    Target target;
    vkCreateImage(device, &info, nullptr, &target.image);
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = target.image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format;
    view.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCreateImageView(device, &view, nullptr, &target.view);
    return target;
}

void Frame::create(VkDevice device, VkExtent2D size) {
    size_ = size;
    samples_ = make(device, VK_FORMAT_R16G16B16A16_SFLOAT, VK_SAMPLE_COUNT_4_BIT,
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    depthSamples_ = make(device, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT,
                         VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
    depth_ = make(device, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_DEPTH_BIT);
    scene_ = make(device, VK_FORMAT_R16G16B16A16_SFLOAT, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
}

void Frame::toShader(VkCommandBuffer cmd, VkImage image, VkImageAspectFlags aspect) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    barrier.newLayout = VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT,
                         VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void Frame::record(VkCommandBuffer cmd, VkImageView window, VkImage windowImage) {
    VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    color.imageView = samples_.view;
    color.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    depth.imageView = depthSamples_.view;
    depth.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    depth.resolveMode = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT;
    depth.resolveImageView = depth_.view;
    depth.resolveImageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkRenderingInfo scene{VK_STRUCTURE_TYPE_RENDERING_INFO};
    scene.renderArea = {{0, 0}, size_};
    scene.layerCount = 1;
    scene.colorAttachmentCount = 1;
    scene.pColorAttachments = &color;
    scene.pDepthAttachment = &depth;
    vkCmdBeginRendering(cmd, &scene);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, scenePipeline_);
    vkCmdDraw(cmd, 3000, 1, 0, 0);
    vkCmdEndRendering(cmd);

    toShader(cmd, samples_.image, VK_IMAGE_ASPECT_COLOR_BIT);
    toShader(cmd, depth_.image, VK_IMAGE_ASPECT_DEPTH_BIT);

    // A shader weighs the samples by their luminance, which no resolve can do.
    VkRenderingAttachmentInfo weighed{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    weighed.imageView = scene_.view;
    weighed.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    weighed.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    weighed.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo weigh{VK_STRUCTURE_TYPE_RENDERING_INFO};
    weigh.renderArea = {{0, 0}, size_};
    weigh.layerCount = 1;
    weigh.colorAttachmentCount = 1;
    weigh.pColorAttachments = &weighed;
    vkCmdBeginRendering(cmd, &weigh);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, weighPipeline_);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &weighSet_, 0, nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);

    toShader(cmd, scene_.image, VK_IMAGE_ASPECT_COLOR_BIT);

    VkRenderingAttachmentInfo output{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    output.imageView = window;
    output.imageLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    output.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    output.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo post{VK_STRUCTURE_TYPE_RENDERING_INFO};
    post.renderArea = {{0, 0}, size_};
    post.layerCount = 1;
    post.colorAttachmentCount = 1;
    post.pColorAttachments = &output;
    vkCmdBeginRendering(cmd, &post);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, occlusionPipeline_);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &occlusionSet_, 0, nullptr);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);

    VkImageMemoryBarrier toPresent{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    toPresent.srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    toPresent.oldLayout = VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL;
    toPresent.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    toPresent.image = windowImage;
    toPresent.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, 0, 0, nullptr, 0,
                         nullptr, 1, &toPresent);
}
