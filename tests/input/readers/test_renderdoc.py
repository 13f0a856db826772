"""RenderDoc's XML: every call with C's names and its place, the zip beside it, and what is no
capture.
"""

from __future__ import annotations

import io
import os
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place
from msaa_lint.input.readers import renderdoc, renderdoc_blobs
from msaa_lint.input.readers.renderdoc_calls import NEEDED_FOR, RENAMED_BY_CALL
from tests.input.readers.dialects_binary import RenderDoc, numbers
from tests.input.readers.dialects_binary import renderdoc as written
from tests.input.readers.programs import programs
from tests.paths import SAMPLES
from tests.strength import examples

FOLDER = SAMPLES / "captures"

CODE = (0x07230203).to_bytes(4, "little") + bytes(range(200))

IMAGE = {
    "sType": "VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO",
    "pNext": None,
    "format": "VK_FORMAT_R8G8B8A8_UNORM",
    "extent": {"width": 64, "height": 32, "depth": 1},
    "samples": "VK_SAMPLE_COUNT_4_BIT",
    "usage": "VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT",
}
RESOLVE = {
    "sType": "VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE",
    "pNext": None,
    "depthResolveMode": "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT",
}
PIPELINE = {
    "sType": "VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO",
    "pMultisampleState": {
        "rasterizationSamples": "VK_SAMPLE_COUNT_4_BIT",
        "minSampleShading": 0.25,
        "pSampleMask": [15],
    },
    "renderPass": 30,
}
PROGRAM: list[tuple[str, dict[str, Any]]] = [
    (
        "vkCreateInstance",
        {
            "pCreateInfo": {
                "pApplicationInfo": {"pApplicationName": "a <b> & c", "apiVersion": 4206592}
            },
            "pInstance": 1,
        },
    ),
    (
        "vkGetPhysicalDeviceProperties",
        {
            "physicalDevice": 2,
            "pProperties": {"vendorID": 5045, "limits": {"framebufferColorSampleCounts": 5}},
        },
    ),
    (
        "vkGetPhysicalDeviceMemoryProperties",
        {
            "physicalDevice": 2,
            "pMemoryProperties": {
                "memoryTypeCount": 1,
                "memoryTypes": [{"propertyFlags": 17, "heapIndex": 0}],
            },
        },
    ),
    ("vkGetPhysicalDeviceFeatures", {"physicalDevice": 2, "pFeatures": {"sampleRateShading": 1}}),
    (
        "vkCreateDevice",
        {
            "physicalDevice": 2,
            "pCreateInfo": {"ppEnabledExtensionNames": ["VK_KHR_swapchain"]},
            "pDevice": 3,
        },
    ),
    (
        "vkCreateSwapchainKHR",
        {"device": 3, "pCreateInfo": {"imageFormat": "VK_FORMAT_R8G8B8A8_UNORM"}, "pSwapchain": 4},
    ),
    ("vkGetSwapchainImagesKHR", {"device": 3, "swapchain": 4, "pSwapchainImages": [5, 6]}),
    ("vkCreateImage", {"device": 3, "pCreateInfo": IMAGE, "pAllocator": None, "pImage": 10}),
    ("vkSetDebugUtilsObjectNameEXT", {"pNameInfo": {"objectHandle": 10, "pObjectName": "colour"}}),
    ("vkAllocateMemory", {"device": 3, "pAllocateInfo": {"memoryTypeIndex": 0}, "pMemory": 11}),
    ("vkBindImageMemory", {"device": 3, "image": 10, "memory": 11, "memoryOffset": 0}),
    ("vkCreateImageView", {"device": 3, "pCreateInfo": {"image": 10}, "pView": 12}),
    (
        "vkCreateRenderPass2",
        {
            "device": 3,
            "pCreateInfo": {"pSubpasses": [{"pNext": RESOLVE, "pResolveAttachments": []}]},
            "pRenderPass": 30,
        },
    ),
    (
        "vkCreateFramebuffer",
        {"device": 3, "pCreateInfo": {"renderPass": 30, "pAttachments": [12]}, "pFramebuffer": 31},
    ),
    (
        "vkCreateShaderModule",
        {"device": 3, "pCreateInfo": {"codeSize": len(CODE), "pCode": CODE}, "pShaderModule": 32},
    ),
    (
        "vkCreateGraphicsPipelines",
        {
            "device": 3,
            "createInfoCount": 2,
            "pCreateInfos": [PIPELINE, PIPELINE],
            "pPipelines": [33, 34],
        },
    ),
    (
        "vkAllocateCommandBuffers",
        {"device": 3, "pAllocateInfo": {"commandPool": 39}, "pCommandBuffers": [40, 41]},
    ),
    (
        "vkBeginCommandBuffer",
        {"commandBuffer": 40, "pBeginInfo": {"flags": 0, "pInheritanceInfo": None}},
    ),
    (
        "vkCmdBeginRenderPass2",
        {
            "commandBuffer": 40,
            "pRenderPassBegin": {"renderPass": 30},
            "pSubpassBeginInfo": {"contents": 0},
        },
    ),
    ("vkCmdEndRenderPass2", {"commandBuffer": 40, "pSubpassEndInfo": {"pNext": None}}),
    (
        "vkCmdPipelineBarrier",
        {
            "commandBuffer": 40,
            "srcStageMask": 1,
            "dstStageMask": 2,
            "pImageMemoryBarriers": [{"srcQueueFamilyIndex": -1}],
        },
    ),
    (
        "vkCmdResolveImage",
        {
            "commandBuffer": 40,
            "srcImage": 10,
            "srcImageLayout": 6,
            "dstImage": 5,
            "dstImageLayout": 7,
            "pRegions": [],
        },
    ),
    ("vkEndCommandBuffer", {"commandBuffer": 40}),
    (
        "vkQueueSubmit",
        {"queue": 50, "submitCount": 1, "pSubmits": [{"pCommandBuffers": [40]}], "fence": 0},
    ),
    (
        "vkQueuePresentKHR",
        {"queue": 50, "pPresentInfo": {"pSwapchains": [4], "pImageIndices": [1]}},
    ),
]


class Everything(frozenset[str]):
    """Every call is wanted."""

    def __contains__(self, name: object) -> bool:
        return str(name).startswith("vk")

    def isdisjoint(self, other: object) -> bool:
        return False


def read(
    text: bytes, wanted: frozenset[str] = Everything(), name: str | None = None
) -> tuple[list[Call], CaptureError | None]:
    """The calls, and how reading ended. There is one mark, before the first call."""
    found: list[Call] = []
    marks: list[tuple[int, Mark]] = []
    broken = None
    try:
        for each in renderdoc.calls(io.BytesIO(text), wanted, name):
            if isinstance(each, Mark):
                marks.append((len(found), each))
            else:
                found.append(each)
    except CaptureError as error:
        broken = error
    assert [(at, mark.kind) for at, mark in marks] == (
        [(0, "frameless")] if b"<chunk " in text and (found or marks) else []
    )
    return found, broken


def split(program: list[tuple[str, dict[str, Any]]]) -> Iterator[tuple[str, dict[str, Any]]]:
    """The program as RenderDoc tells it: one object a call, swapchain images one by one."""
    for name, args in program:
        if name == "vkCreateGraphicsPipelines":
            for info, handle in zip(args["pCreateInfos"], args["pPipelines"], strict=False):
                yield (
                    name,
                    {**args, "createInfoCount": 1, "pCreateInfos": [info], "pPipelines": [handle]},
                )
        elif name == "vkAllocateCommandBuffers":
            for handle in args["pCommandBuffers"]:
                yield name, {**args, "pCommandBuffers": [handle]}
        elif name == "vkGetSwapchainImagesKHR":
            images = args["pSwapchainImages"]
            for count in range(1, len(images) + 1):
                yield (
                    name,
                    {
                        **args,
                        "device": 1,
                        "pSwapchainImageCount": count,
                        "pSwapchainImages": images[:count],
                    },
                )
        else:
            yield name, args


def without(value: Any, *keys: str) -> Any:
    """A structure without some members, at any depth."""
    if isinstance(value, dict):
        return {key: without(item, *keys) for key, item in value.items() if key not in keys}
    return [without(item, *keys) for item in value] if isinstance(value, list) else value


def test_every_call_has_cs_names() -> None:
    capture = written(PROGRAM)
    found, broken = read(capture.text())
    assert broken is None
    told = [(call.name, call.args) for call in found if call.name != "vkEnumeratePhysicalDevices"]
    instance, *others = told
    assert instance[0] == "vkCreateInstance"
    assert instance[1]["pInstance"] == 1
    assert instance[1]["pCreateInfo"]["pApplicationInfo"] == {
        "pApplicationName": "a <b> & c",
        "apiVersion": 4206592,
    }
    expected = [(name, numbers(without(args, "pCode"))) for name, args in split(PROGRAM)][1:]
    for name, args in expected:
        if name == "vkSetDebugUtilsObjectNameEXT":
            args["pNameInfo"]["objectType"] = "VK_OBJECT_TYPE_IMAGE"
    assert others == expected


@given(programs)
@examples(1)
def test_any_program(program: list[tuple[str, dict[str, Any]]]) -> None:
    told = [
        each
        for each in program
        if each[0] not in ("vkGetPhysicalDeviceProperties", "vkSetDebugUtilsObjectNameEXT")
    ]
    found, broken = read(written(told).text())
    assert broken is None
    expected = [(name, first_words(numbers(args))) for name, args in split(told)]
    assert [(call.name, call.args) for call in found] == expected


def first_words(value: Any) -> Any:
    """Sample masks cut to the word that RenderDoc writes."""
    if isinstance(value, dict):
        return {
            key: item[:1] if key == "pSampleMask" and item else first_words(item)
            for key, item in value.items()
        }
    return [first_words(item) for item in value] if isinstance(value, list) else value


@given(text=st.text(max_size=30), block=st.integers(1, 40))
@examples(2)
def test_names_of_any_characters(text: str, block: int) -> None:
    capture = written(
        [
            (
                "vkSetDebugUtilsObjectNameEXT",
                {"pNameInfo": {"objectHandle": 7, "pObjectName": text}},
            ),
            ("vkCmdDraw", {}),
        ]
    )
    name, draw = (
        each
        for each in renderdoc.calls(Slow(capture.text(), block), Everything(), None)
        if isinstance(each, Call)
    )
    assert name.args["pNameInfo"]["pObjectName"] == "".join(
        "?" if ord(each) < 32 and each not in "\t\n\r" else each for each in text
    )
    assert (draw.at.line, draw.at.column) == (11, 3)


def test_names_in_another_encoding() -> None:
    capture = written(
        [("vkSetDebugUtilsObjectNameEXT", {"pNameInfo": {"objectHandle": 7, "pObjectName": "é😀"}})]
    ).text()
    for other, name in (
        (capture.replace("é".encode(), b"\xe9"), "\ufffd😀"),
        (capture.replace("😀".encode(), b"\xf0\x9f"), "é\ufffd"),
    ):
        (call,), broken = read(other)
        assert broken is None
        assert call.args["pNameInfo"]["pObjectName"] == name


class Slow(io.BytesIO):
    """A stream that gives a few bytes at a time."""

    def __init__(self, data: bytes, block: int) -> None:
        super().__init__(data)
        self.block = block

    def read(self, size: int | None = -1, /) -> bytes:
        return super().read(self.block)


def test_the_device_is_told_before_the_call_that_finds_it() -> None:
    found, _ = read(written(PROGRAM).text())
    names = [call.name for call in found]
    queries = names[1:4]
    assert queries == [
        "vkGetPhysicalDeviceProperties",
        "vkGetPhysicalDeviceMemoryProperties",
        "vkGetPhysicalDeviceFeatures",
    ]
    assert names[4] == "vkEnumeratePhysicalDevices"
    assert found[4].args == {"instance": 1, "pPhysicalDeviceCount": 1, "pPhysicalDevices": [2]}
    # Of C's 32 memory types the one that is.
    assert found[2].args["pMemoryProperties"]["memoryTypes"] == [
        {"propertyFlags": 17, "heapIndex": 0}
    ]
    assert {call.at for call in found[1:5]} == {found[1].at}


def test_places_are_those_of_the_chunks() -> None:
    text = written(PROGRAM).text()
    lines = text.decode().split("\n")
    found, _ = read(text)
    chunks = [line for line in lines if "<chunk " in line]
    for call in found:
        assert call.at.line is not None and call.at.call is not None and call.at.column == 3
        line = lines[call.at.line - 1]
        assert line[call.at.column - 1 :].startswith("<chunk ")
        assert line == chunks[call.at.call] or line in chunks
    assert [
        call.at.call for call in found if not call.name.startswith(("vkGetPhysical", "vkEnumerate"))
    ] == [number for number in range(len(chunks)) if number != 1]
    one_line = text.replace(b"\n", b" ")
    places = [call.at for call in read(one_line)[0]]
    assert {place.line for place in places} == {1}
    assert all(one_line[(place.column or 0) - 1 :].startswith(b"<chunk ") for place in places)


def test_columns_count_characters() -> None:
    text = (
        written([("vkCmdDraw", {})]).text().replace(b"\t\t<chunk ", "<!-- 🎮é --><chunk ".encode())
    )
    (call,), _ = read(text)
    assert call.at.column == 12


def test_only_what_is_wanted_is_told() -> None:
    text = written(PROGRAM).text()
    for wanted in (
        frozenset({"vkCreateImage"}),
        frozenset({"vkQueuePresent", "vkCmdResolveImage"}),
        frozenset({"vkGetPhysicalDeviceFeatures"}),
    ):
        found, broken = read(text, wanted)
        assert broken is None
        assert {call.name.removesuffix("KHR") for call in found} == wanted
    everything, _ = read(text)
    some = frozenset(
        {
            "vkCreateImage",
            "vkGetSwapchainImages",
            "vkSetDebugUtilsObjectName",
            "vkGetPhysicalDeviceProperties",
        }
    )
    assert read(text, some)[0] == [
        call for call in everything if call.name.removesuffix("KHR").removesuffix("EXT") in some
    ]


def test_a_name_tells_its_objects_type() -> None:
    made: list[tuple[str, dict[str, Any]]] = [
        ("vkCreateFramebuffer", {"pFramebuffer": 7}),
        ("vkSetDebugUtilsObjectNameEXT", {"pNameInfo": {"objectHandle": 7, "pObjectName": "a"}}),
    ]
    found, _ = read(written(made).text(), frozenset({"vkSetDebugUtilsObjectName"}))
    assert [call.args for call in found] == [
        {
            "pNameInfo": {
                "objectType": "VK_OBJECT_TYPE_FRAMEBUFFER",
                "objectHandle": 7,
                "pObjectName": "a",
            }
        },
    ]
    found, _ = read(written(made[1:]).text())
    assert found[0].args["pNameInfo"]["objectType"] is None


def test_what_is_no_part_of_a_call_is_left_out() -> None:
    capture = RenderDoc()
    capture.chunk(
        "vkBeginCommandBuffer",
        {
            "CommandBuffer": 1,
            "BeginInfo": {"flags": 4},
            "BakedCommandBuffer": 2,
            "device": 3,
            "AllocateInfo": {},
        },
    )
    capture.chunk(
        "vkCmdDraw", {"commandBuffer": 1, "vertexCount": 3, "DebugMessages": [{"message": "x"}]}
    )
    capture.lines[-1:-1] = [
        "<callstack><address>140</address><address>141</address></callstack>",
        "<what>1<struct><uint>2</uint></struct></what>",
    ]
    capture.chunk(
        "vkQueuePresentKHR",
        {"queue": 5, "PresentInfo": {"pImageIndices": [0]}, "PresentedImage": 9},
    )
    found, broken = read(capture.text())
    assert broken is None
    assert [call.args for call in found] == [
        {"commandBuffer": 1, "pBeginInfo": {"flags": 4}},
        {"commandBuffer": 1, "vertexCount": 3},
        {"queue": 5, "pPresentInfo": {"pImageIndices": [0]}},
    ]


def test_memory_requirements_are_a_query() -> None:
    capture = RenderDoc()
    capture.chunk(
        "vkCreateImage",
        {
            "device": 1,
            "CreateInfo": {"format": 37},
            "Image": 2,
            "memoryRequirements": {"size": 4096},
        },
    )
    found, _ = read(capture.text())
    assert [(call.name, call.args) for call in found] == [
        ("vkCreateImage", {"device": 1, "pCreateInfo": {"format": 37}, "pImage": 2}),
        (
            "vkGetImageMemoryRequirements",
            {"device": 1, "image": 2, "pMemoryRequirements": {"size": 4096}},
        ),
    ]


LAYOUT = [
    {"binding": 7, "descriptorType": 2, "descriptorCount": 3},
    {"binding": 0, "descriptorType": 6, "descriptorCount": 1},
    {"binding": 2, "descriptorType": 1000138000, "descriptorCount": 64},
]
"""Bindings in no order: SAMPLED_IMAGE, UNIFORM_BUFFER, INLINE_UNIFORM_BLOCK of 64 bytes."""


def with_sets(slots: list[dict[str, Any]], layout: int = 1) -> RenderDoc:
    capture = RenderDoc()
    capture.chunk(
        "vkCreateDescriptorSetLayout", {"CreateInfo": {"pBindings": LAYOUT}, "SetLayout": 1}
    )
    capture.chunk(
        "vkAllocateDescriptorSets",
        {"AllocateInfo": {"descriptorPool": 9, "pSetLayouts": [layout]}, "DescriptorSet": 20},
    )
    capture.chunk("Internal::Initial Contents", {"type": 8, "id": 2, "Contents": b"abc"})
    capture.chunk(
        "Internal::Initial Contents",
        {"type": 19, "id": 20, "Bindings": slots, "NumBindings": len(slots)},
    )
    return capture


UNIFORM: dict[str, Any] = {"type": 6, "resource": 70, "offset": 0}
BLOCK: dict[str, Any] = {"type": 1000138000, "offset": 0}
NOTHING: dict[str, Any] = {"type": 2, "resource": 0}


def sampled(view: int) -> dict[str, Any]:
    return {"type": 2, "resource": view, "imageLayout": 5}


@pytest.mark.parametrize(
    ("slots", "writes"),
    [
        ([UNIFORM, BLOCK, sampled(71), sampled(72), NOTHING], [(0, [71, 72])]),
        ([UNIFORM, BLOCK, sampled(71), NOTHING, sampled(73)], [(0, [71]), (2, [73])]),
        ([UNIFORM, BLOCK, NOTHING, NOTHING, NOTHING], []),
        ([UNIFORM, BLOCK, sampled(71)], [(0, [71])]),
    ],
)
def test_what_sets_hold_when_the_frame_begins_is_an_update(
    slots: list[dict[str, Any]], writes: list[tuple[int, list[int]]]
) -> None:
    found, broken = read(
        with_sets(slots).text(), frozenset({"vkUpdateDescriptorSets", "vkAllocateDescriptorSets"})
    )
    assert broken is None
    assert found[0].name == "vkAllocateDescriptorSets"
    told = [
        (write["dstArrayElement"], [each["imageView"] for each in write["pImageInfo"]])
        for call in found[1:]
        for write in call.args["pDescriptorWrites"]
    ]
    assert told == writes
    assert all(
        write["dstBinding"] == 7 and write["dstSet"] == 20
        for call in found[1:]
        for write in call.args["pDescriptorWrites"]
    )


def test_a_set_of_an_unknown_layout_holds_what_is_not_told() -> None:
    found, _ = read(with_sets([sampled(71)], layout=5).text())
    assert (found[-1].name, found[-1].args) == (
        "vkUpdateDescriptorSetWithTemplate",
        {"descriptorSet": 20},
    )


def test_a_large_set_is_not_told_and_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(renderdoc, "MAX_ELEMENTS", 40)
    monkeypatch.setattr(renderdoc, "MAX_SIZE", 0)
    capture = with_sets([sampled(71)] * 50)
    capture.chunk("vkCmdDraw", {"vertexCount": 3})
    found, broken = read(capture.text())
    assert broken is None
    assert [(call.name, call.args) for call in found[-2:]] == [
        ("vkUpdateDescriptorSetWithTemplate", {"descriptorSet": 20}),
        ("vkCmdDraw", {"vertexCount": 3}),
    ]


@given(
    programs,
    st.floats(0, 1),
    st.sampled_from(
        [
            "",
            "<",
            ">",
            "/",
            '"',
            "x",
            " ",
            "&",
            "&amp;",
            "<!-- -->",
            "\n",
            "é",
            "<uint>",
            "</chunk>",
        ]
    ),
    st.integers(1, 300),
)
@examples(2)
def test_text_is_read_as_by_the_xml_parser(
    program: list[tuple[str, dict[str, Any]]], place: float, insertion: str, block: int
) -> None:
    text = written(program).text()
    at = int(place * len(text))
    text = text[:at] + insertion.encode() + text[at:]
    names = frozenset(re.findall(rb' name="(vk\w+)"', text)) | {b"vkUpdateDescriptorSets"}
    results = []
    for size in (1 << 20, 0):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(renderdoc, "MAX_SIZE", size)
            found: list[Call | Mark] = []
            broken = None
            try:
                found += renderdoc.calls(
                    Slow(text, block), frozenset(name.decode() for name in names), None
                )
            except CaptureError as error:
                broken = error.message, error.place
            results.append((found, broken))
    assert results[0] == results[1]


@given(block=st.integers(1, 400), limit=st.integers(1500, 5000))
@examples(1)
def test_wherever_a_large_set_is_cut_the_rest_is_told(block: int, limit: int) -> None:
    capture = with_sets([sampled(71)] * 20)
    capture.chunk("vkCmdDraw", {"vertexCount": 3})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(renderdoc, "MAX_CHUNK", limit)
        sets = frozenset(
            {"vkUpdateDescriptorSets", "vkUpdateDescriptorSetWithTemplate", "vkCmdDraw"}
        )
        found = [
            each
            for each in renderdoc.calls(Slow(capture.text(), block), sets, None)
            if isinstance(each, Call)
        ]
    assert [call.name for call in found[1:]] == ["vkCmdDraw"]
    assert found[0].name in ("vkUpdateDescriptorSets", "vkUpdateDescriptorSetWithTemplate")


def test_the_writes_of_a_template_are_decoded() -> None:
    capture = RenderDoc()
    capture.chunk(
        "vkUpdateDescriptorSetWithTemplate",
        {"device": 1, "descriptorSet": 20, "Decoded Writes": [{"dstSet": 0, "dstBinding": 2}]},
    )
    capture.chunk("vkUpdateDescriptorSetWithTemplate", {"device": 1, "descriptorSet": 20})
    writes = [{"dstSet": 0, "dstBinding": 3}]
    capture.chunk(
        "vkCmdPushDescriptorSetWithTemplateKHR",
        {"commandBuffer": 7, "set": 0, "Decoded Writes": writes},
    )
    found, _ = read(capture.text())
    assert [(call.name, call.args) for call in found] == [
        (
            "vkUpdateDescriptorSetWithTemplate",
            {
                "device": 1,
                "descriptorSet": 20,
                "pDescriptorWrites": [{"dstSet": 0, "dstBinding": 2}],
            },
        ),
        ("vkUpdateDescriptorSetWithTemplate", {"device": 1, "descriptorSet": 20}),
        (
            "vkCmdPushDescriptorSetWithTemplateKHR",
            {"commandBuffer": 7, "set": 0, "pDescriptorWrites": writes},
        ),
    ]


def code_of(text: bytes, path: Path) -> object:
    (module,) = read(text, frozenset({"vkCreateShaderModule"}), str(path))[0]
    return module.args["pCreateInfo"].get("pCode")


def test_code_is_in_the_zip_beside(tmp_path: Path) -> None:
    capture = written(PROGRAM)
    (tmp_path / "a.zip").write_bytes(capture.zip())
    assert code_of(capture.text(), tmp_path / "a.zip.xml") == CODE
    assert code_of(capture.text(), tmp_path / "a.xml") == CODE
    assert code_of(capture.text(), tmp_path / "b.zip.xml") is None
    assert code_of(capture.text(), tmp_path / "a.txt") is None
    (call,) = read(capture.text(), frozenset({"vkCreateShaderModule"}))[0]
    assert "pCode" not in call.args["pCreateInfo"]


def test_buffers_of_another_size_are_unknown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    capture = written(PROGRAM)
    (tmp_path / "a.zip").write_bytes(capture.zip())
    length = f'byteLength="{len(CODE)}"'.encode()
    for other in (len(CODE) - 1, len(CODE) + 1, 0, 10**30):
        changed = capture.text().replace(length, f'byteLength="{other}"'.encode())
        assert code_of(changed, tmp_path / "a.xml") is None
    assert code_of(capture.text().replace(length, b""), tmp_path / "a.xml") is None
    monkeypatch.setattr(renderdoc_blobs, "MAX_BLOB", len(CODE) - 1)
    assert code_of(capture.text(), tmp_path / "a.xml") is None


def test_all_buffers_together_are_limited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    capture = written([PROGRAM[14]] * 3)
    (tmp_path / "a.zip").write_bytes(capture.zip())
    monkeypatch.setattr(renderdoc_blobs, "MAX_ALL", 2 * len(CODE))
    found, _ = read(capture.text(), name=str(tmp_path / "a.xml"))
    assert [call.args["pCreateInfo"].get("pCode") for call in found] == [CODE, CODE, None]


def test_what_is_no_zip_is_no_matter(tmp_path: Path) -> None:
    capture = written(PROGRAM)
    good = capture.zip()
    for data in (b"", b"PK", good[:50], good[:-1], good[: len(good) // 2], bytes(len(good))):
        (tmp_path / "a.zip").write_bytes(data)
        assert code_of(capture.text(), tmp_path / "a.xml") is None
    (tmp_path / "a.zip").unlink()
    os.mkfifo(tmp_path / "a.zip")
    assert code_of(capture.text(), tmp_path / "a.xml") is None
    (tmp_path / "c.zip").mkdir()
    assert code_of(capture.text(), tmp_path / "c.xml") is None


@given(at=st.integers(0, 10**6), bit=st.integers(0, 7))
@examples(1.5)
def test_a_flipped_bit_in_the_zip_gives_the_code_or_nothing(
    at: int, bit: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    capture = written(PROGRAM)
    data = bytearray(capture.zip())
    data[at % len(data)] ^= 1 << bit
    path = tmp_path_factory.getbasetemp() / "flipped.zip"
    path.write_bytes(data)
    assert code_of(capture.text(), path.with_suffix(".xml")) in (CODE, None)


def test_a_member_that_inflates_to_more_than_it_says(tmp_path: Path) -> None:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("000000", bytes(50 << 20))
    data = out.getvalue().replace((50 << 20).to_bytes(4, "little"), len(CODE).to_bytes(4, "little"))
    (tmp_path / "a.zip").write_bytes(data)
    assert code_of(written(PROGRAM).text(), tmp_path / "a.xml") is None


def xml(chunks: str, driver: str = "<driver>Vulkan</driver>") -> bytes:
    return f"<rdc><header>{driver}</header><chunks>{chunks}</chunks></rdc>".encode()


GOOD = '<chunk name="vkCmdDraw"><uint name="vertexCount">3</uint></chunk>'


@pytest.mark.parametrize(
    ("marked", "message"),
    [
        ("⟦", "the XML is truncated"),
        ("⟦<html></html>", "the root element must be `rdc`, found `html`"),
        (
            "<rdc><header><driver>D3D11⟦</driver></header></rdc>",
            "expected a Vulkan capture, found the driver `D3D11`",
        ),
        (
            "<rdc><header><driver/>⟦</header></rdc>",
            "expected a Vulkan capture, found the driver ``",
        ),
        (
            '<!DOCTYPE rdc ⟦[<!ENTITY a "b">]><rdc>&a;</rdc>',
            "unexpected document type declaration; RenderDoc does not write one, and entities are "
            "not supported",
        ),
        (
            "<!DOCTYPE html⟦><html/>",
            "unexpected document type declaration; RenderDoc does not write one, and entities are "
            "not supported",
        ),
        ("<rdc>⟦&a;</rdc>", "invalid XML: undefined entity"),
        ("<rdc></rdc>⟦<rdc></rdc>", "invalid XML: junk after document element"),
        (xml("").decode()[:-6] + "⟦</rdc", "the XML is truncated"),
        (
            xml('<chunk name="vkCmdDraw"><uint name="a">x⟦</uint></chunk>').decode(),
            "`x` is not a valid `uint`",
        ),
        (
            xml(f'<chunk name="vkCmdDraw"><uint name="a">{"9" * 5000}⟦</uint></chunk>').decode(),
            f"`{'9' * 64}` is not a valid `uint`",
        ),
        (
            xml('<chunk name="vkCmdDraw"><float name="a">1.0.0⟦</float></chunk>').decode(),
            "`1.0.0` is not a valid `float`",
        ),
        (
            xml('<chunk name="vkCmdDraw"><bool name="a">1⟦</bool></chunk>').decode(),
            "`1` is not a valid `bool`",
        ),
        (
            xml('<chunk name="vkCmdDraw"><uint>⟦<uint>1</uint></uint></chunk>').decode(),
            "unexpected element `uint` inside a value",
        ),
    ],
)
def test_what_is_no_capture(marked: str, message: str) -> None:
    found, broken = read(marked.replace("⟦", "").encode())
    assert found == []
    assert broken is not None and broken.message == message
    assert broken.place == Place(1, marked.index("⟦") + 1, 0 if "<chunk " in marked else None)


def test_what_comes_before_a_mistake_is_told() -> None:
    text = xml(GOOD + GOOD + '<chunk name="vkCmdDraw"><int name="x"/></chunk>' + GOOD)
    found, broken = read(text)
    assert [call.args for call in found] == [{"vertexCount": 3}] * 2
    assert broken is not None and broken.place.call == 2


@pytest.mark.parametrize(
    "wanted", [Everything(), frozenset({"vkCreateImage"})], ids=["read", "passed over"]
)
def test_limits(wanted: frozenset[str], monkeypatch: pytest.MonkeyPatch) -> None:
    deep = '<chunk name="vkCmdDraw">' + "<struct>" * 200 + "</struct>" * 200 + "</chunk>"
    for text in (xml(deep), xml("", "<a>" * 200 + "</a>" * 200)):
        _, broken = read(text, wanted)
        assert broken is not None and broken.message == "elements are nested deeper than 100 levels"
    tag = f'<chunk name="vkCmdDraw" a="{"b" * (3 << 20)}"></chunk>'
    _, broken = read(xml(tag), wanted)
    assert broken is not None and broken.message == "a tag or comment exceeds 1 MiB"
    names = "".join(f"<a{number}/>" for number in range(30_000))
    _, broken = read(xml(f'<chunk name="vkCmdDraw">{names}</chunk>'), wanted)
    assert (
        broken is not None and broken.message == "more than 20000 names of elements and attributes"
    )


def test_limits_of_a_chunk(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(renderdoc, "MAX_CHUNK", 1 << 20)
    monkeypatch.setattr(renderdoc, "MAX_ELEMENTS", 1000)
    text = xml(
        GOOD + f'<chunk name="vkCmdDraw"><string name="a">{"b " * (1 << 20)}</string></chunk>'
    )
    found, broken = read(text)
    assert len(found) == 1
    assert broken is not None and (broken.message, broken.place) == (
        "vkCmdDraw exceeds 1 MiB",
        Place(1, 119, 1),
    )
    assert read(text, frozenset({"vkCreateImage"})) == ([], None)
    _, broken = read(
        xml(f'<chunk name="vkCmdDraw"><array name="a">{"<struct/>" * 2000}</array></chunk>')
    )
    assert broken is not None and broken.message == "vkCmdDraw exceeds 1,000 structures and arrays"


def test_claims() -> None:
    assert renderdoc.claims(written([]).text())
    assert renderdoc.claims(b"\xef\xbb\xbf<rdc><header>")
    assert renderdoc.claims(b'\n<?xml version="1.0" encoding="utf-8"?>\n<rdc>')
    assert not renderdoc.claims(b"")
    assert not renderdoc.claims(b'<?xml version="1.0"?><html></html>')
    assert not renderdoc.claims(b'{"a": "<rdc>"}')


def test_a_byte_order_mark_is_no_matter() -> None:
    text = written(PROGRAM).text()
    assert [call.args for call in read(b"\xef\xbb\xbf" + text)[0]] == [
        call.args for call in read(text)[0]
    ]


def test_another_encodings_declaration_is_no_matter() -> None:
    text = xml(GOOD)
    assert read(b'<?xml version="1.0" encoding="unicode_escape"?>' + text)[1] is None


def test_truncated_at_every_byte() -> None:
    text = written(PROGRAM).text()
    whole, _ = read(text)
    ends = [at + len(b"</chunk>") for at in range(len(text)) if text.startswith(b"</chunk>", at)]
    for at in range(0, len(text.rstrip()), 7):
        found, broken = read(text[:at])
        assert broken is not None and broken.message == "the XML is truncated"
        chunks = sum(end <= at for end in ends)
        assert found == [call for call in whole if (call.at.call or 0) < chunks]


@given(
    flips=st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 7)), min_size=1, max_size=4),
    block=st.integers(1, 300),
)
@examples(3)
def test_flipped_bits_break_nothing_else(flips: list[tuple[int, int]], block: int) -> None:
    text = bytearray(written(PROGRAM).text())
    first = min(at % len(text) for at, _ in flips)
    before = [call for call in read(bytes(text))[0] if bytes(text).find(b"</chunk>", 0, first) >= 0]
    for at, bit in flips:
        text[at % len(text)] ^= 1 << bit
    found, _ = read(bytes(text))
    whole = text[:first].count(b"</chunk>")
    assert found[: sum((call.at.call or 0) < whole for call in found)] == [
        call for call in before if (call.at.call or 0) < whole
    ]


NAMES = [
    *(
        "InitParams",
        "physProps",
        "memProps",
        "memoryTypes",
        "memoryTypeCount",
        "PhysicalDevice",
        "Swapchain",
        "SwapchainImage",
    ),
    *(
        "SwapchainImageIndex",
        "Image",
        "memoryRequirements",
        "SetLayout",
        "CreateInfo",
        "pBindings",
        "binding",
        "descriptorCount",
    ),
    *(
        "DescriptorSet",
        "AllocateInfo",
        "pSetLayouts",
        "id",
        "Bindings",
        "type",
        "resource",
        "Decoded Writes",
        "descriptorSet",
        "Object",
    ),
    *("pNext", "sType", "pNextType", "pSampleMask", "pCode", "pData", "CommandBuffer", "count"),
]
CHUNKS = sorted(
    {
        *NEEDED_FOR,
        *RENAMED_BY_CALL,
        "vkCreateInstance",
        "vkCreateShaderModule",
        "vkSetDebugUtilsObjectNameEXT",
        "vkCmdDraw",
        "Internal::X",
    }
)
LEAVES = [
    *("uint", "int", "enum", "ResourceId", "buffer", "float", "bool", "string", "null", "what")
]


def element(tag: str, name: str | None, content: str) -> str:
    return f"<{tag}{'' if name is None else f' name={chr(34)}{name}{chr(34)}'}>{content}</{tag}>"


leaves = st.builds(
    element,
    st.sampled_from(LEAVES),
    st.none() | st.sampled_from(NAMES),
    st.sampled_from(["0", "1", "2", "3", "1000138000"]),
)
elements = st.recursive(
    leaves,
    lambda inner: st.builds(
        element,
        st.sampled_from(["struct", "array"]),
        st.none() | st.sampled_from(NAMES),
        st.lists(inner, max_size=4).map("".join),
    ),
    max_leaves=8,
)


@given(
    st.lists(
        st.builds(
            element,
            st.just("chunk"),
            st.sampled_from(CHUNKS),
            st.lists(elements, max_size=5).map("".join),
        ),
        max_size=8,
    )
)
@examples(1.5)
def test_chunks_of_any_shape(chunks: list[str]) -> None:
    found, broken = read(xml("".join(chunks)))
    assert broken is None or (
        broken.message.endswith(" is not a valid `bool`") and broken.place.call is not None
    )
    numbers_of = [call.at.call or 0 for call in found]
    assert numbers_of == sorted(numbers_of)
    assert all(isinstance(call.args, dict) for call in found)


@given(block=st.integers(1, 5000))
@examples(0.3)
def test_blocks_of_any_size_give_the_same(block: int) -> None:
    text = written(PROGRAM).text()
    assert [
        each
        for each in renderdoc.calls(Slow(text, block), Everything(), None)
        if isinstance(each, Call)
    ] == read(text)[0]


@pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no samples at {FOLDER}")
class TestSample:
    """A capture by RenderDoc 1.24 of a program on lavapipe."""

    @staticmethod
    def calls() -> list[Call]:
        found, broken = read((FOLDER / "renderdoc_1.24_msaa.xml").read_bytes())
        assert broken is None
        return found

    def test_what_it_holds(self) -> None:
        found = self.calls()
        images = [call.args["pCreateInfo"] for call in found if call.name == "vkCreateImage"]
        assert [(each["samples"], each["usage"], each["format"]) for each in images] == [
            (4, 17, 37),
            (4, 96, 126),
            (1, 19, 37),
            (1, 32, 126),
        ]
        (second,) = [call for call in found if call.name == "vkCreateRenderPass2"]
        (subpass,) = second.args["pCreateInfo"]["pSubpasses"]
        assert (
            subpass["pNext"]["sType"]
            == "VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE"
        )
        assert subpass["pNext"]["pDepthStencilResolveAttachment"]["attachment"] == 3
        pipelines = [
            call.args["pCreateInfos"][0]
            for call in found
            if call.name == "vkCreateGraphicsPipelines"
        ]
        assert [
            (
                each["pMultisampleState"]["sampleShadingEnable"],
                each["pMultisampleState"]["pSampleMask"],
            )
            for each in pipelines
        ] == [
            (1, [15]),
            (0, [15]),
            (0, [15]),
        ]
        assert pipelines[2]["pNext"]["pColorAttachmentFormats"] == [37]
        (memory,) = [call for call in found if call.name == "vkGetPhysicalDeviceMemoryProperties"]
        assert memory.args["pMemoryProperties"]["memoryTypes"] == [
            {"propertyFlags": 15, "heapIndex": 0}
        ]
        frame = [call.name for call in found if (call.at.call or 0) > 40]
        assert frame[:4] == [
            "vkBeginCommandBuffer",
            "vkCmdBeginRenderPass",
            "vkCmdBindPipeline",
            "vkCmdDraw",
        ]
        assert frame[-5:] == [
            "vkCmdResolveImage",
            "vkEndCommandBuffer",
            "vkQueueSubmit",
            "vkWaitForFences",
            "vkDeviceWaitIdle",
        ]

    def test_truncated(self) -> None:
        text = (FOLDER / "renderdoc_1.24_msaa.xml").read_bytes()
        whole = self.calls()
        for at in range(0, len(text) - 10, 4999):
            found, broken = read(text[:at])
            assert broken is not None
            assert found == whole[: len(found)]
