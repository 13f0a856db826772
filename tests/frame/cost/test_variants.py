"""A frame at other sample counts and with its resolves placed otherwise: the published numbers, and
the laws that all variants keep.
"""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.frame.cost.amounts import Amount, Terms
from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.cost.samples import COUNTS
from msaa_lint.frame.cost.variants import AS_WRITTEN, INLINE, NONE, SEPARATE, Variant, variants
from msaa_lint.frame.devices import DeviceProfile, builtin
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.global_facts import profile
from tests.frame.cost.frames import EXAMPLES, document
from tests.frames import frames
from tests.pages import all_examples
from tests.strength import examples

ONE, FOUR = 561.9456, 2247.7824
"""MB/s: 2168 * 1080 * 4 B * 60 Hz, of one sample and of four."""

MIB = 2168 * 1080 * 4 / 2**20
"""Of one such image with one sample."""

LAZY = DeviceProfile(
    "lazy",
    memory_types=(("DEVICE_LOCAL", "LAZILY_ALLOCATED"),),
    color_samples=(1, 4),
    depth_samples=(1, 4),
)


def made(
    text: str, device: str | DeviceProfile | None = None, counts: tuple[int, ...] = (1, 2, 4, 8)
) -> dict[tuple[int, str], Variant]:
    found = document(text)
    default = builtin(device) if isinstance(device, str) else device
    listed = variants(found, profile(found.description, default), Terms(), counts)
    return {(each.samples, each.resolve): each for each in listed}


def example(name: str) -> dict[tuple[int, str], Variant]:
    return made((EXAMPLES / name).read_text(encoding="utf-8"))


def traffic(found: Variant) -> tuple[float, float]:
    return found.cost.total.read_mb_per_s, found.cost.total.write_mb_per_s


def test_the_printed_numbers_of_the_khronos_sample() -> None:
    found = example("khronos-msaa/color-separate.msaa.yaml")
    assert traffic(found[1, NONE]) == pytest.approx((0, ONE))
    assert traffic(found[4, AS_WRITTEN]) == pytest.approx((FOUR, FOUR + ONE))
    assert traffic(found[4, INLINE]) == pytest.approx((0, ONE))
    assert traffic(found[4, SEPARATE]) == pytest.approx((FOUR, FOUR + ONE))
    assert traffic(found[8, SEPARATE]) == pytest.approx((2 * FOUR, 2 * FOUR + ONE))
    assert traffic(found[2, SEPARATE]) == pytest.approx((FOUR / 2, FOUR / 2 + ONE))


def test_separate_resolves_of_colour_and_depth_store_and_read_all_samples() -> None:
    found = example("khronos-msaa/inline.msaa.yaml")
    assert found[4, INLINE].cost == found[4, AS_WRITTEN].cost
    more = [
        b - a for a, b in zip(traffic(found[4, INLINE]), traffic(found[4, SEPARATE]), strict=True)
    ]
    assert more == pytest.approx([2 * FOUR, 2 * FOUR])


def test_the_guides_number_for_1080p() -> None:
    """3.98 GB/s more than 0.50: four samples written and read."""
    text = (
        (EXAMPLES / "khronos-msaa/color-separate.msaa.yaml")
        .read_text(encoding="utf-8")
        .replace("width: 2168", "width: 1920")
    )
    found = made(text)
    inline, separate = (found[4, place].cost.total.traffic_mb_per_s for place in (INLINE, SEPARATE))
    assert (round(inline / 1000, 2), round((separate - inline) / 1000, 2)) == (0.50, 3.98)


@pytest.mark.parametrize(
    ("name", "count", "place", "images"),
    [
        ("color-separate", 4, AS_WRITTEN, 4 + 1),
        ("color-separate", 8, AS_WRITTEN, 8 + 1),
        ("color-separate", 8, INLINE, 1),
        ("color-separate", 1, NONE, 1),
        ("inline", 4, INLINE, 3),
        ("inline", 4, SEPARATE, 4 + 4 + 3),
        ("inline", 1, NONE, 3),
        ("stored-and-resolved", 4, AS_WRITTEN, 4 + 4 + 1),
        ("stored-and-resolved", 4, INLINE, 4 + 1),
        ("depth-unresolved", 4, INLINE, 4 + 2),
    ],
)
def test_memory_is_that_of_the_images_left(name: str, count: int, place: str, images: int) -> None:
    """In images of one sample; what stays on the tile of a Mali is not committed."""
    assert example(f"khronos-msaa/{name}.msaa.yaml")[
        count, place
    ].cost.total.memory_mib == pytest.approx(images * MIB)


RENDERING = """
frame: {width: 100, height: 100, fps: 100}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  ds: {format: D32_SFLOAT_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
  depth: {format: D32_SFLOAT_S8_UINT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
commands:
  - beginRendering:
      colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: out}]
      depthAttachment: {image: ds, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: SAMPLE_ZERO, resolveImage: depth}
      stencilAttachment: {image: ds, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: NONE}
  - endRendering
  - readImage: {image: depth}
"""


def test_dynamic_rendering() -> None:
    """A megapixel a second: figures are bytes a pixel. A command moves depth and stencil, a shader
    reads depth.
    """
    found = made(RENDERING)
    assert traffic(found[4, INLINE]) == pytest.approx((4, 4 + 4))
    assert traffic(found[4, SEPARATE]) == pytest.approx((4 + 16 + 20, 16 + 20 + 4 + 5))
    assert traffic(found[1, NONE]) == pytest.approx((4, 4 + 4))
    assert found[1, NONE].cost.total.memory_mib == pytest.approx((4 + 5) * 1e4 / 2**20)
    assert found[4, SEPARATE].cost.total.memory_mib == pytest.approx(
        (16 + 20 + 4 + 5) * 1e4 / 2**20
    )


def test_a_command_goes_into_the_rendering_before_it() -> None:
    unresolved = "storeOp: STORE, resolveMode: NONE"
    text = RENDERING.replace(
        "storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: out", unresolved
    )
    text = text.replace(
        "- readImage", "- resolveImage: {srcImage: ms, dstImage: out}\n  - readImage"
    )
    found = made(text)
    assert traffic(found[4, AS_WRITTEN]) == pytest.approx((4 + 16, 16 + 4 + 4))
    assert traffic(found[4, INLINE]) == pytest.approx((4, 4 + 4))


def test_what_is_read_later_stays_stored() -> None:
    """The next frame goes on with the samples: inline saves the command's reading alone."""
    text = """
    frame: {width: 100, height: 100, fps: 100}
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      out: {format: R8G8B8A8_UNORM, samples: 1}
    renderPasses:
      main:
        attachments: {color: {image: ms, loadOp: LOAD, storeOp: STORE}}
        subpasses: [{colorAttachments: [color]}]
    commands: [{beginRenderPass: {renderPass: main}}, endRenderPass, {resolveImage: {srcImage: ms, dstImage: out}}]
    """
    found = made(text)
    assert traffic(found[4, INLINE]) == pytest.approx((16, 16 + 4))
    assert (
        traffic(found[4, SEPARATE])
        == traffic(found[4, AS_WRITTEN])
        == pytest.approx((16 + 16, 16 + 4))
    )
    assert traffic(found[1, NONE]) == pytest.approx((4, 4)), "out is loaded and drawn to"


def test_what_is_not_resolved_only_changes_its_count() -> None:
    text = """
    frame: {width: 100, height: 100, fps: 100}
    renderPasses:
      main:
        attachments: [{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}]
        subpasses: [{colorAttachments: [0]}]
    """
    found = made(text)
    assert list(found) == [(1, NONE), (2, AS_WRITTEN), (4, AS_WRITTEN), (8, AS_WRITTEN)]
    assert [traffic(each)[1] for each in found.values()] == pytest.approx([4, 8, 16, 32])


def test_attachments_without_images_take_no_memory_in_any_variant() -> None:
    text = """
    frame: {width: 100, height: 100, fps: 100}
    renderPasses:
      main:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          out: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses: [{colorAttachments: [color], resolveAttachments: [out]}]
    """
    found = made(text)
    assert traffic(found[4, SEPARATE]) == pytest.approx((16, 16 + 4))
    assert {each.cost.total.memory_mib for each in found.values()} == {0.0}


def test_a_pass_that_is_begun_twice_resolves_twice() -> None:
    text = """
    frame: {width: 100, height: 100, fps: 100}
    renderPasses:
      main:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          out: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses: [{colorAttachments: [color], resolveAttachments: [out]}]
    commands:
      - beginRenderPass: {renderPass: main}
      - endRenderPass
      - beginRenderPass: {renderPass: main}
      - endRenderPass
    """
    found = made(text)
    assert traffic(found[4, INLINE]) == pytest.approx((0, 8))
    assert traffic(found[4, SEPARATE]) == pytest.approx((32, 32 + 8))


def test_multisampled_render_to_single_sampled_has_no_other_place_to_resolve() -> None:
    text = """
    frame: {width: 100, height: 100, fps: 100}
    images: {out: {format: R8G8B8A8_UNORM, samples: 1}}
    renderPasses:
      main:
        attachments: [{image: out, loadOp: CLEAR, storeOp: STORE}]
        subpasses: [{colorAttachments: [0], multisampledRenderToSingleSampled: {rasterizationSamples: 4}}]
    """
    found = made(text)
    assert {traffic(each) for each in found.values()} == {(0.0, 4.0)}
    assert [
        each.cost.passes[0].shading.samples
        for each in found.values()
        if each.cost.passes[0].shading
    ] == [1, 2, 4, 8]


def test_a_frame_without_multisampling_has_no_variants() -> None:
    assert (
        made(
            "renderPasses: {main: {attachments: [{samples: 1, format: R8_UNORM}], subpasses: "
            "[{colorAttachments: [0]}]}}"
        )
        == {}
    )


def test_a_count_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="no sample count 3"):
        variants(document(RENDERING), None, Terms(), (3,))


def test_offered_is_what_the_device_says_of_every_format() -> None:
    text = RENDERING.replace("D32_SFLOAT_S8_UINT", "D32_SFLOAT")
    assert [made(text, LAZY)[count, INLINE].offered for count in (2, 4, 8)] == [False, True, False]
    assert made(text)[4, INLINE].offered is None
    assert made(RENDERING, LAZY)[4, INLINE].offered is None, "nothing is known of stencil"
    assert made(text, LAZY._replace(minimum=True))[8, INLINE].offered is None, (
        "not promised is not refused"
    )


def plain(found: Amount) -> tuple[float, ...]:
    return tuple(round(value, 6) for value in found)


@st.composite
def resolving(draw: st.DrawFn) -> dict[str, Any]:
    """Frames of a pass or a rendering with colours and depth, each resolved inside, by command, or
    not at all.
    """
    colors = draw(st.integers(1, 3))
    depth = draw(st.booleans())
    count = draw(st.sampled_from([2, 4, 8]))
    names = [f"c{n}" for n in range(colors)] + (["d"] if depth else [])
    where = {
        name: draw(
            st.sampled_from(["inside", "command", "never"] if name != "d" else ["inside", "never"])
        )
        for name in names
    }
    formats = {name: "D32_SFLOAT" if name == "d" else "R8G8B8A8_UNORM" for name in names}
    images = {name: {"format": formats[name], "samples": count} for name in names}
    images |= {
        f"{name}_out": {"format": formats[name], "samples": 1}
        for name in names
        if where[name] != "never"
    }
    load = {name: draw(st.sampled_from(["CLEAR", "LOAD"])) for name in names}
    store = {
        name: "STORE" if where[name] == "command" else draw(st.sampled_from(["STORE", "DONT_CARE"]))
        for name in names
    }
    after: list[Any] = [
        {"resolveImage": {"srcImage": n, "dstImage": f"{n}_out"}}
        for n in names
        if where[n] == "command"
    ]
    found: dict[str, Any] = {"frame": {"width": 100, "height": 100, "fps": 100}, "images": images}
    if draw(st.booleans()):
        infos = {
            name: {
                "image": name,
                "loadOp": load[name],
                "storeOp": store[name],
                "resolveMode": "NONE",
            }
            | (
                {"resolveMode": "SAMPLE_ZERO", "resolveImage": f"{name}_out"}
                if where[name] == "inside"
                else {}
            )
            for name in names
        }
        begin = {"colorAttachments": [infos[n] for n in names if n != "d"]} | (
            {"depthAttachment": infos["d"]} if depth else {}
        )
        found["commands"] = [{"beginRendering": begin}, "endRendering", *after]
        return found
    attachments = {
        name: {"image": name, "loadOp": load[name], "storeOp": store[name]} for name in names
    }
    inside = [name for name in names if where[name] == "inside"]
    attachments |= {
        f"{name}_out": {"image": f"{name}_out", "loadOp": "DONT_CARE", "storeOp": "STORE"}
        for name in inside
    }
    subpass: dict[str, Any] = {
        "colorAttachments": [n for n in names if n != "d"],
        "resolveAttachments": [f"{n}_out" if n in inside else None for n in names if n != "d"],
    }
    if depth:
        subpass["depthStencilAttachment"] = "d"
        if "d" in inside:
            subpass["depthStencilResolve"] = {
                "attachment": "d_out",
                "depthResolveMode": "SAMPLE_ZERO",
                "stencilResolveMode": "NONE",
            }
    found["renderPasses"] = {"main": {"attachments": attachments, "subpasses": [subpass]}}
    recorded = draw(st.booleans())
    if after or recorded:
        found["commands"] = [{"beginRenderPass": {"renderPass": "main"}}, "endRenderPass", *after]
    return found


@examples(1)
@given(resolving())
def test_laws_of_frames_that_resolve(description: dict[str, Any]) -> None:
    """With its own count a frame is as written; inside costs at most what is written, apart at
    least what inside costs, and the difference is all samples stored and read.
    """
    text = json.dumps(description)
    count = description["images"]["c0"]["samples"]
    found = made(text, LAZY)
    written = frame_cost(Frame(document(text)), LAZY, Terms())
    assert plain(found[count, AS_WRITTEN].cost.total) == plain(written.total)
    assert found[count, AS_WRITTEN].cost.passes == written.passes
    if (count, INLINE) not in found:
        return
    inline, separate = found[count, INLINE].cost.total, found[count, SEPARATE].cost.total
    assert all(a <= b + 1e-9 for a, b in zip(plain(inline), plain(written.total), strict=True))
    resolved = [name for name in description["images"] if f"{name}_out" in description["images"]]
    assert separate.read_mb_per_s - inline.read_mb_per_s == pytest.approx(4 * count * len(resolved))
    assert separate.write_mb_per_s - inline.write_mb_per_s <= 4 * count * len(resolved) + 1e-9
    assert separate.memory_mib >= inline.memory_mib
    one = found[1, NONE].cost.total
    assert all(a <= b + 1e-9 for a, b in zip(plain(one), plain(separate), strict=True))
    assert one.memory_mib == pytest.approx(
        len({n.removesuffix("_out") for n in description["images"]}) * 4e4 / 2**20
    )


@examples(1.5, suppress_health_check=[HealthCheck.too_slow])
@given(frames())
def test_no_frame_is_too_odd(description: dict[str, Any]) -> None:
    found = document(json.dumps(description))
    own = profile(found.description, builtin("mali-g76"))
    before = frame_cost(Frame(found), own, Terms())
    for each in variants(found, own, Terms(), COUNTS):
        assert all(value >= 0 for value in each.cost.total)
    assert frame_cost(Frame(found), own, Terms()) == before, "the description is as it was"


@pytest.mark.parametrize(
    "example", [each for each in all_examples() if "Pipeline" not in each.text], ids=str
)
def test_examples_of_the_rules_have_variants(example: Any) -> None:
    found = document(example.text)
    for each in variants(found, profile(found.description, builtin("mali-g76")), Terms()):
        assert all(value >= 0 for value in each.cost.total)
