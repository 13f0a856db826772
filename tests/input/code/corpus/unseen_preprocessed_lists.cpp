// Conditions of the preprocessor within braces and calls. Everything is right, with MSAA and without it.
#include <vulkan/vulkan.h>

#include <array>
#include <vector>

#if defined(WITH_MSAA) && WITH_MSAA > 1
#define SAMPLES VK_SAMPLE_COUNT_4_BIT
#else
#define SAMPLES VK_SAMPLE_COUNT_1_BIT
#endif

static VkRenderPass create(VkDevice device, const VkAttachmentDescription* attachments, uint32_t count, const VkSubpassDescription& subpass) {
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = count;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass positional(VkDevice device) {
    const VkAttachmentDescription attachments[] = {
        {
            0,
            VK_FORMAT_B8G8R8A8_UNORM,
#ifdef WITH_MSAA
            VK_SAMPLE_COUNT_4_BIT,
            VK_ATTACHMENT_LOAD_OP_CLEAR,
            VK_ATTACHMENT_STORE_OP_DONT_CARE,
#else
            VK_SAMPLE_COUNT_1_BIT,
            VK_ATTACHMENT_LOAD_OP_CLEAR,
            VK_ATTACHMENT_STORE_OP_STORE,
#endif
            VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            VK_ATTACHMENT_STORE_OP_DONT_CARE,
            VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
#ifdef WITH_MSAA
        {
            0,
            VK_FORMAT_B8G8R8A8_UNORM,
            VK_SAMPLE_COUNT_1_BIT,
            VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            VK_ATTACHMENT_STORE_OP_STORE,
            VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            VK_ATTACHMENT_STORE_OP_DONT_CARE,
            VK_IMAGE_LAYOUT_UNDEFINED,
            VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        },
#endif
    };
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolved{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    (void)resolved;
    const VkSubpassDescription subpass{
        0,
        VK_PIPELINE_BIND_POINT_GRAPHICS,
        0,
        nullptr,
        1,
        &color,
#ifdef WITH_MSAA
        &resolved,
#else
        nullptr,
#endif
        nullptr,
        0,
        nullptr,
    };
    return create(device, attachments, sizeof attachments / sizeof attachments[0], subpass);
}

VkRenderPass designated(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> attachments{
        {
            .format = format,
            .samples = SAMPLES,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
#if defined(WITH_MSAA)
            .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
#else
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
#endif
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        },
#ifdef WITH_MSAA
        {
            .format = format,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
            .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR,
        },
#endif
    };
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolved{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    (void)resolved;
    VkSubpassDescription subpass{
        .pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
#ifdef WITH_MSAA
        .pResolveAttachments = &resolved,
#endif
    };
    return create(device, attachments.data(), static_cast<uint32_t>(attachments.size()), subpass);
}

static VkAttachmentDescription described(VkFormat format, VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store, VkImageLayout last) {
    VkAttachmentDescription made{};
    made.format = format;
    made.samples = samples;
    made.loadOp = load;
    made.storeOp = store;
    made.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    made.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    made.finalLayout = last;
    return made;
}

VkRenderPass calls(VkDevice device, VkFormat format) {
#ifdef WITH_MSAA
    std::array<VkAttachmentDescription, 2> attachments{
#else
    std::array<VkAttachmentDescription, 1> attachments{
#endif
        described(format,
#ifdef WITH_MSAA
                  VK_SAMPLE_COUNT_4_BIT,
                  VK_ATTACHMENT_LOAD_OP_CLEAR,
                  VK_ATTACHMENT_STORE_OP_DONT_CARE,
#else
                  VK_SAMPLE_COUNT_1_BIT,
                  VK_ATTACHMENT_LOAD_OP_CLEAR,
                  VK_ATTACHMENT_STORE_OP_STORE,
#endif
                  VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
#ifdef WITH_MSAA
        described(format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR),
#endif
    };
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
#ifdef WITH_MSAA
    const VkAttachmentReference resolved{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    subpass.pResolveAttachments = &resolved;
#endif
    return create(device, attachments.data(), static_cast<uint32_t>(attachments.size()), subpass);
}

VkRenderPass declared_in_both(VkDevice device, VkFormat format) {
#ifdef WITH_MSAA
    std::vector<VkAttachmentDescription> attachments{
        described(format, VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL),
        described(format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR)};
    VkAttachmentReference resolved{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
#else
    std::vector<VkAttachmentDescription> attachments{
        described(format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR)};
#endif
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
#ifdef WITH_MSAA
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    subpass.pResolveAttachments = &resolved;
#endif
    attachments[0].stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    return create(device, attachments.data(), static_cast<uint32_t>(attachments.size()), subpass);
}

VkImage flags(VkDevice device, VkExtent3D extent) {
    VkImageCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .extent = extent,
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = SAMPLES,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT
#ifdef WITH_MSAA
            | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT
#else
            | VK_IMAGE_USAGE_SAMPLED_BIT
#endif
        ,
        .sharingMode = VK_SHARING_MODE_EXCLUSIVE,
    };
    VkImage image = VK_NULL_HANDLE;
    vkCreateImage(device, &info, nullptr, &image);
    return image;
}
