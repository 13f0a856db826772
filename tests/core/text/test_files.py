from __future__ import annotations

import os
import socket
import threading
import time
from pathlib import Path

import pytest

from msaa_lint.core.project import Outside
from msaa_lint.core.text import files
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable

posix = pytest.mark.skipif(os.name != "posix", reason="what is tried here is POSIX's")
MAX = 1 << 20


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "project").mkdir()
    (tmp_path / "outside").mkdir()
    (tmp_path / "outside/secret").write_bytes(b"secret")
    return tmp_path / "project"


def inside(project: Path, path: str, limit: int = MAX) -> bytes:
    return read(str(project / path), limit, str(project))


@pytest.mark.parametrize("named", [True, False])
def test_a_file_up_to_the_limit(project: Path, named: bool) -> None:
    file = project / "a.yaml"
    file.write_bytes(b"a: 1\r\n")
    root = None if named else str(project)
    assert read(str(file), 6, root) == b"a: 1\r\n"
    with pytest.raises(Unreadable, match="larger than the limit of 5 bytes"):
        read(str(file), 5, root)


@pytest.mark.parametrize("named", [True, False])
def test_a_huge_file_is_refused_by_its_size(project: Path, named: bool) -> None:
    file = project / "huge.yaml"
    with file.open("wb") as out:
        out.truncate(1 << 40)  # sparse: it takes no room
    before = time.process_time()
    with pytest.raises(Unreadable, match="limit of 4294967296 bytes"):
        read(str(file), 1 << 32, None if named else str(project))
    assert time.process_time() - before < 0.5, "nothing is read"


@posix
def test_a_file_with_more_than_its_size_is_read_to_its_end() -> None:
    assert os.stat("/proc/self/status").st_size == 0
    assert b"VmPeak" in read("/proc/self/status", MAX, None)


@pytest.mark.parametrize("named", [True, False])
def test_a_folder(project: Path, named: bool) -> None:
    for folder in (project, project / "f"):
        folder.mkdir(exist_ok=True)
        with pytest.raises(OSError, match="it is a folder, not a regular file"):
            read(str(folder), MAX, None if named else str(project))


@posix
def test_what_content_names_must_be_a_regular_file(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    os.mkfifo(project / "pipe")
    with pytest.raises(OSError, match="it is a pipe, not a regular file"):
        inside(project, "pipe")
    monkeypatch.chdir(project)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket")
        for root in (None, str(project)):
            with pytest.raises(OSError, match="it is a socket, not a regular file"):
                read("socket", MAX, root)
    with pytest.raises(OSError, match="it is a device, not a regular file"):
        read("/dev/zero", MAX, "/dev")


@posix
def test_a_pipe_that_takes_a_files_place_is_not_waited_for(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (project / "file").write_bytes(b"a: 1")
    os.mkfifo(project / "pipe")
    status = os.stat(project / "file")
    monkeypatch.setattr(os, "stat", lambda *_, **__: status)
    with pytest.raises(OSError, match="it is a pipe, not a regular file"):
        inside(project, "pipe")


@posix
def test_a_link_that_takes_the_place_of_a_file_or_folder_is_not_followed(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The path was checked when it still had no links."""
    (project / "file").symlink_to("../outside/secret")
    (project / "folder").symlink_to("../outside")
    monkeypatch.setattr(files, "real_path", lambda path, _: path)
    for path in ("file", "folder/secret"):
        with pytest.raises(OSError, match=r"not a regular file|Not a directory|symbolic links"):
            inside(project.resolve(), path)


@posix
def test_the_command_line_names_pipes_and_devices(project: Path) -> None:
    assert read("/dev/null", MAX, None) == b""
    with pytest.raises(Unreadable, match="larger than the limit of 1048576 bytes"):
        read("/dev/zero", MAX, None)
    os.mkfifo(project / "pipe")
    with pytest.raises(OSError, match="it is a pipe that nothing writes to"):
        read(str(project / "pipe"), MAX, None)
    reader, writer = os.pipe()
    threading.Timer(0.2, lambda: (os.write(writer, b"a: 1"), os.close(writer))).start()
    assert read(f"/dev/fd/{reader}", MAX, None) == b"a: 1"
    os.close(reader)


def test_a_link_stays_in_the_project(project: Path) -> None:
    (project / "a/b").mkdir(parents=True)
    (project / "a/b/file").write_bytes(b"a: 1")
    (project / "link").symlink_to("a/b/file")
    (project / "folder").symlink_to("a")
    (project / "absolute").symlink_to((project / "a").resolve())
    for path in (
        "link",
        "folder/b/file",
        "absolute/b/file",
        "a/b/../b/file",
        "../project/link",
        str((project / "link").resolve()),
    ):
        assert inside(project, path) == b"a: 1", path
    (project / "loop").symlink_to("loop")
    with pytest.raises(OSError, match="Too many levels of symbolic links"):
        inside(project, "loop")
    (project / "gone").symlink_to("nowhere")
    with pytest.raises(FileNotFoundError):
        inside(project, "gone")


@posix
def test_what_is_outside_is_not_looked_at(project: Path) -> None:
    """It makes no difference whether it exists."""
    (project / "secret").symlink_to("../outside/secret")
    (project / "gone").symlink_to("../outside/gone")
    (project / "twice").symlink_to("secret")
    (project / "folder").symlink_to("../outside")
    (project / "environment").symlink_to("/proc/self/environ")
    names = [
        "secret",
        "gone",
        "twice",
        "folder/secret",
        "folder/gone",
        "folder",
        "environment",
        "../outside/secret",
        "../outside/gone",
    ]
    names += [
        "/proc/self/environ",
        "/proc/self/root/etc/passwd",
        f"/proc/{os.getpid()}/cwd/../..",
        "/etc/passwd",
        "/nowhere",
        "..",
    ]
    names += [f"{project.name}/../../outside/secret", f"../{project.name}-other/file"]
    for name in names:
        with pytest.raises(Outside, match=r"^it is outside the project$"):
            inside(project, name)


def test_a_hard_link_is_a_file_of_the_project(project: Path) -> None:
    os.link(project.parent / "outside/secret", project / "hard")
    assert inside(project, "hard") == b"secret"


def test_paths_are_not_expanded_and_urls_are_none(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(project))
    (project / "file").write_bytes(b"a: 1")
    monkeypatch.chdir(project)
    for path in ("~/file", "$HOME/file", "${HOME}/file", "%HOME%/file"):
        with pytest.raises(FileNotFoundError):
            read(path, MAX, str(project))
    for path in (f"file://{project}/file", "http://localhost/file"):
        with pytest.raises(OSError, match="it is a URL, not a path"):
            read(path, MAX, str(project))


@pytest.mark.parametrize("named", [True, False])
def test_what_is_not_there_and_what_cannot_be(project: Path, named: bool) -> None:
    root = None if named else str(project)
    with pytest.raises(FileNotFoundError):
        read(str(project / "none.yaml"), MAX, root)
    with pytest.raises(OSError, match="invalid file name"):
        read(str(project / "a\0b"), MAX, root)
