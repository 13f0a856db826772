// A renderer with ash: setters in chains, results in tuples, a structure of images.
use ash::vk;
use std::sync::Arc;

struct Texture {
    image: vk::Image,
    memory: vk::DeviceMemory,
    view: vk::ImageView,
}

pub struct Renderer {
    device: Arc<ash::Device>,
    samples: vk::SampleCountFlags,
    color: Texture,
    depth: Texture,
    pass: vk::RenderPass,
    framebuffers: Vec<vk::Framebuffer>,
}

fn memory_type(properties: vk::PhysicalDeviceMemoryProperties, bits: u32, wanted: vk::MemoryPropertyFlags) -> Option<u32> {
    (0..properties.memory_type_count)
        .find(|&n| bits & (1 << n) != 0 && properties.memory_types[n as usize].property_flags.contains(wanted))
}

unsafe fn create_image(
    device: &ash::Device,
    properties: vk::PhysicalDeviceMemoryProperties,
    extent: vk::Extent2D,
    format: vk::Format,
    samples: vk::SampleCountFlags,
    usage: vk::ImageUsageFlags,
) -> Result<(vk::Image, vk::DeviceMemory), vk::Result> {
    let info = vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(format)
        .extent(vk::Extent3D { width: extent.width, height: extent.height, depth: 1 })
        .mip_levels(1)
        .array_layers(1)
        .samples(samples)
        .tiling(vk::ImageTiling::OPTIMAL)
        .usage(usage);
    let image = device.create_image(&info, None)?;
    let requirements = device.get_image_memory_requirements(image);
    let index = memory_type(properties, requirements.memory_type_bits, vk::MemoryPropertyFlags::DEVICE_LOCAL).unwrap();
    let allocation = vk::MemoryAllocateInfo::default().allocation_size(requirements.size).memory_type_index(index);
    let memory = device.allocate_memory(&allocation, None)?;
    device.bind_image_memory(image, memory, 0)?;
    Ok((image, memory))
}

unsafe fn create_view(device: &ash::Device, image: vk::Image, format: vk::Format, aspect: vk::ImageAspectFlags) -> vk::ImageView {
    let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
    let info = vk::ImageViewCreateInfo::default()
        .image(image)
        .view_type(vk::ImageViewType::TYPE_2D)
        .format(format)
        .subresource_range(range);
    device.create_image_view(&info, None).expect("an image view")
}

impl Renderer {
    pub fn new(
        device: Arc<ash::Device>,
        properties: vk::PhysicalDeviceMemoryProperties,
        extent: vk::Extent2D,
        format: vk::Format,
        targets: &[vk::ImageView],
    ) -> Self {
        let samples = vk::SampleCountFlags::TYPE_4;
        let color = Self::create_color(&device, properties, extent, format, samples);
        let depth = Self::create_depth(&device, properties, extent, samples);
        let pass = Self::create_pass(&device, format, samples);
        let framebuffers = targets
            .iter()
            .map(|&target| {
                let views = [color.view, depth.view, target];
                let info = vk::FramebufferCreateInfo::default().render_pass(pass).attachments(&views).width(extent.width);
                unsafe { device.create_framebuffer(&info, None).unwrap() }
            })
            .collect::<Vec<_>>();
        Self { device, samples, color, depth, pass, framebuffers }
    }

    fn create_color(
        device: &ash::Device,
        properties: vk::PhysicalDeviceMemoryProperties,
        extent: vk::Extent2D,
        format: vk::Format,
        samples: vk::SampleCountFlags,
    ) -> Texture {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSIENT_ATTACHMENT;
        let (image, memory) = unsafe { create_image(device, properties, extent, format, samples, usage) }.unwrap();
        let view = unsafe { create_view(device, image, format, vk::ImageAspectFlags::COLOR) };
        Texture { image, memory, view }
    }

    fn create_depth(
        device: &ash::Device,
        properties: vk::PhysicalDeviceMemoryProperties,
        extent: vk::Extent2D,
        samples: vk::SampleCountFlags,
    ) -> Texture {
        let format = vk::Format::D32_SFLOAT;
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        let (image, memory) = unsafe { create_image(device, properties, extent, format, samples, usage).unwrap() }; // expect: MSAA401
        let view = unsafe { create_view(device, image, format, vk::ImageAspectFlags::DEPTH) };
        Texture { image, memory, view }
    }

    fn create_pass(device: &ash::Device, format: vk::Format, samples: vk::SampleCountFlags) -> vk::RenderPass {
        let color = vk::AttachmentDescription::default()
            .format(format)
            .samples(samples)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE) // expect: MSAA201 // may: MSAA403
            .initial_layout(vk::ImageLayout::UNDEFINED)
            .final_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL);
        let depth = vk::AttachmentDescription::default()
            .format(vk::Format::D32_SFLOAT)
            .samples(samples)
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::DONT_CARE)
            .stencil_store_op(vk::AttachmentStoreOp::DONT_CARE)
            .stencil_load_op(vk::AttachmentLoadOp::DONT_CARE)
            .final_layout(vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        let target = vk::AttachmentDescription::default()
            .format(format)
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::DONT_CARE)
            .store_op(vk::AttachmentStoreOp::STORE)
            .final_layout(vk::ImageLayout::PRESENT_SRC_KHR);
        let attachments = [color, depth, target];
        let colors = [vk::AttachmentReference::default().attachment(0).layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let depths = vk::AttachmentReference::default().attachment(1).layout(vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        let targets = [vk::AttachmentReference::default().attachment(2).layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
        let subpass = vk::SubpassDescription::default()
            .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
            .color_attachments(&colors)
            .resolve_attachments(&targets)
            .depth_stencil_attachment(&depths);
        let info = vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(std::slice::from_ref(&subpass));
        unsafe { device.create_render_pass(&info, None).unwrap() }
    }
}
