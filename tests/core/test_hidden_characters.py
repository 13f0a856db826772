"""Characters that hide, or reorder what is read, in descriptions and code."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from msaa_lint.core.hidden_characters import MAX_FINDINGS, hidden_characters
from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from tests.command import run

FRAME = "images:\n  a: {format: R8G8B8A8_UNORM, samples: 1}\n"


@pytest.mark.parametrize(
    ("text", "name"),
    [
        *((f"# a{chr(point)}b\n", name) for point, name in {
            0x202A: "LEFT-TO-RIGHT EMBEDDING", 0x202B: "RIGHT-TO-LEFT EMBEDDING",
            0x202C: "POP DIRECTIONAL FORMATTING",
            0x202D: "LEFT-TO-RIGHT OVERRIDE", 0x202E: "RIGHT-TO-LEFT OVERRIDE",
            0x2066: "LEFT-TO-RIGHT ISOLATE",
            0x2067: "RIGHT-TO-LEFT ISOLATE", 0x2068: "FIRST STRONG ISOLATE",
            0x2069: "POP DIRECTIONAL ISOLATE",
            0x200E: "LEFT-TO-RIGHT MARK", 0x200F: "RIGHT-TO-LEFT MARK", 0x061C: "ARABIC LETTER "
                "MARK", 0x200B: "ZERO WIDTH SPACE",
            0x200C: "ZERO WIDTH NON-JOINER", 0x200D: "ZERO WIDTH JOINER", 0x2060: "WORD JOINER",
            0xFEFF: "ZERO WIDTH NO-BREAK SPACE",
            0xAD: "SOFT HYPHEN", 0x3164: "HANGUL FILLER", 0xE0041: "TAG LATIN CAPITAL LETTER A",
        }.items()),
        ("# \u05d0\u202e\u05d1\n", "RIGHT-TO-LEFT OVERRIDE"),
        ("# a\u200d\u200db\n", "ZERO WIDTH JOINER"),
    ],
)  # fmt: skip
def test_a_character_is_noted_at_its_place(text: str, name: str) -> None:
    (finding,) = hidden_characters(Source("a.yaml", FRAME + text))
    assert finding.severity == "note" and finding.span is not None
    assert Source("a.yaml", FRAME + text).position(finding.span.start) == (3, 4)
    assert name in finding.message


@pytest.mark.parametrize(
    "text",
    [
        "שלום עולם", "مرحبا", "שלום!\u200f", "\u200fשלום", "می\u200cخواهم", "क्\u200dष",
        "👨\u200d👩\u200d👧", "❤\ufe0f",
        "🏴\U000e0067\U000e0062\U000e0065\U000e006e\U000e0067\U000e007f", "é日本",
    ],
)  # fmt: skip
def test_letters_and_what_their_scripts_need_are_not(text: str) -> None:
    assert hidden_characters(Source("a.yaml", f"# {text}\n")) == []


def test_it_is_linear_and_limited() -> None:
    findings = hidden_characters(Source("a.yaml", "# \u202e\n" * 100_000))
    assert len(findings) == MAX_FINDINGS and findings[-1].notes
    (finding,) = hidden_characters(Source("a.yaml", "\u200b" * 100_000))
    assert "and 99999 more hidden characters" in finding.message and len(finding.labels) <= 20


def test_it_is_a_note_that_can_be_suppressed_and_configured(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(f"{FRAME}# \u202e x\n", encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", "--output", "full", "a.msaa.yaml")
    assert done.returncode == 0 and "3 | # \\u202e x\n  |   ^^^^^^\n" in done.stdout
    found = json.loads(
        run(tmp_path, "check", "--isolated", "--output", "json", "a.msaa.yaml").stdout
    )["findings"]
    assert [(each["rule"], each["severity"], each["line"], each["column"]) for each in found] == [
        ("hidden-character", "note", 3, 3)
    ]
    assert run(
        tmp_path, "check", "--isolated", "--ignore", "MSAA914", "a.msaa.yaml", "--output", "concise"
    ).stdout.startswith("No findings")
    (tmp_path / "msaa-lint.toml").write_text('[severity]\nhidden-character = "error"\n')
    assert run(tmp_path, "check", "a.msaa.yaml").returncode == 2
    (tmp_path / "msaa-lint.toml").unlink()
    (tmp_path / "a.msaa.yaml").write_text(
        f"{FRAME.rstrip()}  # msaa-lint: ignore[hidden-character] \u202e\n", encoding="utf-8"
    )
    assert run(
        tmp_path, "check", "--isolated", "a.msaa.yaml", "--output", "concise"
    ).stdout.startswith("No findings")
    (tmp_path / "a.msaa.yaml").write_text(
        f"{FRAME}# msaa-lint: ignore[hidden-character] not there\n", encoding="utf-8"
    )
    assert (
        "MSAA911"
        in run(tmp_path, "check", "--isolated", "a.msaa.yaml", "--output", "concise").stdout
    )


def test_code_and_the_code_of_a_page(tmp_path: Path) -> None:
    pytest.importorskip("tree_sitter")
    code = "VkImageCreateInfo info = {.samples = VK_SAMPLE_COUNT_1_BIT}; // \u202e x\n"
    (tmp_path / "a.cpp").write_text(code, encoding="utf-8")
    (tmp_path / "a.md").write_text(f"prose \u202e x\n```cpp\n{code}```\n", encoding="utf-8")
    found = json.loads(
        run(tmp_path, "check", "--isolated", "--output", "json", "a.cpp", "a.md").stdout
    )["findings"]
    assert [(each["file"], each["rule"], each["line"], each["confidence"]) for each in found] == [
        ("a.cpp", "hidden-character", 1, "high"), ("a.md", "hidden-character", 3, "high"),
    ]  # fmt: skip


def test_a_description_that_is_written_shows_them_as_escapes() -> None:
    name = "a\x1b\u202e\u200b\u2028\u3164\U000e0041"
    (root,) = parse(Source("a", json.dumps({name: name})), Limits()).documents
    text = emit(root)
    assert (
        text.isascii()
        and text
        == '"a\\x1B\\u202E\\u200B\\u2028\\u3164\\U000E0041": '
        '"a\\x1B\\u202E\\u200B\\u2028\\u3164\\U000E0041"\n'
    )
    (again,) = parse(Source("a", text), Limits()).documents
    assert [(key, value.value) for key, value in again.value.items()] == [(name, name)]
