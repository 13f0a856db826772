// Commands are recorded by lambdas that a scheduler runs, so that no call of the functions that begin passes is seen.
#include <vulkan/vulkan.h>

#include <functional>

struct Frame {
    VkCommandBuffer commands;
    VkImageView samples;
    VkImageView resolved;
    VkExtent2D extent;
};

class Scheduler {
public:
    void add(std::function<void(const Frame&)> job);
};

class Target {
public:
    void beginScene(const Frame& frame) const {
        VkRenderingAttachmentInfo color{};
        color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        color.imageView = frame.samples;
        color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
        color.resolveImageView = frame.resolved;
        color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // expect: MSAA201
        VkRenderingInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
        info.renderArea.extent = frame.extent;
        info.layerCount = 1;
        info.colorAttachmentCount = 1;
        info.pColorAttachments = &color;
        vkCmdBeginRendering(frame.commands, &info);
    }
};

class Manager {
public:
    void schedule(Scheduler& scheduler) {
        auto record = [this](const Frame& frame) {
            target_->beginScene(frame);
            vkCmdEndRendering(frame.commands);
        };
        scheduler.add(record);
    }

private:
    Target* target_ = nullptr;
};
