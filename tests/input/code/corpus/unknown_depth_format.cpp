// Nothing here says which depth format the device has; the view's aspect and the usage say that it is depth.
#include <vulkan/vulkan.h>

VkFormat findDepthFormat(VkPhysicalDevice device);

class DepthPrepass {
public:
    DepthPrepass(VkPhysicalDevice physical, VkDevice device) : format(findDepthFormat(physical)), device(device) {}
    void create();

private:
    VkFormat format;
    VkDevice device;
    VkRenderPass pass = VK_NULL_HANDLE;
};

void DepthPrepass::create() {
    VkAttachmentDescription depth{};
    depth.format = format;
    depth.samples = VK_SAMPLE_COUNT_4_BIT;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;  // expect: MSAA202
    depth.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    depth.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    depth.initialLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &reference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 1;
    info.pAttachments = &depth;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
}
