"""Reports of devices: each dialect gives the same device, a class of devices promises what it must,
and nothing hostile crashes.
"""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given
from hypothesis import strategies as st

from msaa_lint.frame.devices.reports import NotAReport, Report, pick, read
from tests.frame.devices import reported
from tests.strength import examples

COUNTS = {1, 2, 4, 8, 16, 32, 64}


def one(text: str) -> Report:
    (found,) = read(text, "own.json")
    return found


def changed(dialect: dict[str, Any], value: object, *path: str | int) -> str:
    """A dialect with another value at a path."""
    at: Any = dialect
    for key in path[:-1]:
        at = at[key]
    at[path[-1]] = value
    return json.dumps(dialect)


@pytest.mark.parametrize("dialect", reported.DIALECTS)
def test_a_dialect_gives_the_device(dialect: str) -> None:
    found = one(reported.DIALECTS[dialect])
    profile, details = found.profile, found.details
    assert (profile.name, profile.vendor, profile.tiler, profile.minimum) == (
        "Mali-G999 MC3",
        "arm",
        True,
        False,
    )
    assert profile.color_samples == (1, 4, 8)
    assert profile.depth_samples == (1, 4)
    assert profile.stencil_samples == (1, 4, 8, 16)
    assert profile.integer_samples == (1, 4)
    assert profile.depth_resolve_modes == ("SAMPLE_ZERO", "MIN", "MAX")
    assert profile.stencil_resolve_modes == ("SAMPLE_ZERO",)
    assert (profile.independent_resolve, profile.independent_resolve_none) == (False, True)
    assert profile.features == (
        "dynamicRendering",
        "sampleRateShading",
        "shaderStorageImageMultisample",
    )
    assert profile.extensions == (
        "VK_ARM_shader_core_properties",
        "VK_EXT_sample_locations",
        "VK_KHR_depth_stencil_resolve",
    )
    assert (profile.api_version, profile.max_efficient_samples) == ("1.3.77", 4)
    assert (
        details.counts["no_attachments"],
        details.counts["sampled_integer"],
        details.counts["storage"],
    ) == ((1, 2, 4, 8), (1,), (1,))
    assert (
        details.standard_sample_locations,
        details.sub_pixel_precision_bits,
        details.max_framebuffer,
    ) == (True, 8, (8192, 4096))
    assert (details.device_type, details.driver) == ("integrated GPU", "Own v7")
    assert profile.source.startswith("own.json: ")
    assert "Arm GPU Best Practices" in profile.source


@pytest.mark.parametrize("dialect", reported.DIALECTS)
def test_memory_is_read_where_the_dialect_has_it(dialect: str) -> None:
    found = one(reported.DIALECTS[dialect])
    if dialect == "vulkaninfo-json":
        assert found.profile.memory_types is None
        assert found.details.heaps is None
        assert found.notes == ("memory types are not in it: the text of `vulkaninfo` has them",)
        return
    assert found.profile.memory_types == (
        (),
        ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_COHERENT"),
        ("DEVICE_LOCAL", "LAZILY_ALLOCATED"),
    )
    assert found.details.heaps == ((3 << 30, True), (256 << 20, False))
    assert found.notes == ()


def test_old_spellings_of_vulkaninfo() -> None:
    text = reported.text()
    old = text.replace("GPU0:", "GPU0").replace(
        ": count = 3\n\t\tSAMPLE_COUNT_1_BIT\n\t\tSAMPLE_COUNT_4_BIT\n\t\tSAMPLE_COUNT_8_BIT",
        " = 0xd",
    )
    old = (
        old.replace("memoryTypes[", "memoryTypes[")
        .replace("]:\n\t\theapIndex", "] :\n\t\theapIndex")
        .replace("= true", "= 1")
    )
    old = old.replace("MEMORY_", "VK_MEMORY_").replace("0x0011: count = 2", "0x11:")
    assert old != text
    assert one(old).profile == one(text).profile


def test_several_devices() -> None:
    found = read(
        reported.text("Own A", "Own B").replace(
            "INTEGRATED_GPU\n\tdeviceName        = Own B", "CPU\n\tdeviceName        = Own B"
        )
    )
    assert [each.profile.name for each in found] == ["Own A", "Own B"]
    assert found[0].profile.memory_types == found[1].profile.memory_types
    assert pick(found, "2") is found[1]
    assert pick(found, "own b") is found[1]
    assert pick(found, "") is found[0], "the other is a CPU"
    assert (pick(found, "0"), pick(found, "3"), pick(found, "Own C"), pick(found, "²")) == (
        None,
        None,
        None,
        None,
    )
    assert pick(read(reported.text("Own A", "Own B")), "") is None


def test_a_profile_is_a_minimum() -> None:
    base, more = read(json.dumps(reported.profiles()), "own.json")
    profile = base.profile
    assert (profile.name, profile.minimum, profile.api_version) == ("VP_OWN_base", True, "1.1.106")
    assert (profile.vendor, profile.tiler, profile.memory_types, profile.max_efficient_samples) == (
        None,
        None,
        None,
        None,
    )
    assert profile.color_samples == (1, 4)
    assert (profile.depth_samples, profile.integer_samples) == (None, None), (
        "what it does not list is unknown"
    )
    assert profile.depth_resolve_modes == ("SAMPLE_ZERO", "MIN"), "what both alternatives have"
    assert profile.stencil_resolve_modes is None
    assert profile.independent_resolve is None, "one alternative alone has it"
    assert profile.independent_resolve_none is None, "false is no promise"
    assert profile.features == ("sampleRateShading",), "the optional one is not guaranteed"
    assert profile.extensions == ("VK_KHR_depth_stencil_resolve", "VK_KHR_maintenance1")
    assert profile.source == "own.json: Vulkan profile VP_OWN_base version 2 (Our own)"
    assert more.profile.color_samples == (1, 4), "what the required profile has, and its own"
    assert more.profile.depth_samples == (2,)
    assert more.profile.features == ("sampleRateShading",)
    assert (base.details.sub_pixel_precision_bits, more.details.sub_pixel_precision_bits) == (4, 8)


def test_profiles_that_require_each_other() -> None:
    root = reported.profiles()
    root["profiles"]["VP_OWN_base"]["profiles"] = ["VP_OWN_more", "VP_OWN_none"]
    base, more = read(json.dumps(root))
    assert base.profile.depth_samples == more.profile.depth_samples == (2,)
    assert base.notes == ("the file has no profile 'VP_OWN_none', which VP_OWN_base requires",)


def test_the_same_hardware_has_its_tiles() -> None:
    known = one(reported.DIALECTS["gpuinfo"].replace("Mali-G999 MC3", "Mali-G76")).profile
    assert known.tile is not None
    assert known.tile.color_bytes == 8192
    assert known.compression is not None
    assert "as of mali-g76" in known.source
    assert (
        one(reported.DIALECTS["gpuinfo"].replace("Mali-G999 MC3", "Mali-G760")).profile.tile is None
    )
    assert (
        one(
            reported.DIALECTS["gpuinfo"]
            .replace("Mali-G999 MC3", "Mali-G76")
            .replace("5045", "4203")
        ).profile.tile
        is None
    )


@pytest.mark.parametrize(
    ("vendor", "kind", "tiler"),
    [
        (0x13B5, 1, True),
        (0x144D, 1, False),
        (0x10005, 4, False),
        (0x10005, 1, None),
        (0x10DE, 2, False),
        (7, 2, None),
    ],
)
def test_tilers(vendor: int, kind: int, tiler: bool | None) -> None:
    given_report = reported.gpuinfo()
    given_report["properties"].update(vendorID=vendor, deviceType=kind)
    assert one(json.dumps(given_report)).profile.tiler is tiler


WRONG = [
    (
        ("properties", "limits", "framebufferColorSampleCounts"),
        {"a": 1},
        "color_samples",
        "framebufferColorSampleCounts: an object",
    ),
    (
        ("properties", "limits", "framebufferColorSampleCounts"),
        -1,
        "color_samples",
        "framebufferColorSampleCounts: -1",
    ),
    (
        ("properties", "limits", "framebufferColorSampleCounts"),
        [4, "VK_X"],
        "color_samples",
        "framebufferColorSampleCounts: a list",
    ),
    (
        ("core12", "properties", "framebufferIntegerColorSampleCounts"),
        "many",
        "integer_samples",
        "framebufferIntegerColorSampleCounts: 'many'",
    ),
    (("memory", "memoryTypes", 2, "propertyFlags"), None, "memory_types", "memory types: None"),
    (("memory", "memoryTypes"), [1, 2], "memory_types", "memory types: None"),
]


@pytest.mark.parametrize(("path", "value", "fact", "note"), WRONG)
def test_a_wrong_type_is_unknown_and_mentioned(
    path: tuple[str | int, ...], value: object, fact: str, note: str
) -> None:
    found = one(changed(reported.gpuinfo(), value, *path))
    assert getattr(found.profile, fact) is None
    assert [each for each in found.notes if each.startswith(note)], found.notes
    assert found.profile.depth_samples == (1, 4), "the rest is read"


def test_a_wrong_feature_is_mentioned() -> None:
    found = one(changed(reported.gpuinfo(), "perhaps", "features", "alphaToOne"))
    assert found.notes == ("feature alphaToOne: 'perhaps' where a boolean is due, passed over",)


def test_a_mask_of_nothing_is_unknown() -> None:
    found = one(
        changed(reported.gpuinfo(), 0, "properties", "limits", "framebufferColorSampleCounts")
    )
    assert found.profile.color_samples is None
    assert found.notes == ()
    root = reported.gpuinfo()
    root["core12"]["properties"]["supportedDepthResolveModes"] = 0
    assert one(json.dumps(root)).profile.depth_resolve_modes == ("SAMPLE_ZERO", "MIN", "MAX"), (
        "the extension's value counts"
    )


def test_new_bits_count_for_nothing() -> None:
    root = reported.vulkaninfo_json()
    limits = root["capabilities"]["device"]["properties"]["VkPhysicalDeviceProperties"]["limits"]
    limits["framebufferColorSampleCounts"].append("VK_SAMPLE_COUNT_128_BIT")
    assert one(json.dumps(root)).profile.color_samples == (1, 4, 8)
    assert one(
        changed(reported.gpuinfo(), 0x8D, "properties", "limits", "framebufferColorSampleCounts")
    ).profile.color_samples == (1, 4, 8)
    assert one(
        changed(reported.gpuinfo(), 1 << 20 | 1, "memory", "memoryTypes", 0, "propertyFlags")
    ).profile.memory_types == (
        ("DEVICE_LOCAL",),
        ("DEVICE_LOCAL", "HOST_VISIBLE", "HOST_COHERENT"),
        ("DEVICE_LOCAL", "LAZILY_ALLOCATED"),
    )


NO_REPORTS = {
    "": "not a device report",
    "images: {}": "not a device report",
    "{}": "not a device report",
    "[]": "not a device report",
    '{"properties": 3, "environment": 1, "extended": 2}': "not a device report",
    '{"a": 1,}': "broken at line 1, column 9",
    "[" * 100_000: "nested too deeply",
    '{"a": ' + "9" * 5000 + "}": "a number that is too long",
    '{"capabilities": {}, "profiles": {}}': "no device in it",
    '{"properties": {}, "environment": {}, "memory": {}}': "no sample counts in it",
    "==========\nVULKANINFO\n==========\n": "no GPU in it",
    "==========\nVULKANINFO\n==========\nDevices:\n=====\nGPU0:\n\tapiVersion = 1.3.230\n": "without --summary",
}


@pytest.mark.parametrize("text", NO_REPORTS)
def test_what_is_no_report(text: str) -> None:
    with pytest.raises(NotAReport, match=NO_REPORTS[text]):
        read(text)


def test_a_description_is_no_report() -> None:
    with pytest.raises(NotAReport):
        read('{"device": {"name": "x"}, "images": {}}')


def sane(found: list[Report]) -> None:
    """What holds of every report, whatever it was made from."""
    assert found
    for report in found:
        profile = report.profile
        assert isinstance(profile.name, str)
        assert profile.name
        for each in (
            profile.color_samples,
            profile.depth_samples,
            profile.integer_samples,
            report.details.counts["storage"],
        ):
            assert each is None or (
                each and set(each) <= COUNTS and list(each) == sorted(set(each))
            )
        assert profile.depth_resolve_modes is None or profile.depth_resolve_modes
        assert profile.tiler in (True, False, None)
        assert len(report.notes) <= 12
        assert all(len(note) < 400 for note in report.notes)
        json.dumps([profile, report.details, report.notes])


@examples(1.5, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from(sorted(reported.DIALECTS)), st.integers(0, 12_000), st.text(max_size=3))
@example("vulkaninfo-text", 500, "")
def test_a_report_that_is_cut_off_never_crashes(dialect: str, length: int, more: str) -> None:
    try:
        sane(read(reported.DIALECTS[dialect][:length] + more))
    except NotAReport as error:
        assert str(error)


JUNK = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=20)
    | st.sampled_from(["0x", "13", "VK_SAMPLE_COUNT_4_BIT", "\ud800"]),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=6,
)


@examples(3)
@given(
    st.data(), st.sampled_from(["gpuinfo", "vulkaninfo_json", "devsim", "vkjson", "profiles"]), JUNK
)
def test_a_report_with_a_value_exchanged_never_crashes(
    data: st.DataObject, dialect: str, junk: object
) -> None:
    root: Any = json.loads(json.dumps(getattr(reported, dialect)()))
    at = root
    while True:
        keys = list(at) if isinstance(at, dict) else list(range(len(at)))
        key = data.draw(st.sampled_from(keys))
        if not (isinstance(at[key], (dict, list)) and at[key]) or data.draw(st.integers(0, 4)) == 0:
            break
        at = at[key]
    at[key] = junk
    try:
        sane(read(json.dumps(root)))
    except NotAReport as error:
        assert str(error)


@examples(2)
@given(st.data())
def test_vulkaninfo_with_lines_shuffled_never_crashes(data: st.DataObject) -> None:
    lines = reported.text("Own A", "Own B").splitlines()
    for _ in range(data.draw(st.integers(1, 4))):
        first, second = (
            data.draw(st.integers(0, len(lines) - 1)),
            data.draw(st.integers(0, len(lines) - 1)),
        )
        lines[first], lines[second] = lines[second], lines[first][: data.draw(st.integers(0, 60))]
    try:
        sane(read("\n".join(lines)))
    except NotAReport as error:
        assert str(error)


def test_a_large_report_is_read_in_bounded_time_and_notes() -> None:
    root = reported.gpuinfo()
    root["features"] = {f"feature{n}": {"no": "boolean"} for n in range(20_000)}
    root["extensions"] = [{"extensionName": f"VK_OWN_{n}"} for n in range(20_000)]
    found = one(json.dumps(root))
    assert len(found.notes) == 12
    assert found.profile.extensions is not None
    assert len(found.profile.extensions) == 4000
