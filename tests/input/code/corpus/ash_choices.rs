// How Rust programs choose a sample count: the minimum of masks, the highest count, and a search of a list.
use ash::vk;

const DESCENDING: [vk::SampleCountFlags; 4] = [
    vk::SampleCountFlags::TYPE_16,
    vk::SampleCountFlags::TYPE_8,
    vk::SampleCountFlags::TYPE_4,
    vk::SampleCountFlags::TYPE_2,
];

pub struct Adapter {
    limits: vk::PhysicalDeviceLimits,
    samples: vk::SampleCountFlags,
}

impl Adapter {
    pub fn highest(&self) -> vk::SampleCountFlags { // expect: MSAA851
        let color = self.limits.framebuffer_color_sample_counts;
        let depth = self.limits.framebuffer_depth_sample_counts;
        let both = color.min(depth); // expect: MSAA852
        if both.contains(vk::SampleCountFlags::TYPE_16) {
            vk::SampleCountFlags::TYPE_16
        } else if both.contains(vk::SampleCountFlags::TYPE_8) {
            vk::SampleCountFlags::TYPE_8
        } else if both.contains(vk::SampleCountFlags::TYPE_4) {
            vk::SampleCountFlags::TYPE_4
        } else {
            vk::SampleCountFlags::TYPE_1
        }
    }

    pub fn listed(&mut self) {
        let counts = self.limits.framebuffer_color_sample_counts & self.limits.framebuffer_depth_sample_counts;
        self.samples = DESCENDING.iter().copied().find(|&count| counts.contains(count)).unwrap_or(vk::SampleCountFlags::TYPE_1); // expect: MSAA851
    }

    pub fn repeated(&self) -> u32 {
        let counts = self.limits.framebuffer_color_sample_counts;
        if counts.contains(vk::SampleCountFlags::TYPE_4) {
            return vk::SampleCountFlags::TYPE_4.as_raw();
        }
        if counts.contains(vk::SampleCountFlags::TYPE_4) { // expect: MSAA853
            return vk::SampleCountFlags::TYPE_2.as_raw();
        }
        1
    }
}
