// The functions that make structures are declared here and defined in another file: what they set is not known.
#include <vulkan/vulkan.h>

#include <array>

namespace vkx::make {
VkImageCreateInfo image(VkFormat format, VkExtent2D size, VkImageUsageFlags usage, VkSampleCountFlagBits samples);
VkAttachmentDescription attachment(VkFormat format, VkSampleCountFlagBits samples);
VkAttachmentDescription attachmentForDepth(VkFormat format, VkSampleCountFlagBits samples);
VkPipelineMultisampleStateCreateInfo multisample(VkSampleCountFlagBits samples, float minShading = 0.0f);
VkPipelineColorBlendAttachmentState blend(VkColorComponentFlags mask, VkBool32 enable);
VkGraphicsPipelineCreateInfo pipeline(VkPipelineLayout layout, VkRenderPass pass);
}  // namespace vkx::make

namespace vkx {
class Target {
public:
    void create(VkDevice device, const VkImageCreateInfo& info, VkMemoryPropertyFlags memory);
    VkImageView view() const;
};
VkRenderPass createPass(VkDevice device, const VkAttachmentDescription* descriptions, uint32_t count);
}  // namespace vkx

struct Sample {
    VkDevice device;
    VkExtent2D size;
    VkFormat swapFormat;
    VkPipelineLayout layout;
    VkRenderPass pass;
    VkPipeline solid, foliage;
    vkx::Target color, depth;

    void targets() {
        // `image` may add TRANSIENT_ATTACHMENT by itself where samples are more than one.
        VkImageCreateInfo info = vkx::make::image(swapFormat, size, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT);
        color.create(device, info, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        info = vkx::make::image(VK_FORMAT_D32_SFLOAT, size, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT);
        depth.create(device, info, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    }

    void renderPass() {
        std::array<VkAttachmentDescription, 3> descriptions = {
            vkx::make::attachment(swapFormat, VK_SAMPLE_COUNT_4_BIT),
            vkx::make::attachmentForDepth(VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT),
            vkx::make::attachment(swapFormat, VK_SAMPLE_COUNT_1_BIT),
        };
        descriptions[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        descriptions[2].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        pass = vkx::createPass(device, descriptions.data(), static_cast<uint32_t>(descriptions.size()));
    }

    void pipelines() {
        auto multisample = vkx::make::multisample(VK_SAMPLE_COUNT_4_BIT);
        auto info = vkx::make::pipeline(layout, pass);
        info.pMultisampleState = &multisample;
        vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &solid);

        multisample.alphaToCoverageEnable = VK_TRUE;
        vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &foliage);
    }
};
