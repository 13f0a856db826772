"""The built-in shaders: valid, as fresh as their sources, and with the outputs that are asked
for.
"""

from __future__ import annotations

import array
import shutil
import struct
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm import scene
from msaa_lint.experiments.confirm.shaders.spirv import (
    OUTPUTS,
    SLOTS,
    instructions,
    read,
    with_outputs,
    words_of,
)
from tests.experiments.confirm import generate_shaders as generate
from tests.strength import examples

FOLDER = Path(generate.FOLDER)
SHADERS = generate.sources()
FRAGMENTS = [name for name in SHADERS if name.endswith(".frag")]

OP_SOURCE_CONTINUED, OP_SOURCE, OP_SOURCE_EXTENSION, OP_NAME, OP_MEMBER_NAME, OP_STRING, OP_LINE = (
    2,
    3,
    4,
    5,
    6,
    7,
    8,
)
OP_NO_LINE, OP_MODULE_PROCESSED = 317, 330
DEBUG = {
    OP_SOURCE_CONTINUED, OP_SOURCE, OP_SOURCE_EXTENSION, OP_NAME, OP_MEMBER_NAME, OP_STRING,
    OP_LINE, OP_NO_LINE, OP_MODULE_PROCESSED,
}  # fmt: skip
(
    OP_ENTRY_POINT,
    OP_TYPE_INT,
    OP_TYPE_FLOAT,
    OP_TYPE_VECTOR,
    OP_TYPE_POINTER,
    OP_VARIABLE,
    OP_STORE,
    OP_DECORATE,
) = (
    15,
    21,
    22,
    23,
    32,
    59,
    62,
    71,
)
LOCATION, OUTPUT_CLASS, INPUT_CLASS = 30, 3, 1


def stored(shader: str) -> bytes:
    return (FOLDER / f"{shader}.spv").read_bytes()


def validate(path: Path) -> None:
    """Has Khronos's validator judge a module."""
    done = subprocess.run(
        ["spirv-val", "--target-env", "vulkan1.0", str(path)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def plainly(code: bytes) -> tuple[list[int], list[list[int]]]:
    """A module's header without the generator's word, and its instructions without those for
    debuggers.
    """
    words = words_of(code)
    return [*words[:2], *words[3:5]], [
        list(each) for op, each in instructions(words) if op not in DEBUG
    ]


def test_the_tools_are_there() -> None:
    assert shutil.which("glslangValidator"), "apt install glslang-tools"
    assert shutil.which("spirv-val"), "apt install spirv-tools"


def test_every_shader_has_its_code() -> None:
    assert SHADERS == [
        "cover.vert",
        "read.frag",
        "read_samples.frag",
        "samples.comp",
        "scene.frag",
        "scene.vert",
        "shaded.frag",
    ]
    assert sorted(path.name for path in FOLDER.glob("*.spv")) == [f"{name}.spv" for name in SHADERS]


@pytest.mark.parametrize("shader", SHADERS)
def test_the_code_is_valid(shader: str) -> None:
    validate(FOLDER / f"{shader}.spv")
    assert read(shader) == stored(shader)


@pytest.mark.parametrize("shader", SHADERS)
def test_the_code_is_that_of_the_source(shader: str) -> None:
    assert plainly(generate.compiled(shader)) == plainly(stored(shader)), (
        "python -m tests.experiments.confirm.generate_shaders"
    )


def test_another_source_gives_other_code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = (FOLDER / "cover.vert").read_text(encoding="utf-8")
    assert "* 2.0 - 1.0" in source
    (tmp_path / "cover.vert").write_text(
        source.replace("* 2.0 - 1.0", "* 2.0 - 0.5"), encoding="utf-8"
    )
    monkeypatch.setattr(generate, "FOLDER", str(tmp_path))
    assert generate.sources() == ["cover.vert"]
    assert plainly(generate.compiled("cover.vert")) != plainly(stored("cover.vert"))
    assert generate.main() == 0
    assert (tmp_path / "cover.vert.spv").read_bytes() == generate.compiled("cover.vert")
    (tmp_path / "cover.vert").write_text("#version 450\nvoid main() { wrong }\n", encoding="utf-8")
    with pytest.raises(subprocess.CalledProcessError):
        generate.compiled("cover.vert")


# Outputs


class Module:
    """What a module declares."""

    def __init__(self, code: bytes) -> None:
        every = list(instructions(words_of(code)))
        self.types = {
            each[1]: (op, each)
            for op, each in every
            if op in (OP_TYPE_INT, OP_TYPE_FLOAT, OP_TYPE_VECTOR, OP_TYPE_POINTER)
        }
        self.variables = {each[2]: (each[1], each[3]) for op, each in every if op == OP_VARIABLE}
        self.locations = {
            each[1]: each[3] for op, each in every if op == OP_DECORATE and each[2] == LOCATION
        }
        (self.entry,) = [each for op, each in every if op == OP_ENTRY_POINT]

    def outputs(self) -> dict[int, str]:
        """The kinds of the outputs, by location."""
        found = {}
        for variable, (pointer, storage) in self.variables.items():
            if storage == OUTPUT_CLASS:
                assert self.locations[variable] not in found
                found[self.locations[variable]] = self.kind(pointer)
        return found

    def kind(self, pointer: int) -> str:
        _, vector = self.types[self.types[pointer][1][3]]
        assert vector[3] == 4
        op, component = self.types[vector[2]]
        return "float" if op == OP_TYPE_FLOAT else "sint" if component[3] else "uint"

    def interface(self) -> list[int]:
        """The variables of the entry point, which is called `main`."""
        name = self.entry[3:5].tobytes()
        assert name == b"main\0\0\0\0"
        return list(self.entry[5:])


KINDS = st.lists(st.sampled_from(["", *OUTPUTS]), max_size=SLOTS)


@pytest.mark.parametrize("shader", FRAGMENTS)
def test_a_shader_has_every_output_there_may_be(shader: str) -> None:
    expected = {first + slot: kind for kind, first in OUTPUTS.items() for slot in range(SLOTS)}
    assert Module(stored(shader)).outputs() == expected


@examples(0.25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(shader=st.sampled_from(FRAGMENTS), outputs=KINDS)
def test_a_shader_has_the_outputs_that_are_asked_for(
    tmp_path: Path, shader: str, outputs: Sequence[str]
) -> None:
    code = read(shader, outputs)
    (tmp_path / "made.spv").write_bytes(code)
    validate(tmp_path / "made.spv")
    made = Module(code)
    assert made.outputs() == {slot: kind for slot, kind in enumerate(outputs) if kind}
    outer = {
        variable
        for variable, (_, storage) in made.variables.items()
        if storage in (OUTPUT_CLASS, INPUT_CLASS)
    }
    assert set(made.interface()) == outer
    assert len(made.interface()) == len(outer)


@given(shader=st.sampled_from(FRAGMENTS), outputs=KINDS)
def test_nothing_but_outputs_is_changed(shader: str, outputs: Sequence[str]) -> None:
    before, after = words_of(stored(shader)), words_of(read(shader, outputs))
    assert before[:5] == after[:5]
    dropped = {each[2] for op, each in difference(before, after) if op == OP_VARIABLE}
    assert len(dropped) == 3 * SLOTS - sum(map(bool, outputs))
    for op, each in difference(before, after):
        assert op in (OP_ENTRY_POINT, OP_NAME, OP_VARIABLE, OP_DECORATE, OP_STORE), (
            "of outputs: their names, decorations, stores"
        )
        assert (
            op in (OP_ENTRY_POINT, OP_VARIABLE)
            or each[1] in dropped
            or (op == OP_DECORATE and each[2] == LOCATION)
        )


def difference(
    before: array.array[int], after: array.array[int]
) -> Iterator[tuple[int, array.array[int]]]:
    """The instructions of one module that the other does not have."""
    there = {tuple(each) for _, each in instructions(after)}
    return ((op, each) for op, each in instructions(before) if tuple(each) not in there)


def test_more_outputs_than_a_shader_has_are_refused() -> None:
    with pytest.raises(ValueError, match="8"):
        with_outputs(stored("scene.frag"), ["float"] * (SLOTS + 1))


def test_a_kind_that_there_is_not_is_refused() -> None:
    with pytest.raises((KeyError, ValueError)):
        with_outputs(stored("scene.frag"), ["double"])


def test_words_in_the_other_order_are_turned() -> None:
    code = stored("scene.frag")
    words = array.array("I", code)
    words.byteswap()
    assert with_outputs(words.tobytes(), ["float"]) == with_outputs(code, ["float"])
    assert words_of(words.tobytes()) == words_of(code)


# The scene


def test_the_scene_lies_within_the_picture() -> None:
    corners = [
        struct.unpack_from("<3f", scene.vertices(), at)
        for at in range(0, len(scene.vertices()), scene.VERTEX_BYTES)
    ]
    assert len(corners) % 3 == 0 and len(corners) == len(scene.CORNERS)
    # One triangle over the whole picture.
    assert corners[: scene.BACKDROP] == [
        (-1.0, -1.0, 250 / 256),
        (3.0, -1.0, 250 / 256),
        (-1.0, 3.0, 250 / 256),
    ]
    triangles = [corners[at : at + 3] for at in range(scene.BACKDROP, len(corners), 3)]
    depths = [{z for _, _, z in triangle} for triangle in triangles]
    assert all(len(own) == 1 for own in depths), "each lies flat"
    assert len(set.union(*depths)) == len(triangles), "no two at one depth"
    assert all(0 < z < 250 / 256 for own in depths for z in own)
    for triangle in triangles:
        # None is clipped, turned by a quarter neither.
        assert all(abs(x) < 1 and abs(y) < 1 for x, y, _ in triangle)
        assert all(
            value * scene.GRID == int(value * scene.GRID)
            for x, y, _ in triangle
            for value in (x, y)
        )
        (ax, ay, _), (bx, by, _), (cx, cy, _) = triangle
        assert (bx - ax) * (cy - ay) != (cx - ax) * (by - ay), "none is a line"


# What is no SPIR-V


def starts(code: bytes) -> set[int]:
    """The words that instructions begin at, and the end."""
    found, at = {5}, 5
    for _, each in instructions(words_of(code)):
        at += len(each)
        found.add(at)
    return found


@pytest.mark.parametrize("shader", SHADERS)
def test_code_that_is_cut_off_is_refused(shader: str) -> None:
    code = stored(shader)
    whole = starts(code)
    for length in (*range(0, len(code), 4), 1, 19, 21, 4 * (len(code) // 8) + 2, len(code) - 1):
        if length % 4 == 0 and length // 4 in whole:
            # What is cut between instructions is read to its end.
            with_outputs(code[:length], ["float"])
            continue
        with pytest.raises(ValueError, match="not SPIR-V"):
            with_outputs(code[:length], ["float"])


@pytest.mark.parametrize(
    "code",
    [
        b"",
        b"\0" * 20,
        b"#version 450 core\n\n\n",
        stored("cover.vert")[4:],
        stored("cover.vert")[:20] + b"\0" * 4,
    ],
)
def test_what_is_no_code_is_refused(code: bytes) -> None:
    with pytest.raises(ValueError, match="not SPIR-V"):
        with_outputs(code, ["float"])


@examples(3)
@given(
    st.sampled_from(FRAGMENTS),
    st.lists(st.tuples(st.integers(5, 10**6), st.integers(0, 2**32 - 1)), min_size=1, max_size=4),
    KINDS,
)
def test_damaged_code_is_read_or_refused(
    shader: str, damage: list[tuple[int, int]], outputs: Sequence[str]
) -> None:
    words = words_of(stored(shader))
    for at, value in damage:
        words[5 + at % (len(words) - 5)] = value
    try:
        with_outputs(words.tobytes(), outputs)
    except ValueError as error:
        assert "not SPIR-V" in str(error)


@pytest.mark.parametrize("op", [OP_ENTRY_POINT, OP_NAME, OP_STORE, OP_VARIABLE, OP_DECORATE])
def test_an_instruction_that_is_too_short_is_passed_over_or_refused(op: int) -> None:
    head = words_of(stored("cover.vert"))[:5]
    for length in (1, 2, 3):
        code = head + array.array("I", [length << 16 | op, *[0x41414141] * (length - 1)])
        with suppress(ValueError):
            with_outputs(code.tobytes(), ["float"])


def test_an_entry_point_whose_name_does_not_end_is_refused() -> None:
    head = words_of(stored("cover.vert"))[:5]
    code = (
        head + array.array("I", [5 << 16 | OP_ENTRY_POINT, 4, 1, 0x41414141, 0x41414141])
    ).tobytes()
    with pytest.raises(ValueError, match="not SPIR-V"):
        with_outputs(code, ["float"])
