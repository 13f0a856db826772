// Objects that convert to Vulkan's: what they hold lies in a structure of theirs, and their owners initialize them before the body.
#include <vk_mem_alloc.h>

#include <array>
#include <memory>

class Picture {
public:
    struct Description {
        const VkFormat format;
        const VkImageUsageFlags usage;
        const VkSampleCountFlagBits samples;
    };
    Picture(VmaAllocator allocator, VkFormat format, VkImageUsageFlags usage, VkSampleCountFlagBits samples)
        : m_allocator(allocator), m_description({.format = format, .usage = usage, .samples = samples}), m_memory(allocate()) {}
    operator VkImage() const { return m_memory.image; }
    const Description& description() const { return m_description; }

private:
    struct Memory {
        const VkImage image;
        const VmaAllocation allocation;
    };
    const VmaAllocator m_allocator;
    const Description m_description;
    const Memory m_memory;

    Memory allocate() {
        VkImageCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.extent = {1600, 900, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.format = m_description.format;
        info.usage = m_description.usage;
        info.samples = m_description.samples;
        VmaAllocationCreateInfo request = {};
        request.usage = VMA_MEMORY_USAGE_GPU_ONLY;
        VkImage image = nullptr;
        VmaAllocation allocation = nullptr;
        vmaCreateImage(m_allocator, &info, &request, &image, &allocation, nullptr);
        return {.image = image, .allocation = allocation};
    }
};

class PictureView {
public:
    PictureView(VkDevice device, const Picture& picture, VkImageAspectFlags aspect)
        : m_device(device), m_picture(picture), m_aspect(aspect), m_view(create()) {}
    operator VkImageView() const { return m_view; }

private:
    const VkDevice m_device;
    const Picture& m_picture;
    const VkImageAspectFlags m_aspect;
    const VkImageView m_view;

    VkImageView create() {
        VkImageViewCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        info.image = m_picture;
        info.viewType = VK_IMAGE_VIEW_TYPE_2D;
        info.format = m_picture.description().format;
        info.subresourceRange = {m_aspect, 0, 1, 0, 1};
        VkImageView view = nullptr;
        vkCreateImageView(m_device, &info, nullptr, &view);
        return view;
    }
};

class ColorTarget {
public:
    ColorTarget(VkDevice device, VmaAllocator allocator)
        : m_picture(allocator, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_SAMPLE_COUNT_4_BIT),  // expect: MSAA401
          m_view(device, m_picture, VK_IMAGE_ASPECT_COLOR_BIT) {}
    VkImageView view() const { return m_view; }

private:
    const Picture m_picture;
    const PictureView m_view;
};

class ResolvingPass {
public:
    explicit ResolvingPass(VkDevice device) : m_device(device), m_pass(create()) {}
    operator VkRenderPass() const { return m_pass; }

private:
    const VkDevice m_device;
    const VkRenderPass m_pass;

    VkRenderPass create() const {
        std::array<VkAttachmentDescription, 2> attachments = {};
        attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
        attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
        attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachments[1].format = VK_FORMAT_R8G8B8A8_UNORM;
        attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachments[1].finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
        VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkAttachmentReference target = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        VkSubpassDescription subpass = {};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        subpass.pResolveAttachments = &target;
        VkRenderPassCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
        info.attachmentCount = static_cast<uint32_t>(attachments.size());
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        VkRenderPass pass = nullptr;
        vkCreateRenderPass(m_device, &info, nullptr, &pass);
        return pass;
    }
};

class Presenter {
public:
    Presenter(VkDevice device, VmaAllocator allocator) : m_device(device) {
        m_target = std::make_unique<ColorTarget>(device, allocator);
        m_pass = std::make_unique<ResolvingPass>(device);
    }
    VkFramebuffer framebuffer(VkImageView surface) { return connect(*m_pass, *m_target, surface); }

private:
    VkDevice m_device;
    std::unique_ptr<ColorTarget> m_target;
    std::unique_ptr<ResolvingPass> m_pass;

    VkFramebuffer connect(const ResolvingPass& pass, const ColorTarget& target, VkImageView surface) {
        auto views = std::array<VkImageView, 2>{target.view(), surface};
        VkFramebufferCreateInfo info = {};
        info.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO;
        info.renderPass = pass;
        info.attachmentCount = static_cast<uint32_t>(views.size());
        info.pAttachments = views.data();
        info.width = 1600;
        info.height = 900;
        info.layers = 1;
        VkFramebuffer framebuffer = nullptr;
        vkCreateFramebuffer(m_device, &info, nullptr, &framebuffer);
        return framebuffer;
    }
};
