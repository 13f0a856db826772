// Dynamic rendering with a mode that depends on a setting; an image that is resolved by a command.
use ash::vk::{self, AttachmentLoadOp, AttachmentStoreOp, RenderingAttachmentInfo};

pub struct Target {
    view: vk::ImageView,
    resolve: Option<vk::ImageView>,
}

pub struct Frame<'a> {
    device: &'a ash::Device,
    color: Target,
    msaa: bool,
}

impl Frame<'_> {
    pub fn begin(&self, commands: vk::CommandBuffer, area: vk::Rect2D) {
        let mut color = RenderingAttachmentInfo::default()
            .image_view(self.color.view)
            .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
            .load_op(AttachmentLoadOp::CLEAR)
            .store_op(AttachmentStoreOp::STORE); // expect: MSAA201
        if let Some(target) = self.color.resolve {
            color = color
                .resolve_mode(vk::ResolveModeFlags::AVERAGE_KHR)
                .resolve_image_view(target)
                .resolve_image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
        }
        let info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(std::slice::from_ref(&color));
        unsafe { self.device.cmd_begin_rendering(commands, &info) };
    }

    pub fn draw_apart(&self, commands: vk::CommandBuffer, area: vk::Rect2D, target: vk::Image, region: vk::ImageResolve) {
        let info = vk::ImageCreateInfo {
            image_type: vk::ImageType::TYPE_2D,
            format: vk::Format::R8G8B8A8_UNORM,
            samples: match self.msaa {
                true => vk::SampleCountFlags::TYPE_4,
                false => vk::SampleCountFlags::TYPE_1,
            },
            usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC,
            ..Default::default()
        };
        let image = unsafe { self.device.create_image(&info, None) }.unwrap();
        let view = vk::ImageViewCreateInfo { image, view_type: vk::ImageViewType::TYPE_2D, ..Default::default() };
        let view = unsafe { self.device.create_image_view(&view, None) }.unwrap();
        let attachments = [RenderingAttachmentInfo {
            image_view: view,
            load_op: AttachmentLoadOp::CLEAR,
            store_op: AttachmentStoreOp::STORE,
            ..Default::default()
        }];
        unsafe {
            self.device.cmd_begin_rendering(commands, &vk::RenderingInfo::default().render_area(area).color_attachments(&attachments));
            self.device.cmd_end_rendering(commands);
            self.device.cmd_resolve_image( // expect: MSAA301
                commands,
                image,
                vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
                target,
                vk::ImageLayout::TRANSFER_DST_OPTIMAL,
                &[region],
            );
        }
    }
}
