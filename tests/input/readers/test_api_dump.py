"""api_dump's JSON: nodes to plain arguments, places, settings that leave too much out, and files
that end where a program was killed.
"""

from __future__ import annotations

import io
import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.captures import json_stream
from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place
from msaa_lint.input.opening import hint
from msaa_lint.input.readers import api_dump, gfxreconstruct
from tests.input.readers.dialects import api_dump as dumped
from tests.input.readers.dialects import common, lined, new_lines
from tests.input.readers.programs import SMALL, WANTED, programs
from tests.paths import SAMPLES
from tests.strength import examples

FOLDER = SAMPLES / "captures"


def read(
    text: bytes, wanted: frozenset[str] = WANTED
) -> tuple[list[Call | Mark], CaptureError | None]:
    """What is read of a text, and why no more."""
    out: list[Call | Mark] = []
    try:
        out.extend(api_dump.calls(io.BytesIO(text), wanted, None))
    except CaptureError as error:
        return out, error
    return out, None


def calls(text: bytes, wanted: frozenset[str] = WANTED) -> list[Call]:
    """The calls of a text that is whole."""
    found, error = read(text, wanted)
    assert error is None, error.message
    return [each for each in found if isinstance(each, Call)]


def broken(text: bytes) -> tuple[str, Place]:
    """Why a text cannot be read, and where."""
    found, error = read(text)
    assert error is not None, found
    return error.message, error.place


def dump(*arguments: dict[str, Any], **more: Any) -> bytes:
    """A dump of one call with arguments as nodes."""
    call = {
        "name": "vkCmdDraw",
        "thread": "Thread 0",
        "returnType": "void",
        "args": list(arguments),
        **more,
    }
    return json.dumps([{"frameNumber": "0", "apiCalls": [call]}]).encode()


def argument(**members: Any) -> Any:
    """The value that a node becomes."""
    (call,) = calls(dump({"name": "a", **members}))
    return call.args["a"]


def test_nodes_become_plain_values() -> None:
    assert argument(type="uint32_t", value="256") == "256"
    assert (
        argument(type="VkImageUsageFlags", value="17 (VK_A_BIT | VK_B_BIT)")
        == "17 (VK_A_BIT | VK_B_BIT)"
    )
    assert argument(type="VkImage", value="0x559322f0a1b0") == 0x559322F0A1B0
    assert argument(type="VkImage*", address="0x7ffe", value="0x10") == 16
    assert argument(
        type="const VkThing*",
        address="0x7ffe",
        members=[{"type": "float", "name": "x", "value": "0.5"}],
    ) == {"x": "0.5"}
    assert argument(type="const VkImage*", address="0x7ffe", elements=[
        {"type": "VkImage", "name": "[0]", "value": "0xa"}, {"type": "VkImage", "name": "[1]",
        "value": "0xb"},
    ]) == [10, 11]  # fmt: skip
    assert argument(
        type="VkClearValue (Union)",
        members=[{"type": "VkClearColorValue (Union)", "name": "color", "members": []}],
    ) == {"color": {}}


@pytest.mark.parametrize("node", [
    {"address": "address"}, {"address": "NULL"}, {"address": "0x0"}, {}, {"address": "UNUSED",
    "value": "UNUSED"}, {"value": "NULL"},
])  # fmt: skip
def test_pointers_without_a_value_are_null(node: dict[str, str]) -> None:
    assert argument(type="const uint32_t*", **node) is None


def test_texts_stay_texts() -> None:
    for text in ("address", "0x10", "UNUSED", "NULL", "0"):
        assert argument(type="const char*", value=text) == text
        assert argument(type="char[256]", value=text) == text


def test_code_is_left_out() -> None:
    node = {"type": "const uint32_t*", "name": "pCode", "address": "0x7f59", "value": "SHADER DATA"}
    assert argument(
        type="const VkShaderModuleCreateInfo*",
        members=[node, {"type": "size_t", "name": "codeSize", "value": "68"}],
    ) == {"codeSize": "68"}


def test_places_and_numbers() -> None:
    text = dumped(SMALL, frames=2)
    found = calls(text)
    assert [(call.name, call.at.column, call.at.call) for call in found] == [
        ("vkCreateImage", 9, 0),
        ("vkSetDebugUtilsObjectNameEXT", 9, 2),
        ("vkCmdDraw", 9, 3),
        ("vkCmdDraw", 9, 4),
        ("vkQueuePresentKHR", 9, 5),
    ]
    rows = text.decode().split("\n")
    for call in found:
        assert call.at.line is not None
        assert [row.strip() for row in rows[call.at.line - 1 : call.at.line + 1]] == [
            "{",
            f'"name" : "{call.name}",',
        ]
    assert [call.result for call in found] == ["VK_SUCCESS", "VK_SUCCESS", None, None, "VK_SUCCESS"]
    assert (
        found[2].args
        == found[3].args
        == {"commandBuffer": 7, "vertexCount": "3", "instanceCount": "1"}
    )


@given(
    programs,
    st.integers(1, 4),
    st.sampled_from(("address", "NULL")),
    st.sampled_from((None, 0, 2)),
    st.sampled_from((10, 300, 1 << 18)),
)
@examples(0.6)
def test_frames_and_layout_do_not_matter(
    program: list[tuple[str, dict[str, Any]]],
    frames: int,
    null: str,
    indent: int | None,
    block: int,
) -> None:
    plain = [
        common(call)
        for call in gfxreconstruct.calls(io.BytesIO(lined(new_lines(program))), WANTED, None)
        if isinstance(call, Call)
    ]
    text = dumped(program, frames=frames, null=null)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(json_stream, "BLOCK", block)
        for each in (
            text,
            json.dumps(json.loads(text), indent=indent).encode(),
            text.replace(b"\n", b"\r\n"),
        ):
            assert [common(call) for call in calls(each)] == plain


def test_repeated_calls_have_their_own_places() -> None:
    program = SMALL[3:4] * 5 + SMALL[:1] + SMALL[3:4] * 5
    found = calls(dumped(program))
    assert [call.at.call for call in found] == list(range(11))
    assert len({call.at.line for call in found}) == 11


def test_what_is_kept_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(api_dump, "MAX_CACHE", 1000)
    program = [("vkCmdDraw", {"commandBuffer": 7, "vertexCount": count % 7}) for count in range(50)]
    assert [call.args["vertexCount"] for call in calls(dumped(program))] == [
        str(count % 7) for count in range(50)
    ]


def test_a_dump_of_later_frames_is_trimmed() -> None:
    found, error = read(dumped(SMALL, frames=2, first=3))
    assert error is None
    assert [each for each in found if isinstance(each, Mark)] == [
        Mark("trimmed", Place(2, 1))
    ] and isinstance(found[0], Mark)
    assert not any(isinstance(each, Mark) for each in read(dumped(SMALL, frames=2))[0])


# Settings that leave too much out.


def test_a_dump_without_addresses() -> None:
    message, place = broken(
        dump({"type": "VkCommandBuffer", "name": "commandBuffer", "value": "address"})
    )
    assert "VK_APIDUMP_NO_ADDR" in message and "VK_APIDUMP_DETAILED" not in message
    assert place == (1, 36, 0)


def test_a_dump_without_arguments() -> None:
    text = (
        b'[{"frameNumber":"0","apiCalls":[{"name":"vkDeviceWaitIdle","returnType":"VkResult"},\n'
        b'{"name":"vkCmdDraw","returnType":"void"}]}]'
    )
    message, place = broken(text)
    assert "VK_APIDUMP_DETAILED" in message and "VK_APIDUMP_NO_ADDR" not in message
    assert place == (2, 1, 1)


# What is broken.


def test_a_file_of_a_program_that_was_killed() -> None:
    text = dumped(SMALL)
    whole = calls(text)
    cut = text[: text.rindex(b"\n    ]\n}\n]")]
    found, error = read(cut)
    assert found == whole
    assert error is not None
    assert error.message == "the file is truncated: the captured program did not exit cleanly"
    assert error.place == Place(cut.count(b"\n") + 1, 10)


def test_cut_at_every_byte() -> None:
    text = dumped(SMALL, frames=2)
    whole = calls(text)
    rows = text.split(b"\n")
    ends = []
    for call in whole:
        assert call.at.line is not None
        start = sum(len(row) + 1 for row in rows[: call.at.line - 1])
        ends.append(text.index(b"\n        }", start) + len(b"\n        }"))
    for cut in range(len(text) - 1):
        found, error = read(text[:cut])
        assert found == whole[: sum(end <= cut for end in ends)], cut
        assert error is not None and error.place.line == text.count(b"\n", 0, cut) + 1


@given(st.lists(st.tuples(st.integers(0, 1 << 20), st.integers(0, 255)), min_size=1, max_size=3))
@examples(2.5)
def test_bytes_that_were_changed(changes: list[tuple[int, int]]) -> None:
    original = dumped(SMALL, frames=2)
    text = bytearray(original)
    first = len(text)
    for at, value in changes:
        text[at % len(text)] = value
        first = min(first, at % len(text))
    line = original.count(b"\n", 0, first) + 1
    whole = calls(original)
    before = [
        call
        for call, following in zip(whole, [*whole[1:], None], strict=True)
        if following and (following.at.line or 0) < line
    ]
    found, _ = read(bytes(text))
    assert found[: len(before)] == before


SYMBOLS = [
    b"{",
    b"}",
    b"[",
    b"]",
    b'"',
    b",",
    b":",
    b"\n",
    b'"apiCalls"',
    b'"args"',
    b'"name"',
    b"1",
    b" ",
    b"\\",
    b'"elements"',
    b'"a"',
]


@given(st.lists(st.sampled_from(SYMBOLS), max_size=60).map(b"".join))
@examples(2.5)
def test_any_symbols(text: bytes) -> None:
    for given_text in (
        text,
        b"[{" + text,
        b'[{"apiCalls":[{"name":"vkCmdDraw","args":[{"name":"a",' + text,
    ):
        read(given_text)


@pytest.mark.parametrize(("text", "message", "place"), [
    ("", "the file is truncated: the captured program did not exit cleanly", (1, 1)),
    ("{", "invalid JSON: expected `[`", (1, 1)),
    ("[5]", "invalid JSON: expected `{`", (1, 2)),
    ("[{5:6}]", "invalid JSON: expected a name", (1, 3)),
    ('[{"apiCalls":5}]', "invalid JSON: expected `[`", (1, 14)),
    ('[{"apiCalls" []}]', "invalid JSON: expected `:`", (1, 14)),
    ('[{"frameNumber":"0","apiCalls":[]}] 5', "invalid JSON: unexpected text after the end of the "
        "document", (1, 37)),
    ('[{"apiCalls":[5]}]', "invalid call: expected an object with a name", (1, 15)),
    ('[{"apiCalls":[{"name":"vkCmdDraw","args":5}]}]', "invalid call: expected an array of "
        "arguments, members or elements", (1, 15)),
    ('[{"apiCalls":[{"name":"vkCmdDraw","args":[5]}]}]', "invalid call: expected an object with a "
        "type and a name", (1, 15)),
    ('[{"apiCalls":[{"name":"vkCmdDraw","args":[{"value":"5"}]}]}]', "invalid call: a member has "
        "no name", (1, 15)),
    ('[{"apiCalls":[\n{"name":"vkCmdDraw","args":[,]}]}]',
     "invalid JSON: expected a value or a key after `[`, found `,`; remove one of them", (2, 29)),
])  # fmt: skip
def test_what_is_no_dump(text: str, message: str, place: tuple[int, int]) -> None:
    found = broken(text.encode())
    assert (found[0], found[1][:2]) == (message, place)


def test_an_empty_dump() -> None:
    assert calls(b"[]") == calls(b'[{"frameNumber":"0","apiCalls":[]}]') == calls(b"[{}]") == []


def test_deep_nesting_is_refused() -> None:
    node: dict[str, Any] = {"type": "T", "name": "a", "value": "1"}
    for _ in range(60):
        node = {"type": "T", "name": "a", "members": [node]}
    assert broken(dump(node))[0] == "nested deeper than 100"


# Captures of real programs.


class Everything(frozenset[str]):
    """Every call's name."""

    def __contains__(self, name: object) -> bool:
        return True


@pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no samples at {FOLDER}")
class TestSamples:
    @pytest.mark.parametrize(
        ("name", "count"),
        [("apidump_1.4.350_msaa.json", 75), ("apidump_1.4.350_vkcube_3frames.json", 185)],
    )
    def test_every_call_of_a_sample(self, name: str, count: int) -> None:
        text = (FOLDER / name).read_bytes()
        assert api_dump.claims(text[: 1 << 16])
        expected = [
            (each["name"], each.get("returnValue"))
            for frame in json.loads(text)
            for each in frame["apiCalls"]
        ]
        found = calls(text, Everything())
        assert [(call.name, call.result) for call in found] == expected
        assert [call.at.call for call in found] == list(range(count))

    def test_a_sample_says_what_gfxreconstruct_says(self) -> None:
        wanted = frozenset(
            {"vkCreateImage", "vkCreateRenderPass", "vkCreateRenderPass2", "vkCmdBeginRendering"}
        )
        dumped_calls = calls((FOLDER / "apidump_1.4.350_msaa.json").read_bytes(), wanted)
        with open(FOLDER / "gfxr_1.0.5_msaa.jsonl", "rb") as file:
            read_lines = list(gfxreconstruct.calls(file, wanted, None))
        lines = [
            each for each in read_lines if isinstance(each, Call) and each.name.startswith("vk")
        ]
        assert [call.name for call in dumped_calls] == [call.name for call in lines]
        for one, other in zip(dumped_calls, lines, strict=True):
            if one.name == "vkCreateImage":
                infos = [common(call)[1]["pCreateInfo"] for call in (one, other)]
                members = ("format", "extent", "samples", "usage", "mipLevels", "arrayLayers")
                assert [infos[0][member] for member in members] == [
                    infos[1][member] for member in members
                ]
            elif one.name.startswith("vkCreateRenderPass"):
                states = [common(call)[1]["pCreateInfo"]["pAttachments"] for call in (one, other)]
                for left, right in zip(*states, strict=True):
                    for member in (
                        "format",
                        "samples",
                        "loadOp",
                        "storeOp",
                        "stencilLoadOp",
                        "finalLayout",
                    ):
                        assert left[member] == right[member]


# What must be converted first.


@pytest.mark.parametrize(("head", "says"), [
    (b"<!doctype html><html><head><title>Vulkan API Dump</title>", "VK_APIDUMP_OUTPUT_FORMAT=json"),
    (b"Thread 0, Frame 0:\nvkCreateInstance(pCreateInfo, pAllocator, pInstance) returns VkResult",
    "VK_APIDUMP_OUTPUT_FORMAT=json"),
    (b"vkCreateInstance(pCreateInfo, pAllocator, pInstance) returns VkResult VK_SUCCESS (0):\n",
    "VK_APIDUMP_OUTPUT_FORMAT=json"),
    (b"\x04\x22\x4d\x18", "lz4 -d"),
    (b"PK\x03\x04", "unzip"),
    ('[{"frameNumber": "0", "apiCalls": []}]'.encode("utf-16"), "UTF-16"),
])  # fmt: skip
def test_hints(head: bytes, says: str) -> None:
    found = hint(head)
    assert found is not None and says in found


@pytest.mark.parametrize(
    "head",
    [
        b"",
        b"{}",
        b"images: {}",
        b"<!doctype html><html><title>A page</title>",
        b"vkCreateInstance: 5",
        b"<rdc>",
        b"[]",
    ],
)
def test_no_hint(head: bytes) -> None:
    assert hint(head) is None
    assert hint(dumped(SMALL)) is None
