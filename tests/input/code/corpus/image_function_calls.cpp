// A helper for images that is called five times: two of the calls are wrong, and only the arguments say so.
#include <vulkan/vulkan.h>

#include <array>
#include <stdexcept>

struct Texture {
    VkImage image;
    VkImageView view;
};

class Scene {
public:
    void prepare(VkExtent2D size);

private:
    Texture createTexture(uint32_t w, uint32_t h, VkFormat fmt, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                          VkImageAspectFlags aspect, uint32_t mips = 1);
    void createPass();
    void createFramebuffer(VkExtent2D size, VkImageView target);

    VkDevice dev_{};
    VkRenderPass pass_{};
    VkFramebuffer framebuffer_{};
    Texture color_{}, depth_{}, ids_{}, noise_{}, out_{};
};

Texture Scene::createTexture(uint32_t w, uint32_t h, VkFormat fmt, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                             VkImageAspectFlags aspect, uint32_t mips) {
    Texture t{};
    VkImageCreateInfo ci = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    ci.imageType = VK_IMAGE_TYPE_2D;
    ci.extent = {w, h, 1};
    ci.format = fmt;
    ci.mipLevels = mips;
    ci.arrayLayers = 1;
    ci.samples = samples;
    ci.usage = usage;
    if (vkCreateImage(dev_, &ci, nullptr, &t.image)) throw std::runtime_error("vkCreateImage");
    VkImageViewCreateInfo vi = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    vi.image = t.image;
    vi.viewType = VK_IMAGE_VIEW_TYPE_2D;
    vi.format = fmt;
    vi.subresourceRange = {aspect, 0, mips, 0, 1};
    if (vkCreateImageView(dev_, &vi, nullptr, &t.view)) throw std::runtime_error("vkCreateImageView");
    return t;
}

void Scene::prepare(VkExtent2D size) {
    color_ = createTexture(size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_4_BIT,
                           VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,  // expect: MSAA401
                           VK_IMAGE_ASPECT_COLOR_BIT);
    depth_ = createTexture(size.width, size.height, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT,
                           VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT,
                           VK_IMAGE_ASPECT_DEPTH_BIT);
    ids_ = createTexture(size.width, size.height, VK_FORMAT_R32_UINT, VK_SAMPLE_COUNT_1_BIT,
                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    noise_ = createTexture(256, 256, VK_FORMAT_R8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT, 9);
    out_ = createTexture(size.width, size.height, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT,
                         VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT);
    // A transient image that a shader is to sample: Vulkan forbids it.
    Texture normals = createTexture(size.width, size.height, VK_FORMAT_R16G16_SFLOAT, VK_SAMPLE_COUNT_4_BIT,
                                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT |  // expect: MSAA404#normals
                                        VK_IMAGE_USAGE_SAMPLED_BIT,  // may: MSAA404#normals
                                    VK_IMAGE_ASPECT_COLOR_BIT);
    (void)normals;
    createPass();
    createFramebuffer(size, out_.view);
}

void Scene::createPass() {
    std::array<VkAttachmentDescription, 3> a{};
    a[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    a[0].samples = VK_SAMPLE_COUNT_4_BIT;
    a[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    a[1].format = VK_FORMAT_D32_SFLOAT;
    a[1].samples = VK_SAMPLE_COUNT_4_BIT;
    a[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    a[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    a[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    a[2].format = VK_FORMAT_R8G8B8A8_UNORM;
    a[2].samples = VK_SAMPLE_COUNT_1_BIT;
    a[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    a[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    a[2].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    VkAttachmentReference c{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference d{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentReference r{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription s{};
    s.colorAttachmentCount = 1;
    s.pColorAttachments = &c;
    s.pResolveAttachments = &r;
    s.pDepthStencilAttachment = &d;
    VkRenderPassCreateInfo ci = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    ci.attachmentCount = 3;
    ci.pAttachments = a.data();
    ci.subpassCount = 1;
    ci.pSubpasses = &s;
    vkCreateRenderPass(dev_, &ci, nullptr, &pass_);
}

void Scene::createFramebuffer(VkExtent2D size, VkImageView target) {
    VkImageView views[] = {color_.view, depth_.view, target};
    VkFramebufferCreateInfo ci = {VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO};
    ci.renderPass = pass_;
    ci.attachmentCount = 3;
    ci.pAttachments = views;
    ci.width = size.width;
    ci.height = size.height;
    ci.layers = 1;
    vkCreateFramebuffer(dev_, &ci, nullptr, &framebuffer_);
}
