"""The folders of Swift modules."""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.input.code.project.swift_modules import SwiftModules


@pytest.mark.parametrize(
    ("manifest", "file", "module"),
    [
        ("Package.swift", "Sources/Engine/Passes/Main.swift", "Sources/Engine"),
        ("Package.swift", "Sources/Main.swift", ""),
        ("Package.swift", "Engine/Main.swift", ""),
        ("Kit/Package.swift", "Kit/Sources/Kit/A.swift", "Kit/Sources/Kit"),
        ("App/App.xcodeproj/project.pbxproj", "App/Views/Scene/View.swift", "App"),
        ("App/App.xcodeproj/project.pbxproj", "Other/View.swift", None),
        ("Engine.podspec", "extensions/Pass.swift", ""),
        (
            "a/Page.playground/contents.xcplayground",
            "a/Page.playground/Sources/Renderer.swift",
            "a/Page.playground",
        ),
        ("readme", "a/b.swift", None),
    ],
)
def test_the_folder_of_a_module(
    tmp_path: Path, manifest: str, file: str, module: str | None
) -> None:
    (tmp_path / manifest).parent.mkdir(parents=True, exist_ok=True)
    (tmp_path / manifest).touch()
    (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
    expected = "" if module is None else (tmp_path / module).as_posix()
    assert SwiftModules(str(tmp_path)).folder((tmp_path / file).as_posix()) == expected


def test_a_module_does_not_reach_out_of_its_project(tmp_path: Path) -> None:
    (tmp_path / "Package.swift").touch()
    (tmp_path / "inner").mkdir()
    assert (
        SwiftModules(str(tmp_path / "inner")).folder((tmp_path / "inner" / "a.swift").as_posix())
        == ""
    )
