// Choices of a sample count without a mistake: four at most, what the user wants, and masks that are combined with &.
use ash::vk;

pub struct Adapter {
    limits: vk::PhysicalDeviceLimits,
    wanted: vk::SampleCountFlags,
}

impl Adapter {
    pub fn preferred(&self) -> vk::SampleCountFlags {
        let counts = self.limits.framebuffer_color_sample_counts & self.limits.framebuffer_depth_sample_counts;
        [vk::SampleCountFlags::TYPE_4, vk::SampleCountFlags::TYPE_2]
            .into_iter()
            .find(|&count| counts.contains(count))
            .unwrap_or(vk::SampleCountFlags::TYPE_1)
    }

    pub fn of_the_user(&self) -> vk::SampleCountFlags {
        let counts = self.limits.framebuffer_color_sample_counts;
        let candidates = [vk::SampleCountFlags::TYPE_8, vk::SampleCountFlags::TYPE_4, vk::SampleCountFlags::TYPE_2];
        for count in candidates {
            if count <= self.wanted && counts.contains(count) {
                return count;
            }
        }
        vk::SampleCountFlags::TYPE_1
    }

    pub fn at_most(&self) -> vk::SampleCountFlags {
        let counts = self.limits.framebuffer_color_sample_counts;
        let highest = if counts.contains(vk::SampleCountFlags::TYPE_8) {
            vk::SampleCountFlags::TYPE_8
        } else {
            vk::SampleCountFlags::TYPE_4
        };
        highest.min(self.wanted)
    }

    pub fn supports(&self, count: vk::SampleCountFlags) -> bool {
        self.limits.framebuffer_color_sample_counts.contains(count)
    }
}
