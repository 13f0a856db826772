"""What the benchmarks lint: descriptions of 1.3 KB, and pipeline JSON as the Vulkan SC tools write
it.
"""

from __future__ import annotations

import json
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

DESCRIPTION = """\
# A forward pass at 4x, resolved in the pass; depth stays on the tile.
frame: {width: 1920, height: 1080, fps: 60}
images:
  color_ms:
    format: R8G8B8A8_UNORM
    samples: 4
    usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]
    memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]
  depth_ms:
    format: D32_SFLOAT
    samples: 4
    usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]
    memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]
  color:
    format: R8G8B8A8_UNORM
    samples: 1
    usage: [COLOR_ATTACHMENT]
    presentable: true
renderPasses:
  forward:
    attachments:
      color_ms:
        image: color_ms
        loadOp: CLEAR
        storeOp: STORE
        initialLayout: UNDEFINED
        finalLayout: COLOR_ATTACHMENT_OPTIMAL
      depth_ms:
        image: depth_ms
        loadOp: CLEAR
        storeOp: DONT_CARE
        initialLayout: UNDEFINED
        finalLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL
      color:
        image: color
        loadOp: DONT_CARE
        storeOp: STORE
        initialLayout: UNDEFINED
        finalLayout: PRESENT_SRC_KHR
    subpasses:
      - colorAttachments: [color_ms]
        depthStencilAttachment: depth_ms
        resolveAttachments: [color]
pipelines:
  opaque: {renderPass: forward, subpass: 0, multisampleState: {rasterizationSamples: 4}}
"""

PIPELINES = 129
PIPELINE_BYTES = 35_424
"""Of each: what the Khronos tools' own test data has on average."""


def descriptions(folder: str, count: int) -> str:
    """That many descriptions, each of its own; the folder they are in."""
    made = os.path.join(folder, f"descriptions-{count}")
    os.makedirs(made)
    for number in range(count):
        with open(os.path.join(made, f"pass{number:04}.msaa.yaml"), "w", encoding="utf-8") as file:
            file.write(DESCRIPTION.replace("forward", f"forward_{number:04}"))
    return made


def pipelines(folder: str) -> tuple[str, str]:
    """The folder of Vulkan SC pipeline files, and where they are from: the samples, or made here in
    the same number and size.
    """
    samples = os.environ.get("MSAA_LINT_SAMPLES") or os.path.join(ROOT, "..", "shared", "samples")
    real = os.path.join(samples, "vulkan_sc")
    if os.path.isdir(real):
        return real, "the Khronos tools' test data"
    made = os.path.join(folder, "pipelines")
    os.makedirs(made)
    for number in range(PIPELINES):
        with open(os.path.join(made, f"pipeline{number:03}.json"), "w", encoding="utf-8") as file:
            file.write(pipeline(number))
    return made, "made by the benchmark"


def pipeline(number: int) -> str:
    """A pipeline with a render pass of one attachment, filled up with the vertex attributes that
    such files mostly consist of.
    """
    attachment = {
        "flags": "0", "format": "VK_FORMAT_R8G8B8A8_UNORM",
        "samples": f"VK_SAMPLE_COUNT_{1 << number % 3}_BIT",
        "loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR", "storeOp": "VK_ATTACHMENT_STORE_OP_STORE",
        "stencilLoadOp": "VK_ATTACHMENT_LOAD_OP_DONT_CARE",
        "stencilStoreOp": "VK_ATTACHMENT_STORE_OP_DONT_CARE",
        "initialLayout": "VK_IMAGE_LAYOUT_UNDEFINED",
        "finalLayout": "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL",
    }  # fmt: skip
    subpass = {
        "flags": "0", "pipelineBindPoint": "VK_PIPELINE_BIND_POINT_GRAPHICS",
        "colorAttachmentCount": 1,
        "pColorAttachments": [{"attachment": 0,
        "layout": "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL"}], "pResolveAttachments": "NULL",
    }  # fmt: skip
    attributes: list[dict[str, object]] = []
    state = {
        "Renderpass": {
            "sType": "VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO", "pNext": "NULL",
            "attachmentCount": 1, "pAttachments": [attachment],
            "subpassCount": 1, "pSubpasses": [subpass], "dependencyCount": 0,
            "pDependencies": "NULL",
        },
        "GraphicsPipeline": {
            "sType": "VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO", "pNext": "NULL",
            "pVertexInputState": {"pVertexAttributeDescriptions": attributes},
            "pMultisampleState": {
                "rasterizationSamples": attachment["samples"], "sampleShadingEnable": "VK_FALSE",
                "minSampleShading": 0.0,
                "alphaToCoverageEnable": "VK_FALSE", "alphaToOneEnable": "VK_FALSE",
            },
            "renderPass": 1, "subpass": 0,
        },
    }  # fmt: skip
    while len(text := json.dumps({"GraphicsPipelineState": state}, indent=4)) < PIPELINE_BYTES:
        one = {
            "location": len(attributes),
            "binding": 0,
            "format": "VK_FORMAT_R32G32B32A32_SFLOAT",
            "offset": 16 * len(attributes),
        }
        attributes += [one] * max((PIPELINE_BYTES - len(text)) // 200, 1)
    return text
