// vulkan.hpp with its constructors: arguments in the members' order, unique handles, flags combined by operators.
#include <vulkan/vulkan.hpp>

#include <array>
#include <vector>

class Window {
public:
    explicit Window(vk::Device device, vk::PhysicalDevice gpu) : device_(device), gpu_(gpu) {}

    void createAll(vk::Extent2D extent) {
        createImages(extent);
        createRenderPass();
        createPipeline();
    }

private:
    void createImages(vk::Extent2D extent) {
        vk::ImageCreateInfo colorInfo(vk::ImageCreateFlags(), vk::ImageType::e2D, colorFormat_, vk::Extent3D(extent, 1), 1, 1,
                                      vk::SampleCountFlagBits::e4, vk::ImageTiling::eOptimal,
                                      vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransientAttachment);
        color_ = device_.createImageUnique(colorInfo);

        depth_ = device_.createImageUnique(vk::ImageCreateInfo(
            {}, vk::ImageType::e2D, depthFormat_, vk::Extent3D(extent, 1), 1, 1, vk::SampleCountFlagBits::e4, vk::ImageTiling::eOptimal,
            vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eTransientAttachment));
    }

    void createRenderPass() {
        std::array<vk::AttachmentDescription, 3> attachments;
        attachments[0] = vk::AttachmentDescription(
            vk::AttachmentDescriptionFlags(), colorFormat_, vk::SampleCountFlagBits::e4, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eStore,  // expect: MSAA201
            vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare, vk::ImageLayout::eUndefined,
            vk::ImageLayout::eColorAttachmentOptimal);
        attachments[1] = vk::AttachmentDescription(
            vk::AttachmentDescriptionFlags(), depthFormat_, vk::SampleCountFlagBits::e4, vk::AttachmentLoadOp::eClear,
            vk::AttachmentStoreOp::eDontCare, vk::AttachmentLoadOp::eDontCare, vk::AttachmentStoreOp::eDontCare,
            vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthStencilAttachmentOptimal);
        attachments[2] = vk::AttachmentDescription({}, colorFormat_, vk::SampleCountFlagBits::e1, vk::AttachmentLoadOp::eDontCare,
                                                   vk::AttachmentStoreOp::eStore, vk::AttachmentLoadOp::eDontCare,
                                                   vk::AttachmentStoreOp::eDontCare, vk::ImageLayout::eUndefined,
                                                   vk::ImageLayout::ePresentSrcKHR);

        vk::AttachmentReference colorReference(0, vk::ImageLayout::eColorAttachmentOptimal);
        vk::AttachmentReference depthReference(1, vk::ImageLayout::eDepthStencilAttachmentOptimal);
        vk::AttachmentReference resolveReference(2, vk::ImageLayout::eColorAttachmentOptimal);
        vk::SubpassDescription subpass({}, vk::PipelineBindPoint::eGraphics, {}, colorReference, resolveReference, &depthReference);

        vk::SubpassDependency dependency(
            VK_SUBPASS_EXTERNAL, 0, vk::PipelineStageFlagBits::eColorAttachmentOutput | vk::PipelineStageFlagBits::eLateFragmentTests,
            vk::PipelineStageFlagBits::eColorAttachmentOutput | vk::PipelineStageFlagBits::eEarlyFragmentTests,
            vk::AccessFlagBits::eColorAttachmentWrite | vk::AccessFlagBits::eDepthStencilAttachmentWrite,
            vk::AccessFlagBits::eColorAttachmentWrite | vk::AccessFlagBits::eDepthStencilAttachmentWrite);
        pass_ = device_.createRenderPassUnique(vk::RenderPassCreateInfo({}, attachments, subpass, dependency));
    }

    void createPipeline() {
        vk::PipelineMultisampleStateCreateInfo multisample({}, vk::SampleCountFlagBits::e4, VK_TRUE, 1.0f);  // expect: MSAA501
        vk::GraphicsPipelineCreateInfo info;
        info.setPMultisampleState(&multisample).setRenderPass(*pass_).setSubpass(0).setLayout(layout_);
        pipeline_ = device_.createGraphicsPipelineUnique(nullptr, info).value;
    }

    vk::Device device_;
    vk::PhysicalDevice gpu_;
    vk::Format colorFormat_ = vk::Format::eB8G8R8A8Unorm;
    vk::Format depthFormat_ = vk::Format::eD16Unorm;
    vk::UniqueImage color_, depth_;
    vk::UniqueRenderPass pass_;
    vk::PipelineLayout layout_;
    vk::UniquePipeline pipeline_;
};

void start(vk::Device device, vk::PhysicalDevice gpu) { Window(device, gpu).createAll(vk::Extent2D(1024, 768)); }
