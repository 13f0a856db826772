// The same as it should be: nothing is stored that nothing reads. A copy of a description changes, and the original does not.
use ash::vk;

pub unsafe fn create_pass(device: &ash::Device, format: vk::Format, limits: &vk::PhysicalDeviceLimits) -> vk::RenderPass {
    let counts = limits.framebuffer_color_sample_counts & limits.framebuffer_depth_sample_counts;
    let samples = if counts.contains(vk::SampleCountFlags::TYPE_4) {
        vk::SampleCountFlags::TYPE_4
    } else {
        vk::SampleCountFlags::TYPE_1
    };
    let base = vk::AttachmentDescription::builder()
        .format(format)
        .samples(samples)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::DONT_CARE)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
        .build();
    let target = base
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(vk::AttachmentLoadOp::DONT_CARE)
        .store_op(vk::AttachmentStoreOp::STORE)
        .final_layout(vk::ImageLayout::PRESENT_SRC_KHR);
    let colors = [vk::AttachmentReference { attachment: 0, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL }];
    let targets = [vk::AttachmentReference { attachment: 1, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL }];
    let subpasses = vec![vk::SubpassDescription::builder()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)
        .resolve_attachments(&targets)
        .build()];
    let attachments = vec![base, target];
    let info = vk::RenderPassCreateInfo::builder().attachments(&attachments).subpasses(&subpasses);
    device.create_render_pass(&info, None).expect("a render pass")
}
