"""Fossilize databases: what entries create as calls, whatever their order; checks of every length
and sum.
"""

from __future__ import annotations

import io
import json
import os
import zlib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place
from msaa_lint.input.readers import fossilize, fossilize_code, fossilize_objects
from tests.input.readers.dialects_binary import MAGIC, entries, entry, made, numbers, packed
from tests.input.readers.dialects_binary import fossilize as written
from tests.input.readers.programs import programs
from tests.paths import SAMPLES
from tests.strength import examples

FOLDER = SAMPLES / "captures"

EVERYTHING = frozenset(
    f"vkCreate{kind}"
    for kind in (
        "Instance",
        "Device",
        "ShaderModule",
        "RenderPass",
        "RenderPass2",
        "GraphicsPipelines",
        "Image",
    )
)
CODE = b"".join(
    word.to_bytes(4, "little")
    for word in (0x07230203, 0, 127, 128, 16383, 16384, 2**21, 2**28 - 1, 2**28, 2**32 - 1)
)

ATTACHMENT = {
    "format": "VK_FORMAT_D32_SFLOAT_S8_UINT",
    "samples": "VK_SAMPLE_COUNT_4_BIT",
    "storeOp": "VK_ATTACHMENT_STORE_OP_STORE",
}
LAYOUTS = {
    "sType": "VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT",
    "stencilInitialLayout": 0,
    "stencilFinalLayout": 7,
    "pNext": None,
}
SINGLE = {
    "sType": "VK_STRUCTURE_TYPE_MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT",
    "multisampledRenderToSingleSampledEnable": 1,
    "rasterizationSamples": 4,
    "pNext": None,
}
RESOLVE = {
    "sType": "VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE",
    "depthResolveMode": "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT",
    "pDepthStencilResolveAttachment": {"attachment": 1, "layout": 3, "aspectMask": 2},
    "pNext": SINGLE,
}
BARRIER = {
    "sType": "VK_STRUCTURE_TYPE_MEMORY_BARRIER_2",
    "srcStageMask": 1 << 40,
    "dstAccessMask": 3,
    "pNext": None,
}
FORMATS = {
    "sType": "VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO",
    "pColorAttachmentFormats": [37],
    "viewMask": 0,
    "pNext": None,
}
CONSTANTS = {
    "pMapEntries": [{"constantID": 0, "offset": 0, "size": 4}],
    "dataSize": 4,
    "pData": b"\x04\x00\x00\x00",
}

INSTANCE = (
    "vkCreateInstance",
    {
        "pCreateInfo": {
            "pNext": None,
            "pApplicationInfo": {"pApplicationName": "a", "apiVersion": 4206592},
        }
    },
)
PASS = (
    "vkCreateRenderPass",
    {
        "pCreateInfo": {
            "flags": 0,
            "pAttachments": [ATTACHMENT, {**ATTACHMENT, "samples": 1}],
            "pSubpasses": [
                {
                    "pColorAttachments": [{"attachment": 0, "layout": 2}],
                    "pResolveAttachments": [{"attachment": 1, "layout": 2}],
                    "pDepthStencilAttachment": {"attachment": 0, "layout": 3},
                    "pInputAttachments": [{"attachment": 4294967295, "layout": 0}],
                    "pPreserveAttachments": [1],
                }
            ],
            "pDependencies": [{"srcSubpass": 4294967295, "dstSubpass": 0}],
        },
        "pRenderPass": 0xF00000000000000A,
    },
)
PASS_2 = (
    "vkCreateRenderPass2",
    {
        "pCreateInfo": {
            "pAttachments": [{**ATTACHMENT, "pNext": LAYOUTS}],
            "pSubpasses": [{"viewMask": 0, "pNext": RESOLVE}],
            "pDependencies": [{"srcSubpass": 0, "pNext": BARRIER}],
        },
        "pRenderPass": 11,
    },
)
MODULE = (
    "vkCreateShaderModule",
    {
        "pCreateInfo": {
            "sType": "VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO",
            "flags": 0,
            "codeSize": len(CODE),
            "pCode": CODE,
        },
        "pShaderModule": 0xFFFFFFFFFFFFFFFF,
    },
)
PIPELINE: tuple[str, dict[str, Any]] = (
    "vkCreateGraphicsPipelines",
    {
        "createInfoCount": 1,
        "pCreateInfos": [
            {
                "pNext": FORMATS,
                "pStages": [
                    {
                        "stage": 16,
                        "module": 0xFFFFFFFFFFFFFFFF,
                        "pName": "main",
                        "pSpecializationInfo": CONSTANTS,
                    }
                ],
                "pVertexInputState": {
                    "pVertexBindingDescriptions": [{"binding": 0, "stride": 12}],
                    "pVertexAttributeDescriptions": [],
                },
                "pMultisampleState": {
                    "rasterizationSamples": "VK_SAMPLE_COUNT_4_BIT",
                    "minSampleShading": 0.5,
                    "pSampleMask": [15],
                },
                "pColorBlendState": {"pAttachments": [{"blendEnable": 0, "colorWriteMask": 15}]},
                "pDynamicState": {"pDynamicStates": [0, 1]},
                "layout": 0xD00000000000000D,
                "renderPass": 0xF00000000000000A,
                "basePipelineHandle": 0,
                "subpass": 0,
            }
        ],
        "pPipelines": [77],
    },
)
PROGRAM: list[tuple[str, dict[str, Any]]] = [INSTANCE, PASS, PASS_2, MODULE, PIPELINE]


def read(
    data: bytes, wanted: frozenset[str] = EVERYTHING
) -> tuple[list[Call], list[Mark], CaptureError | None]:
    """The calls, the marks, and how reading ended."""
    found: list[Call] = []
    marks: list[Mark] = []
    try:
        for each in fossilize.calls(io.BytesIO(data), wanted, None):
            if isinstance(each, Mark):
                marks.append(each)
            else:
                found.append(each)
    except CaptureError as error:
        return found, marks, error
    return found, marks, None


def told(calls: list[Call]) -> list[tuple[str, dict[str, Any]]]:
    return [(call.name, call.args) for call in calls]


def expected(*program: tuple[str, dict[str, Any]]) -> list[tuple[str, dict[str, Any]]]:
    """The objects as calls; the shader only with the pipeline that has it as its fragment stage."""
    return [
        (name, numbers(args)) for name, args in program if name != MODULE[0] or PIPELINE in program
    ]


@pytest.mark.parametrize("deflated", [True, False])
def test_objects_are_calls(deflated: bool) -> None:
    found, marks, broken = read(written(PROGRAM, deflated))
    assert (marks, broken) == ([], None)
    assert told(found) == expected(*PROGRAM)
    assert [call.at for call in found] == [Place(call=number) for number in range(5)]


@given(programs)
@examples(1)
def test_any_program(program: list[tuple[str, dict[str, Any]]]) -> None:
    found, marks, broken = read(written(program))
    assert (marks, broken) == ([], None)
    of_passes = [(name, args) for name, args in program if name == "vkCreateRenderPass"]
    of_pipelines = [
        (name, {"pCreateInfos": [info], "pPipelines": [handle]})
        for name, args in program
        if name == "vkCreateGraphicsPipelines"
        for info, handle in zip(args["pCreateInfos"], args["pPipelines"], strict=False)
    ]
    assert [(name, stated(args)) for name, args in told(found)] == [
        (name, stated(numbers(args))) for name, args in of_passes + of_pipelines
    ]


def stated(value: Any) -> Any:
    """A structure without null pointers, and without what Fossilize has no place for, or always
    has.
    """
    if isinstance(value, dict):
        left_out = (
            (
                "device",
                "pipelineCache",
                "createInfoCount",
                "colorAttachmentCount",
                "basePipelineHandle",
                "layout",
            )
            if "attachment" not in value
            else ()
        )
        return {
            key: stated(item)
            for key, item in value.items()
            if item is not None and key not in left_out
        }
    return [stated(item) for item in value] if isinstance(value, list) else value


def test_what_is_referred_to_comes_first() -> None:
    found, _, _ = read(written(reversed(PROGRAM)))
    # Of one kind they come as they stand.
    assert told(found) == expected(INSTANCE, PASS_2, PASS, MODULE, PIPELINE)
    assert [call.at.call for call in found] == [4, 2, 3, 1, 0]
    found, _, _ = read(written([PIPELINE, PASS, PIPELINE, INSTANCE, PASS_2]))
    assert told(found) == expected(INSTANCE, PASS, PASS_2, PIPELINE, PIPELINE)


def test_only_what_is_wanted_is_told() -> None:
    for name in (
        "vkCreateRenderPass",
        "vkCreateRenderPass2",
        "vkCreateShaderModule",
        "vkCreateInstance",
        "vkCreateGraphicsPipelines",
    ):
        found, _, broken = read(written(PROGRAM), frozenset({name}))
        assert broken is None
        assert [call.name for call in found] == [name]
    # What nobody asks for is not even looked at.
    assert read(MAGIC + entry(4, 1, b"no JSON"), frozenset({"vkCreateInstance"})) == ([], [], None)


def test_no_device_is_told() -> None:
    assert "vkCreateDevice" not in {call.name for call in read(written(PROGRAM))[0]}


def test_other_entries_are_passed_over() -> None:
    data = (
        MAGIC
        + entry(8, 5, b"{}")
        + entry(3, 1, b"no JSON at all")
        + entry(99, 1, b"")
        + written([PASS])[16:]
    )
    found, marks, broken = read(data)
    assert (told(found), marks, broken) == (expected(PASS), [], None)
    assert found[0].at == Place(call=3)


def test_chains_keep_what_is_asked_for_in_its_order() -> None:
    chain = [
        {"sType": 5, "a": 1},
        {"sType": 1000199001, "depthResolveMode": 1},
        "x",
        {"sType": True},
        {"sType": 1000376002},
        {"a": 2},
    ]
    payload = json.dumps({"renderPasses2": {"0b": {"subpasses": [{"pNext": chain}]}}}).encode()
    (call,), _, _ = read(MAGIC + entry(5, 11, payload))
    assert call.args["pCreateInfo"]["pSubpasses"] == [
        {
            "pNext": {
                "sType": "VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE",
                "depthResolveMode": 1,
                "pNext": {
                    "sType": "VK_STRUCTURE_TYPE_MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT",
                    "pNext": None,
                },
            }
        }
    ]


def test_numbers_that_json_has_not_and_names_that_are_no_utf_8() -> None:
    text = b'{"graphicsPipelines":{"0c":{"depthStencilState":{"minDepthBounds":NaN,"maxDepthBounds":-Infinity}}}}'
    (call,), _, broken = read(MAGIC + entry(6, 12, text))
    assert broken is None
    assert call.args["pCreateInfos"][0]["pDepthStencilState"]["maxDepthBounds"] == float("-inf")
    (call,), _, broken = read(
        MAGIC + entry(0, 1, b'{"applicationInfo":{"applicationName":"\xff","apiVersion":1}}')
    )
    assert broken is None
    assert call.args["pCreateInfo"]["pApplicationInfo"] == {
        "pApplicationName": "\ufffd",
        "apiVersion": 1,
    }


@given(
    words=st.lists(
        st.integers(0, 2**32 - 1) | st.sampled_from([0, 127, 128, 2**28, 2**32 - 1]), max_size=300
    )
)
@examples(1)
def test_code_unpacks_to_what_was_packed(words: list[int]) -> None:
    code = b"".join(word.to_bytes(4, "little") for word in words)
    assert fossilize_code.unpack_code(packed(code), len(code)) == code
    assert fossilize_code.unpack_code(packed(code), len(code) + 4) is None
    if words:
        assert fossilize_code.unpack_code(packed(code)[:-1], len(code)) is None
        assert fossilize_code.unpack_code(packed(code), len(code) - 4) is None


def test_code_is_unpacked_across_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    for block in range(1, 8):
        monkeypatch.setattr(fossilize_code, "BLOCK", block)
        assert fossilize_code.unpack_code(packed(CODE), len(CODE)) == CODE


@pytest.mark.parametrize(
    "bad", [b"\xff\xff\xff\xff\x10", b"\x80\x80\x80\x80\x80\x00", b"\x80" * 100, b"\x80"]
)
def test_code_that_does_not_unpack(bad: bytes) -> None:
    for size in (0, 4, 8):
        assert fossilize_code.unpack_code(bad, size) is None
    assert fossilize_code.unpack_code(b"\x01\x02", 7) is None


def module(payload: bytes = b"\x00" + packed(CODE), **changes: object) -> bytes:
    stated = {"varintOffset": 0, "varintSize": len(packed(CODE)), "codeSize": len(CODE), **changes}
    pipeline = {
        "graphicsPipelines": {"0c": {"stages": [{"stage": 16, "module": "0000000000000001"}]}}
    }
    return (
        MAGIC
        + entry(4, 1, json.dumps({"shaderModules": {"01": stated}}).encode() + payload)
        + entry(6, 12, json.dumps(pipeline).encode())
    )


SHADERS = frozenset({"vkCreateShaderModule"})


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (
            module(varintSize=len(packed(CODE)) + 1),
            "entry 0 at byte 16: its shader code lies outside the entry",
        ),
        (module(varintOffset=1), "entry 0 at byte 16: its shader code lies outside the entry"),
        (module(varintOffset=-1), "entry 0 at byte 16: its shader code lies outside the entry"),
        (module(varintSize=-1), "entry 0 at byte 16: its shader code lies outside the entry"),
        (module(codeSize=4), "entry 0 at byte 16: its shader code differs from its stated size"),
        (
            module(codeSize=len(CODE) + 1),
            "entry 0 at byte 16: its shader code differs from its stated size",
        ),
        (module(b""), "entry 0 at byte 16: its shader code lies outside the entry"),
    ],
)
def test_shaders_that_make_no_sense(data: bytes, message: str) -> None:
    found, _, broken = read(data, SHADERS)
    assert found == []
    assert broken is not None and broken.message == message


def test_shaders_whose_code_is_unknown() -> None:
    for data in (module(codeSize=(16 << 20) + 4), module(codeSize=None), module(varintOffset="0")):
        (call,), _, broken = read(data, SHADERS)
        assert broken is None
        assert "pCode" not in call.args["pCreateInfo"]


def test_shaders_of_other_stages_are_not_told() -> None:
    other = [
        {
            **PIPELINE[1]["pCreateInfos"][0],
            "pStages": [{"stage": 1, "module": 0xFFFFFFFFFFFFFFFF, "pName": "main"}],
        }
    ]
    vertex: tuple[str, dict[str, Any]] = (PIPELINE[0], {**PIPELINE[1], "pCreateInfos": other})
    found, _, broken = read(written([MODULE, vertex]))
    assert broken is None
    assert told(found) == expected(vertex)
    # Unread, it may be anything.
    assert read(MAGIC + entry(4, 5, b"no JSON") + written([PASS])[16:])[2] is None


def test_code_is_limited_in_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fossilize, "MAX_CODE", len(CODE))
    found, _, broken = read(written([MODULE, MODULE, MODULE, PIPELINE]))
    assert broken is None
    assert [call.name for call in found] == ["vkCreateShaderModule"] * 2 + [
        "vkCreateGraphicsPipelines"
    ]


def header(
    stored: int, flags: int, checksum: int, length: int, name: bytes = b"0" * 39 + b"1"
) -> bytes:
    return name + b"".join(each.to_bytes(4, "little") for each in (stored, flags, checksum, length))


JSON = b'{"applicationInfo":{}}'
DEFLATED = zlib.compress(JSON)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (header(len(JSON), 1, 1, len(JSON)) + JSON, "its checksum does not match"),
        (header(len(JSON), 0, 0, len(JSON)) + JSON, "its compression type 0 is unknown"),
        (header(len(JSON), 3, 0, len(JSON)) + JSON, "its compression type 3 is unknown"),
        (header(len(JSON), 1, 0, len(JSON) - 1) + JSON, "its size differs from its stated size"),
        (header(len(JSON), 2, 0, len(JSON)) + JSON, "its compressed data is invalid"),
        (
            header(len(DEFLATED), 2, 0, len(JSON) + 1) + DEFLATED,
            "its size differs from its stated size",
        ),
        (
            header(len(DEFLATED), 2, 0, len(JSON) - 1) + DEFLATED,
            "its size differs from its stated size",
        ),
        (
            header(len(DEFLATED), 2, 0, len(JSON) - 9) + DEFLATED,
            "its decompressed size differs from its stated size",
        ),
        (
            header(len(DEFLATED) - 1, 2, 0, len(JSON)) + DEFLATED[:-1],
            "its decompressed size differs from its stated size",
        ),
        (
            header(len(DEFLATED) + 1, 2, 0, len(JSON)) + DEFLATED + b"x",
            "its decompressed size differs from its stated size",
        ),
        (header(3, 1, 0, 3) + b"{,}", "its JSON is invalid"),
        (header(2, 1, 0, 2) + b"[]", "its JSON must be an object"),
        (header(4000, 1, 0, 4000) + b"[" * 2000 + b"]" * 2000, "its JSON is invalid"),
        (
            entry(0, 1, b'{"a":' + b"[" * 200 + b"]" * 200 + b"}"),
            "its JSON is nested deeper than 100 levels",
        ),
        (entry(0, 1, b'"' + b"a" * (5 << 20) + b'"'), "its JSON exceeds 4 MiB"),
    ],
)
def test_a_bad_entry_spares_the_others(bad: bytes, message: str) -> None:
    before, after = written([PASS]), written([PASS_2])[16:]
    found, marks, broken = read(before + bad + after)
    assert told(found) == expected(PASS, PASS_2)
    assert marks == []
    assert broken is not None
    assert broken.message == f"entry 1 at byte {len(before)}: {message}"
    assert broken.place == Place(call=1)


def test_the_first_bad_entry_is_told() -> None:
    # In the order in which they are read the second comes first.
    data = MAGIC + entry(6, 1, b"x") + entry(5, 1, b"x") + b"!" * 60
    _, _, broken = read(data)
    assert broken is not None and broken.place == Place(call=0)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "not a Fossilize database: the file signature is missing"),
        (b"PK\x03\x04" + bytes(100), "not a Fossilize database: the file signature is missing"),
        (MAGIC[:15], "the Fossilize database ends within its first 16 bytes"),
        (
            MAGIC[:15] + b"\x04",
            "Fossilize database version 4 is not supported; convert it to version 5 or 6",
        ),
        (
            MAGIC[:15] + b"\x07",
            "Fossilize database version 7 is not supported; convert it to version 5 or 6",
        ),
    ],
)
def test_what_is_no_database(data: bytes, message: str) -> None:
    found, marks, broken = read(data)
    assert (found, marks) == ([], [])
    assert broken is not None and (broken.message, broken.place) == (message, Place())


def test_version_5() -> None:
    assert told(read(MAGIC[:15] + b"\x05" + written([PASS])[16:])[0]) == expected(PASS)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (b"x" * 56, "its name must be hexadecimal digits"),
        (b"x", "its name must be hexadecimal digits"),
        (header(0, 1, 0, 0, b"0" * 39 + b"_"), "its name must be hexadecimal digits"),
        (header(0, 1, 0, 0, b"+" + b"0" * 39), "its name must be hexadecimal digits"),
        (header((64 << 20) + 1, 1, 0, 1), "its stated size exceeds 64 MiB"),
        (header(1, 2, 0, (64 << 20) + 1), "its stated size exceeds 64 MiB"),
    ],
)
def test_nonsense_in_the_middle(bad: bytes, message: str) -> None:
    before = written([PASS])
    found, marks, broken = read(before + bad + written([PASS_2])[16:])
    assert told(found) == expected(PASS)
    assert marks == []
    assert broken is not None
    assert (broken.message, broken.place) == (
        f"entry 1 at byte {len(before)}: {message}",
        Place(call=1),
    )


def test_truncated_at_every_byte() -> None:
    data = written(PROGRAM)
    ends = [16]
    for each in PROGRAM:
        ends.append(ends[-1] + len(written([each])) - 16)
    for at in range(16, len(data)):
        found, marks, broken = read(data[:at])
        whole = sum(end <= at for end in ends[1:])
        assert told(found) == expected(*PROGRAM[:whole])
        assert broken is None
        assert marks == ([] if at in ends else [Mark("truncated", Place(call=whole))])


@given(
    victim=st.integers(0, len(PROGRAM) - 1),
    at=st.integers(0, 10**6),
    bit=st.integers(0, 7),
    deflated=st.booleans(),
)
@examples(2)
def test_a_flipped_bit_of_an_entry_is_noticed(
    victim: int, at: int, bit: int, deflated: bool
) -> None:
    parts = [written([each], deflated)[16:] for each in PROGRAM]
    stored = bytearray(parts[victim])
    stored[56 + at % (len(stored) - 56)] ^= 1 << bit
    parts[victim] = bytes(stored)
    found, marks, broken = read(MAGIC + b"".join(parts))
    assert told(found) == expected(*PROGRAM[:victim], *PROGRAM[victim + 1 :])
    assert marks == []
    assert broken is not None and broken.place == Place(call=victim)
    assert (
        broken.message
        == f"entry {victim} at byte {16 + sum(map(len, parts[:victim]))}: its checksum does not "
        "match"
    )


@given(
    flips=st.lists(st.tuples(st.integers(0, 10**6), st.integers(0, 7)), min_size=1, max_size=9),
    checked=st.booleans(),
)
@examples(3)
def test_flipped_bits_end_in_calls_and_one_mistake_at_most(
    flips: list[tuple[int, int]], checked: bool
) -> None:
    data = bytearray(
        MAGIC
        + b"".join(entry(*each, False, checked) for call in made(PROGRAM) for each in entries(call))
    )
    for at, bit in flips:
        data[at % len(data)] ^= 1 << bit
    found, marks, broken = read(bytes(data))
    assert len(marks) <= 1
    numbers_of = [call.at.call or 0 for call in found]
    assert len(set(numbers_of)) == len(numbers_of)
    ends = [mark.at.call for mark in marks] + [
        broken.place.call for broken in [broken] if broken is not None
    ]
    assert not any(end in numbers_of for end in ends)
    if checked:
        # Of what is told a flip may have changed no more than the kind, in the name, or have made
        # the checksum none.
        assert sum(each in expected(*PROGRAM) for each in told(found)) >= len(found) - len(flips)


KEYS = [
    *(
        "renderPasses",
        "renderPasses2",
        "graphicsPipelines",
        "shaderModules",
        "applicationInfo",
        "0a",
        "pNext",
        "sType",
        "stages",
    ),
    *(
        "subpasses",
        "attachments",
        "multisampleState",
        "specializationInfo",
        "data",
        "varintSize",
        "codeSize",
        "varintOffset",
    ),
]


@given(
    kind=st.sampled_from([0, 4, 5, 6]),
    document=st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
        lambda inner: (
            st.lists(inner, max_size=3)
            | st.dictionaries(
                st.sampled_from(KEYS),
                inner,
                max_size=4,
            )
        ),
        max_leaves=25,
    ),
)
@examples(1.5)
def test_json_of_any_shape(kind: int, document: Any) -> None:
    found, marks, broken = read(MAGIC + entry(kind, 1, json.dumps(document).encode() + b"\x00abc"))
    assert marks == []
    assert broken is None or broken.place == Place(call=0)
    assert all(call.name in EVERYTHING for call in found)


def test_a_small_file_does_not_inflate_to_a_large_one() -> None:
    bomb = entry(5, 1, b"{}" + b" " * (60 << 20))
    found, _, broken = read(MAGIC + bomb * 3)
    assert found == []
    assert broken is not None and broken.message == "entry 0 at byte 16: its JSON exceeds 4 MiB"
    data = (
        MAGIC
        + entry(5, 1, b"{}" + b" " * (4 << 20) + b"\x00" + bytes(55 << 20))
        + bomb
        + written([PASS])[16:]
    )
    found, _, broken = read(data)
    assert broken is not None and broken.place == Place(call=0)


def test_inflating_is_limited_in_all(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fossilize, "MAX_PAYLOAD", 10_000)
    monkeypatch.setattr(fossilize, "MAX_RATIO", 0)
    data = MAGIC + entry(0, 1, b"{}" + b" " * 4000) * 4
    found, _, broken = read(data)
    assert len(found) == 2
    assert broken is not None and broken.message.endswith(
        "the file decompresses to more than 0 times its size"
    )


def test_entries_are_limited_in_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fossilize, "MAX_ENTRIES", 3)
    found, _, broken = read(written([PASS] * 5))
    assert len(found) == 3
    assert broken is not None and (broken.message, broken.place) == (
        "more than 3 entries",
        Place(call=3),
    )


def test_what_comes_from_a_pipe() -> None:
    reading, writing = os.pipe()
    os.write(writing, written(reversed(PROGRAM)))
    os.close(writing)
    with open(reading, "rb") as stream:
        assert told(
            [each for each in fossilize.calls(stream, EVERYTHING, None) if isinstance(each, Call)]
        ) == expected(INSTANCE, PASS_2, PASS, MODULE, PIPELINE)


def test_a_stream_is_read_from_where_it_stands() -> None:
    stream = io.BytesIO(b"before" + written([PASS]))
    stream.seek(6)
    (call,) = fossilize.calls(stream, EVERYTHING, None)
    assert isinstance(call, Call) and call.name == "vkCreateRenderPass"


def test_claims() -> None:
    assert fossilize.claims(written([]))
    assert not fossilize.claims(b"")
    assert not fossilize.claims(b"\x81FOSSIL")


def test_huge_modules_are_not_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fossilize_objects, "MAX_CODE", 36)
    (call,), _, broken = read(module(), SHADERS)
    assert broken is None and "pCode" not in call.args["pCreateInfo"]


@pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no samples at {FOLDER}")
class TestSample:
    """A database that Fossilize's own layer made of a program on lavapipe."""

    @staticmethod
    def data() -> bytes:
        return (FOLDER / "fossilize_v6_msaa.foz").read_bytes()

    def test_what_it_holds(self) -> None:
        found, marks, broken = read(self.data())
        assert (marks, broken) == ([], None)
        assert [call.name.removeprefix("vkCreate") for call in found] == [
            "Instance", "RenderPass", "RenderPass2", "ShaderModule", *["GraphicsPipelines"] * 3,
        ]  # fmt: skip
        first, second = (call.args["pCreateInfo"] for call in found[1:3])
        assert [
            (each["samples"], each["storeOp"], each["format"]) for each in first["pAttachments"]
        ] == [
            (4, 0, 37),
            (4, 1, 126),
            (1, 0, 37),
        ]
        assert second["pSubpasses"][0]["pNext"]["pDepthStencilResolveAttachment"] == {
            "attachment": 3,
            "layout": 3,
            "aspectMask": 2,
        }
        module = found[3].args["pCreateInfo"]
        assert (
            module["pCode"][:4] == b"\x03\x02\x23\x07"
            and len(module["pCode"]) == module["codeSize"] == 732
        )
        pipelines = [call.args["pCreateInfos"][0] for call in found[4:]]
        passes = [call.args["pRenderPass"] for call in found[1:3]]
        assert [each["renderPass"] for each in pipelines] == [*passes, 0]
        assert [each["pMultisampleState"]["sampleShadingEnable"] for each in pipelines] == [1, 0, 0]
        assert (
            {each["pStages"][1]["module"] for each in pipelines}
            == {found[3].args["pShaderModule"]}
            == {0x441DBB6694B83657}
        )
        assert pipelines[2]["pNext"]["pColorAttachmentFormats"] == [37]

    def test_truncated_at_every_byte(self) -> None:
        data = self.data()
        whole = read(data)[0]
        for at in range(17, len(data), 37):
            found, marks, broken = read(data[:at])
            assert broken is None
            last = marks[0].at.call if marks else 10**6
            assert found == [call for call in whole if call in found]
            assert all((call.at.call or 0) < (last or 0) for call in found)

    def test_flipped_bits_are_noticed(self) -> None:
        data = bytearray(self.data())
        whole = read(bytes(data))[0]
        # The shader's entry, within what is stored.
        at = bytes(data).index(b"0004441dbb6694b83657") + 20 + 16 + 40
        data[at] ^= 1
        found, _, broken = read(bytes(data))
        assert broken is not None and broken.message.endswith("its checksum does not match")
        assert len(found) == len(whole) - 1
