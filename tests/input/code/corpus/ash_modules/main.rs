// A program of three modules: what a texture creates, and where a frame draws to it.
mod render;

fn main() {
    let device = open_device();
    let targets = render::targets::Targets::new(&device, ash::vk::SampleCountFlags::TYPE_4);
    render::draw(&device, &targets);
}
