// Structures written out, with the pointers and counts of C; constants of the program; a base of which members differ.
use ash::vk;
use std::ptr;

const SAMPLES: vk::SampleCountFlags = vk::SampleCountFlags::TYPE_4;

#[derive(Clone, Copy)]
struct Operations {
    load: vk::AttachmentLoadOp,
    store: vk::AttachmentStoreOp,
}

impl Default for Operations {
    fn default() -> Self {
        Operations { load: vk::AttachmentLoadOp::CLEAR, store: vk::AttachmentStoreOp::DONT_CARE }
    }
}

fn describe(format: vk::Format, samples: vk::SampleCountFlags, operations: Operations, layout: vk::ImageLayout) -> vk::AttachmentDescription {
    vk::AttachmentDescription {
        flags: vk::AttachmentDescriptionFlags::empty(),
        format,
        samples,
        load_op: operations.load,
        store_op: operations.store,
        stencil_load_op: vk::AttachmentLoadOp::DONT_CARE,
        stencil_store_op: vk::AttachmentStoreOp::DONT_CARE,
        initial_layout: vk::ImageLayout::UNDEFINED,
        final_layout: layout,
    }
}

pub fn create_render_pass(device: &ash::Device, format: vk::Format) -> vk::RenderPass {
    let color = vk::AttachmentDescription {
        store_op: vk::AttachmentStoreOp::STORE, // expect: MSAA201
        ..describe(format, SAMPLES, Operations::default(), vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
    };
    let depth = describe(vk::Format::D32_SFLOAT, SAMPLES, Operations::default(), vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    let target = describe(
        format,
        vk::SampleCountFlags::TYPE_1,
        Operations { load: vk::AttachmentLoadOp::DONT_CARE, store: vk::AttachmentStoreOp::STORE },
        vk::ImageLayout::PRESENT_SRC_KHR,
    );
    let color_reference = vk::AttachmentReference { attachment: 0, layout: vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL };
    let depth_reference = vk::AttachmentReference { attachment: 1, layout: vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL };
    let target_reference = vk::AttachmentReference { attachment: 2, ..color_reference };
    let attachments = [color, depth, target];
    let subpasses = [vk::SubpassDescription {
        flags: vk::SubpassDescriptionFlags::empty(),
        pipeline_bind_point: vk::PipelineBindPoint::GRAPHICS,
        input_attachment_count: 0,
        p_input_attachments: ptr::null(),
        color_attachment_count: 1,
        p_color_attachments: &color_reference,
        p_resolve_attachments: &target_reference,
        p_depth_stencil_attachment: &depth_reference,
        preserve_attachment_count: 0,
        p_preserve_attachments: ptr::null(),
    }];
    let info = vk::RenderPassCreateInfo {
        s_type: vk::StructureType::RENDER_PASS_CREATE_INFO,
        p_next: ptr::null(),
        flags: vk::RenderPassCreateFlags::empty(),
        attachment_count: attachments.len() as u32,
        p_attachments: attachments.as_ptr(),
        subpass_count: subpasses.len() as u32,
        p_subpasses: subpasses.as_ptr(),
        dependency_count: 0,
        p_dependencies: ptr::null(),
    };
    unsafe { device.create_render_pass(&info, None).expect("a render pass") }
}
