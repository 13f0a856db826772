"""Real reports, where the folder of samples is at hand: exact values, and the built-in profiles
against them.
"""

from __future__ import annotations

import pytest

from msaa_lint.frame.devices import DeviceProfile, builtin
from msaa_lint.frame.devices.builtin_profiles import RECORDED
from msaa_lint.frame.devices.reports import Report, read
from tests.paths import SAMPLES

FOLDER = SAMPLES / "devices"


def sample(name: str) -> Report:
    path = FOLDER / name
    if not path.exists():
        pytest.skip(
            f"the report {name} is not at hand: MSAA_LINT_SAMPLES names the folder of samples"
        )
    (found,) = read(path.read_text(encoding="utf-8"), name)
    return found


def facts(device: DeviceProfile) -> dict[str, object]:
    """What a built-in profile and a report of the same device agree in."""
    kept = device._replace(
        name="",
        source="",
        features=tuple(set(device.features or ()) & {"sampleRateShading"}),
        extensions=tuple(sorted(set(device.extensions or ()) & set(RECORDED))),
    )
    return kept._asdict()


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("mali-g715", "gpuinfo_report_38609_mali_g715.json"),
        ("adreno-740", "gpuinfo_report_38724_adreno_740.json"),
        ("apple-m1", "gpuinfo_report_38819_apple_m1.json"),
        ("nvidia", "gpuinfo_report_38868_rtx4070.json"),
        ("lavapipe", "vulkaninfo_llvmpipe_1.3.239.txt"),
    ],
)
def test_built_in_profiles_are_their_reports(name: str, file: str) -> None:
    known = builtin(name)
    assert known is not None
    assert facts(sample(file).profile) == facts(known)


def test_mali_g715() -> None:
    found = sample("gpuinfo_report_38609_mali_g715.json")
    assert (found.profile.name, found.profile.vendor, found.profile.api_version) == (
        "Mali-G715",
        "arm",
        "1.3.283",
    )
    assert (
        found.profile.color_samples
        == found.profile.integer_samples
        == found.details.counts["sampled_stencil"]
        == (1, 4, 8, 16)
    )
    assert found.details.counts["storage"] == (1,)
    assert found.details.heaps == ((7685464064, True), (104857600, True))
    assert found.profile.memory_types is not None
    assert ("DEVICE_LOCAL", "LAZILY_ALLOCATED") in found.profile.memory_types
    assert {"sampleRateShading", "dynamicRendering", "multisampledRenderToSingleSampled"} <= set(
        found.profile.features or ()
    )
    assert "alphaToOne" not in (found.profile.features or ())
    assert (len(found.profile.features or ()), len(found.profile.extensions or ())) == (173, 144)
    assert "r50p0" in found.profile.source


def test_adreno_740() -> None:
    found = sample("gpuinfo_report_38724_adreno_740.json")
    assert found.profile.depth_resolve_modes == ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX")
    assert found.profile.stencil_resolve_modes == ("SAMPLE_ZERO", "MIN")
    assert found.profile.memory_types is not None
    assert len(found.profile.memory_types) == 6
    assert found.details.counts["sample_locations"] == (1, 2, 4)


def test_m1() -> None:
    found = sample("gpuinfo_report_38819_apple_m1.json")
    assert found.profile.integer_samples is None, "a report without core 1.2"
    assert found.profile.depth_resolve_modes == ("SAMPLE_ZERO", "MIN", "MAX"), (
        "from text of the extension"
    )
    assert (found.profile.independent_resolve, found.details.sub_pixel_precision_bits) == (True, 4)
    assert found.details.heaps == ((16 << 30, True),)


def test_rtx_4070() -> None:
    found = sample("gpuinfo_report_38868_rtx4070.json")
    assert (found.profile.color_samples, found.profile.stencil_samples) == (
        (1, 2, 4, 8),
        (1, 2, 4, 8, 16),
    )
    assert found.profile.memory_types is not None
    assert not any("LAZILY_ALLOCATED" in flags for flags in found.profile.memory_types)
    assert found.details.heaps == ((12595494912, True), (17103839232, False))


def test_vulkaninfo_says_the_same_as_text_and_as_json() -> None:
    text, as_json = (
        sample("vulkaninfo_llvmpipe_1.3.239.txt"),
        sample("vulkaninfo_llvmpipe_1.3.239.json"),
    )
    assert as_json.profile.memory_types is None
    assert text.profile.memory_types == (
        ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_COHERENT", "HOST_CACHED"),
    )
    assert text.profile._replace(memory_types=None, source="") == as_json.profile._replace(
        source=""
    )
    assert text.details._replace(heaps=None) == as_json.details
    assert (len(text.profile.features or ()), len(text.profile.extensions or ())) == (157, 101)
    assert text.profile.depth_resolve_modes == ("SAMPLE_ZERO", "AVERAGE")
    assert text.profile.integer_samples == (1,)


def test_turnip() -> None:
    found = sample("VP_VULKANINFO_turnip_adreno740.json")
    assert (found.profile.name, found.profile.vendor, found.profile.minimum) == (
        "Turnip Adreno (TM) 740",
        "qualcomm",
        False,
    )
    assert found.profile.depth_resolve_modes == ("SAMPLE_ZERO",)
    assert found.profile.tile is not None


def test_profiles() -> None:
    baseline, roadmap = sample("VP_ANDROID_baseline_2022.json"), sample("VP_KHR_roadmap_2022.json")
    assert baseline.profile.minimum
    assert (baseline.profile.color_samples, baseline.profile.api_version) == ((1, 4), "1.1.106")
    assert (
        baseline.details.counts["sampled_integer"],
        baseline.details.counts["storage"],
        baseline.profile.memory_types,
    ) == (
        (1,),
        (1,),
        None,
    )
    assert "sampleRateShading" in (baseline.profile.features or ())
    assert (roadmap.profile.color_samples, roadmap.profile.api_version) == (None, "1.3.204")
    assert {"sampleRateShading", "dynamicRendering"} <= set(roadmap.profile.features or ())
    assert "wideLines" not in (roadmap.profile.features or ()), "optional"
