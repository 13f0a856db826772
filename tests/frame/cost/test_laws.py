"""Laws that hold for every frame: costs are linear, sums are sums, and nothing unknown is
counted.
"""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.cost.amounts import Amount, FrameCost, Terms
from msaa_lint.frame.cost.model import difference, frame_cost
from msaa_lint.frame.devices import DeviceProfile, builtin
from msaa_lint.frame.devices.tile_models import MODELS
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.global_facts import profile
from tests.frame.cost.frames import cost, document
from tests.frames import frames
from tests.strength import examples

OPS = {
    "loadOp": st.sampled_from(["LOAD", "CLEAR", "DONT_CARE"]),
    "storeOp": st.sampled_from(["STORE", "DONT_CARE"]),
}
COMPRESSED = DeviceProfile(
    "compressed", tiler=True, compression=dict.fromkeys((1, 2, 4, 8, 16, 32, 64), (0.5, 0.75))
)


@st.composite
def passes(draw: st.DrawFn) -> dict[str, Any]:
    """Frames in which everything is known: some passes of some attachments of one count, and
    commands on their images.
    """
    samples = draw(st.sampled_from([1, 2, 4, 8]))
    formats = draw(st.lists(st.sampled_from(["R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT"]), max_size=3))
    formats += ["D24_UNORM_S8_UINT"] if not formats or draw(st.booleans()) else []
    images = {f"i{n}": {"format": format, "samples": samples} for n, format in enumerate(formats)}
    made: dict[str, Any] = {}
    for number in range(draw(st.integers(1, 3))):
        attachments, color, depth = [], [], None
        for n, format in enumerate(formats):
            ops = {name: draw(op) for name, op in OPS.items()}
            stencil = {f"stencil{name[0].upper()}{name[1:]}": draw(op) for name, op in OPS.items()}
            attachments.append({"image": f"i{n}", **ops, **(stencil if "S8" in format else {})})
            if "S8" in format:
                depth = n
            else:
                color.append(n)
        made[f"p{number}"] = {
            "attachments": attachments,
            "subpasses": [{"colorAttachments": color, "depthStencilAttachment": depth}],
        }
    found: dict[str, Any] = {
        "frame": {"width": 64, "height": 32, "fps": 50},
        "images": images,
        "renderPasses": made,
    }
    if draw(st.booleans()):
        begins = draw(st.lists(st.sampled_from(sorted(made)), max_size=4))
        reads = draw(st.lists(st.sampled_from(sorted(images)), max_size=3))
        found["commands"] = [
            each
            for name in begins
            for each in ({"beginRenderPass": {"renderPass": name}}, "endRenderPass")
        ]
        found["commands"] += [{"readImage": {"image": name, "samples": "ALL"}} for name in reads]
    return found


def of(description: dict[str, Any], terms: Terms | None = None) -> FrameCost:
    return cost(json.dumps(description), COMPRESSED, terms)


def scaled(amount: Amount, factor: float, memory: float) -> Amount:
    return Amount(
        amount.read_mb_per_s * factor,
        amount.write_mb_per_s * factor,
        amount.memory_mib * memory,
        amount.milliwatts * factor,
    )


@given(passes(), st.integers(1, 240))
def test_linear_in_the_rate(description: dict[str, Any], fps: int) -> None:
    assert of(description, Terms(fps=fps)).total == pytest.approx(
        scaled(of(description, Terms(fps=1)).total, fps, 1)
    )


@given(passes(), st.integers(1, 8), st.integers(1, 8))
def test_linear_in_the_area(description: dict[str, Any], wide: int, high: int) -> None:
    larger = of(description, Terms(width=64 * wide, height=32 * high)).total
    assert larger == pytest.approx(scaled(of(description).total, wide * high, wide * high))


@given(passes())
def test_linear_in_the_samples(description: dict[str, Any]) -> None:
    before = of(description).total
    for image in description["images"].values():
        image["samples"] *= 2
    assert of(description).total == pytest.approx(scaled(before, 2, 2))


@given(passes())
def test_the_total_is_the_sum_of_its_passes_and_they_of_their_lines(
    description: dict[str, Any],
) -> None:
    found = of(description)
    for name in ("read_mb_per_s", "write_mb_per_s", "milliwatts"):
        assert getattr(found.total, name) == pytest.approx(
            math.fsum(getattr(each.amount, name) for each in found.passes)
        )
        assert found.corrected is not None
        corrected = [each.corrected for each in found.passes]
        assert getattr(found.corrected, name) == pytest.approx(
            math.fsum(getattr(each, name) for each in corrected)
        )
    for each in found.passes:
        moved = sum(line.bytes for line in each.lines)
        assert each.amount.traffic_mb_per_s == pytest.approx(moved * found.fps / 1e6)
        assert each.amount.milliwatts == pytest.approx(each.amount.traffic_mb_per_s / 10)
    assert found.total.memory_mib == pytest.approx(
        sum(image.committed or 0 for image in found.images) / 2**20
    )


@given(passes())
def test_compression_never_adds(description: dict[str, Any]) -> None:
    found = of(description)
    assert found.corrected is not None
    assert found.corrected.read_mb_per_s == pytest.approx(found.total.read_mb_per_s * 0.5)
    assert found.corrected.write_mb_per_s == pytest.approx(found.total.write_mb_per_s * 0.75)
    assert found.corrected.memory_mib == found.total.memory_mib
    assert found.unknown == () or all("no command begins it" in text for text in found.unknown)


@given(passes(), st.data())
def test_an_unknown_operation_counts_nothing_and_is_named(
    description: dict[str, Any], data: st.DataObject
) -> None:
    name = data.draw(st.sampled_from(sorted(description["renderPasses"])))
    attachment = data.draw(st.sampled_from(description["renderPasses"][name]["attachments"]))
    before = of(description)
    op = attachment.pop("storeOp")
    after = of(description)
    begun = any(each.name == name for each in after.passes)
    assert after.total.read_mb_per_s == before.total.read_mb_per_s
    assert after.total.write_mb_per_s <= before.total.write_mb_per_s
    assert (after.total.write_mb_per_s < before.total.write_mb_per_s) == (begun and op == "STORE")
    assert any("storeOp is not stated" in text for text in after.unknown) == begun


@examples(1)
@given(
    frames(),
    st.sampled_from(
        [None, "mali-g76", "nvidia", "v3d", "powervr", "apple-m1", "adreno-740", "portable"]
    ),
    st.sampled_from(sorted(MODELS)),
)
def test_any_frame_has_a_cost(description: Any, name: str | None, tile: str) -> None:
    """Whatever a description holds, the model ends in finite figures, and says the same twice."""
    if isinstance(description.get("device"), dict):
        description["device"] |= {"tile": {"model": tile}, "compression": {"1": 0.5}}
    found = document(json.dumps(description))
    device = profile(found.description, builtin(name) if name is not None else None)
    once, again = (frame_cost(Frame(found), device) for _ in range(2))
    assert once == again
    for amount in (once.total, once.corrected, *(each.amount for each in once.passes)):
        for figure in amount or ():
            assert 0 <= figure < math.inf
    for each in once.passes:
        for line in each.lines:
            assert line.bytes >= 0
            assert line.direction in ("read", "write")


def test_a_difference_is_of_each_figure() -> None:
    assert difference(Amount(4, 3, 2, 1), Amount(1, 1, 3, 1)) == Amount(3, 2, -1, 0)
