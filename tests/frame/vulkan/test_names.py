"""Every spelling of every enumerant, and the nearest name to a wrong one."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.vulkan.enums import ALIASES, BITLESS, ENUMS, PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import (
    VENDORS,
    flag_names,
    from_value,
    nearest_name,
    parse_enum,
    parse_flags,
)
from tests.strength import examples

FLAGS = sorted(enum for enum in VALUES if "FlagBits" in enum)
SPELLINGS = [
    (enum, short, canonical) for enum, names in ENUMS.items() for short, canonical in names.items()
]


def with_bit(name: str) -> str:
    """The name as Vulkan writes it, with `_BIT` before a vendor's suffix."""
    head, _, vendor = name.rpartition("_")
    return f"{head}_BIT_{vendor}" if head and vendor in VENDORS else f"{name}_BIT"


@pytest.mark.parametrize("enum", sorted(VALUES))
def test_every_spelling_gives_the_canonical_name(enum: str) -> None:
    prefix = PREFIXES[enum]
    for short, canonical in ENUMS[enum].items():
        spellings = [short, prefix + short, prefix.removeprefix("VK_") + short]
        if enum in FLAGS and short not in BITLESS.get(enum, ()):
            spellings += [with_bit(short), prefix + with_bit(short)]
        if enum.endswith("2"):
            spellings += [f"{prefix}2_{short}", f"{prefix.removeprefix('VK_')}2_{short}"]
        for spelling in spellings:
            assert parse_enum(enum, spelling) == canonical, spelling


@pytest.mark.parametrize("enum", sorted(VALUES))
def test_canonical_names_and_values_are_one_to_one(enum: str) -> None:
    values = VALUES[enum]
    assert len(set(values.values())) == len(values)
    assert all(from_value(enum, value) == name for name, value in values.items())
    assert not set(values) & set(ALIASES.get(enum, {}))
    assert set(ENUMS[enum].values()) == set(values)
    assert len({name.upper() for name in ENUMS[enum]}) == len(ENUMS[enum])


@pytest.mark.parametrize("enum", sorted(VALUES))
def test_case_is_vulkans_and_nearest_forgives_it(enum: str) -> None:
    for name in VALUES[enum]:
        lower = (PREFIXES[enum] + name).lower()
        assert parse_enum(enum, lower) is None
        assert nearest_name(lower, VALUES[enum]) == name
        assert nearest_name(name.lower(), VALUES[enum]) == name


@pytest.mark.parametrize(
    ("enum", "text", "name"),
    [
        ("VkAttachmentStoreOp", "VK_ATTACHMENT_STORE_OP_DONT_CARE", "DONT_CARE"),
        ("VkAttachmentStoreOp", "NONE_EXT", "NONE"),
        ("VkImageLayout", "VK_IMAGE_LAYOUT_PRESENT_SRC_KHR", "PRESENT_SRC_KHR"),
        ("VkImageLayout", "DEPTH_ATTACHMENT_OPTIMAL_KHR", "DEPTH_ATTACHMENT_OPTIMAL"),
        ("VkImageUsageFlagBits", "VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT", "TRANSIENT_ATTACHMENT"),
        ("VkSampleCountFlagBits", "VK_SAMPLE_COUNT_4_BIT", "4"),
        ("VkSampleCountFlagBits", "SAMPLE_COUNT_4", "4"),
        ("VkSampleCountFlagBits", "64", "64"),
        ("VkImageType", "VK_IMAGE_TYPE_2D", "2D"),
        ("VkImageType", "2D", "2D"),
        ("VkFormat", "VK_FORMAT_D32_SFLOAT", "D32_SFLOAT"),
        ("VkResolveModeFlagBits", "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT_KHR", "SAMPLE_ZERO"),
        (
            "VkResolveModeFlagBits",
            "VK_RESOLVE_MODE_EXTERNAL_FORMAT_DOWNSAMPLE_ANDROID",
            "EXTERNAL_FORMAT_DOWNSAMPLE_ANDROID",
        ),
        (
            "VkResolveModeFlagBits",
            "VK_RESOLVE_MODE_EXTERNAL_FORMAT_DOWNSAMPLE_BIT_ANDROID",
            "EXTERNAL_FORMAT_DOWNSAMPLE_ANDROID",
        ),
        ("VkSubpassDescriptionFlagBits", "CUSTOM_RESOLVE", "CUSTOM_RESOLVE_EXT"),
        (
            "VkSubpassDescriptionFlagBits",
            "VK_SUBPASS_DESCRIPTION_SHADER_RESOLVE_BIT_QCOM",
            "CUSTOM_RESOLVE_EXT",
        ),
        ("VkPipelineStageFlagBits2", "VK_PIPELINE_STAGE_TRANSFER_BIT", "TRANSFER"),
        ("VkPipelineStageFlagBits2", "VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT", "TRANSFER"),
        ("VkPipelineStageFlagBits2", "VK_PIPELINE_STAGE_2_RESOLVE_BIT", "RESOLVE"),
        ("VkPipelineStageFlagBits2", "COLOR_ATTACHMENT_OUTPUT", "COLOR_ATTACHMENT_OUTPUT"),
        ("VkAccessFlagBits2", "VK_ACCESS_2_SHADER_STORAGE_READ_BIT", "SHADER_STORAGE_READ"),
        ("VkAccessFlagBits2", "VK_ACCESS_SHADER_READ_BIT", "SHADER_READ"),
        ("VkImageCreateFlagBits", "VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT", "2D_ARRAY_COMPATIBLE"),
    ],
)
def test_spellings_from_the_specification(enum: str, text: str, name: str) -> None:
    assert parse_enum(enum, text) == name


@pytest.mark.parametrize(
    ("enum", "text"),
    [
        ("VkAttachmentStoreOp", "VK_ATTACHMENT_LOAD_OP_DONT_CARE"),
        ("VkAttachmentStoreOp", "STORE_BIT"),
        ("VkAttachmentStoreOp", "VK_STORE"),
        ("VkAttachmentStoreOp", " STORE"),
        ("VkAttachmentStoreOp", "store"),
        ("VkAttachmentStoreOp", ""),
        ("VkAttachmentStoreOp", "VK_ATTACHMENT_STORE_OP_"),
        ("VkAttachmentStoreOp", "0"),
        ("VkImageLayout", "PRESENT_SRC"),
        ("VkResolveModeFlagBits", "NONE_BIT"),
        ("VkShaderStageFlagBits", "VK_SHADER_STAGE_ALL_GRAPHICS_BIT"),
        ("VkImageUsageFlagBits", "TRANSIENT_BIT_ATTACHMENT"),
        ("VkImageUsageFlagBits", "SAMPLED_BIT_BIT"),
        ("VkPipelineStageFlagBits2", "2_RESOLVE"),
        ("VkSampleCountFlagBits", "3"),
        ("VkFormat", "R8G8B8A8_UNORM" + "\0"),
        ("VkFormat", "VK_FORMAT_" * 100_000),
    ],
)
def test_what_is_no_name(enum: str, text: str) -> None:
    assert parse_enum(enum, text) is None


def test_values_are_the_registrys() -> None:
    assert VALUES["VkFormat"]["R8G8B8A8_UNORM"] == 37
    assert VALUES["VkImageLayout"]["PRESENT_SRC_KHR"] == 1000001002
    assert VALUES["VkAttachmentStoreOp"]["NONE"] == 1000301000
    assert VALUES["VkMemoryPropertyFlagBits"]["LAZILY_ALLOCATED"] == 16
    assert VALUES["VkPipelineStageFlagBits2"]["COLOR_ATTACHMENT_OUTPUT"] == 0x400
    assert VALUES["VkPipelineStageFlagBits2"]["RESOLVE"] == 1 << 33
    assert VALUES["VkAccessFlagBits2"]["SHADER_SAMPLED_READ"] == 1 << 32
    assert VALUES["VkSampleCountFlagBits"] == {
        "1": 1,
        "2": 2,
        "4": 4,
        "8": 8,
        "16": 16,
        "32": 32,
        "64": 64,
    }
    assert from_value("VkImageLayout", 2) == "COLOR_ATTACHMENT_OPTIMAL"
    assert from_value("VkImageLayout", 3_000_000_000) is None


@examples(1)
@given(st.data())
def test_masks_and_names_go_both_ways(data: st.DataObject) -> None:
    enum = data.draw(st.sampled_from(FLAGS))
    bits = {
        name: value for name, value in VALUES[enum].items() if value and value & (value - 1) == 0
    }
    chosen = data.draw(st.lists(st.sampled_from(sorted(bits)), unique=True))
    mask = sum(bits[name] for name in chosen)
    names = flag_names(enum, mask)
    assert names is not None
    assert parse_flags(enum, str(mask)) == names
    assert parse_flags(enum, hex(mask)) == names
    if from_value(enum, mask) is None:
        assert names == sorted(chosen, key=bits.__getitem__)
    if chosen:
        assert parse_flags(enum, " | ".join(chosen)) == chosen
        assert (
            parse_flags(enum, f"{mask} ({'|'.join(PREFIXES[enum] + name for name in chosen)})")
            == names
        )


@pytest.mark.parametrize(
    ("enum", "text", "names"),
    [
        (
            "VkImageUsageFlagBits",
            "COLOR_ATTACHMENT|TRANSIENT_ATTACHMENT",
            ["COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT"],
        ),
        ("VkImageUsageFlagBits", "0", []),
        ("VkImageUsageFlagBits", "0x11", ["TRANSFER_SRC", "COLOR_ATTACHMENT"]),
        (
            "VkImageUsageFlagBits",
            "17 (VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)",
            ["TRANSFER_SRC", "COLOR_ATTACHMENT"],
        ),
        ("VkImageUsageFlagBits", "0 ()", []),
        ("VkImageUsageFlagBits", "SAMPLED | SAMPLED", ["SAMPLED"]),
        ("VkPipelineStageFlagBits2", "NONE", []),
        ("VkPipelineStageFlagBits2", "NONE | COPY", ["COPY"]),
        ("VkShaderStageFlagBits", "31", ["ALL_GRAPHICS"]),
        ("VkShaderStageFlagBits", "0x7FFFFFFF", ["ALL"]),
        ("VkDynamicState", "VIEWPORT | SCISSOR", ["VIEWPORT", "SCISSOR"]),
    ],
)
def test_flags(enum: str, text: str, names: list[str]) -> None:
    assert parse_flags(enum, text) == names


@pytest.mark.parametrize(
    ("enum", "text", "part"),
    [
        ("VkImageUsageFlagBits", "SAMPLED | SAMPELD", "SAMPELD"),
        ("VkImageUsageFlagBits", "SAMPLED |", ""),
        ("VkImageUsageFlagBits", "", ""),
        ("VkImageUsageFlagBits", "0x40000000", "0x40000000"),
        ("VkImageUsageFlagBits", "010", "010"),
        ("VkImageUsageFlagBits", "0b11", "0b11"),
        ("VkImageUsageFlagBits", "-1", "-1"),
        ("VkImageUsageFlagBits", "9" * 5000, "9" * 5000),
        ("VkImageUsageFlagBits", "18446744073709551616", "18446744073709551616"),
        ("VkImageUsageFlagBits", "SAMPLED)", "SAMPLED"),
        ("VkImageUsageFlagBits", "SAMPLED (SAMPLED)", "SAMPLED"),
        ("VkImageUsageFlagBits", "4 (SAMPELD)", "SAMPELD"),
        ("VkDynamicState", "0", "0"),
    ],
)
def test_the_unknown_part_of_flags_is_told(enum: str, text: str, part: str) -> None:
    with pytest.raises(ValueError) as error:
        parse_flags(enum, text)
    assert str(error.value) == part


def test_masks_with_unknown_bits_have_no_names() -> None:
    assert flag_names("VkMemoryPropertyFlagBits", 1 << 40) is None
    assert flag_names("VkMemoryPropertyFlagBits", -1) is None
    assert flag_names("VkMemoryPropertyFlagBits", 1 << 10_000) is None
    assert flag_names("VkMemoryPropertyFlagBits", 0) == []


@pytest.mark.parametrize(
    ("enum", "word", "meant"),
    [
        ("VkAttachmentStoreOp", "dont_care", "DONT_CARE"),
        ("VkAttachmentStoreOp", "DONTCARE", "DONT_CARE"),
        ("VkAttachmentStoreOp", "Don't care", "DONT_CARE"),
        ("VkAttachmentStoreOp", "VK_ATTACHMENT_LOAD_OP_DONT_CARE", "DONT_CARE"),
        ("VkAttachmentStoreOp", "DISCARD", None),
        ("VkImageLayout", "PRESENT_SRC", "PRESENT_SRC_KHR"),
        ("VkImageLayout", "VK_IMAGE_LAYOUT_COLOR_ATACHMENT_OPTIMAL", "COLOR_ATTACHMENT_OPTIMAL"),
        ("VkImageLayout", "COLOR_ATTACHMENT", "COLOR_ATTACHMENT_OPTIMAL"),
        ("VkImageUsageFlagBits", "TRANSIENT", "TRANSIENT_ATTACHMENT"),
        ("VkImageUsageFlagBits", "VK_IMAGE_USAGE_SAMPELD_BIT", "SAMPLED"),
        ("VkFormat", "D24S8", "D24_UNORM_S8_UINT"),
        ("VkFormat", "D32", "D32_SFLOAT"),
        ("VkFormat", "RGBA8", "R8G8B8A8_UNORM"),
        ("VkFormat", "rgba16_sfloat", "R16G16B16A16_SFLOAT"),
        ("VkFormat", "B10G11R11_UFLOAT", "B10G11R11_UFLOAT_PACK32"),
        ("VkFormat", "R8G8B8A8_UNROM", "R8G8B8A8_UNORM"),
        ("VkFormat", "???", None),
        ("VkFormat", "", None),
    ],
)
def test_nearest_enumerant(enum: str, word: str, meant: str | None) -> None:
    assert nearest_name(word, VALUES[enum]) == meant


@examples(1)
@given(st.sampled_from(SPELLINGS), st.integers(min_value=0), st.characters())
def test_nearest_is_one_of_the_words_whatever_the_slip(
    spelling: tuple[str, str, str], place: int, letter: str
) -> None:
    enum, short, _ = spelling
    at = place % (len(short) + 1)
    found = nearest_name(short[:at] + letter + short[at + 1 :], VALUES[enum])
    assert found is None or found in VALUES[enum]
