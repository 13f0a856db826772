pub mod targets;

use ash::vk;
use targets::Targets;

pub fn draw(device: &ash::Device, targets: &Targets) {
    let colors = [vk::RenderingAttachmentInfo::default()
        .image_view(targets.color.view)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::DONT_CARE)
        .resolve_mode(vk::ResolveModeFlags::AVERAGE)
        .resolve_image_view(targets.output)];
    let depth = vk::RenderingAttachmentInfo::default()
        .image_view(targets.depth.view)
        .load_op(vk::AttachmentLoadOp::CLEAR)
        .store_op(vk::AttachmentStoreOp::STORE); // expect: MSAA203 // may: MSAA403
    let info = vk::RenderingInfo::default().layer_count(1).color_attachments(&colors).depth_attachment(&depth);
    unsafe { device.cmd_begin_rendering(targets.commands, &info) };
}
