from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.tree import Limits, read

posix = pytest.mark.skipif(os.name != "posix", reason="what is tried here is POSIX's")


def test_a_file_up_to_the_limit(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_bytes(b"a: 1\r\n")
    assert read(str(file), Limits(bytes=6)) == b"a: 1\r\n"
    with pytest.raises(Unreadable, match="larger than the limit of 5 bytes"):
        read(str(file), Limits(bytes=5))


def test_no_more_is_read_than_the_limit(tmp_path: Path) -> None:
    file = tmp_path / "huge.yaml"
    with file.open("wb") as out:
        out.truncate(1 << 40)  # sparse: it takes no room
    with pytest.raises(Unreadable, match="limit of 1000 bytes"):
        read(str(file), Limits(bytes=1000))


def test_a_folder(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="it is a folder, not a regular file"):
        read(str(tmp_path), Limits())


@posix
def test_a_pipe_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(OSError, match="it is a pipe, not a regular file"):
        read(str(tmp_path / "pipe"), Limits())


@posix
def test_a_pipe_that_takes_a_files_place_is_not_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file, pipe = tmp_path / "file", tmp_path / "pipe"
    file.write_bytes(b"a: 1")
    os.mkfifo(pipe)
    seen = os.stat(file)
    monkeypatch.setattr(os, "stat", lambda path: seen)
    with pytest.raises(OSError, match="it is a pipe, not a regular file"):
        read(str(pipe), Limits())


@posix
def test_a_device() -> None:
    with pytest.raises(OSError, match="it is a device, not a regular file"):
        read("/dev/zero", Limits())


@posix
def test_a_socket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind("socket")
        with pytest.raises(OSError, match="it is a socket, not a regular file"):
            read("socket", Limits())


@posix
def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_bytes(b"a: 1")
    (tmp_path / "link.yaml").symlink_to("a.yaml")
    assert read(str(tmp_path / "link.yaml"), Limits()) == b"a: 1"


def test_what_is_not_there_and_what_cannot_be(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read(str(tmp_path / "none.yaml"), Limits())
    with pytest.raises(OSError, match="invalid file name"):
        read("a\0b", Limits())
