// Attachments that are swapped, rotated, erased, copied by memcpy, bound by structured bindings: an order that only a careful reader follows.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

static VkAttachmentDescription many(VkFormat format) {
    VkAttachmentDescription d{};
    d.format = format;
    d.samples = VK_SAMPLE_COUNT_4_BIT;
    d.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    d.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    d.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return d;
}

static VkAttachmentDescription one(VkFormat format) {
    VkAttachmentDescription d{};
    d.format = format;
    d.samples = VK_SAMPLE_COUNT_1_BIT;
    d.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    d.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    d.finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    return d;
}

static VkRenderPass create(VkDevice device, const VkAttachmentDescription* attachments, uint32_t color, uint32_t resolve) {
    const VkAttachmentReference colorReference{color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolveReference{resolve, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &colorReference;
    subpass.pResolveAttachments = &resolveReference;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass{};
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

VkRenderPass swapped(VkDevice device, VkFormat format) {
    std::array<VkAttachmentDescription, 2> list{one(format), many(format)};
    std::swap(list[0], list[1]);
    return create(device, list.data(), 0, 1);
}

VkRenderPass rotated(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list{one(format), many(format)};
    std::rotate(list.begin(), list.begin() + 1, list.end());
    return create(device, list.data(), 0, 1);
}

VkRenderPass erased(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list{one(format), many(format), one(format)};
    list.erase(list.begin());
    return create(device, list.data(), 0, 1);
}

VkRenderPass reversed(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list;
    list.push_back(one(format));
    list.push_back(many(format));
    std::reverse(list.begin(), list.end());
    return create(device, list.data(), 0, 1);
}

VkRenderPass sorted(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list{one(format), many(format)};
    std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.samples > b.samples; });
    return create(device, list.data(), 0, 1);
}

VkRenderPass copied(VkDevice device, VkFormat format) {
    const VkAttachmentDescription from[2] = {many(format), one(format)};
    VkAttachmentDescription to[2];
    std::memcpy(to, from, sizeof to);
    return create(device, to, 0, 1);
}

VkRenderPass bound(VkDevice device, VkFormat format) {
    auto [color, resolve] = std::make_pair(many(format), one(format));
    std::tie(resolve, color) = std::make_tuple(color, resolve);
    const VkAttachmentDescription list[] = {resolve, color};
    return create(device, list, 0, 1);
}

VkRenderPass shrunk(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list(4, one(format));
    list.clear();
    list.resize(2);
    list.front() = many(format);
    list.back() = one(format);
    return create(device, list.data(), 0, 1);
}

VkRenderPass moved(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> first{one(format), one(format)}, second;
    second.emplace_back(many(format));
    second.insert(second.end(), first.begin(), first.begin() + 1);
    first = std::move(second);
    return create(device, first.data(), 0, 1);
}

VkRenderPass pointed(VkDevice device, VkFormat format) {
    std::vector<VkAttachmentDescription> list{one(format), one(format)};
    auto it = list.begin();
    *it++ = many(format);
    it->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return create(device, &list.at(0), 0, 1);
}
