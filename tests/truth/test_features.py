"""Frames that need a feature, a flag or one sample, and samples that leave the tile: what `check`
says of each.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

OURS = {"MSAA106", "MSAA111", "MSAA201", "MSAA401", "MSAA409", "MSAA503", "MSAA512", "MSAA513"}

DEPENDENCY = (
    "[{srcSubpass: 0, dstSubpass: 1, srcStageMask: [COLOR_ATTACHMENT_OUTPUT], dstStageMask: "
    "[FRAGMENT_SHADER], "
    "srcAccessMask: [COLOR_ATTACHMENT_WRITE], dstAccessMask: [INPUT_ATTACHMENT_READ], "
    "dependencyFlags: [BY_REGION]}]"
)


def image(samples: int, rest: str, format: str = "R8G8B8A8_UNORM") -> str:
    return f"images: {{a: {{format: {format}, samples: {samples}, {rest}}}}}"


def pipeline(state: str, rest: str = "") -> str:
    return (
        f"pipelines: {{p: {{rendering: {{colorAttachmentFormats: [R8G8B8A8_UNORM]}}, "
        f"multisampleState: {{{state}}}{rest}}}}}"
    )


def enabled(*features: str) -> str:
    return f"enabled: {{features: [{', '.join(features)}]}}\n"


def to_single_sampled(flags: str, chained: str, samples: int = 1, depth: str = "") -> str:
    """A rendering to one image with VkMultisampledRenderToSingleSampledInfoEXT."""
    return (
        f"images: {{a: {{format: R8G8B8A8_UNORM, samples: {samples}, {flags}usage: "
        f"[COLOR_ATTACHMENT]}}{depth}}}\n"
        f"commands:\n- beginRendering: {{multisampledRenderToSingleSampled: {{{chained}}}, "
        "colorAttachments: [{image: a, loadOp: CLEAR, storeOp: STORE}]}\n- endRendering\n- "
        "copyImageToBuffer: {srcImage: a}"
    )


MSRTSS = "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT"
FLAG = f"flags: [{MSRTSS}], "
ON = "multisampledRenderToSingleSampledEnable: true, rasterizationSamples: 4"
GLINTS = ", stages: [{stage: FRAGMENT, module: glints.frag.spv}]"
USED = "usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]"

CASES: dict[str, tuple[str, set[str]]] = {
    # VkImageCreateInfo
    "ycbcr": (image(4, "usage: [SAMPLED]", "G8_B8R8_2PLANE_420_UNORM"), {"MSAA106"}),
    "ycbcr, packed": (image(2, "usage: [SAMPLED]", "G8B8G8R8_422_UNORM"), {"MSAA106"}),
    "ycbcr with one sample": (image(1, "usage: [SAMPLED]", "G8_B8R8_2PLANE_420_UNORM"), set()),
    "density map": (image(4, "usage: [FRAGMENT_DENSITY_MAP_EXT]", "R8G8_UNORM"), {"MSAA106"}),
    "density map with one sample": (
        image(1, "usage: [FRAGMENT_DENSITY_MAP_EXT]", "R8G8_UNORM"),
        set(),
    ),
    "shading rates": (
        image(2, "usage: [FRAGMENT_SHADING_RATE_ATTACHMENT_KHR]", "R8_UINT"),
        {"MSAA106"},
    ),
    "quantization map": (
        image(2, "usage: [VIDEO_ENCODE_QUANTIZATION_DELTA_MAP_KHR]", "R8_SINT"),
        {"MSAA106"},
    ),
    "emphasis map": (image(2, "usage: [VIDEO_ENCODE_EMPHASIS_MAP_KHR]", "R8_UNORM"), {"MSAA106"}),
    "flag with samples": (
        enabled("multisampledRenderToSingleSampled") + image(4, FLAG + USED),
        {"MSAA106"},
    ),
    "flag with one sample": (image(1, FLAG + "usage: [COLOR_ATTACHMENT]"), set()),
    "sparse at 8": (
        enabled("sparseResidency4Samples")
        + image(8, "flags: [SPARSE_RESIDENCY], usage: [SAMPLED]"),
        {"MSAA106"},
    ),
    "sparse at 4": (
        enabled("sparseResidency4Samples")
        + image(4, "flags: [SPARSE_RESIDENCY], usage: [SAMPLED]"),
        set(),
    ),
    "sparse, features unknown": (image(4, "flags: [SPARSE_RESIDENCY], usage: [SAMPLED]"), set()),
    "storage": (enabled() + image(4, "usage: [STORAGE]"), {"MSAA513"}),
    "storage with the feature": (
        enabled("shaderStorageImageMultisample") + image(4, "usage: [STORAGE]"),
        set(),
    ),
    "storage, features unknown": (image(4, "usage: [STORAGE]"), set()),
    "storage with one sample": (enabled() + image(1, "usage: [STORAGE]"), set()),
    # Pipelines
    "alpha to one": (
        enabled("sampleRateShading") + pipeline("rasterizationSamples: 4, alphaToOneEnable: true"),
        {"MSAA512"},
    ),
    "alpha to one, one sample": (
        enabled() + pipeline("rasterizationSamples: 1, alphaToOneEnable: true"),
        {"MSAA512"},
    ),
    "alpha to one with the feature": (
        enabled("alphaToOne") + pipeline("rasterizationSamples: 4, alphaToOneEnable: true"),
        set(),
    ),
    "alpha to one, dynamic": (
        enabled()
        + pipeline(
            "rasterizationSamples: 4, alphaToOneEnable: true",
            ", dynamicState: [ALPHA_TO_ONE_ENABLE_EXT]",
        ),
        set(),
    ),
    "alpha to one, features unknown": (
        pipeline("rasterizationSamples: 4, alphaToOneEnable: true"),
        set(),
    ),
    "shader's capability": (enabled() + pipeline("rasterizationSamples: 4", GLINTS), {"MSAA503"}),
    "shader's capability, one sample": (
        enabled() + pipeline("rasterizationSamples: 1", GLINTS),
        {"MSAA503"},
    ),
    "shader's capability with the feature": (
        enabled("sampleRateShading") + pipeline("rasterizationSamples: 1", GLINTS),
        set(),
    ),
    "shader's capability, features unknown": (pipeline("rasterizationSamples: 1", GLINTS), set()),
    # Multisampled rendering to single-sampled attachments
    "no flag": (
        enabled("multisampledRenderToSingleSampled") + to_single_sampled("", ON),
        {"MSAA111"},
    ),
    "no feature": (enabled("dynamicRendering") + to_single_sampled(FLAG, ON), {"MSAA111"}),
    "flag and feature": (
        enabled("multisampledRenderToSingleSampled") + to_single_sampled(FLAG, ON),
        set(),
    ),
    "flag, feature unknown": (to_single_sampled(FLAG, ON), set()),
    "not enabled": (enabled() + to_single_sampled("", ON.replace("true", "false")), set()),
    "whether enabled is not stated": (
        enabled() + to_single_sampled("", "rasterizationSamples: 4"),
        set(),
    ),
    "count of 1": (
        enabled("multisampledRenderToSingleSampled")
        + to_single_sampled(FLAG, ON.replace("4", "1")),
        {"MSAA111"},
    ),
}


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("form", ["yaml", "json"])
def test_what_needs_a_feature_or_one_sample(tmp_path: Path, name: str, form: str) -> None:
    text, expected = CASES[name]
    assert codes(tmp_path, text, form) & OURS == expected


def codes(folder: Path, text: str, form: str = "yaml") -> set[str]:
    """The codes of the findings of a description, of which none is about the description itself."""
    import yaml

    folder.joinpath("glints.frag.spv").write_bytes(
        Path("rules/shaders/glints.frag.spv").read_bytes()
    )
    path = folder / f"frame.msaa.{form}"
    path.write_text(text if form == "yaml" else json.dumps(yaml.safe_load(text)))
    found = [str(finding["code"]) for finding in findings(folder, path)]
    assert not [code for code in found if code.startswith("MSAA9")], found
    return set(found)


def findings(folder: Path, path: Path) -> list[dict[str, object]]:
    done = run(folder, "check", path.name, "--output", "json", "--no-cache")
    result = json.loads(done.stdout)["findings"]
    assert isinstance(result, list)
    return result


GBUFFER = """frame: {{width: 1920, height: 1080, fps: 60}}
{device}images:
  albedo: {{format: R8G8B8A8_UNORM, samples: {samples}{extent}}}
  normal: {{format: A2B10G10R10_UNORM_PACK32, samples: {samples}}}
  depth: {{format: D32_SFLOAT, samples: {samples}}}
  lit: {{format: R16G16B16A16_SFLOAT, samples: 1, extent: {{width: 1920, height: 1080}}}}
commands:
- beginRendering:
    colorAttachments: [{{image: albedo, loadOp: CLEAR, storeOp: STORE}}, {{image: normal, loadOp: CLEAR, storeOp: STORE}}]
    depthAttachment: {{image: depth, loadOp: CLEAR, storeOp: STORE}}
- endRendering
{between}- beginRendering: {{colorAttachments: [{{image: lit, loadOp: DONT_CARE, storeOp: STORE}}]}}
- readImage: {{image: albedo, stage: {stage}, samples: {read}}}
- readImage: {{image: normal, stage: {stage}, samples: {read}}}
- readImage: {{image: depth, stage: {stage}, samples: {read}}}
- endRendering
- readImage: {{image: lit, stage: FRAGMENT}}
{after}"""

PLAIN = {
    "device": "",
    "samples": 4,
    "extent": "",
    "between": "",
    "stage": "FRAGMENT",
    "read": "ALL",
    "after": "",
}


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, True),
        ({"device": "device: mali-g76\n"}, True),
        ({"samples": 2}, True),
        ({"between": "- readImage: {image: lit, stage: COMPUTE}\n"}, True),
        ({"samples": 1}, False),
        ({"device": "device: nvidia\n"}, False),
        ({"stage": "COMPUTE"}, False),
        ({"read": "ALL, resolves: AVERAGE"}, False),
        ({"read": "1"}, False),
        ({"extent": ", extent: {width: 960, height: 540}"}, False),
        ({"between": "- readImage: {image: depth, stage: COMPUTE}\n"}, False),
        ({"between": "- copyImageToBuffer: {srcImage: normal}\n"}, False),
        (
            {
                "after": "- beginRendering: {colorAttachments: [{image: albedo, loadOp: LOAD, "
                "storeOp: STORE}]}\n- endRendering\n"
            },
            True,
        ),
    ],
)
def test_samples_of_a_g_buffer_that_the_next_pass_reads(
    tmp_path: Path, changed: dict[str, object], expected: bool
) -> None:
    text = GBUFFER.format(**{**PLAIN, **changed})
    assert ("MSAA409" in codes(tmp_path, text)) == expected


def test_the_price_of_samples_that_leave_the_tile_is_the_store_and_the_read(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    path.write_text(GBUFFER.format(**PLAIN))
    (found,) = [each for each in findings(tmp_path, path) if each["code"] == "MSAA409"]
    price = found["price"]
    moved = 1920 * 1080 * 60 * 4 * (4 + 4 + 4) / 1e6
    assert isinstance(price, dict)
    assert (price["read_mb_per_s"], price["write_mb_per_s"]) == (
        pytest.approx(moved),
        pytest.approx(moved),
    )


def deferred(usage: str, store: str, input_load: str = "CLEAR") -> str:
    return (
        f"images: {{g: {{format: R8G8B8A8_UNORM, samples: 4, usage: [{usage}]}}}}\n"
        "renderPasses:\n  deferred:\n    attachments:\n"
        f"      g: {{image: g, loadOp: {input_load}, storeOp: {store}, initialLayout: "
        f"COLOR_ATTACHMENT_OPTIMAL}}\n"
        "      lit: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}\n"
        "    subpasses: [{colorAttachments: [g]}, {colorAttachments: [lit], inputAttachments: "
        "[g]}]\n"
        f"    dependencies: {DEPENDENCY}\n"
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (deferred("COLOR_ATTACHMENT, INPUT_ATTACHMENT", "DONT_CARE"), {"MSAA401"}),
        (deferred("COLOR_ATTACHMENT, INPUT_ATTACHMENT", "STORE"), {"MSAA201", "MSAA401"}),
        (deferred("COLOR_ATTACHMENT, INPUT_ATTACHMENT, TRANSIENT_ATTACHMENT", "DONT_CARE"), set()),
        (deferred("COLOR_ATTACHMENT, INPUT_ATTACHMENT, SAMPLED", "STORE"), set()),
        (deferred("COLOR_ATTACHMENT, INPUT_ATTACHMENT", "STORE", "LOAD"), set()),
    ],
)
@pytest.mark.parametrize(
    "commands",
    ["", "commands: [{beginRenderPass: {renderPass: deferred}}, nextSubpass, endRenderPass]\n"],
)
def test_an_input_attachment_is_read_on_the_tile(
    tmp_path: Path, text: str, expected: set[str], commands: str
) -> None:
    if "SAMPLED" in text and commands:
        expected = {"MSAA201", "MSAA401"}  # the commands read nothing
    assert codes(tmp_path, text + commands) & OURS == expected
