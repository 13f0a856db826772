// Structures come from small functions of a namespace in this file. The pipeline rasterizes with another count than its pass.
#include <vulkan/vulkan.h>

#include <vector>

namespace init {

inline VkImageCreateInfo imageCreateInfo() {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    return info;
}

inline VkAttachmentReference reference(uint32_t index, VkImageLayout layout) { return {index, layout}; }

inline VkPipelineMultisampleStateCreateInfo multisampleState(VkSampleCountFlagBits rasterizationSamples,
                                                             VkPipelineMultisampleStateCreateFlags flags = 0) {
    VkPipelineMultisampleStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    info.rasterizationSamples = rasterizationSamples;
    info.flags = flags;
    return info;
}

inline VkRenderPassCreateInfo renderPassCreateInfo() {
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    return info;
}

inline VkGraphicsPipelineCreateInfo pipelineCreateInfo(VkPipelineLayout layout, VkRenderPass renderPass) {
    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.layout = layout;
    info.renderPass = renderPass;
    info.basePipelineIndex = -1;
    info.basePipelineHandle = VK_NULL_HANDLE;
    return info;
}

}  // namespace init

class Example {
public:
    void prepare() {
        setupRenderPass();
        preparePipelines();
    }

private:
    static constexpr VkSampleCountFlagBits sampleCount = VK_SAMPLE_COUNT_4_BIT;
    VkDevice device{};
    VkFormat colorFormat = VK_FORMAT_B8G8R8A8_UNORM;
    VkRenderPass renderPass{};
    VkPipelineLayout layout{};
    VkPipeline opaque{}, wireframe{};

    void setupRenderPass() {
        std::vector<VkAttachmentDescription> attachments(3);
        attachments[0].format = colorFormat;
        attachments[0].samples = sampleCount;
        attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[0].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachments[1].format = colorFormat;
        attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;  // expect: MSAA206
        attachments[1].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        attachments[2].format = VK_FORMAT_D32_SFLOAT;
        attachments[2].samples = sampleCount;
        attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[2].initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
        attachments[2].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

        const VkAttachmentReference color = init::reference(0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        const VkAttachmentReference resolve = init::reference(1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        const VkAttachmentReference depth = init::reference(2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);

        VkSubpassDescription subpass{};
        subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        subpass.pResolveAttachments = &resolve;
        subpass.pDepthStencilAttachment = &depth;

        VkRenderPassCreateInfo info = init::renderPassCreateInfo();
        info.attachmentCount = static_cast<uint32_t>(attachments.size());
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        vkCreateRenderPass(device, &info, nullptr, &renderPass);
    }

    void preparePipelines() {
        VkPipelineMultisampleStateCreateInfo multisample = init::multisampleState(sampleCount, 0);
        VkGraphicsPipelineCreateInfo create = init::pipelineCreateInfo(layout, renderPass);
        create.pMultisampleState = &multisample;
        vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &create, nullptr, &opaque);

        VkPipelineMultisampleStateCreateInfo plain = init::multisampleState(VK_SAMPLE_COUNT_1_BIT);  // expect: MSAA104
        create.pMultisampleState = &plain;
        vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &create, nullptr, &wireframe);
    }
};

int main() { Example().prepare(); }
