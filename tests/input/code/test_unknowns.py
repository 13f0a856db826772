"""Source code of which nothing multisampled was understood: the summary says so, and names the
first unknown on the way.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run

HEADER = (
    "#pragma once\n\nstruct State {\n    bool msaa;\n    int samples;\n};\nextern State "
    "m_state;\nint level();\n"
)
IMAGE = """\
#include "state.h"
void {function} {{
    VkImageCreateInfo info{{}};
    info.samples = {value};
    vkCreateImage(device, &info, nullptr, &image);
}}
"""

CASES = {
    "m_state.msaa ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT": (
        "m_state.msaa",
        "`m_state.msaa` is declared in state.h:4, and set nowhere in what was read",
    ),
    "(VkSampleCountFlagBits)m_state.samples": (
        "m_state.samples",
        "`m_state.samples` is declared in state.h:5, and set nowhere in what was read",
    ),
    "renderer->getSamples()": (
        "renderer->getSamples()",
        "`renderer->getSamples()` is defined nowhere in what was read",
    ),
    "SCENE_SAMPLES": ("SCENE_SAMPLES", "`SCENE_SAMPLES` is defined nowhere in what was read"),
    "argument": ("argument", "`argument` is declared in a.cpp:2, as a parameter"),
    "other": ("other", "`other` is declared nowhere in what was read"),
}


def check(folder: Path, *names: str) -> tuple[str, list[dict[str, Any]]]:
    """The first line of the summary, and what is not read of each file."""
    text = run(folder, "check", "--isolated", "--output", "concise", *names).stdout
    entries = json.loads(run(folder, "check", "--isolated", "--output", "json", *names).stdout)[
        "inputs"
    ]
    return text, [entry["unread"] for entry in entries if entry["unread"] is not None]


@pytest.mark.parametrize("value", CASES)
def test_the_first_unknown_is_named(tmp_path: Path, value: str) -> None:
    (tmp_path / "state.h").write_text(HEADER, encoding="utf-8")
    code = IMAGE.format(function="create(VkSampleCountFlagBits argument)", value=value)
    (tmp_path / "a.cpp").write_text(code, encoding="utf-8")
    name, reason = CASES[value]
    text, (unread,) = check(tmp_path, ".")
    assert (unread["line"], unread["unknown"]) == (4, name)
    assert (
        f"; {reason}: state it with `// msaa-lint: assume {name}=VALUE`, or check a capture"
        in unread["message"]
    )
    understood = "1 image, 1 not understood" if "?" in value else "nothing read"
    assert f"1 C++ file: {understood})" in text


def test_the_way_to_the_unknown_is_followed(tmp_path: Path) -> None:
    (tmp_path / "state.h").write_text(HEADER, encoding="utf-8")
    code = "static VkSampleCountFlagBits pick() { return m_state.samples; }\n" + IMAGE.format(
        function="create()", value="chosen"
    )
    (tmp_path / "a.cpp").write_text(
        code.replace("    info.samples", "    auto chosen = pick();\n    info.samples"),
        encoding="utf-8",
    )
    _, (unread,) = check(tmp_path, ".")
    assert unread["unknown"] == "m_state.samples"


def test_an_assumption_can_be_made_of_it(tmp_path: Path) -> None:
    (tmp_path / "state.h").write_text(HEADER, encoding="utf-8")
    code = IMAGE.format(function="create()", value="m_state.samples")
    (tmp_path / "a.cpp").write_text(
        f"// msaa-lint: assume m_state.samples=4\n{code}", encoding="utf-8"
    )
    done = run(tmp_path, "convert", "a.cpp")
    assert "samples: 4" in done.stdout


def test_what_is_set_has_no_unknown(tmp_path: Path) -> None:
    (tmp_path / "a.cpp").write_text(
        IMAGE.format(function="create()", value="VK_SAMPLE_COUNT_4_BIT"), encoding="utf-8"
    )
    _, (unread,) = check(tmp_path, "a.cpp")
    assert unread["unknown"] is None


@pytest.mark.parametrize(
    "code",
    [
        "// info.samples = count;\n",
        "#if 0\nvoid f() { info.samples = count; vkCreateImage(d, &info, 0, &i); }\n#endif\n",
    ],
)
def test_comments_and_dead_code_create_nothing(tmp_path: Path, code: str) -> None:
    (tmp_path / "a.cpp").write_text(
        f"void g() {{ vkCreateImage(d, &info, 0, &i); }}\n{code}", encoding="utf-8"
    )
    assert check(tmp_path, "a.cpp")[1] == []


def test_many_files_are_a_short_list_in_text_and_all_in_json(tmp_path: Path) -> None:
    for number in range(9):
        code = IMAGE.format(function=f"create{number}()", value="sampleCount")
        (tmp_path / f"a{number}.cpp").write_text(code, encoding="utf-8")
    text, unread = check(tmp_path, ".")
    assert len(unread) == 9
    assert text.count(": not checked: ") == 5
    assert "4 more files not checked" in text


def test_names_in_many_files_take_no_time(tmp_path: Path) -> None:
    text = (
        IMAGE.format(function="create()", value="sampleCount")
        + "int x(int sampleCount) { return sampleCount; }\n" * 5_000
    )
    for number in range(3):
        (tmp_path / f"a{number}.cpp").write_text(text, encoding="utf-8")
    assert len(check(tmp_path, ".")[1]) == 3


def test_a_number_is_no_name(tmp_path: Path) -> None:
    (tmp_path / "state.h").write_text(
        HEADER
        + "enum Flags { MULTI = 0x00000400 };\ninline bool isMulti() { return MULTI & 0x00000C00; "
        "}\n"
    )
    value = "isMulti() ? VK_SAMPLE_COUNT_4_BIT : level()"
    (tmp_path / "a.cpp").write_text(
        IMAGE.format(function="create(VkDevice device, VkImage image)", value=value)
    )
    text, _ = check(tmp_path, ".")
    assert "x00000" not in text, text
