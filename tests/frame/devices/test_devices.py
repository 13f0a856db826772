"""The built-in profiles against Vulkan's guarantees, and against the reports they are from where
those are at hand.
"""

from __future__ import annotations

import json
import os

import pytest

from msaa_lint.frame.devices import DeviceProfile, builtin, names, sample_counts
from msaa_lint.frame.devices.builtin_profiles import RECORDED
from msaa_lint.frame.devices.vendors import TILERS, VENDORS, vendor_of
from tests.paths import SAMPLES

CLASSES = ("portable", "portable-tiler", "desktop")


def profile(name: str) -> DeviceProfile:
    found = builtin(name)
    assert found is not None
    return found


def test_names() -> None:
    assert set(names()) == {
        *(
            "mali-g76",
            "mali-g610",
            "mali-g715",
            "mali-g720",
            "adreno-740",
            "apple-m1",
            "apple-a15",
            "powervr",
            "v3d",
        ),
        *("samsung-xclipse", "nvidia", "amd", "intel", "lavapipe", *CLASSES),
    }
    assert builtin("mali") is None
    assert builtin("Mali-G76") is None
    assert builtin("") is None


@pytest.mark.parametrize("name", names())
def test_profiles_keep_vulkans_guarantees(name: str) -> None:
    device = profile(name)
    for counts in (device.color_samples, device.depth_samples, device.stencil_samples):
        assert counts is not None
        assert {1, 4} <= set(counts)
        assert list(counts) == sorted(set(counts))
    assert device.integer_samples is None or 1 in device.integer_samples
    assert device.depth_resolve_modes is not None and "SAMPLE_ZERO" in device.depth_resolve_modes
    assert (
        device.stencil_resolve_modes is not None and "SAMPLE_ZERO" in device.stencil_resolve_modes
    )
    assert "AVERAGE" not in device.stencil_resolve_modes
    if device.independent_resolve:
        assert device.independent_resolve_none
    assert set(device.extensions or ()) <= set(RECORDED)
    assert device.vendor in {*VENDORS.values(), "khronos"}
    assert device.source
    assert (device.api_version or "").split(".")[0] == "1"
    assert device.max_efficient_samples is None or device.max_efficient_samples in (
        device.color_samples or ()
    )


@pytest.mark.parametrize("name", names())
def test_only_classes_are_minimums(name: str) -> None:
    device = profile(name)
    assert device.minimum == (name in CLASSES)
    assert (device.memory_types is None) == (name in CLASSES)
    if device.memory_types is not None:
        assert len(set(device.memory_types)) == len(device.memory_types)
        assert any("DEVICE_LOCAL" in flags for flags in device.memory_types)
        assert any({"HOST_VISIBLE", "HOST_COHERENT"} <= set(flags) for flags in device.memory_types)


def test_lazily_allocated_memory() -> None:
    offering = {
        name
        for name in names()
        if any("LAZILY_ALLOCATED" in flags for flags in profile(name).memory_types or ())
    }
    assert offering == {
        "mali-g76",
        "mali-g610",
        "mali-g715",
        "mali-g720",
        "adreno-740",
        "apple-m1",
        "apple-a15",
        "powervr",
    }


def test_mali_g76() -> None:
    device = profile("mali-g76")
    assert (device.name, device.vendor, device.tiler, device.minimum) == (
        "Mali-G76",
        "arm",
        True,
        False,
    )
    assert device.color_samples == device.depth_samples == device.stencil_samples == (1, 4, 8)
    assert device.integer_samples is None
    assert device.memory_types == (
        ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_COHERENT"),
        ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_CACHED"),
        ("DEVICE_LOCAL", "LAZILY_ALLOCATED"),
        ("DEVICE_LOCAL", "PROTECTED"),
    )
    assert device.depth_resolve_modes == device.stencil_resolve_modes == ("SAMPLE_ZERO",)
    assert (device.independent_resolve, device.independent_resolve_none) == (False, False)
    assert (device.features, device.max_efficient_samples, device.api_version) == (
        ("sampleRateShading",),
        4,
        "1.1.213",
    )
    assert "38559" in device.source


def test_classes_promise_no_more_than_they_may() -> None:
    portable, tiler, desktop = map(profile, CLASSES)
    assert portable.color_samples == tiler.color_samples == (1, 4)
    assert desktop.color_samples == (1, 2, 4)
    assert portable.integer_samples == tiler.integer_samples == desktop.integer_samples == (1,)
    assert (portable.features, portable.extensions) == ((), ())
    assert (portable.tiler, tiler.tiler, desktop.tiler) == (None, True, None)
    assert tiler.independent_resolve is None


def test_unknown_facts_are_none() -> None:
    assert profile("desktop").tiler is None
    assert profile("apple-m1").integer_samples is None
    assert profile("nvidia").max_efficient_samples is None
    assert DeviceProfile("mine") == DeviceProfile(
        "mine", vendor=None, memory_types=None, minimum=False
    )


@pytest.mark.parametrize(
    ("mask", "counts"),
    [(0, ()), (1, (1,)), (13, (1, 4, 8)), (127, (1, 2, 4, 8, 16, 32, 64)), (128 | 4, (4,))],
)
def test_sample_counts(mask: int, counts: tuple[int, ...]) -> None:
    assert sample_counts(mask) == counts


def test_vendors() -> None:
    assert vendor_of(0x13B5) == "arm"
    assert vendor_of(0x10005) == "mesa"
    assert vendor_of(0x1414) is None
    assert set(TILERS) <= set(VENDORS.values())


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("mali-g715", "gpuinfo_report_38609_mali_g715.json"),
        ("adreno-740", "gpuinfo_report_38724_adreno_740.json"),
        ("apple-m1", "gpuinfo_report_38819_apple_m1.json"),
        ("nvidia", "gpuinfo_report_38868_rtx4070.json"),
    ],
)
def test_profiles_agree_with_their_reports(name: str, file: str) -> None:
    path = os.path.join(SAMPLES, "devices", file)
    if not os.path.exists(path):
        pytest.skip(
            f"the report {file} is not at hand: MSAA_LINT_SAMPLES names the folder of samples"
        )
    with open(path, encoding="utf-8") as text:
        report = json.load(text)
    device, limits = profile(name), report["properties"]["limits"]
    assert device.color_samples == sample_counts(limits["framebufferColorSampleCounts"])
    assert device.depth_samples == sample_counts(limits["framebufferDepthSampleCounts"])
    assert device.stencil_samples == sample_counts(limits["framebufferStencilSampleCounts"])
    core = report.get("core12", {}).get("properties", {})
    integer = core.get("framebufferIntegerColorSampleCounts")
    assert device.integer_samples == (None if integer is None else sample_counts(integer))
    bits = {
        1: "DEVICE_LOCAL",
        2: "HOST_VISIBLE",
        4: "HOST_COHERENT",
        8: "HOST_CACHED",
        16: "LAZILY_ALLOCATED",
        32: "PROTECTED",
    }
    masks = dict.fromkeys(entry["propertyFlags"] for entry in report["memory"]["memoryTypes"])
    assert device.memory_types == tuple(
        tuple(flag for bit, flag in bits.items() if mask & bit) for mask in masks
    )
    resolve = {
        entry["name"]: entry["value"]
        for entry in report["extended"]["deviceproperties2"]
        if entry["extension"] == "VK_KHR_depth_stencil_resolve"
    }
    modes = {1: "SAMPLE_ZERO", 2: "AVERAGE", 4: "MIN", 8: "MAX"}
    assert device.depth_resolve_modes == tuple(
        m for bit, m in modes.items() if int(resolve["supportedDepthResolveModes"]) & bit
    )
    assert device.stencil_resolve_modes == tuple(
        m for bit, m in modes.items() if int(resolve["supportedStencilResolveModes"]) & bit
    )
    assert device.independent_resolve == (resolve["independentResolve"] == "true")
    assert device.independent_resolve_none == (resolve["independentResolveNone"] == "true")
    assert ("sampleRateShading" in (device.features or ())) == bool(
        report["features"]["sampleRateShading"]
    )
    offered = {entry["extensionName"] for entry in report["extensions"]}
    assert set(device.extensions or ()) == offered & set(RECORDED)
    assert device.api_version == report["properties"]["apiVersionText"]
    assert device.vendor == vendor_of(report["properties"]["vendorID"])
