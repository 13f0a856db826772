"""The generated tables are those of the registry that is installed."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from msaa_lint.frame.vulkan import enums, formats_table
from tests.frame.vulkan import generate
from tests.paths import ROOT


def test_tables_are_fresh() -> None:
    pytest.importorskip(
        "vulkan_object", reason="vulkan-object, which carries the Vulkan registry, is not installed"
    )
    assert generate.stale(generate.sources()) == []


def test_stale_and_missing_files_are_told(tmp_path: object) -> None:
    same, other, missing = (
        os.path.join(str(tmp_path), name) for name in ("same.py", "other.py", "missing.py")
    )
    for path, text in ((same, "a = 1\n"), (other, "a = 2\n")):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    assert generate.stale({same: "a = 1\n", other: "a = 1\n", missing: "a = 1\n"}) == [
        other,
        missing,
    ]


def test_check_writes_nothing_and_says_what_is_stale(
    tmp_path: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = os.path.join(str(tmp_path), "enums.py")
    monkeypatch.setattr(generate, "sources", lambda: {path: "a = 1\n"})
    assert generate.main(["--check"]) == 1
    assert not os.path.exists(path)
    assert path in capsys.readouterr().err
    assert generate.main([]) == 0
    assert generate.main(["--check"]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("module", [enums, formats_table])
def test_headers_say_where_the_tables_are_from(module: object) -> None:
    doc = module.__doc__ or ""
    assert "Vulkan registry, version 1." in doc
    assert "`python -m tests.frame.vulkan.generate`: do not edit." in doc


@pytest.mark.parametrize(
    ("enum", "name", "bits", "short"),
    [
        ("VkImageLayout", "VK_IMAGE_LAYOUT_PRESENT_SRC_KHR", False, "PRESENT_SRC_KHR"),
        (
            "VkSubpassDescriptionFlagBits",
            "VK_SUBPASS_DESCRIPTION_CUSTOM_RESOLVE_BIT_EXT",
            True,
            "CUSTOM_RESOLVE_EXT",
        ),
        ("VkPipelineStageFlagBits2", "VK_PIPELINE_STAGE_2_COPY_BIT", True, "COPY"),
    ],
)
def test_short_names(enum: str, name: str, bits: bool, short: str) -> None:
    assert generate.short_name(enum, name, bits) == short
    with pytest.raises(ValueError, match="does not begin with"):
        generate.short_name(enum, "VK_OTHER_THING", bits)


def test_the_lint_path_imports_nothing_heavy() -> None:
    heavy = {
        "difflib",
        "dataclasses",
        "inspect",
        "pathlib",
        "logging",
        "json",
        "vulkan_object",
        "msaa_lint.frame.devices.builtin_profiles",
    }
    code = (
        "import sys; before = set(sys.modules)\n"
        "import msaa_lint.frame.vulkan.names, msaa_lint.frame.vulkan.formats, "
        "msaa_lint.frame.devices, msaa_lint.frame.devices.shares\n"
        "print(*sorted(set(sys.modules) - before))"
    )
    root = ROOT
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=root
    )
    loaded = set(done.stdout.split())
    assert "msaa_lint.frame.vulkan.names" in loaded
    assert heavy & loaded == set()
