// Templates, concepts, requires, attributes, user literals: more than a grammar without types can follow. Nothing wrong.
#include <vulkan/vulkan.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#define GFX_API __attribute__((visibility("default")))
#define GFX_FORCEINLINE inline __attribute__((always_inline))
#define GFX_DECLARE_HANDLE(name) \
    struct name##_T;             \
    using name = name##_T*
#define GFX_FOR_EACH_FORMAT(X) X(RGBA8, VK_FORMAT_R8G8B8A8_UNORM) X(RGBA16F, VK_FORMAT_R16G16B16A16_SFLOAT) X(D32, VK_FORMAT_D32_SFLOAT)

namespace gfx {

GFX_DECLARE_HANDLE(Texture);

enum class Format {
#define X(name, vk) name,
    GFX_FOR_EACH_FORMAT(X)
#undef X
};

constexpr VkFormat toVk(Format format) {
    switch (format) {
#define X(name, vk) \
    case Format::name: return vk;
        GFX_FOR_EACH_FORMAT(X)
#undef X
    }
    return VK_FORMAT_UNDEFINED;
}

template <unsigned N>
concept SampleCount = N >= 1 && N <= 64 && (N & (N - 1)) == 0;

template <typename T, VkStructureType Type>
struct Chained : T {
    constexpr Chained() : T{} { this->sType = Type; }
    template <typename Next>
        requires requires(Next& n) { n.sType; }
    GFX_FORCEINLINE Chained& with(Next& next) & noexcept {
        this->pNext = &next;
        return *this;
    }
};

using ImageInfo = Chained<VkImageCreateInfo, VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO>;

template <unsigned N>
    requires SampleCount<N>
struct Samples : std::integral_constant<VkSampleCountFlagBits, static_cast<VkSampleCountFlagBits>(N)> {};

consteval unsigned operator""_spp(unsigned long long n) { return static_cast<unsigned>(n); }

template <Format F, unsigned N = 1_spp, VkImageUsageFlags Extra = 0>
struct Target {
    static constexpr bool multisampled = N > 1;
    static constexpr bool isDepth = F == Format::D32;
    static constexpr VkImageUsageFlags usage = (isDepth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT) |
                                               (multisampled ? VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT : VK_IMAGE_USAGE_SAMPLED_BIT) | Extra;

    [[nodiscard]] static constexpr VkAttachmentDescription description() {
        return {
            .format = toVk(F),
            .samples = Samples<N>::value,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = multisampled ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE,
            .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED,
            .finalLayout = VK_IMAGE_LAYOUT_GENERAL,
        };
    }

    GFX_API static VkImage create(VkDevice device, VkExtent2D size) {
        ImageInfo info;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = toVk(F);
        info.extent = {size.width, size.height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = Samples<N>::value;
        info.usage = usage;
        VkImage image{};
        vkCreateImage(device, &info, nullptr, &image);
        return image;
    }
};

template <typename... Targets>
class Pass {
public:
    static constexpr std::size_t count = sizeof...(Targets);
    static constexpr std::array<VkAttachmentDescription, count> descriptions{Targets::description()...};

    template <std::size_t... I>
    static std::array<VkImage, count> images(VkDevice device, VkExtent2D size, std::index_sequence<I...>) {
        return {std::tuple_element_t<I, std::tuple<Targets...>>::create(device, size)...};
    }

    template <typename F>
        requires std::invocable<F&, VkAttachmentDescription>
    static void each(F&& f) {
        (f(Targets::description()), ...);
    }
};

using Forward = Pass<Target<Format::RGBA8, 4_spp>, Target<Format::D32, 4_spp>, Target<Format::RGBA8>>;

GFX_API auto makeForward(VkDevice device, VkExtent2D size) -> std::array<VkImage, Forward::count> {
    std::size_t resolved = 0;
    Forward::each([&resolved]<typename D>(const D& d) { resolved += d.samples == VK_SAMPLE_COUNT_1_BIT; });
    return resolved == 1 ? Forward::images(device, size, std::make_index_sequence<Forward::count>{}) : decltype(Forward::images(
                                                                                                            device, size, std::make_index_sequence<Forward::count>{})){};
}

}  // namespace gfx
