"""The features that source code and pipeline JSON enable: what is not stated there is not enabled,
what is not read is not known.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

PROGRAM = """#include <vulkan/vulkan.h>
void run(VkPhysicalDevice gpu, VkBaseInStructure *more) {{
    VkPhysicalDeviceFeatures2 features = {{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2}};
    {features}
    VkDeviceCreateInfo info = {{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO}};
    info.pNext = &features;
    VkDevice device;
    vkCreateDevice(gpu, &info, nullptr, &device);
    VkImageCreateInfo image = {{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO}};
    image.format = VK_FORMAT_R8G8B8A8_UNORM;
    image.samples = VK_SAMPLE_COUNT_4_BIT;
    image.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    VkImage ms;
    vkCreateImage(device, &image, nullptr, &ms);
}}
"""


@pytest.mark.parametrize(
    ("features", "found"),
    [
        ("features.features.sampleRateShading = VK_TRUE;", True),
        ("features.features.shaderStorageImageMultisample = VK_TRUE;", False),
        (
            "features.features.sampleRateShading = VK_TRUE; "
            "features.features.shaderStorageImageMultisample = VK_TRUE;",
            False,
        ),
        # What is chained by somebody else may be anything.
        ("features.pNext = more;", False),
        ("vkGetPhysicalDeviceFeatures2(gpu, &features);", False),
    ],
)
def test_a_feature_of_source_code(tmp_path: Path, features: str, found: bool) -> None:
    (tmp_path / "main.cpp").write_text(PROGRAM.format(features=features))
    findings = json.loads(run(tmp_path, "check", "main.cpp", "--output", "json").stdout)["findings"]
    assert ("MSAA513" in [each["code"] for each in findings]) == found
