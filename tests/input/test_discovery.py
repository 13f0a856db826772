import os
from pathlib import Path

import pytest

from msaa_lint.input.discovery import Discovered, discover
from msaa_lint.input.file_types import HEAD_BYTES
from msaa_lint.linter.settings import config
from msaa_lint.linter.settings.config import Configurations


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "p").mkdir()
    (tmp_path / "p/.git").mkdir()
    monkeypatch.chdir(tmp_path / "p")
    monkeypatch.delenv(config.VARIABLE, raising=False)
    return tmp_path / "p"


FRAME = "images: {color: {format: R8G8B8A8_UNORM}}\n"


def write(*paths: str, text: str | bytes = FRAME) -> None:
    for path in paths:
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_bytes(text if isinstance(text, bytes) else text.encode())


def found(*paths: str) -> Discovered:
    configurations = Configurations()
    return discover(paths, lambda path: configurations.load(path).settings)


def clean(*paths: str) -> list[str]:
    result = found(*paths)
    assert (result.findings, result.notes) == ([], [])
    return result.files


def test_a_named_file_is_linted_whatever_its_name() -> None:
    write("frame.txt", ".hidden.yaml", "node_modules/x.dat", text="")
    assert clean("frame.txt", "./.hidden.yaml", "node_modules/x.dat") == [
        ".hidden.yaml",
        "frame.txt",
        "node_modules/x.dat",
    ]


def test_each_file_once_and_in_order(project: Path) -> None:
    write("b/a.msaa.yaml", "b-c.msaa.yaml", "a.msaa.yaml")
    assert clean(
        "b",
        str(project / "b/a.msaa.yaml"),
        "b-c.msaa.yaml",
        "./a.msaa.yaml",
        ".",
        "b/../a.msaa.yaml",
    ) == [
        "a.msaa.yaml",
        "b/a.msaa.yaml",
        "b-c.msaa.yaml",
    ]


def test_a_folder_gives_its_inputs_by_name_or_by_look() -> None:
    write("f/a.msaa.yaml", "f/b.msaa.yml", "f/c.MSAA.json", text="broken: [")
    write("f/deep/er/d.yaml", "f/e.yml", "f/g.json", "f/h.txt")
    write("f/no.yaml", "f/no.json", text="name: ci\n")
    assert clean("f") == [
        "f/a.msaa.yaml",
        "f/b.msaa.yml",
        "f/c.MSAA.json",
        "f/deep/er/d.yaml",
        "f/e.yml",
        "f/g.json",
    ]


def test_a_frame_begins_in_the_head_of_a_file_in_any_encoding() -> None:
    frame = FRAME.encode()
    write("f/near.yaml", text=b"#" * (HEAD_BYTES - 80) + b"\n" + frame)
    write("f/far.yaml", text=b"#" * HEAD_BYTES + b"\n" + frame)
    write("f/latin.yaml", text=b"# \xe9\n" + frame)
    write("f/wide.yaml", text=FRAME.encode("utf-16"))
    write("f/marked.yaml", text=b"\xef\xbb\xbf" + frame)
    assert clean("f") == ["f/latin.yaml", "f/marked.yaml", "f/near.yaml", "f/wide.yaml"]


def test_folders_of_tools_are_passed_over() -> None:
    for folder in (
        ".git",
        ".hidden",
        "node_modules/x",
        "venv",
        "__pycache__",
        "deep/site-packages",
        "env",
    ):
        write(f"{folder}/a.msaa.yaml")
    write("env/pyvenv.cfg", text="")
    write("a.msaa.yaml", ".b.msaa.yaml")
    assert clean(".") == ["a.msaa.yaml"]
    assert clean(".hidden") == [".hidden/a.msaa.yaml"]
    assert clean("env") == ["env/a.msaa.yaml"]


def test_links_to_folders_are_not_followed_and_loops_end() -> None:
    write("f/a.msaa.yaml", "other/b.msaa.yaml")
    Path("f/loop").symlink_to("..")
    Path("f/self").symlink_to("self")
    Path("f/other").symlink_to("../other")
    assert clean("f") == ["f/a.msaa.yaml"]


def test_links_to_files_stay_in_the_project(project: Path) -> None:
    write("f/a.msaa.yaml", "other/b.yaml")
    (project.parent / "secret.yaml").write_text("images: secret")
    Path("f/in.msaa.yaml").symlink_to("../other/b.yaml")
    Path("f/out.msaa.yaml").symlink_to("../../secret.yaml")
    Path("f/gone.msaa.yaml").symlink_to("nowhere")
    Path("f/seen.yaml").symlink_to("../../secret.yaml")
    result = found("f")
    assert result.files == ["f/a.msaa.yaml", "f/in.msaa.yaml"]
    assert result.notes == [
        "f/gone.msaa.yaml is a link that is broken or leaves the project: name it to lint it",
        "f/out.msaa.yaml is a link that is broken or leaves the project: name it to lint it",
    ]
    assert clean("f/out.msaa.yaml") == ["f/out.msaa.yaml"]


def test_what_is_not_there_is_an_error_and_the_rest_is_linted() -> None:
    write("a.yaml")
    Path("gone.yaml").symlink_to("nowhere")
    result = found("no.yaml", "a.yaml", "gone.yaml", "a\0b")
    assert result.files == ["a.yaml"]
    assert [
        (each.code, each.fatal, each.file, each.span, each.message, each.help)
        for each in result.findings
    ] == [
        ("MSAA921", True, "no.yaml", None, "no such file or folder `no.yaml`", ""),
        (
            "MSAA921",
            True,
            "gone.yaml",
            None,
            "no such file or folder `gone.yaml`: it is a broken link",
            "",
        ),
        ("MSAA921", True, "a\0b", None, "no such file or folder `a\0b`", ""),
    ]


def test_a_folder_without_inputs_is_an_error() -> None:
    write("f/x/readme.txt", "f/ci.yaml", text="name: ci")
    result = found("f")
    assert result.files == []
    (problem,) = result.findings
    assert (problem.code, problem.fatal, problem.file) == ("MSAA921", True, "f")
    names = "*.msaa.yaml, *.msaa.yml, *.msaa.json"
    assert (
        problem.message
        == f"nothing to lint in `f`: inputs are called {names} or contain a Vulkan or Metal frame; "
        "name other files"
    )


def test_exclude_wins_over_a_named_file_and_says_so() -> None:
    write("msaa-lint.toml", text='exclude = ["gen/", "*.old.yaml"]\n')
    write("gen/a.msaa.yaml", "b.old.yaml", "c.yaml")
    result = found("gen/a.msaa.yaml", "b.old.yaml", "c.yaml", "gen")
    assert (result.files, result.findings) == (["c.yaml"], [])
    assert result.notes == [
        "gen/a.msaa.yaml is excluded by `gen/`",
        "b.old.yaml is excluded by `*.old.yaml`",
        "gen is excluded by `gen/`",
    ]
    everything = found(".")
    assert (everything.files, everything.findings, everything.notes) == (["c.yaml"], [], [])


def test_a_folder_of_which_all_is_excluded_is_an_error() -> None:
    write("msaa-lint.toml", text='exclude = ["*.yaml"]\n')
    write("f/a.yaml", "f/b.yaml")
    (problem,) = found("f").findings
    assert problem.message == "nothing to lint in `f`: all inputs are excluded (2)"


def test_a_nearer_configuration_governs_its_folder() -> None:
    write("msaa-lint.toml", text='exclude = ["*.yaml"]\n')
    write("f/msaa-lint.toml", text='exclude = ["a.yaml"]\n')
    write("f/a.yaml", "f/b.yaml", "c.yaml")
    assert found(".").files == ["f/b.yaml"]


def test_include_says_what_is_linted_of_a_folder() -> None:
    write("msaa-lint.toml", text='include = ["*.frame", "frames/*.yaml"]\n')
    write("a.frame", "frames/b.yaml", "frames/x/c.yaml", "d.msaa.yaml", text="")
    assert clean(".") == ["a.frame", "frames/b.yaml"]
    assert clean("d.msaa.yaml") == ["d.msaa.yaml"]


def test_standard_input_is_handed_on() -> None:
    assert clean("-") == ["-"]


def test_a_walk_has_a_floor() -> None:
    write("/".join(["f", *"d" * 64, "a.msaa.yaml"]), "/".join(["f", *"d" * 65, "b.msaa.yaml"]))
    result = found("f")
    assert result.files == ["/".join(["f", *"d" * 64, "a.msaa.yaml"])]
    assert result.notes == [
        "/".join(["f", *"d" * 65]) + " is more than 64 folders deep: name it to lint it"
    ]


def test_what_is_no_regular_file_in_a_folder_is_a_note() -> None:
    write("f/a.msaa.yaml")
    os.mkfifo("f/b.msaa.yaml")
    os.mkfifo("f/c.yaml")
    Path("f/d.msaa.yaml").mkdir()
    result = found("f")
    assert (result.files, result.notes) == (
        ["f/a.msaa.yaml"],
        ["f/b.msaa.yaml is not a regular file: not linted"],
    )


def test_a_folder_that_cannot_be_read_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    write("f/a.msaa.yaml", "f/g/b.msaa.yaml")
    scan = os.scandir

    def refuse(path: str) -> object:
        if path == "f/g":
            raise PermissionError(13, "Permission denied")
        return scan(path)

    monkeypatch.setattr(os, "scandir", refuse)
    result = found("f")
    assert result.files == ["f/a.msaa.yaml"]
    assert [(each.file, each.fatal, each.message) for each in result.findings] == [
        ("f/g", True, "cannot read the folder: Permission denied")
    ]


def test_headers_of_vulkan_are_inputs_only_if_named() -> None:
    text = "VkImageCreateInfo info; info.samples = sampleCount;\n"
    write("libs/vulkan/vulkan_hash.hpp", "libs/vk_mem_alloc.h", "renderer/targets.h", text=text)
    settings = Configurations()
    assert discover(["."], lambda path: settings.load(path).settings, sources=True).files == [
        "renderer/targets.h"
    ]
    assert clean("libs/vk_mem_alloc.h") == ["libs/vk_mem_alloc.h"]
