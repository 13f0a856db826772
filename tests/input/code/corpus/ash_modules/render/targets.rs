use ash::vk;

pub struct Attachment {
    pub image: vk::Image,
    pub view: vk::ImageView,
}

pub struct Targets {
    pub color: Attachment,
    pub depth: Attachment,
    pub output: vk::ImageView,
    pub commands: vk::CommandBuffer,
}

impl Attachment {
    fn new(device: &ash::Device, format: vk::Format, samples: vk::SampleCountFlags, usage: vk::ImageUsageFlags) -> Self {
        let info = vk::ImageCreateInfo {
            image_type: vk::ImageType::TYPE_2D,
            format,
            samples,
            usage: usage | vk::ImageUsageFlags::TRANSIENT_ATTACHMENT,
            mip_levels: 1,
            array_layers: 1,
            ..Default::default()
        };
        let image = unsafe { device.create_image(&info, None) }.expect("an image");
        let view = vk::ImageViewCreateInfo::default().image(image).view_type(vk::ImageViewType::TYPE_2D).format(format);
        let view = unsafe { device.create_image_view(&view, None) }.expect("a view");
        Self { image, view }
    }
}

impl Targets {
    pub fn new(device: &ash::Device, samples: vk::SampleCountFlags) -> Self {
        let color = Attachment::new(device, vk::Format::R8G8B8A8_UNORM, samples, vk::ImageUsageFlags::COLOR_ATTACHMENT);
        let depth = Attachment::new(device, vk::Format::D32_SFLOAT, samples, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT);
        Self { color, depth, output: vk::ImageView::null(), commands: vk::CommandBuffer::null() }
    }
}
