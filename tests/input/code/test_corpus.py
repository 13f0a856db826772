"""Programs in many styles: mistakes are reported on their lines, and nothing else is reported."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.input.code.expected import (
    CORPUS,
    PROGRAMS,
    Found,
    findings,
    marks,
    outcome,
    program_marks,
)
from tests.input.code.generated import program as generated

pytest.importorskip("tree_sitter_cpp")


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_what_a_program_says(program: Path) -> None:
    held = outcome(program)
    assert held.false == ()
    assert held.missed == ()


def test_the_marks_of_a_program() -> None:
    text = (
        "a;\nb;  // expect: MSAA201, MSAA403#x  // may: MSAA101\n/* expect-later: MSAA406 */ c;\n"
    )
    assert marks(text) == [
        (2, "expect", "MSAA201", "MSAA201:2"),
        (2, "expect", "MSAA403", "MSAA403#x"),
        (2, "may", "MSAA101", "MSAA101:2"),
        (3, "expect-later", "MSAA406", "MSAA406:3"),
    ]


def test_a_program_is_held_against_its_marks(tmp_path: Path) -> None:
    """A mark on the wrong line is both missed and false, so this test can fail."""
    text = (CORPUS / "positional.cpp").read_text(encoding="utf-8")
    moved = tmp_path / "moved.cpp"
    text = text.replace("  // expect: MSAA205", "").replace(
        "#define CHECK", "// expect: MSAA205\n#define CHECK"
    )
    moved.write_text(text, encoding="utf-8")
    held = outcome(moved)
    assert [name[:7] for name in held.missed] == ["MSAA205"]
    assert [(found.code, type(found)) for found in held.false] == [("MSAA205", Found)]


def test_a_program_of_several_files(tmp_path: Path) -> None:
    """Marks count in the file that they are in."""
    program = tmp_path / "program"
    (program / "render").mkdir(parents=True)
    text = (CORPUS / "positional.cpp").read_text(encoding="utf-8")
    (program / "render" / "pass.cpp").write_text(text, encoding="utf-8")
    (program / "main.cpp").write_text("int main() {}  // expect: MSAA205\n", encoding="utf-8")
    held = outcome(program)
    assert held.missed == ("MSAA205:main.cpp:1",)
    assert held.false == ()
    (program / "render" / "pass.cpp").write_text(
        text.replace("// expect: MSAA205", ""), encoding="utf-8"
    )
    assert [(found.file, found.code) for found in outcome(program).false] == [
        ("render/pass.cpp", "MSAA205")
    ]


def test_a_long_program(tmp_path: Path) -> None:
    """Classes with methods of the same name, and other code between them."""
    text, places = generated(800)
    path = tmp_path / "long.cpp"
    path.write_text(text, encoding="utf-8")
    assert len(places) == 2
    assert [(found.line, found.code) for found in findings(path)] == [
        (line, "MSAA201") for line in places
    ]


@pytest.mark.parametrize("count", [1, 11, 12, 13, 40])
def test_conditional_stores_leave_it_unknown_whether_samples_are_stored(
    tmp_path: Path, count: int
) -> None:
    """If there are more alternatives than are kept, none of them is taken as the value."""
    stored = "att[1].storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;"
    text = (CORPUS / "zeroed_fields.c").read_text(encoding="utf-8")
    assert stored in text
    conditional = " ".join(
        f"if (option_{n}) att[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;" for n in range(count)
    )
    program = tmp_path / "options.c"
    text = text.replace(stored, f"{stored} {conditional}").replace(
        "memset(att, 0, sizeof(att));", ""
    )
    program.write_text(text, encoding="utf-8")
    assert outcome(program).false == ()


def test_the_corpus_has_programs_of_both_kinds() -> None:
    kinds = [
        any(kind != "may" for _, _, kind, _, _ in program_marks(program)) for program in PROGRAMS
    ]
    assert sum(kinds) >= 25
    assert len(kinds) - sum(kinds) >= 15
