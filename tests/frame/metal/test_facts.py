"""Facts of frames in Metal's words: what they are, where they stand, and when they are not
known.
"""

from __future__ import annotations

import pytest

from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.frame.metal.families import counts, offers_count, offers_memoryless, profile
from tests.frame.metal.frames import ARTICLE, BEST, aspect, document, image, of, stated


def test_the_api_is_never_unknown() -> None:
    for text, api in (
        (ARTICLE, "METAL"),
        ("metal: {textures: {a: {}}}", "METAL"),
        ("images: {a: {}}", "VULKAN"),
    ):
        found = list(subjects(document(text)))
        assert found and {subject.facts.values["frame.api"] for subject in found} == {api}
        assert document(text).api == api


def test_what_a_texture_states() -> None:
    facts = image(ARTICLE, "ms")
    assert {
        name: facts.values[name]
        for name in facts.values
        if name.startswith("image.") and name in WORDS
    } == {
        "image.storage_mode": "private",
        "image.texture_type": "type2DMultisample",
        "image.type_fits": True,
        "image.usage_words": ["renderTarget", "shaderRead"],
        "image.memoryless_offered": True,
        "image.memoryless_conflicts": ["shaderRead"],
        "image.transient": False,
        "image.supported": True,
        "image.supported_samples": [1, 2, 4],
    }
    assert facts.values["device.metal_family"] == "apple7"
    for name, text in (
        ("image.storage_mode", "private"),
        ("image.texture_type", "type2DMultisample"),
        ("image.type_fits", "type2DMultisample"),
        ("image.usage_words", "[renderTarget, shaderRead]"),
        ("image.memoryless_conflicts", "shaderRead"),
        ("image.samples", "4"),
        ("image.format", "r8Unorm"),
        ("image.transient", "private"),
        ("device.metal_family", "apple7"),
    ):
        assert stated(ARTICLE, facts, name) == text, name


WORDS = {
    "image.storage_mode", "image.texture_type", "image.type_fits", "image.usage_words",
    "image.memoryless_offered",
    "image.memoryless_conflicts", "image.transient", "image.supported", "image.supported_samples",
}  # fmt: skip


def test_what_is_not_stated_is_not_known() -> None:
    facts = image(
        "metal: {textures: {a: {sampleCount: 4, usage: [renderTarget], pixelFormat: r8Unorm}}}", "a"
    )
    assert not {
        "image.storage_mode",
        "image.texture_type",
        "image.type_fits",
        "image.memoryless_offered",
        "image.transient",
    } & set(facts.values)
    assert "device.metal_family" not in facts.values
    anything = image(
        "metal: {textures: {a: {usage: [renderTarget, unknown], storageMode: private}}}", "a"
    )
    assert not {"image.usage_words", "image.memoryless_conflicts", "image.usage"} & set(
        anything.values
    )


def test_the_actions_of_an_attachment() -> None:
    color, depth = (
        aspect(ARTICLE, "colorAttachments[0]"),
        aspect(ARTICLE, "depthAttachment", "depth"),
    )
    names = (
        "load_action",
        "store_action",
        "has_resolve_texture",
        "resolve_texture",
        "resolves_by_action",
    )
    assert [color.values.get(f"aspect.{name}") for name in names] == [
        "clear",
        "storeAndMultisampleResolve",
        True,
        "drawable",
        True,
    ]
    assert [depth.values.get(f"aspect.{name}") for name in names] == [
        "clear",
        "store",
        False,
        None,
        False,
    ]
    assert [stated(ARTICLE, color, f"aspect.{name}") for name in names] == [
        "clear", "storeAndMultisampleResolve", "drawable", "drawable", "storeAndMultisampleResolve",
    ]  # fmt: skip
    assert (
        color.values["aspect.store"],
        color.values["aspect.resolved"],
        color.values["aspect.read_later"],
    ) == ("STORE", True, False)
    target = aspect(ARTICLE, "resolveTexture")
    assert [target.values.get(f"aspect.{name}") for name in names] == [
        None,
        None,
        False,
        None,
        False,
    ]
    assert (target.values["attachment.drawn"], target.values["attachment.is_resolve_target"]) == (
        False,
        True,
    )


@pytest.mark.parametrize("action", ["", ", storeAction: unknown"])
def test_a_resolve_by_an_unknown_action_is_not_known(action: str) -> None:
    textures = "a: {pixelFormat: r8Unorm, sampleCount: 4}, b: {pixelFormat: r8Unorm}"
    passes = f"p: {{colorAttachments: [{{texture: a, resolveTexture: b{action}}}]}}"
    facts = aspect(
        f"metal: {{textures: {{{textures}}}, renderPasses: {{{passes}}}}}", "colorAttachments[0]"
    )
    assert not {"aspect.resolved", "aspect.resolves_by_action", "aspect.store"} & set(facts.values)


def test_the_filter_of_a_resolve() -> None:
    textures = "a: {pixelFormat: depth32Float, sampleCount: 4}, b: {pixelFormat: depth32Float}"
    attachment = (
        "{texture: a, resolveTexture: b, storeAction: multisampleResolve, depthResolveFilter: .max}"
    )
    text = (
        f"metal: {{textures: {{{textures}}}, renderPasses: {{p: {{depthAttachment: "
        f"{attachment}}}}}}}"
    )
    facts, (resolve,) = aspect(text, "depthAttachment", "depth"), of(text, "resolve")
    assert (facts.values["aspect.resolve_filter"], resolve.facts.values["resolve.filter"],
    resolve.facts.values["resolve.mode"]) == (
        "max", "max", "MAX",
    )  # fmt: skip
    assert (
        stated(text, facts, "aspect.resolve_filter")
        == stated(text, resolve.facts, "resolve.mode")
        == ".max"
    )
    assert resolve.path == "metal.renderPasses.p.depthAttachment"
    without = text.replace(", depthResolveFilter: .max", "")
    assert "aspect.resolve_filter" not in aspect(without, "depthAttachment", "depth").values
    assert of(without, "resolve")[0].facts.values["resolve.mode"] == "SAMPLE_ZERO"


@pytest.mark.parametrize(
    ("family", "yes", "no"),
    [
        (None, {1, 4}, {16, 32, 64}),
        ("apple1", {1, 2, 4}, {8, 16, 32, 64}),
        ("apple6", {1, 2, 4}, {8, 16, 32, 64}),
        ("apple7", {1, 2, 4}, {16, 32, 64}),
        ("apple10", {1, 2, 4}, {16, 32, 64}),
        ("mac2", {1, 4}, {16, 32, 64}),
        ("common3", {1, 4}, {16, 32, 64}),
        ("metal3", {1, 4}, {16, 32, 64}),
    ],
)
def test_counts_by_family(family: str | None, yes: set[int], no: set[int]) -> None:
    every = (1, 2, 4, 8, 16, 32, 64)
    assert (
        {count for count in every if offers_count(count, family, None)}
        == yes
        == set(counts(family, None))
    )
    assert {count for count in every if offers_count(count, family, None) is False} == no


def test_stated_counts_are_all_there_are() -> None:
    assert [offers_count(count, "apple7", (1, 4, 8)) for count in (1, 2, 4, 8, 16)] == [
        True,
        False,
        True,
        True,
        False,
    ]
    text = (
        "metal: {family: mac2, supportedSampleCounts: [8, 1, 4], textures: {a: {sampleCount: "
        "2}, b: {sampleCount: 8}}}"
    )
    assert image(text, "a").values["image.supported"] is False
    assert image(text, "b").values["image.supported"] is True
    assert image(text, "a").values["image.supported_samples"] == [1, 4, 8]
    assert stated(text, image(text, "a"), "image.supported") == "2"


@pytest.mark.parametrize(
    ("family", "offered"),
    [
        ("apple1", False),
        ("apple2", True),
        ("apple10", True),
        ("mac1", None),
        ("mac2", None),
        ("metal3", None),
    ],
)
def test_memoryless_by_family(family: str, offered: bool | None) -> None:
    assert offers_memoryless(family) is offered
    facts = image(f"metal: {{family: {family}, textures: {{a: {{}}}}}}", "a")
    assert facts.values.get("image.memoryless_offered") is offered


def test_memoryless_by_device() -> None:
    text = "metal: {family: mac2, textures: {a: {}}}\ndevice: apple-m1"
    assert image(text, "a").values["image.memoryless_offered"] is True
    other = text.replace("apple-m1", "{vendor: intel, memoryTypes: [[DEVICE_LOCAL]]}")
    assert image(other, "a").values["image.memoryless_offered"] is False


def test_a_family_is_a_class_of_devices() -> None:
    found = profile("apple7", None)
    assert found is not None
    assert (found.name, found.vendor, found.tiler, found.minimum, found.color_samples) == (
        "apple7",
        "apple",
        True,
        True,
        (1, 2, 4),
    )
    assert profile("mac2", None) is None and profile(None, (1, 4)) is None
    facts = image(BEST, "ms").values
    assert (facts["device.vendor"], facts["device.tiler"], facts["device.lazy_memory"]) == (
        "apple",
        True,
        True,
    )
    named = image("device: mali-g76\n" + BEST, "ms").values
    assert (named["device.vendor"], named["device.metal_family"]) == ("arm", "apple7")
