"""gfxreconstruct's JSON in all of its dialects: every call at its place, the marks, the files
beside it, and what is broken.
"""

from __future__ import annotations

import io
import json
import os
import tracemalloc
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import orjson
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.input.captures import json_stream
from msaa_lint.input.captures.call import Call, CaptureError, Mark, Place
from msaa_lint.input.opening import hint
from msaa_lint.input.readers import api_dump, gfxreconstruct
from tests.input.readers.dialects import api_dump as dumped
from tests.input.readers.dialects import common, lined, new_array, new_lines, new_objects, old_lines
from tests.input.readers.programs import SMALL, WANTED, programs
from tests.paths import SAMPLES
from tests.strength import examples

FOLDER = SAMPLES / "captures"

DRAWS = frozenset({"vkCmdDraw"})


def read(
    text: bytes, wanted: frozenset[str] = WANTED, name: str | None = None
) -> tuple[list[Call | Mark], CaptureError | None]:
    """What is read of a text, and why no more, without whether calls recur."""
    out: list[Call | Mark] = []
    read_calls = gfxreconstruct.calls(io.BytesIO(text), wanted, name)
    try:
        out.extend(
            each._replace(recurring=0) if isinstance(each, Call) else each for each in read_calls
        )
    except CaptureError as error:
        # Lists extended by a generator that fails keep what it gave before.
        return out, error
    return out, None


def calls(text: bytes, wanted: frozenset[str] = WANTED, name: str | None = None) -> list[Call]:
    """The calls of a text that is whole."""
    found, broken = read(text, wanted, name)
    assert broken is None, broken.message
    return [each for each in found if isinstance(each, Call)]


def line(index: int, body: str) -> str:
    return f'{{"index":{index},"function":{body}}}'


def draw(count: int) -> str:
    return f'{{"name":"vkCmdDraw","thread":1,"args":{{"vertexCount":{count}}}}}'


def with_argument(value: str) -> str:
    return line(1, f'{{"name":"vkCmdDraw","args":{{"a":{value}}}}}')


def broken(text: bytes, wanted: frozenset[str] = WANTED) -> tuple[str, Place]:
    """Why a text cannot be read, and where."""
    found, error = read(text, wanted)
    assert error is not None, found
    return error.message, error.place


@given(programs)
@examples(0.6)
def test_all_dialects_give_the_same_calls(program: list[tuple[str, dict[str, Any]]]) -> None:
    plain = calls(lined(new_lines(program)))
    assert len(plain) == len(program)
    wanted = [common(call) for call in plain]
    assert [common(call) for call in calls(lined(new_lines(program, expand=True)))] == wanted
    array = calls(new_array(program))
    assert [common(call) for call in array] == wanted
    assert (
        [call.at.call for call in array]
        == [call.at.call for call in plain]
        == list(range(2, len(program) + 2))
    )
    dump = list(api_dump.calls(io.BytesIO(dumped(program)), WANTED, None))
    assert [common(call) for call in dump if isinstance(call, Call)] == wanted
    for new, old in zip(wanted, calls(lined(old_lines(program))), strict=True):
        name, args, result = common(old)
        assert (name, result) == (new[0], new[2])
        for info, expected in zip(
            args.get("pCreateInfos", ()), new[1].get("pCreateInfos", ()), strict=True
        ):
            if info["pMultisampleState"] is not None:
                assert "pSampleMask" not in info["pMultisampleState"], "0.9 does not know it"
                del expected["pMultisampleState"]["pSampleMask"]
        assert args == new[1]


def test_places_in_lines_and_in_an_array() -> None:
    lines = calls(lined(new_lines(SMALL)))
    assert [(call.name, *call.at) for call in lines] == [
        ("vkCreateImage", 2, 1, 2),
        ("vkSetDebugUtilsObjectNameEXT", 4, 1, 4),
        ("vkCmdDraw", 5, 1, 5),
        ("vkCmdDraw", 6, 1, 6),
        ("vkQueuePresentKHR", 7, 1, 7),
    ]
    text = new_array(SMALL)
    array = calls(text)
    assert [call.at.call for call in array] == [call.at.call for call in lines]
    for call in array:
        assert call.at.line is not None and call.at.column == 1
        rows = text.decode().split("\n")[call.at.line - 1 :]
        assert (rows[0], rows[1].strip(), rows[3].strip()) == (
            "{",
            f'"index": {call.at.call},',
            f'"name": "{call.name}",',
        )


def test_results_and_arguments() -> None:
    image, _, first, second, present = calls(lined(new_lines(SMALL)))
    assert (image.result, first.result, present.result) == ("VK_SUCCESS", None, "VK_SUCCESS")
    assert image.args["pCreateInfo"] == {
        "samples": "VK_SAMPLE_COUNT_4_BIT",
        "usage": "0x00000011",
        "flags": "0x00000000",
    }
    assert first.args == second.args == {"commandBuffer": 7, "vertexCount": 3, "instanceCount": 1}


def test_a_call_that_nobody_follows_is_not_looked_into() -> None:
    text = lined(
        [line(1, draw(3)), line(2, '{"name":"vkDeviceWaitIdle","args":{no json'), line(3, draw(4))]
    )
    assert [call.at.call for call in calls(text)] == [1, 3]


def test_suffixes_of_vendors_do_not_matter() -> None:
    names = ["vkCmdDrawKHR", "vkCmdDrawEXT", "vkCmdDrawNV", "vkCmdDrawIndexed", "vkCmdDraw"]
    text = lined([line(at, f'{{"name":"{name}","args":{{}}}}') for at, name in enumerate(names)])
    assert [call.name for call in calls(text, DRAWS)] == [
        "vkCmdDrawKHR",
        "vkCmdDrawEXT",
        "vkCmdDrawNV",
        "vkCmdDraw",
    ]


def test_lines_of_an_unexpected_shape_are_parsed() -> None:
    text = lined([
        '{"function":{"thread":1,"args":{"vertexCount":1},"name":"vkCmdDraw"},"index":5}',
        ' { "index" : 6, "function" : {"name" : "vkCmdDraw", "args" : {"vertexCount":2}}}',
        "",
        '{"sub":{"index":1,"function":{"name":"vkCmdDraw"}}}',
        '{"index":7,"function":{"name":"vkCmd\\u0044raw","args":{"vertexCount":3}},"function2":1}',
        '{"index":8,"other":{"name":"vkCmdDraw","args":{"vertexCount":3}}}',
    ])  # fmt: skip
    found = calls(text)
    assert [(call.args["vertexCount"], call.at) for call in found] == [
        (1, (1, 1, 5)),
        (2, (2, 1, 6)),
        (3, (5, 1, 7)),
    ]


# The reading of lines against a plain one: whatever recurs, and in whatever order.

BODIES = [
    draw(3),
    draw(4),
    '{"name":"vkCmdDraw","args":{"vertexCount":3}}',
    '{"name":"vkDeviceWaitIdle","args":{"device":1}}',
    '{"name":"vkDeviceWaitIdle","args":{"device":22222}}',
    '{"name":"vkCreateImage","args":{"pImage":1}}',
    '{"name":"vkCmdDraw","args":{"text":"\\n{\\"index\\":3,"}}',
]
OTHER = [
    "",
    "  ",
    '{"state":{"marker_type":"EndMarker","frame_number":3}}',
    '{"index":3,"annotation":{"data":"x"}}',
    "\r",
]


def plainly(text: bytes, wanted: frozenset[str]) -> Iterator[Call]:
    """The calls by parsing every line."""
    for number, each in enumerate(text.split(b"\n"), 1):
        value = json.loads(each) if each.strip() else {}
        body = value.get("function")
        if body is not None and body["name"] in wanted:
            yield Call(body["name"], body["args"], Place(number, 1, value["index"]))


pieces = st.lists(
    st.tuples(st.sampled_from(BODIES), st.integers(-2, 3)) | st.sampled_from(OTHER), max_size=12
)


@given(
    pieces=st.lists(st.tuples(pieces, st.integers(1, 4)), min_size=1, max_size=4),
    first=st.sampled_from((0, 7, 95, 998, 99_990)),
    ending=st.sampled_from(("\n", "\r\n")),
    last=st.booleans(),
    block=st.sampled_from((1, 16, 64, 100, 1000, 1 << 18)),
    credit=st.sampled_from((1, 3, 1 << 13)),
    size=st.sampled_from((50, 200, 1 << 20)),
)
@examples(3)
def test_what_recurs_is_read_as_if_it_were_new(
    pieces: list[tuple[list[Any], int]],
    first: int,
    ending: str,
    last: bool,
    block: int,
    credit: int,
    size: int,
) -> None:
    index = first
    lines = ['{"index":1,"function":{"name":"vkCmdDraw","args":{}}}']
    for piece, times in pieces:
        for _ in range(times):
            for each in piece:
                if isinstance(each, tuple):
                    index = max(0, index + each[1])
                    lines.append(line(index, each[0]))
                else:
                    lines.append(each)
    text = ending.join(lines).encode() + (ending.encode() if last else b"")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(json_stream, "BLOCK", block)
        patch.setattr(gfxreconstruct, "CREDIT", credit)
        patch.setattr(gfxreconstruct, "PAUSE", 2 * credit)
        patch.setattr(gfxreconstruct, "MAX_CACHE", size)
        assert calls(text, frozenset({"vkCmdDraw", "vkCreateImage"})) == list(
            plainly(text, frozenset({"vkCmdDraw", "vkCreateImage"}))
        )


class Counting:
    """A pattern that counts how often it is asked."""

    def __init__(self, pattern: Any) -> None:
        self.pattern = pattern
        self.count = 0

    def match(self, *arguments: Any) -> Any:
        self.count += 1
        return self.pattern.match(*arguments)


def test_frames_alike_are_not_parsed(monkeypatch: pytest.MonkeyPatch) -> None:
    # Draws recur within a frame, and a call that nobody follows differs in each.
    frame = [
        draw(1),
        draw(2),
        draw(1),
        draw(3),
        draw(1),
        draw(1),
        '{"name":"vkWaitForFences","args":{"a":%d}}',
        draw(4),
        draw(2),
        draw(5),
    ]
    text = lined([line(8 + at, frame[at % 10].replace("%d", str(at))) for at in range(2000)])
    slow, parsed = Counting(gfxreconstruct.LINE_START), []
    monkeypatch.setattr(gfxreconstruct, "LINE_START", slow)
    parse = orjson.loads
    for module, name in ((orjson, "loads"), (gfxreconstruct, "loads_plain")):
        monkeypatch.setattr(module, name, lambda line: parsed.append(1) or parse(line))
    monkeypatch.setattr(json_stream, "BLOCK", 1000)
    assert len(calls(text)) == 1800
    assert len(parsed) == 5, "the calls that differ"
    # The names, and the lines where the index has another digit.
    assert slow.count <= 2 + 4


def test_lines_that_never_recur_are_hardly_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    added: list[bytes] = []

    class Counted(gfxreconstruct.LineCache):
        def add(self, line: gfxreconstruct.CachedLine) -> None:
            added.append(line.body)
            super().add(line)

    monkeypatch.setattr(gfxreconstruct, "LineCache", Counted)
    monkeypatch.setattr(gfxreconstruct, "CREDIT", 10)
    monkeypatch.setattr(gfxreconstruct, "PAUSE", 160)
    frames = [
        each
        for frame in range(100)
        for each in (draw(frame), '{"name":"vkCmdDrawIndexed","args":{"indexCount":5}}')
    ]
    assert (
        len(
            calls(
                lined([line(at, each) for at, each in enumerate(frames)]),
                frozenset({"vkCmdDraw", "vkCmdDrawIndexed"}),
            )
        )
        == 200
    )
    assert len(added) == 10 + 1, "the others are not worth it, which is known of each call apart"


def test_an_empty_line_before_one_that_is_foreseen() -> None:
    # The beginning of a call that nobody follows stands where it is expected, but a line further.
    unwanted = '{"name":"vkDeviceWaitIdle","args":{}}'
    text = lined(
        [
            line(10, draw(1)),
            line(11, unwanted),
            line(12, draw(1)),
            "",
            line(9, unwanted),
            line(13, draw(1)),
            "{}",
            line(9, unwanted),
        ]
    )
    text += lined([line(14, draw(2))])
    assert [call.at for call in calls(text)] == [(1, 1, 10), (3, 1, 12), (6, 1, 13), (9, 1, 14)]


def test_what_is_shared_and_what_is_not() -> None:
    module = '{"name":"vkCreateShaderModule","args":{"pCreateInfo":{"codeSize":4}}}'
    lines = [line(at, body) for at, body in enumerate([draw(1), module, draw(1), module], 1)]
    for text in (lined(lines), f"[{','.join(lines)}]".encode()):
        first, one, second, other = calls(text)
        assert first.args is second.args
        assert one.args == other.args and one.args is not other.args, (
            "code may be large: nothing of it is kept"
        )


def test_memory_does_not_grow_with_the_lines() -> None:
    def peak(count: int) -> int:
        class Endless(io.RawIOBase):
            """Lines none of which is like another."""

            at = 0

            def read(self, size: int = -1) -> bytes:
                if self.at >= count:
                    return b""
                self.at += 1000
                return lined([line(at, draw(at)) for at in range(self.at - 1000, self.at)])

        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(gfxreconstruct, "MAX_CACHE", 50_000)
            tracemalloc.start()
            try:
                assert sum(1 for _ in gfxreconstruct.calls(Endless(), DRAWS, None)) == count  # type: ignore[arg-type]
                return tracemalloc.get_traced_memory()[1]
            finally:
                tracemalloc.stop()

    assert peak(16_000) < 1.4 * peak(4_000)


# Layouts of an array.


@given(
    programs,
    st.sampled_from((None, 0, 1, 2, 4, "\t")),
    st.integers(0, 3),
    st.booleans(),
    st.sampled_from((16, 300, 1 << 18)),
)
@examples(0.8)
def test_an_array_in_any_layout(
    program: list[tuple[str, dict[str, Any]]],
    indent: int | str | None,
    shift: int,
    windows: bool,
    block: int,
) -> None:
    objects = new_objects(program)
    wanted = [common(call) for call in calls(lined(new_lines(program)))]
    whole = json.dumps(objects, indent=indent)
    dumped_apart = [json.dumps(each, indent=indent) for each in objects]
    apart = "[" + ",\n".join(" " * shift + each for each in dumped_apart) + "]"
    close = "[\n" + ", ".join(dumped_apart) + "\n]"
    for text in (whole, apart, close):
        text = text.replace("\n", "\r\n") if windows else text
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(json_stream, "BLOCK", block)
            found = calls(text.encode())
        assert [common(call) for call in found] == wanted
        for call in found:
            assert call.at.line is not None and call.at.column is not None
            start = (
                sum(len(row) + 1 for row in text.split("\n")[: call.at.line - 1])
                + call.at.column
                - 1
            )
            assert json.JSONDecoder().raw_decode(text, start)[0]["index"] == call.at.call


@pytest.mark.parametrize("text", [
    '[\n{\n  "a": 1 }, {\n  "index": 1, "function": {"name": "vkCmdDraw", "args": {}}\n}\n]',
        '[{\n  "a": 1 }, {\n  "index": 1, "function": {"name": "vkCmdDraw", "args": {}}\n}]',
    '[\n{\n  "a": 1\n  },\n{\n  "index": 1, "function": {"name": "vkCmdDraw", "args": {}}\n}\n]',
    '[\n{\n"a": "}"\n},\n{\n"index": 1, "function": {\n"name": "vkCmdDraw", "args": {\n}\n}\n}\n]',
    '[\n{\n  "a": "\\" } {"\n},\n{\n  "index": 1,\n  "function": {\n    "name": "vkCmdDraw",\n    '
    '"args": {}\n  }\n}\n]',
    '[\n    {\n        "b": {\n    }, "a": 1},\n    {\n        "index": 1, "function": {"name": '
    '"vkCmdDraw", "args": {}}\n    }\n]',
])  # fmt: skip
def test_brackets_that_mislead(text: str) -> None:
    assert [call.name for call in calls(text.encode())] == ["vkCmdDraw"]
    unwanted = text.replace(
        "]", ', {"index": 2, "function": {"name": "vkCmdDraw", "args": {}}}]'
    ).encode()
    assert [call.at.call for call in calls(unwanted)] == [1, 2]


def test_skipped_elements_in_a_misleading_layout() -> None:
    skipped = (
        '{\n  "index": 1, "function": {"name": "vkDeviceWaitIdle", "args": {}} }, {\n  '
        '"index": 2, "function": {"name": "vkCmdDraw"} }'
    )
    assert [call.at for call in calls(f"[\n{skipped}\n]".encode())] == [(3, 71, 2)]


# What beside calls stands in a capture.


def test_device_commands_are_calls() -> None:
    text = lined([
        '{"index":4,"meta":{"name":"SetDevicePropertiesCommand","args":{"physical_device_id":2,"vendor_id":5045}}}',
        '{"index":5,"meta":{"name":"SetDeviceMemoryPropertiesCommand","args":{"memory_types":[{"property_flags":"0x0000000f","heap_index":0}]}}}',
        '{"index":6,"meta":{"name":"FillMemoryCommand","args":{"data":"[Binary data]"}}}',
        line(7, draw(3)),
    ])  # fmt: skip
    assert [(call.name, call.at) for call in calls(text)] == [
        ("SetDevicePropertiesCommand", (1, 1, 4)),
        ("SetDeviceMemoryPropertiesCommand", (2, 1, 5)),
        ("vkCmdDraw", (4, 1, 7)),
    ]
    assert calls(text)[1].args == {
        "memory_types": [{"property_flags": "0x0000000f", "heap_index": 0}]
    }


def marks(*lines: str) -> list[Mark]:
    return [each for each in read(lined([*lines, line(1, draw(3))]))[0] if isinstance(each, Mark)]


def test_a_trimmed_capture_says_so_once() -> None:
    state = '{"state":{"marker_type":"BeginMarker","frame_number":3}}'
    ended = '{"state":{"marker_type":"EndMarker","frame_number":3}}'
    assert marks(state, ended) == [Mark("trimmed", Place(1, 1))]
    old = '{"header":{"source-path":"cube/cube_frames_3_through_4.gfxr","json-version":"0.8.0"}}'
    assert marks(old) == [Mark("trimmed", Place(1, 1))]
    assert marks('{"header":{"source-path":"cube_frame_12.gfxr"}}', state) == [
        Mark("trimmed", Place(1, 1))
    ]
    assert marks('{"header":{"source-path":"frames.gfxr"}}') == []
    assert marks('{"header":{"source-path":"my_frames_game.gfxr"}}', ended) == []


def test_frames_that_the_tool_marks() -> None:
    text = [
        '{"frame":{"marker_type":"BeginMarker","frame_number":1}}',
        '{"frame":{"marker_type":"EndMarker","frame_number":1}}',
    ]
    assert marks(*text) == [Mark("frame", Place(2, 1))]


def test_direct3d_is_passed_over() -> None:
    method = '{"index":1,"method":{"name":"ID3D12Device::CreateFence","thread":1,"object":{},"return":"S_OK","args":{}}}'
    assert len(calls(lined([method, line(2, draw(3))]))) == 1
    assert (
        broken(lined([method, method]))[0]
        == "this capture contains no Vulkan calls, only Direct3D calls"
    )
    assert broken(b'{"header":{"source-path":"a.gfxr"}}\n') == (
        "this capture contains no Vulkan calls",
        Place(1, 1),
    )
    assert broken(b"")[0] == "this capture contains no Vulkan calls"
    assert calls(lined([line(2, '{"name":"vkDeviceWaitIdle","args":{}}')])) == []


def test_null_sample_masks_of_the_old_dialect_are_unknown() -> None:
    for key, mask, known in (
        ("vkFunc", None, {}),
        ("vkFunc", [15], {"pSampleMask": [15]}),
        ("function", None, {"pSampleMask": None}),
    ):
        state = {"rasterizationSamples": "VK_SAMPLE_COUNT_4_BIT", "pSampleMask": mask}
        infos = [{"pMultisampleState": state}, {"pMultisampleState": None}, None]
        text = json.dumps(
            {
                "index": 1,
                key: {"name": "vkCreateGraphicsPipelines", "args": {"pCreateInfos": infos}},
            }
        )
        (call,) = calls(text.encode())
        assert call.args["pCreateInfos"][0]["pMultisampleState"] == {
            "rasterizationSamples": "VK_SAMPLE_COUNT_4_BIT",
            **known,
        }


# Shaders in files.

CODE = (0x07230203).to_bytes(4, "little") + bytes(64)


def module(path: str, name: str | None) -> Any:
    args = {"pCreateInfo": {"codeSize": 68, "pCode": path}, "pShaderModule": 5}
    text = line(1, json.dumps({"name": "vkCreateShaderModule", "args": args}))
    return calls(text.encode(), name=name)[0].args["pCreateInfo"].get("pCode")


def test_code_is_read_from_files_of_the_captures_folder(tmp_path: Path) -> None:
    folder = tmp_path / "a"
    (folder / "game").mkdir(parents=True)
    (folder / "game" / "1_pCode.bin").write_bytes(CODE)
    capture = str(folder / "game.jsonl")
    assert module("game/1_pCode.bin", capture) == CODE
    assert module("game\\1_pCode.bin", capture) == CODE
    assert module(str(folder / "game" / "1_pCode.bin"), capture) == CODE
    assert module("game/1_pCode.bin", None) is None, "a stream has no folder"
    for nothing in (
        "game",
        "game/2_pCode.bin",
        "[Binary data]",
        "0x7fff0000",
        "",
        "\0",
        "a" * 5000,
    ):
        assert module(nothing, capture) is None, nothing


def test_code_elsewhere_is_left_out(tmp_path: Path) -> None:
    folder = tmp_path / "a"
    folder.mkdir()
    outside = tmp_path / "outside.bin"
    outside.write_bytes(CODE)
    (folder / "link.bin").symlink_to(outside)
    (folder / "up").symlink_to(tmp_path)
    (folder / "inside.bin").write_bytes(CODE)
    (folder / "good.bin").symlink_to(folder / "inside.bin")
    os.mkfifo(folder / "pipe.bin")
    with open(folder / "large.bin", "wb") as file:
        file.truncate((16 << 20) + 1)
    capture = str(folder / "game.jsonl")
    for path in (
        "../outside.bin",
        str(outside),
        "link.bin",
        "up/outside.bin",
        "pipe.bin",
        "large.bin",
        "/dev/zero",
        "../aa/x",
    ):
        assert module(path, capture) is None, path
    assert module("good.bin", capture) == CODE


def test_code_of_shaders_without_a_module(tmp_path: Path) -> None:
    (tmp_path / "s.bin").write_bytes(CODE)
    stage = {"module": 0, "pNext": {"sType": "X", "pNext": {"pCode": "s.bin"}}}
    args = {"pCreateInfos": [{"pStages": [stage], "pNext": {"pCode": "[Binary data]"}}, 5, None]}
    text = line(1, json.dumps({"name": "vkCreateGraphicsPipelines", "args": args})).encode()
    (call,) = calls(text, name=str(tmp_path / "c.jsonl"))
    assert call.args["pCreateInfos"][0] == {
        "pStages": [{"module": 0, "pNext": {"sType": "X", "pNext": {"pCode": CODE}}}],
        "pNext": {},
    }


# What is broken.


def test_a_line_that_is_no_json() -> None:
    text = lined(
        [
            line(1, draw(3)),
            '{"index":2,"function":{"name":"vkCmdDraw","args":{,}}}',
            line(3, draw(3)),
        ]
    )
    found, error = read(text)
    assert [each.at for each in found] == [(1, 1, 1)]
    assert error is not None and error.message.startswith("invalid JSON: ")
    assert error.place == (2, 51, None)


def test_a_cut_line_is_named() -> None:
    text = lined(new_lines(SMALL))
    message, place = broken(text[:-20])
    assert (message, place) == ("the file is truncated in this line", Place(7, 1))
    # The last line is read whole even where nobody follows its call: a cut is to be told.
    assert broken(
        lined([line(1, draw(3))]) + b'{"index":2,"function":{"name":"vkDeviceWaitIdle","ar'
    )[1] == Place(2, 1)


def test_places_of_bad_json_in_an_array() -> None:
    text = b'[\n{\n  "index": 1,\n  "function": {"name": "vkCmdDraw", "args": {,}}\n}\n]'
    message, place = broken(text)
    assert message.startswith("invalid JSON: ") and place == (4, 46, None)
    assert broken(b'[ {"index": 1, "function": {"name": "vkCmdDraw", "args": {,}}}]')[1] == (
        1,
        59,
        None,
    )
    assert broken(b'[\n{"a": 1}\n{"b": 2}]') == ("invalid JSON: expected `,` or `]`", Place(3, 1))
    assert broken(b'[\n{"a": 1}\n] x') == (
        "invalid JSON: unexpected text after the end of the document",
        Place(3, 3),
    )
    assert broken(b'[\n{"a": 1},\n') == ("the file is truncated", Place(3, 1))
    assert broken(b"[\n]") == ("invalid JSON: expected a value", Place(2, 1))


@pytest.mark.parametrize("text", [b"5\n", b'{"index":1,"function":5}\n',
b'{"index":1,"function":{"name":7,"args":{}}}\n',
                                  b'{"index":1,"function":{"name":"vkCmdDraw","args":7}}\n',
                                  b"[5]", b'["a", 5]'])  # fmt: skip
def test_json_that_is_no_call(text: bytes) -> None:
    assert broken(text)[0].startswith("invalid call: ")


@pytest.mark.parametrize("depth", [101, 5000, 200_000])
def test_deep_nesting_is_refused(depth: int) -> None:
    deep = "[" * depth + "]" * depth
    text = with_argument(deep)
    for given_text in (f"{text}\n", text, f"[{text}]", f"[\n{text}\n]"):
        message, place = broken(given_text.encode())
        assert place.line in (1, 2)
        assert message == "nested deeper than 100"


def test_nesting_within_the_limit() -> None:
    text = with_argument("[" * 90 + "]" * 90)
    assert len(calls(text.encode())) == len(calls(f"[{text}]".encode())) == 1


@pytest.mark.parametrize("form", ["line", "element", "unwanted element", "open"])
def test_a_call_that_is_too_long(form: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(json_stream, "MAX_VALUE", 2000)
    monkeypatch.setattr(json_stream, "BLOCK", 100)
    fits = with_argument('"' + "x" * (2000 - len(with_argument('""')) - 1) + '"')
    assert len(fits) == 1999
    assert len(calls(f"{fits}\n".encode())) == len(calls(f"[\n{fits}]".encode())) == 1
    longer = fits.replace("xx", "xxxx", 1)
    text = {
        "line": f"{fits}\n{longer}\n",
        "element": f"[{fits},\n{longer}]",
        "unwanted element": f"[{fits},\n" + longer.replace("vkCmdDraw", "vkCmdXxxx") + "]",
        "open": f"[{fits},\n" + "[" * 50 + "1," * 5000,
    }[form]
    message, place = broken(text.encode())
    assert message == "a call exceeds 64 MiB"
    assert place[:2] == (2, 1)


def test_names_that_are_no_utf8() -> None:
    text = b'{"index":1,"function":{"name":"vkSetDebugUtilsObjectNameEXT","args":{"pNameInfo":{"pObjectName":"\xe9t\xe9"}}}}\n'
    assert calls(text)[0].args == {"pNameInfo": {"pObjectName": "\ufffdt\ufffd"}}


@pytest.mark.parametrize("number", ["nan", "-nan", "inf", "-inf", "NaN", "-Infinity", "-nan(ind)"])
def test_floats_that_are_no_json(number: str) -> None:
    # The float32 of a clear value that is an integer's, by version 0.9.
    color = f'{{"name":"nan \\"inf\\"","float32":[{number},0.000000,{number}],"int32":[-1,0,-1]}}'
    for text in (with_argument(color), f"[{with_argument(color)}]"):
        (call,) = calls(text.encode())
        assert call.args["a"] == {
            "name": 'nan "inf"',
            "float32": [None, 0.0, None],
            "int32": [-1, 0, -1],
        }
    assert broken(with_argument(f'{{"b":{number}5}}').encode() + b"\n")[0].startswith(
        "invalid JSON: "
    )


def test_names_with_control_characters() -> None:
    text = with_argument('"a\1b\\tc\t \\"d\\" C:\\\\dir C:\\x \\u12 \\u00e9"')
    assert calls(text.encode())[0].args == {"a": 'a b\tc  "d" C:\\dir C:\\x \\u12 é'}


def test_a_byte_order_mark() -> None:
    for text in (lined(new_lines(SMALL)), new_array(SMALL)):
        assert gfxreconstruct.claims(b"\xef\xbb\xbf" + text)
        assert calls(b"\xef\xbb\xbf" + text) == calls(text)


# Cuts and flips.

TEXTS = {
    "lines": lined(new_lines(SMALL)),
    "old": lined(old_lines(SMALL)),
    "array": new_array(SMALL),
}


@pytest.mark.parametrize("form", TEXTS)
def test_cut_at_every_byte(form: str) -> None:
    text = TEXTS[form]
    whole = calls(text)
    ends = [
        text.find(b"\n" if form != "array" else b"\n}", _offset(text, call)) + 2 * (form == "array")
        for call in whole
    ]
    for cut in range(len(text)):
        found, error = read(text[:cut])
        assert found == whole[: len(found)]
        assert len(found) == sum(end <= cut for end in ends), cut
        if form == "array":
            assert error is not None or cut == len(text) - 1
        elif text[cut - 1 : cut] not in (b"\n", b"}") and cut:
            assert error is not None
            assert error.place == (text.count(b"\n", 0, cut) + 1, 1, None)


def _offset(text: bytes, call: Call) -> int:
    """Where a call begins."""
    at = 0
    for _ in range((call.at.line or 1) - 1):
        at = text.index(b"\n", at) + 1
    return at


@given(
    st.sampled_from(sorted(TEXTS)),
    st.lists(st.tuples(st.integers(0, 1 << 20), st.integers(0, 255)), min_size=1, max_size=3),
)
@examples(3)
def test_bytes_that_were_changed(form: str, changes: list[tuple[int, int]]) -> None:
    text = bytearray(TEXTS[form])
    whole = calls(bytes(text))
    first = len(text)
    for at, value in changes:
        text[at % len(text)] = value
        first = min(first, at % len(text))
    found, _ = read(bytes(text))
    ending = b"\n" if form != "array" else b"\n}"
    before = [
        call
        for call in whole
        if TEXTS[form].index(ending, _offset(TEXTS[form], call)) + len(ending) <= first
    ]
    assert found[: len(before)] == before


SYMBOLS = [b"{", b"}", b"[", b"]", b'"', b",", b":", b"\n", b'"index":', b"1", b" ", b"\\"]


@given(st.binary(max_size=200) | st.lists(st.sampled_from(SYMBOLS), max_size=60).map(b"".join))
@examples(3)
def test_any_bytes(text: bytes) -> None:
    for given_text in (text, b"[" + text, b'{"index":1,"function":{"name":"vkCmdDraw"' + text):
        read(given_text)
        gfxreconstruct.claims(given_text)
        api_dump.claims(given_text)
        hint(given_text)


def test_who_claims_what() -> None:
    dump = dumped(SMALL)
    for text in TEXTS.values():
        assert gfxreconstruct.claims(text) and not api_dump.claims(text)
    assert api_dump.claims(dump) and not gfxreconstruct.claims(dump)
    for other in (
        b"",
        b"images: {}",
        b'{"images": {}}',
        b'{"renderPasses": {}}',
        b"<rdc>",
        b'{"header": {}}',
        b'{"index": 1}',
    ):
        assert not gfxreconstruct.claims(other) and not api_dump.claims(other)
    assert gfxreconstruct.claims(lined([line(1, draw(3))])), "without a header"


# Captures of real programs.

COUNTS = {
    "gfxr_0.9.18_msaa.jsonl": 75,
    "gfxr_1.0.5_msaa.jsonl": 77,
    "gfxr_1.0.5_msaa.expand-flags.jsonl": 77,
    "gfxr_1.0.5_msaa.json": 77,
    "gfxr_0.9.18_vkcube_trim.jsonl": 114,
    "gfxr_1.0.5_vkcube_trim.jsonl": 116,
}


class Everything(frozenset[str]):
    """Every call's name."""

    def __contains__(self, name: object) -> bool:
        return True


@pytest.mark.skipif(not FOLDER.is_dir(), reason=f"no samples at {FOLDER}")
class TestSamples:
    @pytest.mark.parametrize("name", COUNTS)
    def test_every_call_of_a_sample(self, name: str) -> None:
        text = (FOLDER / name).read_bytes()
        assert gfxreconstruct.claims(text[: 1 << 16])
        objects = (
            json.loads(text)
            if name.endswith(".json")
            else [json.loads(each) for each in text.splitlines()]
        )
        bodies = [
            (each["index"], each.get("function") or each.get("vkFunc"))
            for each in objects
            if "function" in each or "vkFunc" in each
        ]
        found = [call for call in calls(text, Everything()) if call.name.startswith("vk")]
        assert [(call.at.call, call.name, call.result) for call in found] == [
            (at, body["name"], body.get("return")) for at, body in bodies
        ]
        assert len(calls(text, Everything())) == COUNTS[name]
        assert len([each for each in read(text, Everything())[0] if isinstance(each, Mark)]) == (
            "trim" in name
        )

    def test_a_sample_is_the_same_in_every_dialect(self) -> None:
        def of(name: str) -> list[tuple[str, Any, str | None]]:
            found = calls(
                (FOLDER / name).read_bytes(),
                WANTED | {"vkCreateFramebuffer", "vkCmdResolveImage", "vkQueueSubmit"},
            )
            return [common(call) for call in found if call.name.startswith("vk")]

        lines = of("gfxr_1.0.5_msaa.jsonl")
        assert len(lines) > 10
        assert of("gfxr_1.0.5_msaa.json") == lines
        assert [each[0] for each in of("gfxr_0.9.18_msaa.jsonl")] == [each[0] for each in lines]
        images = [
            [each for each in of(f"gfxr_{form}") if each[0] == "vkCreateImage"]
            for form in ("0.9.18_msaa.jsonl", "1.0.5_msaa.expand-flags.jsonl")
        ]
        assert images[0] == images[1] == [each for each in lines if each[0] == "vkCreateImage"]
