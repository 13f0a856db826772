// Vulkan through tables of function pointers and macros around every call, as on Android; two mistakes all the same.
#include <vulkan/vulkan.h>

#include <cstdlib>
#include <vector>

#define LOGE(...) ((void)0)
#define CALL_VK(func)                                       \
    if (VK_SUCCESS != (func)) {                             \
        LOGE("Vulkan error. File[%s], line[%d]", __FILE__, __LINE__); \
        std::abort();                                       \
    }

struct DeviceTable {
    PFN_vkCreateImage CreateImage;
    PFN_vkCreateImageView CreateImageView;
    PFN_vkCreateRenderPass CreateRenderPass;
    PFN_vkCreateFramebuffer CreateFramebuffer;
};

struct VulkanDeviceInfo {
    bool initialized_;
    VkDevice device_;
    DeviceTable vk;
} device;

struct VulkanSwapchainInfo {
    VkExtent2D displaySize_;
    VkFormat displayFormat_;
    std::vector<VkImageView> displayViews_;
    std::vector<VkFramebuffer> framebuffers_;
    VkImage msaaImage_;
    VkImageView msaaView_;
} swapchain;

VkRenderPass renderPass;

void CreateMsaaTarget(void) {
    VkImageCreateInfo imageCreateInfo{
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .pNext = nullptr,
        .flags = 0,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = swapchain.displayFormat_,
        .extent = {.width = swapchain.displaySize_.width, .height = swapchain.displaySize_.height, .depth = 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = VK_SAMPLE_COUNT_4_BIT,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,  // expect: MSAA401
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .queueFamilyIndexCount = 0,
        .pQueueFamilyIndices = nullptr,
        .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
    };
    CALL_VK(device.vk.CreateImage(device.device_, &imageCreateInfo, nullptr, &swapchain.msaaImage_));
    VkImageViewCreateInfo viewCreateInfo{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = swapchain.msaaImage_,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = swapchain.displayFormat_,
        .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1},
    };
    CALL_VK(device.vk.CreateImageView(device.device_, &viewCreateInfo, nullptr, &swapchain.msaaView_));
}

void CreateRenderPass(void) {
    VkAttachmentDescription attachmentDescriptions[]{
        {
            .format = swapchain.displayFormat_,
            .samples = VK_SAMPLE_COUNT_4_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,  // expect: MSAA201
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
        {
            .format = swapchain.displayFormat_,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        },
    };
    VkAttachmentReference colourReference = {.attachment = 0, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolveReference = {.attachment = 1, .layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpassDescription{
        .flags = 0,
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .inputAttachmentCount = 0,
        .pInputAttachments = nullptr,
        .colorAttachmentCount = 1,
        .pColorAttachments = &colourReference,
        .pResolveAttachments = &resolveReference,
        .pDepthStencilAttachment = nullptr,
        .preserveAttachmentCount = 0,
        .pPreserveAttachments = nullptr,
    };
    VkRenderPassCreateInfo renderPassCreateInfo{
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
        .pNext = nullptr,
        .attachmentCount = 2,
        .pAttachments = attachmentDescriptions,
        .subpassCount = 1,
        .pSubpasses = &subpassDescription,
        .dependencyCount = 0,
        .pDependencies = nullptr,
    };
    CALL_VK(device.vk.CreateRenderPass(device.device_, &renderPassCreateInfo, nullptr, &renderPass));
}

void CreateFrameBuffers(VkRenderPass& pass) {
    swapchain.framebuffers_.resize(swapchain.displayViews_.size());
    for (uint32_t i = 0; i < swapchain.displayViews_.size(); i++) {
        VkImageView attachments[2]{swapchain.msaaView_, swapchain.displayViews_[i]};
        VkFramebufferCreateInfo fbCreateInfo{
            .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
            .renderPass = pass,
            .attachmentCount = 2,
            .pAttachments = attachments,
            .width = swapchain.displaySize_.width,
            .height = swapchain.displaySize_.height,
            .layers = 1,
        };
        CALL_VK(device.vk.CreateFramebuffer(device.device_, &fbCreateInfo, nullptr, &swapchain.framebuffers_[i]));
    }
}

bool InitVulkan() {
    CreateMsaaTarget();
    CreateRenderPass();
    CreateFrameBuffers(renderPass);
    device.initialized_ = true;
    return true;
}
