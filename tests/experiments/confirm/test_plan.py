"""Plans: what a frame is to a device, with everything that is not described said in words."""

from __future__ import annotations

import json
import re
import struct
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.experiments.confirm import parts
from msaa_lint.experiments.confirm.parts import (
    Blend,
    Dependency,
    Framebuffer,
    PassCommand,
    Plan,
    Reference,
    RenderTarget,
    Step,
    from_json,
)
from msaa_lint.experiments.confirm.plan import MAX_STEPS, plan
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.spirv.constants import Constants
from msaa_lint.frame.spirv.interface import interface
from msaa_lint.frame.spirv.module import Module
from msaa_lint.input import readers
from tests.experiments.confirm.frames import begins, frames, image, one, planned
from tests.frame.spirv.test_hostile import assembled
from tests.frames import frames as random_frames
from tests.pages import Example, all_examples
from tests.paths import ROOT
from tests.strength import examples

UNDEFINED, GENERAL, COLOR_LAYOUT, DEPTH_LAYOUT, DEPTH_READ_LAYOUT, READ_LAYOUT = 0, 1, 2, 3, 4, 5
SOURCE_LAYOUT, PRESENT_LAYOUT = 6, 1000001002
RGBA8, RGBA16F, R32_UINT, D32, D24S8, D32S8 = 37, 97, 98, 126, 129, 130
COLOR, DEPTH, INPUT, TRANSIENT, SAMPLED, SOURCE, TARGET = 0x10, 0x20, 0x80, 0x40, 0x4, 0x1, 0x2

INLINE = """\
frame: {width: 128, height: 64}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  depth: {format: D24_UNORM_S8_UINT, samples: 4, usage: DEPTH_STENCIL_ATTACHMENT}
  shown: {format: R8G8B8A8_UNORM, samples: 1, usage: COLOR_ATTACHMENT, presentable: true}
renderPasses:
  main:
    attachments:
      color: {image: ms, loadOp: CLEAR, storeOp: DONT_CARE}
      depth: {image: depth, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
      shown: {image: shown, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [shown], depthStencilAttachment: depth}
"""

CLEARED = "{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}"
PLAIN = (
    f"renderPasses: {{p: {{attachments: {{c: {CLEARED}}}, subpasses: [{{colorAttachments: "
    f"[c]}}]}}}}\n"
)


def words(made: Plan, *some: str) -> list[str]:
    """The defaults whose words hold all of some."""
    return [word for word in made.defaults if all(each in word for each in some)]


# Without a device


@pytest.mark.parametrize(
    "module", ["plan", "gate", "defined_contents", "resample", "parts", "shaders.spirv"]
)
def test_planning_loads_no_binding(module: str) -> None:
    heavy = "{'vulkan', 'cffi', '_cffi_backend', 'numpy'}"
    code = (
        f"import sys, msaa_lint.experiments.confirm.{module}; print(sorted({heavy} & "
        "set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "[]\n"


# Render passes


def test_an_inline_resolve_is_planned_whole() -> None:
    made = planned(INLINE, file="frame.msaa.yaml")
    assert made.file == "frame.msaa.yaml"
    assert made.defaults == () == made.extensions == made.without
    assert not made.reversed and not made.hdr
    ms, depth, shown = made.images
    assert ms == parts.Image(
        "ms", RGBA8, 4, COLOR | TRANSIENT, 128, 64, 1, 1, 1, 1, 0, 0, True, parts.COLOR, "UNORM", 4
    )
    assert depth == parts.Image(
        "depth",
        D24S8,
        4,
        DEPTH,
        128,
        64,
        1,
        1,
        1,
        1,
        0,
        0,
        False,
        parts.DEPTH | parts.STENCIL,
        "",
        4,
    )
    assert shown == parts.Image(
        "shown", RGBA8, 1, COLOR, 128, 64, 1, 1, 1, 1, 0, 0, False, parts.COLOR, "UNORM", 4
    )
    each = one(made)
    assert (each.name, each.path, each.kind, each.api, each.refused) == (
        "main",
        "renderPasses.main",
        "renderPass",
        2,
        "",
    )
    assert each.attachments == (
        parts.Attachment(
            RGBA8,
            4,
            0,
            load=1,
            store=1,
            stencil_load=2,
            stencil_store=1,
            initial=UNDEFINED,
            final=COLOR_LAYOUT,
        ),
        parts.Attachment(
            D24S8,
            4,
            0,
            load=1,
            store=1,
            stencil_load=1,
            stencil_store=1,
            initial=UNDEFINED,
            final=DEPTH_LAYOUT,
        ),
        parts.Attachment(
            RGBA8,
            1,
            0,
            load=2,
            store=0,
            stencil_load=2,
            stencil_store=1,
            initial=UNDEFINED,
            final=PRESENT_LAYOUT,
        ),
    )
    (subpass,) = each.subpasses
    assert subpass == parts.Subpass(
        colors=(Reference(0, COLOR_LAYOUT),),
        resolves=(Reference(2, COLOR_LAYOUT),),
        depth_stencil=(Reference(1, DEPTH_LAYOUT),),
    )
    assert each.framebuffers == (Framebuffer((0, 1, 2), 128, 64, 1),)
    assert each.images == (0, 1, 2)
    (pipeline,) = each.pipelines
    assert pipeline == parts.Pipeline(
        "built-in 0", 0, 4, dynamic=(0, 1), depth_test=True, depth_write=True, depth_compare=1,
        stencil_test=True,
        blends=(Blend(),), numerics=("UNORM",),
    )  # fmt: skip
    assert made.steps == (
        Step("begin", 0, 0, (0, 0, 128, 64), (PassCommand("draw", 0, 0, draws=0),)),
    )


@pytest.mark.parametrize(
    ("enabled", "api"),
    [
        ("", 2),
        ("enabled: {extensions: [VK_KHR_swapchain]}\n", 2),
        ("enabled: {apiVersion: '1.0'}\n", 1),
        ("enabled: {apiVersion: '1.1'}\n", 1),
        ("enabled: {apiVersion: 1.1.250}\n", 1),
        ("enabled: {apiVersion: '1.2'}\n", 2),
        ("enabled: {apiVersion: 1.3.230}\n", 2),
        ("enabled: {apiVersion: '2.0'}\n", 2),
        ("enabled: {apiVersion: '1.10'}\n", 2),
        ("enabled: {apiVersion: newest}\n", 2),
        ("enabled: {apiVersion: '1.1', extensions: [VK_KHR_create_renderpass2]}\n", 2),
        ("enabled: {apiVersion: '1.1', extensions: [VK_KHR_multiview]}\n", 1),
    ],
)
def test_the_version_of_the_structure_is_what_the_application_has(enabled: str, api: int) -> None:
    assert one(planned(enabled + PLAIN)).api == api


@pytest.mark.parametrize("api", [1, 2])
def test_the_version_of_the_structure_can_be_asked_for(api: int) -> None:
    assert one(planned("enabled: {apiVersion: '1.0'}\n" + PLAIN, api=api)).api == api
    assert one(planned(PLAIN, api=api)).api == api


def test_what_only_the_second_structure_has_needs_it() -> None:
    resolve = """\
enabled: {apiVersion: '1.1'}
renderPasses:
  p:
    attachments: {d: {format: D32_SFLOAT, samples: 4}, r: {format: D32_SFLOAT, samples: 1}}
    subpasses: [{depthStencilAttachment: d, depthStencilResolve: {attachment: r, depthResolveMode: MIN}}]
"""
    assert one(planned(resolve)).api == 2
    assert (
        one(
            planned(resolve.replace("subpasses: [", "subpasses: [{depthStencilAttachment: d}, "))
        ).api
        == 2
    )
    assert one(planned(re.sub(", depthStencilResolve: {.*?}", "", resolve))).api == 1
    single = """\
enabled: {apiVersion: '1.1'}
renderPasses:
  p:
    attachments: {c: {format: R8G8B8A8_UNORM, samples: 1}}
    subpasses: [{colorAttachments: [c], multisampledRenderToSingleSampled: {rasterizationSamples: 4}}]
"""
    assert one(planned(single)).api == 2


def test_views_need_the_second_structure() -> None:
    """The first has none of its own: VkRenderPassMultiviewCreateInfo is not planned."""
    views = PLAIN.replace("colorAttachments: [c]", "colorAttachments: [c], viewMask: 3")
    assert one(planned("enabled: {apiVersion: '1.1'}\n" + views)).api == 2


@pytest.mark.parametrize(
    ("format", "modes", "depth", "stencil"),
    [
        ("D24_UNORM_S8_UINT", "depthResolveMode: MIN, stencilResolveMode: MAX", 4, 8),
        ("D24_UNORM_S8_UINT", "depthResolveMode: NONE, stencilResolveMode: SAMPLE_ZERO", 0, 1),
        ("D24_UNORM_S8_UINT", "depthResolveMode: AVERAGE", 2, 1),
        ("D32_SFLOAT", "", 1, 1),
    ],
)
def test_a_depth_resolve_has_its_modes(format: str, modes: str, depth: int, stencil: int) -> None:
    made = planned(
        f"""\
renderPasses:
  p:
    attachments: [{{format: {format}, samples: 4}}, {{format: {format}, samples: 1}}]
    subpasses: [{{depthStencilAttachment: 0, depthStencilResolve: {{attachment: 1, {modes}}}}}]
"""
    )
    (subpass,) = one(made).subpasses
    assert (subpass.depth_mode, subpass.stencil_mode) == (depth, stencil)
    assert (subpass.depth_stencil, subpass.depth_resolve) == (
        (Reference(0, DEPTH_LAYOUT),),
        (Reference(1, DEPTH_LAYOUT),),
    )
    assert [each.usage for each in made.images] == [DEPTH, DEPTH]


def test_every_colour_attachment_has_a_resolve_or_an_unused_one() -> None:
    made = planned(
        """\
renderPasses:
  p:
    attachments: {a: {samples: 4}, b: {samples: 4}, r: {samples: 1}}
    subpasses:
      - {colorAttachments: [a, b], resolveAttachments: [r]}
      - {colorAttachments: [a], resolveAttachments: [null]}
      - {colorAttachments: [null, b]}
"""
    )
    first, second, third = one(made).subpasses
    unused = Reference(parts.NONE, UNDEFINED)
    assert (first.colors, first.resolves) == (
        (Reference(0, COLOR_LAYOUT), Reference(1, COLOR_LAYOUT)),
        (Reference(2, COLOR_LAYOUT), unused),
    )
    assert (second.colors, second.resolves) == ((Reference(0, COLOR_LAYOUT),), (unused,))
    assert (third.colors, third.resolves) == ((unused, Reference(1, COLOR_LAYOUT)), ())
    assert [(p.subpass, p.samples, p.numerics) for p in one(made).pipelines] == [
        (0, 4, ("UNORM", "UNORM")), (1, 4, ("UNORM",)), (2, 4, ("", "UNORM")),
    ]  # fmt: skip


def test_input_attachments_are_read_in_layouts_that_fit() -> None:
    made = planned(
        """\
renderPasses:
  p:
    attachments:
      g: {format: R16G16B16A16_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
      d: {format: D32_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
      o: {format: R8G8B8A8_UNORM, samples: 4, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [g], depthStencilAttachment: d}
      - {inputAttachments: [g, d, null], colorAttachments: [o], depthStencilAttachment: d}
      - {inputAttachments: [{attachment: o, layout: GENERAL}], colorAttachments: [g]}
      - {inputAttachments: [g], colorAttachments: [g], preserveAttachments: [o, null]}
"""
    )
    each = one(made)
    assert [image.usage for image in made.images] == [COLOR | INPUT, DEPTH | INPUT, COLOR | INPUT]
    write, read, stated, both = each.subpasses
    assert write.depth_stencil == (Reference(1, DEPTH_LAYOUT),)
    assert read.inputs == (
        Reference(0, READ_LAYOUT, parts.COLOR),
        Reference(1, DEPTH_READ_LAYOUT, parts.DEPTH),
        Reference(parts.NONE, UNDEFINED),
    )
    assert read.depth_stencil == (Reference(1, DEPTH_READ_LAYOUT),)
    assert stated.inputs == (Reference(2, GENERAL, parts.COLOR),)
    assert both.inputs == (Reference(0, GENERAL, parts.COLOR),)
    assert both.colors == (Reference(0, GENERAL),)
    assert both.preserves == (2,)
    tests = [(p.subpass, p.depth_test, p.depth_write) for p in each.pipelines]
    assert tests == [(0, True, True), (1, True, False), (2, False, False), (3, False, False)]


def test_stated_layouts_stay() -> None:
    made = planned(
        """\
images: {d: {format: D24_UNORM_S8_UINT, samples: 4}}
renderPasses:
  p:
    attachments:
      d: {image: d, initialLayout: GENERAL, finalLayout: DEPTH_STENCIL_READ_ONLY_OPTIMAL,
          stencilInitialLayout: STENCIL_ATTACHMENT_OPTIMAL, stencilFinalLayout: STENCIL_READ_ONLY_OPTIMAL}
    subpasses: [{depthStencilAttachment: {attachment: d, layout: DEPTH_STENCIL_READ_ONLY_OPTIMAL}}]
"""
    )
    (attachment,) = one(made).attachments
    assert (attachment.initial, attachment.final) == (GENERAL, DEPTH_READ_LAYOUT)
    assert (attachment.stencil_initial, attachment.stencil_final) == (1000241002, 1000241003)
    assert one(made).subpasses[0].depth_stencil == (Reference(0, DEPTH_READ_LAYOUT),)
    (pipeline,) = one(made).pipelines
    assert (pipeline.depth_test, pipeline.depth_write, pipeline.stencil_test) == (
        True,
        False,
        False,
    )


@pytest.mark.parametrize(
    ("format", "operations", "initial"),
    [
        ("R8G8B8A8_UNORM", "loadOp: LOAD", COLOR_LAYOUT),
        ("R8G8B8A8_UNORM", "loadOp: CLEAR", UNDEFINED),
        ("R8G8B8A8_UNORM", "loadOp: CLEAR, stencilLoadOp: LOAD", UNDEFINED),
        ("D32_SFLOAT_S8_UINT", "loadOp: LOAD", DEPTH_LAYOUT),
        ("D32_SFLOAT_S8_UINT", "loadOp: CLEAR, stencilLoadOp: LOAD", DEPTH_LAYOUT),
        ("D32_SFLOAT_S8_UINT", "loadOp: DONT_CARE, stencilLoadOp: CLEAR", UNDEFINED),
        ("D32_SFLOAT", "loadOp: DONT_CARE, stencilLoadOp: LOAD", UNDEFINED),
    ],
)
def test_what_is_loaded_keeps_its_layout(format: str, operations: str, initial: int) -> None:
    slot = "depthStencilAttachment: 0" if format.startswith("D") else "colorAttachments: [0]"
    made = planned(
        f"renderPasses: {{p: {{attachments: [{{format: {format}, {operations}}}], subpasses: "
        f"[{{{slot}}}]}}}}\n"
    )
    assert one(made).attachments[0].initial == initial


def test_dependencies_are_in_the_second_versions_bits() -> None:
    made = planned(
        f"""\
renderPasses:
  p:
    flags: TRANSFORM_QCOM
    attachments: {{c: {CLEARED}}}
    subpasses: [{{colorAttachments: [c], viewMask: 3}}, {{colorAttachments: [c], viewMask: 3}}]
    dependencies:
      - {{srcSubpass: 0, dstSubpass: 1, srcStageMask: COLOR_ATTACHMENT_OUTPUT, dstStageMask: FRAGMENT_SHADER | COPY,
         srcAccessMask: COLOR_ATTACHMENT_WRITE, dstAccessMask: INPUT_ATTACHMENT_READ,
         dependencyFlags: BY_REGION | VIEW_LOCAL, viewOffset: -1}}
      - {{srcSubpass: EXTERNAL, dstSubpass: 0}}
      - {{srcSubpass: 1}}
"""
    )
    each = one(made)
    assert each.flags == 2
    assert [subpass.view_mask for subpass in each.subpasses] == [3, 3]
    assert made.images[0].layers == 2
    assert each.dependencies == (
        Dependency(0, 1, 0x400, 0x80 | 1 << 32, 0x100, 0x10, 1 | 2, -1),
        Dependency(parts.NONE, 0, 0, 0, 0, 0, 0, 0),
        Dependency(1, parts.NONE, 0, 0, 0, 0, 0, 0),
    )


def test_what_is_only_read_stays_to_be_read() -> None:
    made = planned(
        """\
renderPasses:
  p:
    attachments:
      g: {format: R8G8B8A8_UNORM, samples: 4, loadOp: LOAD, storeOp: STORE}
      d: {format: D32_SFLOAT, samples: 4, loadOp: LOAD, storeOp: STORE}
      o: {format: R8G8B8A8_UNORM, samples: 4, loadOp: LOAD, storeOp: STORE}
    subpasses: [{inputAttachments: [g, d], colorAttachments: [o]}]
"""
    )
    layouts = [(each.initial, each.final) for each in one(made).attachments]
    assert layouts == [
        (READ_LAYOUT, READ_LAYOUT),
        (DEPTH_READ_LAYOUT, DEPTH_READ_LAYOUT),
        (COLOR_LAYOUT, COLOR_LAYOUT),
    ]


@pytest.mark.parametrize(
    ("stated", "final"),
    [
        ("", COLOR_LAYOUT),
        ("initialLayout: UNDEFINED", COLOR_LAYOUT),
        ("initialLayout: GENERAL", GENERAL),
    ],
)
def test_what_no_subpass_uses_stays_as_it_is(stated: str, final: int) -> None:
    unused = f"{{format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: STORE, {stated}}}"
    made = planned(
        f"renderPasses: {{p: {{attachments: [{CLEARED}, {unused}], subpasses: [{{colorAttachments: "
        f"[0]}}]}}}}\n"
    )
    assert one(made).attachments[1].final == final


@pytest.mark.parametrize(
    ("layouts", "initial", "final"),
    [
        ("", -1, -1),
        ("initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL", -1, -1),
        ("initialLayout: DEPTH_ATTACHMENT_OPTIMAL", 1000241002, 1000241002),
        ("finalLayout: DEPTH_READ_ONLY_OPTIMAL", 1000241002, 1000241002),
        (
            "finalLayout: DEPTH_READ_ONLY_OPTIMAL, stencilFinalLayout: STENCIL_READ_ONLY_OPTIMAL",
            1000241002,
            1000241003,
        ),
        ("finalLayout: DEPTH_READ_ONLY_OPTIMAL, stencilLoadOp: CLEAR", UNDEFINED, 1000241002),
    ],
)
def test_stencil_has_layouts_of_its_own_beside_those_of_depth_alone(
    layouts: str, initial: int, final: int
) -> None:
    load = "" if "stencilLoadOp" in layouts else "stencilLoadOp: LOAD, "
    described = f"{{format: D24_UNORM_S8_UINT, samples: 4, loadOp: LOAD, {load}{layouts}}}"
    made = planned(
        f"renderPasses: {{p: {{attachments: [{described}], subpasses: [{{depthStencilAttachment: "
        f"0}}]}}}}\n"
    )
    (attachment,) = one(made).attachments
    assert (attachment.stencil_initial, attachment.stencil_final) == (initial, final)
    alone = planned(
        f"renderPasses: {{p: {{attachments: "
        f"[{described.replace('D24_UNORM_S8_UINT', 'D32_SFLOAT')}], subpasses: [{{}}]}}}}\n"
    )
    assert (one(alone).attachments[0].stencil_initial, one(alone).attachments[0].stencil_final) == (
        -1,
        -1,
    )


@pytest.mark.parametrize(
    ("layout", "writes"),
    [
        ("DEPTH_STENCIL_ATTACHMENT_OPTIMAL", True),
        ("GENERAL", True),
        ("DEPTH_STENCIL_READ_ONLY_OPTIMAL", False),
        ("DEPTH_READ_ONLY_OPTIMAL", False),
        ("READ_ONLY_OPTIMAL", False),
    ],
)
def test_depth_is_not_written_where_its_layout_is_for_reading(layout: str, writes: bool) -> None:
    depth = "{format: D32_SFLOAT, samples: 4, loadOp: CLEAR, storeOp: STORE}"
    subpass = f"{{depthStencilAttachment: {{attachment: 0, layout: {layout}}}}}"
    (pipeline,) = one(
        planned(f"renderPasses: {{p: {{attachments: [{depth}], subpasses: [{subpass}]}}}}\n")
    ).pipelines
    assert (pipeline.depth_test, pipeline.depth_write) == (True, writes)
    rendered = "{image: d, loadOp: CLEAR, storeOp: STORE, imageLayout: " + layout + "}"
    images = "images: {d: {format: D32_SFLOAT, samples: 4}}\n"
    rendering = (
        f"{images}commands: [{{beginRendering: {{depthAttachment: {rendered}}}}}, endRendering]\n"
    )
    (pipeline,) = one(planned(rendering)).pipelines
    assert (pipeline.depth_test, pipeline.depth_write) == (True, writes)


# Passes that nothing can run


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("attachments: [{}], subpasses: []", "none of its subpasses is described"),
        ("attachments: [{}]", "none of its subpasses is described"),
        (
            "attachments: [{}], subpasses: [{colorAttachments: [0], pipelineBindPoint: COMPUTE}]",
            "one of its subpasses is not a graphics subpass",
        ),
        (
            "attachments: [{}], subpasses: [{colorAttachments: [0]}], dependencies: [{srcSubpass: "
            "EXTERNAL, dstSubpass: EXTERNAL}]",
            "one of its dependencies has no subpass on either end",
        ),
        (
            "attachments: [{}], subpasses: [{colorAttachments: [0]}], dependencies: [{}]",
            "one of its dependencies has no subpass on either end",
        ),
        (
            "attachments: [{samples: 4}, {samples: 1}], subpasses: [{flags: [CUSTOM_RESOLVE_EXT], "
            "colorAttachments: [0]}]",
            "it resolves with a shader of its own, which confirm does not support",
        ),
        (
            "attachments: [{samples: 4}, {samples: 1}], subpasses: [{flags: [SHADER_RESOLVE_QCOM], "
            "colorAttachments: [0]}]",
            "it resolves with a shader of its own, which confirm does not support",
        ),
        (
            f"attachments: [{', '.join(['{}'] * 257)}], subpasses: [{{colorAttachments: [0]}}]",
            "it has more than 256 attachments, subpasses or dependencies",
        ),
        (
            f"attachments: [{{}}], subpasses: [{', '.join(['{colorAttachments: [0]}'] * 257)}]",
            "it has more than 256 attachments, subpasses or dependencies",
        ),
    ],
)
def test_a_pass_that_nothing_can_run_says_why(text: str, reason: str) -> None:
    made = planned(
        f"renderPasses:\n  p: {{{text}}}\n"
        + PLAIN.replace("renderPasses: {p:", "  q:").replace("}}\n", "}\n")
    )
    refused, other = made.passes
    assert (refused.name, refused.refused, refused.attachments, refused.pipelines) == (
        "p",
        reason,
        (),
        (),
    )
    assert (other.name, other.refused) == ("q", "")
    assert [step.number for step in made.steps] == [1]


def test_as_many_parts_as_there_may_be_are_planned() -> None:
    text = f"attachments: [{', '.join(['{}'] * 256)}], subpasses: [{{colorAttachments: [0]}}]"
    each = one(planned(f"renderPasses: {{p: {{{text}}}}}\n"))
    assert (each.refused, len(each.attachments)) == ("", 256)


# Images


def test_images_are_as_described() -> None:
    made = planned(
        """\
frame: {width: 100, height: 50}
images:
  plain: {format: R8G8B8A8_SRGB, samples: 2, usage: COLOR_ATTACHMENT | SAMPLED | TRANSFER_SRC}
  cube: {format: R8G8B8A8_UNORM, samples: 1, flags: CUBE_COMPATIBLE}
  line: {format: R32_SFLOAT, samples: 1, imageType: 1D, usage: STORAGE}
  volume: {format: R8_SINT, samples: 1, imageType: 3D, extent: {width: 4, height: 5, depth: 6}, mipLevels: 2, tiling: LINEAR}
  array: {format: D32_SFLOAT_S8_UINT, samples: 1, arrayLayers: 3, extent: {width: 4}}
  stencil: {format: S8_UINT, samples: 1}
"""
    )
    assert made.images == (
        parts.Image(
            "plain",
            43,
            2,
            COLOR | SAMPLED | SOURCE,
            100,
            50,
            1,
            1,
            1,
            1,
            0,
            0,
            False,
            parts.COLOR,
            "SRGB",
            4,
        ),
        parts.Image(
            "cube", RGBA8, 1, COLOR, 100, 100, 1, 6, 1, 1, 0, 0x10, False, parts.COLOR, "UNORM", 4
        ),
        parts.Image("line", 100, 1, 8, 100, 1, 1, 1, 1, 0, 0, 0, False, parts.COLOR, "SFLOAT", 4),
        parts.Image("volume", 14, 1, COLOR, 4, 5, 6, 1, 2, 2, 1, 0, False, parts.COLOR, "SINT", 1),
        parts.Image(
            "array",
            D32S8,
            1,
            DEPTH,
            4,
            50,
            1,
            3,
            1,
            1,
            0,
            0,
            False,
            parts.DEPTH | parts.STENCIL,
            "",
            5,
        ),
        parts.Image(
            "stencil", 127, 1, DEPTH, 100, 50, 1, 1, 1, 1, 0, 0, False, parts.STENCIL, "", 1
        ),
    )
    assert made.defaults == ()
    assert made.passes == (
        parts.Pass("frame", "images", parts.FRAME, 0, images=(0, 1, 2, 3, 4, 5)),
    )
    assert made.steps == ()


def test_an_empty_description_has_nothing_to_plan() -> None:
    assert planned("images: {}\n") == Plan()
    assert planned("frame: {width: 8, height: 8}\ncommands: []\n") == Plan()


def test_a_pipeline_alone_is_a_frame_of_its_own() -> None:
    made = planned("pipelines: {p: {multisampleState: {rasterizationSamples: 8}}}\n")
    (pipeline,) = one(made).pipelines
    assert (one(made).kind, one(made).images) == (parts.FRAME, ())
    assert (pipeline.name, pipeline.subpass, pipeline.samples, pipeline.formats) == (
        "p",
        parts.NONE,
        8,
        (RGBA8,),
    )
    assert made.defaults == ("the attachments of p are not stated: R8G8B8A8_UNORM is assumed",)


@pytest.mark.parametrize(
    ("text", "usage"),
    [
        ("- readImage: {image: a}", SAMPLED),
        ("- writeImage: {image: a}", 8),
        ("- copyImageToBuffer: {srcImage: a}", SOURCE),
        ("- copyBufferToImage: {dstImage: a}", TARGET),
        ("- clearColorImage: {image: a}", TARGET),
        ("- clearDepthStencilImage: {image: a}", TARGET),
        ("- resolveImage: {srcImage: a, dstImage: b}", SOURCE),
        ("- resolveImage: {srcImage: b, dstImage: a}", TARGET),
        ("- copyImage: {srcImage: a, dstImage: b}", SOURCE),
        ("- blitImage: {srcImage: b, dstImage: a}", TARGET),
        ("- present: {image: a}", COLOR),
    ],
)
def test_a_usage_that_is_not_stated_is_what_the_commands_do(text: str, usage: int) -> None:
    images = (
        "images: {a: {format: R8G8B8A8_UNORM, samples: 1}, b: {format: R8G8B8A8_UNORM, "
        "samples: 1}}\n"
    )
    assert image(planned(f"{images}commands:\n  {text}\n"), "a").usage == usage
    stated = images.replace("samples: 1}", "samples: 1, usage: SAMPLED}", 1)
    assert image(planned(f"{stated}commands:\n  {text}\n"), "a").usage == SAMPLED


# What is not described


def test_everything_that_is_not_described_is_said_once() -> None:
    made = planned(
        """\
renderPasses:
  main:
    attachments: {c: {}, o: {}, d: {}, s: {}}
    subpasses: [{colorAttachments: [c], resolveAttachments: [o], depthStencilAttachment: d, depthStencilResolve: {attachment: s}}]
"""
    )
    assert [(each.name, each.format, each.samples, each.width,
    each.height) for each in made.images] == [
        ("main.c", RGBA8, 4, 256, 256), ("main.o", RGBA8, 1, 256, 256), ("main.d", D32, 4, 256,
        256), ("main.s", D32, 1, 256, 256),
    ]  # fmt: skip
    operations = [(each.load, each.store, each.initial) for each in one(made).attachments]
    assert operations == [(2, 0, UNDEFINED)] * 4
    expected = [
        "no format is stated for main.c and main.o: R8G8B8A8_UNORM is assumed",
        "no format is stated for main.d and main.s: D32_SFLOAT is assumed",
        "no sample count is stated for main.c and main.d: 4 is assumed",
        "no sample count is stated for main.o and main.s: 1 is assumed",
    ]
    expected += ["no size is stated: 256x256 is assumed"]
    for name in "cods":
        expected += [
            f"loadOp of renderPasses.main.attachments.{name} is not stated: DONT_CARE is assumed",
            f"storeOp of renderPasses.main.attachments.{name} is not stated: STORE is assumed",
        ]
    resolve = "renderPasses.main.subpasses[0].depthStencilResolve"
    expected += [f"depthResolveMode of {resolve} is not stated: SAMPLE_ZERO is assumed"]
    assert list(made.defaults) == expected


def test_formats_and_counts_come_from_partners() -> None:
    made = planned(
        """\
frame: {width: 8, height: 8}
images:
  ms: {samples: 8}
  one: {format: R16G16B16A16_SFLOAT}
  beside: {format: D32_SFLOAT}
  source: {format: R8G8B8A8_UNORM}
  target: {}
renderPasses:
  p:
    attachments:
      ms: {image: ms, loadOp: CLEAR, storeOp: STORE}
      one: {image: one, loadOp: DONT_CARE, storeOp: STORE}
      d: {image: beside, loadOp: CLEAR, storeOp: STORE}
    subpasses: [{colorAttachments: [ms], resolveAttachments: [one], depthStencilAttachment: d}]
commands:
  - resolveImage: {srcImage: source, dstImage: target}
"""
    )
    assert [(each.name, each.format, each.samples) for each in made.images] == [
        ("ms", RGBA16F, 8), ("one", RGBA16F, 1), ("beside", D32, 8), ("source", RGBA8, 4),
        ("target", RGBA8, 1),
    ]  # fmt: skip
    assert list(made.defaults) == [
        "no format is stated for ms: R16G16B16A16_SFLOAT is assumed",
        "no format is stated for target: R8G8B8A8_UNORM is assumed",
        "no sample count is stated for one and target: 1 is assumed",
        "no sample count is stated for beside: 8 is assumed",
        "no sample count is stated for source: 4 is assumed",
    ]


@pytest.mark.parametrize(
    ("image_of", "operations", "taken"),
    [
        ("format: R8G8B8A8_UNORM", "", {"loadOp": "DONT_CARE", "storeOp": "STORE"}),
        (
            "format: R8G8B8A8_UNORM, usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT",
            "",
            {"loadOp": "DONT_CARE", "storeOp": "DONT_CARE"},
        ),
        ("format: R8G8B8A8_UNORM", "loadOp: CLEAR", {"storeOp": "STORE"}),
        ("format: R8G8B8A8_UNORM", "loadOp: NONE, storeOp: NONE", {}),
        ("format: S8_UINT", "", {"stencilLoadOp": "DONT_CARE", "stencilStoreOp": "STORE"}),
        ("format: D32_SFLOAT", "storeOp: DONT_CARE", {"loadOp": "DONT_CARE"}),
        (
            "format: D24_UNORM_S8_UINT",
            "loadOp: CLEAR, stencilStoreOp: NONE",
            {"storeOp": "STORE", "stencilLoadOp": "DONT_CARE"},
        ),
    ],
)
def test_operations_that_are_not_stated_are_said(
    image_of: str, operations: str, taken: dict[str, str]
) -> None:
    slot = "colorAttachments: [a]" if "R8" in image_of else "depthStencilAttachment: a"
    made = planned(
        f"frame: {{width: 8, height: 8}}\nimages: {{i: {{{image_of}, samples: 4}}}}\n"
        f"renderPasses: {{p: {{attachments: {{a: {{image: i, {operations}}}}}, subpasses: "
        f"[{{{slot}}}]}}}}\n"
    )
    said = {
        word.split(" of ")[0]: word.removesuffix(" is assumed").rpartition(": ")[2]
        for word in made.defaults
    }
    assert said == taken
    (attachment,) = one(made).attachments
    got = {
        "loadOp": attachment.load,
        "storeOp": attachment.store,
        "stencilLoadOp": attachment.stencil_load,
        "stencilStoreOp": attachment.stencil_store,
    }
    loads, stores = (
        {"CLEAR": 1, "DONT_CARE": 2, "NONE": 1000400000},
        {"STORE": 0, "DONT_CARE": 1, "NONE": 1000301000},
    )
    stated = dict(each.split(": ") for each in operations.split(", ") if each)
    for member, name in {**taken, **stated}.items():
        assert got[member] == (loads if member.endswith("oadOp") else stores)[name], member


def test_the_size_is_the_frames_then_the_largest_stated() -> None:
    attachments = (
        "attachments: {c: {format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: "
        "STORE}}, subpasses: [{colorAttachments: [c]}]"
    )
    passes = f"renderPasses: {{p: {{{attachments}}}}}\n"
    sizes = {
        "frame: {width: 640, height: 480}\n": (640, 480),
        "frame: {fps: 60}\n": (256, 256),
        "framebuffers: {f: {renderPass: p, width: 64, height: 48}}\n": (64, 48),
        "images: {i: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 30, height: 20}}}\n": (
            30,
            20,
        ),
    }
    for text, size in sizes.items():
        made = planned(text + passes)
        target = image(made, "p.c")
        assert (target.width, target.height) == size, text
        assert ("no size is stated: 256x256 is assumed" in made.defaults) == (size == (256, 256))


def test_an_area_states_a_size() -> None:
    made = planned(
        """\
images: {a: {format: R8G8B8A8_UNORM, samples: 1}}
commands:
  - beginRendering: {renderArea: {width: 64, height: 48}, colorAttachments: [{image: a, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering
"""
    )
    assert (made.images[0].width, made.images[0].height) == (64, 48)
    assert made.defaults == ()
    other = (
        "images: {b: {format: R8G8B8A8_UNORM, samples: 1}, a: {format: R8G8B8A8_UNORM, "
        "samples: 1}}\n"
    )
    both = planned(
        other
        + "commands: [{beginRendering: {renderArea: {width: 64, height: 48}, colorAttachments: "
        "[{image: a}]}}]\n"
    )
    assert [(each.width, each.height) for each in both.images] == [(256, 256), (64, 48)]
    assert "no size is stated: 256x256 is assumed" in both.defaults


def test_modes_and_counts_of_resolves_that_are_not_stated_are_said() -> None:
    depth = planned(
        """\
frame: {width: 8, height: 8}
renderPasses:
  p:
    attachments: [{format: D24_UNORM_S8_UINT, samples: 4, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE},
                  {format: D24_UNORM_S8_UINT, samples: 1, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}]
    subpasses: [{depthStencilAttachment: 0, depthStencilResolve: {attachment: 1, stencilResolveMode: NONE}}]
"""
    )
    assert len(words(depth, "depthResolveMode", "SAMPLE_ZERO is assumed")) == 1
    assert words(depth, "stencilResolveMode") == []
    single = planned(
        """\
frame: {width: 8, height: 8}
images: {c: {format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  p:
    attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{colorAttachments: [c], multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: true}}]
"""
    )
    assert len(words(single, "rasterizationSamples", "4 is assumed")) == 1


# Framebuffers and areas


def test_a_framebuffer_is_what_its_images_have_in_common() -> None:
    made = planned(
        """\
images:
  a: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}}
  b: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 32, height: 128}}
renderPasses:
  p: {attachments: [{loadOp: CLEAR, storeOp: STORE}, {loadOp: CLEAR, storeOp: STORE}], subpasses: [{colorAttachments: [0, 1]}]}
framebuffers:
  one: {renderPass: p, attachments: [a, b], width: 16, height: 48, layers: 1}
  two: {renderPass: p, attachments: [b, a]}
commands:
  - beginRenderPass: {renderPass: p, framebuffer: one, renderArea: {x: 8, y: 8, width: 100, height: 4}}
  - endRenderPass
  - beginRenderPass: {renderPass: p, framebuffer: two, renderArea: {x: -5, y: 500, width: 4, height: 4}}
  - endRenderPass
  - beginRenderPass: {renderPass: p, framebuffer: [two, one]}
"""
    )
    each = one(made)
    assert each.framebuffers == (
        Framebuffer((0, 1), 16, 48, 1),
        Framebuffer((1, 0), 32, 64, 1),
        Framebuffer((1, 0), 32, 64, 1),
    )
    assert [(step.framebuffer, step.area) for step in begins(made)] == [
        (0, (8, 8, 8, 4)),
        (1, (0, 63, 4, 1)),
        (2, (0, 0, 32, 64)),
    ]
    assert made.defaults == (
        "p alternates between framebuffers: the first one is used",
        "the render area of p exceeds its images and is clipped to them",
    )


def test_the_only_framebuffer_of_a_pass_is_its_own() -> None:
    made = planned(
        f"renderPasses: {{p: {{attachments: {{c: {CLEARED}}}, subpasses: [{{colorAttachments: "
        f"[c]}}]}}}}\n"
        "framebuffers: {f: {renderPass: p, width: 16, height: 200, layers: 3}}\n"
    )
    assert one(made).framebuffers == (Framebuffer((0,), 16, 200, 3),)
    assert (made.images[0].width, made.images[0].height, made.images[0].layers) == (16, 200, 3)
    assert begins(made)[0].area == (0, 0, 16, 200)


# Dynamic rendering


RENDERING = """\
frame: {width: 64, height: 32}
images:
  c: {format: R16G16B16A16_SFLOAT, samples: 4}
  i: {format: R32_UINT, samples: 4, usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT}
  r: {format: R16G16B16A16_SFLOAT, samples: 1}
  ir: {format: R32_UINT, samples: 1}
  d: {format: D32_SFLOAT_S8_UINT, samples: 4}
  dr: {format: D32_SFLOAT_S8_UINT, samples: 1}
commands:
  - beginRendering:
      flags: [SUSPENDING, CONTENTS_SECONDARY_COMMAND_BUFFERS]
      renderArea: {x: 8, y: 4, width: 16, height: 16}
      colorAttachments:
        - {image: c, resolveImage: r}
        - null
        - {image: i, resolveImage: ir, loadOp: CLEAR, imageLayout: GENERAL, resolveImageLayout: GENERAL}
      depthAttachment: {image: d, resolveImage: dr, loadOp: CLEAR, storeOp: STORE}
  - draw: {}
  - endRendering
"""


def test_a_dynamic_rendering_is_planned_whole() -> None:
    made = planned(RENDERING)
    each = one(made)
    assert (each.name, each.path, each.kind, each.api) == (
        "rendering0",
        "commands[0].beginRendering",
        "rendering",
        0,
    )
    assert (each.attachments, each.subpasses, each.flags) == ((), (), 2)
    assert each.rendered == (
        RenderTarget("color", 0, COLOR_LAYOUT, 2, 2, COLOR_LAYOUT, 2, 0),
        RenderTarget("color"),
        RenderTarget("color", 1, GENERAL, 1, 3, GENERAL, 1, 1),
        RenderTarget("depth", 4, DEPTH_LAYOUT, 1, 5, DEPTH_LAYOUT, 1, 0),
    )
    assert each.framebuffers == (Framebuffer((0, 2, 1, 3, 4, 5), 64, 32, 1),)
    (pipeline,) = each.pipelines
    assert (pipeline.formats, pipeline.depth_format, pipeline.stencil_format) == (
        (RGBA16F, 0, R32_UINT),
        D32S8,
        0,
    )
    assert (pipeline.numerics, pipeline.samples) == (("SFLOAT", "", "UINT"), 4)
    assert (pipeline.depth_test, pipeline.depth_write, pipeline.stencil_test) == (True, True, False)
    assert made.steps == (
        Step(
            "begin", 0, 0, (8, 4, 16, 16), (PassCommand("draw", 0, 0, backdrop=True, covers=True),)
        ),
    )
    begin = "commands[0].beginRendering"
    assert list(made.defaults) == [
        f"loadOp of {begin}.colorAttachments[0] is not stated: DONT_CARE is assumed",
        f"storeOp of {begin}.colorAttachments[0] is not stated: STORE is assumed",
        f"resolveMode of {begin}.colorAttachments[0] is not stated: AVERAGE is assumed",
        f"storeOp of {begin}.colorAttachments[2] is not stated: DONT_CARE is assumed",
        f"resolveMode of {begin}.colorAttachments[2] is not stated: SAMPLE_ZERO is assumed",
        f"resolveMode of {begin}.depthAttachment is not stated: SAMPLE_ZERO is assumed",
    ]


def test_renderings_are_passes_in_the_order_they_begin() -> None:
    made = planned(
        """\
images:
  a: {format: R8G8B8A8_UNORM, samples: 4}
  d: {format: D24_UNORM_S8_UINT, samples: 4, arrayLayers: 2}
commands:
  - beginRendering: {colorAttachments: [{image: a, loadOp: CLEAR, storeOp: STORE, resolveMode: NONE}], layerCount: 1}
  - endRendering
  - beginRendering:
      layerCount: 2
      viewMask: 3
      depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE, imageLayout: DEPTH_STENCIL_READ_ONLY_OPTIMAL}
      stencilAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}
  - endRendering
"""
    )
    first, second = made.passes
    assert (first.name, second.name, second.path) == (
        "rendering0",
        "rendering1",
        "commands[2].beginRendering",
    )
    assert (second.layers, second.view_mask, second.framebuffers) == (
        2,
        3,
        (Framebuffer((1, 1), 256, 256, 2),),
    )
    assert [each.role for each in second.rendered] == ["depth", "stencil"]
    (pipeline,) = second.pipelines
    assert (pipeline.depth_format, pipeline.stencil_format, pipeline.view_mask) == (D24S8, D24S8, 3)
    assert (pipeline.depth_test, pipeline.depth_write, pipeline.stencil_test) == (
        True,
        False,
        False,
    )
    assert [step.number for step in made.steps] == [0, 1]


def test_a_rendering_tests_what_is_attached() -> None:
    text = """\
images: {d: {format: D24_UNORM_S8_UINT, samples: 4}, c: {format: R8G8B8A8_UNORM, samples: 4}}
commands:
  - beginRendering:
      colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}, null]
      stencilAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}
  - endRendering
"""
    made = planned(text)
    (pipeline,) = one(made).pipelines
    assert (pipeline.depth_format, pipeline.stencil_format) == (0, D24S8)
    assert (pipeline.depth_test, pipeline.depth_write, pipeline.stencil_test) == (
        False,
        False,
        True,
    )
    # What is unused is not in need of a backdrop.
    assert made.steps[0].inner == (PassCommand("draw", 0, 0, draws=0),)


def test_depth_and_stencil_of_two_images_are_refused() -> None:
    text = """\
images: {d: {format: D32_SFLOAT, samples: 4}, s: {format: S8_UINT, samples: 4}}
commands:
  - beginRendering:
      depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}
      stencilAttachment: {image: s, loadOp: CLEAR, storeOp: STORE}
  - endRendering
"""
    assert one(planned(text)).refused == "its depth and stencil attachments are different images"
    assert (
        one(
            planned(
                text.replace("{image: s,", "{image: d,").replace("D32_SFLOAT", "D24_UNORM_S8_UINT")
            )
        ).refused
        == ""
    )


# Several samples rendered to one


def test_a_subpass_may_render_several_samples_to_one() -> None:
    made = planned(
        """\
images: {c: {format: R8G8B8A8_UNORM, samples: 1, flags: [MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT]}}
renderPasses:
  p:
    attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}
    subpasses:
      - {colorAttachments: [c], multisampledRenderToSingleSampled: {rasterizationSamples: 8}}
      - {colorAttachments: [c], multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: true}}
      - colorAttachments: [c]
        multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: false, rasterizationSamples: 2}
"""
    )
    assert made.extensions == ("VK_EXT_multisampled_render_to_single_sampled",)
    assert (made.images[0].samples, made.images[0].flags) == (1, 0x40000)
    assert [subpass.single_sampled for subpass in one(made).subpasses] == [8, 4, 0]
    assert [pipeline.samples for pipeline in one(made).pipelines] == [8, 4, 1]


def test_a_rendering_may_render_several_samples_to_one() -> None:
    made = planned(
        """\
images: {c: {format: R8G8B8A8_UNORM, samples: 1}}
commands:
  - beginRendering:
      colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]
      multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: true, rasterizationSamples: 4}
  - endRendering
"""
    )
    assert made.extensions == ("VK_EXT_multisampled_render_to_single_sampled",)
    assert (one(made).single_sampled, one(made).pipelines[0].samples) == (4, 4)


@pytest.mark.parametrize(
    ("enabled", "extensions", "without"),
    [
        ("", (), ()),
        ("enabled: {extensions: [VK_KHR_swapchain, VK_EXT_sample_locations]}", (), ()),
        ("enabled: {extensions: [VK_NV_framebuffer_mixed_samples, "
            "VK_AMD_mixed_attachment_samples]}",
         ("VK_AMD_mixed_attachment_samples", "VK_NV_framebuffer_mixed_samples"), ()),
        ("enabled: {extensions: [VK_EXT_multisampled_render_to_single_sampled]}",
        ("VK_EXT_multisampled_render_to_single_sampled",), ()),
        ("enabled: {features: [multisampledRenderToSingleSampled, sampleRateShading]}",
         ("VK_EXT_multisampled_render_to_single_sampled",), ("alphaToOne",)),
        ("enabled: {features: []}", (), ("sampleRateShading", "alphaToOne")),
        ("enabled: {features: [alphaToOne, sampleRateShading]}", (), ()),
    ],
)  # fmt: skip
def test_a_device_is_opened_with_what_the_application_enables(
    enabled: str, extensions: tuple[str, ...], without: tuple[str, ...]
) -> None:
    made = planned(f"{enabled}\n{PLAIN}")
    assert (made.extensions, made.without) == (extensions, without)


# Pipelines


PIPELINES = """\
frame: {width: 64, height: 64}
scene: {depth: REVERSED, color: HDR}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  d: {format: D32_SFLOAT_S8_UINT, samples: 4}
renderPasses:
  p:
    attachments:
      c: {image: ms, loadOp: DONT_CARE, storeOp: STORE}
      d: {image: d, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
pipelines:
  one:
    renderPass: p
    multisampleState: {rasterizationSamples: 2, sampleShadingEnable: true, minSampleShading: 0.25, sampleMask: [5],
                       alphaToCoverageEnable: true, alphaToOneEnable: true}
    colorBlendState:
      attachments:
        - {blendEnable: true, srcColorBlendFactor: ONE, dstColorBlendFactor: ZERO, colorBlendOp: MAX, srcAlphaBlendFactor: ZERO,
           dstAlphaBlendFactor: ONE, alphaBlendOp: MIN, colorWriteMask: R | B}
        - {}
    depthStencilState: {depthTestEnable: true, depthWriteEnable: false, depthCompareOp: GREATER_OR_EQUAL, stencilTestEnable: false}
    rasterizationState: {depthClampEnable: true, depthBiasEnable: true, polygonMode: LINE, rasterizerDiscardEnable: false}
    vertexInputState: {vertexBindingDescriptions: [{binding: 0, stride: 4}]}
    dynamicState: [SCISSOR, RASTERIZATION_SAMPLES_EXT, LINE_WIDTH, SAMPLE_MASK_EXT, VIEWPORT, ALPHA_TO_COVERAGE_ENABLE_EXT]
    stages:
      - {stage: VERTEX, module: none.spv}
      - {stage: FRAGMENT, module: shaders/f.spv, name: shade, specialization: {3: 4, 7: true, 9: 0.5}}
  two: {renderPass: p, rasterizationState: {rasterizerDiscardEnable: true}}
"""


def test_pipelines_are_as_described(tmp_path: Path) -> None:
    (tmp_path / "shaders").mkdir()
    # An entry point `shade` with three specialization constants.
    kinds = (
        (21, 5, 32, 1),
        (20, 6),
        (22, 7, 32),
        (50, 5, 20, 0),
        (48, 6, 21),
        (50, 7, 22, 0),
        (19, 2),
        (33, 3, 2),
    )
    entry = (15, 4, 1, *struct.unpack("<2I", b"shade\0\0\0"))
    shader = assembled(
        entry,
        *((71, 20 + n, 1, spec) for n, spec in enumerate((3, 7, 9))),
        *kinds,
        (54, 2, 1, 0, 3),
        (56,),
    )
    (tmp_path / "shaders" / "f.spv").write_bytes(shader)
    made = planned(PIPELINES, file=str(tmp_path / "frame.msaa.yaml"))
    one_of, two = one(made).pipelines
    assert one_of == parts.Pipeline(
        "one", 0, 2, sample_shading=0.25, mask=(5,), alpha_to_coverage=True, alpha_to_one=True,
        dynamic=(0, 1, 1000455005, 1000455006, 1000455007), depth_test=True, depth_write=False,
        depth_compare=6, stencil_test=False,
        blends=(Blend(True, 5, 1, 0, 4, 0, 1, 3),), numerics=("UNORM",), depth_clamp=True,
        depth_bias=True, polygon_mode=1,
        stages=(
            parts.Stage(16, str(tmp_path / "shaders" / "f.spv"), "shade", ((3, 4.0), (7, 1.0), (9,
            0.5)), version=(1, 3)),
            one_of.stages[1],
        ),
    )  # fmt: skip
    assert (one_of.stages[1].stage, one_of.stages[1].path) == (1, "")
    assert two == parts.Pipeline(
        "two", 0, 4, dynamic=(0, 1), depth_test=True, depth_write=True, depth_compare=4,
        stencil_test=True, blends=(Blend(),),
        numerics=("UNORM",), discard=True,
    )  # fmt: skip
    assert made.reversed and made.hdr
    assert list(made.defaults) == [
        "the vertex shader of one does not exist: a built-in one is used",
        "the vertex input of one is ignored: the built-in shader has its own vertices",
        "the dynamic state LINE_WIDTH of one is ignored",
    ]


def test_a_shader_is_looked_for_beside_the_description(tmp_path: Path) -> None:
    made = planned(PIPELINES, file=str(tmp_path / "frame.msaa.yaml"))
    assert one(made).pipelines[0].stages == ()
    assert "the fragment shader of one does not exist: a built-in one is used" in made.defaults


def test_a_blend_that_is_left_open_is_the_usual_one() -> None:
    pipelines = (
        "pipelines: {x: {renderPass: p, colorBlendState: {attachments: [{blendEnable: true}]}}}\n"
    )
    (pipeline,) = one(planned(PLAIN + pipelines)).pipelines
    assert pipeline.blends == (Blend(True, 15, 6, 7, 0, 1, 7, 0),)


@pytest.mark.parametrize("state, least", [("sampleShadingEnable: true", 1.0),
("sampleShadingEnable: true, minSampleShading: 0", 0.0),
                                          ("sampleShadingEnable: false, minSampleShading: 0.5",
                                          -1.0), ("", -1.0)])  # fmt: skip
def test_sample_shading_has_its_share(state: str, least: float) -> None:
    (pipeline,) = one(
        planned(f"{PLAIN}pipelines: {{x: {{renderPass: p, multisampleState: {{{state}}}}}}}\n")
    ).pipelines
    assert (pipeline.sample_shading, pipeline.samples) == (least, 4)


def test_a_pipeline_of_no_pass_has_the_formats_that_it_states() -> None:
    made = planned(
        "pipelines: {x: {rendering: {colorAttachmentFormats: [R16G16B16A16_SFLOAT, "
        "R8G8B8A8_UNORM], depthAttachmentFormat: D32_SFLOAT,"
        " stencilAttachmentFormat: S8_UINT, viewMask: 3}, multisampleState: {rasterizationSamples: "
        "4}}}\n"
    )
    (pipeline,) = one(made).pipelines
    assert (pipeline.formats, pipeline.depth_format, pipeline.stencil_format) == (
        (RGBA16F, RGBA8),
        D32,
        127,
    )
    assert (pipeline.subpass, pipeline.samples, pipeline.view_mask, len(pipeline.blends)) == (
        parts.NONE,
        4,
        3,
        2,
    )
    assert made.defaults == ()


def test_the_outputs_of_a_pipeline_of_no_pass_are_of_its_formats() -> None:
    made = planned(
        "pipelines: {x: {rendering: {colorAttachmentFormats: [R32_UINT, null, R8_SINT, "
        "R8G8B8A8_UNORM]}}}\n"
    )
    (pipeline,) = one(made).pipelines
    assert pipeline.formats == (R32_UINT, 0, 14, RGBA8)
    assert [
        numeric if numeric in ("UINT", "SINT", "") else "float" for numeric in pipeline.numerics
    ] == ["UINT", "", "SINT", "float"]


def test_a_pipeline_of_depth_alone_has_no_colours() -> None:
    (pipeline,) = one(
        planned("pipelines: {x: {rendering: {depthAttachmentFormat: D32_SFLOAT}}}\n")
    ).pipelines
    assert (pipeline.formats, pipeline.blends, pipeline.numerics, pipeline.depth_format) == (
        (),
        (),
        (),
        D32,
    )


def test_a_rendering_draws_with_the_pipelines_that_it_names() -> None:
    made = planned(
        """\
images: {c: {format: R8G8B8A8_UNORM, samples: 4}}
pipelines:
  x: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}, multisampleState: {rasterizationSamples: 4}}
  y: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}}
commands:
  - beginRendering: {colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]}
  - draw: {}
  - draw: {pipeline: y}
  - draw: {pipeline: x}
  - draw: {pipeline: y}
  - endRendering
"""
    )
    assert [pipeline.name for pipeline in one(made).pipelines] == ["built-in 0", "y", "x"]
    assert [inner.pipeline for inner in made.steps[0].inner] == [0, 1, 2, 1]
    # Its count is not stated: it is that of what it draws to.
    assert [pipeline.samples for pipeline in one(made).pipelines] == [4, 4, 4]


# Commands


COMMANDS = """\
frame: {width: 32, height: 16}
images:
  a: {format: R8G8B8A8_UNORM, samples: 4, usage: COLOR_ATTACHMENT | TRANSFER_SRC | SAMPLED}
  b: {format: R8G8B8A8_UNORM, samples: 1}
  c: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
renderPasses:
  p:
    attachments: {a: {image: a, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{colorAttachments: [a]}, {colorAttachments: [a]}]
  q:
    attachments: {c: {image: c, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{colorAttachments: [c]}]
pipelines:
  x: {renderPass: p, subpass: 1, multisampleState: {sampleMask: [5]}}
commands:
  - clearColorImage: {image: b}
  - beginRenderPass: {renderPass: p}
  - draw: {}
  - nextSubpass
  - setRasterizationSamples: 2
  - clearAttachments: {attachments: [{aspect: COLOR, colorAttachment: 0}]}
  - draw: {pipeline: x}
  - endRenderPass
  - pipelineBarrier: {srcStageMask: COLOR_ATTACHMENT_OUTPUT, dstStageMask: COPY, srcAccessMask: COLOR_ATTACHMENT_WRITE,
      dstAccessMask: TRANSFER_READ, images: [{image: a, oldLayout: COLOR_ATTACHMENT_OPTIMAL, newLayout: TRANSFER_SRC_OPTIMAL}, b]}
  - pipelineBarrier: {}
  - resolveImage: {srcImage: a, dstImage: b}
  - copyImage: {srcImage: b, dstImage: c}
  - blitImage: {srcImage: b, dstImage: c}
  - copyImageToBuffer: {srcImage: c}
  - copyBufferToImage: {dstImage: b}
  - writeImage: {image: b}
  - readImage: {image: b}
  - beginRenderPass: {renderPass: q}
  - readImage: {image: b}
  - readImage: {image: a, stage: FRAGMENT_SHADER}
  - readImage: {image: a, stage: COMPUTE_SHADER}
  - readImage: {image: c}
  - pipelineBarrier: {}
  - endRenderPass
  - present: {image: c}
"""


def test_commands_are_recorded_in_their_order() -> None:
    made = planned(COMMANDS)
    p, q = made.passes
    assert [pipeline.name for pipeline in p.pipelines] == ["x", "built-in 0"]
    assert [pipeline.name for pipeline in q.pipelines] == ["built-in 0"]
    a, b, c = range(3)
    within = (
        PassCommand("draw", 0, 1),
        PassCommand("samples", 1, value=2),
        PassCommand("clear", 1, aspects=parts.COLOR),
        PassCommand("draw", 1, 0),
    )
    # The dynamic sample count outlives the first pass.
    reads = (
        PassCommand("read", 0, image=b),
        PassCommand("read", 0, image=a),
        PassCommand("samples", 0, value=2),
        PassCommand("draw", 0, 0, draws=0),
    )
    assert made.steps == (
        Step("clear", 0, source=b, target=b),
        Step("begin", 0, 0, (0, 0, 32, 16), within),
        Step(
            "barrier",
            0,
            masks=(0x400, 1 << 32, 0x100, 0x800),
            layouts=((a, COLOR_LAYOUT, SOURCE_LAYOUT), (b, -1, -1)),
        ),
        Step("barrier", 0, masks=(0, 0, 0, 0)),
        Step("resolve", 0, source=a, target=b),
        Step("copy", 0, source=b, target=c),
        Step("blit", 0, source=b, target=c),
        Step("copyOut", 0, source=c),
        Step("copyIn", 0, target=b),
        Step("read", 0, source=b),
        Step("read", 1, source=a),
        Step("read", 1, source=c),
        Step("begin", 1, 0, (0, 0, 32, 16), reads),
        Step("present", 1, source=c, target=c),
    )
    assert (p.images, q.images) == ((a, b, c), (a, b, c))
    assert list(made.defaults) == [
        "writeImage outside a pass is ignored",
        "readImage outside a pass is ignored",
        "a barrier within a pass is ignored",
    ]


def test_what_is_read_later_is_left_to_be_read() -> None:
    made = planned(
        """\
images: {c: {format: R8G8B8A8_UNORM, samples: 4}, d: {format: D32_SFLOAT, samples: 4}, o: {format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  p:
    attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}, d: {image: d, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
  q: {attachments: {o: {image: o, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [o]}]}
commands:
  - beginRenderPass: {renderPass: p}
  - endRenderPass
  - beginRenderPass: {renderPass: q}
  - readImage: {image: c, stage: FRAGMENT}
  - readImage: {image: d}
  - endRenderPass
"""
    )
    p, q = made.passes
    assert [each.final for each in p.attachments] == [READ_LAYOUT, DEPTH_READ_LAYOUT]
    assert [each.final for each in q.attachments] == [COLOR_LAYOUT]


def test_a_pass_that_never_begins_is_created_and_not_drawn() -> None:
    made = planned(PLAIN + "pipelines: {x: {renderPass: p}}\ncommands: []\n")
    assert made.steps == ()
    assert [pipeline.name for pipeline in one(made).pipelines] == ["x"]
    assert one(made).images == (0,)


def test_a_pass_that_never_ends_is_drawn_to_the_end() -> None:
    made = planned(
        PLAIN + "commands: [{beginRenderPass: {renderPass: p}}, {draw: {}}, {draw: {}}]\n"
    )
    (step,) = made.steps
    assert step.inner == (PassCommand("draw", 0, 0), PassCommand("draw", 0, 0))


def test_subpasses_beyond_the_last_are_the_last() -> None:
    commands = (
        "commands: [{beginRenderPass: {renderPass: p}}, nextSubpass, nextSubpass, {draw: "
        "{}}, endRenderPass, nextSubpass]\n"
    )
    (step,) = planned(PLAIN + commands).steps
    assert step.inner == (PassCommand("draw", 0, 0),)


def test_every_pipeline_of_a_subpass_draws_where_no_draw_is_described() -> None:
    pipelines = "".join(f"  x{number}: {{renderPass: p}}\n" for number in range(10))
    made = planned(f"{PLAIN}pipelines:\n{pipelines}")
    (step,) = made.steps
    assert step.inner == tuple(PassCommand("draw", 0, number, draws=0) for number in range(8))
    assert len(one(made).pipelines) == 10


def test_a_pipeline_that_discards_everything_has_one_beside_it_that_draws() -> None:
    made = planned(
        f"{PLAIN}pipelines: {{x: {{renderPass: p, rasterizationState: {{rasterizerDiscardEnable: "
        f"true}}}}}}\n"
    )
    assert [(pipeline.name, pipeline.discard) for pipeline in one(made).pipelines] == [
        ("x", True),
        ("built-in 0", False),
    ]
    assert made.steps[0].inner == (
        PassCommand("draw", 0, 0, draws=0),
        PassCommand("draw", 0, 1, draws=0),
    )


def test_commands_beyond_a_limit_are_left_out() -> None:
    images = "images: {a: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 8, height: 8}}}\n"
    few = planned(f"{images}commands: [{', '.join(['{present: {image: a}}'] * MAX_STEPS)}]\n")
    assert (len(few.steps), few.defaults) == (MAX_STEPS, ())
    many = planned(
        f"{images}commands: [{', '.join(['{present: {image: a}}'] * (MAX_STEPS + 100))}]\n"
    )
    assert len(many.steps) <= MAX_STEPS + 1
    assert many.defaults == ("commands after the first 4096 are ignored",)


@pytest.mark.parametrize(
    ("load", "pipeline", "backdrop", "covers"),
    [
        ("DONT_CARE", "", True, True),
        ("CLEAR", "", False, False),
        ("LOAD", "", False, False),
        ("NONE", "", True, True),
        ("DONT_CARE", "multisampleState: {alphaToCoverageEnable: true}", True, False),
        ("DONT_CARE", "multisampleState: {sampleMask: [7]}", True, False),
        ("DONT_CARE", "multisampleState: {sampleMask: [15]}", True, True),
        ("DONT_CARE", "multisampleState: {sampleMask: [4294967295]}", True, True),
        ("DONT_CARE", "colorBlendState: {attachments: [{blendEnable: true}]}", True, False),
        ("DONT_CARE", "colorBlendState: {attachments: [{colorWriteMask: R | G | B}]}", True, False),
    ],
)
def test_what_is_neither_kept_nor_cleared_gets_a_backdrop(
    load: str, pipeline: str, backdrop: bool, covers: bool
) -> None:
    pipelines = f"pipelines: {{x: {{renderPass: p, {pipeline}}}}}\n" if pipeline else ""
    (step,) = planned(PLAIN.replace("CLEAR", load) + pipelines).steps
    (draw,) = step.inner
    assert (draw.backdrop, draw.covers) == (backdrop, covers)


@pytest.mark.parametrize(
    ("depth", "state", "scene", "covers"),
    [
        ("CLEAR", "", "", True),
        ("CLEAR", "", "scene: {depth: REVERSED}", True),
        ("LOAD", "", "", False),
        ("DONT_CARE", "", "", False),
        ("LOAD", "depthTestEnable: false", "", True),
        ("LOAD", "depthTestEnable: true, depthCompareOp: ALWAYS", "", True),
        ("CLEAR", "depthTestEnable: true, depthCompareOp: LESS_OR_EQUAL", "", True),
        (
            "CLEAR",
            "depthTestEnable: true, depthCompareOp: LESS_OR_EQUAL",
            "scene: {depth: REVERSED}",
            False,
        ),
        ("CLEAR", "depthTestEnable: true, depthCompareOp: GREATER", "", False),
        (
            "CLEAR",
            "depthTestEnable: true, depthCompareOp: GREATER",
            "scene: {depth: REVERSED}",
            True,
        ),
        ("CLEAR", "depthTestEnable: true, depthCompareOp: NEVER", "", False),
    ],
)
def test_a_backdrop_covers_where_depth_lets_it(
    depth: str, state: str, scene: str, covers: bool
) -> None:
    made = planned(
        f"""\
{scene}
renderPasses:
  p:
    attachments: [{{format: R8G8B8A8_UNORM, samples: 4, loadOp: DONT_CARE, storeOp: STORE}},
                  {{format: D32_SFLOAT, samples: 4, loadOp: {depth}, storeOp: STORE}}]
    subpasses: [{{colorAttachments: [0], depthStencilAttachment: 1}}]
pipelines: {{x: {{renderPass: p, depthStencilState: {{{state}}}}}}}
"""
    )
    (draw,) = made.steps[0].inner
    assert (draw.backdrop, draw.covers) == (True, covers)


# Other sizes and counts


def test_a_size_that_is_asked_for_is_that_of_the_largest_pass() -> None:
    made = planned(INLINE, size=(32, 32))
    assert one(made).framebuffers == (Framebuffer((0, 1, 2), 32, 32, 1),)
    assert {(each.width, each.height) for each in made.images} == {(32, 32)}
    assert begins(made)[0].area == (0, 0, 32, 32)


def test_a_count_that_is_asked_for_is_everywhere() -> None:
    made = planned(
        INLINE
        + "pipelines: {x: {renderPass: main, multisampleState: {rasterizationSamples: 4}}}\n",
        samples=8,
    )
    assert [each.samples for each in made.images] == [8, 8, 1]
    assert [each.samples for each in one(made).attachments] == [8, 8, 1]
    assert [each.samples for each in one(made).pipelines] == [8]
    assert one(made).subpasses == one(planned(INLINE)).subpasses


def test_one_sample_draws_to_what_it_resolves_to() -> None:
    made = planned(INLINE, samples=1)
    assert [each.samples for each in made.images] == [1, 1, 1]
    (subpass,) = one(made).subpasses
    assert (subpass.colors, subpass.resolves) == ((Reference(2, COLOR_LAYOUT),), ())
    shown = one(made).attachments[2]
    assert (shown.samples, shown.load, shown.store, shown.initial, shown.final) == (
        1,
        1,
        0,
        UNDEFINED,
        PRESENT_LAYOUT,
    )
    assert [each.samples for each in one(made).pipelines] == [1]


def test_one_sample_makes_a_copy_of_a_resolve() -> None:
    made = planned(COMMANDS, samples=1)
    kinds = [step.kind for step in made.steps]
    before = ["clear", "begin", "barrier", "barrier", "copy", "copy", "blit", "copyOut", "copyIn"]
    assert kinds == [*before, "read", "read", "read", "begin", "present"]


# Laws


@pytest.mark.parametrize("example", all_examples(), ids=str)
def test_every_example_of_the_catalogue_is_planned_and_carried(example: Example) -> None:
    for found in frames(example.text):
        for arguments in ({}, {"size": (48, 80)}, {"samples": 1}, {"samples": 2}, {"api": 1}):
            made = plan(found, file="folder/frame.msaa.yaml", **arguments)
            assert from_json(json.loads(json.dumps(made))) == made
            assert len(made.passes) == max(
                len(found.passes), min(1, len(made.images) + len(found.pipelines))
            )
            sound(made)


def sound(made: Plan) -> None:
    """Every number of a plan leads somewhere."""
    images = range(len(made.images))
    for each in made.passes:
        assert set(each.images) <= set(images)
        assert all(set(framebuffer.images) <= set(each.images) for framebuffer in each.framebuffers)
        attachments = range(len(each.attachments))
        for subpass in each.subpasses:
            references = (
                *subpass.inputs,
                *subpass.colors,
                *subpass.resolves,
                *subpass.depth_stencil,
                *subpass.depth_resolve,
            )
            assert {reference.attachment for reference in references} - {parts.NONE} <= set(
                attachments
            )
            assert set(subpass.preserves) <= set(attachments)
            assert not subpass.resolves or len(subpass.resolves) == len(subpass.colors)
        assert all(
            len(framebuffer.images) == len(each.attachments)
            for framebuffer in each.framebuffers
            if each.kind == parts.RENDER_PASS
        )
        for pipeline in each.pipelines:
            assert len(pipeline.numerics) == len(pipeline.blends)
            assert pipeline.samples in (1, 2, 4, 8, 16, 32, 64)
    # Barriers alone need no pass, and are recorded with none.
    for step in made.steps if made.passes else ():
        each = made.passes[step.number]
        assert {step.source, step.target, *(inner.image for inner in step.inner)} - {
            parts.NONE
        } <= set(each.images)
        if step.kind == "begin":
            framebuffer = each.framebuffers[step.framebuffer]
            x, y, width, height = step.area
            assert min(x, y) >= 0 < min(width, height)
            assert x + width <= framebuffer.width and y + height <= framebuffer.height
            for number in framebuffer.images:
                assert (
                    framebuffer.width <= made.images[number].width
                    and framebuffer.height <= made.images[number].height
                )
            drawn = [inner for inner in step.inner if inner.kind == "draw"]
            assert all(
                each.pipelines[inner.pipeline].subpass == inner.subpass
                for inner in drawn
                if each.kind == parts.RENDER_PASS
            )
            assert [inner.subpass for inner in step.inner] == sorted(
                inner.subpass for inner in step.inner
            )


ARGUMENTS = st.fixed_dictionaries(
    {},
    optional={
        "size": st.tuples(st.integers(1, 600), st.integers(1, 600)),
        "samples": st.sampled_from([1, 2, 4, 8]),
        "api": st.sampled_from([1, 2]),
    },
)


@examples(1.5, suppress_health_check=list(HealthCheck))
@given(random_frames(), ARGUMENTS)
def test_any_description_is_planned(description: Any, arguments: dict[str, Any]) -> None:
    source = Source("frame.msaa.yaml", json.dumps(description))
    (root,) = parse(source, Limits()).documents
    made = plan(Frame(readers.read(source, root)), **arguments)
    assert from_json(json.loads(json.dumps(made))) == made
    sound(made)


@pytest.mark.parametrize(
    "data",
    [[], [1] * 10, {"passes": [{}]}, ["", [], [[1]], *[[]] * 4, False, False, ""], [[[]] * 10]],
)
def test_what_is_no_plan_is_refused(data: Any) -> None:
    with pytest.raises((KeyError, TypeError, ValueError)):
        from_json(data)


def test_notes_that_differ_in_a_name_are_one() -> None:
    pipelines = "".join(
        f"  p{n}: {{dynamicState: [VIEWPORT_WITH_COUNT, LINE_WIDTH, DEPTH_BIAS]}}\n"
        for n in range(6)
    )
    made = planned(f"pipelines:\n{pipelines}commands: []\n")
    assert (
        "the dynamic states LINE_WIDTH, DEPTH_BIAS of p0, p1, p2 and 3 more are ignored"
        in made.defaults
    )


def test_layouts_usages_and_flags_of_extensions_are_replaced() -> None:
    """A device without these extensions would reject them, whatever the frame is about."""
    made = planned(
        """\
frame: {width: 8, height: 8}
images:
  c:
    format: R8G8B8A8_UNORM
    samples: 1
    flags: [SPARSE_BINDING, MUTABLE_FORMAT]
    usage: [COLOR_ATTACHMENT, HOST_TRANSFER, ATTACHMENT_FEEDBACK_LOOP_EXT]
renderPasses:
  p:
    attachments:
      c:
        {image: c, loadOp: CLEAR, storeOp: STORE, initialLayout: PREINITIALIZED, finalLayout: ATTACHMENT_FEEDBACK_LOOP_OPTIMAL_EXT}
    subpasses: [{colorAttachments: [{attachment: c, layout: RENDERING_LOCAL_READ}]}]
"""
    )
    assert (image(made, "c").usage, image(made, "c").flags) == (parts.COLOR_ATTACHMENT, 0x8)
    attachment = one(made).attachments[0]
    assert (attachment.initial, attachment.final, one(made).subpasses[0].colors[0].layout) == (
        GENERAL,
    ) * 3
    assert made.defaults == (
        "the usages HOST_TRANSFER, ATTACHMENT_FEEDBACK_LOOP_EXT of c are ignored",
        "the flag SPARSE_BINDING of c is ignored",
    )


@pytest.mark.parametrize("stages", [["FRAGMENT", "VERTEX"], ["VERTEX", "FRAGMENT"]])
def test_a_fragment_shader_gets_a_vertex_shader_that_writes_its_inputs(
    stages: list[str], tmp_path: Path
) -> None:
    """The vertex shader of the description reads vertices that are not described."""
    shaders = ROOT / "msaa_lint" / "experiments" / "confirm" / "shaders"
    for stage in stages:
        (tmp_path / f"{stage}.spv").write_bytes(
            (shaders / f"scene.{stage[:4].lower()}.spv").read_bytes()
        )
    listed = ", ".join(f"{{stage: {stage}, module: {stage}.spv}}" for stage in stages)
    made = planned(
        f"pipelines:\n  p: {{stages: [{listed}]}}\n", file=str(tmp_path / "frame.msaa.yaml")
    )
    fragment, vertex = one(made).pipelines[0].stages
    assert (fragment.stage, fragment.path, vertex.stage, vertex.path) == (
        16,
        str(tmp_path / "FRAGMENT.spv"),
        1,
        "",
    )
    written = Module(parts.unpacked(vertex.code))
    assert [
        each.type
        for each in interface(written, written.entry("main"), Constants(written, {})).outputs
    ] == ["vec4"]
    assert (
        "the vertex shader of p has inputs, which are not described: a built-in one is used"
        in made.defaults
    )
