// Formats and operations from tables, counts from settings: what a pass has is known when it runs.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

enum PixelFormat { PF_RGBA8, PF_RGBA16F, PF_R11G11B10F, PF_D24S8, PF_D32, PF_COUNT };
enum LoadAction { LA_Load, LA_Clear, LA_DontCare };
enum StoreAction { SA_Store, SA_DontCare, SA_Resolve, SA_StoreResolve };

struct FormatInfo {
    VkFormat format;
    VkImageAspectFlags aspect;
    uint8_t bytes;
};

static const FormatInfo s_formats[PF_COUNT] = {
    {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_ASPECT_COLOR_BIT, 4},
    {VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_ASPECT_COLOR_BIT, 8},
    {VK_FORMAT_B10G11R11_UFLOAT_PACK32, VK_IMAGE_ASPECT_COLOR_BIT, 4},
    {VK_FORMAT_D24_UNORM_S8_UINT, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT, 4},
    {VK_FORMAT_D32_SFLOAT, VK_IMAGE_ASPECT_DEPTH_BIT, 4},
};

static const VkAttachmentLoadOp s_load[] = {VK_ATTACHMENT_LOAD_OP_LOAD, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_LOAD_OP_DONT_CARE};
static const VkAttachmentStoreOp s_store[] = {VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                              VK_ATTACHMENT_STORE_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE};

static const VkSampleCountFlagBits s_samples[] = {VK_SAMPLE_COUNT_1_BIT, VK_SAMPLE_COUNT_2_BIT, VK_SAMPLE_COUNT_4_BIT,
                                                  VK_SAMPLE_COUNT_8_BIT, VK_SAMPLE_COUNT_16_BIT};

struct TargetDesc {
    PixelFormat format;
    uint8_t samplesLog2;
    LoadAction load;
    StoreAction store;
};

struct PassDesc {
    TargetDesc color[8];
    TargetDesc depth;
    uint32_t colorCount;
    bool hasDepth;
};

VkRenderPass createPass(VkDevice device, const PassDesc& desc) {
    VkAttachmentDescription attachments[17] = {};
    VkAttachmentReference colorRefs[8], resolveRefs[8], depthRef;
    uint32_t count = 0;
    bool anyResolve = false;
    for (uint32_t i = 0; i < desc.colorCount; i++) {
        const TargetDesc& target = desc.color[i];
        VkAttachmentDescription& a = attachments[count];
        a.format = s_formats[target.format].format;
        a.samples = s_samples[target.samplesLog2];
        a.loadOp = s_load[target.load];
        a.storeOp = s_store[target.store];
        a.initialLayout = target.load == LA_Load ? VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED;
        a.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        colorRefs[i] = {count++, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        resolveRefs[i] = {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED};
        if (target.store >= SA_Resolve) {
            anyResolve = true;
            attachments[count] = a;
            attachments[count].samples = VK_SAMPLE_COUNT_1_BIT;
            attachments[count].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
            attachments[count].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
            resolveRefs[i] = {count++, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        }
    }
    if (desc.hasDepth) {
        VkAttachmentDescription& a = attachments[count];
        a.format = s_formats[desc.depth.format].format;
        a.samples = s_samples[desc.depth.samplesLog2];
        a.loadOp = a.stencilLoadOp = s_load[desc.depth.load];
        a.storeOp = a.stencilStoreOp = s_store[desc.depth.store];
        a.finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        depthRef = {count++, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    }
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = desc.colorCount;
    subpass.pColorAttachments = colorRefs;
    subpass.pResolveAttachments = anyResolve ? resolveRefs : nullptr;
    subpass.pDepthStencilAttachment = desc.hasDepth ? &depthRef : nullptr;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = count;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkImage createTarget(VkDevice device, VkExtent3D extent, const TargetDesc& target, bool sampled) {
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = s_formats[target.format].format;
    info.extent = extent;
    info.mipLevels = 1;
    info.arrayLayers = 1;
    info.samples = s_samples[target.samplesLog2];
    info.usage = (s_formats[target.format].aspect & VK_IMAGE_ASPECT_COLOR_BIT) ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
                                                                               : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (sampled) info.usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
    VkImage image = VK_NULL_HANDLE;
    vkCreateImage(device, &info, nullptr, &image);
    return image;
}
