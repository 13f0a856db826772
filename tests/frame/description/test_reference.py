"""The texts of keys and enumerants: every one has a title in words, a meaning, a unit if it is a
number, and a term that exists.
"""

from __future__ import annotations

from typing import Any

import pytest

from msaa_lint.cli.schema import description_schema
from msaa_lint.frame.description import models
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.reference.entries import SECTIONS
from msaa_lint.frame.description.reference.enumerants import ENUMERANTS
from msaa_lint.frame.description.reference.lookup import (
    STRUCTURES,
    enumerant_text,
    key_at,
    key_text,
    path_text,
    source_of,
    unit_of,
)
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.metal import names as metal
from msaa_lint.frame.vulkan.enums import VALUES

SCHEMA = description_schema()
KINDS = {
    name: kind
    for name, kind in vars(models).items()
    if isinstance(kind, type) and issubclass(kind, Record) and name in STRUCTURES
}
KEYS = [(kind, name) for kind in KINDS.values() for name in kind.SHAPE]
NUMBERS = frozenset({"int", "number", "share", "samples", "shading", "subpass", "slot"})


def properties(node: Any) -> list[tuple[str, dict[str, Any]]]:
    """Every property of every object in a schema."""
    own = list(node.get("properties", {}).items())
    return own + [found for inner in node.get("$defs", {}).values() for found in properties(inner)]


def is_number(shape: Shape) -> bool:
    if shape[0] == "word":
        return any(isinstance(word, int) for word in shape[1])
    return shape[0] in NUMBERS or any(
        is_number(part) for part in shape[1:] if isinstance(part, tuple) and shape[0] != "caseless"
    )


def test_the_reference_has_the_keys_of_the_models_and_no_others() -> None:
    assert {name: set(structure.keys) for name, structure in STRUCTURES.items()} == {
        name: set(KINDS[name].SHAPE) for name in STRUCTURES
    }


def test_every_property_of_the_schema_has_a_title_in_words_and_a_description() -> None:
    found = properties(SCHEMA)
    assert len(found) == len(KEYS) > 300
    for name, schema in found:
        assert schema["title"] != name
        assert schema["title"][0].isupper(), name
        assert schema["description"][-1] == schema["markdownDescription"][-1] == ".", name
        assert len(schema["description"].split()) >= 4, name


@pytest.mark.parametrize(
    ("kind", "name"), KEYS, ids=lambda value: value if isinstance(value, str) else value.__name__
)
def test_a_number_has_a_unit(kind: type[Record], name: str) -> None:
    unit = unit_of(kind, name)
    assert bool(unit) == is_number(kind.SHAPE[name])
    assert (f"Unit: {unit}." in key_text(kind, name).description) == bool(unit)


def test_descriptions_name_the_specifications_members() -> None:
    """The names are those of the registry that the tables are generated from."""
    registry = pytest.importorskip("vulkan_object").get_vulkan_object()
    members = {
        name: {member.name for member in structure.members}
        for name, structure in registry.structs.items()
    }
    terms = (
        members.keys() | registry.commands.keys() | registry.bitmasks.keys() | registry.enums.keys()
    )
    for kind, name in KEYS:
        term, _, member = source_of(kind, name).partition("::")
        if term[:2] in ("Vk", "vk"):
            assert term in terms, (kind, name)
            assert not member or member in members[term], (kind, name)


def test_sections_are_all_used_and_all_known() -> None:
    used = {structure.section for structure in STRUCTURES.values()} | {
        key.section for structure in STRUCTURES.values() for key in structure.keys.values()
    }
    assert used - {""} == set(SECTIONS)


def test_a_text_states_meaning_absence_source_and_section() -> None:
    text = key_text(models.Image, "extent")
    assert text.title == "Size"
    assert text.description == (
        "The size of mip level 0, in texels. If absent: the size of the framebuffer or render area "
        "that uses it. "
        "VkImageCreateInfo::extent; Vulkan specification, Images."
    )
    assert "[VkImageCreateInfo::extent](https://docs.vulkan.org/" in text.markdown


@pytest.mark.parametrize(
    ("path", "title"),
    [
        (("images",), "Images"),
        (("images", "color", "format"), "Format"),
        (("renderPasses", "forward", "attachments", "color", "storeOp"), "Store operation"),
        (("renderPasses", "forward", "attachments", 0, "storeOp"), "Store operation"),
        (("renderPasses", "forward", "subpasses", 0, "colorAttachments", 0, "layout"), "Layout"),
        (("commands", 2, "beginRendering"), "Begin dynamic rendering"),
        (("commands", 2, "beginRendering", "colorAttachments", 0, "loadOp"), "Load operation"),
        (("commands", 2, "pipelineBarrier", "images", 0, "newLayout"), "New layout"),
        (
            ("metal", "renderPasses", "forward", "colorAttachments", "0", "storeAction"),
            "Store action",
        ),
        (("device", "sampleCounts", "color"), "Color"),
    ],
)
def test_a_path_leads_to_its_text(path: tuple[str | int, ...], title: str) -> None:
    text = path_text(path)
    assert text is not None
    assert text.title == title


@pytest.mark.parametrize(
    "path",
    [
        (),
        ("images", "color"),
        ("imagez",),
        ("images", "color", "format", "x"),
        ("device", "name", "x"),
    ],
)
def test_a_path_to_no_key_has_no_text(path: tuple[str, ...]) -> None:
    assert key_at(path) is None
    assert path_text(path) is None


def test_enumerants_exist_and_have_sentences() -> None:
    for enum, values in ENUMERANTS.items():
        assert values.keys() <= set(VALUES[enum] if enum in VALUES else metal.ENUMS[enum])
        assert all(text.endswith(".") for text in values.values())
    assert (
        enumerant_text("VkAttachmentStoreOp", "VK_ATTACHMENT_STORE_OP_DONT_CARE")
        == ENUMERANTS["VkAttachmentStoreOp"]["DONT_CARE"]
    )
    assert enumerant_text("MTLStoreAction", ".store") == ENUMERANTS["MTLStoreAction"]["store"]
    assert enumerant_text("VkAttachmentStoreOp", "STOER") is None
    assert enumerant_text("VkFormat", "D16_UNORM") is None


def test_the_schema_describes_enumerants() -> None:
    short = SCHEMA["$defs"]["VkAttachmentLoadOp"]["anyOf"][0]  # type: ignore[index,call-overload]
    assert (
        dict(zip(short["enum"], short["enumDescriptions"], strict=True))
        == ENUMERANTS["VkAttachmentLoadOp"]
    )
