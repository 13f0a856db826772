#pragma once

#include <vulkan/vulkan.h>

#include "graphics_types.h"

class RenderPassVk {
public:
    RenderPassVk(VkDevice Device, const RenderPassDesc& Desc);

private:
    VkRenderPass m_RenderPass = VK_NULL_HANDLE;
};
