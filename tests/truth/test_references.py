"""Attachments that no subpass lists: density maps and shading rate attachments, and structures of a
pNext chain that are not read.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run
from tests.input.captures.program import Program, attachment, info, lint

Json = Any

COLOR = "{format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: STORE}"
MAP = "{format: R8G8_UNORM, samples: 1, loadOp: LOAD, storeOp: DONT_CARE}"


def found(
    folder: Path, text: str, *arguments: str, name: str = "f.msaa.yaml"
) -> list[tuple[str, bool | None]]:
    """The codes of the findings in a text, each with whether its fix is safe (None: it has
    none).
    """
    (folder / name).write_text(text, encoding="utf-8")
    done = run(folder, "check", "--output", "json", "--min-severity", "note", *arguments, name)
    findings = json.loads(done.stdout)["findings"]
    return sorted((each["code"], each["fix"]["safe"] if each["fix"] else None) for each in findings)


def yaml(chained: str = "", subpass: str = "", mapped: str = MAP) -> str:
    return f"""
renderPasses:
  eyes:
    attachments: {{color: {COLOR}, map: {mapped}}}
    subpasses: [{{colorAttachments: [color], viewMask: 3{subpass}}}]
{chained}
"""


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (yaml(), [("MSAA212", True)]),
        (yaml("    fragmentDensityMapAttachment: map"), []),
        (yaml("    fragmentDensityMapAttachment: 1"), []),
        (
            yaml(
                "    fragmentDensityMapAttachment: {attachment: map, layout: "
                "FRAGMENT_DENSITY_MAP_OPTIMAL_EXT}"
            ),
            [],
        ),
        (yaml("    fragmentDensityMapAttachment: null"), [("MSAA212", True)]),
        (
            yaml(
                "",
                ", fragmentShadingRateAttachment: map, shadingRateAttachmentTexelSize: {width: 8, "
                "height: 8}",
            ),
            [],
        ),
        (yaml("    pNext: [RENDER_PASS_TILE_SHADING_CREATE_INFO_QCOM]"), []),
        (yaml("", ", pNext: [SOMETHING_NEW]"), []),
    ],
)
def test_an_attachment_that_a_pass_reads_without_a_subpass_is_used(
    tmp_path: Path, text: str, expected: list[Any]
) -> None:
    assert [each for each in found(tmp_path, text) if each[0] == "MSAA212"] == expected


def test_the_image_of_a_density_map_is_kept(tmp_path: Path) -> None:
    """What a pass stores in a map that the next one reads is read, and the map outlives passes that
    may discard it.
    """
    frame = """
images:
  map: {format: R8G8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, FRAGMENT_DENSITY_MAP_EXT]}
  eyes: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
renderPasses:
  foveate:
    attachments: {map: {image: map, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{colorAttachments: [map]}]
  eyes:
    attachments:
      eyes: {image: eyes, loadOp: CLEAR, storeOp: STORE}
      map: {image: map, loadOp: LOAD, storeOp: DONT_CARE}
    fragmentDensityMapAttachment: map
    subpasses: [{colorAttachments: [eyes]}]
commands:
  - beginRenderPass: {renderPass: foveate}
  - draw: {vertexCount: 3}
  - endRenderPass
  - beginRenderPass: {renderPass: eyes}
  - draw: {vertexCount: 3}
  - endRenderPass
  - beginRenderPass: {renderPass: eyes}
  - draw: {vertexCount: 3}
  - endRenderPass
  - present: {image: eyes}
"""
    assert not {code for code, _ in found(tmp_path, frame)} & {
        "MSAA203",
        "MSAA211",
        "MSAA212",
        "MSAA213",
        "MSAA214",
    }
    unread = frame.replace("fragmentDensityMapAttachment: map", "pNext: [SOMETHING_NEW]")
    assert not [each for each in found(tmp_path, unread) if each[1]]


@pytest.mark.parametrize(
    "member",
    [
        "fragmentDensityMapAttachment: {image: map, imageLayout: FRAGMENT_DENSITY_MAP_OPTIMAL_EXT}",
        "fragmentShadingRateAttachment: {image: map, shadingRateAttachmentTexelSize: {width: 16, "
        "height: 16}}",
        "pNext: [SOMETHING_NEW]",
    ],
)
def test_a_rendering_reads_the_image_that_is_chained_to_it(tmp_path: Path, member: str) -> None:
    frame = f"""
images:
  map: {{format: R8_UINT, samples: 4}}
  eyes: {{format: R8G8B8A8_UNORM, samples: 4}}
commands:
  - beginRendering: {{colorAttachments: [{{image: map, loadOp: CLEAR, storeOp: STORE}}]}}
  - draw: {{vertexCount: 3}}
  - endRendering
  - beginRendering:
      colorAttachments: [{{image: eyes, loadOp: CLEAR, storeOp: DONT_CARE}}]
      {member}
  - draw: {{vertexCount: 3}}
  - endRendering
"""
    assert "MSAA201" not in dict(found(tmp_path, frame))
    assert "MSAA201" in dict(found(tmp_path, frame.replace(member, "layerCount: 1")))


def dumped(render_pass: Json, version: int = 1) -> str:
    return json.dumps(
        {"GraphicsPipelineState": {"Renderpass" + ("2" if version == 2 else ""): render_pass}}
    )


def vulkan_sc(pass_chain: Json, subpass_chain: Json = "NULL") -> Json:
    described = {
        "format": "VK_FORMAT_R8G8B8A8_UNORM",
        "samples": "VK_SAMPLE_COUNT_1_BIT",
        "storeOp": "VK_ATTACHMENT_STORE_OP_DONT_CARE",
    }
    described |= {
        "stencilLoadOp": "VK_ATTACHMENT_LOAD_OP_DONT_CARE",
        "stencilStoreOp": "VK_ATTACHMENT_STORE_OP_DONT_CARE",
    }
    attachments = [
        {**described, "loadOp": f"VK_ATTACHMENT_LOAD_OP_{load}"} for load in ("CLEAR", "LOAD")
    ]
    color = [{"attachment": 0, "layout": "VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL"}]
    subpass = {
        "pNext": subpass_chain,
        "colorAttachmentCount": 1,
        "pColorAttachments": color,
        "pDepthStencilAttachment": "NULL",
    }
    return {
        "pNext": pass_chain,
        "attachmentCount": 2,
        "pAttachments": attachments,
        "subpassCount": 1,
        "pSubpasses": [subpass],
    }


def structure(name: str, following: Json = "NULL", **members: Json) -> Json:
    return {"sType": f"VK_STRUCTURE_TYPE_{name}", "pNext": following, **members}


DENSITY = structure(
    "RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO_EXT",
    fragmentDensityMapAttachment={"attachment": 1, "layout": 1000218000},
)
RATE = structure(
    "FRAGMENT_SHADING_RATE_ATTACHMENT_INFO_KHR",
    pFragmentShadingRateAttachment={"attachment": 1, "layout": 1000164003},
)
RESOLVE = structure(
    "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE", RATE, pDepthStencilResolveAttachment="NULL"
)
MULTIVIEW = structure("RENDER_PASS_MULTIVIEW_CREATE_INFO", subpassCount=1, pViewMasks=[3])


@pytest.mark.parametrize(
    ("pass_chain", "subpass_chain", "expected"),
    [
        ("NULL", "NULL", ["MSAA212"]),
        (DENSITY, "NULL", []),
        ({**MULTIVIEW, "pNext": DENSITY}, "NULL", []),
        (MULTIVIEW, "NULL", ["MSAA212"]),
        ("NULL", RATE, []),
        ("NULL", RESOLVE, []),
        (structure("RENDER_PASS_TILE_SHADING_CREATE_INFO_QCOM"), "NULL", []),
        ("NULL", structure("SOMETHING_NEW_EXT"), []),
        ("0x7ffe12345678", "NULL", []),
    ],
)
@pytest.mark.parametrize("version", [1, 2])
def test_the_chains_of_a_dump_are_read(
    tmp_path: Path, pass_chain: Json, subpass_chain: Json, expected: list[str], version: int
) -> None:
    text = dumped(vulkan_sc(pass_chain, subpass_chain), version)
    assert [
        code for code, _ in found(tmp_path, text, name="pipeline.json") if code == "MSAA212"
    ] == expected


CPP = """
VkRenderPass make(VkDevice device) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[1].format = VK_FORMAT_R8G8_UNORM;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    CHAIN
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
"""


@pytest.mark.parametrize(
    ("chain", "expected"),
    [
        ("", ["MSAA212"]),
        (
            """VkRenderPassFragmentDensityMapCreateInfoEXT density = {};
            density.fragmentDensityMapAttachment = {1, VK_IMAGE_LAYOUT_FRAGMENT_DENSITY_MAP_OPTIMAL_EXT};
            info.pNext = &density;""",
            [],
        ),
        (
            """VkRenderPassFragmentDensityMapCreateInfoEXT density = {};
            density.fragmentDensityMapAttachment.attachment = 1;
            VkRenderPassMultiviewCreateInfo views = {};
            views.pNext = &density;
            info.pNext = &views;""",
            [],
        ),
        ("VkRenderPassMultiviewCreateInfo views = {}; info.pNext = &views;", ["MSAA212"]),
        ("VkRenderPassTileShadingCreateInfoQCOM tiles = {}; info.pNext = &tiles;", []),
        ("info.pNext = chainOf(device);", []),
    ],
)
def test_the_chain_of_a_render_pass_in_source_code_is_read(
    tmp_path: Path, chain: str, expected: list[str]
) -> None:
    codes = [code for code, _ in found(tmp_path, CPP.replace("CHAIN", chain), name="pass.cpp")]
    assert [code for code in codes if code == "MSAA212"] == expected


def test_the_image_that_is_chained_to_a_captured_rendering_is_read() -> None:
    for chained in (True, False):
        program = Program()
        eyes, density = (
            program.view(program.image()),
            program.view(program.image("VK_FORMAT_R8G8_UNORM", 4, 0x210)),
        )
        buffer = program.buffer()
        program.rendering(buffer, [info(density, store="STORE")])
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.rendering(buffer, [info(eyes)])
        if chained:
            name = "VK_STRUCTURE_TYPE_RENDERING_FRAGMENT_DENSITY_MAP_ATTACHMENT_INFO_EXT"
            program.calls[-1][1]["pRenderingInfo"]["pNext"] = {
                "sType": name,
                "imageView": density,
                "imageLayout": 1000218000,
            }
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        assert ("MSAA201" in {finding.code for finding in lint(program.text())}) is not chained


def test_a_structure_that_a_capture_does_not_read_leaves_uses_unknown() -> None:
    program = Program()
    views = [
        program.view(program.image()),
        program.view(program.image("VK_FORMAT_R8G8_UNORM", 1, 0x200)),
    ]
    render_pass = program.render_pass([attachment(), attachment("VK_FORMAT_R8G8_UNORM", 1, "LOAD")])
    program.calls[-1][1]["pCreateInfo"]["pNext"] = {"sType": "VK_STRUCTURE_TYPE_SOMETHING_NEW_EXT"}
    buffer = program.buffer()
    program.begin(buffer, render_pass, program.framebuffer(render_pass, views))
    program.draw(buffer, program.pipeline(render_pass))
    program.end(buffer)
    program.submit(buffer)
    findings = lint(program.text())
    assert "MSAA212" not in {finding.code for finding in findings}
    assert not any(finding.fix is not None and finding.fix.safe for finding in findings)
