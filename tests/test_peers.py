"""The Khronos validation layer's best-practices checks on multisampling, by their ids.

Where its trigger holds ours fires too; where it is known to be wrong, or does not look, ours is
right.
"""

from __future__ import annotations

import pytest

from msaa_lint import lint

PASS = """
images:
  ms: {{format: R8G8B8A8_UNORM, samples: {samples}, usage: [{usage}]{more}}}
  out: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}}
renderPasses:
  main:
    attachments:
      color: {{image: ms, loadOp: {load}, storeOp: {store}, initialLayout: COLOR_ATTACHMENT_OPTIMAL}}
      output: {{image: out, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED}}
    subpasses:
      - {{colorAttachments: [color], resolveAttachments: [output]}}
"""

RENDERING = """
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 4}}
  depth: {{format: D24_UNORM_S8_UINT, samples: 4}}
  out: {{format: R8G8B8A8_UNORM, samples: 1}}
commands:
  - beginRendering:
      colorAttachments: [{{image: ms, loadOp: {load}, storeOp: {store}, resolveMode: {mode}, resolveImage: out}}]
      depthAttachment: {{image: depth, loadOp: {load}, storeOp: {store}}}
      stencilAttachment: {{image: depth, loadOp: {load}, storeOp: {store}}}
  - endRendering
"""


def color(
    samples: int = 4,
    usage: str = "COLOR_ATTACHMENT",
    more: str = "",
    load: str = "CLEAR",
    store: str = "DONT_CARE",
) -> str:
    return PASS.format(samples=samples, usage=usage, more=more, load=load, store=store)


def depth(format: str, ops: str, samples: int = 4) -> str:
    return f"""
images: {{ds: {{format: {format}, samples: {samples}, usage: [DEPTH_STENCIL_ATTACHMENT]}}}}
renderPasses:
  main:
    attachments:
      ds: {{image: ds, {ops}}}
    subpasses:
      - {{depthStencilAttachment: ds}}
"""


def blended(extra: str = "", format: str = "R16G16B16A16_SFLOAT") -> str:
    return f"""
device: mali-g76
pipelines:
  p:
    rendering: {{colorAttachmentFormats: [{format}]}}
    multisampleState: {{rasterizationSamples: 4, sampleShadingEnable: false}}
    colorBlendState: {{attachments: [{{blendEnable: true, colorWriteMask: [R, G, B, A]}}]}}
{extra}"""


TRANSIENT = "COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT"
LAZY_DEVICE = (
    "device: {name: phone, memoryTypes: [[DEVICE_LOCAL], [DEVICE_LOCAL, LAZILY_ALLOCATED]]}\n"
)
PLAIN_DEVICE = "device: {name: desktop, memoryTypes: [[DEVICE_LOCAL]]}\n"
OPS = (
    "loadOp: {}, storeOp: {}, stencilLoadOp: {}, stencilStoreOp: {}, initialLayout: "
    "DEPTH_STENCIL_ATTACHMENT_OPTIMAL"
)

FIRES = {
    "vkCreateImage-non-transient-ms-image": (color(), "multisampled-image-not-transient"),
    "Arm-vkCreateImage-too-large-sample-count": (color(samples=8), "sample-count-above-four"),
    "IMG-vkCreateImage-too-large-sample-count": (
        "device: {vendor: img}\n" + color(samples=8),
        "sample-count-above-four",
    ),
    "vkBindImageMemory-non-lazy-transient-image": (
        LAZY_DEVICE + color(usage=TRANSIENT, more=", memory: [DEVICE_LOCAL]"),
        "transient-not-lazily-allocated",
    ),
    "AMD-vkImage-AvoidConcurrentRenderTargets": (
        "device: {vendor: amd}\n" + color(more=", sharingMode: CONCURRENT"),
        "attachment-blocks-compression",
    ),
    "AMD-vkImage-DontUseMutableRenderTargets": (
        "device: {vendor: amd}\n" + color(more=", flags: [MUTABLE_FORMAT]"),
        "attachment-blocks-compression",
    ),
    "AMD-vkImage-DontUseStorageRenderTargets": (
        "device: {vendor: amd}\n" + color(usage="COLOR_ATTACHMENT, STORAGE"),
        "attachment-blocks-compression",
    ),
    "NVIDIA-CreateImage-TilingLinear": (
        "device: {vendor: nvidia}\n" + color(samples=1, more=", tiling: LINEAR"),
        "attachment-blocks-compression",
    ),
    "vkCreateRenderPass-image-requires-memory (colour STORE)": (
        color(store="STORE"),
        "multisampled-attachment-stored",
    ),
    "vkCreateRenderPass-image-requires-memory (colour LOAD)": (
        color(load="LOAD"),
        "multisampled-attachment-loaded",
    ),
    "vkCreateRenderPass-image-requires-memory (depth STORE)": (
        depth("D32_SFLOAT", "loadOp: CLEAR, storeOp: STORE"),
        "multisampled-depth-stored",
    ),
    "vkCreateRenderPass-image-requires-memory (stencil STORE)": (
        depth("D24_UNORM_S8_UINT", OPS.format("CLEAR", "DONT_CARE", "CLEAR", "STORE")),
        "multisampled-stencil-stored",
    ),
    "vkCreateRenderPass-image-requires-memory (stencil LOAD)": (
        depth("S8_UINT", OPS.format("DONT_CARE", "DONT_CARE", "LOAD", "DONT_CARE")),
        "multisampled-stencil-stored",
    ),
    "vkCreateRenderPass-attachment-color-depth": (
        depth("D32_SFLOAT", "loadOp: LOAD, storeOp: DONT_CARE, initialLayout: UNDEFINED"),
        "load-from-undefined",
    ),
    "vkCreateRenderPass-attachment-stencil": (
        depth(
            "D24_UNORM_S8_UINT",
            "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: LOAD, initialLayout: UNDEFINED",
        ),
        "load-from-undefined",
    ),
    "vkCreateFramebuffer-attachment-should-not-be-transient": (
        color(usage=TRANSIENT, store="STORE"),
        "transient-needs-memory",
    ),
    "vkCreateFramebuffer-attachment-should-be-transient": (
        LAZY_DEVICE + color(),
        "multisampled-image-not-transient",
    ),
    "vkCmdBeginRenderPass-attachment-needs-readback (multisampled)": (
        color(load="LOAD"),
        "multisampled-attachment-loaded",
    ),
    "vkCmdBeginRenderPass-attachment-needs-readback (single-sampled)": (
        depth(
            "D32_SFLOAT",
            "loadOp: LOAD, storeOp: STORE, initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
            samples=1,
        ),
        "framebuffer-readback",
    ),
    "vkCmdBeginRenderPass-attachment-needs-readback (resolve target)": (
        color()
        .replace("{image: out, loadOp: DONT_CARE", "{image: out, loadOp: LOAD")
        .replace("UNDEFINED", "COLOR_ATTACHMENT_OPTIMAL"),
        "resolve-target-loaded",
    ),
    "VkRenderingInfo-ResolveModeNone": (
        RENDERING.format(load="CLEAR", store="STORE", mode="NONE"),
        "resolve-mode-none",
    ),
    "Arm-vkCmdResolveImage-resolving-image": (
        """
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  out: {format: R8G8B8A8_UNORM, samples: 1}
commands:
  - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering
  - resolveImage: {srcImage: ms, dstImage: out}
""",
        "resolve-outside-pass",
    ),
    "Arm-vkCreatePipelines-multisampled-blending": (blended(), "multisampled-float-blending"),
}


def rules(text: str) -> set[str]:
    result = lint(text=text, isolated=True)
    assert not [finding for finding in result.findings if finding.fatal]
    return {finding.rule for finding in result.findings}


@pytest.mark.parametrize("peer", FIRES)
def test_ours_fires_where_the_trigger_of(peer: str) -> None:
    text, rule = FIRES[peer]
    assert rule in rules(text)


def test_requires_memory_holds_for_dynamic_rendering_where_the_layer_does_not_look() -> None:
    found = rules(RENDERING.format(load="LOAD", store="STORE", mode="AVERAGE"))
    # The pass loads in the next frame what it stored: the load is what there is to say.
    assert {"multisampled-attachment-loaded", "multisampled-stencil-stored"} <= found
    found = rules(RENDERING.format(load="CLEAR", store="STORE", mode="AVERAGE"))
    assert {
        "multisampled-attachment-stored",
        "multisampled-depth-stored",
        "multisampled-stencil-stored",
    } <= found


def test_requires_memory_passes_for_none_operations() -> None:
    assert not rules(color(store="NONE")) & {"multisampled-attachment-stored"}


def test_requires_memory_looks_at_attachments_that_nothing_uses_and_ours_does_not() -> None:
    text = (
        "renderPasses: {main: {attachments: [{format: R8G8B8A8_UNORM, samples: 4, loadOp: LOAD, "
        "storeOp: STORE}], subpasses: [{}]}}"
    )
    assert not rules(text) & {"multisampled-attachment-stored", "multisampled-attachment-loaded"}


def test_requires_memory_takes_load_op_of_a_stencil_only_format_for_something_and_ours_does_not() -> (
    None
):
    found = rules(depth("S8_UINT", OPS.format("LOAD", "STORE", "CLEAR", "DONT_CARE")))
    assert not found & {
        "multisampled-attachment-loaded",
        "multisampled-depth-stored",
        "multisampled-stencil-stored",
    }


def test_aspects_are_judged_apart_where_the_layer_takes_them_together() -> None:
    found = rules(depth("D24_UNORM_S8_UINT", OPS.format("CLEAR", "DONT_CARE", "CLEAR", "STORE")))
    assert "multisampled-stencil-stored" in found
    assert "multisampled-depth-stored" not in found


def test_non_transient_ms_image_does_not_excuse_sampled_images_and_ours_does() -> None:
    """VUID-VkImageCreateInfo-usage-00963 forbids TRANSIENT_ATTACHMENT beside SAMPLED."""
    assert "multisampled-image-not-transient" not in rules(color(usage="COLOR_ATTACHMENT, SAMPLED"))


def test_non_transient_ms_image_is_a_note_on_a_device_without_lazily_allocated_memory() -> None:
    result = lint(text=PLAIN_DEVICE + color(), isolated=True)
    assert [
        f.severity for f in result.findings if f.rule == "multisampled-image-not-transient"
    ] == ["note"]


def test_non_lazy_transient_image_is_silent_on_a_device_without_lazily_allocated_memory() -> None:
    assert "transient-not-lazily-allocated" not in rules(
        PLAIN_DEVICE + color(usage=TRANSIENT, more=", memory: [DEVICE_LOCAL]")
    )


def test_should_be_transient_decides_by_one_framebuffer_and_ours_by_the_whole_frame() -> None:
    second = (
        "{attachments: {again: {image: ms, loadOp: LOAD, storeOp: DONT_CARE}}, subpasses: "
        "[{colorAttachments: [again]}]}"
    )
    text = f"{color()}  second: {second}\n"
    assert "multisampled-image-not-transient" not in rules(text)


def test_a_stencil_only_clear_is_no_load() -> None:
    found = rules(
        depth("D24_UNORM_S8_UINT", OPS.format("CLEAR", "DONT_CARE", "CLEAR", "DONT_CARE"))
    )
    assert not found & {
        "multisampled-attachment-loaded",
        "multisampled-stencil-stored",
        "load-from-undefined",
    }


def test_multisampled_blending_is_silent_with_sample_shading_and_for_normalised_formats() -> None:
    assert "multisampled-float-blending" not in rules(blended(format="R8G8B8A8_UNORM"))
    assert "multisampled-float-blending" not in rules(
        blended().replace("sampleShadingEnable: false", "sampleShadingEnable: true")
    )


def test_multisampled_blending_is_a_note_where_the_device_is_another_vendors() -> None:
    result = lint(text=blended().replace("mali-g76", "adreno-740"), isolated=True)
    assert {f.severity for f in result.findings if f.rule == "multisampled-float-blending"} <= {
        "note"
    }
