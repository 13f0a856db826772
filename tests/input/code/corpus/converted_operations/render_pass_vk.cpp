// A description of the framework's becomes one of Vulkan's. What it says is the caller's, here another file.
#include "render_pass_vk.h"

#include <array>
#include <vector>

static VkAttachmentLoadOp AttachmentLoadOpToVk(ATTACHMENT_LOAD_OP Op) {
    switch (Op) {
        // clang-format off
        case ATTACHMENT_LOAD_OP_LOAD:    return VK_ATTACHMENT_LOAD_OP_LOAD;
        case ATTACHMENT_LOAD_OP_CLEAR:   return VK_ATTACHMENT_LOAD_OP_CLEAR;
        case ATTACHMENT_LOAD_OP_DISCARD: return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        // clang-format on
        default:
            return VK_ATTACHMENT_LOAD_OP_LOAD;
    }
}

static VkAttachmentStoreOp AttachmentStoreOpToVk(ATTACHMENT_STORE_OP Op) {
    static constexpr std::array<VkAttachmentStoreOp, 2> Ops = {VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_STORE_OP_DONT_CARE};
    return Ops[Op];  // may: MSAA201
}

static VkFormat FormatToVk(TEXTURE_FORMAT Format) {
    return Format == TEX_FORMAT_D32 ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM;
}

RenderPassVk::RenderPassVk(VkDevice Device, const RenderPassDesc& Desc) {
    std::vector<VkAttachmentDescription> vkAttachments(Desc.AttachmentCount);
    for (Uint32 i = 0; i < Desc.AttachmentCount; ++i) {
        const RenderPassAttachmentDesc& Attachment = Desc.pAttachments[i];
        VkAttachmentDescription& vkAttachment = vkAttachments[i];
        vkAttachment.flags = 0;
        vkAttachment.format = FormatToVk(Attachment.Format);
        vkAttachment.samples = static_cast<VkSampleCountFlagBits>(Attachment.SampleCount);
        vkAttachment.loadOp = AttachmentLoadOpToVk(Attachment.LoadOp);
        vkAttachment.storeOp = AttachmentStoreOpToVk(Attachment.StoreOp);
        vkAttachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        vkAttachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    }
    VkAttachmentReference Color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference Resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription Subpass = {};
    Subpass.colorAttachmentCount = 1;
    Subpass.pColorAttachments = &Color;
    Subpass.pResolveAttachments = Desc.Resolves ? &Resolve : nullptr;
    VkRenderPassCreateInfo RenderPassCI = {};
    RenderPassCI.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    RenderPassCI.attachmentCount = Desc.AttachmentCount;
    RenderPassCI.pAttachments = vkAttachments.data();
    RenderPassCI.subpassCount = 1;
    RenderPassCI.pSubpasses = &Subpass;
    vkCreateRenderPass(Device, &RenderPassCI, nullptr, &m_RenderPass);
}
