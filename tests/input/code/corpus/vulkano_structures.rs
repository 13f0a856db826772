// A render pass of vulkano written out, with the resolve target in the reference of its source.
use vulkano::image::{ImageLayout, SampleCount};
use vulkano::render_pass::{
    AttachmentDescription, AttachmentLoadOp, AttachmentReference, AttachmentStoreOp, RenderPass, RenderPassCreateInfo, SubpassDescription,
};

pub fn create(device: std::sync::Arc<vulkano::device::Device>, format: vulkano::format::Format) -> std::sync::Arc<RenderPass> {
    let create_info = RenderPassCreateInfo {
        attachments: vec![
            AttachmentDescription {
                format,
                samples: SampleCount::Sample4,
                load_op: AttachmentLoadOp::Clear,
                store_op: AttachmentStoreOp::Store, // expect: MSAA201
                final_layout: ImageLayout::ColorAttachmentOptimal,
                ..Default::default()
            },
            AttachmentDescription {
                format,
                load_op: AttachmentLoadOp::DontCare,
                store_op: AttachmentStoreOp::Store,
                final_layout: ImageLayout::PresentSrc,
                ..Default::default()
            },
        ],
        subpasses: vec![SubpassDescription {
            color_attachments: vec![Some(AttachmentReference {
                attachment: 0,
                layout: ImageLayout::ColorAttachmentOptimal,
                ..Default::default()
            })],
            color_resolve_attachments: vec![Some(AttachmentReference {
                attachment: 1,
                layout: ImageLayout::ColorAttachmentOptimal,
                ..Default::default()
            })],
            ..Default::default()
        }],
        ..Default::default()
    };
    RenderPass::new(device, create_info).unwrap()
}
