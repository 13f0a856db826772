// vulkan.hpp, members set one by one on objects, `vk::` everywhere, setAttachments with a braced list.
#include <vulkan/vulkan.hpp>

struct Mirror {
    vk::Device device;
    vk::RenderPass pass;
    vk::Image image;
    const vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e2;

    void createPass(vk::Format format) {
        vk::AttachmentDescription colorAttachment;
        colorAttachment.format = format;
        colorAttachment.samples = samples;
        colorAttachment.loadOp = vk::AttachmentLoadOp::eClear;
        colorAttachment.storeOp = vk::AttachmentStoreOp::eStore;  // expect: MSAA201
        colorAttachment.finalLayout = vk::ImageLayout::eColorAttachmentOptimal;

        vk::AttachmentDescription resolveAttachment{};
        resolveAttachment.setFormat(format);
        resolveAttachment.setSamples(vk::SampleCountFlagBits::e1);
        resolveAttachment.setLoadOp(vk::AttachmentLoadOp::eDontCare);
        resolveAttachment.setStoreOp(vk::AttachmentStoreOp::eStore);
        resolveAttachment.setFinalLayout(vk::ImageLayout::eShaderReadOnlyOptimal);

        vk::AttachmentReference colorRef;
        colorRef.attachment = 0;
        colorRef.layout = vk::ImageLayout::eColorAttachmentOptimal;
        vk::AttachmentReference resolveRef;
        resolveRef.attachment = 1;
        resolveRef.layout = vk::ImageLayout::eColorAttachmentOptimal;

        vk::SubpassDescription subpass;
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &colorRef;
        subpass.pResolveAttachments = &resolveRef;

        vk::SubpassDependency dependency{};
        dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
        dependency.dstSubpass = 0;
        dependency.srcStageMask = vk::PipelineStageFlagBits::eColorAttachmentOutput;
        dependency.srcAccessMask = {};  // expect-later: MSAA602#external
        dependency.dstStageMask = vk::PipelineStageFlagBits::eColorAttachmentOutput;
        dependency.dstAccessMask = vk::AccessFlagBits::eColorAttachmentWrite;

        auto attachments = {colorAttachment, resolveAttachment};
        vk::RenderPassCreateInfo renderPassInfo;
        renderPassInfo.setAttachments(attachments);
        renderPassInfo.setSubpasses(subpass);
        renderPassInfo.setDependencies(dependency);
        pass = device.createRenderPass(renderPassInfo);
    }

    vk::Pipeline createPipeline(vk::PipelineLayout layout) {
        vk::PipelineMultisampleStateCreateInfo multisampling;
        multisampling.rasterizationSamples = samples;
        multisampling.sampleShadingEnable = true;  // expect: MSAA502#shading
        multisampling.minSampleShading = .2f;  // may: MSAA502#shading
        vk::GraphicsPipelineCreateInfo info;
        info.pMultisampleState = &multisampling;
        info.layout = layout;
        info.renderPass = pass;
        return device.createGraphicsPipeline(nullptr, info).value;
    }
};
