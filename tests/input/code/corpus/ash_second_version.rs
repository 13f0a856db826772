// A render pass of the second version with ash: its masks are those of synchronization2, and depth is resolved.
use ash::vk;

const SAMPLES: vk::SampleCountFlags = vk::SampleCountFlags::TYPE_4;

fn attachment<'a>(format: vk::Format, samples: vk::SampleCountFlags, store: vk::AttachmentStoreOp) -> vk::AttachmentDescription2<'a> {
    vk::AttachmentDescription2::default()
        .format(format)
        .samples(samples)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(store)
        .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
        .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
        .initial_layout(vk::ImageLayout::UNDEFINED)
        .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
}

fn reference<'a>(index: u32) -> vk::AttachmentReference2<'a> {
    vk::AttachmentReference2::default().attachment(index).layout(vk::ImageLayout::ATTACHMENT_OPTIMAL)
}

pub unsafe fn create(device: &ash::Device) -> Result<vk::RenderPass, vk::Result> {
    let attachments = [
        attachment(vk::Format::R8G8B8A8_UNORM, SAMPLES, vk::AttachmentStoreOp::DONT_CARE),
        attachment(vk::Format::D32_SFLOAT, SAMPLES, vk::AttachmentStoreOp::DONT_CARE),
        attachment(vk::Format::R8G8B8A8_UNORM, vk::SampleCountFlags::TYPE_1, vk::AttachmentStoreOp::STORE),
        attachment(vk::Format::D32_SFLOAT, vk::SampleCountFlags::TYPE_1, vk::AttachmentStoreOp::STORE),
    ];
    let (colors, depth, resolves, depth_target) = ([reference(0)], reference(1), [reference(2)], reference(3));
    let mut depth_resolve = vk::SubpassDescriptionDepthStencilResolve::default()
        .depth_resolve_mode(vk::ResolveModeFlagsKHR::AVERAGE) // expect: MSAA703
        .stencil_resolve_mode(vk::ResolveModeFlags::NONE)
        .depth_stencil_resolve_attachment(&depth_target);
    let subpasses = [vk::SubpassDescription2::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .color_attachments(&colors)
        .resolve_attachments(&resolves)
        .depth_stencil_attachment(&depth)
        .push_next(&mut depth_resolve)];
    let info = vk::RenderPassCreateInfo2::default().attachments(&attachments).subpasses(&subpasses);
    device.create_render_pass2(&info, None)
}
