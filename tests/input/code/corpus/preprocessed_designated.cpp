// Members of designated initialisers that are there only with MSAA; the multisampled color is stored nevertheless.
#define VULKAN_HPP_NO_STRUCT_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

#include <array>

#define MSAA_ENABLE
#ifdef MSAA_ENABLE
constexpr auto SAMPLES = vk::SampleCountFlagBits::e4;
#else
constexpr auto SAMPLES = vk::SampleCountFlagBits::e1;
#endif
static vk::raii::RenderPass renderPass = nullptr;
static vk::raii::Pipeline pipeline = nullptr;

void createRenderPass(vk::raii::Device& device, vk::Format swapFormat) {
    vk::AttachmentDescription colorAttachment {
        .format = swapFormat,
        .samples = SAMPLES,
        .loadOp = vk::AttachmentLoadOp::eClear,
#ifdef MSAA_ENABLE
        .storeOp = vk::AttachmentStoreOp::eStore,  // expect: MSAA201
#else
        .storeOp = vk::AttachmentStoreOp::eStore,
#endif
        .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
        .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
        .initialLayout = vk::ImageLayout::eUndefined,
#ifdef MSAA_ENABLE
        .finalLayout = vk::ImageLayout::eColorAttachmentOptimal
#else
        .finalLayout = vk::ImageLayout::ePresentSrcKHR
#endif
    };
    vk::AttachmentDescription depthAttachment {
        .format = vk::Format::eD32Sfloat,
        .samples = SAMPLES,
        .loadOp = vk::AttachmentLoadOp::eClear,
        .storeOp = vk::AttachmentStoreOp::eDontCare,
        .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
        .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
        .initialLayout = vk::ImageLayout::eUndefined,
        .finalLayout = vk::ImageLayout::eDepthStencilAttachmentOptimal
    };
#ifdef MSAA_ENABLE
    vk::AttachmentDescription resolveAttachment {
        .format = swapFormat,
        .samples = vk::SampleCountFlagBits::e1,
        .loadOp = vk::AttachmentLoadOp::eDontCare,
        .storeOp = vk::AttachmentStoreOp::eStore,
        .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
        .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
        .initialLayout = vk::ImageLayout::eUndefined,
        .finalLayout = vk::ImageLayout::ePresentSrcKHR
    };
    std::array attachments = { colorAttachment, depthAttachment, resolveAttachment };
    vk::AttachmentReference resolveAttachmentReference { .attachment = 2, .layout = vk::ImageLayout::eColorAttachmentOptimal };
#else
    std::array attachments = { colorAttachment, depthAttachment };
#endif
    vk::AttachmentReference colorAttachmentRef { .attachment = 0, .layout = vk::ImageLayout::eColorAttachmentOptimal };
    vk::AttachmentReference depthAttachmentReference { .attachment = 1, .layout = vk::ImageLayout::eDepthStencilAttachmentOptimal };
    vk::SubpassDescription subpass {
        .pipelineBindPoint = vk::PipelineBindPoint::eGraphics,
        .colorAttachmentCount = 1,
        .pColorAttachments = &colorAttachmentRef,
#ifdef MSAA_ENABLE
        .pResolveAttachments = &resolveAttachmentReference,
#endif
        .pDepthStencilAttachment = &depthAttachmentReference
    };
    vk::RenderPassCreateInfo info { .attachmentCount = static_cast<uint32_t>(attachments.size()), .pAttachments = attachments.data(), .subpassCount = 1, .pSubpasses = &subpass };
    renderPass = vk::raii::RenderPass(device, info);
    vk::PipelineMultisampleStateCreateInfo ms { .rasterizationSamples = SAMPLES, .sampleShadingEnable = VK_FALSE };
    vk::GraphicsPipelineCreateInfo p { .pMultisampleState = &ms, .renderPass = *renderPass };
    pipeline = vk::raii::Pipeline(device, nullptr, p);
}
