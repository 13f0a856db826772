// A render pass of the project is created from lists: textures, operations, and layouts.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <vector>

namespace cookbook {

class Texture {
public:
    Texture(VkDevice device, VkFormat format, VkImageUsageFlags usage, VkExtent3D extent, VkSampleCountFlagBits count);
    VkFormat format() const { return format_; }
    VkSampleCountFlagBits count() const { return count_; }
    bool isDepth() const;

private:
    VkFormat format_;
    VkSampleCountFlagBits count_;
    VkImage image_ = VK_NULL_HANDLE;
};

class RenderPass {
public:
    RenderPass(VkDevice device, const std::vector<std::shared_ptr<Texture>>& attachments,
               const std::vector<std::shared_ptr<Texture>>& resolved, const std::vector<VkAttachmentLoadOp>& loads,
               const std::vector<VkAttachmentStoreOp>& stores, const std::vector<VkImageLayout>& layouts);

private:
    VkRenderPass pass_ = VK_NULL_HANDLE;
};

}  // namespace cookbook
