// Mistakes around a resolve, each in a function of its own: counts, targets, operations.
#include <vulkan/vulkan.h>

#include <iterator>

namespace {

VkRenderPass finish(VkDevice device, const VkAttachmentDescription* list, uint32_t count, const VkSubpassDescription& subpass) {
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.attachmentCount = count;
    info.pAttachments = list;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

constexpr VkAttachmentReference at(uint32_t index) { return {index, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}; }

}  // namespace

// The resolve target has four samples as well.
VkRenderPass targetMultisampled(VkDevice device) {
    VkAttachmentDescription list[2]{};
    for (auto& each : list) {
        each.format = VK_FORMAT_R8G8B8A8_UNORM;
        each.samples = VK_SAMPLE_COUNT_4_BIT;  // may: MSAA305#target
        each.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        each.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;  // may: MSAA206, MSAA207
        each.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    list[1].samples = VK_SAMPLE_COUNT_4_BIT;  // expect: MSAA305#target
    list[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    list[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // may: MSAA201
    const VkAttachmentReference color = at(0), resolve = at(1);  // may: MSAA305#target
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    return finish(device, list, std::size(list), subpass);
}

// A picture of one sample is resolved.
VkRenderPass sourceSingleSampled(VkDevice device) {
    VkAttachmentDescription list[2]{};
    list[0].format = VK_FORMAT_B8G8R8A8_UNORM;
    list[0].samples = VK_SAMPLE_COUNT_1_BIT;  // expect: MSAA304#source
    list[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    list[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    list[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    list[1] = list[0];
    list[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    list[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    const VkAttachmentReference color = at(0), resolve = at(1);  // may: MSAA304#source
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    return finish(device, list, 2, subpass);
}

// Two colour attachments, and the resolve stands at the wrong one: the second picture is lost.
VkRenderPass resolvesTheOther(VkDevice device) {
    VkAttachmentDescription list[3]{};
    for (int i = 0; i < 2; i++) {
        list[i].format = VK_FORMAT_R8G8B8A8_UNORM;
        list[i].samples = VK_SAMPLE_COUNT_4_BIT;
        list[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        list[i].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;  // expect: MSAA207
        list[i].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    }
    list[2].format = VK_FORMAT_R8G8B8A8_UNORM;
    list[2].samples = VK_SAMPLE_COUNT_1_BIT;
    list[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    list[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    list[2].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    const VkAttachmentReference colors[] = {at(0), at(1)};
    const VkAttachmentReference resolves[] = {at(2), {VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED}};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 2;
    subpass.pColorAttachments = colors;
    subpass.pResolveAttachments = resolves;
    return finish(device, list, 3, subpass);
}

// Depth goes from pass to pass in memory, with all of its samples.
VkRenderPass depthGoesOn(VkDevice device, VkFormat depthFormat) {
    VkAttachmentDescription depth{0,
                                  depthFormat,
                                  VK_SAMPLE_COUNT_4_BIT,
                                  VK_ATTACHMENT_LOAD_OP_LOAD,  // expect: MSAA202
                                  VK_ATTACHMENT_STORE_OP_STORE,
                                  VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                                  VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.pDepthStencilAttachment = &reference;
    return finish(device, &depth, 1, subpass);
}
