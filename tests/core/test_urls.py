"""URLs as names: what is one, what outputs call it, and what an input at one may state."""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.core import urls
from msaa_lint.core.project import Outside, project_root, shown
from msaa_lint.core.text.files import open_file


@pytest.mark.parametrize(
    "path",
    ["-", "C:\\frames", "C://frames", "C:/frames", "frames/a.yaml", "https:/x", "://x", "s3:", ""],
)
def test_paths_are_not_urls(path: str) -> None:
    assert not urls.is_url(path) and urls.name_of(path) == path and urls.problem(path) is None


def test_a_path_that_exists_is_not_a_url(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert urls.is_url("s3://bucket")
    (tmp_path / "s3:/bucket").mkdir(parents=True)
    assert not urls.is_url("s3://bucket")
    assert shown("s3://bucket") == "s3:/bucket"


@pytest.mark.parametrize(
    ("url", "name"),
    [
        ("s3://bucket/frames/", "s3://bucket/frames"),
        ("S3://bucket/a b.yaml", "s3://bucket/a b.yaml"),
        ("gs://bucket", "gs://bucket"),
        ("sftp://me@host/frames", "sftp://me@host/frames"),
        (
            "abfs://container@account.dfs.core.windows.net/frames",
            "abfs://container@account.dfs.core.windows.net/frames",
        ),
        ("http://[::1]:8080/frames", "http://[::1]:8080/frames"),
        ("https://host:8080/a@b", "https://host:8080/a@b"),
    ],
)
def test_names(url: str, name: str) -> None:
    assert (urls.name_of(url), urls.name_of(name), urls.problem(url)) == (name, name, None)
    assert shown(url) == name


@pytest.mark.parametrize(
    ("url", "name"),
    [
        ("s3://AKIA:secret@bucket/frames", "s3://bucket/frames"),
        ("s3://AKIA:sec/ret@bucket/frames", "s3://bucket/frames"),
        ("s3://AKIA:sec/ret", "s3://..."),
        ("sftp://me:12345@host/frames", "sftp://host/frames"),
        ("https://host/frame.json?X-Amz-Signature=secret#secret", "https://host/frame.json"),
    ],
)
def test_secrets_are_neither_used_nor_shown(url: str, name: str) -> None:
    assert (urls.name_of(url), shown(url)) == (name, name)
    assert "is not read because" in (urls.problem(url) or "")


def test_a_file_url_is_a_path() -> None:
    assert urls.name_of("file:///a%20folder/frame.yaml") == "/a folder/frame.yaml"
    assert urls.name_of("file://localhost/frame.yaml") == "/frame.yaml"
    assert "another machine" in (urls.problem("file://elsewhere/frame.yaml") or "")


@pytest.fixture
def allowed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(urls, "_allowed", set())
    urls.allow("s3://bucket/frames/")
    urls.allow("s3://bucket/frames/deep")
    urls.allow("https://host/frames")


@pytest.mark.usefixtures("allowed")
def test_the_project_is_the_outermost_folder_that_is_named() -> None:
    assert project_root("s3://bucket/frames/deep/er") == "s3://bucket/frames"
    assert project_root("s3://bucket/frames2") == "s3://bucket/frames2"


@pytest.mark.usefixtures("allowed")
@pytest.mark.parametrize(
    ("path", "url"),
    [
        ("s3://bucket/frames/deep/../a::b.spv", "s3://bucket/frames/a::b.spv"),
        ("s3://bucket/frames/../secret", None),
        ("s3://bucket/frames/../../../secret", None),
        ("s3://bucket/frames", None),
        ("s3://other/a.spv", None),
        ("/etc/passwd", None),
    ],
)
def test_what_an_input_states_stays_in_the_folder(path: str, url: str | None) -> None:
    assert urls.inside(path, "s3://bucket/frames") == url


@pytest.mark.usefixtures("allowed")
def test_a_web_server_is_not_asked_for_what_it_may_decode() -> None:
    assert urls.inside("https://host/frames/%2e%2e/secret", "https://host/frames") is None
    assert urls.inside("https://host/frames/a.spv?b", "https://host/frames") is None


@pytest.mark.usefixtures("allowed")
def test_an_input_states_no_url() -> None:
    for path, project in (
        ("s3://bucket/frames/s3://other/a.spv", "s3://bucket/frames"),
        ("s3://other/a", "s3://other"),
    ):
        with pytest.raises(OSError, match="it is a URL, not a path"):
            open_file(path, project)
    with pytest.raises(OSError, match="it is a URL, not a path"):
        open_file("s3://bucket/frames/a.spv", str(Path.cwd()))
    with pytest.raises(Outside):
        open_file("s3://bucket/secret", "s3://bucket/frames")
