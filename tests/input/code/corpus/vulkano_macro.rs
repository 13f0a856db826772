// Render passes by vulkano's macros; images and multisample state as structures.
use std::sync::Arc;
use vulkano::{
    device::Device,
    format::Format,
    image::{view::ImageView, Image, ImageCreateInfo, ImageType, ImageUsage, SampleCount},
    memory::allocator::{AllocationCreateInfo, StandardMemoryAllocator},
    render_pass::{Framebuffer, FramebufferCreateInfo, RenderPass},
};

pub fn forward(device: Arc<Device>, allocator: Arc<StandardMemoryAllocator>, target: Arc<ImageView>) -> Arc<Framebuffer> {
    let render_pass = vulkano::single_pass_renderpass!(
        device.clone(),
        attachments: {
            intermediary: {
                format: Format::R8G8B8A8_UNORM,
                samples: 4,
                load_op: Clear,
                store_op: Store, // expect: MSAA201
            },
            color: {
                format: Format::R8G8B8A8_UNORM,
                samples: 1,
                load_op: DontCare,
                store_op: Store,
            },
        },
        pass: {
            color: [intermediary],
            color_resolve: [color],
            depth_stencil: {},
        },
    )
    .unwrap();
    let intermediary = ImageView::new_default(
        Image::new(
            allocator.clone(),
            ImageCreateInfo {
                image_type: ImageType::Dim2d,
                format: Format::R8G8B8A8_UNORM,
                extent: [1024, 1024, 1],
                usage: ImageUsage::COLOR_ATTACHMENT, // expect: MSAA401
                samples: SampleCount::Sample4,
                ..Default::default()
            },
            AllocationCreateInfo::default(),
        )
        .unwrap(),
    )
    .unwrap();
    Framebuffer::new(render_pass, FramebufferCreateInfo { attachments: vec![intermediary, target], ..Default::default() }).unwrap()
}

pub fn deferred(device: Arc<Device>) -> Arc<RenderPass> {
    vulkano::ordered_passes_renderpass!(
        device,
        attachments: {
            color: { format: Format::R8G8B8A8_SRGB, samples: 4, load_op: Clear, store_op: DontCare },
            depth: { format: Format::D16_UNORM, samples: 4, load_op: Clear, store_op: DontCare },
            target: { format: Format::R8G8B8A8_SRGB, samples: 1, load_op: DontCare, store_op: Store },
        },
        passes: [
            { color: [color], depth_stencil: { depth }, input: [] },
            { color: [color], color_resolve: [target], depth_stencil: { depth }, input: [] },
        ],
    )
    .unwrap()
}
