// A menu offers modes of antialiasing: the count is that of the mode that is selected, none of which is certain.
#include <vulkan/vulkan.h>

bool selectable(const char* name, bool selected);

enum Mode : uint32_t { MODE_NONE, MODE_4X, MODE_8X, MODE_COUNT };

struct Settings {
    uint32_t mode = MODE_NONE;
    int samples = 1;

    void update() {
        switch (mode) {
        case MODE_NONE:
            samples = 1;
            break;
        case MODE_4X:
            samples = 4;
            break;
        case MODE_8X:
            samples = 8;
            break;
        default:
            break;
        }
    }
};

class Application {
public:
    void menu() {
        const char* names[MODE_COUNT] = {"none", "msaa 4x", "msaa 8x"};
        for (uint32_t mode = 0; mode < MODE_COUNT; mode++) {
            if (selectable(names[mode], settings_.mode == mode)) {
                settings_.mode = mode;
            }
        }
    }

    void frame() {
        settings_.update();
        format_ = swapchain_format_;
    }

    void connect() { swapchain_format_ = VK_FORMAT_R8G8B8A8_UNORM; }

    void create(VkDevice device) {
        VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format_;
        info.extent = {1280, 720, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = static_cast<VkSampleCountFlagBits>(settings_.samples);
        info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
        vkCreateImage(device, &info, nullptr, &image_);
    }

private:
    Settings settings_;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkFormat swapchain_format_ = VK_FORMAT_UNDEFINED;
    VkImage image_ = VK_NULL_HANDLE;
};
