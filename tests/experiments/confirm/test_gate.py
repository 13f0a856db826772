"""The gate: what a device says that it cannot do is refused before a driver is asked, and nothing
else is.
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm import parts
from msaa_lint.experiments.confirm.gate import gate
from msaa_lint.experiments.confirm.parts import Framebuffer, Pass, Plan
from msaa_lint.experiments.confirm.plan import plan
from msaa_lint.experiments.confirm.session import Session
from tests.experiments.confirm.frames import frames, planned
from tests.frames import frames as random_frames
from tests.pages import Example, all_examples
from tests.strength import examples

ONE = "format: R8G8B8A8_UNORM, samples: 1"
LIMITS = ("properties", "limits")
RESOLVES = "VkPhysicalDeviceVulkan12Properties"
VERSIONS = {
    (1, 0): 1 << 22,
    (1, 1): 1 << 22 | 1 << 12,
    (1, 2): 1 << 22 | 2 << 12,
    (1, 3): 1 << 22 | 3 << 12,
}
SINGLE = "VK_EXT_multisampled_render_to_single_sampled"


@pytest.fixture(scope="module")
def device() -> Iterator[dict[str, Any]]:
    """lavapipe, as it describes itself: 1 and 4 samples, no resolves of depth and stencil apart."""
    with Session(None, validation=False, vendors=()) as session:
        found = session.open()
        assert found["properties"]["deviceName"].startswith("llvmpipe")
        assert found["properties"]["limits"]["framebufferColorSampleCounts"] == 5
        kept = copy.deepcopy(found)
        yield found
        assert found == kept, "the gate changes nothing"


def but(
    device: Mapping[str, Any],
    *changes: tuple[tuple[str, ...], Any],
    without: tuple[str, ...] = (),
    version: Any = None,
) -> dict[str, Any]:
    """A device that says something else at some paths (None: nothing), lacks extensions, or is of
    an earlier version.
    """
    made = copy.deepcopy(dict(device))
    for path, value in changes:
        within = made
        for name in path[:-1]:
            within = within.setdefault(name, {})
        if value is None:
            within.pop(path[-1], None)
        else:
            within[path[-1]] = value
    made["extensions"] = [
        each for each in made["extensions"] if each["extensionName"] not in without
    ]
    if version is not None:
        made["properties"]["apiVersion"] = VERSIONS[version]
    return made


def limit(name: str, value: int) -> tuple[tuple[str, ...], int]:
    return (*LIMITS, name), value


def resolves(**stated: int) -> tuple[tuple[tuple[str, ...], int], ...]:
    return tuple(
        ((structure, name), value)
        for name, value in stated.items()
        for structure in (RESOLVES, "VkPhysicalDeviceDepthStencilResolveProperties")
    )


def offering(device: Mapping[str, Any], *names: str) -> dict[str, Any]:
    """A device with more extensions."""
    made = copy.deepcopy(dict(device))
    made["extensions"] += [{"extensionName": name} for name in names]
    return made


def refused(text: str, device: Mapping[str, Any], **arguments: Any) -> str:
    """Why a device refuses the only pass of a description; empty where it does not."""
    made = planned(text, **arguments)
    assert not any(each.refused for each in made.passes)
    found = gate(made, device)
    assert set(found) <= {0} and len(made.passes) == 1
    return found.get(0, "")


def a_pass(
    color: str = "format: R8G8B8A8_UNORM, samples: 4",
    depth: str = "",
    attachment: str = "",
    subpass: str = "",
    rest: str = "",
    image: str = "",
) -> str:
    """A render pass that draws to one colour image `c`, and to depth image `d` where one is
    described.
    """
    size = "extent: {width: 64, height: 64}"
    images = f"  c: {{{color}, {size}, {image}}}\n" + (
        f"  d: {{{depth}, {size}}}\n" if depth else ""
    )
    attachments = f"      c: {{image: c, {attachment or 'loadOp: CLEAR, storeOp: STORE'}}}\n"
    if depth:
        attachments += (
            "      d: {image: d, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, "
            "stencilStoreOp: STORE}\n"
        )
    drawn = "colorAttachments: [c]" + (", depthStencilAttachment: d" if depth else "")
    return (
        f"images:\n{images}renderPasses:\n  p:\n    attachments:\n{attachments}    subpasses: "
        f"[{{{drawn}, {subpass}}}]\n{rest}\n"
    )


def pipeline(state: str) -> str:
    return a_pass(rest=f"pipelines: {{x: {{renderPass: p, {state}}}}}")


RENDERING = """\
images:
  c: {format: R8G8B8A8_UNORM, samples: COUNT, extent: {width: 64, height: 64}}
commands:
  - beginRendering: {colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}], MORE}
  - endRendering
"""


def rendering(count: int = 4, more: str = "") -> str:
    return RENDERING.replace("COUNT", str(count)).replace("MORE", more)


# What is there


def test_what_a_device_supports_is_let_through(device: Mapping[str, Any]) -> None:
    for text in (
        a_pass(),
        a_pass("format: R8G8B8A8_UNORM, samples: 1"),
        a_pass(depth="format: D24_UNORM_S8_UINT, samples: 4"),
        rendering(),
    ):
        assert refused(text, device) == ""


def test_what_a_device_does_not_say_is_not_held_against_a_pass() -> None:
    depth = "format: D24_UNORM_S8_UINT, samples: 16"
    for text in (
        a_pass("format: R8G8B8A8_UNORM, samples: 16", depth),
        pipeline("multisampleState: {sampleShadingEnable: true}"),
    ):
        assert refused(text, {"properties": {"apiVersion": VERSIONS[1, 3]}}) == ""


def test_a_pass_that_nothing_can_run_is_not_asked_about(device: Mapping[str, Any]) -> None:
    made = planned("renderPasses: {p: {attachments: [{format: R8G8B8A8_UNORM, samples: 8}]}}\n")
    assert made.passes[0].refused != ""
    assert gate(made, device) == {}


def test_every_pass_has_its_own_reason(device: Mapping[str, Any]) -> None:
    passes = "".join(
        f"  p{count}: {{attachments: [{{format: R8G8B8A8_UNORM, samples: {count}, loadOp: CLEAR, "
        f"storeOp: STORE}}],"
        " subpasses: [{colorAttachments: [0]}]}\n"
        for count in (1, 2, 4, 8)
    )
    found = gate(planned(f"renderPasses:\n{passes}"), device)
    words = "p{0}.0 has {0} samples, but the device supports only 1 and 4 for R8G8B8A8_UNORM"
    assert found == {1: words.format(2), 3: words.format(8)}


# Sample counts


@pytest.mark.parametrize(
    ("image", "samples", "words"),
    [
        (
            "format: R8G8B8A8_UNORM, usage: COLOR_ATTACHMENT",
            8,
            "c has 8 samples, but the device supports only 1 and 4 for R8G8B8A8_UNORM",
        ),
        (
            "format: R16G16B16A16_SFLOAT, usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT",
            2,
            "c has 2 samples, but the device supports only 1 and 4 for R16G16B16A16_SFLOAT",
        ),
        (
            "format: R32_UINT, usage: COLOR_ATTACHMENT",
            16,
            "c has 16 samples, but the device supports only 1 and 4 for R32_UINT",
        ),
        (
            "format: R8G8B8A8_SRGB, usage: COLOR_ATTACHMENT",
            64,
            "c has 64 samples, but the device supports only 1 and 4 for R8G8B8A8_SRGB",
        ),
    ],
)
def test_a_count_that_a_format_does_not_have_is_refused(
    device: Mapping[str, Any], image: str, samples: int, words: str
) -> None:
    assert refused(a_pass(f"{image}, samples: {samples}"), device) == words
    assert refused(a_pass(f"{image}, samples: 4"), device) == ""
    assert refused(a_pass(f"{image}, samples: {samples}"), device, samples=4) == ""


def test_a_count_of_depth_is_that_of_its_format(device: Mapping[str, Any]) -> None:
    text = a_pass("format: R8G8B8A8_UNORM, samples: 4", "format: D32_SFLOAT, samples: 4")
    assert refused(text, device) == ""
    only_one = but(device, (("formats", "126", "counts"), 1))
    assert (
        refused(text, only_one) == "d has 4 samples, but the device supports only 1 for D32_SFLOAT"
    )
    assert refused(text.replace("D32_SFLOAT", "D16_UNORM"), only_one) == ""


@pytest.mark.parametrize(
    ("usage", "key", "word"),
    [
        ("SAMPLED", "sampled", "SAMPLED"),
        ("STORAGE", "storage", "STORAGE"),
        ("TRANSIENT_ATTACHMENT", "transient", "TRANSIENT_ATTACHMENT"),
    ],
)
def test_a_count_is_that_of_the_usage(
    device: Mapping[str, Any], usage: str, key: str, word: str
) -> None:
    text = a_pass(image=f"usage: COLOR_ATTACHMENT | {usage}")
    plain = a_pass(image="usage: COLOR_ATTACHMENT")
    less = but(device, (("formats", "37", key), 1))
    assert refused(text, device) == ""
    assert (
        refused(text, less)
        == "c has 4 samples, but the device supports only 1 for R8G8B8A8_UNORM with the usage "
        f"{word}"
    )
    assert refused(plain, less) == ""
    none = but(device, (("formats", "37", key), 0))
    assert (
        refused(text, none)
        == f"the device does not support R8G8B8A8_UNORM with the usage {word}, the format of c"
    )


def test_counts_are_those_of_plain_images(device: Mapping[str, Any]) -> None:
    most = but(device, (("formats", "37", "counts"), 64 | 1))
    assert (
        refused(a_pass(), most)
        == "c has 4 samples, but the device supports only 1 and 64 for R8G8B8A8_UNORM"
    )
    none = but(device, (("formats", "37", "counts"), 0))
    assert (
        refused(a_pass(ONE), none) == "the device does not support R8G8B8A8_UNORM, the format of c"
    )
    # Linear images and volumes are not those that were asked about.
    assert refused(a_pass(ONE, image="tiling: LINEAR"), none) == ""
    assert refused(a_pass(ONE, image="imageType: 3D"), none) == ""


def test_an_image_that_is_only_read_has_counts_too(device: Mapping[str, Any]) -> None:
    read = """\
images:
  o: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}}
  s: {format: R8G8B8A8_UNORM, samples: COUNT, usage: SAMPLED | TRANSFER_DST, extent: {width: 64, height: 64}}
renderPasses: {p: {attachments: {c: {image: o, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c]}]}}
"""
    assert refused(read.replace("COUNT", "4"), device) == ""
    assert "8 samples" in refused(read.replace("COUNT", "8"), device)


@pytest.mark.parametrize(
    "image",
    ["imageType: 3D", "imageType: 1D", "tiling: LINEAR", "mipLevels: 2", "flags: CUBE_COMPATIBLE"],
)
def test_only_plain_images_have_samples(device: Mapping[str, Any], image: str) -> None:
    words = (
        "c has 4 samples, which requires a 2D image with optimal tiling, one mip level and no "
        "cube faces"
    )
    assert refused(a_pass(image=image), device) == words
    assert refused(a_pass("format: R8G8B8A8_UNORM, samples: 1", image=image), device) == ""


def test_an_image_has_the_count_of_its_attachment(device: Mapping[str, Any]) -> None:
    text = a_pass(attachment="samples: 1, loadOp: CLEAR, storeOp: STORE")
    assert refused(text, device) == "c has sample count 4, and its attachment has 1"
    assert refused(a_pass(attachment="samples: 4, loadOp: CLEAR, storeOp: STORE"), device) == ""


def test_a_pipeline_has_a_count_of_the_device(device: Mapping[str, Any]) -> None:
    words = (
        "x: the device does not rasterize with 8 samples (framebufferColorSampleCounts: 1 and 4)"
    )
    assert refused(pipeline("multisampleState: {rasterizationSamples: 8}"), device) == words
    assert refused(pipeline("multisampleState: {rasterizationSamples: 4}"), device) == ""
    more = but(device, limit("framebufferColorSampleCounts", 13))
    assert refused(pipeline("multisampleState: {rasterizationSamples: 8}"), more) == ""


def test_a_pipeline_without_attachments_has_a_limit_of_its_own(device: Mapping[str, Any]) -> None:
    text = """\
renderPasses: {p: {subpasses: [{}]}}
framebuffers: {f: {renderPass: p, width: 64, height: 64}}
pipelines: {x: {renderPass: p, multisampleState: {rasterizationSamples: COUNT}}}
"""
    words = (
        "x: the device does not rasterize with 8 samples "
        "(framebufferNoAttachmentsSampleCounts: 1 and 4)"
    )
    assert refused(text.replace("COUNT", "8"), device) == words
    assert refused(text.replace("COUNT", "4"), device) == ""


def test_a_pipeline_of_depth_alone_has_attachments(device: Mapping[str, Any]) -> None:
    text = """\
images: {d: {format: D32_SFLOAT, samples: 4, extent: {width: 64, height: 64}}}
renderPasses: {p: {attachments: {d: {image: d, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{depthStencilAttachment: d}]}}
"""
    assert refused(text, device) == ""
    assert refused(text, but(device, limit("framebufferNoAttachmentsSampleCounts", 1))) == ""


def test_a_dynamic_count_is_one_of_the_device(device: Mapping[str, Any]) -> None:
    dynamic = "pipelines: {x: {renderPass: p, dynamicState: [RASTERIZATION_SAMPLES_EXT]}}\n"
    commands = (
        "commands: [{beginRenderPass: {renderPass: p}}, {setRasterizationSamples: COUNT}, "
        "{draw: {pipeline: x}}, endRenderPass]"
    )
    words = "the device does not rasterize with 8 samples (framebufferColorSampleCounts: 1 and 4)"
    assert refused(a_pass(rest=dynamic + commands.replace("COUNT", "8")), device) == words
    assert refused(a_pass(rest=dynamic + commands.replace("COUNT", "4")), device) == ""


def test_integers_are_asked_about_by_their_format(device: Mapping[str, Any]) -> None:
    text = a_pass("format: R32_UINT, samples: 4")
    assert refused(text, but(device, limit("framebufferColorSampleCounts", 1))) == ""
    assert (
        refused(text, but(device, (("formats", "98", "counts"), 1)))
        == "c has 4 samples, but the device supports only 1 for R32_UINT"
    )


# Counts that are mixed


MIXED = (
    "its attachments differ in their sample counts (1 and 4), which cannot be rendered "
    "together on this device"
)
NAMES = ("VK_AMD_mixed_attachment_samples", "VK_NV_framebuffer_mixed_samples")


@pytest.mark.parametrize("name", NAMES)
def test_mixed_counts_need_an_extension_that_is_offered_and_enabled(
    device: Mapping[str, Any], name: str
) -> None:
    text = a_pass("format: R8G8B8A8_UNORM, samples: 1", "format: D24_UNORM_S8_UINT, samples: 4")
    enabled = f"enabled: {{extensions: [{name}]}}\n"
    assert refused(text, device) == MIXED
    assert refused(enabled + text, device) == MIXED
    assert refused(text, offering(device, name)) == MIXED
    assert refused(enabled + text, offering(device, name)) == ""
    assert refused(a_pass(depth="format: D24_UNORM_S8_UINT, samples: 4"), device) == ""


def test_colours_of_several_counts_are_never_drawn_to_together(device: Mapping[str, Any]) -> None:
    text = """\
enabled: {extensions: [VK_AMD_mixed_attachment_samples]}
renderPasses:
  p:
    attachments: [{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}, {format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: STORE}]
    subpasses: [SUBPASSES]
"""
    together = text.replace("SUBPASSES", "{colorAttachments: [0, 1]}")
    assert refused(together, offering(device, NAMES[0])) == MIXED
    assert (
        refused(
            text.replace("SUBPASSES", "{colorAttachments: [0]}, {colorAttachments: [1]}"), device
        )
        == ""
    )
    assert (
        refused(
            text.replace("SUBPASSES", "{colorAttachments: [0], resolveAttachments: [1]}"), device
        )
        == ""
    )


def test_a_pipeline_of_another_count_needs_the_extension_that_is_enabled(
    device: Mapping[str, Any],
) -> None:
    enabled = "enabled: {extensions: [VK_NV_framebuffer_mixed_samples]}\n"
    text = a_pass(
        "format: R8G8B8A8_UNORM, samples: 1",
        rest="pipelines: {x: {renderPass: p, multisampleState: {rasterizationSamples: 4}}}",
    )
    assert refused(enabled + text, device) == "the device has no VK_NV_framebuffer_mixed_samples"
    assert refused(enabled + text, offering(device, NAMES[1])) == ""
    both = text.replace(
        "pipelines: {",
        "pipelines: {same: {renderPass: p, multisampleState: {rasterizationSamples: 1}}, ",
    )
    assert refused(enabled + both, device) == "the device has no VK_NV_framebuffer_mixed_samples"
    assert (
        refused(
            enabled + both.replace("rasterizationSamples: 4", "rasterizationSamples: 1"), device
        )
        == ""
    )
    # Without the extension it is a mistake for the layer to judge.
    assert refused(text, device) == ""


def test_mixed_counts_in_dynamic_rendering_are_refused(device: Mapping[str, Any]) -> None:
    text = """\
images:
  c: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64}}
  d: {format: D32_SFLOAT, samples: COUNT, extent: {width: 64, height: 64}}
commands:
  - beginRendering:
      colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]
      depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}
  - endRendering
"""
    assert refused(text.replace("COUNT", "1"), device) == MIXED
    assert refused(text.replace("COUNT", "4"), device) == ""


# Depth and stencil


def depth_resolve(modes: str, format: str = "D24_UNORM_S8_UINT", target: str = "") -> str:
    return f"""\
images:
  d: {{format: {format}, samples: 4, extent: {{width: 64, height: 64}}}}
  r: {{format: {target or format}, samples: 1, extent: {{width: 64, height: 64}}}}
renderPasses:
  p:
    attachments:
      d: {{image: d, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}}
      r: {{image: r, loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE}}
    subpasses: [{{depthStencilAttachment: d, depthStencilResolve: {{attachment: r, {modes}}}}}]
"""


ZERO = "depthResolveMode: SAMPLE_ZERO, stencilResolveMode: SAMPLE_ZERO"


def test_modes_are_those_of_the_device(device: Mapping[str, Any]) -> None:
    assert refused(depth_resolve(ZERO), device) == ""
    assert refused(depth_resolve("depthResolveMode: MIN", "D32_SFLOAT"), device) == (
        "the device does not resolve depth with MIN (supportedDepthResolveModes: SAMPLE_ZERO | "
        "AVERAGE)"
    )
    assert refused(depth_resolve("depthResolveMode: AVERAGE", "D32_SFLOAT"), device) == ""
    assert refused(depth_resolve("stencilResolveMode: MAX", "S8_UINT"), device) == (
        "the device does not resolve stencil with MAX (supportedStencilResolveModes: SAMPLE_ZERO)"
    )
    more = but(device, *resolves(supportedDepthResolveModes=4, supportedStencilResolveModes=9))
    assert refused(depth_resolve("depthResolveMode: MIN", "D32_SFLOAT"), more) == ""
    assert refused(depth_resolve("stencilResolveMode: MAX", "S8_UINT"), more) == ""
    assert refused(depth_resolve("depthResolveMode: SAMPLE_ZERO", "D32_SFLOAT"), more) == (
        "the device does not resolve depth with SAMPLE_ZERO (supportedDepthResolveModes: MIN)"
    )
    assert refused(
        depth_resolve("depthResolveMode: MIN", "D32_SFLOAT"),
        but(device, *resolves(supportedDepthResolveModes=0)),
    ) == ("the device does not resolve depth with MIN (supportedDepthResolveModes: none)")


def test_modes_of_aspects_that_are_not_there_are_nothing(device: Mapping[str, Any]) -> None:
    assert (
        refused(
            depth_resolve("depthResolveMode: SAMPLE_ZERO, stencilResolveMode: MAX", "D32_SFLOAT"),
            device,
        )
        == ""
    )
    assert (
        refused(
            depth_resolve("depthResolveMode: MIN, stencilResolveMode: SAMPLE_ZERO", "S8_UINT"),
            device,
        )
        == ""
    )


@pytest.mark.parametrize(
    ("depth", "stencil", "limit_of", "enough"),
    [
        ("AVERAGE", "SAMPLE_ZERO", "independentResolve", {"independentResolve"}),
        (
            "SAMPLE_ZERO",
            "NONE",
            "independentResolveNone",
            {"independentResolve", "independentResolveNone"},
        ),
        (
            "NONE",
            "SAMPLE_ZERO",
            "independentResolveNone",
            {"independentResolve", "independentResolveNone"},
        ),
    ],
)
def test_modes_that_differ_need_independent_resolves(
    device: Mapping[str, Any], depth: str, stencil: str, limit_of: str, enough: set[str]
) -> None:
    text = depth_resolve(f"depthResolveMode: {depth}, stencilResolveMode: {stencil}")
    words = (
        f"the device does not resolve depth with {depth} and stencil with {stencil} "
        f"({limit_of} is false)"
    )
    assert refused(text, device) == words
    for name in ("independentResolve", "independentResolveNone"):
        assert refused(text, but(device, *resolves(**{name: 1}))) == (
            "" if name in enough else words
        )


def test_a_target_without_stencil_resolves_depth_alone(device: Mapping[str, Any]) -> None:
    """VUID-VkSubpassDescriptionDepthStencilResolve-pDepthStencilResolveAttachment-03185, 03186: of
    formats with both.
    """
    modes = "depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE"
    assert refused(depth_resolve(modes, "D32_SFLOAT_S8_UINT", "D32_SFLOAT"), device) == ""
    assert "independentResolveNone" in refused(depth_resolve(modes, "D32_SFLOAT_S8_UINT"), device)


def test_rendering_several_samples_to_one_resolves_with_a_mode_of_the_device(
    device: Mapping[str, Any],
) -> None:
    """VUID-VkSubpassDescription2-pNext-06871: the structure has modes, and no attachment."""
    single = "multisampledRenderToSingleSampled: {rasterizationSamples: 4}, depthStencilResolve"
    text = (
        depth_resolve("depthResolveMode: MIN", "D32_SFLOAT")
        .replace("samples: 4", "samples: 1")
        .replace("attachment: r, ", "")
    )
    text = text.replace("depthStencilResolve", single)
    assert (
        refused(text, device)
        == "the device does not resolve depth with MIN (supportedDepthResolveModes: SAMPLE_ZERO | "
        "AVERAGE)"
    )
    assert refused(text.replace("MIN", "AVERAGE"), device) == ""


def test_a_resolve_of_no_depth_is_refused(device: Mapping[str, Any]) -> None:
    words = "it resolves depth or stencil in a subpass without a depth-stencil attachment"
    assert refused(depth_resolve(ZERO).replace("depthStencilAttachment: d, ", ""), device) == words


def test_a_rendering_that_resolves_to_nothing_is_refused(device: Mapping[str, Any]) -> None:
    color = "storeOp: STORE, resolveMode: AVERAGE}"
    words = "it resolves without an image to resolve to"
    assert refused(rendering().replace("storeOp: STORE}", color), device) == words
    assert (
        refused(rendering().replace("storeOp: STORE}", color.replace("AVERAGE", "NONE")), device)
        == ""
    )
    single = "multisampledRenderToSingleSampled: {rasterizationSamples: 4}"
    assert refused(rendering(1, single).replace("storeOp: STORE}", color), device) == ""


DEPTH_RENDERING = """\
images:
  d: {format: D24_UNORM_S8_UINT, samples: 4, extent: {width: 64, height: 64}}
  r: {format: D24_UNORM_S8_UINT, samples: 1, extent: {width: 64, height: 64}}
commands:
  - beginRendering:
      depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE, DEPTH}
      stencilAttachment: {image: d, loadOp: CLEAR, storeOp: STORE, STENCIL}
  - endRendering
"""


@pytest.mark.parametrize(
    ("depth", "stencil", "words"),
    [
        ("SAMPLE_ZERO", "SAMPLE_ZERO", ""),
        ("NONE", "NONE", ""),
        (
            "MAX",
            "SAMPLE_ZERO",
            "the device does not resolve depth with MAX (supportedDepthResolveModes: SAMPLE_ZERO | "
            "AVERAGE)",
        ),
        (
            "SAMPLE_ZERO",
            "MIN",
            "the device does not resolve stencil with MIN (supportedStencilResolveModes: "
            "SAMPLE_ZERO)",
        ),
        (
            "AVERAGE",
            "SAMPLE_ZERO",
            "the device does not resolve depth with AVERAGE and stencil with SAMPLE_ZERO "
            "(independentResolve is false)",
        ),
        (
            "SAMPLE_ZERO",
            "NONE",
            "the device does not resolve depth with SAMPLE_ZERO and stencil with NONE "
            "(independentResolveNone is false)",
        ),
    ],
)
def test_modes_of_dynamic_rendering_are_those_of_the_device(
    device: Mapping[str, Any], depth: str, stencil: str, words: str
) -> None:
    text = DEPTH_RENDERING.replace("DEPTH}", f"resolveImage: r, resolveMode: {depth}}}")
    assert (
        refused(text.replace("STENCIL}", f"resolveImage: r, resolveMode: {stencil}}}"), device)
        == words
    )


def test_stencil_that_is_not_resolved_beside_depth_that_is_is_refused(
    device: Mapping[str, Any],
) -> None:
    """VUID-VkRenderingInfo-pDepthAttachment-06104: both modes are the same where
    independentResolveNone is false.
    """
    text = DEPTH_RENDERING.replace("DEPTH}", "resolveImage: r, resolveMode: SAMPLE_ZERO}").replace(
        ", STENCIL}", "}"
    )
    words = (
        "the device does not resolve depth with SAMPLE_ZERO and stencil with NONE "
        "(independentResolveNone is false)"
    )
    assert refused(text, device) == words
    assert refused(text, but(device, *resolves(independentResolveNone=1))) == ""
    alone = "\n".join(line for line in text.splitlines() if "stencilAttachment" not in line) + "\n"
    assert refused(alone, device) == ""


# Extensions, versions, features


def test_dynamic_rendering_is_of_a_version_or_an_extension(device: Mapping[str, Any]) -> None:
    name = "VK_KHR_dynamic_rendering"
    words = "the device does not support dynamic rendering"
    assert refused(rendering(), but(device, without=(name,))) == ""
    assert refused(rendering(), but(device, version=(1, 2))) == ""
    assert refused(rendering(), but(device, without=(name,), version=(1, 2))) == words
    structures = ("VkPhysicalDeviceVulkan13Features", "VkPhysicalDeviceDynamicRenderingFeatures")
    assert (
        refused(rendering(), but(device, *(((each, "dynamicRendering"), 0) for each in structures)))
        == words
    )
    assert refused(a_pass(), but(device, without=(name,), version=(1, 2))) == ""


def test_the_second_structure_of_render_passes_is_of_a_version_or_an_extension(
    device: Mapping[str, Any],
) -> None:
    old = but(device, without=("VK_KHR_create_renderpass2",), version=(1, 1))
    assert refused(a_pass(), old) == "the device has no VK_KHR_create_renderpass2"
    assert refused(a_pass(), but(device, version=(1, 1))) == ""
    assert refused(a_pass(), old, api=1) == ""


@pytest.mark.parametrize(
    "text", [a_pass(subpass="viewMask: 3", image="arrayLayers: 2"), rendering(more="viewMask: 3")]
)
def test_views_are_a_feature(device: Mapping[str, Any], text: str) -> None:
    assert refused(text, device) == ""
    assert (
        refused(text, but(device, (("VkPhysicalDeviceVulkan11Features", "multiview"), 0)))
        == "the device does not support multiview"
    )
    assert (
        refused(
            text.replace("viewMask: 3", "viewMask: 0"),
            but(device, (("VkPhysicalDeviceVulkan11Features", "multiview"), 0)),
        )
        == ""
    )


def test_a_device_has_so_many_views(device: Mapping[str, Any]) -> None:
    """VUID-VkSubpassDescription2-viewMask-06706."""
    most = device["VkPhysicalDeviceVulkan11Properties"]["maxMultiviewViewCount"]
    assert most == 6
    assert refused(a_pass(subpass="viewMask: 0x20", image="arrayLayers: 8"), device) == ""
    assert "maxMultiviewViewCount 6" in refused(
        a_pass(subpass="viewMask: 0x40", image="arrayLayers: 8"), device
    )


@pytest.mark.parametrize(
    "text",
    [
        a_pass(ONE, subpass="multisampledRenderToSingleSampled: {rasterizationSamples: 4}"),
        rendering(
            1,
            "multisampledRenderToSingleSampled: {multisampledRenderToSingleSampledEnable: true, "
            "rasterizationSamples: 4}",
        ),
    ],
)
def test_rendering_several_samples_to_one_is_an_extension(
    device: Mapping[str, Any], text: str
) -> None:
    words = f"the device has no {SINGLE}"
    assert refused(text, device) == ""
    assert refused(text, but(device, without=(SINGLE,))) == words
    feature = (
        "VkPhysicalDeviceMultisampledRenderToSingleSampledFeaturesEXT",
        "multisampledRenderToSingleSampled",
    )
    assert refused(text, but(device, (feature, 0))) == words
    off = "{multisampledRenderToSingleSampledEnable: false}"
    assert (
        refused(
            re.sub(r"\{(\w+: true, )?rasterizationSamples: 4\}", off, text),
            but(device, without=(SINGLE,)),
        )
        == ""
    )
    counts = refused(text.replace("rasterizationSamples: 4", "rasterizationSamples: 8"), device)
    assert (
        counts == "built-in 0: the device does not rasterize with 8 samples "
        "(framebufferColorSampleCounts: 1 and 4)"
    )


@pytest.mark.parametrize(
    ("operations", "words", "name"),
    [
        (
            "loadOp: NONE, storeOp: STORE",
            "the device has no VK_EXT_load_store_op_none, which loadOp NONE needs",
            "VK_EXT_load_store_op_none",
        ),
        (
            "loadOp: NONE, storeOp: STORE",
            "the device has no VK_EXT_load_store_op_none, which loadOp NONE needs",
            "VK_KHR_load_store_op_none",
        ),
        (
            "loadOp: CLEAR, storeOp: NONE",
            "the device has no VK_EXT_load_store_op_none, which storeOp NONE needs",
            "VK_KHR_dynamic_rendering",
        ),
        (
            "loadOp: CLEAR, storeOp: NONE",
            "the device has no VK_EXT_load_store_op_none, which storeOp NONE needs",
            "VK_QCOM_render_pass_store_ops",
        ),
        (
            "loadOp: CLEAR, storeOp: NONE",
            "the device has no VK_EXT_load_store_op_none, which storeOp NONE needs",
            "VK_EXT_load_store_op_none",
        ),
    ],
)
def test_no_operation_is_an_extension(
    device: Mapping[str, Any], operations: str, words: str, name: str
) -> None:
    text = a_pass(attachment=operations)
    old = but(device, without=("VK_KHR_dynamic_rendering",), version=(1, 2))
    assert refused(text, old) == words
    assert refused(text, offering(old, name)) == ""
    assert refused(a_pass(), old) == ""


def test_no_store_operation_is_part_of_vulkan_1_3(device: Mapping[str, Any]) -> None:
    assert refused(a_pass(attachment="loadOp: CLEAR, storeOp: NONE"), device) == ""
    assert refused(a_pass(attachment="loadOp: NONE, storeOp: STORE"), device) == (
        "the device has no VK_EXT_load_store_op_none, which loadOp NONE needs"
    )
    text = a_pass(depth="format: D24_UNORM_S8_UINT, samples: 4").replace(
        "stencilLoadOp: CLEAR", "stencilLoadOp: NONE"
    )
    assert (
        refused(text, device)
        == "the device has no VK_EXT_load_store_op_none, which loadOp NONE needs"
    )
    assert refused(rendering().replace("loadOp: CLEAR", "loadOp: NONE"), device) == (
        "the device has no VK_EXT_load_store_op_none, which loadOp NONE needs"
    )


@pytest.mark.parametrize(
    ("state", "feature"),
    [
        ("multisampleState: {sampleShadingEnable: true}", "sampleRateShading"),
        ("multisampleState: {sampleShadingEnable: true, minSampleShading: 0}", "sampleRateShading"),
        ("multisampleState: {alphaToOneEnable: true}", "alphaToOne"),
        ("rasterizationState: {depthClampEnable: true}", "depthClamp"),
        ("rasterizationState: {polygonMode: LINE}", "fillModeNonSolid"),
        ("rasterizationState: {polygonMode: POINT}", "fillModeNonSolid"),
    ],
)
def test_states_of_pipelines_are_features(
    device: Mapping[str, Any], state: str, feature: str
) -> None:
    less = but(device, (("features", feature), 0))
    assert refused(pipeline(state), device) == ""
    assert refused(pipeline(state), less) == f"x: the device has no {feature}"
    off = state.replace("true", "false").replace("LINE", "FILL").replace("POINT", "FILL")
    assert refused(pipeline(off), less) == ""


def test_a_feature_that_the_application_leaves_off_is_not_asked_of_the_device(
    device: Mapping[str, Any],
) -> None:
    less = but(device, (("features", "sampleRateShading"), 0))
    text = pipeline("multisampleState: {sampleShadingEnable: true}")
    assert refused("enabled: {features: [alphaToOne]}\n" + text, less) == ""
    assert (
        refused("enabled: {features: [sampleRateShading]}\n" + text, less)
        == "x: the device has no sampleRateShading"
    )


def test_blends_that_differ_are_a_feature(device: Mapping[str, Any]) -> None:
    text = """\
renderPasses:
  p:
    attachments: [{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}, {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}]
    subpasses: [{colorAttachments: [0, 1]}]
pipelines: {x: {renderPass: p, colorBlendState: {attachments: [{blendEnable: true}, {blendEnable: OTHER}]}}}
"""
    less = but(device, (("features", "independentBlend"), 0))
    assert refused(text.replace("OTHER", "false"), less) == "x: the device has no independentBlend"
    assert refused(text.replace("OTHER", "false"), device) == ""
    assert refused(text.replace("OTHER", "true"), less) == ""


@pytest.mark.parametrize(
    ("state", "feature"),
    [
        ("RASTERIZATION_SAMPLES_EXT", "extendedDynamicState3RasterizationSamples"),
        ("SAMPLE_MASK_EXT", "extendedDynamicState3SampleMask"),
        ("ALPHA_TO_COVERAGE_ENABLE_EXT", "extendedDynamicState3AlphaToCoverageEnable"),
    ],
)
def test_dynamic_states_are_features(device: Mapping[str, Any], state: str, feature: str) -> None:
    text = pipeline(f"dynamicState: [VIEWPORT, {state}]")
    assert refused(text, device) == ""
    assert (
        refused(text, but(device, without=("VK_EXT_extended_dynamic_state3",)))
        == f"x: the device has no {feature}"
    )
    less = but(device, (("VkPhysicalDeviceExtendedDynamicState3FeaturesEXT", feature), 0))
    assert refused(text, less) == f"x: the device has no {feature}"
    assert refused(pipeline("dynamicState: [VIEWPORT]"), less) == ""


# Formats


def test_a_format_that_is_not_there_is_refused(device: Mapping[str, Any]) -> None:
    less = but(device, (("formats", "37"), None))
    assert refused(a_pass(), less) == "the device does not support R8G8B8A8_UNORM, the format of c"
    assert refused(a_pass("format: B8G8R8A8_UNORM, samples: 4"), less) == ""
    # Formats of extensions were not asked about.
    assert refused(a_pass("format: A4R4G4B4_UNORM_PACK16, samples: 4"), device) == ""
    assert refused(a_pass(), but(device, (("formats",), None))) == ""


def test_a_format_that_is_not_rendered_to_is_refused(device: Mapping[str, Any]) -> None:
    text = a_pass("format: BC1_RGB_UNORM_BLOCK, samples: 1")
    assert (
        refused(text, device) == "the device cannot render to BC1_RGB_UNORM_BLOCK, the format of c"
    )
    read = a_pass(ONE).replace(
        "images:\n", "images:\n  t: {format: BC1_RGB_UNORM_BLOCK, samples: 1, usage: SAMPLED}\n"
    )
    assert refused(read, device) == ""


BLENDED = "colorBlendState: {attachments: [{blendEnable: true}]}"


def test_a_format_that_is_not_blended_is_refused(device: Mapping[str, Any]) -> None:
    words = "x: the device does not blend R32_UINT"
    own = f"pipelines: {{x: {{rendering: {{colorAttachmentFormats: [R32_UINT]}}, {BLENDED}}}}}\n"
    draw = "draw: {pipeline: x}\n  - endRendering"
    text = rendering().replace("R8G8B8A8_UNORM", "R32_UINT").replace("endRendering", draw)
    assert refused(own + text, device) == words
    assert refused(own.replace("true", "false") + text, device) == ""
    assert (
        refused(
            own.replace("R32_UINT", "R32_SFLOAT") + text.replace("R32_UINT", "R32_SFLOAT"), device
        )
        == ""
    )
    passes = a_pass(
        "format: R32_UINT, samples: 4", rest=f"pipelines: {{x: {{renderPass: p, {BLENDED}}}}}"
    )
    assert refused(passes, device) == words
    assert refused(passes.replace("R32_UINT", "R32_SFLOAT"), device) == ""


def test_a_tiling_by_modifiers_is_refused(device: Mapping[str, Any]) -> None:
    words = "c has the tiling DRM_FORMAT_MODIFIER_EXT, whose modifiers are not described"
    assert refused(a_pass(ONE, image="tiling: DRM_FORMAT_MODIFIER_EXT"), device) == words
    assert refused(a_pass(ONE, image="tiling: OPTIMAL"), device) == ""
    assert refused(a_pass(ONE, image="tiling: LINEAR"), device) == ""


# Limits


@pytest.mark.parametrize(
    ("image", "name", "words"),
    [
        ("", "maxImageDimension2D", "c is 64x64 texels, and the device has maxImageDimension2D 63"),
        (
            "imageType: 1D",
            "maxImageDimension1D",
            "c is 64x1 texels, and the device has maxImageDimension1D 63",
        ),
        (
            "imageType: 3D",
            "maxImageDimension3D",
            "c is 64x64 texels, and the device has maxImageDimension3D 63",
        ),
    ],
)
def test_images_have_a_largest_size(
    device: Mapping[str, Any], image: str, name: str, words: str
) -> None:
    text = a_pass(ONE, image=image)
    assert refused(text, device) == ""
    assert refused(text, but(device, limit(name, 63))) == words
    assert refused(text, but(device, limit(name, 64))) == ""
    others = [
        other
        for other in ("maxImageDimension1D", "maxImageDimension2D", "maxImageDimension3D")
        if other != name
    ]
    assert refused(text, but(device, *(limit(other, 1) for other in others))) == ""


def test_images_have_so_many_layers(device: Mapping[str, Any]) -> None:
    text = a_pass(image="arrayLayers: 3")
    assert (
        refused(text, but(device, limit("maxImageArrayLayers", 2)))
        == "c has 3 layers, and the device has maxImageArrayLayers 2"
    )
    assert refused(text, but(device, limit("maxImageArrayLayers", 3))) == ""


@pytest.mark.parametrize("name", ["maxFramebufferWidth", "maxFramebufferHeight"])
def test_framebuffers_have_a_largest_size(device: Mapping[str, Any], name: str) -> None:
    for text in (a_pass(), rendering()):
        assert (
            refused(text, but(device, limit(name, 63)))
            == f"it renders to 64x64 pixels, and the device has {name} 63"
        )
        assert refused(text, but(device, limit(name, 64))) == ""


def test_framebuffers_have_so_many_layers(device: Mapping[str, Any]) -> None:
    text = a_pass(
        image="arrayLayers: 4",
        rest="framebuffers: {f: {renderPass: p, attachments: [c], layers: 4}}",
    )
    words = "it renders to 4 layers, and the device has maxFramebufferLayers 3"
    assert refused(text, but(device, limit("maxFramebufferLayers", 3))) == words
    assert refused(text, but(device, limit("maxFramebufferLayers", 4))) == ""
    assert (
        refused(rendering(more="layerCount: 4"), but(device, limit("maxFramebufferLayers", 3)))
        == words
    )


def test_a_pass_has_so_many_colours(device: Mapping[str, Any]) -> None:
    attachment = "{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}"
    text = "renderPasses: {{p: {{attachments: [{0}], subpasses: [{{colorAttachments: {1}}}]}}}}\n"
    nine = text.format(", ".join([attachment] * 9), list(range(9)))
    assert (
        refused(nine, device)
        == "it has 9 color attachments, and the device has maxColorAttachments 8"
    )
    assert refused(text.format(", ".join([attachment] * 9), list(range(8))), device) == ""
    unused = rendering().replace(
        "storeOp: STORE}]", f"storeOp: STORE}}, {', '.join(['null'] * 8)}]"
    )
    assert (
        refused(unused, device)
        == "it has 9 color attachments, and the device has maxColorAttachments 8"
    )
    assert refused(unused.replace(", null]", "]"), device) == ""


# The rest


def test_a_frame_without_passes_has_its_images_and_pipelines_asked_about(
    device: Mapping[str, Any],
) -> None:
    images = "images: {a: {format: R8G8B8A8_UNORM, samples: 8, extent: {width: 64, height: 64}}}\n"
    assert (
        refused(images, device)
        == "a has 8 samples, but the device supports only 1 and 4 for R8G8B8A8_UNORM"
    )
    assert refused(images.replace("8,", "4,"), device) == ""
    alone = "pipelines: {x: {multisampleState: {rasterizationSamples: 8}}}\n"
    assert (
        refused(alone, device)
        == "x: the device does not rasterize with 8 samples (framebufferColorSampleCounts: 1 and 4)"
    )


def test_an_unknown_format_is_named_by_its_number(device: Mapping[str, Any]) -> None:
    image = parts.Image("i", 184, 1, 0x10, 8, 8, 1, 1, 1, 1, 0, 0, False, parts.COLOR, "UNORM")
    number = image._replace(format=0)
    for each, words in ((image, "ASTC_12x12_SRGB_BLOCK"), (number, "UNDEFINED")):
        made = Plan(
            "f",
            (each,),
            (
                Pass(
                    "p",
                    "p",
                    parts.RENDER_PASS,
                    2,
                    framebuffers=(Framebuffer((0,), 8, 8, 1),),
                    images=(0,),
                ),
            ),
        )
        assert gate(made, device) == {0: f"the device does not support {words}, the format of i"}


def generous(device: Mapping[str, Any]) -> dict[str, Any]:
    """A device that has every count, mode, feature and extension, in any size."""
    made = offering(device, *NAMES, "VK_EXT_load_store_op_none")
    limits = made["properties"]["limits"]
    limits.update({name: 1 << 30 for name in limits if name.startswith("max")})
    limits.update({name: 127 for name in limits if name.endswith("SampleCounts")})
    for stated in made["formats"].values():
        stated.update({name: 127 for name in stated if name not in ("features", "linear")})
    for name, value in resolves(
        supportedDepthResolveModes=15,
        supportedStencilResolveModes=15,
        independentResolve=1,
        independentResolveNone=1,
    ):
        made[name[0]][name[1]] = value
    return made


@pytest.mark.parametrize("example", all_examples(), ids=str)
def test_every_example_of_the_catalogue_is_asked_about(
    device: Mapping[str, Any], example: Example
) -> None:
    for found in frames(example.text):
        made = plan(found)
        reasons = gate(made, device)
        assert all(reasons.values())
        assert all(not made.passes[number].refused for number in reasons)
        left = gate(made, generous(device))
        assert set(left) <= set(reasons)
        # What is left holds on every device.
        assert not any(
            words in reason
            for reason in left.values()
            for words in ("the device has", "the device does not")
        ), left


PIECES = st.sampled_from(
    [
        "properties",
        "features",
        "memory",
        "extensions",
        "formats",
        RESOLVES,
        "VkPhysicalDeviceVulkan13Features",
    ]
)


@examples(0.6, suppress_health_check=list(HealthCheck))
@given(description=random_frames(), lacking=st.sets(PIECES, max_size=7))
def test_any_description_is_asked_about(
    device: Mapping[str, Any], description: Any, lacking: set[str]
) -> None:
    made = planned(json.dumps(description))
    for each in (device, {key: value for key, value in device.items() if key not in lacking}):
        found = gate(made, each)
        assert all(reason and 0 <= number < len(made.passes) for number, reason in found.items())
        assert not any(made.passes[number].refused for number in found)
