// Café: größte Auflösung, 多重采样, Ω – Kommentare in vielen Schriften, Zeilen enden mit CR LF. ✂
#include <vulkan/vulkan.h>

#include <cstdio>

/* Die Struktur „Ziel“: ein Bild und seine Ansicht. 画像とビュー */
struct Ziel {
    VkImage bild = VK_NULL_HANDLE;
    VkImageView ansicht = VK_NULL_HANDLE;
};

static const char *titel = "Überblick — 四重采样 😀";

VkRenderPass passErzeugen(VkDevice gerät, VkFormat format) {
    std::printf("%s\n", titel);
    VkAttachmentDescription farbe = {}; /* 颜色 */
    farbe.format = format;
    farbe.samples = VK_SAMPLE_COUNT_4_BIT;  // vier Proben je Pixel ✓
    farbe.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    /* größer 😀 */ farbe.storeOp = VK_ATTACHMENT_STORE_OP_STORE;  // überflüssig  // expect: MSAA201
    farbe.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    farbe.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    farbe.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    farbe.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

    VkAttachmentDescription auflösung = farbe;  // 解析目标
    auflösung.samples = VK_SAMPLE_COUNT_1_BIT;
    auflösung.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    auflösung.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    auflösung.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;

    VkAttachmentReference verweise[] = {
        {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},  // “Farbe”
        {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},  // “Auflösung”
    };
    VkSubpassDescription teil = {};
    teil.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    teil.colorAttachmentCount = 1;
    teil.pColorAttachments = &verweise[0];
    teil.pResolveAttachments = &verweise[1];

    const VkAttachmentDescription beide[] = {farbe, auflösung};
    VkRenderPassCreateInfo angaben = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    angaben.attachmentCount = 2;
    angaben.pAttachments = beide;
    angaben.subpassCount = 1;
    angaben.pSubpasses = &teil;
    VkRenderPass pass = VK_NULL_HANDLE;
    vkCreateRenderPass(gerät, &angaben, nullptr, &pass);
    return pass;
}

Ziel zielErzeugen(VkDevice gerät, VkExtent2D größe) {
    Ziel ziel;
    VkImageCreateInfo angaben = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    angaben.imageType = VK_IMAGE_TYPE_2D;
    angaben.format = VK_FORMAT_R8G8B8A8_UNORM;
    angaben.extent = {größe.width, größe.height, 1};
    angaben.mipLevels = 1;
    angaben.arrayLayers = 1;
    angaben.samples = VK_SAMPLE_COUNT_4_BIT;
    angaben.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    angaben.tiling = VK_IMAGE_TILING_LINEAR; /* ✗ */  // expect: MSAA106
    vkCreateImage(gerät, &angaben, nullptr, &ziel.bild);
    return ziel;
}
