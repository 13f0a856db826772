"""Generates C++ of any length for measurements: the modules of an application, half of which use
Vulkan.
"""

from __future__ import annotations

MODULE = """\
namespace module{n} {{

struct Vertex{n} {{
    float position[3];
    float normal[3];
    float texture[2];
}};

struct Settings{n} {{
    unsigned width = {width};
    unsigned height = {height};
    bool vsync = true;
    float exposure = 1.0f + {n} * 0.01f;
}};

template <typename T>
T mix(const T& a, const T& b, float t) {{
    return a * (1.0f - t) + b * t;
}}

inline std::string trimmed(const std::string& text) {{
    const auto first = text.find_first_not_of(" \\t");
    if (first == std::string::npos) return {{}};
    return text.substr(first, text.find_last_not_of(" \\t") - first + 1);
}}

inline std::map<std::string, float> parse(const std::vector<std::string>& lines) {{
    std::map<std::string, float> values;
    for (const auto& line : lines) {{
        const auto middle = line.find('=');
        if (middle == std::string::npos || line.empty() || line[0] == '#') continue;
        values[trimmed(line.substr(0, middle))] = static_cast<float>(std::atof(line.c_str() + middle + 1));
    }}
    return values;
}}

class Renderer{n} {{
public:
    explicit Renderer{n}(VkDevice device, const Settings{n}& settings) : device_(device), settings_(settings) {{
        createImages();
        createRenderPass();
        createPipeline();
    }}

private:
    VkImage createImage(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage) {{
        VkImageCreateInfo info{{}};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {{settings_.width, settings_.height, 1}};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = samples;
        info.usage = usage;
        VkImage image{{}};
        if (vkCreateImage(device_, &info, nullptr, &image) != VK_SUCCESS) throw std::runtime_error("image {n}");
        return image;
    }}

    void createImages() {{
        color_ = createImage(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_4_BIT,
                             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT);
        depth_ = createImage(VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT,
                             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT);
        for (unsigned i = 0; i < 3; i++)
            textures_.push_back(createImage(VK_FORMAT_R8G8B8A8_SRGB, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_USAGE_SAMPLED_BIT));
    }}

    void createRenderPass() {{
        std::array<VkAttachmentDescription, 3> attachments{{}};
        attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
        attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
        attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_{store};
        attachments[0].finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        attachments[1].format = VK_FORMAT_D32_SFLOAT;
        attachments[1].samples = VK_SAMPLE_COUNT_4_BIT;
        attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
        attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
        attachments[1].finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        attachments[2].format = VK_FORMAT_R8G8B8A8_UNORM;
        attachments[2].samples = VK_SAMPLE_COUNT_1_BIT;
        attachments[2].loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        attachments[2].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        attachments[2].finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        VkAttachmentReference color{{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
        VkAttachmentReference depth{{1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL}};
        VkAttachmentReference resolve{{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
        VkSubpassDescription subpass{{}};
        subpass.colorAttachmentCount = 1;
        subpass.pColorAttachments = &color;
        subpass.pResolveAttachments = &resolve;
        subpass.pDepthStencilAttachment = &depth;
        VkRenderPassCreateInfo info{{}};
        info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
        info.attachmentCount = static_cast<uint32_t>(attachments.size());
        info.pAttachments = attachments.data();
        info.subpassCount = 1;
        info.pSubpasses = &subpass;
        vkCreateRenderPass(device_, &info, nullptr, &renderPass_);
    }}

    void createPipeline() {{
        VkPipelineMultisampleStateCreateInfo multisample{{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO}};
        multisample.rasterizationSamples = VK_SAMPLE_COUNT_4_BIT;
        VkGraphicsPipelineCreateInfo info{{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO}};
        info.pMultisampleState = &multisample;
        info.renderPass = renderPass_;
        vkCreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
    }}

    float animate(float seconds) {{
        float sum = 0.0f;
        for (int i = 0; i < {n} + 3; i++) {{
            const float phase = seconds * (0.5f + 0.1f * static_cast<float>(i));
            if (phase > 1.0f) {{
                sum += mix(std::sin(phase), std::cos(phase), settings_.exposure);
            }} else {{
                sum -= phase * phase;
            }}
        }}
        return sum;
    }}

    VkDevice device_{{}};
    Settings{n} settings_;
    VkImage color_{{}}, depth_{{}};
    std::vector<VkImage> textures_;
    VkRenderPass renderPass_{{}};
    VkPipeline pipeline_{{}};
}};

}}  // namespace module{n}

"""

HEAD = """\
#include <vulkan/vulkan.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

"""


def program(lines: int, wrong: int = 3) -> tuple[str, list[int]]:
    """Returns C++ of at least a number of lines, and the lines of the multisampled attachments that
    are stored but unused, in every third module.
    """
    parts, places = [HEAD], []
    count = HEAD.count("\n")
    while count < lines:
        number = len(parts)
        store = "DONT_CARE" if number % wrong else "STORE"
        text = MODULE.format(n=number, width=1280 + number, height=720 + number, store=store)
        if store == "STORE":
            places.append(
                count + text[: text.index("storeOp = VK_ATTACHMENT_STORE_OP_STORE")].count("\n") + 1
            )
        parts.append(text)
        count += text.count("\n")
    return "".join(parts), places
