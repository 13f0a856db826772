"""Programs as calls in normal form, by hypothesis and by hand."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

FORMATS = (
    "VK_FORMAT_R8G8B8A8_UNORM",
    "VK_FORMAT_R16G16B16A16_SFLOAT",
    "VK_FORMAT_D32_SFLOAT",
    "VK_FORMAT_D24_UNORM_S8_UINT",
)
LAYOUTS = (
    "VK_IMAGE_LAYOUT_UNDEFINED",
    "VK_IMAGE_LAYOUT_GENERAL",
    "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL",
)

handles = st.integers(1, (1 << 63) - 1)
small = st.integers(0, 0xFFFFFFFF)
samples = st.sampled_from([f"VK_SAMPLE_COUNT_{count}_BIT" for count in (1, 2, 4, 8, 16)])
loads = st.sampled_from(
    ("VK_ATTACHMENT_LOAD_OP_LOAD", "VK_ATTACHMENT_LOAD_OP_CLEAR", "VK_ATTACHMENT_LOAD_OP_DONT_CARE")
)
stores = st.sampled_from(("VK_ATTACHMENT_STORE_OP_STORE", "VK_ATTACHMENT_STORE_OP_DONT_CARE"))
layouts = st.sampled_from(LAYOUTS)
texts = st.text(st.characters(exclude_categories=("Cs",)), max_size=20)

images = st.fixed_dictionaries({
    "sType": st.just("VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO"),
    "pNext": st.none(),
    "flags": st.integers(0, 255),
    "format": st.sampled_from(FORMATS),
    "extent": st.fixed_dictionaries({"width": small, "height": small, "depth": st.just(1)}),
    "samples": samples,
    "usage": st.integers(0, 255),
    "initialLayout": layouts,
})  # fmt: skip
attachments = st.fixed_dictionaries({
    "flags": st.integers(0, 1), "format": st.sampled_from(FORMATS), "samples": samples,
    "loadOp": loads, "storeOp": stores,
    "stencilLoadOp": loads, "stencilStoreOp": stores, "initialLayout": layouts,
    "finalLayout": layouts,
})  # fmt: skip
references = st.fixed_dictionaries(
    {"attachment": st.sampled_from((0, 1, 2, 0xFFFFFFFF)), "layout": layouts}
)
chains = st.none() | st.fixed_dictionaries({
    "sType": st.just("VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE"),
    "pNext": st.none(),
    "depthResolveMode": st.sampled_from(("VK_RESOLVE_MODE_NONE", "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT",
    "VK_RESOLVE_MODE_AVERAGE_BIT")),
    "stencilResolveMode": st.just("VK_RESOLVE_MODE_SAMPLE_ZERO_BIT"),
    "pDepthStencilResolveAttachment": st.none() | references,
})  # fmt: skip
subpasses = st.fixed_dictionaries({
    "pNext": chains,
    "colorAttachmentCount": st.just(1),
    "pColorAttachments": st.lists(references, min_size=1, max_size=3),
    "pResolveAttachments": st.none() | st.lists(references, min_size=1, max_size=3),
    "pDepthStencilAttachment": st.none() | references,
})  # fmt: skip
passes = st.fixed_dictionaries({
    "flags": st.just(0), "pAttachments": st.lists(attachments, min_size=1, max_size=3),
    "pSubpasses": st.lists(subpasses, min_size=1, max_size=2), "pDependencies": st.none(),
})  # fmt: skip
multisampling = st.fixed_dictionaries({
    "rasterizationSamples": samples, "sampleShadingEnable": st.booleans(),
    "minSampleShading": st.sampled_from((0.0, 0.25, 1.0)),
    "pSampleMask": st.none() | st.lists(small, min_size=1, max_size=2),
    "alphaToCoverageEnable": st.booleans(),
})  # fmt: skip
pipelines = st.fixed_dictionaries({
    "pMultisampleState": st.none() | multisampling, "renderPass": st.just(0) | handles,
    "subpass": st.integers(0, 3),
})  # fmt: skip
targets = st.fixed_dictionaries({
    "imageView": st.just(0) | handles, "resolveMode": st.sampled_from(("VK_RESOLVE_MODE_NONE",
    "VK_RESOLVE_MODE_AVERAGE_BIT")),
    "resolveImageView": st.just(0) | handles, "loadOp": loads, "storeOp": stores,
})  # fmt: skip


def call(
    name: str, **arguments: st.SearchStrategy[Any]
) -> st.SearchStrategy[tuple[str, dict[str, Any]]]:
    """Calls of one function."""
    return st.tuples(st.just(name), st.fixed_dictionaries(arguments))


calls = st.one_of(
    call("vkCreateImage", device=handles, pCreateInfo=images, pAllocator=st.none(), pImage=handles),
    call("vkCreateRenderPass", device=handles, pCreateInfo=passes, pAllocator=st.none(),
    pRenderPass=handles),
    call("vkCreateGraphicsPipelines", device=handles, pipelineCache=st.just(0),
    pCreateInfos=st.lists(pipelines, min_size=1, max_size=2),
         pPipelines=st.lists(handles, min_size=1, max_size=2)),
    call("vkCmdBeginRenderingKHR", commandBuffer=handles, pRenderingInfo=st.fixed_dictionaries({
        "flags": st.just(0), "pColorAttachments": st.lists(targets, max_size=2),
        "pDepthAttachment": st.none() | targets})),
    call("vkCmdDraw", commandBuffer=handles, vertexCount=small, instanceCount=st.just(1)),
    call("vkSetDebugUtilsObjectNameEXT", device=handles,
    pNameInfo=st.fixed_dictionaries({"objectHandle": handles, "pObjectName": texts})),
    call("vkGetPhysicalDeviceProperties", physicalDevice=handles,
    pProperties=st.fixed_dictionaries({
        "limits": st.fixed_dictionaries({"framebufferColorSampleCounts": st.integers(1, 127)})})),
)  # fmt: skip
programs = st.lists(calls, min_size=1, max_size=8)

WANTED = frozenset({
    "vkCreateImage", "vkCreateRenderPass", "vkCreateGraphicsPipelines", "vkCreateShaderModule",
    "vkCmdBeginRendering", "vkCmdDraw",
    "vkSetDebugUtilsObjectName", "vkGetPhysicalDeviceProperties", "vkQueuePresent",
})  # fmt: skip

SMALL: list[tuple[str, dict[str, Any]]] = [
    (
        "vkCreateImage",
        {
            "device": 3,
            "pCreateInfo": {"samples": "VK_SAMPLE_COUNT_4_BIT", "usage": 17, "flags": 0},
            "pImage": 10,
        },
    ),
    ("vkDeviceWaitIdle", {"device": 3}),
    (
        "vkSetDebugUtilsObjectNameEXT",
        {"device": 3, "pNameInfo": {"objectHandle": 10, "pObjectName": 'a "b" {[\\'}},
    ),
    ("vkCmdDraw", {"commandBuffer": 7, "vertexCount": 3, "instanceCount": 1}),
    ("vkCmdDraw", {"commandBuffer": 7, "vertexCount": 3, "instanceCount": 1}),
    ("vkQueuePresentKHR", {"queue": 4, "pPresentInfo": {"pNext": None, "pImageIndices": [0]}}),
]
"""A small program; one of its calls nobody follows."""
