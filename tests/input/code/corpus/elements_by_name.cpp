// Attachments and their parts have names: structured bindings, pairs, iterators, and the parameters of lambdas that a scheduler runs.
#include <vulkan/vulkan.h>

#include <functional>
#include <tuple>
#include <utility>
#include <vector>

struct Scheduler {
    void submit(std::function<void(VkDevice)> job);
};

struct Targets {
    VkAttachmentDescription color, resolve;
};

static VkAttachmentDescription describe(VkSampleCountFlagBits samples, VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
    VkAttachmentDescription description{};
    description.format = VK_FORMAT_R8G8B8A8_UNORM;
    description.samples = samples;
    description.loadOp = load;
    description.storeOp = store;
    description.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return description;
}

static VkRenderPass create(VkDevice device, const std::vector<VkAttachmentDescription>& attachments) {
    VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = static_cast<uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}

static std::pair<VkAttachmentDescription, VkAttachmentDescription> scene() {
    return {describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
            describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)};
}

static Targets overlay() {
    return {describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
            describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)};
}

void createPasses(VkDevice device, Scheduler& scheduler) {
    const auto [color, resolve] = scene();
    create(device, {color, resolve});

    auto [samples, window] = overlay();
    create(device, {samples, window});

    const auto third = std::make_tuple(
        describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
        describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE));
    create(device, {std::get<0>(third), std::get<1>(third)});

    const std::vector<VkAttachmentDescription> listed{
        describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
        describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)};
    std::vector<VkAttachmentDescription> attachments;
    for (auto it = listed.begin(); it != listed.end(); ++it)
        attachments.push_back(*it);
    create(device, attachments);

    scheduler.submit([](VkDevice chosen) {
        create(chosen, {describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_STORE),  // expect: MSAA201
                        describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE)});
    });

    // What the second name stands for is not stored.
    auto [first, second] = std::make_pair(describe(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_STORE),
                                          describe(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR, VK_ATTACHMENT_STORE_OP_DONT_CARE));
    create(device, {second, first});
}
